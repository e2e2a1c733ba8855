/* Shadow tiles that are kept from one frame to the next. */
#ifndef GN_KEPT_H
#define GN_KEPT_H

#include "shadow/gn_cull.h"
#include "shadow/gn_tiles.h"
#include "gnomon.h"

/* Signature of everything that a layer of the view's tile depends on; never 0. */
uint64_t gn_kept_signature(const gn_frame *frame, const gn_light_view *view, gn_layer layer);

/* If tiles move within the atlas, their texels are overwritten: then nothing is kept. */
void gn_kept_check_layout(gn_frame *frame, const gn_tile_plan *plan);

/* Whether the layer's content has this signature. If not, the layer counts as empty until gn_kept_set. */
int gn_kept_is_same(gn_frame *frame, uint32_t view_idx, gn_layer layer, uint64_t signature);
void gn_kept_set(gn_frame *frame, uint32_t view_idx, gn_layer layer, uint64_t signature);

/* Whether the tile of view `view_idx` is kept from an earlier frame. */
int gn_kept_holds(const gn_frame *frame, uint32_t view_idx);

#endif
