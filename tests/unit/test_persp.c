/* Views of spot and point lights: the cube's faces, the fit and its limits, against the formulas in doubles. */
#include <math.h>
#include <string.h>

#include "scene/gn_scene.h"
#include "base/gn_math.h"
#include "shadow/gn_views.h"
#include "check.h"
#include "rng.h"

static gn_renderer one;
static gn_scene scene;

enum { T = 64 }; /* texels of a tile for casters */

/* MODEL 5: t with (1 - A) P t^2 - (1 - P - A) t + 1 = 0, the smaller root; A = 2 (k + 1) / T, P = nu A / sqrt(2). 2
 * if there is none up to 2. */
static double face(int k, double nu, int texels, int *clamped)
{
    const double a = 2.0 * (k + 1) / texels, p = nu * a / sqrt(2), b = 1 - p - a, under = b * b - 4 * p * (1 - a);
    *clamped = b <= 0 || under < 0 || 2 / (b + sqrt(under)) > 2;
    return *clamped ? 2 : 2 / (b + sqrt(under));
}

static void test_faces(void)
{
    int n_clamped = 0, n_free = 0;
    for (int k = 0; k <= 8; k++)
        for (int nu_q16 = 0; nu_q16 <= 18 << 16; nu_q16 += nu_q16 ? nu_q16 : 1 << 13)
            for (int texels = 8; texels <= 1024; texels += texels / 4) {
                int want, got = -1;
                const double t = face(k, ldexp(nu_q16, -16), texels, &want);
                const int64_t t_q24 = gn_persp_face_q24(k, nu_q16, texels, &got);
                /* 2^-24 in A, P and B is up to 2^-20 in the root of a discriminant that is nearly 0 */
                if (fabs(t - 2) > 1e-3 || want) CHECK_EQ_INT(got, want);
                CHECK_NEAR(ldexp((double)t_q24, -24), t, 2e-3);
                n_clamped += want, n_free += !want;
            }
    CHECK(n_clamped > 20 && n_free > 200);
    int clamped;
    CHECK_NEAR(ldexp((double)gn_persp_face_q24(0, 0, 64, &clamped), -24), 64.0 / 62, ldexp(1, -22));
    CHECK_EQ_INT(clamped, 0);
    /* one face per direction, and ties as gn_persp_face says */
    for (int f = 0; f < 6; f++) {
        int32_t axis[3];
        gn_persp_face_axis(axis, f);
        CHECK_EQ_INT(gn_persp_face(axis), f);
        for (int i = 0; i < 3; i++) CHECK_EQ_INT(axis[i], i != f / 2 ? 0 : f & 1 ? -(1 << 30) : 1 << 30);
    }
    const int32_t tie[5][4] = {{5, 5, 5, 4}, {5, -5, 4, 3}, {5, 4, -5, 5}, {6, 5, -5, 0}, {0, 0, 0, 4}};
    for (int i = 0; i < 5; i++) CHECK_EQ_INT(gn_persp_face(tie[i]), tie[i][3]);
}

/* Every field of the fit of a spot, from the narrowest cone in the largest tile to the widest in the smallest. */
static void test_spot(void)
{
    static const int texels[] = {8, 16, 64, 333, 1024};
    static const double degrees[] = {1.001, 2, 20, 90, 150, 178.9};
    static const int32_t nears[] = {1, 655, 8192 << 16}, biases[] = {0, 1, 1 << 16, 64 << 16};
    for (int i = 0; i < 5 * 6 * 3 * 4; i++) {
        gn_light light = {.kind = GN_LIGHT_SPOT, .position_q16 = {i, -5, 7}};
        gn_light_view view = {0};
        const double angle = degrees[i / 5 % 6];
        light.outer_turn = (uint16_t)lround(angle / 360 * 65536);
        light.near_q16 = nears[i / 30 % 3], light.bias_constant_q16 = biases[i / 90];
        view.tile_texels = (uint16_t)texels[i % 5];
        gn_persp_fit_view(&one.frame, &view, &light);
        const gn_persp_fit *fit = &view.fit.persp;
        const double per_t = texels[i % 5] / tan(light.outer_turn / 65536.0 * acos(-1)), max = 2147483647;
        const double focal2 = fmin(per_t * 65536, 4294967295.0), got = fit->focal2_q16;
        CHECK_NEAR(got, focal2, 1 + focal2 * ldexp(1, -13)); /* 2 units of Q30 in the smallest sine, 0.0087 */
        CHECK_EQ_INT(fit->near_q16, light.near_q16);
        for (int k = 0; k < 3; k++) CHECK_EQ_INT(fit->eye_q16[k], light.position_q16[k]);
        for (int k = 0; k < 2; k++) {
            CHECK_EQ_INT(fit->guard_q16[k], fmin(floor(ldexp(16384, 32) / got), max));
            CHECK_EQ_INT(fit->side_q16[k], fmin(floor(ldexp(texels[i % 5], 32) / got) + 2, max));
        }
        CHECK_EQ_INT(fit->constant_share_q30, fmin(floor(ldexp(light.bias_constant_q16, 31) / got), ldexp(1, 30)));
        CHECK_NEAR((double)fit->ratio_max_q28, ldexp(1, 62) / got, 1 + ldexp(1, 62) / got * 1e-12);
        const double texel = (double)gn_bf_apply(1 << 30, fit->texel_per_z, 10); /* 2 t / T, Q40 */
        CHECK_NEAR(texel, ldexp(2 * 65536 / got, 40), 2 + texel * ldexp(1, -24));
        const double per_near = (double)gn_bf_apply(1 << 30, fit->per_near, 0);
        CHECK_NEAR(per_near, ldexp(1.0 / light.near_q16, 30), 2 + per_near * ldexp(1, -24));
    }
    CHECK_EQ_INT(one.frame.stats.n_reach_clamped, 0);
}

/* A point light's faces are as wide as its filter and bias need; those that 2 is too little for are counted. */
static void test_point(void)
{
    for (int i = 0; i < 9; i++) {
        gn_light light = {.kind = GN_LIGHT_POINT, .near_q16 = 655, .auto_bias = GN_AUTO_BIAS_OFF};
        gn_light_view view = {.tile_texels = (uint16_t)(8 << i % 3 * 3), .filter_idx = (uint8_t)(i / 3)};
        int want;
        light.bias_normal_q16 = i << 15;
        const double t = face(i / 3, i / 2.0 * sqrt(2), view.tile_texels, &want);
        one.frame.stats.n_reach_clamped = 0;
        gn_persp_fit_view(&one.frame, &view, &light);
        CHECK_NEAR(view.fit.persp.focal2_q16, view.tile_texels * 65536 / t, 1e-3 * view.tile_texels * 65536);
        CHECK_EQ_INT(one.frame.stats.n_reach_clamped, want);
    }
}

static double within(rng *state, double lo, double hi)
{
    return lo + (hi - lo) * ldexp(rng_u32(state), -32);
}

/* A view of a spot light: of four widths, with and without biases. */
static void make_spot(gn_light_view *view, int i)
{
    static const double degrees[] = {3, 40, 120, 170};
    gn_light light = {.kind = GN_LIGHT_SPOT, .near_q16 = 6554, .bias_constant_q16 = i & 8 ? 1 << 14 : 0};
    *view = (gn_light_view){.tile_texels = T, .tile_log2 = 6, .depth_bits = 16, .perspective = 1};
    light.outer_turn = (uint16_t)lround(degrees[i & 3] / 360 * 65536);
    view->bias_constant_q16 = light.bias_constant_q16;
    view->bias_slope_q16 = i & 16 ? 1 << 15 : 0;
#if GN_DISK_FILTER
    static gn_depth_block blocks[T * T / 64];
    view->block = blocks;
#endif
#if GN_TIGHT_FIT
    view->tile_rows = T;
#endif
    gn_persp_fit_view(&one.frame, view, &light);
}

/* A triangle of 1/8 to 64 texels, most of it in the tile. */
static void make_caster(gn_caster_corner corner[3], const gn_light_view *view, rng *state)
{
    const double tangent = T * 65536.0 / view->fit.persp.focal2_q16, size = ldexp(1, (int)rng_below(state, 9) - 3);
    const double u = within(state, -6, T + 6), v = within(state, -6, T + 6), away = within(state, 0.05, 30);
    for (int k = 0; k < 3; k++) {
        const double z = fmax(away + within(state, -0.2, 0.2) * size * away * tangent / T, 0.01);
        const double at[2] = {u + within(state, -size, size), v + within(state, -size, size)};
        for (int axis = 0; axis < 2; axis++)
            corner[k].vertex.v_q16[axis] = (int32_t)lround((at[axis] - T / 2.0) * 2 / T * tangent * z * 65536);
        corner[k].vertex.v_q16[2] = (int32_t)lround(z * 65536);
        gn_persp_corner(&one.frame, view, &corner[k]);
    }
}

/* Small casters, told apart by the quick way at their corners, against the general way: the same texels, and as many.
 */
static void test_small_casters(void)
{
    enum { TRIANGLES = 20000 };
    static uint16_t texels[2][T * T];
    static gn_casting casting;
    rng state = {77};
    int n_drawn = 0, n_culled = 0, n_cut = 0;
    for (int i = 0; i < TRIANGLES; i++) {
        gn_light_view view;
        gn_caster_corner corner[3];
        const gn_caster_corner *c[3] = {&corner[0], &corner[1], &corner[2]};
        make_spot(&view, i);
        make_caster(corner, &view, &state);
        casting.job.sides = i & 4 ? GN_SIDES_BOTH : GN_SIDE_CCW;
        int32_t n[2];
        memset(texels, 255, sizeof texels);
        for (int way = 0; way < 2; way++) {
            for (int k = 0; k < 9; k++)
                casting.with.clipping.polygon.v_q16[k / 3][k % 3] = c[k / 3]->vertex.v_q16[k % 3];
            view.depth.d16 = texels[way];
            n[way] = way ? gn_persp_triangle(&one.frame, &view, &casting, NULL)
                         : gn_persp_small_triangle(&one.frame, &view, &casting, c);
        }
        CHECK(!memcmp(texels[0], texels[1], sizeof texels[0]));
        CHECK(n[0] > 0 || n[1] > 0 ? n[0] == n[1] : 1);
        n_drawn += n[0] > 0, n_culled += n[0] < 0, n_cut += (c[0]->out | c[1]->out | c[2]->out) != 0;
    }
    CHECK(n_drawn > TRIANGLES / 4 && n_culled > TRIANGLES / 4 && n_cut > TRIANGLES / 20);
}

int main(void)
{
    const gn_picture p = {64, 64, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    CHECK(gn_init(&one, &p) == GN_OK);
    one.frame.scene = &scene;
    test_faces();
    test_spot();
    test_point();
    test_small_casters();
    return check_report();
}
