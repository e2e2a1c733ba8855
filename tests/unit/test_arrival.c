/* What arrives at a point from a spot or point light (gn_punctual_at, gn_corner_place_any), against the formulas of the
 * specification, in double: where it ends, which view sees the point, and where. How much arrives is in
 * test_punctual.c. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "exact.h"
#include "knobs.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_surface.h"
#include "light_scene.h"

enum { W = 96, H = 64 };

static gn_renderer fresh;
static light_scene ls;
static gn_surface surface;
static gn_lattice lattice;

static double random_of(rng *r, double lo, double hi)
{
    return lo + (hi - lo) * rng_below(r, 1U << 30) / (1U << 30);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double half_cosine(uint16_t turn)
{
    return cos(turn * 3.14159265358979323846 / 65536);
}

static const gn_light_view *view_of(int face)
{
    return &fresh.frame.view[fresh.frame.light[0].view_idx + face];
}

/* A point along a view's axes. */
static void along_axes(const gn_light_view *view, const double p[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        double axis[3];
        for (int k = 0; k < 3; k++) axis[k] = view->axis_q30[i][k] * 0x1p-30;
        out[i] = dot(p, axis);
    }
}

static void begin_light(rng *r, int auto_bias)
{
    gn_picture picture = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    ls_begin(&ls);
    gn_light *light = ls_add_random_light(&ls, r, rng_below(r, 2) ? GN_LIGHT_POINT : GN_LIGHT_SPOT);
    light->auto_bias = auto_bias ? GN_AUTO_BIAS_NORMAL : GN_AUTO_BIAS_OFF;
    light->bias_normal_q16 = 0;
    light->near_q16 = rng_range(r, 2000, GN_Q16(0.5));
    light->range_q16 = (uint32_t)rng_range(r, GN_Q16(4), GN_Q16(30));
    CHECK_EQ_INT(gn_init(&fresh, &picture), GN_OK);
    SET_KNOB(&fresh.frame, persp_step, 1);
    SET_KNOB(&fresh.frame, other_atlas_size, light->kind == GN_LIGHT_POINT ? 512 : 128); /* 128 texels a tile */
    CHECK_EQ_INT(gn_begin(&fresh, &ls.scene), GN_OK);
}

/* ---- Where it ends ----------------------------------------------------------------------------------------------- */

/* Not at all, through the rim of a cone, fully. */
enum { NOT, RIM, FULLY };

/* How a light arrives, and by how much that is certain, as a share of 1. */
static int how_it_arrives(const gn_light *light, const double p[3], double *certain)
{
    const double d2 = dot(p, p), range = light->range_q16 / 65536.0;
    *certain = fabs(1 - d2 / (range * range));
    if (d2 >= range * range) return NOT;
    if (light->kind == GN_LIGHT_POINT) return FULLY;
    double at[3];
    along_axes(view_of(0), p, at);
    const double outer = half_cosine(light->outer_turn), inner = half_cosine(light->inner_turn);
    const double share = (at[2] / sqrt(d2) - outer) / (inner - outer);
    *certain = fmin(*certain, fmin(fabs(share), fabs(share - 1)));
    return share <= 0 ? NOT : share < 1 ? RIM : FULLY;
}

/* A random point of the light's surroundings, from the light. */
static void random_point(rng *r, int32_t from_q16[3], double p[3])
{
    const double d = random_of(r, 0.02, 1.2 * ls.light[0].range_q16 / 65536.0);
    double length = 0;
    for (int i = 0; i < 3; i++) p[i] = random_of(r, -1, 1), length += p[i] * p[i];
    for (int i = 0; i < 3; i++) {
        from_q16[i] = (int32_t)floor(p[i] * d / sqrt(length) * 65536 + 0.5);
        p[i] = from_q16[i] / 65536.0;
    }
}

static long n_arrives[2][3]; /* spot, point */

/* The rounding of a step's root is 2^-28; a window of less than 2^-15 is lost in a factor of 30 bits. */
static void check_ends(rng *r, tally *class)
{
    int32_t from_q16[3];
    double p[3], certain;
    gn_punctual_point point;
    random_point(r, from_q16, p);
    const int want = how_it_arrives(&ls.light[0], p, &certain),
              any = gn_punctual_at(&fresh.frame, &fresh.frame.light[0], from_q16, &point),
              is = !any                                                       ? NOT
                   : ls.light[0].kind == GN_LIGHT_SPOT && !point.within_inner ? RIM
                                                                              : FULLY;
    n_arrives[ls.light[0].kind == GN_LIGHT_POINT][want]++;
    if (certain > 0x1p-12) HOLDS(class, is == want, "%d at (%g %g %g)", is, p[0], p[1], p[2]);
}

static void test_ends(void)
{
    rng r = {23};
    tally class = {0};
    for (int i = 0; i < 200; i++) {
        begin_light(&r, 0);
        for (int k = 0; k < 300; k++) check_ends(&r, &class);
    }
    CHECK_TALLY(class, "what bends the light is what the formula says");
    for (int k = 0; k < 3; k++) CHECK(n_arrives[0][k] > 300 && (k == RIM || n_arrives[1][k] > 300));
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

/* A point that a view sees must be where the formula says: NUMERICS 4.10, with two steps. */
static int is_near(const gn_light_view *view, const gn_corner_light *is, const double at[3])
{
    const double scale = view->fit.persp.focal2_q16 / 65536.0 / 2, half = view->tile_texels / 2.0,
                 share = view->fit.persp.near_q16 / 65536.0 / at[2], z_q16 = at[2] * 65536;
    for (int i = 0; i < 2; i++) {
        const double beside = scale * at[i] / at[2], u = (i ? is->v_q16 : is->u_q16) / 65536.0;
        const double bound = (fabs(beside) * (0x1p-29 + 0.5 / z_q16) + 0.5 * scale / z_q16) * 1.004 + scale * 0x1p-29;
        if (fabs(u - half - beside) > bound + 0x1p-17) return 0;
    }
    return fabs(is->depth_q30 * 0x1p-30 - (1 - share)) <= share * (0x1p-29 + 0.5 / z_q16) * 1.004 + 7 * 0x1p-32;
}

static long n_seen, n_not_seen;

/* Asks where a view sees a point. Returns what gn_corner_place_any() does. */
static int place_in(const gn_light_view *view, const int32_t from_q16[3], gn_corner_light *is)
{
    gn_corner *c = &lattice.corner;
    c->z_q16 = GN_Q16(5);
    for (int i = 0; i < 3; i++) c->ray_q16[i] = from_q16[i] - (int32_t)fresh.frame.light[0].from_light[i].d_q16;
    const int seen = gn_corner_place_any(&lattice, &fresh.frame, &surface, c, 0, view);
    *is = c->light[0];
    return seen;
}

/* Any view of the light may be asked for a point, also one of another face. */
static void check_place(rng *r, tally *place, tally *seen)
{
    gn_corner_light is;
    int32_t from_q16[3];
    double p[3], at[3];
    const int asked = ls.light[0].kind == GN_LIGHT_POINT ? (int)rng_below(r, 6) : 0;
    random_point(r, from_q16, p);
    along_axes(view_of(asked), p, at);
    const double near = ls.light[0].near_q16 / 65536.0, beyond = fmax(fabs(at[0]), fabs(at[1])) / at[2];
    const int visible = place_in(view_of(asked), from_q16, &is);
    if (fabs(at[2] - near) > 0x1p-16) HOLDS(seen, visible == (at[2] > near), "%d: %g of %g", visible, at[2], near);
    n_seen += visible;
    n_not_seen += !visible;
    if (visible && beyond < 8)
        HOLDS(place, is_near(view_of(asked), &is, at), "(%d %d %u) of (%g %g %g)", (int)is.u_q16, (int)is.v_q16,
              (unsigned)is.depth_q30, at[0], at[1], at[2]);
}

static void test_places(void)
{
    rng r = {24};
    tally place = {0}, seen = {0};
    for (int i = 0; i < 200; i++) {
        begin_light(&r, 0);
        for (int k = 0; k < 300; k++) check_place(&r, &place, &seen);
    }
    CHECK_TALLY(place, "places are where the formula says");
    CHECK_TALLY(seen, "points are seen beyond the near plane");
    CHECK(n_seen > 10000 && n_not_seen > 10000);
}

/* ---- Automatic bias at the rim ----------------------------------------------------------------------------------- */

#if GN_AUTO_BIAS
/* Along the normal a point of a tile's rim would leave the tile: there it stays on its ray, a little nearer. */
static void test_rim(void)
{
    rng r = {25};
    tally stays = {0};
    long n_rim = 0;
    for (int i = 0; i < 200; i++) {
        begin_light(&r, 1);
        const gn_light_view *view = view_of(0);
        const double scale = view->fit.persp.focal2_q16 / 65536.0 / 2, half = view->tile_texels / 2.0;
        for (int k = 0; k < 100; k++) {
            const double z = random_of(&r, 2, 5), in[3] = {half / scale * z * random_of(&r, 0.9, 0.9999),
                                                           half / scale * z * random_of(&r, -0.9, 0.9), z};
            int32_t from[3];
            double p[3], at[3], length = 0;
            gn_corner_light is;
            for (int c = 0; c < 3; c++) {
                double v = 0;
                for (int a = 0; a < 3; a++) v += in[a] * view->axis_q30[a][c] * 0x1p-30;
                from[c] = (int32_t)floor(v * 65536);
                p[c] = from[c] / 65536.0;
                length += v * v;
            }
            /* a face that looks at the light from the side: along its normal the point goes outwards */
            for (int c = 0; c < 3; c++)
                surface.face_q30[c] = (int32_t)(0x1p30 * (0.8 * view->axis_q30[0][c] * 0x1p-30 - 0.6 * p[c] / z) /
                                                sqrt(0.64 + 0.36 * length / (z * z) - 0.96 * in[0] / z));
            along_axes(view, p, at);
            const double u = half + scale * at[0] / at[2];
            if (!place_in(view, from, &is)) continue;
            HOLDS(&stays, is.u_q16 >= 0 && is.u_q16 <= view->tile_texels * 65536, "%d from %g", (int)is.u_q16, u);
            n_rim += fabs(is.u_q16 / 65536.0 - u) < 0x1p-6;
        }
    }
    CHECK_TALLY(stays, "points of the rim stay in the tile");
    CHECK(n_rim > 1000);
}
#else
static void test_rim(void)
{
}
#endif

/* [A6] Vertex normals of length 0 point nowhere: 512 along each axis. */
static void test_no_normal(void)
{
    static uint32_t normal[W * H];
    const gn_picture p = {W, H, GN_FORMAT_RAW32, GN_VIEW_NORMAL, 0};
    int n_nowhere = 0;
    ls_begin(&ls);
    memset(ls.demo.ball_nrm, 0, sizeof ls.demo.ball_nrm);
    ls.scene.objects = &ls.object[2];
    ls.scene.n_objects = 1;
    CHECK_EQ_INT(gn_init(&fresh, &p), GN_OK);
    CHECK_EQ_INT(ls_prepare(&fresh, &ls.scene), GN_OK);
    CHECK_EQ_INT(ls_screen(&fresh, normal, 4), GN_OK);
    for (int i = 0; i < W * H; i++)
        if (normal[i] != UINT32_MAX) n_nowhere += CHECK_EQ_INT(normal[i], 512U << 20 | 512U << 10 | 512U);
    CHECK(n_nowhere > 50);
}

int main(void)
{
    surface.n_lights = surface.n_punctual = surface.shadowed = 1;
    surface.light[0].state = &fresh.frame.light[0];
    test_ends();
    test_places();
    test_rim();
    test_no_normal();
    return check_report();
}
