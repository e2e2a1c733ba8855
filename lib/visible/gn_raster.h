/* Drawing a screen tile's triangles as they are set up. */
#ifndef GN_RASTER_H
#define GN_RASTER_H

#include "base/gn_hint.h"
#include "gnomon.h"

/* A screen tile that is being drawn. */
typedef struct gn_raster_target gn_raster_target;

/* Constants of a triangle's rows. A candidate cell is depth in the high bits, identity in the low ones. */
typedef struct {
    uint32_t minus_dx;  /* from a cell to the one before it */
    uint32_t lo, range; /* depth inside the triangle: lo .. lo + range */
    uint32_t id_mask;
    uint32_t below; /* id_mask - id: from a cell with all identity bits set to the triangle's cell */
} gn_raster_depth;

/* Depth is linear over a row; inside the triangle it stays within its range. A snapped edge can extend past the
 * unsnapped triangle by a fraction of a pixel, so values outside are clamped to the nearer end (modulo 2^32). */
GN_HOT static inline uint32_t gn_raster_clamp(uint32_t v, const gn_raster_depth *depth)
{
    uint32_t above = v - depth->lo;
    if (above <= depth->range) return v;
    return 0U - above < above - depth->range ? depth->lo : depth->lo + depth->range;
}

/* Draws a triangle whose bounds intersect the tile. Identities must ascend. */
void gn_raster_triangle(const gn_raster_target *target, const gn_tri *tri, uint32_t id);

#endif
