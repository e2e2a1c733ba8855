/* Triangles of one plane that are one surface: those of a quad, of a polygon, or of one that was cut. What cells, parts
 * and windows need of a surface is found once for all of them. */
#ifndef GN_JOIN_H
#define GN_JOIN_H

#include "shade/gn_shade_types.h"

#if GN_INTERPOLATES

/* Smaller triangles, in pixels, are quicker each for itself. */
enum { GN_JOIN_PX = 8 };

/* Whether others may be one surface with a triangle: it is opaque, and its normals do not turn. */
int gn_join_may(const gn_frame *frame, const gn_tri_source *tri);

enum { GN_JOIN_NONE = -1, GN_JOIN_SAME = -2 };

/* The vertex by which a triangle goes on in the plane of `first`, which it may, beyond an edge of `last`, which does,
 * too. GN_JOIN_SAME: it is another part of the last one; GN_JOIN_NONE: it does not, or
 * what vertices have does not go on linearly. */
int32_t gn_join_vertex(const gn_frame *frame, const gn_tri_source *first, const gn_tri_source *last,
                       const gn_tri_source *next);

#endif

#endif
