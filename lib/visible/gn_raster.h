/* Visible surfaces of a screen tile (R2): depth and triangle identity per pixel, before any shading. */
#ifndef GN_RASTER_H
#define GN_RASTER_H

#include "visible/gn_bin.h"

/* Fills scratch->cell, rows of rect.x1 - rect.x0. A cell is near / Z in its high bits and the triangle's identity in
 * its low id_bits; the larger cell wins, whatever the order of drawing. */
void gn_raster_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx);

/* A triangle's identity in a cell: 1 .. n_triangles, larger for earlier triangles, which thereby win where depths are
 * equal. */
static inline uint32_t gn_raster_id(const gn_frame *frame, uint32_t tri_idx)
{
    return frame->stats.n_triangles - tri_idx;
}

/* The triangle of an identity. */
static inline const gn_tri *gn_raster_tri(const gn_frame *frame, uint32_t id)
{
    return &frame->tri[frame->stats.n_triangles - id];
}

#endif
