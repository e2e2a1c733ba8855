/* Orthographic light views: how a tile lies in the world, and casters as it sees them (MODEL 4, 6). */
#ifndef GN_ORTHO_H
#define GN_ORTHO_H

#include "shadow/gn_caster.h"
#include "gnomon.h"

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

#endif
