/* Compact arithmetic: points, from an object's space to a raster. */
#include "gn_compact.h"

#if GN_COMPACT
#include "gn_hint.h"
#include "gn_math.h"
#include "gn_q.h"

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
    /* matrix and axis entries are at most 2^30: sums below 2^62; differences of places at most 2^30 */
    for (int r = 0; r < 3; r++) {
        const int32_t *axis = view->axis_q30[r];
        int64_t t = 0;
        for (int c = 0; c < 3; c++) {
            int64_t m = 0;
            for (int k = 0; k < 3; k++) m += (int64_t)axis[k] * affine->m_q30[k][c];
            out->m_q29[r][c] = (int32_t)(m >> 31); /* sqrt(3) 2^29 */
            t += (int64_t)axis[c] * (affine->t_q16[c] - view->eye_q16[c]);
        }
        out->t_q16[r] = (int32_t)(t >> 30); /* sqrt(3) 2^30 */
    }
    out->shift = (int32_t)(13U - (uint32_t)affine->exp + (uint32_t)frac_bits);
    return (uint32_t)out->shift <= 43;
}

int gn_compact_transform(int32_t out_q16[3], const gn_compact_xform *xform, const int32_t p[3])
{
    uint32_t beyond = 0;
    for (int r = 0; r < 3; r++) {
        const int32_t *m = xform->m_q29[r];
        /* three times 2^31 * sqrt(3) 2^29: below 2^63 */
        int64_t v = (((int64_t)m[0] * p[0] + (int64_t)m[1] * p[1] + (int64_t)m[2] * p[2]) >> xform->shift) + xform->t_q16[r];
        beyond |= (uint32_t)((uint64_t)(v + GN_COMPACT_LENGTH_Q16) >> 30);
        beyond |= (uint32_t)((uint64_t)v >> 32) ^ (uint32_t)((int32_t)v >> 31);
        out_q16[r] = (int32_t)v;
    }
    return !beyond;
}

/* v * scale >> shift, at most the reach in magnitude. */
static int32_t scaled(int32_t v, uint32_t scale, int32_t shift)
{
    int64_t r = ((int64_t)v * (int64_t)scale) >> shift; /* 2^30 * 2^32 */
    return r > GN_COMPACT_REACH_Q16 ? GN_COMPACT_REACH_Q16 : r < -GN_COMPACT_REACH_Q16 ? -GN_COMPACT_REACH_Q16 : (int32_t)r;
}

/* Nearer than near, or behind the eye: sides by the signs of X 2F + W Z and X 2F - W Z. */
static uint32_t before_near(const int32_t v_q16[3], const gn_compact_view *view)
{
    uint32_t outside = GN_COMPACT_NEAR;
    for (int k = 0; k < 2; k++) {
        int64_t x = (int64_t)v_q16[k] * (int64_t)(view->scale >> view->shift); /* 2^29 * 2^31 */
        int64_t w = (int64_t)v_q16[2] * (view->size[k] << 16);
        if (x + w < 0) outside |= (uint32_t)GN_COMPACT_LEFT << k;
        if (x - w > 0) outside |= (uint32_t)GN_COMPACT_RIGHT << k;
    }
    return outside;
}

uint32_t gn_compact_project(gn_compact_corner *corner, const gn_compact_view *view)
{
    const int32_t *v = corner->v_q16;
    uint32_t scale = view->scale, outside = 0;
    int32_t shift = view->shift;
    if (view->near_norm) {
        if (v[2] < view->near_q16) return before_near(v, view);
        int32_t clz = gn_clz32((uint32_t)v[2]);
        uint32_t recip = gn_recip_norm((uint32_t)v[2] << clz, 2);
        /* near / Z = near_norm * recip * 2^(clz - near_clz - 63) */
        corner->key = (int32_t)gn_compact_mul(view->near_norm, recip, view->near_clz - clz + 1);
        scale = gn_compact_mul(scale, recip, 0); /* F / Z = scale * 2^(clz - shift - 32 - 16) */
        shift += 32 - clz;
    } else {
        int32_t depth_q16 = scaled(v[2], scale, shift);
        if (gn_abs32(depth_q16) == GN_COMPACT_REACH_Q16) outside = GN_COMPACT_FAR;
        corner->key = -depth_q16 * 4;
    }
    for (int k = 0; k < 2; k++) {
        int32_t from_middle = scaled(v[k], scale, shift), at = from_middle + (view->size[k] << 15);
        if (gn_abs32(from_middle) == GN_COMPACT_REACH_Q16) outside |= GN_COMPACT_FAR;
        if (at < 0) outside |= (uint32_t)GN_COMPACT_LEFT << k;
        if (at > view->size[k] << 16) outside |= (uint32_t)GN_COMPACT_RIGHT << k;
        corner->at_q16[k] = at;
    }
    return outside;
}

#endif
