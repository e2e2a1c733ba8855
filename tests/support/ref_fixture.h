/* Scenes built by hand for the tests of the reference engine, without the loaders. */
#ifndef GNOMON_TESTS_REF_FIXTURE_H
#define GNOMON_TESTS_REF_FIXTURE_H

#include "check.h"
#include "../host/ref/ref.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI        3.14159265358979323846
#define MAX_PARTS 16

typedef struct {
    scene s;
    scene_mesh meshes[MAX_PARTS];
    scene_object objects[MAX_PARTS];
    scene_light lights[REF_MAX_LIGHTS + 1];
    scene_texture textures[2];
} fixture;

static char no_name[] = "";

/* ---- scenes ---- */

static inline scene_affine identity(void)
{
    return (scene_affine){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

static inline void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void normalise(double a[3])
{
    const double length = sqrt(dot(a, a));
    for (int i = 0; i < 3; i++) a[i] /= length;
}

static inline void look(fixture *f, const double from[3], const double at[3], const double up_hint[3])
{
    double forward[3], right[3], up[3];
    for (int i = 0; i < 3; i++) forward[i] = at[i] - from[i];
    normalise(forward);
    cross(right, forward, up_hint);
    normalise(right);
    cross(up, right, forward);
    for (int i = 0; i < 3; i++) {
        double *row = f->s.camera.to_world.m[i];
        row[0] = right[i];
        row[1] = up[i];
        row[2] = -forward[i];
        row[3] = from[i];
    }
}

/* Camera at the origin looking along -Z, white ambient 0, hard filter, no lights. */
static inline void begin(fixture *f)
{
    memset(f, 0, sizeof *f);
    f->s.meshes = f->meshes;
    f->s.objects = f->objects;
    f->s.lights = f->lights;
    f->s.textures = f->textures;
    f->s.camera = (scene_camera){.to_world = identity(), .focal = 1.0, .near = 0.1, .far = HUGE_VAL};
    f->s.shadow = (scene_shadow){.max_distance = 100,
                                 .distance_fade = 0.1,
                                 .cascade_fade = 0.1,
                                 .filter = SCENE_FILTER_HARD,
                                 .n_cascades = 1,
                                 .cascade_ratio = {1, 1, 1}};
}

static inline void end(fixture *f)
{
    for (size_t i = 0; i < f->s.n_meshes; i++) {
        free(f->meshes[i].pos);
        free(f->meshes[i].nrm);
        free(f->meshes[i].rgb);
        free(f->meshes[i].uv);
        free(f->meshes[i].mask_uv);
        free(f->meshes[i].joint);
        free(f->meshes[i].weight);
        free(f->meshes[i].idx);
    }
    for (size_t i = 0; i < f->s.n_objects; i++) {
        free(f->objects[i].mask);
        free(f->objects[i].baked);
        free(f->objects[i].joints);
    }
}

static inline double *copy(const double *values, size_t n)
{
    double *out = malloc(n * sizeof *out);
    if (!out) abort();
    memcpy(out, values, n * sizeof *out);
    return out;
}

/* A mesh and a white object that casts and receives. */
static inline scene_mesh *add_mesh(fixture *f, size_t n_vertices, const double *pos, size_t n_triangles,
                                   const uint32_t *idx)
{
    scene_mesh *mesh = &f->meshes[f->s.n_meshes];
    *mesh = (scene_mesh){.name = no_name, .n_vertices = n_vertices, .n_triangles = n_triangles};
    mesh->pos = copy(pos, 3 * n_vertices);
    mesh->idx = malloc(3 * n_triangles * sizeof *mesh->idx);
    if (!mesh->idx) abort();
    memcpy(mesh->idx, idx, 3 * n_triangles * sizeof *mesh->idx);
    f->objects[f->s.n_objects++] = (scene_object){.name = no_name,
                                                  .mesh_idx = f->s.n_meshes++,
                                                  .to_world = identity(),
                                                  .albedo = {1, 1, 1},
                                                  .alpha = 1,
                                                  .alpha_cutoff = 0.5,
                                                  .texture_idx = SCENE_NONE,
                                                  .emissive_texture_idx = SCENE_NONE,
                                                  .mask_texture_idx = SCENE_NONE,
                                                  .caster = SCENE_CASTER_ON,
                                                  .receives = true};
    return mesh;
}

/* Corners in counter-clockwise order. */
static inline scene_mesh *add_quad(fixture *f, const double corners[12])
{
    static const uint32_t idx[6] = {0, 1, 2, 0, 2, 3};
    return add_mesh(f, 4, corners, 2, idx);
}

/* y = height, facing up. */
static inline scene_mesh *add_floor(fixture *f, double half, double height)
{
    const double corners[12] = {-half, height, half, half, height, half, half, height, -half, -half, height, -half};
    return add_quad(f, corners);
}

static inline void add_box(fixture *f, const double low[3], const double high[3])
{
    static const uint32_t idx[36] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                     2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    double pos[24];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++) pos[3 * i + k] = (i >> k) & 1 ? high[k] : low[k];
    add_mesh(f, 8, pos, 12, idx);
}

static inline scene_light *add_light(fixture *f, double x, double y, double z)
{
    scene_light *light = &f->lights[f->s.n_lights++];
    *light = (scene_light){
        .name = no_name, .direction = {x, y, z}, .colour = {1, 1, 1}, .shadow = true, .strength = 1, .bias_normal = 1};
    normalise(light->direction);
    return light;
}

/* Lights of unlimited range and without biases. */
static inline scene_light *add_point(fixture *f, double x, double y, double z)
{
    scene_light *light = &f->lights[f->s.n_lights++];
    *light = (scene_light){.name = no_name,
                           .kind = SCENE_LIGHT_POINT,
                           .direction = {0, -1, 0},
                           .position = {x, y, z},
                           .range = HUGE_VAL,
                           .colour = {1, 1, 1},
                           .mask_channel = -1,
                           .shadow = true,
                           .strength = 1,
                           .near = 0.05};
    return light;
}

static inline scene_light *add_spot(fixture *f, const double from[3], const double at[3], double degrees)
{
    scene_light *light = add_point(f, from[0], from[1], from[2]);
    light->kind = SCENE_LIGHT_SPOT;
    light->inner = light->outer = degrees / 360;
    for (int k = 0; k < 3; k++) light->direction[k] = at[k] - from[k];
    normalise(light->direction);
    return light;
}

static inline ref_picture render_with(const fixture *f, const ref_options *options)
{
    ref_picture p;
    char error[200] = "";
    const int status = ref_render(&p, &f->s, options, error, sizeof error);
    if (status) fprintf(stderr, "%s\n", error);
    CHECK_EQ_INT(status, 0);
    if (status) abort();
    return p;
}

static inline ref_picture render(const fixture *f, int width, int height, int atlas_size)
{
    const ref_options options = {.width = width, .height = height, .atlas_size = atlas_size, .srgb = false};
    return render_with(f, &options);
}

/* The world point that a pixel shows, from its depth. */
static inline void world_at(double out[3], const fixture *f, const ref_picture *p, int i, int j)
{
    const double z = p->depth[j * p->width + i], flat = f->s.camera.half_height;
    const double per_px = (flat > 0 ? flat : z / f->s.camera.focal) / (p->height / 2.0);
    const double x = (i + 0.5 - p->width / 2.0) * per_px, y = (p->height / 2.0 - j - 0.5) * per_px;
    for (int k = 0; k < 3; k++) {
        const double *row = f->s.camera.to_world.m[k];
        out[k] = row[0] * x + row[1] * y - row[2] * z + row[3];
    }
}

/* Uniform in 0..1, xorshift64*. */
static inline double random_unit(void)
{
    static uint64_t state = 88172645463325252u;
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (double)((state * 2685821657736338717u) >> 11) / 9007199254740992.0;
}

static inline double random_between(double low, double high)
{
    return low + (high - low) * random_unit();
}

static inline double random_log(double low, double high)
{
    return low * pow(high / low, random_unit());
}

static inline void random_direction(double out[3])
{
    do {
        for (int k = 0; k < 3; k++) out[k] = random_between(-1, 1);
    } while (dot(out, out) > 1 || dot(out, out) < 1e-6);
    normalise(out);
}

#endif
