/* The scene itself: its notes, and freeing it. */
#include "model.h"

#include <stdlib.h>

#include "loader.h"

int scene_add_note(scene *s, const char *text, char *error, size_t error_bytes)
{
    loader l = {.s = s, .path = "note", .error = error, .error_bytes = error_bytes};
    return loader_note(&l, "%s", text) ? 0 : -1;
}

static void free_mesh(scene_mesh *mesh)
{
    free(mesh->name);
    free(mesh->pos);
    free(mesh->nrm);
    free(mesh->rgb);
    free(mesh->uv);
    free(mesh->mask_uv);
    free(mesh->joint);
    free(mesh->weight);
    free(mesh->idx);
}

static void free_object(scene_object *object)
{
    free(object->name);
    free(object->mask);
    free(object->baked);
    free(object->joints);
}

static void free_rig(scene_rig *rig)
{
    if (!rig) return;
    for (size_t i = 0; i < rig->n_channels; i++) {
        free(rig->channels[i].curve.times);
        free(rig->channels[i].curve.values);
    }
    for (size_t i = 0; rig->clips && i < rig->n_clips; i++) free(rig->clips[i].name);
    for (size_t i = 0; i < rig->n_cameras; i++) free(rig->cameras[i].name);
    free(rig->nodes);
    free(rig->channels);
    free(rig->clips);
    free(rig->cameras);
    free(rig);
}

void scene_free(scene *s)
{
    for (size_t i = 0; i < s->n_meshes; i++) free_mesh(&s->meshes[i]);
    for (size_t i = 0; i < s->n_objects; i++) free_object(&s->objects[i]);
    for (size_t i = 0; i < s->n_textures; i++) {
        free(s->textures[i].name);
        free(s->textures[i].rgba);
    }
    scene_remove_lights(s);
    for (size_t i = 0; i < s->n_settings; i++) {
        free(s->settings[i].key);
        free(s->settings[i].value);
    }
    for (size_t i = 0; i < s->n_clips; i++) free(s->clips[i].name);
    for (size_t i = 0; i < s->n_notes; i++) free(s->notes[i]);
    for (size_t i = 0; i < s->n_remarks; i++) free(s->remarks[i]);
    for (size_t i = 0; i < s->n_files; i++) free(s->files[i]);
    free_rig(s->rig);
    free(s->meshes);
    free(s->objects);
    free(s->textures);
    free(s->settings);
    free(s->clips);
    free(s->notes);
    free(s->remarks);
    free(s->files);
    *s = (scene){0};
}
