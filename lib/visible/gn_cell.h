/* Cells of a screen tile: near / Z in the high bits, the identity of a triangle in the low id_bits. */
#ifndef GN_CELL_H
#define GN_CELL_H

#include "gnomon.h"

/* A triangle's identity in a cell: 1 .. n_triangles, larger for earlier triangles, so that they win at equal depth. */
GN_HOT static inline uint32_t gn_cell_id(const gn_frame *frame, uint32_t tri_idx)
{
    return frame->stats.n_triangles - tri_idx;
}

/* The triangle of an identity. */
GN_HOT static inline const gn_tri *gn_cell_tri(const gn_frame *frame, uint32_t id)
{
    return &frame->tri[frame->stats.n_triangles - id];
}

#endif
