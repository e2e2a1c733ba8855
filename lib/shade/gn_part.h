/* Parts of a surface of which nothing but shadows varies: filled where a window says that a light falls on all of it,
 * or on none; rows of two colours where it has an edge. */
#ifndef GN_PART_H
#define GN_PART_H

#include "shade/gn_lattice.h"

/* Once per surface: whether it is of that kind. */
void gn_part_begin(gn_shading *s);

/* Shades the pixels of the spans in the part, which ends at part_end or before. Returns 0 if it is not of that kind: it
 * is to be shaded by cells. */
int gn_part_shade(gn_shading *s);

#endif
