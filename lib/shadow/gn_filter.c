/* Percentage-closer filtering: any filter. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "shadow/gn_lookup.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_tent.h"
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
#if !GN_SIZE_FIRST
    if (gn_lookup_rows_on_plane(l, u, v, w, h, at, rows)) return;
#endif
    for (int32_t j = 0; j < h; j++) rows[j] = gn_lookup_dark(l, u, v + j, w) << at;
}

/* The texel and its neighbours: gn_lookup_cross_on_plane(). */
GN_HOT static uint32_t read_cross(const gn_lookup *l, int32_t u, int32_t v)
{
    uint32_t dark, rows[3];
#if !GN_SIZE_FIRST
    if (gn_lookup_cross_on_plane(l, u, v, &dark)) return dark;
#endif
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
    l.view = view;
    l.u_q16 = near_tile(receiver->u_q16);
    l.v_q16 = near_tile(receiver->v_q16);
    l.least = gn_rounded_depth(receiver->depth_q32, dropped, gn_texel_far(GN_VIEW_BITS(view)));
    if (GN_PLANES) start_plane(&l, receiver, dropped, GN_VIEW_EDGE(frame, view));
    return filtered(frame, &l, receiver);
}
