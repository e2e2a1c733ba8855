/* Scenes with lights of every kind, built in C: a ground, boxes, balls and a card with holes, and random lights among
 * them. */
#ifndef GNOMON_TESTS_LIGHT_SCENE_H
#define GNOMON_TESTS_LIGHT_SCENE_H

#include <string.h>

#include "demo_scene.h"
#include "gnomon.h"
#include "rng.h"

enum { LS_OBJECTS_MAX = 24, LS_LIGHTS_MAX = 40, LS_CARD_SIDE = 8 };

typedef struct {
    demo_scene demo; /* its meshes */
    gn_mesh card;
    gn_texture holes;
    uint8_t texel[LS_CARD_SIDE * LS_CARD_SIDE * 4];
    gn_object object[LS_OBJECTS_MAX];
    gn_light light[LS_LIGHTS_MAX];
    gn_scene scene;
} light_scene;

static const int32_t ls_card_pos[4 * 3] = {GN_Q16(-1), GN_Q16(-1), 0, GN_Q16(1),  GN_Q16(-1), 0,
                                           GN_Q16(1),  GN_Q16(1),  0, GN_Q16(-1), GN_Q16(1),  0};
static const int16_t ls_card_uv[4 * 2] = {0, 256, 256, 256, 256, 0, 0, 0};
static const uint16_t ls_card_idx[2 * 3] = {0, 1, 2, 0, 2, 3};

static inline int32_t ls_q16(rng *r, double lo, double hi)
{
    return rng_range(r, GN_Q16(lo), GN_Q16(hi));
}

static inline gn_object *ls_add_object(light_scene *s, const gn_mesh *mesh)
{
    gn_object *o = &s->object[s->scene.n_objects++];
    memset(o, 0, sizeof *o);
    o->mesh = mesh;
    o->flags = GN_OBJECT_DEFAULT;
    o->alpha_uq16 = 65536;
    o->alpha_cutoff_uq16 = 32768;
    for (int k = 0; k < 3; k++) o->albedo_uq16[k] = 30000U + 9000U * (uint32_t)k;
    gn_affine_identity(&o->to_world);
    return o;
}

static inline void ls_place(gn_object *o, int32_t x_q16, int32_t y_q16, int32_t z_q16, uint16_t yaw, uint16_t pitch,
                            double scale)
{
    gn_affine_rotation(&o->to_world, yaw, pitch, 0);
    gn_affine_scale(&o->to_world, GN_Q16(scale));
    o->to_world.t_q16[0] = x_q16;
    o->to_world.t_q16[1] = y_q16;
    o->to_world.t_q16[2] = z_q16;
}

static inline gn_light *ls_add_light(light_scene *s, gn_light_kind kind)
{
    gn_light light = {.kind = kind,
                      .direction = {GN_Q16(0.4), GN_Q16(-1), GN_Q16(-0.3)},
                      .position_q16 = {0, GN_Q16(3), 0},
                      .colour_uq16 = {GN_UQ16(0.6), GN_UQ16(0.5), GN_UQ16(0.4)},
                      .colour_exp = kind == GN_LIGHT_DIRECTIONAL ? 0 : 3,
                      .range_q16 = kind == GN_LIGHT_DIRECTIONAL ? 0 : GN_UQ16(12),
                      .near_q16 = GN_Q16(0.1),
                      .inner_turn = GN_TURN(50),
                      .outer_turn = GN_TURN(80),
                      .shadow_strength_uq16 = 65536,
                      .mask_channel = -1,
                      .bias_normal_q16 = GN_Q16(1)};
    s->light[s->scene.n_lights] = light;
    return &s->light[s->scene.n_lights++];
}

/* Somewhere above the ground, shining downwards. */
static inline gn_light *ls_add_random_light(light_scene *s, rng *r, gn_light_kind kind)
{
    gn_light *light = ls_add_light(s, kind);
    light->direction[0] = ls_q16(r, -0.8, 0.8);
    light->direction[2] = ls_q16(r, -0.8, 0.8);
    for (int k = 0; k < 3; k++) light->colour_uq16[k] = rng_below(r, 60000) + 5000;
    light->position_q16[0] = ls_q16(r, -4, 4);
    light->position_q16[1] = ls_q16(r, 1.5, 4);
    light->position_q16[2] = ls_q16(r, -4, 4);
    light->outer_turn = (uint16_t)rng_range(r, GN_TURN(50), GN_TURN(110));
    light->inner_turn = (uint16_t)(light->outer_turn / 2);
    return light;
}

static inline void ls_look(light_scene *s, int32_t x_q16, int32_t y_q16, int32_t z_q16)
{
    static const int32_t target_q16[3] = {0, GN_Q16(0.8), 0};
    const int32_t eye_q16[3] = {x_q16, y_q16, z_q16};
    gn_camera_look_at(&s->scene.camera.to_world, eye_q16, target_q16);
}

static inline void ls_card(light_scene *s)
{
    for (int i = 0; i < LS_CARD_SIDE * LS_CARD_SIDE; i++) {
        uint8_t *t = &s->texel[4 * i];
        t[0] = (uint8_t)(90 + i), t[1] = 200, t[2] = (uint8_t)(250 - i);
        t[3] = (i ^ i / LS_CARD_SIDE) & 1 ? 255 : 40;
    }
    gn_texture holes = {.rgba = s->texel, .width_log2 = 3, .height_log2 = 3};
    gn_mesh card = {.pos = ls_card_pos,
                    .uv = ls_card_uv,
                    .idx = ls_card_idx,
                    .n_vertices = 4,
                    .n_triangles = 2,
                    .pos_frac_bits = 16,
                    .uv_frac_bits = 8};
    s->holes = holes;
    s->card = card;
}

/* Ground, box, ball and a card cut by its texture; no lights. */
static inline void ls_begin(light_scene *s)
{
    memset(s, 0, sizeof *s);
    demo_scene_make(&s->demo, 1);
    ls_card(s);
    s->scene = s->demo.scene;
    s->scene.objects = s->object;
    s->scene.lights = s->light;
    s->scene.n_objects = s->scene.n_lights = 0;
    s->scene.shadow.disk_samples = 8;
    s->scene.shadow.penumbra_uq16 = 65536;
    s->scene.shadow.object_lights = 8;
    ls_add_object(s, &s->demo.ground);
    ls_place(ls_add_object(s, &s->demo.box), GN_Q16(-1.3), GN_Q16(1.1), 0, 9000, 3000, 1);
    ls_place(ls_add_object(s, &s->demo.ball), GN_Q16(1.2), GN_Q16(1.2), GN_Q16(0.3), 0, 0, 0.9);
    gn_object *card = ls_add_object(s, &s->card);
    ls_place(card, GN_Q16(0.2), GN_Q16(1.2), GN_Q16(1.9), 3000, 0, 0.7);
    card->texture = &s->holes;
    card->flags |= GN_OBJECT_TWO_SIDED;
    card->visible_alpha = card->caster_alpha = GN_ALPHA_CLIP;
}

/* More boxes and balls at random. */
static inline void ls_add_random_objects(light_scene *s, rng *r, uint32_t n)
{
    for (; n > 0; n--) {
        gn_object *o = ls_add_object(s, n & 1 ? &s->demo.box : &s->demo.ball);
        /* one after the other: the order of arguments is the compiler's choice */
        const uint16_t pitch = (uint16_t)rng_u32(r), yaw = (uint16_t)rng_u32(r);
        const int32_t z_q16 = ls_q16(r, -5, 5), y_q16 = ls_q16(r, 0.3, 2), x_q16 = ls_q16(r, -5, 5);
        ls_place(o, x_q16, y_q16, z_q16, yaw, pitch, 0.4);
    }
}

/* Pixels of a whole picture, of 1 to 4 bytes each. */
typedef struct {
    uint8_t *bytes;
    size_t width, pixel_bytes;
} ls_canvas;

static inline void ls_flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    ls_canvas *c = user;
    size_t row_bytes = (size_t)w * c->pixel_bytes;
    for (int row = 0; row < h; row++)
        memcpy(c->bytes + ((size_t)(y + row) * c->width + (size_t)x) * c->pixel_bytes,
               (const uint8_t *)pixels + (size_t)row * row_bytes, row_bytes);
}

/* Everything of a frame up to gn_prepare. */
static inline gn_status ls_prepare(gn_renderer *renderer, const gn_scene *from)
{
    gn_status status = gn_begin(renderer, from);
    for (uint32_t i = 0; !status && i < gn_shadow_tile_count(renderer); i++) status = gn_shadow_tile(renderer, i);
    return status ? status : gn_prepare(renderer);
}

static inline gn_status ls_screen(gn_renderer *renderer, void *pixels, size_t pixel_bytes)
{
    ls_canvas out = {pixels, renderer->frame.picture.width, pixel_bytes};
    gn_status status = GN_OK;
    for (uint32_t i = 0; !status && i < gn_screen_tile_count(renderer); i++)
        status = gn_screen_tile(&renderer->frame, &renderer->scratch, i, ls_flush, &out);
    return status;
}

static inline size_t ls_tile_bytes(const gn_tile_info *tile)
{
    return (size_t)tile->texels * tile->rows * tile->depth_bits / 8;
}

#endif
