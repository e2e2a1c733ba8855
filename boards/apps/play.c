/* A compiled scene with a library that was configured for it: make firmware BOARD=... APP=play SCENE=FILE. Prints the
 * CRC-32 of every frame's bytes, or of the first N with ARGS=N. */
#include "scene.h"

#include "board.h"
#include "crc32.h"

static gn_renderer renderer;
static scene_state state;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    uint32_t *crc = user;
    (void)x, (void)y;
    *crc = crc32_add(*crc, pixels, gn_format_bytes(SCENE_FORMAT, (uint32_t)w, (uint32_t)h));
}

static uint32_t n_frames(void)
{
    uint32_t n = 0;
    for (const char *digit = board_args(); *digit >= '0' && *digit <= '9'; digit++)
        n = 10 * n + (uint32_t)(*digit - '0');
    return n && n < SCENE_FRAMES ? n : SCENE_FRAMES;
}

int app_main(void)
{
    const gn_picture picture = {SCENE_WIDTH, SCENE_HEIGHT, SCENE_FORMAT, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &picture);
    for (uint32_t frame = 0, end = n_frames(); !status && frame < end; frame++) {
        uint32_t crc = 0;
        status = gn_render(&renderer, scene_frame(&state, frame), flush, &crc);
        board_print_hex(crc);
        board_print(" frame ");
        board_print_u32(frame);
        board_print("\n");
    }
    if (status) board_print(gn_status_text(status));
    board_print_memory();
    return status != GN_OK;
}
