/* What arrives from spot and point lights between two samples (gn_arrival) against the formulas at every pixel, in
 * double: what NUMERICS 4.13 allows. The points lie on a plane, a chord apart; the formulas are those of the
 * specification, with nothing of the library's. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "knobs.h"
#include "shade/gn_arrival.h"
#include "shade/gn_chord.h"
#include "light_scene.h"

enum { W = 96, H = 64 };

static gn_renderer fresh;
static light_scene ls;
static gn_surface surface;

typedef struct {
    double irradiance, u, v;
} arrived;

static double random_of(rng *r, double lo, double hi)
{
    return lo + (hi - lo) * rng_below(r, 1U << 30) / (1U << 30);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamped(double v)
{
    return fmin(fmax(v, 0), 1);
}

/* P2, P3 of a light of colour 1 */
static double irradiance_of(const gn_light *light, const double axis[3], const double p[3], double facing)
{
    const double d2 = dot(p, p), ratio = d2 / pow(light->range_q16 / 65536.0, 2),
                 window = pow(clamped(1 - ratio * ratio), 2);
    double angle = 1;
    if (light->kind == GN_LIGHT_SPOT) {
        const double outer = cos(light->outer_turn * 3.14159265358979323846 / 65536),
                     inner = cos(light->inner_turn * 3.14159265358979323846 / 65536);
        angle = pow(clamped((dot(p, axis) / sqrt(d2) - outer) / fmax(inner - outer, 1e-4)), 2);
    }
    return window * angle * facing / sqrt(d2) / fmax(d2, 1e-4) * ldexp(1, fresh.frame.light[0].colour_exp);
}

static arrived exact_at(const gn_light *light, int face, const double p[3], double facing)
{
    const gn_light_view *view = &fresh.frame.view[fresh.frame.light[0].view_idx + face];
    double at[3], axis[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        double k[3];
        for (int c = 0; c < 3; c++) k[c] = view->axis_q30[i][c] * 0x1p-30;
        at[i] = dot(p, k);
        if (i == 2) memcpy(axis, k, sizeof axis);
    }
    const double half = view->tile_texels / 2.0, scale = view->fit.persp.focal2_q16 / 65536.0 / 2;
    arrived a = {irradiance_of(light, axis, p, facing), half + scale * at[0] / at[2], half + scale * at[1] / at[2]};
    return a;
}

/* How far a receiver is from the plane n . p = -height, Q16 units. */
static double off_plane(const gn_light *light, int face, const gn_arrival *at, const double n[3], double height)
{
    const gn_light_view *view = &fresh.frame.view[fresh.frame.light[0].view_idx + face];
    const double half = view->tile_texels / 2.0, scale = view->fit.persp.focal2_q16 / 65536.0 / 2;
    const double x = (at->u_q16 / 65536.0 - half) / scale, y = (at->v_q16 / 65536.0 - half) / scale;
    const double z = light->near_q16 / 65536.0 / (1 - at->depth_q32 * 0x1p-32);
    double p[3];
    for (int i = 0; i < 3; i++)
        p[i] = z * (view->axis_q30[0][i] * x + view->axis_q30[1][i] * y + view->axis_q30[2][i]) * 0x1p-30;
    return fabs(dot(n, p) + height) * 65536;
}

static void begin_light(rng *r)
{
    gn_picture picture = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    ls_begin(&ls);
    gn_light *light = ls_add_random_light(&ls, r, rng_below(r, 2) ? GN_LIGHT_POINT : GN_LIGHT_SPOT);
    light->auto_bias = GN_AUTO_BIAS_OFF;
    light->near_q16 = rng_range(r, 2000, GN_Q16(0.5));
    light->range_q16 = (uint32_t)rng_range(r, GN_Q16(4), GN_Q16(30));
    CHECK_EQ_INT(gn_init(&fresh, &picture), GN_OK);
    SET_KNOB(&fresh.frame, newton_steps, 2);
    SET_KNOB(&fresh.frame, persp_step, 16);
    SET_KNOB(&fresh.frame, other_atlas_size, light->kind == GN_LIGHT_POINT ? 512 : 128); /* 128 texels a tile */
    CHECK_EQ_INT(gn_begin(&fresh, &ls.scene), GN_OK);
    for (size_t i = 0; i < sizeof fresh.frame.other_block / sizeof *fresh.frame.other_block; i++)
        fresh.frame.other_block[i] = (gn_depth_block){0, UINT16_MAX}; /* nothing is decided */
}

/* A sample at a point of the plane n . p = -height as the light sees it. Returns n . (light - point). */
static double put(gn_sample *s, const double p[3], const double n[3])
{
    const double facing = -dot(n, p);
    memset(s, 0, sizeof *s);
    s->value[GN_VALUE_Z] = GN_Q16(5);
    for (int i = 0; i < 3; i++) s->value[GN_VALUE_LIGHT + GN_LIGHT_POINT_AT + i] = (int32_t)floor(p[i] * 65536 + 0.5);
    s->value[GN_VALUE_LIGHT + GN_LIGHT_FACING] = (int32_t)floor(facing * 65536 + 0.5);
    return facing;
}

static struct {
    double irradiance, texels, off_plane; /* the last in LSB per pixel of the chord */
    long held, tried;
} seen_of[2], *seen = seen_of; /* spot, point */

static struct {
    long held, tried; /* of those that are dark all along */
    long wrong;       /* pixels that something is said to arrive at nevertheless */
    double brightest; /* of 1 / d^2, in those that held */
} dark_of[2], *dark = dark_of;

/* Nothing arrives at either end: nothing must where that is taken for all that lies between. */
static void check_dark(gn_chord *chord, gn_sample *here, const gn_sample *next, const double a[3], const double b[3],
                       const double n[3], int32_t px)
{
    double brightest = 0;
    gn_arrivals_between(chord, &fresh.frame, &surface, here, next, px);
    for (int32_t k = 1; k < px; k++) {
        double p[3];
        for (int i = 0; i < 3; i++) p[i] = a[i] + (b[i] - a[i]) * k / px;
        const arrived exact = exact_at(&ls.light[0], 0, p, -dot(n, p));
        brightest = fmax(brightest, exact.irradiance * dot(p, p) / ldexp(1, fresh.frame.light[0].colour_exp));
        gn_arrivals_next(chord, &fresh.frame, &surface, here);
        dark->wrong += chord->arrival[0].holds && here->arrival[0].reaches;
    }
    dark->tried += brightest == 0;
    dark->held += chord->arrival[0].holds;
    if (chord->arrival[0].holds) dark->brightest = fmax(dark->brightest, brightest);
}

/* Two points and what lies between them. */
static void check_chord(rng *r)
{
    const gn_light *light = &ls.light[0];
    double a[3], b[3], n[3], length = 0;
    const double d = random_of(r, 0.6, 1.2 * light->range_q16 / 65536.0), moved = d * pow(2, -random_of(r, 2, 7));
    for (int i = 0; i < 3; i++) n[i] = random_of(r, -1, 1), a[i] = random_of(r, -1, 1), length += a[i] * a[i];
    for (int i = 0; i < 3; i++) a[i] *= d / sqrt(length);
    length = sqrt(dot(n, n)) * (dot(n, a) > 0 ? -1 : 1);
    for (int i = 0; i < 3; i++) n[i] /= length;
    double way[3], along = 0;
    for (int i = 0; i < 3; i++) way[i] = random_of(r, -1, 1);
    along = dot(way, n);
    for (int i = 0; i < 3; i++) way[i] -= along * n[i];
    length = sqrt(dot(way, way));
    for (int i = 0; i < 3; i++) b[i] = a[i] + way[i] * moved / length;
    gn_sample here, next;
    gn_chord chord;
    const int32_t px = 3 + (int32_t)rng_below(r, 14);
    put(&here, a, n);
    put(&next, b, n);
    if (!gn_chord_between(&chord, &fresh.frame, &surface, &here, &next, px)) return;
    gn_arrivals_at(&fresh.frame, &surface, &here);
    gn_arrivals_at(&fresh.frame, &surface, &next);
    if (!here.arrival[0].reaches && !next.arrival[0].reaches && dot(n, a) < -0x1p-12)
        check_dark(&chord, &here, &next, a, b, n, px);
    if (!here.arrival[0].reaches) return;
    const int face = here.arrival[0].face;
    seen->tried++;
    gn_arrivals_between(&chord, &fresh.frame, &surface, &here, &next, px);
    if (!chord.arrival[0].holds || face == GN_FACE_NONE) return;
    seen->held++;
    for (int32_t k = 1; k < px; k++) {
        double p[3];
        gn_chord_next(&chord, here.value, surface.first_value);
        gn_arrivals_next(&chord, &fresh.frame, &surface, &here);
        for (int i = 0; i < 3; i++) p[i] = a[i] + (b[i] - a[i]) * k / px;
        const arrived exact = exact_at(light, face, p, -dot(n, p));
        const gn_arrival *is = &here.arrival[0];
        const double scale = ldexp(1, fresh.frame.light[0].colour_exp) / dot(p, p);
        seen->irradiance = fmax(seen->irradiance, fabs(is->irradiance_q24 * 0x1p-24 - exact.irradiance) / scale);
        if (is->shadow != GN_SHADOW_UNDECIDED) continue;
        seen->texels =
            fmax(seen->texels, fmax(fabs(is->u_q16 / 65536.0 - exact.u), fabs(is->v_q16 / 65536.0 - exact.v)));
        seen->off_plane = fmax(seen->off_plane, off_plane(light, face, is, n, -dot(n, a)) / px);
    }
}

int main(void)
{
    rng r = {23};
    surface.n_lights = surface.n_punctual = surface.shadowed = 1;
    surface.first_value = GN_VALUE_Z;
    surface.n_values = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT;
    surface.light[0].state = &fresh.frame.light[0];
    for (int i = 0; i < 300; i++) {
        begin_light(&r);
        seen = &seen_of[ls.light[0].kind == GN_LIGHT_POINT];
        dark = &dark_of[seen == &seen_of[1]];
        for (int k = 0; k < 400; k++) check_chord(&r);
    }
    for (int k = 0; k < 2; k++) {
        seen = &seen_of[k];
        printf("%s, between samples, %ld of %ld chords: irradiance off by %.5f of 1 / d^2, places by %.4f texels; %.2f "
               "LSB per pixel of the chord off the plane\n",
               k ? "point" : "spot", seen->held, seen->tried, seen->irradiance, seen->texels, seen->off_plane);
        CHECK(2 * seen->held > seen->tried);
        CHECK(seen->irradiance <= 0x1p-8 && 0x1p-8 < 8 * seen->irradiance);
        CHECK((seen->texels <= 0x1p-6 && 0x1p-6 < 8 * seen->texels) || !GN_RUNTIME_KNOBS);
        CHECK(seen->off_plane <= 1 && 1 < 8 * seen->off_plane);
        printf(
            "    dark at both ends: %ld of %ld that are dark all along are known to be, with %g of 1 / d^2 at most\n",
            dark_of[k].held, dark_of[k].tried, dark_of[k].brightest);
        CHECK(dark_of[k].brightest == 0 && dark_of[k].wrong == 0);
        CHECK(2 * dark_of[k].held > dark_of[k].tried);
    }
    return check_report();
}
