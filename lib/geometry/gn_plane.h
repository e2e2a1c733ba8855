/* The projective plane of a triangle: what is linear in screen space, from unsnapped view-space vertices
 * (NUMERICS 4.3).
 *
 * Rays through pixel centres are (px, py, 2F) with px = 2x + 1 - W, py = H - 1 - 2y. For a linear form c in view space,
 * c . ray is linear on the screen. With n = (v1 - v0) x (v2 - v0) and det = n . v0: view depth Z = det * 2F / (n .
 * ray).
 */
#ifndef GN_PLANE_H
#define GN_PLANE_H

#include "base/gn_math.h"
#include "gnomon.h"

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

#endif
