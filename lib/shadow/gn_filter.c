/* Percentage-closer filtering: any filter. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_texel.h"

/* ---- The receiver's plane ---------------------------------------------------------------------------------------- */

/* With x the depth at a tap in Q44, h half a step of rounding, s a texel, hence a whole number of steps: s >= round(x)
 * if and only if s > x - h, and, s being also a multiple of 2^12, if and only if s >= floor((x - h) / 2^12) + 1. From a
 * texel to the next, x changes by slope * 2^16, so this by slope * 16: whole numbers, every tap is exact. Slopes are
 * below 2^29.1, a receiver is at most 2^31.1 away from the texel nearest to it, both axes together: |x| < 2^62. */
GN_HOT static int64_t plane_rise_q44(int32_t slope_q28, int32_t tap_q16, int32_t c_q16)
{
    /* to the centre of the texel that tap_q16 lies in */
    return slope_q28 * ((int64_t)(tap_q16 >> 16) * 65536 + 0x8000 - c_q16);
}

/* The depth that the first tap is compared with lies on the receiver's plane. [B5] */
GN_HOT static GN_NOINLINE void start_plane(gn_lookup *l, const gn_receiver *receiver, int32_t dropped, int always)
{
    int32_t most = 2 << 28;
    l->slope_q28[0] = gn_max32(-most, gn_min32(receiver->slope_q28[0], most));
    l->slope_q28[1] = gn_max32(-most, gn_min32(receiver->slope_q28[1], most));
    l->sloped = always || (l->slope_q28[0] | l->slope_q28[1]) != 0;
    l->least_q32 = 0;
    if (!l->sloped) return;
    int64_t x_q44 = (int64_t)receiver->depth_q32 * 4096 + plane_rise_q44(l->slope_q28[0], l->u_q16, receiver->u_q16) +
                    plane_rise_q44(l->slope_q28[1], l->v_q16, receiver->v_q16);
    l->least_q32 = ((x_q44 - ((int64_t)1 << (dropped + 11))) >> 12) + 1;
}

/* ---- Filters ----------------------------------------------------------------------------------------------------- */

/* Four texels are compared first, then weighted. [F2] */
GN_HOT static uint32_t bilinear(const gn_lookup *l, int32_t bits)
{
    int32_t cu = l->u_q16 + 32768, cv = l->v_q16 + 32768;
    int32_t u = (cu >> 16) - 1, v = (cv >> 16) - 1;
    uint32_t upper, lower;
    GN_COUNT(lookups_2x2, 1);
    if (gn_lookup_is_plain(l, u, v, 2)) {
        int32_t depth_bits = GN_VIEW_BITS(l->view);
        gn_texels top = gn_view_texels(l->view, u, v), bottom = gn_texels_at(top, depth_bits, l->view->tile_texels);
        upper = (uint32_t)(gn_texel_load(top, depth_bits, 0) < l->least) |
                (uint32_t)(gn_texel_load(top, depth_bits, 1) < l->least) << 1;
        lower = (uint32_t)(gn_texel_load(bottom, depth_bits, 0) < l->least) |
                (uint32_t)(gn_texel_load(bottom, depth_bits, 1) < l->least) << 1;
    } else {
        upper = gn_lookup_dark(l, u, v, 2);
        lower = gn_lookup_dark(l, u, v + 1, 2);
    }
    if (!(upper | lower)) return 65536;
    if ((upper & lower) == 3) return 0;
    return gn_tent_of_2x2(upper, lower, cu, cv, bits);
}

/* A coordinate may lie far outside after a steep offset. There every tap reads the border, but the fraction still gives
 * the weights. */
GN_HOT static int32_t near_tile(int32_t c_q16)
{
    if ((uint32_t)c_q16 + (64U << 16) < 1152U << 16) return c_q16; /* from -64 to 1088: the common case */
    return (c_q16 < 0 ? -64 : 1088) * 65536 + (c_q16 & 0xFFFF);
}

#if GN_EDGE_BUILT
enum { EDGE_ROWS = 17 }; /* 2 * 8 + 1 */

/* Rows of texels, a bit each that keeps the receiver dark, from bit `at` on. */
GN_HOT static void read_rows(const gn_lookup *l, int32_t u, int32_t v, int32_t w, int32_t h, int32_t at, uint32_t *rows)
{
    for (int32_t j = 0; j < h; j++) rows[j] = gn_lookup_dark(l, u, v + j, w) << at;
}

/* The texel and its neighbours that keep the receiver dark: bit 0, above, below, left, right. */
GN_HOT static uint32_t read_cross(const gn_lookup *l, int32_t u, int32_t v)
{
    uint32_t dark, rows[3];
    for (int32_t i = 0; i < 3; i++) rows[i] = gn_lookup_dark(l, u - 1, v - 1 + i, 3);
    dark = (rows[1] >> 1 & 1U) | (rows[0] & 2U) | (rows[2] & 2U) << 1 | (rows[1] & 1U) << 3 | (rows[1] & 4U) << 2;
    return dark;
}

/* The hard filter or 2x2 with edges finer than texels. Beyond the tile of a tight fit all is lit. [F7] */
GN_HOT static GN_NOINLINE uint32_t edge_attenuation(const gn_frame *frame, const gn_lookup *l)
{
    const int32_t u = l->u_q16 >> 16, v = l->v_q16 >> 16, n = GN_K(frame, edge);
    uint32_t rows[EDGE_ROWS], *row = &rows[n];
    if (gn_border_lit(l->view) &&
        ((uint32_t)u >= (uint32_t)l->view->tile_texels || (uint32_t)v >= (uint32_t)GN_TILE_ROWS(l->view)))
        return 65536;
    const uint32_t cross = read_cross(l, u, v), own = 0U - (cross & 1U), differ = (cross ^ own) & 30U;
    const int by_row = (differ & 6U) != 0, by_column = (differ & 24U) != 0;
    if (!differ) return own ? 0 : 65536;
    if (!by_row) read_rows(l, u - 1, v - 1, 3, 3, n - 1, row - 1);
    if (by_row) read_rows(l, u - n, v - 1, 2 * n + 1, 3, 0, row - 1);
    if (by_column && n > 1) {
        read_rows(l, u - 1, v - n, 3, n - 1, n - 1, rows);
        read_rows(l, u - 1, v + 2, 3, n - 1, n - 1, row + 2);
    }
    return gn_edge_attenuation(row, n, n, l->u_q16, l->v_q16, l->view->filter == GN_FILTER_HARD);
}
#endif

/* One texel, hard, unless another filter is set. [F1] */
GN_HOT static uint32_t filtered(const gn_frame *frame, const gn_lookup *l, const gn_receiver *receiver)
{
    const int32_t filter = l->view->filter;
#if GN_EDGE_BUILT
    if (GN_VIEW_EDGE(frame, l->view)) return edge_attenuation(frame, l);
#endif
    if (GN_FILTER_MAX >= 1 && filter == GN_FILTER_2X2) return bilinear(l, GN_FILTER_BITS(frame));
    if (GN_DISK_FILTER && filter == GN_FILTER_DISK) return gn_disk_attenuation(frame, l, receiver);
    if (GN_FILTER_MAX >= 2 && filter > GN_FILTER_2X2)
        return gn_tent_attenuation(l, filter - GN_FILTER_2X2, GN_FILTER_BITS(frame));
    return gn_lookup_tap(l, l->u_q16 >> 16, l->v_q16 >> 16) << 16;
}

GN_HOT uint32_t gn_filter_attenuation(const gn_frame *frame, const gn_light_view *view, const gn_receiver *receiver)
{
    gn_lookup l;
    int32_t dropped = gn_dropped_bits(view);
    if (GN_PLANES && !receiver->depth_q32) return 65536; /* no slope brings it back into the range [B5] */
    l.view = view;
    l.u_q16 = near_tile(receiver->u_q16);
    l.v_q16 = near_tile(receiver->v_q16);
    l.least = gn_rounded_depth(receiver->depth_q32, dropped, gn_texel_far(GN_VIEW_BITS(view)));
    if (GN_PLANES) start_plane(&l, receiver, dropped, GN_VIEW_EDGE(frame, view));
    return filtered(frame, &l, receiver);
}

/* ---- Edges finer than texels ------------------------------------------------------------------------------------- */

/* [F7] */

#if GN_EDGE_BUILT

/* A run of texels like the receiver's beside texels that are not: how many lie before and after it, up to n. */
typedef struct {
    int32_t length[2];
    int32_t end[2]; /* bits of the texel after the last: 1 in the receiver's line, 2 in the other, where dark differs */
} texel_run;

/* Along a row; bit n, 1 .. 8, is the receiver's texel. Bits of texels like it are 0; those above 2n may be any, as runs
 * end there. Shifts are up to 31. */
GN_HOT static inline void run_of_row(uint32_t own, uint32_t other, int32_t n, texel_run *run)
{
    const uint32_t bits = ~own & other, before = ~(bits << (32 - n)), after = ~(bits >> (n + 1));
    const int32_t left = gn_min32(gn_clz32(before | 1U), n), right = gn_min32(31 - gn_clz32(after & (0U - after)), n);
    run->length[0] = left;
    run->length[1] = right;
    own <<= 1; /* one texel before the first */
    other <<= 1;
    run->end[0] = (int32_t)((own >> (n - left) & 1U) | (other >> (n - left) & 1U) << 1);
    run->end[1] = (int32_t)((own >> (n + 2 + right) & 1U) | (other >> (n + 2 + right) & 1U) << 1);
}

/* Along a column, from the receiver's row on. */
GN_HOT static inline void run_of_column(const uint32_t *row, int32_t own, int32_t other, uint32_t flip, int32_t n,
                                        texel_run *run)
{
    for (int side = 0; side < 2; side++) {
        const uint32_t *at = row;
        int32_t k = 0, end;
        do {
            at += side ? 1 : -1;
            end = (int32_t)(((*at ^ flip) >> own & 1U) | ((*at ^ flip) >> other & 1U) << 1);
        } while (end == 2 && ++k < n);
        run->length[side] = k;
        run->end[side] = end;
    }
}

/* What is left of the receiver's own answer by one side: f along it, y inside of it. The outline lies half a texel
 * inside of the side where the run ends in a step towards the receiver, as much outside where it steps away, and on it
 * in the run's middle. */
GN_HOT static int32_t share_by_side(const texel_run *run, int32_t n, uint32_t f_q16, int32_t y_q16, int hard)
{
    const int32_t length = run->length[0] + run->length[1] + 1;
    int32_t from_end = 2 * ((run->length[0] << 16) + (int32_t)f_q16), side = 0;
    if (from_end >= length << 16) {
        from_end = (length << 17) - from_end;
        side = 1;
    }
    int32_t line = (length << 16) - from_end; /* up to 17 * 2^16: half a texel times twice the length */
    const int32_t end = run->length[side] >= n ? 1 : run->end[side];
    if (end == 0) line = -line;
    else if (end != 3) line = 0;
    /* all below 2^22: y up to 2^16, length up to 17 */
    if (hard) return y_q16 * 2 * length < line ? 0 : 65536;
    return gn_max32(0, gn_min32(32768 + y_q16 - line / (2 * length), 65536));
}

GN_HOT uint32_t gn_edge_attenuation(const uint32_t *row, int32_t s, int32_t n, int32_t u_q16, int32_t v_q16, int hard)
{
    const uint32_t f[2] = {(uint32_t)u_q16 & 0xFFFFU, (uint32_t)v_q16 & 0xFFFFU};
    const uint32_t dark = row[0] >> s & 1U, flip = 0U - dark;
    int32_t share = 65536;
    GN_COUNT(outlines, 1);
    for (int side = 0; side < 4; side++) {
        const int by_column = side >> 1, step = side & 1 ? 1 : -1;
        const uint32_t *beside = by_column ? row : row + step;
        const int32_t t = by_column ? s + step : s;
        texel_run run;
        const uint32_t across = f[!by_column];
        const int32_t y_q16 = (int32_t)(step > 0 ? 65536 - across : across);
        if ((*beside >> t & 1U) == dark || (hard && y_q16 >= 32768)) continue;
        if (by_column) run_of_column(row, s, t, flip, n, &run);
        else run_of_row((row[0] ^ flip) >> (s - n), (*beside ^ flip) >> (s - n), n, &run);
        share = gn_min32(share, share_by_side(&run, n, f[by_column], y_q16, hard));
        if (!share) break;
    }
    return (uint32_t)(dark ? 65536 - share : share);
}

#endif

/* ---- Weights of tents -------------------------------------------------------------------------------------------- */

#if GN_FILTER_MAX >= 2
GN_HOT void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t bits)
{
    uint32_t f = 1U << bits, ff = f * f, uf4 = 4 * u * f, h = 2 * u;
    uint32_t m = h < f ? f - h : 0, p = h > f ? h - f : 0; /* |2u - F| left and right of the texel's centre */
    int32_t n = 2 * (k + 1);
    w[0] = 2 * (f - u) * (f - u);
    w[n - 1] = 2 * u * u;
    for (int32_t i = 1; i <= k; i++) {
        /* rising towards the peak 4i + 2, falling after it; the peak's corner is cut off the middle ones */
        w[i] = (uint32_t)(4 * i + 2) * ff - uf4 - (i == k ? m * m : 0);
        w[n - 1 - i] = (uint32_t)(4 * i - 2) * ff + uf4 - (i == k ? p * p : 0);
    }
}
#endif

/* ---- Texels compared with a receiver's depth --------------------------------------------------------------------- */

/* Taps are limited to the tile [P8]. */
GN_HOT static int is_dark(const gn_light_view *view, gn_texels row, int32_t u, uint32_t least)
{
    int32_t last = view->tile_texels - 1, in_u = u < 0 ? 0 : u > last ? last : u;
    if (gn_border_lit(view) && in_u != u) return 0;
    return gn_texel_load(row, GN_VIEW_BITS(view), (uint32_t)in_u) < least;
}

GN_HOT static uint32_t dark_on_plane(const gn_lookup *l, gn_texels row, int32_t u, int32_t in_v, int32_t n)
{
    int32_t last = l->view->tile_texels - 1;
    int64_t least_q32 = gn_least_on_plane(l, gn_max32(0, gn_min32(u, last)), in_v); /* of the texel that is read */
    uint32_t dark = 0;
    for (int32_t i = 0; i < n; i++, u++) {
        dark |= (uint32_t)is_dark(l->view, row, u, gn_limited_depth(l->view, least_q32)) << i;
        if (u >= 0 && u < last) least_q32 += (int64_t)l->slope_q28[0] * 16;
    }
    return dark;
}

GN_HOT uint32_t gn_lookup_dark(const gn_lookup *l, int32_t u, int32_t v, int32_t n)
{
    const gn_light_view *view = l->view;
    int32_t last = GN_TILE_ROWS(view) - 1, in_v = v < 0 ? 0 : v > last ? last : v;
    uint32_t dark = 0;
    GN_COUNT(taps_edge, 1);
    if (gn_border_lit(view) && in_v != v) return 0;
    gn_texels row = gn_view_texels(view, 0, in_v);
    if (GN_PLANES && l->sloped) return dark_on_plane(l, row, u, in_v, n);
    for (int32_t i = 0; i < n; i++) dark |= (uint32_t)is_dark(view, row, u + i, l->least) << i;
    return dark;
}
