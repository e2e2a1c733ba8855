/* Small triangles: light, colours and places in shadow maps are found at the vertices, and are linear on the screen in
 * between (NUMERICS 4.17). */
#ifndef GN_FACET_H
#define GN_FACET_H

#include "gnomon.h"

#if GN_INTERPOLATES

/* Shades the surface's n_px pixels in the spans of s->lattice, all of which are in `box`, after
 * gn_corner_begin_lights(). Returns 0 if they are to be shaded by cells: nothing is drawn. */
int gn_facet_shade(gn_shading *s, const gn_rect *box, int32_t n_px);

#endif

#endif
