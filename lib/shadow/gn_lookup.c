/* Texels compared with a receiver's depth. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "shadow/gn_lookup.h"
#include "shadow/gn_texel_rows.h"

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

#if GN_PLANES && !GN_SIZE_FIRST
/* Whether w x h texels from (u, v) on lie in the tile, and the plane in what texels hold: its least and most there. */
GN_HOT static inline int is_plain_plane(const gn_lookup *l, int32_t u, int32_t v, int32_t w, int32_t h, int64_t *lo,
                                        int64_t *hi)
{
    const gn_light_view *view = l->view;
    if (u < 0 || v < 0 || u > view->tile_texels - w || v > GN_TILE_ROWS(view) - h) return 0;
    gn_plane_range(l, u, v, w - 1, h - 1, lo, hi);
    return *lo >= 0 && *hi <= (int64_t)gn_texel_far(GN_VIEW_BITS(view));
}

/* Those of n texels of a row that are before depths that grow by 4 `across`, from `least` on. */
GN_HOT static inline uint32_t before_plane(gn_texels row, int32_t bits, int32_t n, uint32_t least, uint32_t across)
{
    if (bits == 16) /* steps are whole quarters */
        return gn_texels_before(row.d16, n, (int32_t)((least >> 2) + ((least & 3U) != 0)), (int32_t)across);
    uint32_t near = 0;
    for (int32_t i = n - 1; i >= 0; i--)
        near = near << 1 | (gn_texel_load(row, bits, (uint32_t)i) < least + (uint32_t)i * (4 * across));
    return near;
}

GN_HOT int gn_lookup_on_plane(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint8_t *dark, uint32_t *found)
{
    const gn_light_view *view = l->view;
    const int32_t bits = GN_VIEW_BITS(view);
    const uint32_t across = (uint32_t)l->slope_q28[0] * 4, down = (uint32_t)l->slope_q28[1] * 16;
    int64_t lo, hi;
    if (!is_plain_plane(l, u, v, n, n, &lo, &hi)) return 0;
    GN_COUNT(undecided, 1);
    GN_COUNT(taps_tent, n * n);
    uint32_t least = (uint32_t)gn_least_on_plane(l, u, v), any = 0, all = 255;
    gn_texels row = gn_view_texels(view, u, v);
    for (uint8_t *end = dark + n; dark < end; dark++, least += down) {
        uint32_t near = before_plane(row, bits, n, least, across);
        *dark = (uint8_t)near;
        any |= near;
        all &= near;
        row = gn_texels_at(row, bits, (size_t)view->tile_texels);
    }
    *found = any | all << 16;
    return 1;
}

#if GN_EDGE_BUILT
GN_HOT int gn_lookup_cross_on_plane(const gn_lookup *l, int32_t u, int32_t v, uint32_t *dark)
{
    const gn_light_view *view = l->view;
    const int32_t bits = GN_VIEW_BITS(view), pitch = view->tile_texels;
    if (u < 1 || v < 1 || u > pitch - 2 || v > GN_TILE_ROWS(view) - 2) return 0;
    const uint32_t steep = gn_abs32(l->slope_q28[0]) | gn_abs32(l->slope_q28[1]), most = 32 * steep;
    if (steep >> 25 || l->least_q32 >> 32) return 0;
    const uint32_t least = (uint32_t)l->least_q32;
    if (least < most || least > gn_texel_far(bits) - most) return 0;
    const uint32_t across = (uint32_t)l->slope_q28[0] * 16, down = (uint32_t)l->slope_q28[1] * 16;
    const gn_texels above = gn_view_texels(view, u, v - 1), row = gn_texels_at(above, bits, (size_t)pitch - 1),
                    below = gn_texels_at(row, bits, (size_t)pitch + 1);
    GN_COUNT(taps_lone, 1);
    *dark = (uint32_t)(gn_texel_load(row, bits, 1) < least) |
            (uint32_t)(gn_texel_load(above, bits, 0) < least - down) << 1 |
            (uint32_t)(gn_texel_load(below, bits, 0) < least + down) << 2 |
            (uint32_t)(gn_texel_load(row, bits, 0) < least - across) << 3 |
            (uint32_t)(gn_texel_load(row, bits, 2) < least + across) << 4;
    return 1;
}

GN_HOT int gn_lookup_rows_on_plane(const gn_lookup *l, int32_t u, int32_t v, int32_t w, int32_t h, int32_t at,
                                   uint32_t *rows)
{
    const int32_t bits = GN_VIEW_BITS(l->view);
    int64_t lo, hi;
    if (!is_plain_plane(l, u, v, w, h, &lo, &hi)) return 0;
    uint32_t least = (uint32_t)gn_least_on_plane(l, u, v);
    gn_texels row = gn_view_texels(l->view, u, v);
    for (uint32_t *end = rows + h; rows < end; rows++, least += (uint32_t)l->slope_q28[1] * 16) {
        *rows = before_plane(row, bits, w, least, (uint32_t)l->slope_q28[0] * 4) << at;
        row = gn_texels_at(row, bits, (size_t)l->view->tile_texels);
    }
    return 1;
}
#endif
#endif
