/* Pieces of smooth surfaces. The interpolated normal times n . ray is linear on the screen: so its square and its part
 * along a light are exact from a few numbers per piece, and one root gives n . L at any pixel, however far normals
 * turn. */
#ifndef GN_TURN_H
#define GN_TURN_H

#include "shade/gn_pixel.h"

/* The normal in the middle of the piece, Q28, and half the sides of the piece, in pixels. Returns 0 if it is shorter
 * than half a unit, or changes by more than two. */
int gn_turn_select(gn_pieces *pieces, const gn_slope n_q28[3], uint32_t half_w, uint32_t half_h);

/* Stores n pixels from (x, y) on, all in the piece, in the light that casts a shadow as far as that lets it:
 * attenuation[i] of 65536, or everywhere all or nothing. */
void gn_turn_row(const gn_pieces *pieces, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t n,
                 const uint32_t *attenuation, int all);

#endif
