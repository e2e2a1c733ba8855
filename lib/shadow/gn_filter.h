/* Percentage-closer filtering (MODEL 7). */
#ifndef GN_FILTER_H
#define GN_FILTER_H

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "gnomon.h"
#include "shadow/gn_texel.h"

/* A surface point as a light view sees it. */
typedef struct {
    int32_t u_q16, v_q16; /* tile coordinates in texels */
    uint32_t depth_q32;   /* fraction of the view's depth range */
    int32_t slope_q28[2]; /* receiver's plane: change of that fraction per texel along u and v, within +-2; 0: compare
                             with depth_q32 everywhere */
    int32_t pixel_x, pixel_y; /* its screen pixel: rotates the disk */
} gn_receiver;

/* Texels along which outlines are followed each way in a view; 0: its edges are those of texels. [F7] */
#if GN_EDGE_BUILT
#define GN_VIEW_EDGE(frame, view) ((view)->filter <= GN_FILTER_2X2 ? GN_K(frame, edge) : 0)
#else
#define GN_VIEW_EDGE(frame, view) ((void)(frame), (void)(view), 0)
#endif

#if GN_CHANGES
/* Notes the texels that gn_filter_attenuation may read. */
void gn_note_lookup(gn_squares *squares, const gn_frame *frame, const gn_light_view *view, const gn_receiver *receiver);
#define GN_NOTE_LOOKUP(squares, frame, view, receiver) gn_note_lookup(squares, frame, view, receiver)
#else
#define GN_NOTE_LOOKUP(squares, frame, view, receiver) ((void)0)
#endif

/* Attenuation 0 (shadowed) .. 65536 (lit). Texels outside the tile repeat its border, or are lit if the view says so.
 */
uint32_t gn_filter_attenuation(const gn_frame *frame, const gn_light_view *view, const gn_receiver *receiver);

/* A receiver that is stepped from pixel to pixel: tile coordinates in texels, Q16, and its depth as a fraction of the
 * view's range, Q31; negative before the near plane. Coordinates within +-2^28. */
typedef struct {
    int32_t u_q16, v_q16, depth_q31;
} gn_receiver_step;

/* n pixels on. Depth wraps around where it is not read. */
GN_HOT static inline void gn_receiver_advance(gn_receiver_step *at, const gn_receiver_step *step, int32_t n)
{
    at->u_q16 += n * step->u_q16;
    at->v_q16 += n * step->v_q16;
    at->depth_q31 = (int32_t)((uint32_t)at->depth_q31 + (uint32_t)n * (uint32_t)step->depth_q31);
}

/* ---- Lookups in a shadow tile ------------------------------------------------------------------------------------ */

/* Which texels are nearer to the light than the receiver. All filters are built from them. */

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

/* Whether n x n texels from (u, v) on lie in the tile and compare with one depth, so that taps need no checks. */
GN_HOT static inline int gn_lookup_is_plain(const gn_lookup *l, int32_t u, int32_t v, int32_t n)
{
    return !(GN_PLANES && l->sloped) && (uint32_t)u <= (uint32_t)(l->view->tile_texels - n) &&
           (uint32_t)v <= (uint32_t)(GN_TILE_ROWS(l->view) - n);
}

/* Texels of row v, n from u on, wherever they lie: bit i is set where texel i keeps the receiver dark. */
uint32_t gn_lookup_dark(const gn_lookup *l, int32_t u, int32_t v, int32_t n);

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

/* ---- Filters that weigh texels ----------------------------------------------------------------------------------- */

/* Tents (F3). Compares come first, weights are exact integers, and one division, done as a multiplication, comes
 * last. Inline, as each has one caller per pixel. */

#define GN_TENT_TAPS_MAX 8

/* Weights of the 2 (k + 1) texels of a tent along one axis, k = 1, 2, 3: exact rationals over (2k + 1)^2 F^2, which
 * they sum to. u = F * frac(centre + 1/2), 0 <= u <= F, F = 2^bits <= 4096: everything stays below 2^30. */
void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t bits);

/* Rounded to `bits`; F itself is allowed: the weights are continuous there */
GN_HOT static inline uint32_t gn_filter_fraction(int32_t c_q16, int32_t bits)
{
    return (((uint32_t)c_q16 & 0xFFFFU) + (0x8000U >> bits)) >> (16 - bits);
}

/* Sum of the products of weights of the dark texels of n x n. */
GN_HOT static inline uint64_t gn_weighted(const uint8_t *dark, int32_t n, const uint32_t *wu, const uint32_t *wv)
{
    uint64_t sum = 0;
    for (int32_t j = 0; j < n; j++) {
        const uint32_t *w = wu;
        uint32_t across = 0;
        for (uint32_t bits = dark[j]; bits; bits >>= 1, w++) across += bits & 1U ? *w : 0;
        sum += (uint64_t)across * wv[j];
    }
    return sum;
}

/* sum / (N * 2^scale_bits) in Q16, scale = round(2^32 / N): 20 fraction bits are kept, kept <= N * 2^20 < 2^32. */
GN_HOT static inline uint32_t gn_weighted_fraction(uint64_t sum, int32_t scale_bits, uint32_t scale)
{
    int32_t drop = scale_bits - 20;
    uint64_t kept = drop >= 0 ? sum >> drop : sum << -drop;
    return (uint32_t)((kept * scale + ((uint64_t)1 << 35)) >> 36);
}

/* Which of n x n texels from (u, v) on keep the receiver dark: bit i of dark[j] for texel i of row j. Returns the OR of
 * all rows, and in the upper half their AND. */
GN_HOT static inline uint32_t gn_tent_dark(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint8_t *dark)
{
    int32_t depth_bits = GN_VIEW_BITS(l->view);
    int is_plain = gn_lookup_is_plain(l, u, v, n);
    uint32_t any = 0, all = 255;
    if (is_plain && depth_bits == 16)
        return gn_kernel_dark_texels16(gn_view_texels(l->view, u, v).d16, l->view->tile_texels, l->least, n, dark);
    for (int32_t j = 0; j < n; j++) {
        uint32_t row_dark = 0;
        if (is_plain) {
            gn_texels row = gn_view_texels(l->view, u, v + j);
            for (int32_t i = 0; i < n; i++)
                row_dark |= (uint32_t)(gn_texel_load(row, depth_bits, (uint32_t)i) < l->least) << i;
        } else row_dark = gn_lookup_dark(l, u, v + j, n);
        dark[j] = (uint8_t)row_dark;
        any |= row_dark;
        all &= row_dark;
    }
    return any | all << 16;
}

/* Attenuation of a lookup with both dark and lit texels, a byte of `dark` per row, by the tent of index k.
 * cu, cv: the receiver, half a texel down and right, Q16, of which the fraction counts. */
GN_HOT static inline uint32_t gn_tent_of_dark(const uint8_t *dark, int32_t k, int32_t cu, int32_t cv, int32_t bits)
{
    uint32_t wu[GN_TENT_TAPS_MAX], wv[GN_TENT_TAPS_MAX];
    uint32_t u = gn_filter_fraction(cu, bits), v = gn_filter_fraction(cv, bits);
    gn_tent_weights(wu, k, u, bits);
    gn_tent_weights(wv, k, v, bits);
    /* along a row <= 49 F^2 < 2^30, all <= (2k + 1)^4 F^4 <= 2401 * 2^48 */
    uint32_t whole = k == 1 ? 81 : k == 2 ? 625 : 2401;
    uint64_t sum = ((uint64_t)whole << 4 * bits) - gn_weighted(dark, 2 * (k + 1), wu, wv);
    return gn_weighted_fraction(sum, 4 * bits,
                                k == 1   ? 53024288U
                                : k == 2 ? 6871948U
                                         : 1788824U); /* round(2^32 / whole) */
}

/* Attenuation by the 3x3 filter of four rows of four texels, a bit each that is dark, to 1/32 texel: u, v in Q16, half
 * a texel down and right, and rounded: 1024 more. */
GN_HOT static inline uint32_t gn_tent_of_4x4(uint32_t a, uint32_t b, uint32_t c, uint32_t d, int32_t u, int32_t v)
{
    const uint16_t *across = gn_tent_sums[u >> 11 & 31], *down = gn_tent_sums[v >> 11 & 31];
    const uint32_t sum = across[a] * (uint32_t)down[1] + across[b] * (uint32_t)down[2] + across[c] * (uint32_t)down[4];
    return 65536 - ((sum + across[d] * (uint32_t)down[8]) >> 8); /* 2^12 * 2^12 */
}

/* Attenuation by 2x2 texels, a bit each that is dark; u, v as gn_tent_of_dark() has them. */
GN_HOT static inline uint32_t gn_tent_of_2x2(uint32_t upper, uint32_t lower, int32_t u, int32_t v, int32_t bits)
{
    const uint32_t wu = gn_filter_fraction(u, bits), wv = gn_filter_fraction(v, bits), one = 1U << bits;
    const uint32_t above = (upper & 1U ? one - wu : 0) + (upper & 2U ? wu : 0),
                   below = (lower & 1U ? one - wu : 0) + (lower & 2U ? wu : 0),
                   lit = (one << bits) - (one - wv) * above - wv * below; /* <= F^2 <= 2^24 */
    return bits <= 8 ? lit << (16 - 2 * bits) : (lit + ((1U << (2 * bits - 16)) >> 1)) >> (2 * bits - 16);
}

/* Attenuation by the tent of index k. [F3] */
GN_HOT static inline uint32_t gn_tent_attenuation(const gn_lookup *l, int32_t k, int32_t bits)
{
    int32_t cu = l->u_q16 + 32768, cv = l->v_q16 + 32768, n = 2 * (k + 1);
    int32_t u0 = (cu >> 16) - (k + 1), v0 = (cv >> 16) - (k + 1);
    uint8_t dark[GN_TENT_TAPS_MAX];
    GN_COUNT(undecided, 1);
    GN_COUNT(taps_tent, n * n);
    const uint32_t found = gn_tent_dark(l, u0, v0, n, dark);
    if (!(found & 0xFFFFU)) return 65536;
    if (found >> 16 == (1U << n) - 1) return 0;
    return gn_tent_of_dark(dark, k, cu, cv, bits);
}

/* ---- Texel windows ----------------------------------------------------------------------------------------------- */

/* Which texels of a part of a shadow tile keep a plane in the dark, a bit each.  A filter compares texels with the
 * depth of the pixel; a window compares each once with the depth of the receiver's plane at the texel. Both agree
 * but where a texel's depth is within the filter's reach times the plane's slope of the plane. Behind the plane, and
 * within half of that before it, a texel is in doubt: lookups compare it with the receiver's own depth. What that
 * leaves of differences to gn_filter_attenuation is in NUMERICS 4.13. */

#if GN_INTERPOLATES

/* Makes a window of a view that knows a plane by its slopes: change of depth per texel, a fraction of the range.
 * own_q30: how far bias keeps the texels of the surface itself behind the plane: they are not in doubt. on_plane: taps
 * are compared with the plane (B5), none is in doubt. Returns 0 if the plane is too steep, or the filter has no
 * windows.
 */
int gn_window_begin(gn_window *window, const gn_frame *frame, const gn_light_view *view, const int32_t slope_q28[2],
                    int64_t own_q30, int on_plane);

/* The texels that filters read of receivers whose tile coordinates lie in lo .. hi: the first, and how many. edge: of
 * those along which outlines are followed, GN_VIEW_EDGE; up to 1 where texels that are all alike tell as much. */
void gn_window_reads(const gn_light_view *view, int32_t edge, int32_t lo_q16, int32_t hi_q16, int32_t *first,
                     int32_t *n);

/* Compares w x h texels from (u0, v0) on, all at most GN_WINDOW_TEXELS, with the plane through a place. Returns 0 if
 * the plane leaves the range of depths there, or all lie beyond a border that repeats; before all of the range it is
 * lit. */
int gn_window_compare(gn_window *window, const gn_window_place *place, int32_t u0, int32_t v0, int32_t w, int32_t h);

GN_HOT static inline int gn_window_covers(const gn_window *window, int32_t u0, int32_t v0, int32_t w, int32_t h)
{
    return u0 >= window->u0 && v0 >= window->v0 && u0 + w <= window->u0 + window->w && v0 + h <= window->v0 + window->h;
}

/* Depth of the plane at tile coordinates in the window. */
GN_HOT static inline int32_t gn_window_depth(const gn_window *window, int32_t u_q16, int32_t v_q16)
{
    int64_t du = u_q16 - window->u0 * 65536 - 32768, dv = v_q16 - window->v0 * 65536 - 32768;
    return window->depth_q30 + (int32_t)((du * window->slope_q30[0] + dv * window->slope_q30[1]) >> 16);
}

GN_HOT static inline int32_t gn_window_depth_step(const gn_window *window, int32_t u_q16, int32_t v_q16)
{
    return (int32_t)(((int64_t)u_q16 * window->slope_q30[0] + (int64_t)v_q16 * window->slope_q30[1]) >> 16);
}

/* Whether w x h texels lie beyond the tile: no window tells of those. */
GN_HOT static inline int gn_window_is_beyond(const gn_light_view *view, int32_t u, int32_t v, int32_t w, int32_t h)
{
    return u + w <= 0 || v + h <= 0 || u >= view->tile_texels || v >= GN_TILE_ROWS(view);
}

/* Of texels that it covers: GN_WINDOW_LIT, _DARK or _MIXED. */
int gn_window_says(const gn_window *window, int32_t u0, int32_t v0, int32_t w, int32_t h);

/* Attenuations of n receivers on the plane; texels in doubt are compared with their depths, which are in Q30 here, and
 * the plane's, from that at so many receivers `behind` on, if that is not negative. Returns GN_WINDOW_LIT or _DARK if
 * all of them are, and sets none; else _MIXED, or GN_WINDOW_MISSED if the window does not cover all. */
int gn_window_row(const gn_frame *frame, const gn_window *window, const gn_receiver_step *from,
                  const gn_receiver_step *step, int32_t n, int32_t behind, uint32_t *attenuation);

#endif

#endif
