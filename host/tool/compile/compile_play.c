/* Playing a scene's frames: what changes from one to the next, and the most that any of them needs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rig.h"

#define OBJECT_(name, n)                                                                                               \
    {                                                                                                                  \
        COMPILE_OF_OBJECT, #name, offsetof(gn_object, name), n                                                         \
    }
#define LIGHT_(name, n)                                                                                                \
    {                                                                                                                  \
        COMPILE_OF_LIGHT, #name, offsetof(gn_light, name), n                                                           \
    }
#define SCENE_(name, n)                                                                                                \
    {                                                                                                                  \
        COMPILE_OF_SCENE, #name, offsetof(gn_scene, name), n                                                           \
    }

/* All that the loaders and the choice of the unit of length can make differ from frame to frame. */
static const compile_field fields[] = {
    {COMPILE_OF_SKIN, "joint", 0, sizeof(gn_affine) / 4}, /* for each of them */
    OBJECT_(to_world.m_q30, 9),
    OBJECT_(to_world.t_q16, 3),
    OBJECT_(to_world.exp, 1),
    LIGHT_(direction, 3),
    LIGHT_(position_q16, 3),
    LIGHT_(colour_exp, 1),
    LIGHT_(range_q16, 1),
    LIGHT_(near_q16, 1),
    LIGHT_(near_offset_q16, 1),
    SCENE_(camera.to_world.m_q30, 9),
    SCENE_(camera.to_world.t_q16, 3),
    SCENE_(camera.focal_q24, 1),
    SCENE_(camera.half_height_q16, 1),
    SCENE_(camera.near_q16, 1),
    SCENE_(camera.far_q16, 1),
    SCENE_(unit_log2, 1),
    SCENE_(shadow.max_distance_q16, 1),
};
enum { N_FIELDS = sizeof fields / sizeof *fields };

static const void *owner_of(const fixed_scene *f, compile_owner of, size_t idx)
{
    return of == COMPILE_OF_SKIN     ? (const void *)f->objects[idx].skin->joint
           : of == COMPILE_OF_OBJECT ? (const void *)&f->objects[idx]
           : of == COMPILE_OF_LIGHT  ? (const void *)&f->lights[idx]
                                     : (const void *)&f->scene;
}

static size_t count_of(const fixed_scene *f, compile_owner of)
{
    return of == COMPILE_OF_OBJECT || of == COMPILE_OF_SKIN ? f->scene.n_objects
           : of == COMPILE_OF_LIGHT                         ? f->scene.n_lights
                                                            : 1;
}

/* ---- What may not change ----------------------------------------------------------------------------------------- */

/* Frames differ in fields alone. */
static int check_same(const compiled *c, const fixed_scene *f, int frame, char *error, size_t bytes)
{
    const fixed_scene *base = &c->fixed;
    const char *what = f->scene.n_objects != base->scene.n_objects ? "objects"
                       : f->scene.n_lights != base->scene.n_lights ? "lights"
                       : f->n_meshes != base->n_meshes             ? "meshes"
                                                                   : NULL;
    for (size_t i = 0; !what && i < f->n_meshes; i++)
        if (!quantise_same_mesh(&f->meshes[i], &base->meshes[i])) what = "meshes";
    for (size_t i = 0; !what && i < f->scene.n_objects; i++)
        if (f->objects[i].mesh - f->meshes != base->objects[i].mesh - base->meshes) what = "meshes";
    for (size_t i = 0; !what && i < f->scene.n_objects; i++)
        if (!f->objects[i].skin != !base->objects[i].skin) what = "skins";
    if (!what) return 0;
    snprintf(error, bytes,
             "frame %d has other %s than frame %d (a ground that follows): leave one out "
             "with --frames",
             frame, what, c->first_frame);
    return -1;
}

/* ---- Tracks ------------------------------------------------------------------------------------------------------ */

static compile_track *find_track(compiled *c, const compile_field *field, size_t idx)
{
    for (size_t i = 0; i < c->n_tracks; i++)
        if (c->tracks[i].field == field && c->tracks[i].idx == idx) return &c->tracks[i];
    return NULL;
}

static size_t words_of(const compiled *c, const compile_field *field, size_t idx)
{
    return field->of == COMPILE_OF_SKIN ? field->n_words * c->fixed.objects[idx].skin->n_joints : field->n_words;
}

/* A track that stood still up to this frame; NULL: out of memory. */
static compile_track *add_track(compiled *c, const compile_field *field, size_t idx, int frames_before,
                                const void *first)
{
    compile_track *grown = realloc(c->tracks, (c->n_tracks + 1) * sizeof *grown);
    if (!grown) return NULL;
    c->tracks = grown;
    compile_track *t = &c->tracks[c->n_tracks];
    const size_t n_words = words_of(c, field, idx);
    *t = (compile_track){field, idx, n_words, malloc((size_t)c->n_frames * n_words * sizeof *t->words)};
    if (!t->words) return NULL;
    c->n_tracks++;
    for (int i = 0; i < frames_before; i++) memcpy(t->words + (size_t)i * n_words, first, 4 * n_words);
    return t;
}

static int track_field(compiled *c, const fixed_scene *f, int i, const compile_field *field, size_t idx)
{
    const char *first = (const char *)owner_of(&c->fixed, field->of, idx) + field->offset;
    const char *now = (const char *)owner_of(f, field->of, idx) + field->offset;
    compile_track *t = find_track(c, field, idx);
    const size_t n_words = words_of(c, field, idx);
    if (!t && memcmp(first, now, 4 * n_words) != 0) t = add_track(c, field, idx, i, first);
    else if (!t) return 0;
    if (!t) return -1;
    memcpy(t->words + (size_t)i * n_words, now, 4 * n_words);
    return 0;
}

static int track_frame(compiled *c, const fixed_scene *f, int i)
{
    for (size_t k = 0; k < N_FIELDS; k++)
        for (size_t idx = 0; idx < count_of(f, fields[k].of); idx++)
            if ((fields[k].of != COMPILE_OF_SKIN || f->objects[idx].skin) && track_field(c, f, i, &fields[k], idx))
                return -1;
    return 0;
}

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

static int play_frame(compiled *c, const fixed_scene *f, int i, char *error, size_t bytes)
{
    if (i > 0 && check_same(c, f, c->first_frame + i, error, bytes)) return -1;
    if (!track_frame(c, f, i)) return 0;
    snprintf(error, bytes, "out of memory");
    return -1;
}

/* Every frame but the first, which stays. */
static int play_later(compiled *c, int i, char *error, size_t bytes)
{
    tool_options o = *c->options;
    scene s;
    settings set;
    fixed_scene f;
    o.frame = c->first_frame + i;
    o.posed = true;
    if (tool_load_with(&o, o.sets, o.n_sets, &s, &set, error, bytes)) return -1;
    int failed = quantise_scene_for(&f, &s, &set.quality, error, bytes);
    if (!failed) {
        failed = play_frame(c, &f, i, error, bytes);
        quantise_free(&f);
    }
    scene_free(&s);
    return failed;
}

/* All frames of the animation, or those that were requested. */
static int choose_frames(compiled *c, char *error, size_t bytes)
{
    const tool_options *o = c->options;
    double last = ceil(c->scene.duration * c->scene.fps - 1e-6);
    c->first_frame = o->frame;
    c->n_frames = 1;
    if (o->last_frame >= 0) {
        c->n_frames = o->last_frame - o->frame + 1;
    } else if (o->frame < last) {
        c->n_frames = last - o->frame < COMPILE_FRAMES_MAX ? (int)last - o->frame + 1 : COMPILE_FRAMES_MAX + 1;
    }
    if (c->n_frames <= COMPILE_FRAMES_MAX) return 0;
    snprintf(error, bytes, "%g frames are more than %d: choose some with --frames FIRST-LAST", last,
             (int)COMPILE_FRAMES_MAX);
    return -1;
}

static int name_all(compiled *c)
{
    const scene *s = &c->scene;
    c->object_name = malloc((s->n_objects + 1) * sizeof *c->object_name);
    c->light_name = malloc((s->n_lights + 1) * sizeof *c->light_name);
    c->mesh_name = malloc((s->n_meshes + 1) * sizeof *c->mesh_name);
    c->texture_name = malloc((s->n_textures + 1) * sizeof *c->texture_name);
    if (!c->object_name || !c->light_name || !c->mesh_name || !c->texture_name) return -1;
    for (size_t i = 0; i < s->n_objects; i++) c->object_name[i] = s->objects[i].name;
    for (size_t i = 0; i < s->n_lights; i++) c->light_name[i] = s->lights[i].name;
    for (size_t i = 0; i < s->n_meshes; i++) c->mesh_name[i] = s->meshes[i].name;
    for (size_t i = 0; i < s->n_textures; i++) c->texture_name[i] = s->textures[i].name;
    c->n_textures = s->n_textures;
    return 0;
}

int compile_play(compiled *c, const tool_options *o, char *error, size_t error_bytes)
{
    *c = (compiled){.options = o};
    if (tool_load_with(o, o->sets, o->n_sets, &c->scene, &c->set, error, error_bytes)) return -1;
    c->requested = c->set;
    if (o->asset) c->scene.extent = rig_extent(&c->scene);
    if (choose_frames(c, error, error_bytes) ||
        quantise_scene_for(&c->fixed, &c->scene, &c->set.quality, error, error_bytes)) {
        scene_free(&c->scene);
        return -1;
    }
    compile_progress progress = {.doing = "loading"};
    int failed = name_all(c);
    if (failed) snprintf(error, error_bytes, "out of memory");
    for (int i = 1; !failed && i < c->n_frames; i++) {
        compile_tick(&progress, i, c->n_frames);
        failed = play_later(c, i, error, error_bytes);
    }
    compile_tick_end(&progress);
    if (failed) compile_free(c);
    return failed;
}

size_t compile_count_skins(const compiled *c, size_t n_objects)
{
    size_t n = 0;
    for (size_t i = 0; i < n_objects; i++) n += c->fixed.objects[i].skin != NULL;
    return n;
}

bool compile_moves(const compiled *c, compile_owner of)
{
    for (size_t i = 0; i < c->n_tracks; i++)
        if (c->tracks[i].field->of == of) return true;
    return false;
}

void compile_free(compiled *c)
{
    for (size_t i = 0; i < c->n_tracks; i++) free(c->tracks[i].words);
    free(c->tracks);
    free(c->object_name);
    free(c->light_name);
    free(c->mesh_name);
    free(c->texture_name);
    free(c->cameras);
    free(c->camera_name);
    free(c->clip_name);
    rig_free(c->rig);
    free(c->run.hash);
    quantise_free(&c->fixed);
    scene_free(&c->scene);
    *c = (compiled){0};
}
