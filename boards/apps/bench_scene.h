/* The scene of the speed measurement, around a mesh: an object, one light from beside the camera, everything within its
 * shadows. The host's benchmark (tests/bench/bench_workload.c) and the boards' (bench.c) draw it. */
#ifndef GNOMON_BOARDS_BENCH_SCENE_H
#define GNOMON_BOARDS_BENCH_SCENE_H

#include <string.h>

#include "gnomon.h"

enum { BENCH_SCENE_WIDTH = 320, BENCH_SCENE_HEIGHT = 240, BENCH_SCENE_FOCAL_PX = 160 };

typedef struct {
    const char *name;
    int coloured; /* vertex colours, and vertex normals where light falls */
    int shadowed; /* one light; otherwise the object is unlit */
} bench_case;

static const bench_case bench_cases[] = {
    {"flat", 0, 0}, {"gouraud", 1, 0}, {"flat-shadow", 0, 1}, {"gouraud-shadow", 1, 1}};
enum { BENCH_N_CASES = sizeof bench_cases / sizeof *bench_cases };

typedef struct {
    gn_mesh mesh; /* set first */
    gn_object object;
    gn_light light;
    gn_scene scene;
} bench_scene;

static void bench_light(gn_light *light)
{
    static const int32_t direction[3] = {GN_Q16(0.4), GN_Q16(-0.3), GN_Q16(-1.0)};
    memcpy(light->direction, direction, sizeof direction);
    light->kind = GN_LIGHT_DIRECTIONAL;
    for (int i = 0; i < 3; i++) light->colour_uq16[i] = GN_UQ16(0.9);
    light->shadow_strength_uq16 = GN_UQ16(1.0);
    light->bias_constant_q16 = GN_Q16(0.5);
    light->bias_slope_q16 = GN_Q16(1.0);
    light->bias_normal_q16 = GN_Q16(1.0);
}

/* Without triangles: the empty picture. */
static void bench_build_scene(bench_scene *b, const bench_case *c)
{
    gn_scene *scene = &b->scene;
    bench_light(&b->light);
    b->object.mesh = &b->mesh;
    gn_affine_identity(&b->object.to_world);
    b->object.albedo_uq16[0] = GN_UQ16(0.8);
    b->object.albedo_uq16[1] = GN_UQ16(0.6);
    b->object.albedo_uq16[2] = GN_UQ16(0.3);
    b->object.flags = c->shadowed ? GN_OBJECT_DEFAULT : GN_OBJECT_UNLIT;
    scene->objects = &b->object;
    scene->n_objects = b->mesh.n_triangles > 0;
    scene->lights = &b->light;
    scene->n_lights = (uint32_t)c->shadowed;
    /* the deepest vertex lies at 14.6 units: the whole view has shadows, none of them faded */
    scene->shadow.max_distance_q16 = GN_Q16(16);
    scene->shadow.distance_fade_uq16 = GN_UQ16(1.0 / 16);
    scene->shadow.cascade_fade_uq16 = GN_UQ16(0.1);
    scene->shadow.filter = GN_FILTER_2X2;
    gn_affine_identity(&scene->camera.to_world);
    scene->camera.focal_q24 = GN_Q24(2.0 * BENCH_SCENE_FOCAL_PX / BENCH_SCENE_HEIGHT);
    scene->camera.near_q16 = GN_Q16(1);
    scene->camera.far_q16 = GN_Q16(32);
    for (int i = 0; i < 3; i++) scene->ambient_uq16[i] = GN_UQ16(0.1);
    scene->background_uq20[2] = GN_UQ20(0.1);
}

#endif
