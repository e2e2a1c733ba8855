/* Texels compared with a receiver's depth. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "shadow/gn_lookup.h"

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
    if (GN_RECEIVER_PLANE && l->sloped) return dark_on_plane(l, row, u, in_v, n);
    for (int32_t i = 0; i < n; i++) dark |= (uint32_t)is_dark(view, row, u + i, l->least) << i;
    return dark;
}
