/* A scene of its own through the public API, and the CRC-32 of every frame's bytes: the least that proves a board. */
#include "crc32.h"

#include "board.h"
#include "gn_port.h"
#include "gnomon.h"

enum { WIDTH = 64, HEIGHT = 48, FRAMES = 4 };

/* All of the memory: at its smallest it fits where data is fastest, on every board. */
#if GN_PRESET == GN_PRESET_TINY
GN_PORT_FAST
#endif
static gn_renderer renderer;

static const int32_t pos[] = {GN_Q16(-4), 0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4), 0,         GN_Q16(-4),
                              GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-1), 0, GN_Q16(1),  GN_Q16(1), 0,         GN_Q16(1),
                              GN_Q16(1),  0, GN_Q16(-1), GN_Q16(-1), 0, GN_Q16(-1), 0,         GN_Q16(2), 0};
static const uint16_t idx[] = {0, 1, 2, 0, 2, 3, 4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8};
static const gn_mesh mesh = {.pos = pos, .idx = idx, .n_vertices = 9, .n_triangles = 6, .pos_frac_bits = 16};

static gn_object object = {.mesh = &mesh, .albedo_uq16 = {60000, 50000, 40000}, .flags = GN_OBJECT_DEFAULT};
static gn_light sun = {.colour_uq16 = {GN_UQ16(0.9), GN_UQ16(0.9), GN_UQ16(0.8)},
                       .shadow_strength_uq16 = GN_UQ16(1),
                       .bias_normal_q16 = GN_Q16(1)};
static gn_scene scene = {.objects = &object,
                         .n_objects = 1,
                         .lights = &sun,
                         .n_lights = 1,
                         .ambient_uq16 = {9000, 9000, 12000},
                         .camera = {.focal_q24 = GN_Q24(2.747), .near_q16 = GN_Q16(1), .far_q16 = GN_Q16(50)},
                         .shadow = {.max_distance_q16 = GN_Q16(14),
                                    .distance_fade_uq16 = GN_UQ16(0.1),
                                    .cascade_fade_uq16 = GN_UQ16(0.1),
                                    .filter = GN_FILTER_MAX >= 2 ? GN_FILTER_3X3 : GN_FILTER_HARD}};

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    uint32_t *crc = user;
    (void)x, (void)y;
    *crc = crc32_add(*crc, pixels, 2U * (uint32_t)(w * h));
}

/* The sun goes round; the pyramid turns. */
static void move(int frame)
{
    gn_affine_rotation(&object.to_world, (uint16_t)(frame * GN_TURN(20)), 0, 0);
    sun.direction[0] = -2 + frame;
    sun.direction[1] = -3;
    sun.direction[2] = -1;
}

int app_main(void)
{
    static const int32_t eye[3] = {GN_Q16(3), GN_Q16(3), GN_Q16(7)}, target[3] = {0, GN_Q16(0.5), 0};
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_affine_identity(&object.to_world);
    gn_camera_look_at(&scene.camera.to_world, eye, target);
    gn_status status = gn_init(&renderer, &picture);
    for (int frame = 0; !status && frame < FRAMES; frame++) {
        uint32_t crc = 0;
        move(frame);
        status = gn_render(&renderer, &scene, flush, &crc);
        board_print("frame ");
        board_print_u32((uint32_t)frame);
        board_print(" crc ");
        board_print_hex(crc);
        board_print("\n");
    }
    if (status) board_print(gn_status_text(status));
    return status != GN_OK;
}
