/* Shadow tiles: which casters each holds, and what is kept from frame to frame (A5, D8, M1, DESIGN 1.6). */
#ifndef GN_ATLAS_H
#define GN_ATLAS_H

#include "gnomon.h"

#if GN_SHADOWS

/* Brings one view's tile up to date: draws it, unless it still holds what would be drawn. The memory is scratch, for a
 * cache of vertices: at least 4 words. */
gn_status gn_atlas_render_tile(gn_frame *frame, gn_casting *casting, uint32_t view_idx, uint32_t *memory,
                               uint32_t n_words);

#endif
#endif
