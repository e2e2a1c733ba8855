/* Texel windows. [B5] */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shadow/gn_filter.h"

#if GN_INTERPOLATES

/* ---- Comparing --------------------------------------------------------------------------------------------------- */

/* How far from a receiver the centres of the texels are that its filter reads, per axis, in half texels. */
GN_HOT static uint32_t reach_halves(const gn_light_view *view)
{
    return view->filter == GN_FILTER_HARD ? 1 : 2 * ((uint32_t)view->filter_idx + 1);
}

/* Depths in doubt: as far behind the plane as its slope and the filter reach, and in front of it; of 3x3 half of that
 * there, as what casts a shadow so near is under few of the filter's texels. The fastest shading takes the surface's
 * own texels for lit. Slopes at their limit are not the plane's. */
GN_HOT int gn_window_begin(gn_window *window, const gn_frame *frame, const gn_light_view *view,
                           const int32_t slope_q28[2], int64_t own_q30, int on_plane)
{
    uint32_t steep = gn_abs32(slope_q28[0]) | gn_abs32(slope_q28[1]);
    int32_t dropped = gn_dropped_bits(view);
    window->view = view;
    window->w = 0;
    window->planar = view->filter != GN_FILTER_DISK && !(steep >> gn_min32(25, GN_SLOPE_LIMIT_LOG2(view)));
    if (!window->planar) return 0;
    window->slope_q30[0] = slope_q28[0] * 4;
    window->slope_q30[1] = slope_q28[1] * 4;
    uint32_t per_half_q30 = 2 * (gn_abs32(slope_q28[0]) + gn_abs32(slope_q28[1]));
    if (on_plane) { /* compared there, with what rounds to it */
        window->behind_q30 = dropped ? -(1 << (dropped - 3)) : 0;
        window->front_q30 = -window->behind_q30;
        return 1;
    }
    uint32_t halves = reach_halves(view), rounding = (dropped ? 1U << (dropped - 3) : 0) + 4 * GN_WINDOW_TEXELS + 16;
    const int fast = GN_K(frame, persp_step) == 16;
    window->behind_q30 = (int32_t)(per_half_q30 * halves + rounding);
    window->front_q30 = (int32_t)(per_half_q30 * (view->filter_idx == 1 ? halves >> 1 : halves) + rounding);
    int64_t safe_q30 = own_q30 - (own_q30 >> 3) - ((int64_t)1 << 30 >> GN_VIEW_BITS(view));
    int enough = own_q30 + (own_q30 >> 3) >= window->behind_q30; /* the reference sees no acne */
    if (enough) window->behind_q30 = window->front_q30;
    if ((fast || enough) && safe_q30 > 0 && safe_q30 < window->behind_q30) window->behind_q30 = (int32_t)safe_q30;
    return 1;
}

GN_HOT void gn_window_reads(const gn_light_view *view, int32_t edge, int32_t lo_q16, int32_t hi_q16, int32_t *first,
                            int32_t *n)
{
    if (edge || view->filter == GN_FILTER_HARD) {
        *first = (lo_q16 >> 16) - edge;
        *n = (hi_q16 >> 16) + 1 + edge - *first;
        return;
    }
    int32_t k = view->filter_idx;
    *first = ((lo_q16 + 32768) >> 16) - (k + 1);
    *n = ((hi_q16 + 32768) >> 16) + k + 1 - *first;
}

/* Part of a tile whose texels are compared, and the depth at its first one. */
typedef struct {
    const gn_light_view *view;
    int32_t u, v, n;
    int32_t depth_q30, step_q30[2];
    int32_t reach_q30; /* so much farther than what may be before the plane is what surely is */
} texel_rows;

/* Which texels of row j are dark, as they may be before the plane, and which of them are in doubt. */
GN_HOT static void compare_row(const texel_rows *rows, int32_t j, uint32_t *dark, uint32_t *doubt)
{
    int32_t bits = GN_VIEW_BITS(rows->view), depth = rows->depth_q30 + j * rows->step_q30[1];
    gn_texels row = gn_view_texels(rows->view, rows->u, rows->v + j);
    uint32_t maybe = 0, surely = 0;
    for (int32_t i = rows->n - 1; i >= 0; i--) {
        int32_t beyond = (int32_t)(gn_texel_load(row, bits, (uint32_t)i) >> 2) - (depth + i * rows->step_q30[0]);
        maybe = maybe << 1 | (uint32_t)beyond >> 31;
        surely = surely << 1 | (uint32_t)(beyond + rows->reach_q30) >> 31;
    }
    *dark = maybe;
    *doubt = maybe & ~surely;
}

/* Repeats the first and the last bit of n on both sides, or leaves both sides lit. */
GN_HOT static uint32_t repeat_border(uint32_t bits, int32_t left, int32_t n, int32_t right, int lit)
{
    uint32_t out = bits << left;
    if (!lit && bits & 1U) out |= (1U << left) - 1;
    if (!lit && right && bits >> (n - 1) & 1U) out |= ((1U << right) - 1) << (left + n);
    return out;
}

/* Texels beyond the border repeat it, with its depth, or are lit: so do their bits. The tile has n_rows rows of the
 * window from row `first` on, of n texels. */
GN_HOT static GN_NOINLINE void repeat_borders(gn_window *window, int32_t left, int32_t n, int32_t first, int32_t n_rows)
{
    int lit = gn_border_lit(window->view);
    int32_t right = window->w - n - left;
    for (int32_t j = first; j < first + n_rows; j++) {
        window->dark[j] = repeat_border(window->dark[j], left, n, right, lit);
        window->doubt[j] = repeat_border(window->doubt[j], left, n, right, lit);
    }
    for (int32_t j = 0; j < window->h; j++) {
        int32_t from = gn_max32(first, gn_min32(j, first + n_rows - 1));
        if (j == from) continue;
        window->dark[j] = lit ? 0 : window->dark[from];
        window->doubt[j] = lit ? 0 : window->doubt[from];
    }
}

/* Whether depths on the plane over w x h texels can be stepped: the first of them has `first`. 0: no; -1: the plane is
 * nearer to the light than any texel. */
GN_HOT static int in_range(const gn_window *window, int64_t first, int32_t apart, int32_t w, int32_t h)
{
    const int32_t *slope = window->slope_q30;
    int64_t across = (int64_t)slope[0] * w, down = (int64_t)slope[1] * h;
    int64_t lo = first + (across < 0 ? across : 0) + (down < 0 ? down : 0),
            hi = first + (across > 0 ? across : 0) + (down > 0 ? down : 0);
    if (hi + apart + window->behind_q30 < 0) return -1;
    return lo - apart - window->front_q30 >= -(1 << 29) &&
           hi + apart + window->behind_q30 < gn_texel_far(GN_VIEW_BITS(window->view)) >> 2;
}

/* What all rows say. */
GN_HOT static void sum_up(gn_window *window)
{
    uint32_t any = 0, all = UINT32_MAX, doubts = 0;
    for (int32_t j = 0; j < window->h; j++) {
        any |= window->dark[j];
        all &= window->dark[j] & ~window->doubt[j];
        doubts |= window->doubt[j];
    }
    window->any = any;
    window->all = all | (window->w < 32 ? UINT32_MAX << window->w : 0);
    window->doubts = doubts;
}

/* Beyond a border that is lit, or before all that casts. */
GN_HOT static void light_all(gn_window *window)
{
    for (int32_t j = 0; j < window->h; j++) window->dark[j] = window->doubt[j] = 0;
    window->any = window->all = window->doubts = 0;
    window->plain = 0;
}

GN_HOT int gn_window_compare(gn_window *window, const gn_window_place *place, int32_t u0, int32_t v0, int32_t w,
                             int32_t h)
{
    const gn_light_view *view = window->view;
    const int32_t *slope = window->slope_q30, last = view->tile_texels - 1, last_row = GN_TILE_ROWS(view) - 1;
    const int is_beyond = gn_window_is_beyond(view, u0, v0, w, h), lit = gn_border_lit(view);
    int64_t du = u0 * 65536 + 32768 - place->u_q16, dv = v0 * 65536 + 32768 - place->v_q16;
    int64_t first = place->depth_q30 + ((du * slope[0] + dv * slope[1]) >> 16);
    const int within = in_range(window, first, place->apart_q30, w, h), all_lit = (is_beyond && lit) || within < 0;
    window->w = 0;
    if (!within || (is_beyond && !lit)) return 0;
    GN_NOTE_TEXELS(window->squares, view, u0, v0, w, h);
    GN_COUNT(window_texels, w * h);
    window->depth_q30 = (int32_t)first;
    window->u0 = u0;
    window->v0 = v0;
    window->w = w;
    window->h = h;
    if (all_lit) {
        light_all(window);
        return 1;
    }
    int32_t ua = gn_max32(u0, 0), n = gn_min32(u0 + w - 1, last) - ua + 1, left = ua - u0;
    int32_t va = gn_max32(v0, 0), n_rows = gn_min32(v0 + h - 1, last_row) - va + 1, above = va - v0;
    const texel_rows rows = {view,
                             ua,
                             va,
                             n,
                             (int32_t)(first + window->behind_q30 + place->apart_q30) + slope[0] * left +
                                 slope[1] * above,
                             {slope[0], slope[1]},
                             window->front_q30 + window->behind_q30 + 2 * place->apart_q30};
    for (int32_t j = 0; j < n_rows; j++) compare_row(&rows, j, &window->dark[above + j], &window->doubt[above + j]);
    const int inside = n == w && n_rows == h;
    window->plain = inside && GN_VIEW_BITS(view) == 16;
    if (!inside) repeat_borders(window, left, n, above, n_rows);
    sum_up(window);
    if (!inside && !lit) window->any |= 1, window->all = 0; /* beyond the tile each is asked */
    return 1;
}

/* ---- Asking ------------------------------------------------------------------------------------------------------ */

/* What rows say of the texels of `mask`; *doubts: those of them that are in doubt. */
GN_HOT static inline int ask_rows(const uint32_t *dark, const uint32_t *doubt, int32_t h, uint32_t mask,
                                  uint32_t *doubts)
{
    uint32_t any = 0, all = mask, some = 0;
    for (const uint32_t *end = dark + h; dark < end; dark++, doubt++) {
        any |= *dark;
        some |= *doubt;
        all &= *dark & ~*doubt;
    }
    *doubts = some & mask;
    return !(any & mask) ? GN_WINDOW_LIT : all == mask ? GN_WINDOW_DARK : GN_WINDOW_MIXED;
}

GN_HOT int gn_window_says(const gn_window *window, int32_t u0, int32_t v0, int32_t w, int32_t h)
{
    uint32_t doubts;
    if (!window->any) return GN_WINDOW_LIT;
    if (window->all == UINT32_MAX) return GN_WINDOW_DARK;
    return ask_rows(&window->dark[v0 - window->v0], &window->doubt[v0 - window->v0], h,
                    (UINT32_MAX >> (32 - w)) << (u0 - window->u0), &doubts);
}

/* The least depth, Q32, of texels that leave a receiver lit. */
GN_HOT static uint32_t least_depth(const gn_light_view *view, int32_t depth_q30)
{
    uint32_t depth_q32 = depth_q30 < 0 ? 0 : depth_q30 >> 30 ? UINT32_MAX : (uint32_t)depth_q30 << 2;
    return gn_rounded_depth(depth_q32, gn_dropped_bits(view), gn_texel_far(GN_VIEW_BITS(view)));
}

/* Texels of row j that can be dark: beyond a border that is lit none can. */
GN_HOT static uint32_t texels_inside(const gn_window *window, int32_t j)
{
    const gn_light_view *view = window->view;
    const int32_t v = window->v0 + j, left = gn_max32(-window->u0, 0), end = view->tile_texels - window->u0;
    if (!gn_border_lit(view)) return UINT32_MAX;
    if (v < 0 || v >= GN_TILE_ROWS(view) || end <= left) return 0;
    return UINT32_MAX << left & UINT32_MAX >> gn_max32(32 - end, 0);
}

/* Of texels in doubt, from texel 0 of row j on, those before `least`. */
GN_HOT static uint32_t compare_doubts(const gn_window *window, int32_t j, uint32_t doubt, uint32_t least)
{
    const gn_light_view *view = window->view;
    int32_t last = view->tile_texels - 1, v = gn_max32(0, gn_min32(window->v0 + j, GN_TILE_ROWS(view) - 1)),
            bits = GN_VIEW_BITS(view);
    gn_texels row = gn_view_texels(view, 0, v);
    uint32_t dark = 0;
    while (doubt) {
        uint32_t bit = doubt & (0U - doubt);
        int32_t u = window->u0 + 31 - gn_clz32(bit);
        doubt ^= bit;
        GN_COUNT(taps_lone, 1);
        if (gn_texel_load(row, bits, (uint32_t)gn_max32(0, gn_min32(u, last))) < least) dark |= bit;
    }
    return dark;
}

/* Rows of a window that receivers read, at their own depths. */
typedef struct {
    const gn_window *window;
    const uint32_t *dark, *doubt; /* from row v0 of the window on */
    int32_t v0;
    uint32_t doubts; /* of their texels */
} window_rows;

/* Which of n x n texels from texel s of row j on keep a receiver dark, a byte per row: if some are in doubt, all of
 * more than four are compared. Returns the OR of all rows, and in the upper half their AND. */
GN_HOT static uint32_t dark_texels(const window_rows *rows, int32_t s, int32_t j, int32_t n, int32_t depth_q30,
                                   uint8_t *dark)
{
    const gn_window *window = rows->window;
    uint32_t mask = (1U << (uint32_t)n) - 1U, any = 0, all = mask, doubts = 0;
    const uint32_t *row = &rows->dark[j - rows->v0], *doubt = &rows->doubt[j - rows->v0];
    for (int32_t i = 0; i < n; i++) {
        uint32_t bits = row[i] >> s & mask;
        doubts |= doubt[i] >> s & mask;
        dark[i] = (uint8_t)bits;
        any |= bits;
        all &= bits;
    }
    if (!doubts) return any | all << 16;
    uint32_t least = least_depth(window->view, depth_q30);
    if (window->plain && n > 2)
        return gn_kernel_dark_texels16(gn_view_texels(window->view, window->u0 + s, window->v0 + j).d16,
                                       (size_t)window->view->tile_texels, least, n, dark);
    any = 0;
    all = mask;
    for (int32_t i = 0; i < n; i++) {
        uint32_t unknown = (n > 2 ? texels_inside(window, j + i) : doubt[i]) & mask << s, bits = row[i] & ~unknown;
        if (unknown) bits |= compare_doubts(window, j + i, unknown, least);
        bits = bits >> s & mask;
        dark[i] = (uint8_t)bits;
        any |= bits;
        all &= bits;
    }
    return any | all << 16;
}

#if GN_FILTER_MAX >= 2
/* Whether one of the texels that a lookup reads is in doubt. */
GN_HOT static inline uint32_t in_doubt_3x3(const gn_window *window, int32_t j, int32_t s)
{
    const uint32_t *doubt = &window->doubt[j];
    return (doubt[0] | doubt[1] | doubt[2] | doubt[3]) >> s & 15U;
}

/* 3x3, positions to 1/32 texel. */
GN_HOT static void row_3x3(const window_rows *rows, int32_t u, int32_t v, int32_t depth_q30,
                           const gn_receiver_step *step, int32_t n, uint32_t *out)
{
    const gn_window *window = rows->window;
    const uint16_t *texels = window->plain ? gn_view_texels(window->view, window->u0, window->v0).d16 : NULL;
    const uint32_t *first = rows->dark - rows->v0, pitch = window->view->tile_texels, doubts = rows->doubts;
    GN_KEEP(first); /* one pointer */
    u += 1024;      /* rounded, not cut */
    v += 1024;
    for (uint32_t *end = out + n; out < end; out++, u += step->u_q16, v += step->v_q16,
                  depth_q30 = (int32_t)((uint32_t)depth_q30 + (uint32_t)step->depth_q31)) {
        const uint32_t *row = &first[v >> 16];
        int32_t s = u >> 16;
        uint32_t a = row[0] >> s & 15U, b = row[1] >> s & 15U, c = row[2] >> s & 15U, d = row[3] >> s & 15U;
        *out = 65536;
        if (!(a | b | c | d)) continue;
        if (doubts >> s & 15U && in_doubt_3x3(window, v >> 16, s)) {
            uint8_t near[4], dark[4]; /* the one in registers */
            if (!texels) {
                if (!(dark_texels(rows, s, v >> 16, 4, depth_q30, dark) & 15U)) continue;
                a = dark[0], b = dark[1], c = dark[2], d = dark[3];
            } else {
                uint32_t least = least_depth(window->view, depth_q30);
                if (!(gn_kernel_dark_texels16(texels + (uint32_t)(v >> 16) * pitch + s, pitch, least, 4, near) & 15U))
                    continue;
                a = near[0], b = near[1], c = near[2], d = near[3];
            }
        }
        *out = 0;
        if ((a & b & c & d) == 15U) continue;
        *out = gn_tent_of_4x4(a, b, c, d, u, v);
    }
}

#endif

/* The hard filter's texel, or four by their weights: n_across texels each way. */
GN_HOT static inline void row_small(const gn_frame *frame, const window_rows *rows, int32_t u, int32_t v,
                                    int32_t depth_q30, const gn_receiver_step *step, int32_t n, int32_t n_across,
                                    uint32_t *out)
{
    const uint32_t *first = rows->dark - rows->v0, doubts = rows->doubts, mask = (1U << n_across) - 1;
    const int32_t bits = GN_FILTER_BITS(frame);
    for (uint32_t *end = out + n; out < end; out++, u += step->u_q16, v += step->v_q16,
                  depth_q30 = (int32_t)((uint32_t)depth_q30 + (uint32_t)step->depth_q31)) {
        const uint32_t *row = &first[v >> 16];
        int32_t s = u >> 16;
        uint8_t dark[2] = {(uint8_t)(row[0] >> s & mask), (uint8_t)(row[n_across - 1] >> s & mask)};
        *out = 65536;
        if (!(dark[0] | dark[1])) continue;
        if (doubts >> s & mask && !(dark_texels(rows, s, v >> 16, n_across, depth_q30, dark) & mask)) continue;
        *out = (dark[0] & dark[1]) == mask ? 0 : gn_tent_of_2x2(dark[0], dark[1], u, v, bits);
    }
}

#if GN_FILTER_MAX >= 2
/* Any other filter, exactly. */
GN_HOT static GN_NOINLINE uint32_t by_weights(const gn_frame *frame, const window_rows *rows, int32_t u, int32_t v,
                                              int32_t depth_q30)
{
    int32_t k = rows->window->view->filter - GN_FILTER_2X2, n = 2 * (k + 1);
    uint8_t dark[GN_TENT_TAPS_MAX];
    uint32_t found = dark_texels(rows, u >> 16, v >> 16, n, depth_q30, dark);
    if (!(found & 0xFFFFU)) return 65536;
    if (found >> 16 == (1U << n) - 1) return 0;
    return gn_tent_of_dark(dark, k, u, v, GN_FILTER_BITS(frame));
}
#endif

#if GN_EDGE_BUILT
/* The hard filter and 2x2 with edges finer than texels. Windows of such views are of the receiver's plane: no texel is
 * in doubt. */
GN_HOT static GN_NOINLINE void row_edges(const gn_frame *frame, const window_rows *rows, int32_t u, int32_t v,
                                         const gn_receiver_step *step, int32_t n, uint32_t *out)
{
    const gn_light_view *view = rows->window->view;
    const uint32_t *first = rows->dark - rows->v0;
    const int32_t reach = GN_K(frame, edge), end_u = (view->tile_texels - rows->window->u0) * 65536,
                  end_v = (GN_TILE_ROWS(view) - rows->window->v0) * 65536, first_u = -rows->window->u0 * 65536,
                  first_v = -rows->window->v0 * 65536;
    const int beyond = gn_border_lit(view), hard = view->filter == GN_FILTER_HARD;
    int32_t known = INT32_MIN;
    const uint32_t *row = first;
    uint32_t edges = 0;
    for (uint32_t *end = out + n; out < end; out++, u += step->u_q16, v += step->v_q16) {
        const int32_t s = u >> 16;
        if (v >> 16 != known) {
            known = v >> 16;
            row = &first[known];
            edges = gn_edge_texels(row[-1], row[0], row[1]);
        }
        *out = row[0] >> s & 1U ? 0 : 65536;
        if (!(edges >> s & 1U)) continue;
        *out = beyond && (u >= end_u || v >= end_v || u < first_u || v < first_v)
                   ? 65536
                   : gn_edge_attenuation(row, s, reach, u, v, hard);
    }
}
#endif

/* The rows that receivers read, and what they say of all of them. */
GN_HOT static int find_rows(const gn_frame *frame, const gn_window *window, const gn_receiver_step *from,
                            const gn_receiver_step *step, int32_t n, window_rows *rows)
{
    const gn_light_view *view = window->view;
    int32_t end[2] = {from->u_q16 + (n - 1) * step->u_q16, from->v_q16 + (n - 1) * step->v_q16}, u0, w, h;
    gn_window_reads(view, GN_VIEW_EDGE(frame, view), gn_min32(from->u_q16, end[0]),
                    gn_max32(from->u_q16, end[0]) + 1024, &u0, &w);
    gn_window_reads(view, GN_VIEW_EDGE(frame, view), gn_min32(from->v_q16, end[1]),
                    gn_max32(from->v_q16, end[1]) + 1024, &rows->v0, &h);
    if (!gn_window_covers(window, u0, rows->v0, w, h)) return GN_WINDOW_MISSED;
    if (!window->any) return GN_WINDOW_LIT;
    if (window->all == UINT32_MAX) return GN_WINDOW_DARK;
    /* with edges: read, but not asked, as what is next to receivers tells whether all are alike */
    const int32_t rest = GN_VIEW_EDGE(frame, view) ? GN_VIEW_EDGE(frame, view) - 1 : 0;
    uint32_t mask = (UINT32_MAX >> (32 - w + 2 * rest)) << (u0 + rest - window->u0);
    rows->window = window;
    rows->v0 -= window->v0;
    rows->dark = &window->dark[rows->v0];
    rows->doubt = &window->doubt[rows->v0];
    return ask_rows(rows->dark + rest, rows->doubt + rest, h - 2 * rest, mask, &rows->doubts);
}

GN_HOT int gn_window_row(const gn_frame *frame, const gn_window *window, const gn_receiver_step *from,
                         const gn_receiver_step *step, int32_t n, int32_t behind, uint32_t *attenuation)
{
    window_rows rows;
    gn_receiver_step across = *step;
    int said = find_rows(frame, window, from, step, n, &rows);
    if (said != GN_WINDOW_MIXED) return said;
    const gn_light_view *view = window->view;
    int32_t shift =
        view->filter == GN_FILTER_HARD || GN_VIEW_EDGE(frame, view) ? 0 : (view->filter_idx + 1) * 65536 - 32768;
    int32_t u = from->u_q16 - shift - window->u0 * 65536, v = from->v_q16 - shift - window->v0 * 65536;
    int32_t depth_q30 = from->depth_q31;
    if (behind >= 0 && rows.doubts) {
        across.depth_q31 = gn_window_depth_step(window, step->u_q16, step->v_q16);
        depth_q30 = gn_window_depth(window, from->u_q16 - behind * step->u_q16, from->v_q16 - behind * step->v_q16) +
                    behind * across.depth_q31;
    }
    GN_COUNT(window_lookups, n);
#if GN_FILTER_MAX >= 2
    if (view->filter == GN_FILTER_3X3) {
        row_3x3(&rows, u, v, depth_q30, &across, n, attenuation);
        return said;
    }
#endif
#if GN_EDGE_BUILT
    if (GN_VIEW_EDGE(frame, view)) {
        row_edges(frame, &rows, u, v, &across, n, attenuation);
        return said;
    }
#endif
    if (view->filter <= GN_FILTER_2X2) {
        row_small(frame, &rows, u, v, depth_q30, &across, n, 1 + (view->filter == GN_FILTER_2X2), attenuation);
        return said;
    }
#if GN_FILTER_MAX >= 2
    for (int32_t i = 0; i < n; i++, u += step->u_q16, v += step->v_q16) {
        attenuation[i] = by_weights(frame, &rows, u, v, depth_q30);
        depth_q30 = (int32_t)((uint32_t)depth_q30 + (uint32_t)across.depth_q31); /* not used beyond the row */
    }
#endif
    return said;
}

#endif
