/* Shading of a screen tile: each visible pixel once, triangle by triangle, in runs (R2, R4). */
#ifndef GN_SHADE_H
#define GN_SHADE_H

#include "gnomon.h"

/* From scratch->cell to scratch->pixel. */
void gn_shade_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx);

#endif
