/* Views of lights: their tiles, what the camera sees of their receivers, their directions, filters and biases. */
#ifndef GN_VIEWS_H
#define GN_VIEWS_H

#include "base/gn_q.h"
#include "gnomon.h"

/* ---- Which light gets how many shadow tiles, of which size, in which atlas (MODEL 6) ----------------------------- */

typedef struct {
    uint8_t n_tiles;  /* 0: none */
    uint8_t n_drawn;  /* without those of unused cascades */
    uint8_t in_other; /* atlas */
    uint8_t cascaded; /* its tiles are cascades */
    uint8_t tile_log2;
    uint8_t weight; /* importance 1..64, w in gn_tiles.c */
} gn_tile_plan;

/* Whether the sides of tiles are in frame->seen. */
#define GN_BY_WORTH(frame) (GN_TIGHT_FIT && (frame)->scene->shadow.tile_sizes == GN_TILES_WORTH)

/* The job is memory for polygons. One plan per light; sets frame->light[].shadow_state. Needs boxes and light states.
 */
gn_status gn_tiles_plan(gn_frame *frame, gn_seen_job *job, gn_tile_plan plan[GN_MAX_LIGHTS]);

/* What the camera sees of the receivers, for each view of a light: tight fits and tiles by worth need it (MODEL 4,
 * 6). */

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

/* What is seen in a directional view, along u and v of each turn about the light, and along w: parts of gn_seen. */

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

/* Views of lights: each light that casts shadows gets tiles, and each tile a direction, a filter and a bias. */

/* MODEL 4: u, v, w from the direction of travel. */
void gn_light_view_axes(int32_t axis_q30[3][3], const int32_t w_q30[3]);

/* Fills frame->view, and the shadow fields of frame->light. gn_lights_setup has been called. */
gn_status gn_light_views_setup(gn_frame *frame, gn_seen_job *job);

#endif
