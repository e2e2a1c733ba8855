/* Visible spans of a screen tile [R2], linked and drawn by gn_shade_tile: whatever the cells hold, every pixel gets the
 * colour of the triangle that its cell names. Triangles cover the whole picture and are unlit, so that a triangle's
 * colour is one and known; the cells are filled in here, not by the raster. */
#include <string.h>

#include "check.h"
#include "gn_internal.h"
#include "knobs.h"
#include "rng.h"
#include "visible/gn_cell.h"

enum { N_MAX = 1000, SIDE_MAX = 256, BACKGROUND = 0 };

static rng random_state = {17};
static gn_renderer renderer;
static gn_object object[N_MAX];
static gn_scene scene;
static uint32_t expected[SIDE_MAX * SIDE_MAX]; /* the triangle of each cell plus 1, or BACKGROUND */

static const int32_t far_pos[9] = {GN_Q16(-80), GN_Q16(-11), GN_Q16(-10), GN_Q16(80), GN_Q16(-11),
                                   GN_Q16(-10), 0,           GN_Q16(50),  GN_Q16(-10)};
static const uint16_t triangle_idx[3] = {0, 1, 2};
static const uint16_t white[9] = {65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535};
/* A mesh of one colour, whose runs are filled, and one of equal vertex colours, whose runs are shaded. */
static const gn_mesh plain = {
    .pos = far_pos, .idx = triangle_idx, .n_vertices = 3, .n_triangles = 1, .pos_frac_bits = 16};
static const gn_mesh coloured = {
    .pos = far_pos, .rgb_uq16 = white, .idx = triangle_idx, .n_vertices = 3, .n_triangles = 1, .pos_frac_bits = 16};

/* Object i has the colour i + 1, in bits of 8 levels that survive the output's 8 bits. */
static void make_scene(uint32_t n, uint32_t coloured_in)
{
    gn_camera camera = {.focal_q24 = GN_Q24(1), .near_q16 = GN_Q16(1), .far_q16 = GN_Q16(100)};
    gn_affine_identity(&camera.to_world);
    scene = gn_scene_default(&camera, object, n, NULL, 0);
    memset(scene.background_uq20, 0, sizeof scene.background_uq20);
    for (uint32_t i = 0; i < n; i++) {
        object[i] = gn_object_default(i % coloured_in == 0 ? &coloured : &plain);
        object[i].flags = GN_OBJECT_UNLIT | GN_OBJECT_TWO_SIDED;
        gn_affine_identity(&object[i].to_world);
        for (int k = 0; k < 3; k++) object[i].albedo_uq16[k] = (uint16_t)(((i + 1) >> 4 * k & 15) * 4369);
    }
}

/* What the output says of the scene's colour: the object plus 1. */
static uint32_t object_at(const uint8_t *rgb)
{
    uint32_t number = 0;
    for (int k = 0; k < 3; k++) number |= (uint32_t)(rgb[k] + 8) / 17 << 4 * k;
    return number;
}

/* Cells as the raster leaves them: stretches of one triangle, on over the ends of rows, `most_px` at most. */
static void fill_cells(const gn_rect *rect, uint32_t n, uint32_t most_px)
{
    gn_scratch *scratch = &renderer.scratch;
    const int32_t stride = GN_K(&renderer.frame, tile_width);
    uint32_t left = 0, triangle = 0, id_bits = renderer.frame.id_bits;
    memset(scratch->cell, 0, sizeof scratch->cell);
    for (int32_t y = 0; y < rect->y1 - rect->y0; y++)
        for (int32_t x = 0; x < rect->x1 - rect->x0; x++, left--) {
            if (!left) {
                left = 1 + rng_below(&random_state, most_px);
                triangle = rng_below(&random_state, n + 1);
            }
            uint32_t depth = rng_u32(&random_state) >> id_bits << id_bits;
            expected[y * stride + x] = triangle;
            GN_CELLS(scratch)[y * stride + x] = triangle ? depth | gn_cell_id(&renderer.frame, triangle - 1) : 0;
        }
}

/* Draws a tile of random cells. Returns how many of its pixels show another triangle than their cell. */
static uint32_t wrong_pixels(uint32_t tile_idx, uint32_t n, uint32_t most_px)
{
    const gn_rect rect = gn_screen_rect(&renderer.frame, tile_idx);
    const int32_t stride = GN_K(&renderer.frame, tile_width), width = rect.x1 - rect.x0;
    uint32_t n_wrong = 0;
    fill_cells(&rect, n, most_px);
    gn_shade_tile(&renderer.frame, &renderer.scratch, tile_idx);
    for (int32_t y = 0; y < rect.y1 - rect.y0; y++)
        for (int32_t x = 0; x < width; x++) {
            const uint32_t triangle = expected[y * stride + x];
            const uint32_t want =
                triangle ? renderer.frame.records.tri[triangle - 1].source.object_idx + 1U : BACKGROUND;
            n_wrong += object_at(renderer.scratch.pixel.bytes + 3 * (y * width + x)) != want;
        }
    return n_wrong;
}

static void check_tiles(uint32_t n, uint32_t coloured_in, int32_t width, int32_t height, uint32_t most_px)
{
    gn_picture p = {(uint16_t)width, (uint16_t)height, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    make_scene(n, coloured_in);
    CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
    SET_KNOB(&renderer.frame, srgb, 0);
    SET_KNOB(&renderer.frame, tile_width, 8 * rng_range(&random_state, 1, 16));
    SET_KNOB(&renderer.frame, tile_height, rng_range(&random_state, 1, 32));
    CHECK_EQ_INT(gn_begin(&renderer, &scene), GN_OK);
    CHECK_EQ_INT(gn_prepare(&renderer), GN_OK);
    if (!CHECK_EQ_INT(gn_get_stats(&renderer)->n_triangles, n)) return;
    uint32_t n_wrong = 0;
    for (uint32_t i = 0; i < gn_screen_tile_count(&renderer); i++) n_wrong += wrong_pixels(i, n, most_px);
    if (!CHECK_EQ_INT(n_wrong, 0)) printf("  %u triangles, pictures of %d x %d\n", n, width, height);
}

int main(void)
{
    static const uint32_t counts[] = {1, 2, 7, 60, 300, N_MAX};
    for (int i = 0; i < 300; i++) {
        const uint32_t n = counts[rng_below(&random_state, sizeof counts / sizeof *counts)];
        check_tiles(n, 1 + rng_below(&random_state, 3), rng_range(&random_state, 1, 120),
                    rng_range(&random_state, 30, 60), rng_below(&random_state, 2) ? 3 : 200);
    }
    return check_report();
}
