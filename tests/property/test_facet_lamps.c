/* Spot and point lights on small triangles (NUMERICS 4.17): what is linear between the vertices, and how far it is off
 * at most, against the formulas in double. */
#include <math.h>
#include <stdlib.h>

#include "../lib/light/gn_punctual.h"
#include "../lib/shade/gn_corner.h"
#include "../lib/shade/gn_facet_punctual.h"
#include "../lib/shade/gn_facet_specular.h"
#include "../lib/shade/gn_lattice_cell.h"
#include "check.h"
#include "demo_scene.h"
#include "rng.h"

#if GN_INTERPOLATES && GN_PUNCTUAL_LIGHTS && GN_VERTEX_NORMALS

enum { WIDTH = 32, HEIGHT = 24, CASES = 60000, PER_SIDE = 9, LIMIT = 1 << 27 /* what irradiance is limited to */ };

static gn_renderer renderer;
static demo_scene demo;
static gn_shading shading;
static rng random_state = {40417};
static int n_lit, n_rims, n_dark, n_split, n_ranges, n_refused[2];
static double nearest_to_bound;

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * rng_u32(&random_state) / 4294967296.0;
}

static void direction(double out[3])
{
    double length = 0;
    while (length < 0.1 || length > 1) {
        length = 0;
        for (int i = 0; i < 3; i++) out[i] = uniform(-1, 1), length += out[i] * out[i];
    }
    for (int i = 0; i < 3; i++) out[i] /= sqrt(length);
}

static void no_pixels(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A triangle before the camera, smooth or flat. */
static void draw_triangle(gn_surface *s, double distance)
{
    const double size = distance * pow(2, uniform(-7, -1.5)), turn = rng_below(&random_state, 4) ? uniform(0, 0.8) : 0;
    double n[3];
    direction(n);
    for (int k = 0; k < 3; k++) {
        double own[3], length = 0;
        for (int i = 0; i < 3; i++) {
            s->v_q16[k][i] = (int32_t)lround(ldexp((i == 2 ? 20 : 0) + size * uniform(-1, 1), 16));
            own[i] = n[i] + turn * uniform(-1, 1);
            length += own[i] * own[i];
        }
        for (int i = 0; i < 3; i++) {
            const int32_t at = (int32_t)lround(ldexp((turn > 0 ? own[i] / sqrt(length) : n[i]) * 0.999999, 30));
            s->normal_q30[k][i] = at - (k ? s->normal_q30[0][i] : 0);
        }
    }
    s->smooth = turn > 0;
}

static void draw_light(const gn_frame *frame, gn_light *light, double distance)
{
    double away[3], aside[3];
    direction(away);
    direction(aside);
    const double outer = uniform(0.02, 3), wide = rng_below(&random_state, 3) ? uniform(0, 1) : 1;
    light->kind = rng_below(&random_state, 2) ? GN_LIGHT_SPOT : GN_LIGHT_POINT;
    light->outer_turn = (uint16_t)lround(outer / 6.283185307 * 65536);
    light->inner_turn = (uint16_t)lround(outer * wide / 6.283185307 * 65536);
    if (!light->inner_turn) light->inner_turn = 1;
    for (int i = 0; i < 3; i++) {
        light->position_q16[i] =
            frame->cam.eye_q16[i] +
            (int32_t)lround(ldexp(20 * ldexp(frame->cam.axis_q30[2][i], -30) + distance * away[i], 16));
        light->direction[i] = (int32_t)lround(ldexp(-away[i] + tan(outer / 4) * 1.5 * uniform(0, 1) * aside[i], 16));
        light->colour_uq16[i] = 65536;
    }
    light->colour_exp = (int8_t)lround(2 * log2(distance) + (rng_below(&random_state, 3) ? 0 : uniform(0, 5)));
    light->range_q16 =
        rng_below(&random_state, 3) ? 0 : (uint32_t)lround(ldexp(distance * pow(2, uniform(-0.1, 3)), 16));
}

/* The light of colour 1 at a point of the triangle, not divided by the normal's length, and the share of the rim. */
static double light_at(const gn_light_state *light, const gn_facet_vertices *v, const double b[3], double *rim)
{
    double from[3], n[3], to_light[3];
    for (int i = 0; i < 3; i++) {
        from[i] = n[i] = 0;
        for (int k = 0; k < 3; k++) {
            from[i] += b[k] * ldexp((double)v->ray_q16[k][i] + (double)light->from_light[i].d_q16, -16);
            n[i] += b[k] * ldexp(v->normal_q30[k][i], -30);
        }
        to_light[i] = ldexp(light->to_light_q30[i], -30);
    }
    const double d2 = dot(from, from), range2 = ldexp((double)light->range2_q32, -32);
    double window = 1;
    *rim = 1;
    if (light->kind == GN_LIGHT_SPOT)
        *rim = (-dot(from, to_light) / sqrt(d2) - ldexp(light->cos_outer_q30, -30)) *
               ldexp((double)light->angle_scale.mant, light->angle_scale.exp + 30);
    if (light->range2_q32 != UINT64_MAX) window = d2 < range2 ? pow(1 - d2 * d2 / (range2 * range2), 2) : 0;
    return ldexp(-dot(n, from) / (d2 * sqrt(d2)) * window, light->colour_exp + 24);
}

static double squared(double rim)
{
    return pow(fmax(0, fmin(rim, 1)), 2);
}

static void compare(const gn_light_state *light, const gn_facet_vertices *v, const gn_facet_lamp *lamp, int dark)
{
    double nearest2 = 1e30;
    for (int k = 0; k < 3; k++) {
        if (!dark && abs(lamp->irradiance_q24[k]) == LIMIT) return; /* cells are asked about limits */
        double d2 = 0;
        for (int i = 0; i < 3; i++)
            d2 += pow(ldexp((double)v->ray_q16[k][i] + (double)light->from_light[i].d_q16, -16), 2);
        nearest2 = fmin(nearest2, d2);
    }
    double share = ldexp(1, -13); /* a rim's cosine is off by half a unit of length, 4.10 */
    if (light->kind == GN_LIGHT_SPOT)
        share +=
            2 * ldexp(1, -16) / sqrt(nearest2) * ldexp((double)light->angle_scale.mant, light->angle_scale.exp + 30);
    const double full = ldexp(1 / nearest2, light->colour_exp + 24), rounding = full * share + 4;
    double worst = 0;
    for (int i = 0; i <= PER_SIDE; i++)
        for (int j = 0; i + j <= PER_SIDE; j++) {
            const double b[3] = {1 - (double)(i + j) / PER_SIDE, (double)i / PER_SIDE, (double)j / PER_SIDE};
            double rim, linear = 0, linear_rim = 0;
            const double e = light_at(light, v, b, &rim);
            for (int k = 0; k < 3; k++) {
                linear += b[k] * lamp->irradiance_q24[k];
                linear_rim += b[k] * ldexp(lamp->rim_q20[k], -20);
            }
            if (!lamp->has_rim) linear_rim = 1;
            const double is = fmin(fmax(0, e) * squared(rim), LIMIT),
                         says = dark ? 0 : fmax(0, linear) * squared(linear_rim);
            worst = fmax(worst, fabs(is - says) - rounding);
        }
    nearest_to_bound = fmax(nearest_to_bound, worst / (lamp->error_q24 + 1.0));
    CHECK(worst <= lamp->error_q24);
}

/* What may be off is half as much with each size, so that a larger triangle is refused no later; nothing else changes.
 */
static void compare_sizes(const gn_facet_vertices *v, int said)
{
    for (int32_t size_log2 = 1; size_log2 <= 2; size_log2++) {
        gn_facet_lamp lamp = {.error_q24 = 0};
        const int larger = gn_facet_punctual(&shading, v, 0, 1 << 24, size_log2, &lamp);
        CHECK(larger == said || larger == GN_CELL_SPLIT);
        n_refused[size_log2 - 1] += said != GN_CELL_SPLIT && larger == GN_CELL_SPLIT;
    }
}

static int n_shining, n_dull, n_opposite;
static double brightest, brightest_opposite;

static void normalise(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++) v[i] /= length;
}

/* (n . h)^2^k at a point of the triangle. */
static double highlight_at(const gn_light_state *light, const gn_facet_vertices *v, const double b[3])
{
    double n[3], to_eye[3], h[3];
    for (int i = 0; i < 3; i++) {
        n[i] = to_eye[i] = 0;
        for (int k = 0; k < 3; k++) {
            n[i] += b[k] * v->normal_q30[k][i];
            to_eye[i] -= b[k] * v->ray_q16[k][i];
        }
        h[i] = light->kind == GN_LIGHT_DIRECTIONAL ? light->to_light_q30[i]
                                                   : to_eye[i] - (double)light->from_light[i].d_q16;
    }
    normalise(n);
    normalise(to_eye);
    normalise(h);
    for (int i = 0; i < 3; i++) h[i] += to_eye[i];
    normalise(h);
    return pow(fmax(0, dot(n, h)), ldexp(1, shading.surface.object->shininess_log2));
}

/* The brightest highlight of the light in the triangle, if it is said that none is seen; else 0. */
static double unseen_highlight(const gn_light_state *light, const gn_facet_vertices *v)
{
    static gn_object object;
    double most = 0;
    object.shininess_log2 = (uint8_t)rng_below(&random_state, 8);
    shading.surface.object = &object;
    const int shines = gn_facet_shines(&shading, 0);
    n_shining += shines;
    n_dull += !shines;
    for (int i = 0; !shines && i <= PER_SIDE; i++)
        for (int j = 0; i + j <= PER_SIDE; j++) {
            const double b[3] = {1 - (double)(i + j) / PER_SIDE, (double)i / PER_SIDE, (double)j / PER_SIDE};
            most = fmax(most, highlight_at(light, v, b));
        }
    return most;
}

static void try_highlight(gn_light_state *light, const gn_facet_vertices *v)
{
    const uint8_t kind = light->kind;
    if (rng_below(&random_state, 2)) light->kind = GN_LIGHT_DIRECTIONAL;
    brightest = fmax(brightest, unseen_highlight(light, v));
    light->kind = kind;
}

/* Eye and light nearly opposite, normals near the half vectors: those turn fast, and not evenly. */
static void try_opposite(gn_frame *frame)
{
    static const uint32_t unknown[3] = {0, 0, 0};
    gn_surface *s = &shading.surface;
    gn_light_state *light = &frame->light[0];
    gn_facet_vertices v;
    double aside[3], to_side[3], to_light[3];
    draw_triangle(s, pow(2, uniform(-5, 4)));
    if (!CHECK(gn_facet_vertices_find(&v, frame, s, unknown))) return;
    const double apart = uniform(0.02, 1), off = uniform(0, 1.5), turn = uniform(0, 0.2);
    direction(aside);
    direction(to_side);
    for (int k = 0; k < 3; k++) {
        double to_eye[3], n[3], own[3];
        for (int i = 0; i < 3; i++) to_eye[i] = -v.ray_q16[k][i];
        normalise(to_eye);
        for (int i = 0; i < 3 && !k; i++) to_light[i] = apart * aside[i] - to_eye[i];
        if (!k) normalise(to_light);
        for (int i = 0; i < 3; i++) n[i] = to_light[i] + to_eye[i];
        normalise(n);
        direction(own);
        for (int i = 0; i < 3; i++) n[i] += off * to_side[i] + turn * own[i];
        normalise(n);
        for (int i = 0; i < 3; i++) {
            light->to_light_q30[i] = (int32_t)lround(ldexp(to_light[i] * 0.9999999, 30));
            v.normal_q30[k][i] = (int32_t)lround(ldexp(n[i] * 0.999999, 30));
            s->normal_q30[k][i] = v.normal_q30[k][i] - (k ? v.normal_q30[0][i] : 0);
        }
    }
    s->smooth = 1;
    light->kind = GN_LIGHT_DIRECTIONAL;
    const double most = unseen_highlight(light, &v);
    n_opposite += most > 0;
    brightest_opposite = fmax(brightest_opposite, most);
}

static void try_case(gn_frame *frame)
{
    static const uint32_t unknown[3] = {0, 0, 0};
    gn_surface *s = &shading.surface;
    gn_light *light = &demo.light[0];
    gn_facet_vertices v;
    gn_facet_lamp lamp = {.error_q24 = 0};
    uint32_t turn_q28[3] = {unknown[0], unknown[1], unknown[2]};
    const double distance = pow(2, uniform(-2, 5));
    draw_triangle(s, distance);
    draw_light(frame, light, distance);
    frame->light[0].kind = (uint8_t)light->kind;
    double axis[3], length = 0;
    for (int i = 0; i < 3; i++) axis[i] = light->direction[i], length += axis[i] * axis[i];
    for (int i = 0; i < 3; i++)
        frame->light[0].to_light_q30[i] = (int32_t)lround(ldexp(-axis[i] / sqrt(length), 30) * 0.9999999);
    gn_punctual_setup(frame, 0);
    for (int k = 0; k < 3; k++)
        for (int i = 0; s->smooth && i < 3; i++) {
            const int32_t *n1 = s->normal_q30[1], *n2 = s->normal_q30[2];
            const double d = ldexp(k == 0 ? n1[i] : k == 1 ? n2[i] : (double)n2[i] - n1[i], -30);
            turn_q28[k] += (uint32_t)lround(ldexp(d * d, 28));
        }
    if (!CHECK(gn_facet_vertices_find(&v, frame, s, turn_q28))) return;
    try_highlight(&frame->light[0], &v);
    const int said = gn_facet_punctual(&shading, &v, 0, 1 << 24, 0, &lamp);
    compare_sizes(&v, said);
    if (said == GN_CELL_SPLIT) {
        n_split++;
        if (lamp.error_q24) compare(&frame->light[0], &v, &lamp, 0); /* not told before it is known */
        return;
    }
    if (said == GN_CELL_DARK) n_dark++;
    else {
        n_lit++;
        n_rims += lamp.has_rim;
        n_ranges += light->range_q16 != 0;
    }
    compare(&frame->light[0], &v, &lamp, said == GN_CELL_DARK);
}

/* A light that is dimmer by a power of two is, to half of the last bit, down to none at all; brighter, it is limited.
 */
static void test_exponents(gn_light_state *light)
{
    static const int32_t from[3] = {3 << 16, 1 << 16, -(5 << 16)};
    static gn_corner_light scratch;
    const uint64_t d2 = (uint64_t)gn_dot64(from, from);
    int32_t brighter = LIMIT, n_between = 0;
    light->kind = GN_LIGHT_POINT;
    light->range2_q32 = UINT64_MAX;
    for (int exp = 100; exp >= -100; exp--) {
        light->colour_exp = (int8_t)exp;
        const int32_t e = gn_corner_irradiance(&renderer.frame, light, from, d2, 4 << 16, &scratch, NULL);
        CHECK(e == brighter >> 1 || (brighter == LIMIT && e > LIMIT / 2 && e <= LIMIT));
        n_between += e > 0 && e < LIMIT;
        brighter = e;
    }
    CHECK(brighter == 0 && n_between > 20);
}

/* What lies 2^30 away is not told by vertices. */
static void test_reach(gn_light_state *light)
{
    static const uint32_t turns[3] = {0, 0, 0};
    gn_facet_vertices v;
    gn_facet_lamp lamp;
    draw_triangle(&shading.surface, 1);
    if (!CHECK(gn_facet_vertices_find(&v, &renderer.frame, &shading.surface, turns))) return;
    for (int i = 0; i < 3; i++) light->from_light[i].d_q16 = 0;
    light->kind = GN_LIGHT_POINT;
    light->range2_q32 = UINT64_MAX;
    light->colour_exp = 26;
    for (int i = 0; i < 6; i++) {
        const int32_t side = i % 2 ? 1 : -1;
        for (int k = 0; k < 3; k++) v.normal_q30[k][i / 2] = -side * (1 << 29);
        light->from_light[i / 2].d_q16 = side * ((1 << 30) - (100 << 16));
        CHECK(gn_facet_punctual(&shading, &v, 0, 1 << 24, 0, &lamp) == GN_CELL_LIT);
        light->from_light[i / 2].d_q16 = side * ((1 << 30) + (100 << 16));
        CHECK(gn_facet_punctual(&shading, &v, 0, 1 << 24, 0, &lamp) == GN_CELL_SPLIT);
        light->from_light[i / 2].d_q16 = 0;
        for (int k = 0; k < 3; k++) v.normal_q30[k][i / 2] = 0;
    }
}

int main(void)
{
    const gn_picture target = {.width = WIDTH, .height = HEIGHT, .format = GN_FORMAT_RGB888};
    demo_scene_make(&demo, 1);
    if (!CHECK(gn_init(&renderer, &target) == GN_OK)) return check_report();
    if (!CHECK(gn_render(&renderer, &demo.scene, no_pixels, NULL) == GN_OK)) return check_report();
    shading.frame = &renderer.frame;
    shading.surface.light[0].state = &renderer.frame.light[0];
    for (int c = 0; c < 3; c++) shading.surface.light[0].radiance_uq16[c] = 65536;
    shading.surface.n_lights = shading.surface.n_punctual = 1;
    for (int i = 0; i < CASES; i++) try_case(&renderer.frame);
    test_exponents(&renderer.frame.light[0]);
    test_reach(&renderer.frame.light[0]);
    printf("%d lit, %d of them in a rim, %d with a range; %d dark, %d split; off by up to %.2f of the bound\n", n_lit,
           n_rims, n_ranges, n_dark, n_split, nearest_to_bound);
    CHECK(n_lit > 5000 && n_rims > 1000 && n_ranges > 1000 && n_dark > 1000 && n_split > 1000);
    CHECK(n_shining > 5000 && n_dull > 5000 && brightest <= exp(-7));
    for (int i = 0; i < CASES; i++) try_opposite(&renderer.frame);
    printf("highlights: %d, %d without any; there up to %.6f, %.6f where eye and light are opposite\n", n_shining,
           n_dull, brightest, brightest_opposite);
    CHECK(n_opposite > 1000 && brightest_opposite <= exp(-6));
    CHECK(n_refused[0] > 100 && n_refused[1] > n_refused[0] + 100);
    return check_report();
}

#else

int main(void)
{
    return check_report();
}

#endif
