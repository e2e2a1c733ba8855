/* Clipping of polygons in view space against the near plane and the guard band (R3). */
#ifndef GN_CLIP_H
#define GN_CLIP_H

#include "gnomon.h"

#define GN_CLIP_VERTICES_MAX 8 /* a triangle against five planes */

typedef struct {
    int32_t v_q16[GN_CLIP_VERTICES_MAX][3]; /* X right, Y up, Z forward */
    int n;
} gn_polygon;

enum { GN_OUT_NEAR = 1, GN_OUT_LEFT = 2, GN_OUT_RIGHT = 4, GN_OUT_BOTTOM = 8, GN_OUT_TOP = 16 };

/* Which planes a point is outside of: the near plane and the four planes |X| = side[0] Z, |Y| = side[1] Z. */
uint32_t gn_outcode(const int32_t v_q16[3], int32_t near_q16, const int32_t side_q16[2]);

/* Cuts the polygon by the planes in `planes` (an OR of the above). An edge's cut depends only on its end points and the
 * plane, so that neighbouring triangles get the same vertices. */
void gn_clip(gn_polygon *polygon, uint32_t planes, int32_t near_q16, const int32_t side_q16[2]);

#endif
