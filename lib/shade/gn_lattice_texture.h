/* Texture coordinates of a cell: bilinear between its corners, or quadratics through more exact places. */
#ifndef GN_LATTICE_TEXTURE_H
#define GN_LATTICE_TEXTURE_H

#include "geometry/gn_texture.h"
#include "shade/gn_corner.h"

#if GN_INTERPOLATES && GN_TEXTURES

/* A coordinate down a column, in texels: from + down t + 2 bent t (t - 1), t = 0 .. 1 over the cell. */
typedef struct {
    int32_t from_q17, down_q17, bent_q17;
} gn_texture_column;

/* u and v in the left, the middle and the right column. */
typedef struct {
    gn_texture_column column[2][3];
    int32_t bends_rows;
} gn_texture_patch;

/* Of the cell at hand, 2^size_log2 pixels from (x, y) on, with these corners; `texture`: the surface's, or a level. */
void gn_lattice_texture_begin(gn_shading *shading, const gn_texture *texture, int32_t x, int32_t y, int32_t size_log2,
                              gn_corner *const corner[4], gn_texture_patch *out);

/* Colours of the texture in a row, `below` pixels under the cell's first row: of the pixels `bits`, the lowest of which
 * is the cell's pixel `first`; others are not set, or to anything. */
void gn_lattice_texture_row(const gn_texture_patch *patch, const gn_texture *texture, int32_t size_log2, int32_t below,
                            int32_t first, uint32_t bits, uint16_t (*rgb)[3]);

#endif

#endif
