/* Cells without an edge of a shadow: one colour, or few of them. */
#ifndef GN_LATTICE_BLOCK_H
#define GN_LATTICE_BLOCK_H

#include "gnomon.h"

#if GN_INTERPOLATES

/* Draws a cell whose colours are bilinear between its corners, without a texture. */
void gn_lattice_draw_blocks(gn_shading *s, int32_t x, int32_t y, int32_t size_log2);

#endif

#endif
