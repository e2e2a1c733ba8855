/* Which casters are drawn into a tile. */
#ifndef GN_CULL_H
#define GN_CULL_H

#include "gnomon.h"

/* Which casters: static and moving ones are drawn separately if there is a static layer. */
typedef enum { GN_LAYER_ALL, GN_LAYER_STATIC, GN_LAYER_MOVING } gn_layer;

/* Whether an object has to be drawn into a layer of a view's tile. *culled: only gn_cull_shown_nearer excluded it. */
int gn_cull_draws(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx, gn_layer layer, int *culled);

/* Whether the object's box intersects the view's tile: gn_cull_boxes.c. */
int gn_cull_sees(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx);

/* ---- gn_cull_cascades.c ------------------------------------------------------------------------------------------ */

/* Box of all receiving objects, for gn_cull_shown_nearer. */
void gn_cull_begin(gn_frame *frame);

/* Whether every point that the object can shadow is looked up in a smaller cascade than the view's. Then the object may
 * be skipped. */
int gn_cull_shown_nearer(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx);

#endif
