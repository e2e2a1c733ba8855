/* Shadow tiles: casters rasterised as depth seen from the light (A2, B1, D9, DESIGN 1.5). */
#ifndef GN_ATLAS_H
#define GN_ATLAS_H

#include "gnomon.h"

#if GN_SHADOWS

#define GN_ATLAS_EMPTY 65535U

/* Clears and draws one light's tile. */
gn_status gn_atlas_render_tile(gn_frame *frame, gn_light_view *view);

#endif
#endif
