/* The demo scene with a light of each kind and an object with texture and masks, so that every field is asked for. */
#ifndef GNOMON_TESTS_FULL_SCENE_H
#define GNOMON_TESTS_FULL_SCENE_H

#include <string.h>

#include "demo_scene.h"

static demo_scene demo;
static struct {
    gn_light light[3];
    gn_texture texture, mask;
    int16_t uv[2 * DEMO_BALL_VERTICES];
    uint16_t mask_uv[2 * DEMO_BALL_VERTICES];
    uint8_t rgba[4 * 4 * 2];
} full;

enum { FULL_DIRECTIONAL, FULL_SPOT, FULL_POINT, FULL_OBJECT = 1 };

static inline void full_lights(void)
{
    for (int i = 0; i < 3; i++) {
        gn_light *l = &full.light[i];
        *l = demo.light[0];
        l->kind = (gn_light_kind)i;
        l->position_q16[1] = GN_Q16(3);
        l->near_q16 = GN_Q16(0.05);
        l->inner_turn = GN_TURN(30);
        l->outer_turn = GN_TURN(60);
        l->mask_channel = -1;
    }
    demo.scene.lights = full.light;
    demo.scene.n_lights = 3;
}

static inline void full_scene(void)
{
    demo_scene_make(&demo, 1);
    memset(&full, 0, sizeof full);
    gn_texture texture = {.rgba = full.rgba, .width_log2 = 2, .height_log2 = 1};
    gn_object *o = &demo.object[FULL_OBJECT];
    full.texture = full.mask = texture;
    full_lights();
    demo.ball.uv = full.uv;
    demo.ball.uv_frac_bits = 15;
    demo.ball.mask_uv_uq16 = full.mask_uv;
    o->texture = &full.texture;
    o->mask_image = &full.mask;
    demo.scene.shadow.mixing = GN_MIXING_DISTANCE;
    demo.scene.shadow.disk_samples = 16;
    demo.scene.shadow.filter = demo.scene.shadow.other_filter = GN_FILTER_DISK;
}

#endif
