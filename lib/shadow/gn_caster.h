/* Rasterises caster triangles into a shadow tile, whatever its projection (MODEL 6). */
#ifndef GN_CASTER_H
#define GN_CASTER_H

#include "geometry/gn_alpha.h"
#include "geometry/gn_plane.h"
#include "geometry/gn_walk.h"
#include "gnomon.h"

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

#endif
