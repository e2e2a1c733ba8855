/* A lit scene with a filtered shadow in 16 KB of RAM: a pocket sundial, streamed strip by strip as to a serial panel.
 * ARGS=FILE writes the strips of the first hour to a file of the machine that runs the emulator, RGB565, 128 x 128. */
#include "crc32.h"

#include "board.h"
#include "pocket_scene.h"

enum { WIDTH = 128, HEIGHT = 128, HOURS = 3 };

static gn_renderer renderer;
static gn_light sun = {.colour_uq16 = {GN_UQ16(1.5), GN_UQ16(1.35), GN_UQ16(1.1)},
                       .shadow_strength_uq16 = GN_UQ16(1),
                       .bias_normal_q16 = GN_Q16(1)};
static const gn_scene scene = {
    .objects = pocket_objects,
    .n_objects = POCKET_OBJECTS,
    .lights = &sun,
    .n_lights = 1,
    .ambient_uq16 = {9000, 11000, 16000},
    .background_uq20 = {320000, 512000, 800000},
    /* from (2.2, 5, 5.6) to (0, 0.35, -0.1), as gn_camera_look_at has it: a constant costs no RAM */
    .camera = {.to_world = {.m_q30 = {{1001719042, -234149502, 307659678},
                                      {0, 854433424, 650280731},
                                      {-386627038, -606662213, 797121069}},
                            .t_q16 = {XYZ(2.2, 5, 5.6)}},
               .focal_q24 = GN_Q24(2.4),
               .near_q16 = GN_Q16(1),
               .far_q16 = GN_Q16(30)},
    .shadow = {.max_distance_q16 = GN_Q16(11),
               .distance_fade_uq16 = GN_UQ16(0.1),
               .cascade_fade_uq16 = GN_UQ16(0.1),
               .filter = GN_FILTER_3X3}};

typedef struct {
    uint32_t crc;
    int file; /* negative: none */
    int failed;
} stream;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    stream *out = user;
    uint32_t n_bytes = 2U * (uint32_t)(w * h);
    (void)x, (void)y;
    out->crc = crc32_add(out->crc, pixels, n_bytes);
    if (out->file >= 0) out->failed |= board_file_write(out->file, pixels, n_bytes);
}

static gn_status show_hour(int hour, stream *out)
{
    sun.direction[0] = 3 - 3 * hour;
    sun.direction[1] = -3;
    sun.direction[2] = -2;
    out->crc = 0;
    gn_status status = gn_render(&renderer, &scene, flush, out);
    board_print("hour ");
    board_print_u32((uint32_t)hour);
    board_print(" crc ");
    board_print_hex(out->crc);
    board_print("\n");
    return status;
}

int app_main(void)
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    const char *path = board_args();
    stream out = {0, *path ? board_file_create(path) : -1, 0};
    int failed = *path && out.file < 0;
    gn_status status = gn_init(&renderer, &picture);
    for (int hour = 0; !status && hour < HOURS; hour++) {
        status = show_hour(hour, &out);
        if (out.file >= 0) failed |= board_file_close(out.file);
        out.file = -1;
    }
    if (status) board_print(gn_status_text(status));
    board_print_memory();
    return status != GN_OK || failed || out.failed;
}
