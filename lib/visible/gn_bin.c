/* Counting sort of triangles into screen tiles, in triangle order. */
#include "gn_internal.h"

#include "gn_stages.h"
#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "scene/gn_scene.h"
#include "visible/gn_setup.h"

/* Puts a triangle into the bins of the screen tiles within its bounds. */
static inline void bin_by_bounds(gn_frame *frame, uint32_t tri_idx)
{
    gn_rect px = gn_setup_bounds(frame, &frame->records.tri[tri_idx]);
    gn_tile_walk tiles = gn_setup_tiles(frame, &px);
    gn_ref_offset *at = frame->tile_first + tiles.first;
    do {
        int32_t n = tiles.width;
        do frame->tile_ref[--*at++] = (uint16_t)tri_idx;
        while (--n);
        at += tiles.skip;
    } while (--tiles.height);
}

static void sort_triangles(gn_frame *frame, uint32_t n_tiles)
{
    gn_ref_offset *first = frame->tile_first;
    /* offsets to the end of each bin; filling backwards leaves each at its bin's start, in triangle order */
    for (uint32_t i = 1; i <= n_tiles; i++) first[i] = (gn_ref_offset)(first[i] + first[i - 1]);
    for (uint32_t t = frame->stats.n_triangles; t-- > 0;) bin_by_bounds(frame, t);
}

/* Whether the identities of every screen tile have room, with groups. */
static gn_status check_tiles(gn_frame *frame, uint32_t n_tiles)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < n_tiles; i++)
        if (frame->tile_first[i] > most) most = frame->tile_first[i];
#if GN_GROUPS
    frame->stats.n_tile_triangles = most;
#endif
    return most > GN_MAX_TRIANGLES ? gn_fail_capacity(frame, GN_ERR_TRIANGLES_FULL, most, GN_MAX_TRIANGLES) : GN_OK;
}

/* The triangles of every screen tile, in the order of the scene. A function of its own: a stage that is counted. [R1]
 */
GN_NOINLINE gn_status gn_bin_triangles(gn_frame *frame)
{
    uint32_t n_tiles = (uint32_t)frame->tiles_x * frame->tiles_y;
    uint64_t n_refs = 0;
    for (uint32_t i = 0; i < n_tiles; i++) n_refs += frame->tile_first[i];
    frame->stats.n_tile_refs = n_refs > UINT32_MAX ? UINT32_MAX : (uint32_t)n_refs;
    if (GN_K(frame, triangle_groups)) return check_tiles(frame, n_tiles);
    if (n_refs > GN_MAX_TILE_REFS)
        return gn_fail_capacity(frame, GN_ERR_TILE_REFS_FULL, frame->stats.n_tile_refs, GN_MAX_TILE_REFS);
    GN_COUNT(tile_refs, n_refs);
    sort_triangles(frame, n_tiles);
    return GN_OK;
}
