/* Directional light views: which light gets a shadow tile and how the tile lies in the world (D1-D3, DESIGN 1.4). */
#ifndef GN_CASCADE_H
#define GN_CASCADE_H

#include "gnomon.h"

/* Fills frame->light and, for every light that gets a shadow tile, frame->view. */
gn_status gn_cascade_setup(gn_frame *frame);

#if GN_SHADOWS
/* Bounding sphere of a slice of the frustum, as fractions of its far end: depth of the centre and radius, Q8.24. */
void gn_cascade_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, int64_t *centre_q24, int64_t *radius_q24);

/* Tile coordinates of a world point before the origin is taken off: p . axis / texel, Q16, within 1 LSB + 2^-29 of the value. */
int64_t gn_light_coord_q16(const gn_light_view *view, int axis_idx, const int32_t p_q16[3]);
#endif

#endif
