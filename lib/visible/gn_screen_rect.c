/* The rectangle of a screen tile in the picture. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "visible/gn_screen_rect.h"

gn_rect gn_screen_rect(const gn_frame *frame, uint32_t tile_idx)
{
    int32_t w = GN_K(frame, tile_width), h = GN_K(frame, tile_height);
    gn_rect r;
    r.x0 = (int32_t)(tile_idx % frame->tiles_x) * w;
    r.y0 = (int32_t)(tile_idx / frame->tiles_x) * h;
    r.x1 = gn_min32(r.x0 + w, frame->picture.width);
    r.y1 = gn_min32(r.y0 + h, frame->picture.height);
    return r;
}
