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
GN_HOT static uint32_t window_q30(const gn_light_state *light, uint64_t d2_q32)
{
    if (light->range2_q32 == UINT64_MAX) return GN_ONE_Q30;
    int64_t ratio = gn_clamp64(gn_bf_apply((int64_t)(d2_q32 >> 1), light->inv_range2, 31), 0, GN_ONE_Q30);
    int32_t window = GN_ONE_Q30 - gn_mul_q30((int32_t)ratio, (int32_t)ratio);
    return (uint32_t)gn_mul_q30(window, window);
}

GN_COLD gn_bfloat gn_punctual_weight(const gn_light_state *light, uint64_t distance2_q32, uint64_t min2_q32)
{
    uint32_t largest = 1;
    for (int c = 0; c < 3; c++)
        if (light->colour_uq16[c] > largest) largest = light->colour_uq16[c];
    uint64_t window = (uint64_t)window_q30(light, distance2_q32) + 1;
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
GN_HOT static uint32_t angle_q30(const gn_light_state *light, int32_t beyond)
{
    if (beyond <= 0) return 0;
    int32_t share = (int32_t)gn_clamp64(gn_bf_apply(beyond, light->angle_scale, 30), 0, GN_ONE_Q30);
    return (uint32_t)gn_mul_q30(share, share);
}

GN_HOT static int32_t root_steps(const gn_frame *frame, const gn_light_state *light)
{
    return light->kind == GN_LIGHT_SPOT && light->angle_scale.exp >= GN_NARROW_EXP ? 2 : GN_RECIP_STEPS(frame);
}

/* Distance and cone together. [P2] [P3] */
GN_HOT int gn_punctual_at(const gn_frame *frame, const gn_light_state *light, const int32_t from_light_q16[3],
                          gn_punctual_point *out)
{
    uint64_t d2 = 0;
    out->within_inner = 0;
    out->beyond_q30 = INT32_MAX;
    for (int i = 0; i < 3; i++) d2 += (uint64_t)((int64_t)from_light_q16[i] * from_light_q16[i]);
    if (d2 >= light->range2_q32 || d2 == 0) return 0;
    int32_t steps = root_steps(frame, light);
    out->inv_root = out->scale_root = inverse_root(d2, steps, &out->shift);
    out->scale_shift = out->shift;
    if (d2 < frame->min2_q32) out->scale_root = inverse_root(frame->min2_q32, steps, &out->scale_shift);
    out->colour_exp = light->colour_exp;
    out->factor_q30 = window_q30(light, d2);
    if (light->kind == GN_LIGHT_SPOT) {
        /* against the axis towards the light: the ratio of light-plane distance to distance */
        int32_t along = gn_sat32(-gn_dot_q30(from_light_q16, light->to_light_q30));
        out->beyond_q30 = along > 0 ? gn_punctual_cosine_q30(out, along) - light->cos_outer_q30 : -GN_ONE_Q30;
        uint32_t angle = angle_q30(light, out->beyond_q30);
        out->within_inner = angle == GN_ONE_Q30;
        out->factor_q30 = (uint32_t)gn_mul_q30((int32_t)out->factor_q30, (int32_t)angle);
    }
    return out->factor_q30 != 0;
}

GN_HOT int32_t gn_punctual_cosine_q30(const gn_punctual_point *point, int32_t length_q16)
{
    /* length * 2^16 / (d * 2^16): d = 2^(63 - shift / 2) / root. 2^31 * 2^32 */
    int64_t product = (int64_t)length_q16 * (int64_t)point->inv_root;
    return (int32_t)gn_clamp64(gn_scale64(product, 33 - point->shift / 2), -GN_ONE_Q30, GN_ONE_Q30);
}

GN_HOT uint32_t gn_punctual_irradiance_q24(const gn_punctual_point *point, int32_t cosine_q30)
{
    if (cosine_q30 <= 0) return 0;
    int64_t share_q30 = gn_mul_q30((int32_t)point->factor_q30, cosine_q30);
    /* 1 / d^2 = 2^32 / d2 = root^2 * 2^(shift - 94); 32 bits of root^2 */
    uint64_t inverse = ((uint64_t)point->scale_root * point->scale_root) >> 32;
    int64_t q24 =
        gn_scale64(share_q30 * (int64_t)(inverse >> 1), 30 + 61 - 24 - point->scale_shift - point->colour_exp);
    return (uint32_t)gn_clamp64(q24, 0, INT32_MAX);
}
