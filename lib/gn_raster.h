/* Visible surfaces of a screen tile (R2): depth and triangle identity per pixel, before any shading. */
#ifndef GN_RASTER_H
#define GN_RASTER_H

#include "gn_bin.h"
#include "gn_walk.h"

/* Fills scratch->cell, rows of rect.x1 - rect.x0. A cell is near / Z in its high bits and triangle + 1 in its low id_bits; the
 * larger cell wins, so the result does not depend on the order of triangles. */
void gn_raster_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx);

/* Starts walking a triangle's rows inside the rectangle. */
int gn_raster_walk(const gn_frame *frame, gn_walk *walk, const gn_tri *tri, const gn_rect *rect);

#endif
