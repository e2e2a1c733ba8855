/* Transforms of the frame: camera, object to view, object to light. */
#ifndef GN_XFORM_H
#define GN_XFORM_H

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "gnomon.h"

/* Object space to axes (rows, unit, Q1.30) through `origin_q16`: out = axis * (to_world * p - origin). */
void gn_xform_compose(gn_xform *out, const int32_t axis_q30[3][3], const int32_t origin_q16[3],
                      const gn_object *object);

/* out_q16 = xform of a point of the object's (gn_position_of), |out| exact to 1 LSB plus the composition's
 * 3 * |p| * 2^-30. Not range checked. */
void gn_xform_point(int64_t out_q16[3], const gn_xform *xform, const int32_t p[3]);

/* Adds up the constant terms, for many vertices. */
void gn_xform_fast_begin(gn_xform_fast *fast, const gn_xform *xform);

/* Row r times p, with the constant terms */
#define GN_FAST_ROW_(r)                                                                                                \
    (fast->row[r].sum + (int64_t)fast->row[r].m[0] * p0 + (int64_t)fast->row[r].m[1] * p1 +                            \
     (int64_t)fast->row[r].m[2] * p2)

/* The same result as gn_xform_point, however large. Returns 0, without a result, if the position may be 2^30. */
GN_INLINE int gn_xform_fast_wide(int32_t out_q16[3], const gn_xform_fast *fast, const int32_t position[3])
{
    uint32_t reach = fast->reach, up = fast->up, down = fast->down;
    int32_t p0 = position[0], p1 = position[1], p2 = position[2];
    if ((((uint32_t)p0 + reach) | ((uint32_t)p1 + reach) | ((uint32_t)p2 + reach)) >= 2 * reach) return 0;
    p0 = (int32_t)((uint32_t)p0 << up);
    p1 = (int32_t)((uint32_t)p1 << up);
    p2 = (int32_t)((uint32_t)p2 << up);
    /* row by row: three at once need too many registers */
    int32_t x = (int32_t)(GN_FAST_ROW_(0) >> 32);
    GN_KEEP(x);
    int32_t y = (int32_t)(GN_FAST_ROW_(1) >> 32);
    GN_KEEP(y);
    int32_t z = (int32_t)(GN_FAST_ROW_(2) >> 32);
    if (down) {
        x = (x >> down) + fast->row[0].t_q16;
        y = (y >> down) + fast->row[1].t_q16;
        z = (z >> down) + fast->row[2].t_q16;
    }
    out_q16[0] = x, out_q16[1] = y, out_q16[2] = z;
    return 1;
}
#undef GN_FAST_ROW_

/* Returns 0, too, if the result may be 2^29 or more. */
GN_INLINE int gn_xform_fast_inline(int32_t out_q16[3], const gn_xform_fast *fast, const int32_t position[3])
{
    const uint32_t limit = 1U << 29;
    return gn_xform_fast_wide(out_q16, fast, position) &&
           (((uint32_t)out_q16[0] + limit) | ((uint32_t)out_q16[1] + limit) | ((uint32_t)out_q16[2] + limit)) <
               2 * limit;
}

/* The inverse transpose of a rotation and scale, |m| <= 2^30, up to a positive factor: row by row, the largest entry
 * near 1.0 in Q1.30. */
void gn_xform_normal_matrix(int32_t out_q30[9], const int32_t m[3][3]);

/* Number of bits that view coordinates may use: |v| < 2^30, i.e. +-16384 units. */
#define GN_VIEW_LIMIT_Q16 ((int64_t)1 << 30)

/* ---- The projective plane of a triangle -------------------------------------------------------------------------- */

/* What is linear in screen space, from unsnapped view-space vertices (NUMERICS 4.3).  Rays through pixel centres are
 * (px, py, 2F) with px = 2x + 1 - W, py = H - 1 - 2y. For a linear form c in view space, c . ray is linear on the
 * screen. With n = (v1 - v0) x (v2 - v0) and det = n . v0: view depth Z = det * 2F / (n . ray). */

/* v0, v1, v2 in view space, |v| < 2^30. */
void gn_plane_setup(gn_plane *plane, const int32_t v0[3], const int32_t v1[3], const int32_t v2[3]);

/* For the triangle that `plane` was set up from. */
void gn_bary_setup(gn_bary *bary, const gn_plane *plane, const int32_t v0[3], const int32_t v1[3], const int32_t v2[3]);

/* Reciprocal of n . ray at a pixel, the divisor of depth and barycentrics. */
typedef struct {
    uint32_t w_norm; /* n . ray = w_norm * 2^(32 - clz) */
    uint32_t recip;  /* 2^63 / w_norm */
    int32_t clz;
} gn_ray_recip;

/* Returns 0 where the plane is edge on or behind. */
int gn_plane_recip(gn_ray_recip *out, const gn_plane *plane, int32_t px, int32_t py, uint32_t focal2_px_q16,
                   int32_t newton_steps);

/* b1, b2 at that pixel, clamped to the triangle: b1, b2 >= 0, b1 + b2 <= 1. */
void gn_bary_at(int32_t b_q30[2], const gn_bary *bary, const gn_ray_recip *recip, int32_t px, int32_t py,
                uint32_t focal2_px_q16);

/* The same, not clamped. Returns 0 where one is below -1 or above 2. */
int gn_bary_beyond(int32_t b_q30[2], const gn_bary *bary, const gn_ray_recip *recip, int32_t px, int32_t py,
                   uint32_t focal2_px_q16);

/* c . ray at a pixel, Q16 relative to c's own scale. |c| < 2^30, |px|, |py| < 2^13: below 2^63 */
GN_HOT static inline int64_t gn_plane_at(const int32_t c[3], int32_t px, int32_t py, uint32_t focal2_px_q16)
{
    return ((int64_t)c[0] * px + (int64_t)c[1] * py) * 65536 + (int64_t)c[2] * (int64_t)focal2_px_q16;
}

/* ---- Clipping of polygons in view space against the near plane and the guard band -------------------------------- */

enum { GN_OUT_NEAR = 1, GN_OUT_LEFT = 2, GN_OUT_RIGHT = 4, GN_OUT_BOTTOM = 8, GN_OUT_TOP = 16, GN_OUT_ALL = 31 };

/* Which planes a point is outside of: the near plane and the four planes |X| = side[0] Z, |Y| = side[1] Z;
 * with a flat depth that is in place of Z there. */
uint32_t gn_outcode(const int32_t v_q16[3], int32_t near_q16, const int32_t side_q16[2], int32_t flat_q16);

/* Cuts the polygon by the planes in `planes`. An edge's cut depends only on its end points and the planes, so that
 * neighbouring triangles get the same vertices if both are cut by all: a cut vertex can round to the far side of the
 * next plane. It lies within 2 LSB of the side planes, exactly on the near plane. */
void gn_clip(gn_polygon *polygon, gn_polygon *uncut, uint32_t planes, int32_t near_q16, const int32_t side_q16[2],
             int32_t flat_q16);

#endif
