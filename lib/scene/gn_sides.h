/* Which objects and which sides of their triangles are drawn: the one place that knows what mirrors. */
#ifndef GN_SIDES_H
#define GN_SIDES_H

#include "gnomon.h"

/* gn_frame.flags: GN_OBJECT_..., and this one for an object that its transforms mirror. */
#define GN_OBJECT_MIRRORED 128U

/* Triangles by the order of their corners, seen from the camera or the light. */
enum { GN_SIDE_CCW = 1, GN_SIDE_CW = 2, GN_SIDES_BOTH = 3 };

/* Finds frame->flags of all objects, once a frame. What has no inverse keeps no flag by which it would be drawn. */
void gn_sides_setup(gn_frame *frame);

/* Sides to draw of an object with these flags; `two_sided`: flags of which each asks for both. A mirror exchanges the
 * sides. */
static inline uint32_t gn_sides_of(uint32_t flags, uint32_t two_sided)
{
    if (flags & two_sided) return GN_SIDES_BOTH;
    return flags & GN_OBJECT_MIRRORED ? GN_SIDE_CW : GN_SIDE_CCW;
}

#endif
