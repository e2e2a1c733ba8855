/* One scene, built in C, that uses every feature of the library: a box and a ball above a ground, one light, vertex
 * normals and colours, smooth and flat faces, casters and receivers. `frame` moves camera, box and light. */
#ifndef GNOMON_TESTS_DEMO_SCENE_H
#define GNOMON_TESTS_DEMO_SCENE_H

#include <string.h>

#include "gnomon.h"

enum { DEMO_STACKS = 6, DEMO_SLICES = 10, DEMO_BALL_VERTICES = (DEMO_STACKS + 1) * DEMO_SLICES };
enum { DEMO_BALL_TRIANGLES = 2 * DEMO_STACKS * DEMO_SLICES, DEMO_OBJECTS = 3 };

typedef struct {
    int32_t box_pos[8 * 3], ball_pos[DEMO_BALL_VERTICES * 3];
    int16_t ball_nrm[DEMO_BALL_VERTICES * 3];
    uint16_t box_rgb[8 * 3], ball_rgb[DEMO_BALL_VERTICES * 3];
    uint16_t ball_idx[DEMO_BALL_TRIANGLES * 3];
    gn_mesh box, ball, ground;
    gn_object object[DEMO_OBJECTS];
    gn_light light[1];
    gn_scene scene;
} demo_scene;

static const int32_t demo_ground_pos[4 * 3] = {GN_Q16(-6), 0, GN_Q16(-6), GN_Q16(-6), 0, GN_Q16(6),
                                               GN_Q16(6),  0, GN_Q16(6),  GN_Q16(6),  0, GN_Q16(-6)};
static const uint16_t demo_ground_idx[2 * 3] = {0, 1, 2, 0, 2, 3};
static const uint16_t demo_box_idx[12 * 3] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                              2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

static inline void demo_box(demo_scene *d)
{
    for (int i = 0; i < 8; i++) { /* bit k of i: which side of axis k */
        for (int k = 0; k < 3; k++) {
            d->box_pos[3 * i + k] = i >> k & 1 ? GN_Q16(0.75) : GN_Q16(-0.75);
            d->box_rgb[3 * i + k] = i >> k & 1 ? 65535 : 9000;
        }
    }
    gn_mesh mesh = {.pos = d->box_pos,
                    .rgb_uq16 = d->box_rgb,
                    .idx = demo_box_idx,
                    .n_vertices = 8,
                    .n_triangles = 12,
                    .pos_frac_bits = 16};
    d->box = mesh;
}

static inline void demo_ball(demo_scene *d)
{
    uint16_t *idx = d->ball_idx;
    for (int s = 0; s <= DEMO_STACKS; s++) {
        for (int a = 0; a < DEMO_SLICES; a++) {
            int i = 3 * (s * DEMO_SLICES + a);
            uint16_t down = (uint16_t)(s * 32768 / DEMO_STACKS), around = (uint16_t)(a * 65536 / DEMO_SLICES);
            int32_t ring = gn_sin_q30(down) >> 15;
            int32_t unit[3] = {ring * (gn_cos_q30(around) >> 15), gn_cos_q30(down), -ring * (gn_sin_q30(around) >> 15)};
            for (int k = 0; k < 3; k++) {
                d->ball_pos[i + k] = unit[k]; /* radius 1, 30 fraction bits */
                d->ball_nrm[i + k] = (int16_t)((unit[k] - (unit[k] >> 15)) >> 15);
                d->ball_rgb[i + k] = (uint16_t)(20000 + 9000 * (s + a + k) % 45535);
            }
            if (s == DEMO_STACKS) continue;
            int right = (a + 1) % DEMO_SLICES;
            uint16_t quad[4] = {(uint16_t)(s * DEMO_SLICES + a), (uint16_t)((s + 1) * DEMO_SLICES + a),
                                (uint16_t)((s + 1) * DEMO_SLICES + right), (uint16_t)(s * DEMO_SLICES + right)};
            for (int k = 0; k < 6; k++) *idx++ = quad[k < 3 ? k : k == 3 ? 0 : k - 2];
        }
    }
    gn_mesh mesh = {.pos = d->ball_pos,
                    .nrm_q15 = d->ball_nrm,
                    .rgb_uq16 = d->ball_rgb,
                    .idx = d->ball_idx,
                    .n_vertices = DEMO_BALL_VERTICES,
                    .n_triangles = DEMO_BALL_TRIANGLES,
                    .pos_frac_bits = 30};
    d->ball = mesh;
}

static inline void demo_objects(demo_scene *d, uint32_t frame)
{
    gn_mesh ground = {
        .pos = demo_ground_pos, .idx = demo_ground_idx, .n_vertices = 4, .n_triangles = 2, .pos_frac_bits = 16};
    d->ground = ground;
    const gn_mesh *mesh[DEMO_OBJECTS] = {&d->box, &d->ball, &d->ground};
    for (int i = 0; i < DEMO_OBJECTS; i++) {
        gn_object *o = &d->object[i];
        o->mesh = mesh[i];
        o->flags = GN_OBJECT_DEFAULT;
        gn_affine_identity(&o->to_world);
        for (int k = 0; k < 3; k++) o->albedo_uq16[k] = i < 2 ? 60000U : 30000U + 8000U * (uint32_t)k;
    }
    gn_affine_rotation(&d->object[0].to_world, (uint16_t)(5000U + 3000U * frame), GN_TURN(20), GN_TURN(10));
    d->object[0].to_world.t_q16[0] = GN_Q16(-1.3);
    d->object[0].to_world.t_q16[1] = GN_Q16(1.4);
    d->object[1].to_world.t_q16[0] = GN_Q16(1.2);
    d->object[1].to_world.t_q16[1] = GN_Q16(1.25);
}

static inline void demo_scene_make(demo_scene *d, uint32_t frame)
{
    static const int32_t target_q16[3] = {0, GN_Q16(0.8), 0};
    const int32_t eye_q16[3] = {GN_Q16(2.5) - (int32_t)frame * GN_Q16(0.5), GN_Q16(3.5),
                                GN_Q16(6) - (int32_t)frame * GN_Q16(0.4)};
    memset(d, 0, sizeof *d);
    demo_box(d);
    demo_ball(d);
    demo_objects(d, frame);
    gn_light light = {.kind = GN_LIGHT_DIRECTIONAL,
                      .direction = {GN_Q16(0.5), GN_Q16(-1), GN_Q16(-0.3)},
                      .colour_uq16 = {GN_UQ16(0.9), GN_UQ16(0.85), GN_UQ16(0.7)},
                      .shadow_strength_uq16 = 65536,
                      .bias_normal_q16 = GN_Q16(1)};
    light.direction[0] += (int32_t)frame * GN_Q16(0.2);
    d->light[0] = light;
    gn_scene *s = &d->scene;
    s->objects = d->object;
    s->n_objects = DEMO_OBJECTS;
    s->lights = d->light;
    s->n_lights = 1;
    gn_camera_look_at(&s->camera.to_world, eye_q16, target_q16);
    s->camera.focal_q24 = GN_Q24(1.4);
    s->camera.near_q16 = GN_Q16(0.1);
    s->camera.far_q16 = GN_Q16(100);
    for (int k = 0; k < 3; k++) {
        s->ambient_uq16[k] = GN_UQ16(0.15);
        s->background_uq20[k] = 16 * (8000U + 6000U * (uint32_t)k);
    }
    s->shadow.max_distance_q16 = GN_Q16(20);
    s->shadow.distance_fade_uq16 = GN_UQ16(0.1);
    s->shadow.cascade_fade_uq16 = GN_UQ16(0.1);
    s->shadow.n_cascades = frame ? 4 : 1;
    s->shadow.cascade_ratio_uq16[0] = GN_UQ16(0.3);
    s->shadow.cascade_ratio_uq16[1] = GN_UQ16(0.4);
    s->shadow.cascade_ratio_uq16[2] = GN_UQ16(0.55);
    s->shadow.blend = GN_BLENDED_CASCADES ? GN_BLEND_SOFT : GN_BLEND_HARD;
    s->shadow.filter = GN_FILTER_MAX >= 2 ? GN_FILTER_3X3 : (gn_filter)GN_FILTER_MAX;
}

/* CRC-32 (the polynomial of zip); `crc` is 0 at the start. */
static inline uint32_t demo_crc32(uint32_t crc, const void *bytes, size_t n)
{
    const uint8_t *p = (const uint8_t *)bytes;
    for (crc = ~crc; n > 0; n--) {
        crc ^= *p++;
        for (int k = 0; k < 8; k++) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320U : 0);
    }
    return ~crc;
}

#endif
