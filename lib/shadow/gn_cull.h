/* Which casters can show in a tile (D8). */
#ifndef GN_CULL_H
#define GN_CULL_H

#include "gnomon.h"

#if GN_SHADOWS

#if GN_OBJECT_BOXES
/* Whether any of an object can lie in the view's tile, by its box. */
int gn_cull_sees(const gn_frame *frame, const gn_light_view *view, const gn_object_state *object);
#endif

#if GN_CASTER_CULLING
/* Box of all receiving objects, for gn_cull_shown_nearer. */
void gn_cull_begin(gn_frame *frame);

/* Whether every point that the object can shadow is looked up in a smaller cascade than the view's: then it may be left
 * out. */
int gn_cull_shown_nearer(const gn_frame *frame, const gn_light_view *view, const gn_object_state *object);
#endif

#endif
#endif
