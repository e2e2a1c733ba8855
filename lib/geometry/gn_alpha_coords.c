/* Texture coordinates along a row of a triangle that alpha cuts. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_alpha.h"
#include "geometry/gn_plane.h"
#include "geometry/gn_texture.h"

GN_HOT void gn_alpha_corners(gn_alpha_cut *cut, const uint16_t idx[3])
{
    gn_texture_corners(&cut->uv, cut->object->mesh, cut->object->texture, idx);
}

GN_HOT void gn_alpha_plane(gn_alpha_cut *cut, const gn_frame *frame, int32_t (*v)[3], uint32_t focal2_px_q16,
                           int32_t width, int32_t newton_steps)
{
    gn_plane_setup(&cut->plane, v[0], v[1], v[2]);
    gn_bary_setup(&cut->bary, &cut->plane, v[0], v[1], v[2]);
    cut->focal2_px_q16 = focal2_px_q16;
    cut->width = width;
    cut->newton_steps = newton_steps;
    cut->px_per_step = gn_min32(GN_K(frame, persp_step), 8);
}

/* By division. Returns 0 where the plane is edge on or behind: the coordinates are those of vertex 0 there. */
GN_HOT static int exact_coords(const gn_alpha_cut *cut, int32_t x, int32_t uv_q20[2], gn_ray_recip *recip)
{
    int32_t b_q30[2] = {0, 0}, px = 2 * x + 1 - cut->width;
    int seen = gn_plane_recip(recip, &cut->plane, px, cut->py, cut->focal2_px_q16, cut->newton_steps);
    if (seen) gn_bary_at(b_q30, &cut->bary, recip, px, cut->py, cut->focal2_px_q16);
    for (int i = 0; i < 2; i++) uv_q20[i] = gn_texture_coord(&cut->uv, cut->object->texture, b_q30, i);
    return seen;
}

#define GN_ALPHA_BEND_MAX_Q30 (3 << 26) /* 3/16; the parabola is in NUMERICS 4.9 */
#define GN_ALPHA_TEXEL_LOG2   8         /* maximum distance of coordinates from the parabola: 2^-8 texel */
#define GN_ALPHA_LONG_PX      32        /* tried first, before cut->px_per_step */

GN_HOT static void find_exact(const gn_alpha_cut *cut, gn_alpha_exact *at, int32_t x)
{
    gn_ray_recip recip;
    at->x = x;
    at->w_norm = 0;
    if (!exact_coords(cut, x, at->uv_q20, &recip)) return;
    at->w_norm = recip.w_norm;
    at->clz = recip.clz;
}

/* (z1 - z0) / (z1 + z0), Q30, of depths z = 1 / w. */
GN_HOT static int32_t bend_between(const gn_alpha_exact *a, const gn_alpha_exact *b)
{
    int32_t larger = a->clz - b->clz; /* w1, by so many bits */
    uint32_t w0 = a->w_norm >> 1 >> gn_min32(gn_max32(larger, 0), 31),
             w1 = b->w_norm >> 1 >> gn_min32(gn_max32(-larger, 0), 31);
    int32_t bend_q30 = (int32_t)gn_quotient_q30(w0 < w1 ? w1 - w0 : w0 - w1, w0 + w1);
    return w0 < w1 ? -bend_q30 : bend_q30;
}

/* A coordinate that changes by d over n <= 32 pixels, 1 / n of them as share_q31. Returns 0 if that is two turns or
 * more, or if its distance from the parabola is above the limit. */
GN_HOT static int step_coord(gn_alpha_steps *steps, int axis, int32_t d, int32_t n, int32_t share_q31, int32_t bend_q30,
                             uint32_t size_log2)
{
    uint32_t bend_q16 = (gn_abs32(bend_q30) >> 14) + 1; /* at most 2^13.6 */
    if (gn_abs32(d) >> 21) return 0;
    if ((uint64_t)gn_abs32(d) * (bend_q16 * bend_q16) > (uint64_t)1 << (34 + 20 - GN_ALPHA_TEXEL_LOG2 - size_log2))
        return 0;                                                                         /* a^2/4 */
    const int32_t d_q28 = d * 256, bend_q28 = (int32_t)((int64_t)d_q28 * bend_q30 >> 28), /* 2^29 * 3/4 */
        bend = gn_mul_high(2 * bend_q28, 2 * gn_mul_high(share_q31, share_q31));
    steps->bend_q28[axis] = bend;
    steps->step_q28[axis] = gn_mul_high(2 * (d_q28 - bend * (n * (n - 1) / 2)), share_q31); /* 2^29 + 2^29 * 3/8 */
    return 1;
}

/* The pixels from `at` on between two exact samples, px apart, or where the triangle's row begins and ends. Returns 0
 * if they are too far apart for the limit. */
GN_HOT static int find_steps(gn_alpha_cut *cut, int32_t at, int32_t px)
{
    const gn_texture *texture = cut->object->texture;
    gn_alpha_steps *steps = &cut->steps;
    gn_alpha_exact from = cut->exact;
    steps->first = gn_max32(at, cut->x_begin);
    steps->end = gn_min32(at + px, cut->x_end);
    steps->hold = 0;
    int32_t last = gn_min32(at + px, cut->x_end - 1), n = last - steps->first;
    if (n < 2) return 1;
    if (from.x != steps->first) find_exact(cut, &from, steps->first);
    find_exact(cut, &cut->exact, last);
    if (!from.w_norm || !cut->exact.w_norm) return 0;
    int32_t bend_q30 = bend_between(&from, &cut->exact);
    if (gn_abs32(bend_q30) > GN_ALPHA_BEND_MAX_Q30) return 0;
    const int32_t share_q31 = (int32_t)((1U << 31) / (uint32_t)n);
    for (int i = 0; i < 2; i++) {
        const int32_t u = from.uv_q20[i], to = cut->exact.uv_q20[i], d = (int32_t)((uint32_t)to - (uint32_t)u);
        if ((d < 0) != (to < u) && gn_texture_clamps(texture, i)) return 0; /* modulo whole turns, if it repeats */
        steps->from_q20[i] = from.uv_q20[i];
        if (!step_coord(steps, i, d, n, share_q31, bend_q30, gn_texture_size_log2(texture, i))) return 0;
    }
    steps->hold = 1;
    return 1;
}

/* The span around x: all of a short row. What it is does not depend on the pixels before: a row in two screen tiles is
 * one row. */
GN_HOT static void alpha_steps(gn_alpha_cut *cut, int32_t x)
{
    const int32_t at = cut->x_end - cut->x_begin <= GN_ALPHA_LONG_PX ? cut->x_begin : x & -GN_ALPHA_LONG_PX;
    if (cut->steps.bent != at && find_steps(cut, at, GN_ALPHA_LONG_PX)) return;
    cut->steps.bent = at;
    find_steps(cut, x & -cut->px_per_step, cut->px_per_step);
}

GN_HOT int32_t gn_alpha_coords(gn_alpha_cut *cut, int32_t x, gn_texture_curve *curve)
{
    const gn_alpha_steps *steps = &cut->steps;
    gn_ray_recip recip;
    if (GN_ALPHA_STEPS && cut->px_per_step > 1) {
        if (x >= steps->end || x < steps->first) alpha_steps(cut, x);
        if (steps->hold) {
            int32_t k = x - steps->first, bends = k * (k - 1) / 2;
            for (int i = 0; i < 2; i++) {
                curve->from_q20[i] = steps->from_q20[i];
                curve->at_q28[i] = k * steps->step_q28[i] + bends * steps->bend_q28[i] + 128;
                curve->step_q28[i] = steps->step_q28[i] + k * steps->bend_q28[i];
                curve->bend_q28[i] = steps->bend_q28[i];
            }
            return steps->end - x;
        }
    }
    exact_coords(cut, x, curve->from_q20, &recip);
    for (int i = 0; i < 2; i++) curve->at_q28[i] = curve->step_q28[i] = curve->bend_q28[i] = 0;
    return 1;
}
