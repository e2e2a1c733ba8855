/* Drawing the atlas: which casters go into a tile, and what is kept of it from frame to frame. */
#ifndef GN_ATLAS_H
#define GN_ATLAS_H

#include "shadow/gn_views.h"
#include "gnomon.h"

/* ---- Which casters are drawn into a tile ------------------------------------------------------------------------- */

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

/* ---- Shadow tiles that are kept from one frame to the next ------------------------------------------------------- */

/* Signature of everything that a layer of the view's tile depends on; never 0. */
uint64_t gn_kept_signature(const gn_frame *frame, const gn_light_view *view, gn_layer layer);

/* If tiles move within the atlas, their texels are overwritten: then nothing is kept. */
void gn_kept_check_layout(gn_frame *frame, const gn_tile_plan *plan);

/* Whether the layer's content has this signature. If not, the layer counts as empty until gn_kept_set. */
int gn_kept_is_same(gn_frame *frame, uint32_t view_idx, gn_layer layer, uint64_t signature);
void gn_kept_set(gn_frame *frame, uint32_t view_idx, gn_layer layer, uint64_t signature);

/* Whether the tile of view `view_idx` is kept from an earlier frame. */
int gn_kept_holds(const gn_frame *frame, uint32_t view_idx);

/* ---- The static layer: static casters, kept apart from moving ones from frame to frame --------------------------- */

/* The view's texels in the static layer. */
gn_texels gn_static_layer_texels(gn_frame *frame, const gn_light_view *view);

/* Copies them into the view's tile. */
void gn_static_layer_copy(const gn_light_view *to, gn_texels from);

#endif
