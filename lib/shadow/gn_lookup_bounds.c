/* Lookups that bounds of depth decide. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "shadow/gn_lookup.h"

/* The smallest and largest `least` over n x n texels from (u, v) on. */
GN_HOT static void least_over(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint32_t *smallest,
                              uint32_t *largest)
{
    *smallest = *largest = l->least;
    if (!GN_PLANES || !l->sloped) return;
    int32_t last = l->view->tile_texels - 1, last_row = GN_TILE_ROWS(l->view) - 1;
    int32_t u0 = gn_max32(0, gn_min32(u, last)), v0 = gn_max32(0, gn_min32(v, last_row));
    int64_t lo, hi;
    gn_plane_range(l, u0, v0, gn_max32(0, gn_min32(u + n - 1, last)) - u0,
                   gn_max32(0, gn_min32(v + n - 1, last_row)) - v0, &lo, &hi);
    *smallest = gn_limited_depth(l->view, lo);
    *largest = gn_limited_depth(l->view, hi);
}

GN_HOT int gn_lookup_decided(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint32_t *answer)
{
    uint32_t smallest, largest;
    least_over(l, u, v, n, &smallest, &largest);
    return gn_blocks_decide(l->view, u, v, n, smallest, largest, answer);
}
