/* Texture coordinates of a cell: bilinear between its corners, or quadratics that bend as perspective does. */
#ifndef GN_LATTICE_TEXTURE_H
#define GN_LATTICE_TEXTURE_H

#include "geometry/gn_texture.h"
#include "shade/gn_corner.h"
#include "shade/gn_pixel.h"

#if GN_INTERPOLATES && GN_TEXTURES

/* Of the cell at hand, 2^size_log2 pixels from (x, y) on, with these corners; `texture`: the surface's, or a level. */
void gn_lattice_texture_begin(const gn_lattice *lattice, const gn_texture *texture, int32_t x, int32_t y,
                              int32_t size_log2, gn_corner *const corner[4], gn_texture_patch *out);

/* A row of it, `below` pixels under the first, from pixel `first` on. */
void gn_lattice_texture_line(const gn_texture_patch *patch, const gn_texture *texture, int32_t size_log2, int32_t below,
                             int32_t first, gn_texture_line *line);

/* The same of all textures, pass by pass from 0 on: one per level that the cell shows. Returns 0 beyond the last. */
int gn_lattice_textures_begin(gn_shading *shading, int32_t x, int32_t y, int32_t size_log2, int32_t pass,
                              gn_cell_textures *out);

/* Where the line finds colours of the textures. */
void gn_lattice_textures_line(gn_lattice *lattice, const gn_cell_textures *textures, gn_pixel_line *line);

/* Colours of the textures in a row, `below` pixels under the cell's first row: of the pixels `bits` of the cell, from
 * its pixel `first` on. Returns those that are of the pass. */
uint32_t gn_lattice_textures_row(gn_lattice *lattice, const gn_cell_textures *textures, int32_t size_log2,
                                 int32_t below, int32_t first, uint32_t bits);

#endif

#endif
