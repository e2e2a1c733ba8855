/* A screen tile: its rectangle, and its cells: near / Z in the high bits, the identity of a triangle in the low
 * id_bits. Identities are 1 .. n, larger for earlier triangles, so that these win at equal depth: n are the frame's
 * triangles, or with groups the tile's. */
#ifndef GN_CELL_H
#define GN_CELL_H

#include <stddef.h>

#include "base/gn_q.h"
#include "gnomon.h"

/* The pixels of screen tile `tile_idx`, cut to the picture; tiles are counted row by row. */
static inline gn_rect gn_screen_rect(const gn_frame *frame, uint32_t tile_idx)
{
    int32_t w = GN_K(frame, tile_width), h = GN_K(frame, tile_height);
    gn_rect r;
    r.x0 = (int32_t)(tile_idx % frame->tiles_x) * w;
    r.y0 = (int32_t)(tile_idx / frame->tiles_x) * h;
    r.x1 = gn_min32(r.x0 + w, frame->picture.width);
    r.y1 = gn_min32(r.y0 + h, frame->picture.height);
    return r;
}

/* The identity of the frame's triangle. */
GN_HOT static inline uint32_t gn_cell_id(const gn_frame *frame, uint32_t tri_idx)
{
    return frame->stats.n_triangles - tri_idx;
}

/* The triangle of an identity. */
GN_HOT static inline const gn_tri *gn_cell_tri(const gn_frame *frame, uint32_t id)
{
    return &frame->records.tri[frame->stats.n_triangles - id];
}

#if !GN_COMPACT
/* Where identity 0 would have its source: those of others lie at equal distances. */
GN_HOT static inline const char *gn_cell_sources(const gn_frame *frame, const gn_scratch *scratch)
{
    (void)scratch;
#if GN_GROUPS
    if (GN_K(frame, triangle_groups)) return (const char *)scratch->drawn;
#endif
    return (const char *)gn_cell_tri(frame, 0) + offsetof(gn_tri, source);
}

GN_HOT static inline const gn_tri_source *gn_cell_source(const gn_frame *frame, const char *sources, uint32_t id)
{
    const int32_t bytes = GN_K(frame, triangle_groups) ? (int32_t)sizeof(gn_tri_source) : -(int32_t)sizeof(gn_tri);
    return (const gn_tri_source *)(const void *)(sources + (int32_t)id * bytes);
}
#endif

#endif
