/* Cones of spots on a ground of small triangles, and its pixels each for itself: cones that lie between the corners of
 * a triangle, soft and hard rims, wide and narrow ones. */
#include <math.h>

#include "base/gn_count.h"
#include "canvas.h"
#include "check.h"
#include "knobs.h"
#include "light_scene.h"
#if GN_COUNTERS
#include "../host/tool/cost/count.h"
#endif

#if GN_INTERPOLATES && GN_PUNCTUAL_LIGHTS

enum { W = 96, H = 72, N_SCENES = 200, QUADS = 24 };

static gn_renderer renderer;
static light_scene ls;
static rng random_state = {23};
static int32_t pos[3 * (QUADS + 1) * (QUADS + 1)];
static uint16_t idx[6 * QUADS * QUADS];
static gn_mesh fine;

static void make_fine(void)
{
    uint16_t *to = idx;
    for (int i = 0; i <= QUADS; i++)
        for (int k = 0; k <= QUADS; k++) {
            int32_t *p = &pos[3 * ((QUADS + 1) * i + k)];
            p[0] = GN_Q16(12) / QUADS * k - GN_Q16(6);
            p[2] = GN_Q16(12) / QUADS * i - GN_Q16(6);
        }
    for (int i = 0; i < QUADS; i++)
        for (int k = 0; k < QUADS; k++) {
            const int a = (QUADS + 1) * i + k, c = a + QUADS + 1, quad[6] = {a, c, c + 1, a, c + 1, a + 1};
            for (int j = 0; j < 6; j++) *to++ = (uint16_t)quad[j];
        }
    fine = (gn_mesh){.pos = pos,
                     .idx = idx,
                     .n_vertices = (QUADS + 1) * (QUADS + 1),
                     .n_triangles = 2 * QUADS * QUADS,
                     .pos_frac_bits = 16};
}

/* A spot above that looks down, or aslant; as bright as white on the ground below. */
static void begin_spot(rng *r)
{
    ls_begin(&ls);
    ls.scene.n_objects = 1;
    ls.object[0].mesh = &fine;
    gn_light *light = ls_add_light(&ls, GN_LIGHT_SPOT);
    const int32_t height = ls_q16(r, 2, 6);
    light->position_q16[0] = ls_q16(r, -2, 2), light->position_q16[1] = height,
    light->position_q16[2] = ls_q16(r, -2, 2);
    light->direction[0] = ls_q16(r, -1, 1) / 3, light->direction[1] = GN_Q16(-1),
    light->direction[2] = ls_q16(r, -1, 1) / 3;
    light->outer_turn = (uint16_t)(600 + rng_below(r, 14000));
    light->inner_turn = (uint16_t)rng_below(r, light->outer_turn);
    light->range_q16 = 0;
    for (int k = 0; k < 3; k++) {
        ls.object[0].albedo_uq16[k] = 65536;
        light->colour_uq16[k] = (uint32_t)((int64_t)height * height >> 16);
        ls.scene.ambient_uq16[k] = ls.scene.background_uq20[k] = 0;
    }
    light->colour_exp = 0;
    const int32_t x = ls_q16(r, -3, 3), y = ls_q16(r, 4, 8), z = ls_q16(r, 4, 8);
    ls_look(&ls, x, y, z);
}

static int draw(canvas *picture, int32_t step)
{
    gn_picture p = picture_of(W, H, GN_FORMAT_RGB888);
    if (!CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK)) return 0;
    if (!TAKES_KNOB(&renderer.frame, persp_step, step)) return 0;
#if GN_COUNTERS
    count_reset();
#endif
    canvas_begin(picture, W, H, GN_FORMAT_RGB888);
    return CHECK_EQ_INT(gn_render(&renderer, &ls.scene, flush, picture), GN_OK);
}

static double linear(uint8_t encoded)
{
    const double v = encoded / 255.0;
    if (!GN_SRGB) return v;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

int main(void)
{
    static const int32_t steps[] = {4, 8, 16};
    double worst = 0;
    long n_patches = 0, n_lit = 0;
    make_fine();
    for (int i = 0; i < N_SCENES; i++) {
        canvas exact, fast;
        begin_spot(&random_state);
        if (!draw(&exact, 1)) return check_report();
        for (int k = 0; k < 3; k++) {
            double here = 0;
            if (!draw(&fast, steps[k])) continue;
#if GN_COUNTERS
            n_patches += (long)count_get().n[GN_COUNT_patches];
#endif
            for (int j = 0; j < W * H; j++) {
                const double a = linear(exact.pixels[3 * j]), b = linear(fast.pixels[3 * j]);
                here = fmax(here, fabs(a - b));
                n_lit += a > 0.1;
            }
            if (here >= 0.1) printf("scene %d, step %d: off by %.3f\n", i, (int)steps[k], here);
            worst = fmax(worst, here);
            canvas_end(&fast);
        }
        canvas_end(&exact);
    }
    printf("%ld patches, %ld lit pixels; off by %.4f\n", n_patches, n_lit, worst);
    CHECK(n_lit > 1000 || !GN_RUNTIME_KNOBS);
    CHECK(n_patches > 10000 || !GN_COUNTERS || !GN_RUNTIME_KNOBS);
    CHECK(worst < 0.1);
    return check_report();
}

#else

int main(void)
{
    return check_report();
}

#endif
