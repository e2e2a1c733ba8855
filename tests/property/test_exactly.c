/* What has one right answer, whatever is approximated: a surface beside another looks as it does alone, of two surfaces
 * the nearer one is seen down to 2^-18 of near/Z, and lookups are counted. */
#include <stdlib.h>

#include "canvas.h"
#include "check.h"
#include "knobs.h"
#include "light_scene.h"
#if GN_COUNTERS
#include "../host/tool/cost/count.h"
#endif

enum { W = 128, H = 96, FOCAL_PX = 96, N_SCENES = 40, N_STEEP = 400 };

static gn_renderer renderer;
static light_scene ls;
static canvas picture;
static rng random_state = {97};

/* A picture of the scene, with cells of so many pixels. */
static int draw(gn_format format, int32_t step)
{
    gn_picture p = picture_of(W, H, format);
    if (!CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK)) return 0;
    SET_KNOB(&renderer.frame, persp_step, step);
    SET_KNOB(&renderer.frame, atlas_size, 128);
    canvas_begin(&picture, W, H, format);
    return CHECK_EQ_INT(gn_render(&renderer, &ls.scene, flush, &picture), GN_OK);
}

/* The ground alone. */
static void begin_ground(void)
{
    ls_begin(&ls);
    ls.scene.n_objects = 1;
    for (int k = 0; k < 3; k++) ls.scene.background_uq20[k] = 0;
}

/* ---- Surfaces beside each other ---------------------------------------------------------------------------------- */

/* Two squares of one colour, a strip between them whose colour varies, and posts and boxes that throw shadows on all.
 */
static void begin_squares(rng *r, uint16_t baked_uq12[12])
{
    static int32_t strip_pos[12];
    static gn_mesh strip;
    begin_ground();
    for (int i = 0; i < 12; i++) baked_uq12[i] = (uint16_t)rng_below(r, 4096);
    const int32_t at = ls_q16(r, -1, 1), half = ls_q16(r, 0.1, 0.4), end = GN_Q16(2);
    const int32_t corners[12] = {-half, 0, -end, -half, 0, end, half, 0, end, half, 0, -end};
    memcpy(strip_pos, corners, sizeof corners);
    strip = ls.demo.ground;
    strip.pos = strip_pos;
    for (int i = 0; i < 3; i++) {
        gn_object *o = i ? ls_add_object(&ls, i == 1 ? &strip : &ls.demo.ground) : &ls.object[0];
        ls_place(o, at + (i - 1) * (half + end), 0, 0, 0, 0, i == 1 ? 1 : 1.0 / 3);
        o->flags &= ~(uint32_t)GN_OBJECT_CASTS;
        for (int k = 0; k < 3; k++) o->albedo_uq16[k] = 40000;
    }
    ls.object[1].baked_uq12 = GN_BAKED_LIGHT ? baked_uq12 : NULL;
    ls_add_random_light(&ls, r, GN_LIGHT_DIRECTIONAL);
    for (int i = 0; i < 12; i++) {
        gn_object *o = ls_add_object(&ls, &ls.demo.box);
        const int32_t x = ls_q16(r, -2, 2), z = ls_q16(r, -2, 2), y = ls_q16(r, 1, 2);
        const uint16_t yaw = (uint16_t)rng_u32(r), pitch = (uint16_t)rng_u32(r);
        ls_place(o, x, y, z, yaw, pitch, 0.2);
    }
    ls.scene.shadow.n_cascades = (uint8_t)(1 + rng_below(r, 2));
}

/* Without the square in between, which throws no shadow, the others look as they did. */
static void test_beside(void)
{
    static uint8_t before[2 * W * H];
    uint16_t baked[12];
    long n_other = 0;
    for (int i = 0; i < N_SCENES; i++) {
        begin_squares(&random_state, baked);
        if (!draw(GN_FORMAT_RGB565, 16)) return;
        memcpy(before, picture.pixels, sizeof before);
        canvas_end(&picture);
        ls.object[1].flags = GN_OBJECT_HIDDEN;
        if (!draw(GN_FORMAT_RGB565, 16)) return;
        for (int k = 0; k < 2 * W * H; k += 2)
            if (picture.pixels[k] | picture.pixels[k + 1]) n_other += memcmp(before + k, picture.pixels + k, 2) != 0;
        canvas_end(&picture);
    }
    CHECK_EQ_INT(n_other, 0);
}

/* ---- The nearer of two surfaces ------------------------------------------------------------------------------------
 */

/* A ceiling, the nearest edge of which goes through the centres of the pixels of row r above the middle, and a wall
 * 2^-16 units behind that edge. Returns the picture's row. */
static int begin_steep(rng *r, int32_t pos[2][12], gn_mesh mesh[2])
{
    static const uint16_t idx[6] = {0, 1, 2, 0, 2, 3};
    const int row = 4 + (int)rng_below(r, 30);
    const int32_t z = ls_q16(r, 1.5, 3), y = (int32_t)(((int64_t)(2 * row + 1) * z) / (2 * FOCAL_PX)),
                  far = z + GN_Q16(20), side = GN_Q16(0.2), wall = z + 1, big = GN_Q16(5);
    const int32_t ceiling[12] = {-side, y, -z, side, y, -z, side, y, -far, -side, y, -far},
                  behind[12] = {-big, -big, -wall, big, -big, -wall, big, big, -wall, -big, big, -wall};
    memcpy(pos[0], ceiling, sizeof ceiling);
    memcpy(pos[1], behind, sizeof behind);
    ls_begin(&ls);
    ls.scene.n_objects = 0;
    gn_affine_identity(&ls.scene.camera.to_world);
    ls.scene.camera.focal_q24 = 2 * GN_Q24(1) * FOCAL_PX / H;
    ls.scene.camera.near_q16 = GN_Q16(1);
    for (int i = 0; i < 2; i++) {
        const gn_mesh quad = {.pos = pos[i], .idx = idx, .n_vertices = 4, .n_triangles = 2, .pos_frac_bits = 16};
        mesh[i] = quad;
        gn_object *o = ls_add_object(&ls, &mesh[i]);
        o->flags |= GN_OBJECT_TWO_SIDED;
        for (int k = 0; k < 3; k++) o->albedo_uq16[k] = k == i ? 65536 : 0;
    }
    for (int k = 0; k < 3; k++) ls.scene.ambient_uq16[k] = 65536;
    return H / 2 - 1 - row;
}

static void test_nearer(void)
{
    int n_behind = 0;
    for (int i = 0; i < N_STEEP; i++) {
        int32_t pos[2][12];
        gn_mesh mesh[2];
        const int row = begin_steep(&random_state, pos, mesh);
        if (!draw(GN_FORMAT_RGB888, 16)) return;
        n_behind += picture.pixels[3 * (row * W + W / 2)] == 0;
        canvas_end(&picture);
    }
    CHECK_EQ_INT(n_behind, 0);
}

/* ---- Close to a lamp --------------------------------------------------------------------------------------------- */

/* Where irradiance is above 8 corners limit it: what a dark surface leaves of it is found for each pixel. Below the
 * lamp, at 0.9, it is 29 / (0.81 + r^2)^1.5, above 8 up to a radius of 1.2; 24 pixels are 1. */
static void test_close_to_lamp(void)
{
    static uint8_t exactly[3 * W * H];
    begin_ground();
    gn_light *light = ls_add_light(&ls, GN_LIGHT_POINT);
    const int32_t above[3] = {0, GN_Q16(0.9), 0};
    memcpy(light->position_q16, above, sizeof above);
    light->colour_exp = 5;
    light->shadow_strength_uq16 = 0;
    for (int k = 0; k < 3; k++) {
        light->colour_uq16[k] = 65536;
        ls.object[0].albedo_uq16[k] = 1200;
        ls.scene.ambient_uq16[k] = 0;
    }
    ls_look(&ls, 0, GN_Q16(4), GN_Q16(0.05));
    if (!draw(GN_FORMAT_RGB888, 1)) return;
    memcpy(exactly, picture.pixels, sizeof exactly);
    canvas_end(&picture);
    for (int32_t step = 4; step <= 16; step *= 2) {
        int n_off = 0, brightest = 0;
        if (!draw(GN_FORMAT_RGB888, step)) return;
        for (int y = H / 2 - 12; y < H / 2 + 12; y++)
            for (int x = W / 2 - 12; x < W / 2 + 12; x++)
                for (int k = 0, i = 3 * (y * W + x); k < 3; k++) {
                    n_off += picture.pixels[i + k] != exactly[i + k];
                    if (exactly[i + k] > brightest) brightest = exactly[i + k];
                }
        canvas_end(&picture);
        CHECK_EQ_INT(n_off, 0);
        CHECK(brightest > 170 && brightest < 255); /* limited to 8 it is 107 */
    }
}

/* ---- Parallel rays ----------------------------------------------------------------------------------------------- */

/* Shiny things, by an orthographic camera, after a frame of another one: whatever was shaded before, highlights between
 * the corners of cells are those of pixels, but for a level in 99 of 100 channels. */
static void test_parallel_highlights(void)
{
    static uint8_t exactly[3 * W * H];
    long n_all = 0, n_other = 0, n_far = 0, n_lit = 0;
    for (int i = 0; i < N_SCENES; i++) {
        ls_begin(&ls);
        ls.scene.n_objects = 3; /* without the card, whose texture is not told exactly */
        ls_add_random_objects(&ls, &random_state, 4);
        gn_light *light = ls_add_random_light(&ls, &random_state, (gn_light_kind)(i % 3));
        light->shadow_strength_uq16 = 0; /* whose edges are finer where every pixel is exact */
        ls_look(&ls, ls_q16(&random_state, -6, 6), GN_Q16(3), GN_Q16(7));
        for (uint32_t k = 0; k < ls.scene.n_objects; k++) {
            ls.object[k].shininess_log2 = (uint8_t)rng_below(&random_state, 6);
            for (int c = 0; c < 3; c++) ls.object[k].specular_uq16[c] = 40000;
        }
        for (int step = 1; step <= 16; step += 15) {
            ls.scene.camera.half_height_q16 = 0;
            if (!draw(GN_FORMAT_RGB888, step)) return;
            ls.scene.camera.half_height_q16 = GN_Q16(2);
            if (!CHECK_EQ_INT(gn_render(&renderer, &ls.scene, flush, &picture), GN_OK)) return;
            if (step == 1) memcpy(exactly, picture.pixels, sizeof exactly);
            for (int k = 0; step > 1 && k < 3 * W * H; k++) {
                const int off = abs(exactly[k] - picture.pixels[k]);
                n_all++;
                n_other += off > 1;
                n_far += off > 32;
                n_lit += exactly[k] > 128;
            }
            canvas_end(&picture);
        }
    }
    CHECK(n_other * 100 < n_all && n_far == 0);
    CHECK(n_lit > 10000);
}

/* ---- Counts --------------------------------------------------------------------------------------------------------
 */

#if GN_COUNTERS
/* By single pixels and the hard filter: one lookup for each pixel of the ground. */
static void test_counts(void)
{
    long n_ground = 0;
    begin_ground();
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    ls.scene.shadow.filter = GN_FILTER_HARD;
    ls.scene.shadow.n_cascades = 1;
    ls.scene.shadow.max_distance_q16 = GN_Q16(40);
    count_reset();
    if (!draw(GN_FORMAT_RGB888, 1)) return;
    const count_all count = count_get();
    for (int i = 0; i < W * H; i++) n_ground += picture.pixels[3 * i] != 0;
    canvas_end(&picture);
    CHECK(n_ground > W * H / 8 && n_ground < W * H);
    CHECK_EQ_INT((long)count.n[GN_COUNT_lookups], n_ground);
}
#endif

int main(void)
{
    test_beside();
    test_nearer();
    if (GN_PUNCTUAL_LIGHTS && GN_RUNTIME_KNOBS) test_close_to_lamp();
    if (GN_SPECULAR && GN_ORTHOGRAPHIC && GN_PUNCTUAL_LIGHTS && GN_RUNTIME_KNOBS) test_parallel_highlights();
#if GN_COUNTERS
    test_counts();
#endif
    return check_report();
}
