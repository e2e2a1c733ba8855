/* Bins visible triangles to screen tiles (R1): frame->tile_first[t] .. tile_first[t + 1] index tile_ref. */
#ifndef GN_BIN_H
#define GN_BIN_H

#include "visible/gn_setup.h"

/* Sorts what gn_setup_triangles counted in tile_first, with what it left in the scratch. */
gn_status gn_bin_triangles(gn_frame *frame, const gn_scratch *scratch);

/* Pixels of a screen tile. */
static inline gn_rect gn_bin_tile_rect(const gn_frame *frame, uint32_t tile_idx)
{
    int32_t w = GN_K(frame, tile_width), h = GN_K(frame, tile_height);
    gn_rect r;
    r.x0 = (int32_t)(tile_idx % frame->tiles_x) * w;
    r.y0 = (int32_t)(tile_idx / frame->tiles_x) * h;
    r.x1 = gn_min32(r.x0 + w, frame->picture.width);
    r.y1 = gn_min32(r.y0 + h, frame->picture.height);
    return r;
}

#endif
