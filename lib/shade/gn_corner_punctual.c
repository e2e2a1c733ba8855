/* Spot and point lights at corners of cells. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_punctual.h"
#include "shade/gn_corner.h"

#if GN_INTERPOLATES && GN_PUNCTUAL_LIGHTS

/* clamp(share, 0, 1)^2 of a spot's rim, Q30. */
GN_HOT static int32_t rim_q30(const gn_light_state *light, int32_t cosine_q30, gn_corner_light *out)
{
    int32_t beyond = cosine_q30 - light->cos_outer_q30;
    uint64_t share = gn_corner_rim_q30(light, gn_abs32(beyond));
    int32_t whole = share >> 32 ? 126 : (int32_t)(share >> 25), q30 = (int32_t)share;
    out->arrives = (int8_t)(beyond <= 0 ? -whole : gn_max32(whole, 1));
    if (beyond <= 0) return 0;
    return share >= 1U << 30 ? 1 << 30 : 4 * gn_mul_high(q30, q30);
}

/* The share alone, within 2^8: a rim is 10^-4 wide or more, so that where one vertex is limited and another is lit, the
 * bound of what is linear in between is above 1. */
GN_HOT static int32_t rim_share_q20(const gn_light_state *light, int32_t cosine_q30)
{
    int32_t beyond = cosine_q30 - light->cos_outer_q30;
    uint64_t share = gn_corner_rim_q30(light, gn_abs32(beyond)) >> 10;
    int32_t q20 = share >> 28 ? 1 << 28 : (int32_t)share;
    return beyond < 0 ? -q20 : q20;
}

GN_HOT int32_t gn_corner_irradiance(const gn_frame *frame, const gn_light_state *light, const int32_t from_q16[3],
                                    uint64_t d2, int32_t facing_q16, gn_corner_light *out, int32_t *rim_q20)
{
    out->arrives = GN_CORNER_DARK;
    if (facing_q16 <= 0) return 0;
    if (d2 >= light->range2_q32 || d2 >> 62) return 0;
    int steps = light->kind == GN_LIGHT_SPOT && light->angle_scale.exp >= GN_NARROW_EXP ? 2 : GN_RECIP_STEPS(frame);
    int32_t shift = gn_clz64(d2) & ~1, half = (shift >> 1) - 1, most = INT32_MAX >> half, factor = 1 << 30;
    uint32_t root = gn_rsqrt_norm((uint32_t)((d2 << shift) >> 32), steps);
    int32_t root_q31 = (int32_t)(root >> 1);
    GN_KEEP(root_q31); /* signed: one multiplication; factor, too */
    out->arrives = GN_CORNER_FULLY;
    if (light->kind == GN_LIGHT_SPOT) {
        int32_t reach = (int32_t)gn_clamp64(-gn_dot_q30(from_q16, light->to_light_q30), -most, most),
                cosine = 2 * gn_mul_high(reach * (1 << half), root_q31);
        if (rim_q20) *rim_q20 = rim_share_q20(light, cosine);
        else if (reach > 0) factor = rim_q30(light, cosine, out);
        else factor = 0, out->arrives = 1 - GN_CORNER_FULLY;
        if (!factor) return 0;
    }
    GN_KEEP(factor);
    if (light->range2_q32 != UINT64_MAX) factor = 4 * gn_mul_high(factor, gn_corner_window_q30(light, d2));
    int32_t cosine = 2 * gn_mul_high(gn_min32(facing_q16, most) << half, root_q31);
    GN_KEEP(factor);
    int32_t share = 4 * gn_mul_high(factor, cosine);
    if (d2 < frame->min2_q32) { /* cosines are of the true distance */
        shift = gn_clz64(frame->min2_q32) & ~1;
        root = gn_rsqrt_norm((uint32_t)((frame->min2_q32 << shift) >> 32), steps);
    }
    /* 1 / d^2 = root^2 * 2^(shift - 94), of which 31 bits are used */
    int32_t root2 = (int32_t)(gn_umul_high(root, root) >> 1);
    GN_KEEP(root2);
    int32_t q = gn_mul_high(share, root2), down = 35 - shift - light->colour_exp;
    if (down >= 0) return gn_min32(down > 31 ? 0 : q >> down, 1 << 27);
    return down < -27 || q >> (27 + down) ? 1 << 27 : q << -down;
}

#endif
