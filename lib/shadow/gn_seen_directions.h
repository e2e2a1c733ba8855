/* What is seen in a directional view, along u and v of each turn about the light, and along w: parts of gn_seen. */
#ifndef GN_SEEN_DIRECTIONS_H
#define GN_SEEN_DIRECTIONS_H

#include "shadow/gn_seen.h"

#if GN_TIGHT_FIT

#define GN_SEEN_COORD_MAX ((1 << 30) - 1) /* differences fit 32 bits */

static inline int32_t gn_seen_limited(int64_t v)
{
    return (int32_t)gn_clamp64(v, -GN_SEEN_COORD_MAX, GN_SEEN_COORD_MAX);
}

/* A point's coordinates along u, v, w in all directions. */
void gn_seen_directions(const int32_t at[3], int32_t out[GN_SEEN_DIRECTIONS]);

/* The job's box is that of an object, from the camera. */
void gn_seen_from(gn_seen_job *job, uint32_t object_idx);

/* What is seen reaches as far as the box along the world's axes. */
void gn_seen_note(gn_seen_job *job);

/* Along an axis: the middle of the box, per axis of the world half of it, and its bounds. */
void gn_seen_project_box(gn_seen_job *job, const int32_t axis_q30[3], uint32_t to);

/* Bounds of the box in all directions. */
void gn_seen_box_along(const gn_seen_job *job, int32_t lo[GN_SEEN_DIRECTIONS], int32_t hi[GN_SEEN_DIRECTIONS]);

/* Leaves of the bounds along u and v what casters may shadow. */
void gn_seen_crop(gn_seen_job *job);

/* The turn with the smallest rectangle, of those within a 64th of it the first. None if that saves less than 5/16:
 * windows of texels are smallest where u is level. */
uint32_t gn_seen_pick_turn(const gn_seen_job *job);

/* Bounds along a turn's directions from the world's origin, no more than the sphere's, and along u and v at least an
 * eighth of its diameter wide. */
void gn_seen_take(const gn_seen_job *job, gn_view_seen *seen, uint32_t turn);

/* A fixed box in their place. Returns 0 if it does not hold all that is seen: they must be taken then. */
int gn_seen_take_fixed(const gn_seen_job *job, gn_view_seen *seen, const gn_fixed_fit *fit);

#endif

#endif
