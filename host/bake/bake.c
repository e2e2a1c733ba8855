/* Baking from scene to scene: lights get channels, objects masks; then nothing that stands still casts any more. */
#include "bake.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bake_internal.h"

/* ---- Lights ---- */

bool bake_ranges_meet(const scene_light *a, const scene_light *b)
{
    if (a->kind == SCENE_LIGHT_DIRECTIONAL || b->kind == SCENE_LIGHT_DIRECTIONAL) return true;
    double d[3];
    for (int i = 0; i < 3; i++) d[i] = a->position[i] - b->position[i];
    return hypot(hypot(d[0], d[1]), d[2]) < a->range + b->range;
}

static bool is_free(const scene *s, const int *channel, size_t light, int wanted)
{
    for (size_t i = 0; i < light; i++)
        if (channel[i] == wanted && bake_ranges_meet(&s->lights[i], &s->lights[light])) return false;
    return true;
}

void bake_assign(const scene *s, bake_fate fate[REF_MAX_LIGHTS], int channel[REF_MAX_LIGHTS])
{
    for (size_t l = 0; l < s->n_lights; l++) {
        const scene_light *light = &s->lights[l];
        channel[l] = -1;
        fate[l] = BAKE_UNSHADOWED;
        if (light->mode == SCENE_BAKED || !light->shadow || !(light->strength > 0)) continue;
        fate[l] = BAKE_WHOLE;
        for (int c = 0; c < BAKE_CHANNELS && channel[l] < 0; c++)
            if (is_free(s, channel, l, c)) channel[l] = c;
        if (channel[l] >= 0) fate[l] = BAKE_MASKED;
    }
}

/* ---- Objects ---- */

static bool receives(const scene_object *o)
{
    return o->receives && !o->unlit && !o->hidden;
}

static void choose_objects(baker *b)
{
    for (size_t i = 0; i < b->s->n_objects; i++) {
        scene_object *o = &b->s->objects[i];
        if (b->options->still) o->moving = false;
        const size_t n = b->s->meshes[o->mesh_idx].n_vertices;
        b->objects[i].wanted = receives(o) && !o->moving;
        b->result->n_objects += b->objects[i].wanted;
        b->result->n_moving += o->moving;
        b->result->casters_kept = b->result->casters_kept || (o->moving && receives(o));
        b->result->n_vertices_before += n;
        b->result->n_vertices += n;
    }
}

/* ---- Tracing ---- */

/* What moves is no part of what is baked. The options' tiles decide nothing here. */
static const char *begin(baker *b, ref_picture *picture, const ref_options *options, scene_caster *casters)
{
    for (size_t i = 0; i < b->s->n_objects; i++) {
        casters[i] = b->s->objects[i].caster;
        if (b->s->objects[i].moving) b->s->objects[i].caster = SCENE_CASTER_OFF;
    }
    const char *fault = ref_begin(&b->frame, picture, b->s, options);
    return fault ? fault : truth_begin(&b->tracer, &b->frame);
}

static int trace(baker *b, char *error, size_t bytes)
{
    snprintf(error, bytes, "out of memory");
    for (size_t i = 0; i < b->s->n_objects; i++)
        if (b->objects[i].wanted && bake_vertices(b, i)) return -1;
    return b->options->side ? bake_texels(b, error, bytes) : 0;
}

static int trace_all(baker *b, const ref_options *options, char *error, size_t bytes)
{
    ref_picture picture = {0};
    scene_caster *casters = calloc(b->s->n_objects + 1, sizeof *casters);
    if (!casters) return -1;
    const char *fault = begin(b, &picture, options, casters);
    const int failed = fault ? -1 : trace(b, error, bytes);
    if (fault) snprintf(error, bytes, "%s", fault);
    for (size_t i = 0; i < b->s->n_objects; i++) b->s->objects[i].caster = casters[i];
    truth_end(&b->tracer);
    ref_end(&b->frame);
    ref_free(&picture);
    free(casters);
    return failed;
}

/* ---- The new scene ---- */

/* n elements of so many numbers, each that of its source; NULL in, NULL out. */
static double *gather(const double *from, size_t width, const uint32_t *source, size_t n, bool *ok)
{
    if (!from) return NULL;
    double *out = malloc((width * n + 1) * sizeof *out);
    *ok = *ok && out;
    for (size_t i = 0; out && i < n; i++) memcpy(out + width * i, from + width * source[i], width * sizeof *out);
    return out;
}

static scene_mesh *add_mesh(scene *s)
{
    scene_mesh *grown = realloc(s->meshes, (s->n_meshes + 1) * sizeof *grown);
    if (!grown) return NULL;
    s->meshes = grown;
    s->meshes[s->n_meshes] = (scene_mesh){0};
    return &s->meshes[s->n_meshes++];
}

static bool set_mesh(scene *s, scene_object *o, bake_object *made)
{
    bool ok = true;
    scene_mesh *mesh = add_mesh(s);
    if (!mesh) return false;
    const scene_mesh *old = &s->meshes[o->mesh_idx];
    const size_t n = made->n_vertices;
    mesh->n_vertices = n;
    mesh->n_triangles = old->n_triangles;
    mesh->name = strdup(old->name);
    mesh->pos = gather(old->pos, 3, made->source, n, &ok);
    mesh->nrm = gather(old->nrm, 3, made->source, n, &ok);
    mesh->rgb = gather(old->rgb, 3, made->source, n, &ok);
    mesh->uv = gather(old->uv, 2, made->source, n, &ok);
    mesh->mask_uv = made->mask_uv;
    mesh->idx = made->idx;
    made->mask_uv = NULL;
    made->idx = NULL;
    if (made->baked) {
        double *baked = gather(made->baked, 3, made->source, n, &ok);
        free(made->baked);
        made->baked = baked;
    }
    o->mesh_idx = s->n_meshes - 1;
    return ok && mesh->name;
}

static bool add_image(baker *b)
{
    static const char name[] = "shadow masks";
    scene *s = b->s;
    scene_texture *grown = realloc(s->textures, (s->n_textures + 1) * sizeof *grown);
    char *copy = malloc(sizeof name);
    if (grown) s->textures = grown;
    if (!grown || !copy) {
        free(copy);
        return false;
    }
    memcpy(copy, name, sizeof name);
    s->textures[s->n_textures++] = (scene_texture){.name = copy,
                                                   .width = b->options->side,
                                                   .height = b->options->side,
                                                   .rgba = b->image,
                                                   .clamp_u = true,
                                                   .clamp_v = true,
                                                   .bilinear = true};
    b->image = NULL;
    return true;
}

static bool change_object(baker *b, size_t i)
{
    scene_object *o = &b->s->objects[i];
    bake_object *made = &b->objects[i];
    if (!o->moving && !b->result->casters_kept) o->caster = SCENE_CASTER_OFF;
    free(o->mask);
    o->mask = NULL;
    o->mask_texture_idx = SCENE_NONE;
    if (!made->wanted) return true;
    const size_t before = b->s->meshes[o->mesh_idx].n_vertices;
    if (made->lit) b->result->n_objects--;
    else if (b->options->side) {
        if (!set_mesh(b->s, o, made)) return false;
        o->mask_texture_idx = b->s->n_textures - 1;
        b->result->n_vertices += made->n_vertices - before;
        b->result->mask_bytes += 4 * made->n_vertices; /* two coordinates of 16 bits */
    } else {
        b->result->mask_bytes += 4 * before;
        o->mask = made->mask;
        made->mask = NULL;
    }
    free(o->baked);
    o->baked = made->baked;
    made->baked = NULL;
    return true;
}

static void change_lights(baker *b)
{
    for (size_t l = 0; l < b->s->n_lights; l++) {
        scene_light *light = &b->s->lights[l];
        light->mask_channel = b->channel[l];
        if (b->result->fate[l] == BAKE_MASKED) light->mode = SCENE_MIXED;
        if (b->result->fate[l] == BAKE_WHOLE) light->mode = SCENE_BAKED;
        if (b->channel[l] >= b->result->n_channels) b->result->n_channels = b->channel[l] + 1;
    }
}

static bool change_scene(baker *b)
{
    const size_t side = (size_t)b->options->side;
    change_lights(b);
    const size_t channels = (size_t)b->result->n_channels, texel_bytes = channels > 2 ? 4 : channels > 1 ? 2 : 1;
    if (side) b->result->mask_bytes = texel_bytes * side * side;
    if (side && !add_image(b)) return false;
    for (size_t i = 0; i < b->s->n_objects; i++)
        if (!change_object(b, i)) return false;
    b->s->shadow.mixing = SCENE_MIX_ALWAYS;
    return true;
}

static void free_objects(baker *b)
{
    for (size_t i = 0; b->objects && i < b->s->n_objects; i++) {
        bake_object *o = &b->objects[i];
        charts_free(&o->set);
        free(o->source);
        free(o->idx);
        free(o->mask_uv);
        free(o->mask);
        free(o->baked);
    }
    free(b->objects);
    free(b->image);
}

int bake_scene(scene *s, const ref_options *frame, const bake_options *options, bake_result *out, char *error,
               size_t error_bytes)
{
    baker b = {.s = s, .options = options, .result = out};
    memset(out, 0, sizeof *out);
    snprintf(error, error_bytes, "out of memory");
    b.objects = calloc(s->n_objects + 1, sizeof *b.objects);
    if (!b.objects) return -1;
    bake_assign(s, out->fate, b.channel);
    choose_objects(&b);
    int failed = trace_all(&b, frame, error, error_bytes);
    if (!failed && !change_scene(&b)) {
        snprintf(error, error_bytes, "out of memory");
        failed = -1;
    }
    free_objects(&b);
    return failed;
}
