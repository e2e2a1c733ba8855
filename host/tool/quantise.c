/* A scene in double precision to the library's fixed-point scene. */
#include "quantise.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Everything must stay within +-8192 units of the origin and 16384 of the camera; half of that leaves room for both. */
#define WORLD_REACH 4096.0

_Static_assert((int)GN_FILTER_7X7 == (int)SCENE_FILTER_7X7 && (int)GN_BLEND_DITHER == (int)SCENE_BLEND_DITHER &&
                   (int)GN_BLEND_SOFT == (int)SCENE_BLEND_SOFT && (int)GN_DISTANCE_RADIUS == (int)SCENE_DISTANCE_RADIUS,
               "the scene's enumerations are the library's");

static int64_t fixed(double v, int bits)
{
    double scaled = floor(ldexp(v, bits) + 0.5);
    if (scaled > 2147483647.0) return INT32_MAX;
    if (scaled < -2147483648.0) return INT32_MIN;
    return (int64_t)scaled;
}

/* Q1.30, kept within +-1.0 */
static int32_t fixed_unit(double v, int bits)
{
    int64_t f = fixed(v, bits);
    return (int32_t)(f > 1 << 30 ? 1 << 30 : f < -(1 << 30) ? -(1 << 30) : f);
}

static double reach_of_object(const scene *s, const scene_object *o)
{
    const scene_mesh *mesh = &s->meshes[o->mesh_idx];
    double reach = 0;
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        const double *p = mesh->pos + 3 * i;
        for (int r = 0; r < 3; r++) {
            const double *m = o->to_world.m[r];
            reach = fmax(reach, fabs(m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3]));
        }
    }
    for (int r = 0; r < 3; r++) reach = fmax(reach, fabs(o->to_world.m[r][3]));
    return reach;
}

static int choose_world_exp(const scene *s)
{
    double reach = fmax(s->shadow.max_distance, s->camera.near);
    for (size_t i = 0; i < s->n_objects; i++) reach = fmax(reach, reach_of_object(s, &s->objects[i]));
    for (int r = 0; r < 3; r++) reach = fmax(reach, fabs(s->camera.to_world.m[r][3]));
    for (size_t i = 0; i < s->n_lights; i++) reach = fmax(reach, s->lights[i].near_offset);
    int e;
    frexp(reach / WORLD_REACH, &e);
    return -e;
}

/* The largest number of fraction bits that keeps every coordinate of the mesh within 2^30. */
static int position_bits(const scene_mesh *mesh)
{
    double largest = 0;
    int e;
    for (size_t i = 0; i < 3 * mesh->n_vertices; i++) largest = fmax(largest, fabs(mesh->pos[i]));
    frexp(largest, &e);
    return largest > 0 ? 30 - e : 30;
}

static int quantise_mesh(gn_mesh *out, const scene_mesh *mesh, int bits, char *error, size_t error_bytes)
{
    size_t n = 3 * mesh->n_vertices, n_idx = 3 * mesh->n_triangles;
    if (mesh->n_vertices > 65535 || mesh->n_triangles > 65535) {
        snprintf(error, error_bytes, "mesh '%s': more than 65535 vertices or triangles", mesh->name);
        return -1;
    }
    int32_t *pos = malloc(n * sizeof *pos);
    int16_t *nrm = mesh->nrm ? malloc(n * sizeof *nrm) : NULL;
    uint16_t *rgb = mesh->rgb ? malloc(n * sizeof *rgb) : NULL, *idx = malloc(n_idx * sizeof *idx);
    out->pos = pos;
    out->nrm_q15 = nrm;
    out->rgb_uq16 = rgb;
    out->idx = idx;
    if (!pos || !idx || (mesh->nrm && !nrm) || (mesh->rgb && !rgb)) {
        snprintf(error, error_bytes, "out of memory");
        return -1;
    }
    for (size_t i = 0; i < n; i++) {
        pos[i] = (int32_t)fmax(-1073741824.0, fmin(1073741824.0, floor(ldexp(mesh->pos[i], bits) + 0.5)));
        if (nrm) nrm[i] = (int16_t)floor(mesh->nrm[i] * 32767.0 + 0.5);
        if (rgb) rgb[i] = (uint16_t)floor(fmax(0, fmin(1, mesh->rgb[i])) * 65535.0 + 0.5);
    }
    for (size_t i = 0; i < n_idx; i++) idx[i] = (uint16_t)mesh->idx[i];
    out->n_vertices = (uint16_t)mesh->n_vertices;
    out->n_triangles = (uint16_t)mesh->n_triangles;
    return 0;
}

/* Matrix entries become a Q1.30 mantissa under one exponent. A mesh's fraction bits beyond 0..30 move into that exponent. */
static int quantise_object(gn_object *out, const scene_object *o, const gn_mesh *mesh, int mesh_bits, int world_exp, char *error,
                           size_t error_bytes)
{
    double largest = 0;
    int e;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) largest = fmax(largest, fabs(o->to_world.m[r][c]));
    frexp(largest, &e);
    int shift = world_exp + (int)mesh->pos_frac_bits - mesh_bits; /* object space as stored = true * 2^(mesh_bits - pos_frac) */
    int exp = e + shift < 0 ? 0 : e + shift;
    if (exp > 14) {
        snprintf(error, error_bytes, "object '%s': scale too large", o->name);
        return -1;
    }
    out->mesh = mesh;
    out->to_world.exp = exp;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) out->to_world.m_q30[r][c] = fixed_unit(o->to_world.m[r][c], 30 + shift - exp);
        out->to_world.t_q16[r] = (int32_t)fixed(o->to_world.m[r][3], 16 + world_exp);
        out->albedo_uq16[r] = (uint32_t)fixed(fmax(0, fmin(1, o->albedo[r])), 16);
    }
    out->flags = (o->caster != SCENE_CASTER_OFF ? GN_OBJECT_CASTS : 0U) | (o->receives ? GN_OBJECT_RECEIVES : 0U) |
                 (o->two_sided ? GN_OBJECT_TWO_SIDED : 0U) | (o->unlit ? GN_OBJECT_UNLIT : 0U);
    return 0;
}

static void quantise_light(gn_light *out, const scene_light *l, int world_exp)
{
    out->kind = GN_LIGHT_DIRECTIONAL;
    for (int i = 0; i < 3; i++) {
        out->direction[i] = (int32_t)fixed(l->direction[i], 30);
        out->colour_uq16[i] = (uint32_t)fixed(fmin(l->colour[i], 255.99), 16);
    }
    out->shadow_strength_uq16 = l->shadow ? (uint32_t)fixed(l->strength, 16) : 0;
    out->bias_constant_q16 = (int32_t)fixed(l->bias_constant, 16);
    out->bias_slope_q16 = (int32_t)fixed(l->bias_slope, 16);
    out->bias_normal_q16 = (int32_t)fixed(l->bias_normal, 16);
    out->near_offset_q16 = (int32_t)fixed(l->near_offset, 16 + world_exp);
}

static void quantise_view(gn_scene *out, const scene *s, int world_exp)
{
    const scene_camera *camera = &s->camera;
    out->camera.to_world.exp = 0;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) out->camera.to_world.m_q30[r][c] = fixed_unit(camera->to_world.m[r][c], 30);
        out->camera.to_world.t_q16[r] = (int32_t)fixed(camera->to_world.m[r][3], 16 + world_exp);
        out->ambient_uq16[r] = (uint32_t)fixed(fmin(s->ambient[r], 255.99), 16);
        out->background_uq16[r] = (uint32_t)fixed(s->background[r], 16);
    }
    out->camera.focal_q24 = (uint32_t)fmin(4294967295.0, floor(ldexp(camera->focal, 24) + 0.5));
    out->camera.near_q16 = (int32_t)fixed(camera->near, 16 + world_exp);
    out->camera.far_q16 = isinf(camera->far) ? INT32_MAX : (int32_t)fixed(camera->far, 16 + world_exp);
    out->shadow.max_distance_q16 = (int32_t)fixed(s->shadow.max_distance, 16 + world_exp);
    out->shadow.distance_fade_uq16 = (uint32_t)fixed(s->shadow.distance_fade, 16);
    out->shadow.cascade_fade_uq16 = (uint32_t)fixed(s->shadow.cascade_fade, 16);
    out->shadow.filter = (gn_filter)s->shadow.filter;
    out->shadow.n_cascades = (uint32_t)s->shadow.n_cascades;
    for (int i = 0; i < 3; i++) out->shadow.cascade_ratio_uq16[i] = (uint32_t)fixed(s->shadow.cascade_ratio[i], 16);
    out->shadow.blend = (gn_blend)s->shadow.blend;
    out->shadow.distance_mode = (gn_distance_mode)s->shadow.distance_mode;
}

int quantise_scene(fixed_scene *out, const scene *s, char *error, size_t error_bytes)
{
    memset(out, 0, sizeof *out);
    out->world_exp = choose_world_exp(s);
    out->n_meshes = s->n_meshes;
    out->meshes = calloc(s->n_meshes + 1, sizeof *out->meshes);
    out->objects = calloc(s->n_objects + 1, sizeof *out->objects);
    out->lights = calloc(s->n_lights + 1, sizeof *out->lights);
    int *bits = calloc(s->n_meshes + 1, sizeof *bits);
    int failed = !out->meshes || !out->objects || !out->lights || !bits;
    if (failed) snprintf(error, error_bytes, "out of memory");
    out->scene.n_objects = (uint32_t)s->n_objects;
    out->scene.n_lights = (uint32_t)s->n_lights;
    for (size_t i = 0; !failed && i < s->n_meshes; i++) {
        bits[i] = position_bits(&s->meshes[i]);
        out->meshes[i].pos_frac_bits = (uint8_t)(bits[i] < 0 ? 0 : bits[i] > 30 ? 30 : bits[i]);
        failed = quantise_mesh(&out->meshes[i], &s->meshes[i], bits[i], error, error_bytes);
    }
    for (size_t i = 0; !failed && i < s->n_objects; i++) {
        size_t mesh = s->objects[i].mesh_idx;
        failed =
            quantise_object(&out->objects[i], &s->objects[i], &out->meshes[mesh], bits[mesh], out->world_exp, error, error_bytes);
    }
    if (!failed) {
        for (size_t i = 0; i < s->n_lights; i++) quantise_light(&out->lights[i], &s->lights[i], out->world_exp);
        quantise_view(&out->scene, s, out->world_exp);
        out->scene.objects = out->objects;
        out->scene.lights = out->lights;
    }
    free(bits);
    if (failed) quantise_free(out);
    return failed ? -1 : 0;
}

void quantise_free(fixed_scene *f)
{
    for (size_t i = 0; f->meshes && i < f->n_meshes; i++) {
        free((void *)(uintptr_t)f->meshes[i].pos);
        free((void *)(uintptr_t)f->meshes[i].nrm_q15);
        free((void *)(uintptr_t)f->meshes[i].rgb_uq16);
        free((void *)(uintptr_t)f->meshes[i].idx);
    }
    free(f->meshes);
    free(f->objects);
    free(f->lights);
    memset(f, 0, sizeof *f);
}
