/* Random scenes by compact arithmetic: a line with a CRC-32 for each, or with the status that refuses it. The same on
 * every machine. */
#include "crc32.h"

#include "board.h"
#include "gnomon.h"

enum { WIDTH = 64, HEIGHT = 48, FRAMES = 24, OBJECTS = 4 };

static gn_renderer renderer;

static const int32_t pos[] = {GN_Q16(-4), 0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4), 0,         GN_Q16(-4),
                              GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-1), 0, GN_Q16(1),  GN_Q16(1), 0,         GN_Q16(1),
                              GN_Q16(1),  0, GN_Q16(-1), GN_Q16(-1), 0, GN_Q16(-1), 0,         GN_Q16(2), 0};
static const uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3}, idx[] = {4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8};
static const gn_mesh ground = {.pos = pos, .idx = ground_idx, .n_vertices = 9, .n_triangles = 2, .pos_frac_bits = 15};
static const gn_mesh pyramid = {.pos = pos, .idx = idx, .n_vertices = 9, .n_triangles = 4, .pos_frac_bits = 16};

static gn_object objects[OBJECTS];
static gn_light sun;
static gn_scene scene = {.objects = objects, .n_objects = OBJECTS, .lights = &sun, .n_lights = 1};

static uint32_t state;

/* lo .. hi - 1 */
static int32_t between(int32_t lo, int32_t hi)
{
    state = state * 1664525U + 1013904223U;
    return lo + (int32_t)(((uint64_t)state * (uint32_t)(hi - lo)) >> 32);
}

static void make_objects(void)
{
    for (int i = 0; i < OBJECTS; i++) {
        gn_object *o = &objects[i];
        o->mesh = i ? &pyramid : &ground;
        o->flags = GN_OBJECT_DEFAULT;
        for (int k = 0; k < 3; k++) o->albedo_uq16[k] = (uint32_t)between(10000, 65536);
        gn_affine_identity(&o->to_world);
        if (!i) continue;
        uint16_t yaw = (uint16_t)between(0, 65536), pitch = (uint16_t)between(-9000, 9000);
        gn_affine_rotation(&o->to_world, yaw, pitch, 0);
        gn_affine_scale(&o->to_world, between(20000, 70000));
        for (int k = 0; k < 3; k++) o->to_world.t_q16[k] = k == 1 ? between(0, 60000) : between(-GN_Q16(3), GN_Q16(3));
        if (!between(0, 4)) o->flags |= GN_OBJECT_TWO_SIDED;
        if (!between(0, 8)) o->flags |= GN_OBJECT_UNLIT;
    }
}

static void make_light(void)
{
    for (int k = 0; k < 3; k++) {
        sun.direction[k] = k == 1 ? -1000 : between(-900, 900);
        sun.colour_uq16[k] = (uint32_t)between(30000, 70000);
        scene.ambient_uq16[k] = (uint32_t)between(2000, 12000);
        scene.background_uq20[k] = 16 * (uint32_t)between(0, 65536);
    }
    sun.shadow_strength_uq16 = GN_UQ16(1);
    sun.bias_normal_q16 = between(-GN_Q16(1), GN_Q16(2));
    if (sun.bias_normal_q16 < 0) sun.bias_normal_q16 = 0; /* automatic */
    sun.bias_constant_q16 = between(0, 65536);
    sun.bias_slope_q16 = between(0, 65536);
    sun.bias_caster_q16 = 0;
}

static void make_view(void)
{
    int32_t eye[3] = {between(-GN_Q16(4), GN_Q16(4)), between(GN_Q16(1), GN_Q16(5)), GN_Q16(6)};
    int32_t target[3] = {between(-GN_Q16(1), GN_Q16(1)), GN_Q16(0.5), between(-GN_Q16(1), GN_Q16(1))};
    gn_affine roll;
    gn_camera_look_at(&scene.camera.to_world, eye, target);
    gn_affine_rotation(&roll, 0, 0, (uint16_t)between(-4000, 4000));
    gn_affine_mul(&scene.camera.to_world, &scene.camera.to_world, &roll);
    scene.camera.focal_q24 = (uint32_t)between((int32_t)GN_Q24(1.2), (int32_t)GN_Q24(3));
    scene.camera.near_q16 = between(GN_Q16(0.25), GN_Q16(2));
    scene.camera.far_q16 = GN_Q16(100);
    scene.shadow.max_distance_q16 = between(GN_Q16(8), GN_Q16(30));
    scene.shadow.distance_fade_uq16 = (uint32_t)between(66, 30000);
    scene.shadow.cascade_fade_uq16 = (uint32_t)between(66, 30000);
    scene.shadow.filter = GN_FILTER_HARD;
}

/* Out of range. */
static void spoil(int how)
{
    if (how == 0) objects[1].to_world.t_q16[0] = GN_Q16(4097);
    if (how == 1) scene.camera.focal_q24 = GN_Q24(0.5);
    if (how == 2) scene.shadow.filter = GN_FILTER_2X2;
    if (how == 3) scene.shadow.max_distance_q16 = scene.camera.near_q16;
    if (how == 4) sun.bias_caster_q16 = 1;
    if (how == 5) sun.direction[0] = sun.direction[1] = sun.direction[2] = 0;
}

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    uint32_t *crc = user;
    (void)x, (void)y;
    *crc = crc32_add(*crc, pixels, 2U * (uint32_t)(w * h));
}

static void line(const char *what, uint32_t n)
{
    board_print(what);
    board_print_u32(n);
}

int app_main(void)
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &picture);
    for (int frame = 0; !status && frame < FRAMES; frame++) {
        uint32_t crc = 0;
        state = (uint32_t)frame * 747796405U + 1U;
        make_objects();
        make_light();
        make_view();
        if (frame % 4 == 3) spoil(frame / 4);
        gn_status refused = gn_render(&renderer, &scene, flush, &crc);
        line("frame ", (uint32_t)frame);
        if (refused) {
            line(" status ", refused);
        } else {
            board_print(" crc ");
            board_print_hex(crc);
        }
        board_print("\n");
    }
    return status != GN_OK;
}
