/* A turning pyramid, drawn by both cores of an RP2040 or RP2350: one takes the even screen tiles, one the odd. */
#include <stdio.h>
#include <string.h>

#include "gnomon.h"
#include "pico/multicore.h"
#include "pico/stdlib.h"

enum { SIDE = 240 };
void st7789_begin(void);
void st7789_show(const uint16_t *pixels);

static gn_renderer renderer; /* with the scratch of one core */
static gn_scratch second;    /* of the other */
static uint16_t picture[SIDE * SIDE];
static const int32_t ground_pos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                     GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3}, body_idx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
static const int32_t body_pos[] = {GN_Q16(-1), 0,         GN_Q16(-1), GN_Q16(-1), 0, GN_Q16(1), GN_Q16(1), 0,
                                   GN_Q16(1),  GN_Q16(1), 0,          GN_Q16(-1), 0, GN_Q16(2), 0};
static const gn_mesh ground = GN_MESH(ground_pos, ground_idx), body = GN_MESH(body_pos, body_idx);

static void keep(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    for (int j = 0; j < h; j++) memcpy(&picture[(y + j) * SIDE + x], (const uint16_t *)pixels + j * w, 2 * (size_t)w);
}
static void draw_tiles(uint32_t first, gn_scratch *scratch)
{
    for (uint32_t i = first; i < gn_screen_tile_count(&renderer); i += 2)
        gn_screen_tile(&renderer.frame, scratch, i, keep, NULL);
}
static void core1(void)
{
    for (;; multicore_fifo_push_blocking(0)) multicore_fifo_pop_blocking(), draw_tiles(1, &second);
}
int main(void)
{
    const gn_picture size = {SIDE, SIDE, GN_FORMAT_RGB565_SWAPPED, GN_VIEW_COLOUR, 0};
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    gn_object objects[] = {gn_object_default(&ground), gn_object_default(&body)};
    stdio_init_all(), st7789_begin(), multicore_launch_core1(core1);
    gn_status status = gn_init(&renderer, &size);
    for (uint16_t turn = 0; !status; turn = (uint16_t)(turn + 512)) {
        const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
        const uint32_t start = time_us_32();
        gn_affine_rotation(&objects[1].to_world, turn, 0, 0);
        if ((status = gn_begin(&renderer, &scene))) break;
        for (uint32_t i = 0; i < gn_shadow_tile_count(&renderer); i++) gn_shadow_tile(&renderer, i);
        if ((status = gn_prepare(&renderer))) break;
        multicore_fifo_push_blocking(1), draw_tiles(0, &renderer.scratch), multicore_fifo_pop_blocking();
        st7789_show(picture);
        printf("%u us\n", (unsigned)(time_us_32() - start));
    }
    printf("%s\n", gn_status_text(status));
}
