/* What a cell of a screen tile holds: near / Z in its high bits, the identity of a triangle in its low id_bits. */
#ifndef GN_CELL_H
#define GN_CELL_H

#include "gnomon.h"

/* A triangle's identity in a cell: 1 .. n_triangles, larger for earlier triangles, which thereby win where depths are
 * equal. */
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
