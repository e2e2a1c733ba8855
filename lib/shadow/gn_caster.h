/* Casters: rasterised into a shadow tile (MODEL 6), and orthographic views of them. */
#ifndef GN_CASTER_H
#define GN_CASTER_H

#include "geometry/gn_alpha.h"
#include "geometry/gn_plane.h"
#include "geometry/gn_walk.h"
#include "gnomon.h"

/* ---- Rasterises caster triangles into a shadow tile, whatever its projection (MODEL 6) --------------------------- */

/* With GN_SIZE_FIRST the general path draws small casters, too: same results. */
#define GN_SMALL_CASTERS (!GN_SIZE_FIRST || !GN_LARGE_CASTERS)

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

#endif
