/* A surface by cells: squares of pixels, between whose corners light is interpolated. Cells whose light is too uneven
 * are split; what even the smallest cannot show is shaded pixel by pixel (gn_corner_pixel). */
#ifndef GN_LATTICE_H
#define GN_LATTICE_H

#include "shade/gn_lattice_look.h"

#if GN_INTERPOLATES

/* Shades the surface's pixels in the spans of s->lattice: n_spans > 0. */
void gn_lattice_shade(gn_shading *s);

/* Once per screen tile. */
void gn_lattice_begin_tile(gn_shading *s);

/* Draws the pixels of a cell that its look is known of: gn_lattice_draw.c. */
void gn_lattice_draw(gn_shading *s, int32_t x, int32_t y, int32_t size_log2);

/* Pixels of the part in a row of a cell. */
GN_HOT static inline uint32_t gn_lattice_bits(const gn_lattice *l, int32_t x, int32_t y, int32_t size_log2)
{
    uint32_t at = (uint32_t)(x - l->x);
    return l->bits[at >> 5][y - l->y] >> (at & 31) & ((1U << (1 << size_log2)) - 1);
}

/* The columns of a cell that have pixels in rows y .. y + n_rows - 1. */
GN_HOT static inline uint32_t gn_lattice_columns(const gn_lattice *l, int32_t x, int32_t y, int32_t n_rows,
                                                 int32_t size_log2)
{
    uint32_t at = (uint32_t)(x - l->x), any = 0;
    const uint32_t *row = &l->bits[at >> 5][y - l->y];
    for (int32_t i = 0; i < n_rows; i++) any |= row[i];
    return any >> (at & 31) & ((1U << (1 << size_log2)) - 1);
}

#endif

#endif
