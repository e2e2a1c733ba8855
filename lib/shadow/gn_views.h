/* Views of lights: their tiles, what the camera sees of their receivers, their directions, filters and biases. */
#ifndef GN_VIEWS_H
#define GN_VIEWS_H

#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "geometry/gn_walk.h"
#include "geometry/gn_xform.h"
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

/* Whether anything was seen that the view is looked up for. */
GN_HOT static inline int gn_seen_any(const gn_view_seen *seen)
{
    return seen->lo_q16[0] <= seen->hi_q16[0];
}

/* Quarter octaves of the side that a view is worth: of the directional atlas those of the root of its pixels, of the
 * other those of the fourth root. */
int32_t gn_seen_level(const gn_view_seen *seen, uint32_t in_other);

/* What is seen in a directional view, along the light's axes: parts of gn_seen. */

#define GN_SEEN_COORD_MAX ((1 << 30) - 1) /* differences fit 32 bits */

static inline int32_t gn_seen_limited(int64_t v)
{
    return (int32_t)gn_clamp64(v, -GN_SEEN_COORD_MAX, GN_SEEN_COORD_MAX);
}

/* The job's box is that of an object, from the camera. */
void gn_seen_from(gn_seen_job *job, uint32_t object_idx);

/* What is seen reaches as far as the box along the world's axes. */
void gn_seen_note(gn_seen_job *job);

/* Along an axis: the middle of the box, per axis of the world half of it, and its bounds. */
void gn_seen_project_box(gn_seen_job *job, const int32_t axis_q30[3], uint32_t to);

/* Leaves of the bounds along u and v what casters may shadow. */
void gn_seen_crop(gn_seen_job *job);

/* Bounds from the world's origin, no more than the sphere's, and along u and v at least an eighth of its diameter wide.
 */
void gn_seen_take(const gn_seen_job *job, gn_view_seen *seen);

/* A fixed box in their place. Returns 0 if it does not hold all that is seen, and leaves them. */
int gn_seen_take_fixed(gn_view_seen *seen, const gn_fixed_fit *fit);

#endif

/* Views of lights: each light that casts shadows gets tiles, and each tile a direction, a filter and a bias. */

/* MODEL 4: u, v, w from the direction of travel. */
void gn_light_view_axes(int32_t axis_q30[3][3], const int32_t w_q30[3]);

/* Fills frame->view, and the shadow fields of frame->light. gn_lights_setup has been called. */
gn_status gn_light_views_setup(gn_frame *frame, gn_seen_job *job);

/* ---- Drawing the atlas ------------------------------------------------------------------------------------------- */

/* Which casters go into a tile, and what is kept of it from frame to frame. */

/* ---- Which casters are drawn into a tile ------------------------------------------------------------------------- */

/* Which casters: static and moving ones are drawn separately if there is a static layer. */
typedef enum { GN_LAYER_ALL, GN_LAYER_STATIC, GN_LAYER_MOVING } gn_layer;

/* Whether an object has to be drawn into a layer of a view's tile. *culled: only gn_cull_shown_nearer excluded it. */
int gn_cull_draws(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx, gn_layer layer, int *culled);

/* Whether the object's box intersects the view's tile. */
int gn_cull_sees(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx);

/* ---- Casters that a smaller cascade shows
 * ------------------------------------------------------------------------------------------ */

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

/* ---- Squares of shadow maps [R13] -------------------------------------------------------------------------------- */

/* Sets where the squares of all views lie; adds what lookups in a view depend on beside texels to a signature; notes
 * which squares of a view's tile, which has been drawn, have changed. */
void gn_kept_find_squares(gn_frame *frame);
uint64_t gn_kept_sign_view(const gn_frame *frame, uint32_t view_idx, uint64_t signature);
void gn_kept_note_squares(gn_frame *frame, uint32_t view_idx);

/* ---- The static layer: static casters, kept apart from moving ones from frame to frame --------------------------- */

/* The view's texels in the static layer. */
gn_texels gn_static_layer_texels(gn_frame *frame, const gn_light_view *view);

/* Copies them into the view's tile. */
void gn_static_layer_copy(const gn_light_view *to, gn_texels from);

/* ---- Casters ----------------------------------------------------------------------------------------------------- */

/* Rasterised into a shadow tile (MODEL 6), and orthographic views of them. */

/* ---- Rasterises caster triangles into a shadow tile, whatever its projection (MODEL 6) --------------------------- */

#define GN_CASTER_GRADIENT_MAX ((int64_t)1 << 33) /* twice the whole depth range per texel */

/* Depth over one triangle, as fractions of the view's depth range, Q32. */
typedef struct {
    int64_t z_corner; /* at the centre of texel (0, 0), |.| < 2^62 */
    int64_t dz_du, dz_dv;
    int64_t lo, hi; /* range of the triangle, pancaked */
    int64_t bias;   /* added after limiting to that range */
} gn_caster;

/* Corners in texels with GN_CASTER_BITS fraction bits, within 2^26. The walk is scratch; `alpha` may be NULL.
 * Returns the number of texels covered. */
int32_t gn_caster_draw(const gn_frame *frame, const gn_light_view *view, const gn_caster *caster, gn_walk *walk,
                       const int32_t x[3], const int32_t y[3], gn_alpha_cut *alpha);

/* The same in two steps, for casters that may cover nothing: begins a walk (returns its first rows, 0: nothing is
 * covered), and draws. */
int32_t gn_caster_begin(const gn_frame *frame, const gn_light_view *view, gn_walk *walk, const int32_t x[3],
                        const int32_t y[3]);
int32_t gn_caster_rows(const gn_light_view *view, const gn_caster *caster, gn_walk *walk, int32_t n_rows,
                       gn_alpha_cut *alpha);

/* ---- Orthographic light views: how a tile lies in the world, and casters as it sees them (MODEL 4, 6) ------------ */

/* Fits a view, whose light, axes, tile and filter are known, to the sphere of the slice near .. far. */
void gn_ortho_fit_view(gn_frame *frame, gn_light_view *view, const gn_light *light, int32_t near_q16, int32_t far_q16);

#if GN_TIGHT_FIT
/* Fits it to what is seen, in a rectangle of at most as many texels as its square has. Returns 0 if nothing is seen, or
 * the square is too small for the filter. */
int gn_ortho_fit_tight(gn_frame *frame, gn_light_view *view, const gn_light *light);

/* Whether the view's tile, of an earlier frame, covers what is seen. */
int gn_ortho_covers(const gn_frame *frame, gn_light_view *view, const gn_light *light, const gn_view_seen *seen);
#endif

/* Updates only the planes that give light coordinates along this frame's rays; the rest of the fit stays. */
void gn_ortho_rays(const gn_frame *frame, gn_light_view *view);

/* Tile coordinates of a world point before the origin is taken off: p . axis / texel, Q16, within 1 LSB + 2^-29 of the
 * value. */
int64_t gn_light_coord_q16(const gn_light_view *view, int axis_idx, const int32_t p_q16[3]);

/* Object space to tile coordinates U, V, D in texels, Q16, |.| <= 2^46. */
void gn_ortho_compose(gn_xform *out, const gn_light_view *view, const gn_object *object);
void gn_ortho_point(int64_t out[3], const gn_xform *xform, const int32_t p[3]);

/* Draws a triangle into the view's tile. Returns the number of texels it covers, -1 if it is culled. */
int32_t gn_ortho_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting, gn_alpha_cut *alpha);

/* The same for corners within 2^29 (8192 texels), without alpha. */
int32_t gn_ortho_small_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting,
                                const gn_caster_corner *const c[3]);

#define GN_ORTHO_TOO_FAR (-2) /* without GN_CASTER_CLIPPING: it extends too far beyond the tile */

/* ---- Perspective light views of spot and point lights, and casters as they see them (MODEL 5, 6) ----------------- */

/* Fits a view, whose axes, tile and filter are known, to its light. */
void gn_persp_fit_view(gn_frame *frame, gn_light_view *view, const gn_light *light);

/* Half-width of a cube's face, t = tan(fov / 2), Q24, between 1 and 2; *clamped: 2 was not enough. nu:
 * gn_bias_reach_q16. */
int64_t gn_persp_face_q24(int32_t filter_idx, int32_t nu_q16, int32_t tile_texels, int *clamped);

/* The cube's face that a point lies in, from the point's position relative to the light. */
int32_t gn_persp_face(const int32_t from_light_q16[3]);

/* Where a view sees a point: texels, Q16, what is 1 - n / z of it, and its light-plane distance, saturated. */
typedef struct {
    int32_t u_q16, v_q16;
    uint32_t depth_q32;
    int32_t far_q16;
} gn_persp_place;

/* Of a point from the light, world axes, and its depth less that much. Returns 0 if it is not beyond the near plane. */
int gn_persp_find_place(const gn_frame *frame, const gn_light_view *view, const int32_t from_q16[3], int64_t less_q32,
                        gn_persp_place *out);

/* Axis of travel of a face, Q1.30. */
void gn_persp_face_axis(int32_t out_q30[3], int32_t face);

/* Draws a triangle, corners in the view's axes from the light, |.| < 2^30. Returns the number of texels it covers,
 * -1 if it is culled. */
int32_t gn_persp_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting, gn_alpha_cut *alpha);

/* Tells where the view sees a corner whose coordinates are known. */
void gn_persp_corner(const gn_frame *frame, const gn_light_view *view, gn_caster_corner *c);

/* The same of such corners, of casters that alpha does not cut. */
int32_t gn_persp_small_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting,
                                const gn_caster_corner *const c[3]);

#endif
