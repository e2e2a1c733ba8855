/* Compact arithmetic: points, from an object's space to a raster. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "compact/gn_compact.h"

int gn_compact_unit(int32_t out_q30[3], const int64_t a[3])
{
    uint64_t any = 0, sum = 0;
    for (int i = 0; i < 3; i++) any |= (uint64_t)(a[i] ^ a[i] >> 63);
    int32_t s = gn_clz64(any | 1) - 2; /* all ones shorter than the magnitude, at most */
    for (int i = 0; i < 3; i++) {
        out_q30[i] = (int32_t)(gn_shl64(a[i], s) >> 32); /* |.| <= 2^30 */
        sum += (uint64_t)((int64_t)out_q30[i] * out_q30[i]);
    }
    uint32_t length = gn_isqrt64(sum); /* 2^29 .. 2^30.8 */
    if (!length) return 0;
    s = gn_clz32(length);
    int64_t recip = gn_recip_norm(length << s, 2); /* 2^63 / (length 2^s) */
    for (int i = 0; i < 3; i++) out_q30[i] = (int32_t)((out_q30[i] * recip) >> (33 - s));
    return 1;
}

uint32_t gn_compact_mul(uint32_t a, uint32_t b, int32_t shift)
{
    return (uint32_t)(((uint64_t)a * b) >> 32) >> shift;
}

/* |v| <= limit */
static int within(const int32_t *v, int n, uint32_t limit)
{
    for (int i = 0; i < n; i++)
        if (gn_abs32(v[i]) > limit) return 0;
    return 1;
}

int gn_compact_affine_ok(const gn_affine *a)
{
    return within(a->m_q30[0], 9, 1U << 30) && within(a->t_q16, 3, GN_COMPACT_LENGTH_Q16 / 2);
}

int gn_compact_compose(gn_compact_xform *out, const gn_compact_view *view, const gn_affine *affine, int32_t frac_bits)
{
    int fits = 1;
    /* matrix and axis entries are at most 2^30: sums below 2^62; differences of positions at most 2^30.4 */
    for (int r = 0; r < 3; r++) {
        const int32_t *axis = view->axis_q30[r];
        int64_t t = 0;
        for (int c = 0; c < 3; c++) {
            int64_t m = 0;
            for (int k = 0; k < 3; k++) m += (int64_t)axis[k] * affine->m_q30[k][c];
            out->m_q28[r][c] = (int32_t)(m >> 32); /* 3 * 2^28 */
            t += (int64_t)axis[c] * (affine->t_q16[c] - view->eye_q16[c]);
        }
        out->t_q16[r] = (int32_t)(t >> 30);
        fits &= out->t_q16[r] == t >> 30;
    }
    out->shift = (int32_t)(12U - (uint32_t)affine->exp + (uint32_t)frac_bits);
    return fits && (uint32_t)out->shift <= 42;
}

int gn_compact_transform(int32_t out_q16[3], const gn_compact_xform *xform, const int32_t p[3])
{
    uint32_t beyond = 0;
    for (int r = 0; r < 3; r++) {
        const int32_t *m = xform->m_q28[r];
        /* three times 2^31 * 3 * 2^28: below 2^63 */
        int64_t v =
            (((int64_t)m[0] * p[0] + (int64_t)m[1] * p[1] + (int64_t)m[2] * p[2]) >> xform->shift) + xform->t_q16[r];
        beyond |= (uint32_t)((uint64_t)(v + GN_COMPACT_LENGTH_Q16) >> 30);
        beyond |= (uint32_t)((uint64_t)v >> 32) ^ (uint32_t)((int32_t)v >> 31);
        out_q16[r] = (int32_t)v;
    }
    return !beyond;
}

/* v * scale >> shift, at most GN_COMPACT_REACH_Q16 in magnitude. */
static int32_t compact_scaled(int32_t v, uint32_t scale, int32_t shift)
{
    int64_t r = ((int64_t)v * (int64_t)scale) >> shift; /* 2^30 * 2^32 */
    return r > GN_COMPACT_REACH_Q16    ? GN_COMPACT_REACH_Q16
           : r < -GN_COMPACT_REACH_Q16 ? -GN_COMPACT_REACH_Q16
                                       : (int32_t)r;
}

int gn_compact_project(gn_compact_corner *corner, const gn_compact_view *view, const int32_t v_q16[3])
{
    uint32_t scale = view->scale;
    int32_t shift = view->shift, depth_q16 = 0;
    if (view->near_norm) {
        uint32_t z = (uint32_t)gn_max32(v_q16[2], view->near_q16); /* a cut may be a rounding nearer */
        int32_t clz = gn_clz32(z);
        uint32_t recip = gn_recip_norm(z << clz, 2);
        /* near / Z = near_norm * recip * 2^(clz - near_clz - 63) */
        corner->key = (int32_t)gn_compact_mul(view->near_norm, recip, view->near_clz - clz + 1);
        scale = gn_compact_mul(scale, recip, 0); /* F / Z = scale * 2^(clz - shift - 32 - 16) */
        shift += 32 - clz;
    } else {
        depth_q16 = compact_scaled(v_q16[2], scale, shift);
        corner->key = -depth_q16 * 4;
    }
    for (int k = 0; k < 2; k++) corner->at_q16[k] = compact_scaled(v_q16[k], scale, shift) + (view->size[k] << 15);
    return gn_abs32(depth_q16) < GN_COMPACT_REACH_Q16;
}
