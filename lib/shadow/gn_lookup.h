/* Lookups in a shadow tile: which texels are nearer to the light than the receiver. All filters are built from them. */
#ifndef GN_LOOKUP_H
#define GN_LOOKUP_H

#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_texel.h"
#include "gnomon.h"

/* A receiver prepared for its taps. A texel, in the upper bits of 32, is lit if it is not below `least`: the
 * receiver's depth rounded to the bits of the view and GN_DEPTH_FRAC_BITS, at most that of an empty texel. */
typedef struct {
    const gn_light_view *view;
    int32_t u_q16, v_q16;
    uint32_t least;
    int32_t sloped; /* receiver's plane: this and the following fields are set only with GN_PLANES */
    int32_t slope_q28[2];
    int64_t least_q32; /* on the plane, at the texel that (u, v) lies in, not limited */
} gn_lookup;

/* Bits of depth_q32 that rounding drops: 0, or at least 12. */
GN_HOT static inline int32_t gn_dropped_bits(const gn_light_view *view)
{
    return GN_VIEW_BITS(view) == 32 ? 0 : 32 - GN_VIEW_BITS(view) - GN_DEPTH_FRAC_BITS;
}

/* The far value is a multiple of 2^dropped, so that no smaller depth rounds beyond it. */
GN_HOT static inline uint32_t gn_rounded_depth(uint32_t depth_q32, int32_t dropped, uint32_t far)
{
    if (depth_q32 >= far) return far;
    return dropped ? (depth_q32 + (1U << (dropped - 1))) >> dropped << dropped : depth_q32;
}

/* least_q32 at a texel of the tile, at most 64 + 1023 texels away in each axis: 2^50 and twice 2^44. */
GN_HOT static inline int64_t gn_least_on_plane(const gn_lookup *l, int32_t u, int32_t v)
{
    int32_t du = u - (l->u_q16 >> 16), dv = v - (l->v_q16 >> 16);
    return l->least_q32 + (int64_t)l->slope_q28[0] * (16 * du) + (int64_t)l->slope_q28[1] * (16 * dv);
}

/* The least and the most of it between a texel and one w and h texels after it. */
GN_HOT static inline void gn_plane_range(const gn_lookup *l, int32_t u, int32_t v, int32_t w, int32_t h, int64_t *lo,
                                         int64_t *hi)
{
    int64_t across = (int64_t)l->slope_q28[0] * (16 * w), down = (int64_t)l->slope_q28[1] * (16 * h);
    *lo = *hi = gn_least_on_plane(l, u, v);
    *(across < 0 ? lo : hi) += across;
    *(down < 0 ? lo : hi) += down;
}

GN_HOT static inline uint32_t gn_limited_depth(const gn_light_view *view, int64_t least_q32)
{
    uint32_t far = gn_texel_far(GN_VIEW_BITS(view));
    return least_q32 < 0 ? 0 : least_q32 > (int64_t)far ? far : (uint32_t)least_q32;
}

GN_HOT static inline gn_texels gn_view_texels(const gn_light_view *view, int32_t u, int32_t v)
{
    return gn_texels_at(view->depth, GN_VIEW_BITS(view), (size_t)(uint32_t)(v * view->tile_texels + u));
}

/* Whether n x n texels from (u, v) on lie in the tile and compare with one depth, so that taps need no checks. With
 * GN_SIZE_FIRST taps are always checked. */
GN_HOT static inline int gn_lookup_is_plain(const gn_lookup *l, int32_t u, int32_t v, int32_t n)
{
    return !GN_SIZE_FIRST && !(GN_PLANES && l->sloped) && (uint32_t)u <= (uint32_t)(l->view->tile_texels - n) &&
           (uint32_t)v <= (uint32_t)(GN_TILE_ROWS(l->view) - n);
}

/* Texels of row v, n from u on, wherever they lie: bit i is set where texel i keeps the receiver dark. */
uint32_t gn_lookup_dark(const gn_lookup *l, int32_t u, int32_t v, int32_t n);

#if GN_PLANES && !GN_SIZE_FIRST
/* The same of n x n texels on the receiver's plane: a byte per row; *found: the OR of all rows, and in the upper half
 * their AND. Returns 0 if a texel lies outside the tile, or the plane outside what texels hold. */
int gn_lookup_on_plane(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint8_t *dark, uint32_t *found);

/* The same of the texel that the lookup lies in, bit 0, and those before and after it: in its column, in its row. */
int gn_lookup_cross_on_plane(const gn_lookup *l, int32_t u, int32_t v, uint32_t *dark);

/* The same of w x h texels, bits of a row from bit `at` on. */
int gn_lookup_rows_on_plane(const gn_lookup *l, int32_t u, int32_t v, int32_t w, int32_t h, int32_t at, uint32_t *rows);
#endif

/* A tap of the hard filter, the disk or 2x2 at the border: 1 if it is lit. */
GN_HOT static inline uint32_t gn_lookup_tap(const gn_lookup *l, int32_t u, int32_t v)
{
    GN_COUNT(taps_lone, 1);
    if (!gn_lookup_is_plain(l, u, v, 1)) return !gn_lookup_dark(l, u, v, 1);
    return gn_texel_load(gn_view_texels(l->view, u, v), GN_VIEW_BITS(l->view), 0) >= l->least;
}

/* ---- The rotated disk: taps at points of a disk, which is turned from pixel to pixel ----------------------------- */

/* The receiver's pixel turns the disk. */
uint32_t gn_disk_attenuation(const gn_frame *frame, const gn_lookup *l, const gn_receiver *receiver);

/* Edges finer than texels (F7): the outline of what shadows is found between texels, from their compares with the
 * receiver's plane. Where a texel's neighbour has another answer, the run of such texels along that side says where the
 * outline passes through it: from half a texel inside to half a texel outside, as the run's ends step. */

#if GN_EDGE_BUILT

/* Texels of three rows, a bit each that keeps the receiver dark: bits that are set in the result are those whose texel
 * of the middle row has a neighbour with another answer. */
GN_HOT static inline uint32_t gn_edge_texels(uint32_t above, uint32_t row, uint32_t below)
{
    return (row ^ above) | (row ^ below) | (row ^ row << 1) | (row ^ row >> 1);
}

/* Attenuation 0 .. 65536, of the hard filter one of both, of a receiver at (u, v), whose fractions count: bit s of row
 * 0 is its texel. Read are n = GN_K(frame, edge) texels before and after it in rows -1 .. 1, and of n rows before and
 * after those the three in the middle; but for sides whose texels are alike. */
uint32_t gn_edge_attenuation(const uint32_t *row, int32_t s, int32_t n, int32_t u_q16, int32_t v_q16, int hard);

#endif

#endif
