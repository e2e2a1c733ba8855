/* Bias of receivers that a light sets itself (gn_bias.c): the terms of MODEL 7 in doubles, their limits, and what
 * does not fit 32 bits; limits of automatic bias, whose promise tests/oracle/test_bias.c holds. */
#include <math.h>
#include <string.h>

#include "base/gn_math.h"
#include "light/gn_lights.h"
#include "check.h"
#include "rng.h"

static gn_renderer one;
static gn_scene scene;
static gn_light light;
enum { NEAR_MOST_Q16 = 8192 << 16 };

static void test_reach(void)
{
    gn_light_view view = {.tile_texels = 64};
    for (int i = 0; i <= 16; i++) {
        light.bias_normal_q16 = i << 15, light.bias_receiver_q16[0] = 77, light.bias_receiver_q16[1] = 99;
        light.bias_receiver_q16[2] = i * 1000, light.bias_receiver_q16[3] = i * i;
        const double nu = sqrt(2) * (i << 15) + i * 1000 + i * i;
        CHECK_NEAR(gn_bias_reach_q16(&one.frame, &view, &light), nu, 1.5 + nu * 1e-5);
    }
#if GN_AUTO_BIAS /* the depth form moves nothing: its views need no margin */
    light.auto_bias = GN_AUTO_BIAS_DEPTH;
    CHECK_EQ_INT(gn_bias_reach_q16(&one.frame, &view, &light), 0);
    light.auto_bias = GN_AUTO_BIAS_NORMAL;
    CHECK(gn_bias_reach_q16(&one.frame, &view, &light) > 92682);
    light.auto_bias = GN_AUTO_BIAS_OFF;
#endif
}

static void random_unit(rng *r, int32_t out_q30[3])
{
    double v[3], length = 0;
    for (int i = 0; i < 3; i++) v[i] = rng_range(r, -1000, 1000), length += v[i] * v[i];
    for (int i = 0; i < 3; i++) out_q30[i] = (int32_t)(ldexp(v[i], 30) / sqrt(length + 1));
}

static double dot(const int32_t a[3], const int32_t b[3])
{
    return ldexp((double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2], -60);
}

static void random_biases(rng *r, gn_light_view *view)
{
    for (int i = 0; i < 4; i++) light.bias_receiver_q16[i] = rng_below(r, 3) ? rng_range(r, 0, 8 << 16) : 0;
    if (rng_below(r, 4) == 0) light.bias_receiver_q16[0] = 0, light.bias_receiver_q16[1] = light.bias_receiver_q16[3];
    light.bias_normal_q16 = 1 << 16, light.auto_bias = GN_AUTO_BIAS_OFF;
    view->filter_idx = (uint8_t)rng_below(r, 9);
    view->offset_q16 = rng_range(r, 0, 72 << 16);
}

/* Along the normal and towards the light, texels: b_n + reach b_w sin, reach (b_x + b_y tan), tan at most 50. */
static void terms(const gn_light_view *view, double cosine, double *along, double *towards)
{
    const int32_t *b = light.bias_receiver_q16;
    const double c = fmin(fmax(cosine, 0), 1), s = sqrt(1 - c * c), reach = view->filter_idx + 1;
    const double tangent = s < 50 * c ? s / c : 50;
    *along = view->offset_q16 + reach * b[3] * s;
    *towards = b[0] | b[1] | b[3] ? reach * (b[0] + b[1] * tangent) : 0;
}

static void test_directional(void)
{
    rng r = {3};
    int grazing = 0;
    for (int n = 0; n < 4000; n++) {
        gn_light_view view = {0};
        int32_t normal[3], out[3];
        double along, towards;
        random_biases(&r, &view);
        for (int i = 0; i < 3; i++) random_unit(&r, view.axis_q30[i]);
        random_unit(&r, one.frame.light[0].to_light_q30);
        random_unit(&r, normal);
        if (n % 4 == 0) /* at right angles to the light, nearly */
            for (int i = 0; i < 3; i++) normal[i] = i ? 0 : 1 << 30, one.frame.light[0].to_light_q30[0] = n << 12;
        const double cosine = dot(normal, one.frame.light[0].to_light_q30);
        terms(&view, cosine, &along, &towards);
        grazing += cosine > 0 && cosine < 0.02;
        gn_bias_directional(&one.frame, &view, normal, out);
        for (int i = 0; i < 3; i++) {
            const double want = dot(normal, view.axis_q30[i]) * along - (i == 2 ? towards : 0);
            /* a term's rounding counts reach times, and so does the tangent's, times b_y <= 8; the relative error of
             * the tangent is 2^-28, and the cosine's unit */
            const double rounding = 3 + 9 * (view.filter_idx + 1);
            CHECK_NEAR(out[i], want, rounding + towards * ldexp(1, -28) * (1 + 1 / fmax(fabs(cosine), 0.019)));
        }
    }
    CHECK(grazing > 100);
}

static void test_punctual(void)
{
    rng r = {5};
    int saturated = 0;
    for (int n = 0; n < 4000; n++) {
        gn_light_view *view = &one.frame.view[0];
        gn_light_state *state = &one.frame.light[0];
        int32_t normal[3], out[3], from[3];
        double along, towards, length = 0, z = 0;
        random_biases(&r, view);
        random_unit(&r, normal);
        random_unit(&r, state->to_light_q30);
        state->kind = (uint8_t)(n & 1 ? GN_LIGHT_POINT : GN_LIGHT_SPOT);
        state->view_idx = 0, view->light_idx = 0;
        view->fit.persp.texel_per_z = gn_bf_recip(gn_bf_from_u64(1 + rng_below(&r, 1 << (n % 9 ? 10 : 4))));
        for (int face = 1; face < 6; face++) one.frame.view[face] = *view; /* a face's texels may be its own */
        const double per_z = ldexp((double)gn_bf_apply(1 << 30, view->fit.persp.texel_per_z, 30), -60);
        for (int i = 0; i < 3; i++) {
            from[i] = rng_range(&r, -(1 << 30), 1 << 30) >> rng_below(&r, 16);
            length += (double)from[i] * from[i];
        }
        double cosine = 0;
        for (int i = 0; i < 3; i++) cosine -= ldexp(normal[i], -30) * from[i] / sqrt(length);
        if (fabs(cosine) < 0.03) continue; /* the tangent is steep there */
        if (state->kind == GN_LIGHT_SPOT) z = fmax(-dot(from, state->to_light_q30) * ldexp(1, 30), 0);
        else
            for (int i = 0; i < 3; i++) z = fmax(z, fabs((double)from[i]));
        terms(view, cosine, &along, &towards);
        gn_bias_punctual(&one.frame, state, normal, from, out);
        /* texels to units, at most 2^31 - 1 each, and the sum in 32 bits */
        along = fmin(along * z * per_z / 65536, 2147483647), towards = fmin(towards * z * per_z / 65536, 2147483647);
        for (int i = 0; i < 3; i++) {
            const double sum = along * ldexp(normal[i], -30) - towards * from[i] / sqrt(length);
            const double want = fmax(fmin(sum, 2147483647), -2147483648.0);
            saturated += along > 2147483646;
            /* a unit of the cosine is 2^-30 cos / sin of the sine; 5 of them at 0.03 are less than 2^-22; z is rounded
             */
            const double sine = fmax(sqrt(fmax(1 - cosine * cosine, 0)), ldexp(1, -15)), reach = view->filter_idx + 1;
            const double unit = ldexp(light.bias_receiver_q16[1] + light.bias_receiver_q16[3], -29) / sine;
            const double rounding = (3 + reach * (9 + unit)) * z * per_z / 65536;
            CHECK_NEAR(out[i], want, 4 + rounding + (along + towards) * (ldexp(1, -22) + 1 / fmax(z, 1)));
        }
    }
    CHECK(saturated > 50);
}

/* The position error of a directional light's receivers is at most 8 texels, whatever the distance. */
static void test_automatic_limit(void)
{
    const int delta = (1 << (15 - GN_CASTER_BITS(&one.frame))) + (1 << (15 - GN_FILTER_BITS(&one.frame)));
    gn_light_view view = {.tile_texels = 64, .border_lit = 1, .filter = GN_FILTER_HARD};
    int32_t before = 0;
    scene.shadow.max_distance_q16 = 8192 << 16, scene.camera.focal_q24 = GN_Q24(1);
    for (int i = 0; i < 32; i++) {
        view.fit.ortho.inv_texel = gn_bf_from_u64((uint64_t)1 << i);
        gn_bias_auto_view(&one.frame, &view);
        const int32_t place = view.offset_q16 - 32768 - delta - 2;
        CHECK(place >= 17 && place >= before && place <= 8 << 16);
        before = place;
    }
    CHECK_EQ_INT(before, 8 << 16);
}

/* Along the normal nothing is taken from the depth, but where a texel of the face is deeper than twice its distance:
 * near tau |m_u| > 2 h. Then all of it is. */
static void test_automatic_steep(void)
{
    gn_light_view view = {.tile_texels = 64, .perspective = 1, .axis_q30 = {{1 << 30}, {0, 1 << 30}, {0, 0, 1 << 30}}};
    int steep = 0, flat = 0;
    view.fit.persp.near_q16 = 1 << 12;
    view.fit.persp.texel_per_z = gn_bf_recip(gn_bf_from_u64(32)); /* 2 t / T */
    view.fit.persp.per_near = gn_bf_recip(gn_bf_from_u64(1 << 12));
    for (int axis = 0; axis < 2; axis++)
        for (int h = 1; h < 1 << 12; h += 1 + h / 16) { /* the face's distance from the light */
            const int32_t face[3] = {axis ? 0 : 1 << 30, axis ? 1 << 30 : 0, 0};
            const int32_t from[3] = {axis ? 0 : -h, axis ? -h : 0, 1 << 16};
            gn_auto_bias form = GN_AUTO_BIAS_NORMAL;
            int32_t moved[3];
            const int64_t less = gn_bias_auto_persp(&view, &form, face, 1 << 16, from, moved);
            if (form != GN_AUTO_BIAS_NORMAL) continue;
            const double change = (1 << 12) / 32.0;
            if (fabs(change - 2 * h) > 2) CHECK(less == (change > 2 * h ? (int64_t)1 << 33 : 0));
            steep += change > 2 * h, flat += change < 2 * h;
        }
    CHECK(steep > 10 && flat > 10);
}

/* A face and a point before it, of a view whose axes are the world's. */
typedef struct {
    int32_t face_q30[3], from_q16[3];
    double across, along, h; /* |m_u| + |m_v|, m_w; the face's distance from the light */
} lit_face;

static void random_face(rng *r, lit_face *f)
{
    double m[3], length = 0;
    f->h = 0;
    for (int i = 0; i < 3; i++) m[i] = rng_range(r, -1000, 1000) + 0.5, length += m[i] * m[i];
    for (int i = 0; i < 3; i++) {
        f->face_q30[i] = (int32_t)lrint(ldexp(m[i] / sqrt(length), 30));
        f->from_q16[i] = i < 2 ? rng_range(r, -(1 << 20), 1 << 20) : rng_range(r, 1 << 14, 1 << 20);
        f->h += ldexp((double)f->face_q30[i] * f->from_q16[i], -30);
    }
    f->h = fabs(f->h);
    f->across = ldexp(fabs((double)f->face_q30[0]) + fabs((double)f->face_q30[1]), -30);
    f->along = ldexp(f->face_q30[2], -30);
}

/* Along the normal z A / (1 - A max(0, m_w)), A = radius tau (|m_u| + |m_v|) + D_s h / n; by depth D_s + radius n tau
 * (|m_u| + |m_v|) / h. */
static void test_automatic_sizes(void)
{
    enum { NEAR = 1 << 13, STEP = 1 << 16 };
    gn_light_view view = {.tile_texels = 64, .perspective = 1, .axis_q30 = {{1 << 30}, {0, 1 << 30}, {0, 0, 1 << 30}}};
    rng r = {9};
    int n_normal = 0, n_depth = 0;
    view.fit.persp.near_q16 = NEAR, view.auto_step = STEP;
    view.fit.persp.texel_per_z = gn_bf_recip(gn_bf_from_u64(200));
    view.fit.persp.per_near = gn_bf_recip(gn_bf_from_u64(NEAR));
    for (int i = 0; i < 2000; i++) {
        lit_face f;
        int32_t moved[3];
        gn_auto_bias form = i % 2 ? GN_AUTO_BIAS_NORMAL : GN_AUTO_BIAS_DEPTH;
        random_face(&r, &f);
        view.offset_q16 = rng_range(&r, 1 << 15, 5 << 16);
        const double place = (double)gn_bias_auto_place_q16(&view, f.from_q16[2]), radius = view.offset_q16 / 65536.0;
        const double a = radius / 200 * f.across + ldexp(STEP, -32) * f.h / NEAR;
        const double lift = f.from_q16[2] * a / (1 - a * fmax(0, f.along));
        const int64_t less = gn_bias_auto_persp(&view, &form, f.face_q30, f.from_q16[2], f.from_q16, moved);
        const int by_depth = form == GN_AUTO_BIAS_DEPTH;
        n_normal += !by_depth, n_depth += by_depth;
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(moved[k] - f.from_q16[k], (place + (by_depth ? 0 : lift)) * ldexp(f.face_q30[k], -30),
                       3 + ldexp(lift, -20));
        if (!by_depth || f.h < 100) continue;
        const double slope = radius * NEAR / 200 * fmax(0.5, f.across) / f.h, want = STEP + ldexp(fmin(slope, 2), 32);
        CHECK_NEAR((double)less, want, 2 + want * 2 / f.h);
    }
    CHECK(n_normal > 500 && n_depth > 500);
}

/* The light in the plane of a surface, as far from it as there is room, a wide spot in a small tile: more than 64 bits
 * hold. The depth form takes twice the range, which lights everything. */
static void test_automatic_in_plane(void)
{
    gn_light_view view = {.perspective = 1, .tile_texels = 8, .offset_q16 = 9 << 16, .auto_step = 1 << 10};
    const int32_t face_q30[3] = {1 << 29, 929887697, 0}; /* cos 60, sin 60 degrees */
    view.fit.persp.near_q16 = NEAR_MOST_Q16;
    view.fit.persp.texel_per_z = gn_bf_recip(gn_bf_from_u64(1 << 10)); /* 2^6 texels of the light-plane distance */
    view.fit.persp.texel_per_z.exp += 17;
    view.fit.persp.per_near = gn_bf_recip(gn_bf_from_u64(NEAR_MOST_Q16));
    for (int i = 0; i < 3; i++) view.axis_q30[i][i] = 1 << 30;
    for (int32_t h_q16 = 0; h_q16 < 3; h_q16++)
        for (int form = GN_AUTO_BIAS_DEPTH; form <= GN_AUTO_BIAS_NORMAL; form++) {
            gn_auto_plane plane = {(gn_auto_bias)form, view.offset_q16, view.auto_step, 0, 0};
            const int32_t from_q16[3] = {2 * h_q16, 0, NEAR_MOST_Q16};
            gn_bias_auto_plane(&view, face_q30, from_q16, &plane);
            CHECK(plane.form == GN_AUTO_BIAS_DEPTH && plane.less_q32 == plane.step_q32 + ((int64_t)2 << 32));
        }
}

int main(void)
{
    const gn_picture p = {64, 64, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    CHECK(gn_init(&one, &p) == GN_OK);
    scene.lights = &light, scene.n_lights = 1;
    one.frame.scene = &scene;
    light.auto_bias = GN_AUTO_BIAS_OFF;
    test_reach();
    test_directional();
    test_punctual();
    test_automatic_limit();
    test_automatic_steep();
    test_automatic_sizes();
    test_automatic_in_plane();
    return check_report();
}
