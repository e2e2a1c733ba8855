/* What a cell looks like: the light at its corners, and which lights' shadows have an edge in it (NUMERICS 4.12). */
#ifndef GN_LATTICE_LOOK_H
#define GN_LATTICE_LOOK_H

#include "shade/gn_corner.h"

#if GN_INTERPOLATES

/* Looks at the cell whose corners, 2^size_log2 pixels apart, are in cell_corner. Fills lattice->look; returns 0 if the
 * cell is too uneven to be interpolated: it is to be split. */
int gn_lattice_look_at(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, int32_t size_log2);

/* Where the pixels of an edge are seen: between the cell's corners; between the ends of each row; each for itself, in
 * its own face of a point light. And a flag: pixels that are not in this face are in that of the next edge. */
enum { GN_PLACES_BILINEAR, GN_PLACES_BY_ROW, GN_PLACES_LONE, GN_PLACES_OF_TWO = 4 };

/* Through values at the corners of a cell. */
GN_HOT static inline void gn_flat_patch_make(gn_flat_patch *p, const int32_t at[4], int32_t size_log2)
{
    int32_t across = (at[1] - at[0]) >> size_log2;
    p->at = at[0];
    p->dx = across;
    p->dy = (at[2] - at[0]) >> size_log2;
    p->dxy = (((at[3] - at[2]) >> size_log2) - across) >> size_log2;
}

/* Value of a patch at (x, y) pixels from its first corner. */
GN_HOT static inline int32_t gn_flat_patch_at(const gn_flat_patch *p, int32_t x, int32_t y)
{
    return p->at + y * p->dy + x * (p->dx + y * p->dxy);
}

#endif

#endif
