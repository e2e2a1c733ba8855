/* What the camera sees of the receivers, for each view of a light: tight fits and tiles by worth need it (MODEL 4,
 * 6). */
#ifndef GN_SEEN_H
#define GN_SEEN_H

#include "shadow/gn_tiles.h"
#include "gnomon.h"

#if GN_TIGHT_FIT

/* Fills frame->seen, for the views of all lights with tiles, in their order. */
void gn_seen_find(gn_frame *frame, gn_seen_job *job, const gn_tile_plan *plan);

/* Axes u and v of a view become u c + v s and v c - u s. */
void gn_seen_turn_axes(gn_light_view *view, uint32_t turn);

/* Whether anything was seen that the view is looked up for. */
GN_HOT static inline int gn_seen_any(const gn_view_seen *seen)
{
    return seen->lo_q16[0] <= seen->hi_q16[0];
}

/* Quarter octaves of the side that a view is worth: of the directional atlas those of the root of its pixels, of the
 * other those of the fourth root. */
int32_t gn_seen_level(const gn_view_seen *seen, uint32_t in_other);

#endif

#endif
