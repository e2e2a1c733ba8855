/* Loading a scene by its file's ending, and freeing it. */
#include "scene.h"

#include <stdlib.h>
#include <string.h>

#include "loader.h"

static bool ends_with(const char *path, const char *ending)
{
    size_t n = strlen(path), n_ending = strlen(ending);
    if (n < n_ending) return false;
    for (size_t i = 0; i < n_ending; i++) {
        char c = path[n - n_ending + i];
        if (c >= 'A' && c <= 'Z') c = (char)(c - 'A' + 'a');
        if (c != ending[i]) return false;
    }
    return true;
}

static bool load_any(loader *l)
{
    if (l->options->width <= 0 || l->options->height <= 0) {
        return loader_fail(l, "%s: the picture size %dx%d is not positive", l->path, l->options->width,
                           l->options->height);
    }
    if (ends_with(l->path, ".obj")) return loader_load_obj(l);
    if (ends_with(l->path, ".gltf")) return loader_load_gltf(l);
    if (ends_with(l->path, ".glb")) return loader_load_glb(l);
    return loader_fail(l, "%s: not a scene: .obj, .gltf and .glb are known", l->path);
}

int scene_load(scene *s, const char *path, const scene_options *options, char *error, size_t error_bytes)
{
    loader l = {.s = s, .options = options, .path = path, .error = error, .error_bytes = error_bytes};
    *s = (scene){0};
    if (error_bytes > 0) error[0] = '\0';
    bool ok = load_any(&l) && loader_add_defaults(&l);
    loader_free_mesh_light(&l);
    arena_release(&l.memory, NULL);
    s->n_file_notes = s->n_notes;
    if (!ok) scene_free(s);
    return ok ? 0 : -1;
}

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
    free(mesh->idx);
}

static void free_object(scene_object *object)
{
    free(object->name);
    free(object->mask);
    free(object->baked);
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
    for (size_t i = 0; i < s->n_notes; i++) free(s->notes[i]);
    for (size_t i = 0; i < s->n_files; i++) free(s->files[i]);
    free(s->meshes);
    free(s->objects);
    free(s->textures);
    free(s->settings);
    free(s->notes);
    free(s->files);
    *s = (scene){0};
}
