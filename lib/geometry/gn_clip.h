/* Clipping of polygons in view space against the near plane and the guard band. */
#ifndef GN_CLIP_H
#define GN_CLIP_H

#include "gnomon.h"

enum { GN_OUT_NEAR = 1, GN_OUT_LEFT = 2, GN_OUT_RIGHT = 4, GN_OUT_BOTTOM = 8, GN_OUT_TOP = 16, GN_OUT_ALL = 31 };

/* Which planes a point is outside of: the near plane and the four planes |X| = side[0] Z, |Y| = side[1] Z;
 * with a flat depth that is in place of Z there. */
uint32_t gn_outcode(const int32_t v_q16[3], int32_t near_q16, const int32_t side_q16[2], int32_t flat_q16);

/* Cuts the polygon by the planes in `planes`. An edge's cut depends only on its end points and the planes, so that
 * neighbouring triangles get the same vertices if both are cut by all: a cut vertex can round to the far side of the
 * next plane. It lies within 2 LSB of the side planes, exactly on the near plane. */
void gn_clip(gn_polygon *polygon, gn_polygon *uncut, uint32_t planes, int32_t near_q16, const int32_t side_q16[2],
             int32_t flat_q16);

#endif
