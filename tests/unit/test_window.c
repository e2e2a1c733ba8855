/* Texel windows against lookups of single receivers on random planes, and against the texels themselves, in whole
 * numbers. A window asks the receiver itself of texels in doubt, so both are the same. A texel is contested if it is so
 * near to the receiver that rounding decides, or between the plane at the texel's own centre and the receiver, but
 * beyond what is in doubt: only there they may differ. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exact.h"
#include "knobs.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_filter.h"
#include "rng.h"

#if GN_INTERPOLATES && GN_SHADOWS

enum { SIZE_LOG2 = 6, SIZE = 1 << SIZE_LOG2 };

static rng random_state = {31};
static gn_frame frame;
static gn_scene scene;
static gn_light_view view;
static gn_depth_block blocks[SIZE * SIZE / 64];
static uint32_t texels[SIZE * SIZE];
static gn_window window;
#if GN_CHANGES
static gn_squares squares;
#endif

/* The plane that receivers lie on. */
static gn_window_place place;
static int32_t slope_q28[2];
static int on_plane;
static int64_t own_q30;

/* ---- The plane and the texels ------------------------------------------------------------------------------------ */

/* Depth of the plane, Q46. */
static int64_t plane_at(int64_t u_q16, int64_t v_q16)
{
    return place.depth_q30 * (int64_t)65536 +
           4 * ((u_q16 - place.u_q16) * (int64_t)slope_q28[0] + (v_q16 - place.v_q16) * (int64_t)slope_q28[1]);
}

static int32_t inside(int64_t i)
{
    return (int32_t)i128_clamp(i, 0, SIZE - 1);
}

static int is_outside(int64_t i, int64_t j)
{
    return i != inside(i) || j != inside(j);
}

/* The same at the centre of the texel that is read. */
static int64_t plane_of_texel(int64_t i, int64_t j)
{
    return plane_at((int64_t)inside(i) * 65536 + 32768, (int64_t)inside(j) * 65536 + 32768);
}

static int64_t texel_q46(int64_t i, int64_t j)
{
    const size_t at = (size_t)(inside(j) * SIZE + inside(i));
    uint32_t depth = 0;
    if (view.depth_bits == 8) depth = (uint32_t)view.depth.d8[at] << 24;
    else if (view.depth_bits == 16) depth = (uint32_t)view.depth.d16[at] << 16;
    else depth = view.depth.d32[at];
    return (int64_t)depth << 14;
}

static void store(size_t at, uint32_t depth)
{
    if (view.depth_bits == 8) view.depth.d8[at] = (uint8_t)(depth >> 24);
    else if (view.depth_bits == 16) view.depth.d16[at] = (uint16_t)(depth >> 16);
    else view.depth.d32[at] = depth;
}

/* Half a step of a rounded depth, Q46. */
static int64_t half_step(void)
{
    const int dropped = view.depth_bits == 32 ? 0 : 32 - view.depth_bits - GN_DEPTH_FRAC_BITS;
    return dropped ? (int64_t)1 << (dropped + 13) : 0;
}

/* What rounding may decide, at most: that, twice, 64 units of 2^-30 that a window may be off by, and what it adds for
 * them. Q46. */
static int64_t rounding(void)
{
    return 2 * half_step() + (int64_t)300 * 65536;
}

/* How far from a receiver the centres of texels are that its filter reads, times the slopes, Q46. */
static int64_t reach(void)
{
    static const int64_t halves[] = {1, 2, 4, 6, 8};
    const int64_t slopes = llabs((int64_t)slope_q28[0]) + llabs((int64_t)slope_q28[1]);
    return on_plane ? 0 : halves[view.filter] * 2 * 65536 * slopes;
}

/* ---- Random cases ------------------------------------------------------------------------------------------------ */

static void random_view(void)
{
#if GN_RUNTIME_KNOBS
    static const uint8_t depth_bits[] = {8, 16, 32};
#else
    static const uint8_t depth_bits[] = {GN_DEPTH_BITS, GN_DEPTH_BITS, GN_DEPTH_BITS};
#endif
    static const int32_t steps[] = {4, 8, 16};
    frame.scene = &scene;
    SET_KNOB(&frame, persp_step, steps[rng_below(&random_state, 3)]);
    SET_KNOB(&frame, edge, rng_below(&random_state, 2) ? rng_range(&random_state, 1, 8) : 0);
    view.depth_bits = depth_bits[rng_below(&random_state, 3)];
    view.filter = (uint8_t)rng_below(&random_state, (GN_FILTER_MAX < 4 ? GN_FILTER_MAX : 4) + 1U);
    view.filter_idx = (uint8_t)(view.filter ? view.filter - 1 : 0);
    view.tile_log2 = SIZE_LOG2;
    view.tile_texels = view.tile_rows = SIZE;
    view.border_lit = (uint8_t)(GN_MAIN_LIGHT && rng_below(&random_state, 2));
    if (view.depth_bits == 8) view.depth.d8 = (uint8_t *)texels;
    else if (view.depth_bits == 16) view.depth.d16 = (uint16_t *)texels;
    else view.depth.d32 = texels;
    view.block = blocks;
}

static void random_plane(void)
{
    const int bits = rng_range(&random_state, 10, 22);
    place.u_q16 = rng_range(&random_state, -2 * 65536, (SIZE + 2) * 65536);
    place.v_q16 = rng_range(&random_state, -2 * 65536, (SIZE + 2) * 65536);
    place.depth_q30 = rng_range(&random_state, 1 << 28, 3 << 28);
    for (int i = 0; i < 2; i++)
        slope_q28[i] = rng_below(&random_state, 8) ? rng_wide_i32(&random_state, (uint32_t)bits) : 0;
    on_plane = GN_VIEW_EDGE(&frame, &view) || (GN_RECEIVER_PLANE && rng_below(&random_state, 4) == 0);
    own_q30 = 0;
    if (rng_below(&random_state, 4) == 0) own_q30 = rng_below(&random_state, 2) ? INT32_MAX : reach() >> 16;
    if (rng_below(&random_state, 8) == 0) own_q30 = (reach() >> 19) * 5;
}

/* Casters before an edge and none behind it; here and there a texel near the plane, or anything. */
static void random_texels(void)
{
    const int32_t edge = rng_range(&random_state, -4, SIZE + 4), pattern = rng_range(&random_state, 0, 4);
    const uint32_t few = rng_below(&random_state, 2) ? 1000 : 20;
    for (int32_t j = 0; j < SIZE; j++)
        for (int32_t i = 0; i < SIZE; i++) {
            const int dark = pattern == 0   ? i < edge
                             : pattern == 1 ? j < edge
                             : pattern == 2 ? i + j < 2 * edge
                             : pattern == 3 ? (i < edge) == (j < edge)
                                            : (int)rng_below(&random_state, 2);
            int64_t depth = dark ? plane_of_texel(i, j) - 2 * reach() - 4 * rounding() : (int64_t)UINT32_MAX << 14;
            const uint32_t kind = rng_below(&random_state, few);
            if (kind == 0) depth = plane_of_texel(i, j) + rng_range(&random_state, -150, 150) * (reach() / 100);
            else if (kind == 1) depth = plane_of_texel(i, j) + rng_range(&random_state, -3, 3) * (rounding() / 2);
            else if (kind == 2) depth = (int64_t)rng_u32(&random_state) << 14;
            store((size_t)(j * SIZE + i), (uint32_t)i128_clamp(depth >> 14, 0, UINT32_MAX));
        }
    gn_blocks_build(&view);
}

/* ---- One receiver ------------------------------------------------------------------------------------------------ */

/* Integral of max(0, h - |t|) from minus infinity to x. */
static double tent_integral(double x, double h)
{
    if (x <= -h) return 0;
    if (x >= h) return h * h;
    return x <= 0 ? (x + h) * (x + h) / 2 : h * h - (h - x) * (h - x) / 2;
}

/* At least what a texel weighs along an axis, if its place is off by up to 1/64 texel or by the rounding of weights. */
static double most_weight(double texel, double at)
{
    const double off = 1 / 32.0, h = view.filter_idx + 0.5;
    if (view.filter == GN_FILTER_HARD) return texel == floor(at);
    if (view.filter == GN_FILTER_2X2) return fabs(texel + 0.5 - at) < view.filter_idx + 1 + off ? 1 : 0;
    return (tent_integral(texel + 1 - at, h) - tent_integral(texel - at, h)) / (h * h) + off;
}

/* Whether 3x3 looks as close as the fastest shading. */
static int looks_closer(void)
{
    return GN_K(&frame, persp_step) == 8 && view.filter == GN_FILTER_3X3 && !view.perspective;
}

/* How far before the plane, and behind it, texels are in doubt at least, Q46: behind it the filter's reach, or what
 * bias leaves of it; before it half of that, or half a texel. */
static int64_t doubt_before(void)
{
    const int64_t halves = view.filter ? 2 * (view.filter_idx + 1) : 1;
    return reach() / halves * (GN_K(&frame, persp_step) == 16 || looks_closer() ? 1 : (halves + 1) / 2);
}

static int64_t doubt_behind(void)
{
    const int64_t safe = (own_q30 - own_q30 / 8 - ((int64_t)1 << 30 >> view.depth_bits)) * 65536;
    if (own_q30 == 0) return reach();
    if (own_q30 < reach() >> 16) return GN_K(&frame, persp_step) == 16 && safe > 0 && safe < reach() ? safe : reach();
    return safe > 0 && safe < doubt_before() ? safe : doubt_before();
}

typedef struct {
    double contested; /* what texels weigh, at most, that a window may take for another's */
    int between;      /* a texel is between the plane at its centre and the receiver: the window asked the receiver */
} reading;

/* All texels that a receiver may read, and one more to each side: places are rounded. */
static reading read_around(const gn_receiver *r)
{
    const int64_t here = (int64_t)r->depth_q32 << 14, u = r->u_q16 >> 16, v = r->v_q16 >> 16;
    const int64_t before = doubt_before(), behind = doubt_behind(), near = half_step() + 64 * 65536;
    const int edge = GN_VIEW_EDGE(&frame, &view);
    const int n = edge ? edge : view.filter == GN_FILTER_HARD ? 0 : view.filter_idx + 2;
    reading out = {0, 0};
    for (int64_t j = v - n; j <= v + n; j++)
        for (int64_t i = u - n; i <= u + n; i++) {
            if (view.border_lit && is_outside(i, j)) continue;
            const int64_t t = texel_q46(i, j), own = plane_of_texel(i, j), at = on_plane ? own : here;
            const double weight = edge ? 1 /* any may turn the outline */
                                       : fmin(1, most_weight((double)i, r->u_q16 / 65536.0)) *
                                             fmin(1, most_weight((double)j, r->v_q16 / 65536.0));
            const int taken_for_dark = t >= at && t < own - before, taken_for_lit = t < at && t >= own + behind - near;
            if (llabs(t - at) <= (on_plane ? rounding() : near) || (!on_plane && (taken_for_dark || taken_for_lit)))
                out.contested += weight;
            else if (weight > 0.1 && (t < at) != (t < own)) out.between = 1;
        }
    return out;
}

/* How far a window's answer may be from a lookup's where nothing is contested: NUMERICS 4.13. */
static double rounding_of_places(void)
{
    if (view.filter != GN_FILTER_3X3) return 0;
    const double weights = 2 * 2 / 3.0 * ldexp(1, -GN_FILTER_BITS(&frame) - 1) * 65536 + 1;
    return 2 * 2 / 3.0 / 64 * 65536 + 32 + weights;
}

static struct {
    long asked, contested, between, mixed[5];
    double most[5]; /* off, 65536 = 1, where nothing is contested */
} seen;

static void check_receiver(const gn_receiver *r, uint32_t is, tally *same, tally *near)
{
    static char text[200];
    const reading around = read_around(r);
    const uint32_t want = gn_filter_attenuation(&frame, &view, r);
    snprintf(text, sizeof text, "filter %d, %d bits, border %d, step %d, slopes %d %d%s, at (%d, %d): %u, not %u",
             (int)view.filter, (int)view.depth_bits, (int)view.border_lit, (int)GN_K(&frame, persp_step),
             (int)slope_q28[0], (int)slope_q28[1], on_plane ? " (B5)" : "", (int)r->u_q16, (int)r->v_q16, (unsigned)is,
             (unsigned)want);
    const double off = fabs((double)is - want), most = rounding_of_places() * (1 + 1e-9);
    seen.asked++;
    seen.mixed[view.filter] += want && want < 65536;
    if (around.contested > 0) {
        seen.contested++;
        HOLDS(near, off <= most + around.contested * 65536, "%s, contested %g", text, around.contested);
        return;
    }
    seen.between += around.between;
    seen.most[view.filter] = fmax(seen.most[view.filter], off);
    HOLDS(same, off <= most, "%s", text);
}

static gn_receiver receiver_at(int32_t u_q16, int32_t v_q16)
{
    gn_receiver r = {u_q16, v_q16, 0, {0, 0}, 0, 0};
    r.depth_q32 = (uint32_t)i128_clamp(plane_at(u_q16, v_q16) >> 14, 0, UINT32_MAX);
    for (int i = 0; on_plane && i < 2; i++) r.slope_q28[i] = slope_q28[i];
    return r;
}

/* ---- Rows of receivers ------------------------------------------------------------------------------------------- */

/* A row somewhere in the tile or across its border. */
static int random_row(gn_receiver_step *from, gn_receiver_step *step, int32_t n)
{
    const int across = rng_below(&random_state, 2) ? 4 : 0;
    int32_t end[2];
    memset(from, 0, sizeof *from);
    from->u_q16 = rng_range(&random_state, (across ? -4 : 5) * 65536, (across ? SIZE + 4 : SIZE - 5) * 65536);
    from->v_q16 = rng_range(&random_state, (across ? -4 : 5) * 65536, (across ? SIZE + 4 : SIZE - 5) * 65536);
    step->u_q16 = rng_range(&random_state, -70000, 70000);
    step->v_q16 = rng_range(&random_state, -70000, 70000);
    if (rng_below(&random_state, 4) == 0) step->u_q16 = 0;
    step->depth_q31 = 0;
    end[0] = from->u_q16 + (n - 1) * step->u_q16;
    end[1] = from->v_q16 + (n - 1) * step->v_q16;
    for (int i = 0; i < 2; i++)
        if (end[i] < -5 * 65536 || end[i] > (SIZE + 5) * 65536) return 0;
    return 1;
}

/* The window that a row needs. Returns 0 if there is none. */
static int window_for(const gn_receiver_step *from, const gn_receiver_step *step, int32_t n, int32_t box[4])
{
    const int32_t u = from->u_q16 + (n - 1) * step->u_q16, v = from->v_q16 + (n - 1) * step->v_q16;
    gn_window_reads(&view, GN_VIEW_EDGE(&frame, &view), from->u_q16 < u ? from->u_q16 : u,
                    (from->u_q16 < u ? u : from->u_q16) + 1024, &box[0], &box[2]);
    gn_window_reads(&view, GN_VIEW_EDGE(&frame, &view), from->v_q16 < v ? from->v_q16 : v,
                    (from->v_q16 < v ? v : from->v_q16) + 1024, &box[1], &box[3]);
    for (int i = 0; i < 2; i++) { /* larger than it must be, if there is room */
        const int32_t room = GN_WINDOW_TEXELS - box[2 + i], before = rng_range(&random_state, 0, room > 0 ? room : 0);
        box[i] -= before;
        box[2 + i] += before;
        if (box[2 + i] > GN_WINDOW_TEXELS) return 0;
    }
    return gn_window_compare(&window, &place, box[0], box[1], box[2], box[3]);
}

static void check_row(tally *same, tally *near, tally *covers)
{
    uint32_t attenuation[17];
    gn_receiver_step from, step;
    const int32_t n = rng_range(&random_state, 1, 16);
    int32_t box[4];
    if (!random_row(&from, &step, n) || !window_for(&from, &step, n, box)) return;
    from.depth_q31 = gn_window_depth(&window, from.u_q16, from.v_q16);
    step.depth_q31 = gn_window_depth_step(&window, step.u_q16, step.v_q16);
    attenuation[n] = 0xDEADBEEF;
    const int said = gn_window_row(&frame, &window, &from, &step, n, rng_below(&random_state, 2) == 0, attenuation);
    for (int32_t i = 0; said < GN_WINDOW_MIXED && i < n; i++) attenuation[i] = said == GN_WINDOW_LIT ? 65536 : 0;
    HOLDS(covers, said != GN_WINDOW_MISSED && attenuation[n] == 0xDEADBEEF, "filter %d, %d from (%d, %d)",
          (int)view.filter, (int)n, (int)from.u_q16, (int)from.v_q16);
    for (int32_t i = 0; i < n; i++) {
        const int64_t depth = plane_at(from.u_q16 + i * step.u_q16, from.v_q16 + i * step.v_q16);
        if (on_plane && depth < 0) continue; /* the receiver itself cannot say so */
        const gn_receiver r = receiver_at(from.u_q16 + i * step.u_q16, from.v_q16 + i * step.v_q16);
        check_receiver(&r, attenuation[i], same, near);
    }
    from.u_q16 += (box[2] + 1) * 65536; /* beyond it on one side */
    HOLDS(covers, gn_window_row(&frame, &window, &from, &step, n, 1, attenuation) == GN_WINDOW_MISSED,
          "filter %d, beyond", (int)view.filter);
}

/* ---- What it says of rectangles ---------------------------------------------------------------------------------- */

static long n_said[3];

/* LIT is not said if a texel is before the plane, DARK not if one is behind it; both are said if no texel is near. */
static void check_says(tally *sound, tally *sure)
{
    const int32_t u = window.u0 + rng_range(&random_state, 0, window.w - 1),
                  v = window.v0 + rng_range(&random_state, 0, window.h - 1),
                  w = rng_range(&random_state, 1, window.u0 + window.w - u),
                  h = rng_range(&random_state, 1, window.v0 + window.h - v);
    int dark = 0, lit = 0, maybe_dark = 0, maybe_lit = 0;
    for (int32_t j = v; j < v + h; j++)
        for (int32_t i = u; i < u + w; i++) {
            const int64_t t = texel_q46(i, j), own = plane_of_texel(i, j);
            const int no_texel = view.border_lit && is_outside(i, j);
            dark |= !no_texel && t < own - rounding();
            lit |= no_texel || t > own + rounding();
            maybe_dark |= !no_texel && t < own + reach() + 2 * rounding();
            maybe_lit |= no_texel || t > own - reach() - 2 * rounding();
        }
    const int said = gn_window_says(&window, u, v, w, h);
    n_said[said]++;
    HOLDS(sound, said != GN_WINDOW_LIT || !dark, "filter %d, %d x %d: lit", (int)view.filter, (int)w, (int)h);
    /* bias keeps the surface's own texels behind it: in doubt they are lit */
    HOLDS(sound, said != GN_WINDOW_DARK || !lit, "filter %d, %d x %d: dark", (int)view.filter, (int)w, (int)h);
    HOLDS(sure, maybe_dark || said == GN_WINDOW_LIT, "filter %d, %d x %d: not lit", (int)view.filter, (int)w, (int)h);
    HOLDS(sure, maybe_lit || said == GN_WINDOW_DARK, "filter %d, %d x %d: not dark", (int)view.filter, (int)w, (int)h);
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

static void test_rows(void)
{
    tally same = {0}, near = {0}, covers = {0}, sound = {0}, sure = {0};
    for (int k = 0; k < 2000; k++) {
        random_view();
        random_plane();
        random_texels();
        if (!gn_window_begin(&window, &frame, &view, slope_q28, own_q30, on_plane)) continue;
        for (int i = 0; i < 6; i++) {
            check_row(&same, &near, &covers);
            if (window.w) check_says(&sound, &sure);
        }
    }
    CHECK_TALLY(same, "rows are what lookups are, 3x3 to the rounding of places");
    CHECK_TALLY(near, "only contested texels differ");
    CHECK_TALLY(covers, "a window answers for what it covers");
    CHECK_TALLY(sound, "lit and dark rectangles are");
    CHECK_TALLY(sure, "what is far from the plane is not in doubt");
    printf("%ld receivers, %ld with contested texels, %ld asked themselves; off by at most", seen.asked, seen.contested,
           seen.between);
    for (int i = 0; i <= GN_FILTER_MAX && i < 5; i++) printf(" %.0f", seen.most[i]);
    printf(" of 65536; rectangles: %ld lit, %ld dark, %ld mixed\n", n_said[GN_WINDOW_LIT], n_said[GN_WINDOW_DARK],
           n_said[GN_WINDOW_MIXED]);
    CHECK(seen.asked > 20000 && 4 * seen.contested < seen.asked && seen.between > 400);
    for (int i = 1; i <= GN_FILTER_MAX && i < 5; i++) CHECK(seen.mixed[i] > 200);
    for (int i = 0; i < 3; i++) CHECK(n_said[i] > 500);
    if (GN_FILTER_MAX >= 2) CHECK(seen.most[2] > rounding_of_places() / 8);
}

/* The texels of an interval of places are those of all places in it, and no others. [F1] [F2] [F3] */
static void test_reads(void)
{
    tally t = {0};
    for (int k = 0; k < 100000; k++) {
        view.filter = (uint8_t)rng_below(&random_state, 5);
        view.filter_idx = (uint8_t)(view.filter ? view.filter - 1 : 0);
        const int32_t lo = rng_range(&random_state, -20 * 65536, 80 * 65536) & (k & 1 ? -1 : -32768),
                      hi = lo + rng_range(&random_state, 0, 5 * 65536);
        const double reach_of = view.filter ? view.filter_idx + 1 : 0.5; /* of centres, the last excluded */
        int32_t first, n;
        const int32_t edge = rng_range(&random_state, 0, 8);
        gn_window_reads(&view, 0, lo, hi, &first, &n);
        const double at = lo / 65536.0 - reach_of - 0.5, end = hi / 65536.0 + reach_of - 0.5;
        HOLDS(&t, first == (int32_t)floor(at) + 1 && first + n - 1 == (int32_t)floor(end),
              "filter %d, %d .. %d: %d from %d", (int)view.filter, (int)lo, (int)hi, (int)n, (int)first);
        if (!edge) continue;
        gn_window_reads(&view, edge, lo, hi, &first, &n); /* of F7 */
        HOLDS(&t, first == (lo >> 16) - edge && first + n - 1 == (hi >> 16) + edge, "edge %d, %d .. %d: %d from %d",
              (int)edge, (int)lo, (int)hi, (int)n, (int)first);
    }
    CHECK_TALLY(t, "texels that are read");
}

/* Planes that are too steep, or leave the range of depths, and the disk have no windows; before the range all is lit.
 */
static void test_none(void)
{
    tally t = {0};
    for (int k = 0; k < 20000; k++) {
        random_view();
        random_plane();
        for (int i = 0; i < 2; i++) slope_q28[i] = rng_wide_i32(&random_state, 28);
        view.tile_log2 = (uint8_t)rng_range(&random_state, SIZE_LOG2, 10); /* slopes are limited to 16 / T */
        const int32_t most = view.tile_log2 > 7 ? 1 << (32 - view.tile_log2) : 1 << 25;
        const int steep = abs(slope_q28[0]) >= most || abs(slope_q28[1]) >= most;
        const int disk = rng_below(&random_state, 8) == 0;
        if (disk) view.filter = GN_FILTER_DISK;
        const int got = gn_window_begin(&window, &frame, &view, slope_q28, own_q30, on_plane);
        view.tile_log2 = SIZE_LOG2;
        HOLDS(&t, got == !(steep || disk) && !window.w, "%d: slopes %d, %d", got, (int)slope_q28[0], (int)slope_q28[1]);
        if (!got) continue;
        const int32_t u = rng_range(&random_state, 0, 32), v = rng_range(&random_state, 0, 32);
        const int made = gn_window_compare(&window, &place, u, v, 32, 32);
        int64_t lo = INT64_MAX, hi = INT64_MIN;
        for (int i = 0; i < 4; i++) {
            const int64_t at = plane_of_texel(u + 31 * (i & 1), v + 31 * (i >> 1));
            lo = at < lo ? at : lo;
            hi = at > hi ? at : hi;
        }
        HOLDS(&t, !made || (hi < 0 && !window.any) || (lo > -((int64_t)1 << 46) && hi < (int64_t)1 << 46), "%g .. %g",
              ldexp((double)lo, -46), ldexp((double)hi, -46));
        const int64_t beside =
            (int64_t)abs(window.slope_q30[0]) + abs(window.slope_q30[1]) + place.apart_q30; /* a texel */
        HOLDS(&t, hi + (beside + window.behind_q30 + 1) * 65536 >= 0 || (made && !window.any), "%g .. %g is not lit",
              ldexp((double)lo, -46), ldexp((double)hi, -46));
        HOLDS(&t, made || lo < ((int64_t)1 << 43) - reach() || hi > ((int64_t)7 << 43) - 2 * reach() - rounding(),
              "%g .. %g has none", ldexp((double)lo, -46), ldexp((double)hi, -46));
    }
    CHECK_TALLY(t, "planes that have a window");
}

int main(void)
{
#if GN_CHANGES
    window.squares = &squares;
#endif
    test_reads();
    test_rows();
    test_none();
    return check_report();
}

#else
int main(void)
{
    printf("1 passed, 0 failed\n");
    return 0;
}
#endif
