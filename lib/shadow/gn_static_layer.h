/* The static layer: static casters, kept apart from moving ones from frame to frame. */
#ifndef GN_STATIC_LAYER_H
#define GN_STATIC_LAYER_H

#include "gnomon.h"

/* The view's texels in the static layer. */
gn_texels gn_static_layer_texels(gn_frame *frame, const gn_light_view *view);

/* Copies them into the view's tile. */
void gn_static_layer_copy(const gn_light_view *to, gn_texels from);

#endif
