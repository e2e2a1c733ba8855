/* Spot and point lights. Distances squared are Q32 in 64 bits: components are below 2^31, so three squares stay below
 * 2^64. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"

#define GN_ONE_Q30 (1 << 30)

/* Coefficients of surface point minus light along a pixel's ray, world axes: see gn_ray_plane. */
GN_COLD static void ray_planes(const gn_frame *frame, gn_light_state *light)
{
    const gn_cam *cam = &frame->cam;
    gn_bfloat per_px = cam->inv_focal2;
    per_px.exp += 16;
    /* |ray| <= 1 + |x| + |y| over depth; tan_q16 bounds the two, that of y below 33 */
    uint32_t reach_q16 = 65536U + ((uint32_t)cam->tan_q16[0] > 1U << 30 ? 1U << 30 : (uint32_t)cam->tan_q16[0]) +
                         (uint32_t)cam->tan_q16[1];
    light->ray_shift = 30 - (32 - gn_clz32(reach_q16) - 16);
    for (int i = 0; i < 3; i++) {
        gn_ray_plane *ray = &light->from_light[i];
        ray->a0 = (int32_t)gn_scale64(cam->axis_q30[2][i], 30 - light->ray_shift);
        ray->ax = gn_sat32(gn_bf_apply(cam->axis_q30[0][i], per_px, light->ray_shift - 30));
        ray->ay = gn_sat32(gn_bf_apply(cam->axis_q30[1][i], per_px, light->ray_shift - 30));
        ray->d_q16 = (int64_t)cam->eye_q16[i] - light->position_q16[i];
    }
}

/* Colours become mantissas of at most 1: a channel loses less than 2^-16 of the largest. */
GN_COLD static void normalise_colour(gn_light_state *light, const gn_light *from)
{
    uint32_t largest = from->colour_uq16[0];
    for (int c = 1; c < 3; c++)
        if (from->colour_uq16[c] > largest) largest = from->colour_uq16[c];
    int32_t up = largest ? gn_clz32(largest) - 15 : 0; /* the largest to [2^16, 2^17) */
    for (int c = 0; c < 3; c++) light->colour_uq16[c] = (uint32_t)gn_scale64(from->colour_uq16[c], -up);
    light->colour_exp = from->colour_exp - up;
}

/* A spot or point light for the frame. [P1] */
GN_COLD void gn_punctual_setup(gn_frame *frame, uint32_t light_idx)
{
    const gn_light *from = &frame->scene->lights[light_idx];
    gn_light_state *light = &frame->light[light_idx];
    const gn_cam *cam = &frame->cam;
    int32_t offset[3];
    normalise_colour(light, from);
    for (int i = 0; i < 3; i++) {
        light->position_q16[i] = from->position_q16[i];
        offset[i] = from->position_q16[i] - cam->eye_q16[i]; /* within 2^30 each */
    }
    for (int i = 0; i < 3; i++) light->eye_q16[i] = (int32_t)gn_dot_q30(cam->axis_q30[i], offset); /* sqrt(3) * 2^30 */
    ray_planes(frame, light);
    uint64_t range = from->range_q16, floor2 = frame->min2_q32; /* r^2 >= 10^-4 */
    light->range2_q32 = range ? (range * range > floor2 ? range * range : floor2) : UINT64_MAX;
    light->inv_range2 = gn_bf_recip(gn_bf_from_u64(light->range2_q32));
    if (light->kind != GN_LIGHT_SPOT) return;
    /* cos(a / 2) = sqrt((1 + cos a) / 2): the half of an odd angle is between two turns */
    int64_t outer = (int64_t)gn_isqrt64((uint64_t)(GN_ONE_Q30 + (int64_t)gn_cos_q30(from->outer_turn)) << 29);
    int64_t inner = (int64_t)gn_isqrt64((uint64_t)(GN_ONE_Q30 + (int64_t)gn_cos_q30(from->inner_turn)) << 29);
    int64_t width = inner - outer < 107374 ? 107374 : inner - outer; /* 10^-4 */
    light->cos_outer_q30 = (int32_t)outer;
    light->angle_scale = gn_bf_recip(gn_bf_from_u64((uint64_t)width));
}

/* (1 - (d^2 / r^2)^2)^2, Q30; d < r [P2] */
GN_INLINE int32_t window_q30(const gn_light_state *light, uint64_t d2_q32)
{
    if (light->range2_q32 == UINT64_MAX) return GN_ONE_Q30;
    const int32_t clz = gn_clz64(light->range2_q32),
                  ratio = (int32_t)(gn_umul_high((uint32_t)((d2_q32 << clz) >> 32), light->inv_range2.mant) >> 1),
                  window = GN_ONE_Q30 - 4 * gn_mul_high(ratio, ratio);
    return 4 * gn_mul_high(window, window);
}

GN_HOT int32_t gn_punctual_window_q30(const gn_light_state *light, uint64_t d2_q32)
{
    return window_q30(light, d2_q32);
}

GN_COLD gn_bfloat gn_punctual_weight(const gn_light_state *light, uint64_t distance2_q32, uint64_t min2_q32)
{
    uint32_t largest = 1;
    for (int c = 0; c < 3; c++)
        if (light->colour_uq16[c] > largest) largest = light->colour_uq16[c];
    uint64_t window = distance2_q32 < light->range2_q32 ? (uint64_t)window_q30(light, distance2_q32) + 1 : 1;
    gn_bfloat weight = gn_bf_recip(gn_bf_from_u64(distance2_q32 > min2_q32 ? distance2_q32 : min2_q32));
    weight = gn_bf_mul(weight, gn_bf_from_u64(window * largest));
    weight.exp += light->colour_exp;
    return weight;
}

/* 2^47 / sqrt(v << shift >> 32); v > 0 */
GN_HOT static uint32_t inverse_root(uint64_t v, int32_t newton_steps, int32_t *shift)
{
    *shift = gn_clz64(v) & ~1;
    return gn_rsqrt_norm((uint32_t)((v << *shift) >> 32), newton_steps);
}

/* clamp((cos - cos outer) / (cos inner - cos outer), 0, 1)^2, Q30 [P3] */
GN_HOT static int32_t angle_q30(const gn_light_state *light, int32_t beyond_q30)
{
    if (beyond_q30 <= 0) return 0;
    const uint64_t share_q30 = gn_punctual_rim_q30(light, (uint32_t)beyond_q30);
    const int32_t share = (int32_t)share_q30;
    return share_q30 >> 30 ? GN_ONE_Q30 : 4 * gn_mul_high(share, share);
}

GN_HOT static int32_t root_steps(const gn_frame *frame, const gn_light_state *light)
{
    return light->kind == GN_LIGHT_SPOT && light->angle_scale.exp >= GN_NARROW_EXP ? 2 : GN_RECIP_STEPS(frame);
}

GN_HOT int32_t gn_punctual_cosine_q30(const gn_punctual_point *point, int32_t length_q16)
{
    const int32_t half = point->half, most = INT32_MAX >> gn_max32(half, 0);
    int32_t length = gn_max32(-most, gn_min32(length_q16, most));
    length = half < 0 ? length >> 1 : length * (1 << half);
    return 2 * gn_mul_high(length, point->root_q31);
}

/* Distance and cone together. [P2] [P3] */
GN_HOT int gn_punctual_at(const gn_frame *frame, const gn_light_state *light, const int32_t from_light_q16[3],
                          gn_punctual_point *out)
{
    const uint64_t d2 = gn_distance2_q32(from_light_q16);
    int32_t shift;
    out->within_inner = 0;
    out->beyond_q30 = INT32_MAX;
    if (d2 >= light->range2_q32 || d2 == 0) return 0;
    const int32_t steps = root_steps(frame, light);
    uint32_t root = inverse_root(d2, steps, &shift);
    out->half = (shift >> 1) - 1;
    out->root_q31 = (int32_t)(root >> 1);
    out->factor_q30 = window_q30(light, d2);
    if (light->kind == GN_LIGHT_SPOT) {
        /* against the axis towards the light: the ratio of light-plane distance to distance */
        const int32_t along = gn_sat32(-gn_dot_q30(from_light_q16, light->to_light_q30));
        out->beyond_q30 = along > 0 ? gn_punctual_cosine_q30(out, along) - light->cos_outer_q30 : -GN_ONE_Q30;
        const int32_t angle = angle_q30(light, out->beyond_q30);
        out->within_inner = angle == GN_ONE_Q30;
        out->factor_q30 = 4 * gn_mul_high(out->factor_q30, angle);
    }
    if (d2 < frame->min2_q32) root = inverse_root(frame->min2_q32, steps, &shift); /* cosines are of the distance */
    /* 1 / d^2 = root^2 * 2^(shift - 94), of which 31 bits are used */
    out->inverse_q31 = (int32_t)(gn_umul_high(root, root) >> 1);
    out->down = 35 - shift - light->colour_exp;
    return out->factor_q30 != 0;
}

GN_HOT int32_t gn_punctual_irradiance_q24(const gn_punctual_point *point, int32_t cosine_q30)
{
    const int32_t down = point->down;
    if (cosine_q30 <= 0) return 0;
    const int32_t share_q30 = 4 * gn_mul_high(point->factor_q30, cosine_q30),
                  q = gn_mul_high(share_q30, point->inverse_q31);
    if (down >= 0) return q >> gn_min32(down, 31);
    return down < -30 || q >> (31 + down) ? INT32_MAX : q * (1 << -down);
}
