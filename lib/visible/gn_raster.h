/* Drawing a screen tile's triangles as they are set up. */
#ifndef GN_RASTER_H
#define GN_RASTER_H

#include "gnomon.h"

/* A screen tile that is being drawn. */
typedef struct gn_raster_target gn_raster_target;

/* Draws a triangle whose bounds intersect the tile. Identities must ascend. */
void gn_raster_triangle(const gn_raster_target *target, const gn_tri *tri, uint32_t id);

#endif
