/* The projective plane of a triangle. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "geometry/gn_plane.h"

/* Brings an edge to 30 bits. Returns the exponent that it lost. */
GN_HOT static int32_t shorten(int32_t e[3])
{
    const int64_t wide[3] = {e[0], e[1], e[2]};
    return gn_norm_vec(e, wide);
}

GN_HOT void gn_plane_setup(gn_plane *plane, const int32_t v0[3], const int32_t v1[3], const int32_t v2[3])
{
    int32_t e1[3], e2[3], exp = 0;
    int64_t n[3];
    uint32_t wide = 0;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        e1[i] = v1[i] - v0[i]; /* < 2^31 */
        e2[i] = v2[i] - v0[i];
        wide |= ((uint32_t)e1[i] ^ (uint32_t)e1[i] << 1) | ((uint32_t)e2[i] ^ (uint32_t)e2[i] << 1);
    }
    if (wide >> 31) exp = shorten(e1) + shorten(e2);        /* 2^30 or more */
    n[0] = (int64_t)e1[1] * e2[2] - (int64_t)e1[2] * e2[1]; /* exact: 2 * 2^30 * 2^30 */
    n[1] = (int64_t)e1[2] * e2[0] - (int64_t)e1[0] * e2[2];
    n[2] = (int64_t)e1[0] * e2[1] - (int64_t)e1[1] * e2[0];
    plane->n_exp = gn_norm_vec(plane->n, n) + exp;
    plane->det = gn_dot64(plane->n, v0); /* 3 * 2^30 * 2^30 */
    plane->back = plane->det < 0;
    if (plane->back) {
        plane->det = -plane->det;
        GN_UNROLL
        for (int i = 0; i < 3; i++) plane->n[i] = -plane->n[i];
    }
}

GN_HOT void gn_bary_setup(gn_bary *bary, const gn_plane *plane, const int32_t v0[3], const int32_t v1[3],
                          const int32_t v2[3])
{
    /* b1 = (e2 x v0) . ray / (n . ray), b2 = (v0 x e1) . ray / (n . ray) */
    GN_UNROLL
    for (int k = 0; k < 2; k++) {
        const int32_t *to = k == 0 ? v2 : v1;
        int64_t c[3];
        int32_t e[3], exp = 0;
        uint32_t wide = 0;
        GN_UNROLL
        for (int i = 0; i < 3; i++) {
            e[i] = to[i] - v0[i]; /* < 2^31 */
            wide |= (uint32_t)e[i] ^ (uint32_t)e[i] << 1;
        }
        if (wide >> 31) exp = shorten(e);
        if (k == 0) gn_cross64(c, e, v0);
        else gn_cross64(c, v0, e);
        bary->exp[k] = gn_norm_vec(bary->form[k], c) + exp - plane->n_exp;
        if (plane->back)
            for (int i = 0; i < 3; i++) bary->form[k][i] = -bary->form[k][i];
    }
}

/* The perspective divide of a pixel. [R4] */
GN_HOT int gn_plane_recip(gn_ray_recip *out, const gn_plane *plane, int32_t px, int32_t py, uint32_t focal2_px_q16,
                          int32_t newton_steps)
{
    int64_t w = plane->det > 0 ? gn_plane_at(plane->n, px, py, focal2_px_q16) : 0;
    if (w <= 0) return 0;
    out->clz = gn_clz64((uint64_t)w);
    out->w_norm = (uint32_t)(((uint64_t)w << out->clz) >> 32);
    out->recip = gn_recip_norm(out->w_norm, newton_steps);
    return 1;
}

/* round(b * 2^-s), clamped to 0 .. most */
GN_HOT static inline uint32_t bary_fraction(int64_t b, int32_t s, uint32_t most)
{
    if (GN_SIZE_FIRST || s < 1 || s > 62) return (uint32_t)gn_clamp64(gn_scale64(b, s), 0, most);
    if (b < 0) return 0;
    uint64_t twice = (uint64_t)b >> (s - 1);
    if (twice >> 32) return twice >= (uint64_t)most << 1 ? most : (uint32_t)((twice + 1) >> 1);
    uint32_t t = ((uint32_t)twice >> 1) + ((uint32_t)twice & 1U);
    return t < most ? t : most;
}

GN_HOT void gn_bary_at(int32_t b_q30[2], const gn_bary *bary, const gn_ray_recip *recip, int32_t px, int32_t py,
                       uint32_t focal2_px_q16)
{
    const int32_t one = 1 << 30;
    GN_UNROLL
    for (int k = 0; k < 2; k++) {
        int64_t b = gn_plane_at(bary->form[k], px, py, focal2_px_q16);
        uint32_t t = bary_fraction(b, 32 - recip->clz - bary->exp[k], recip->w_norm);
        GN_KEEP(t);                                               /* 32 bits: one multiplication */
        b_q30[k] = (int32_t)(gn_umul_high(t, recip->recip) >> 1); /* 2^64 / 2^33 */
        b_q30[k] = gn_min32(b_q30[k], one);
    }
    if (b_q30[1] > one - b_q30[0]) b_q30[1] = one - b_q30[0];
}

#if GN_INTERPOLATES || GN_ORTHOGRAPHIC
GN_HOT int gn_bary_beyond(int32_t b_q30[2], const gn_bary *bary, const gn_ray_recip *recip, int32_t px, int32_t py,
                          uint32_t focal2_px_q16)
{
    GN_UNROLL
    for (int k = 0; k < 2; k++) {
        int64_t b = gn_plane_at(bary->form[k], px, py, focal2_px_q16);
        int64_t t = gn_scale64((int64_t)gn_abs64(b), 33 - recip->clz - bary->exp[k]); /* half of it */
        if (t >= (int64_t)recip->w_norm) return 0;                                    /* 2 or more */
        uint64_t b_uq30 = (uint64_t)t * recip->recip >> 32;
        if (b_uq30 > INT32_MAX) return 0;
        b_q30[k] = b < 0 ? -(int32_t)b_uq30 : (int32_t)b_uq30;
    }
    return b_q30[0] >= -(1 << 30) && b_q30[1] >= -(1 << 30);
}
#endif
