/* Lighting of one surface point. */
#include "gn_light.h"
#include "gn_filter.h"
#include "gn_q.h"

#if GN_SHADOWS
/* D5: 65536 up to the start of the fade, 0 from the max distance on. */
static uint32_t distance_fade(const gn_frame *frame, int32_t z_q16)
{
    if ((uint32_t)z_q16 <= frame->fade_start_q16) return 65536;
    int64_t left_q16 = (int64_t)frame->scene->shadow.max_distance_q16 - z_q16;
    if (left_q16 <= 0) return 0;
    return (uint32_t)gn_clamp64(gn_bf_apply(left_q16, frame->fade_scale, 32), 0, 65536);
}
#endif

#if GN_SHADOWS
/* frac(52.9829189 * frac(0.06711056 x + 0.00583715 y)) at a pixel's centre, Q0.16: both fractions are wraps of 32 bits. */
static uint32_t gradient_noise_uq16(int32_t x, int32_t y)
{
    uint32_t inner = (2U * (uint32_t)x + 1) * 144118830U + (2U * (uint32_t)y + 1) * 12535184U; /* 2^31 times the factors */
    return (uint32_t)(((uint64_t)inner * 3555623499U) >> 26) >> 16;                            /* 52.9829189 * 2^26 */
}

/* Attenuation in the sample's cascade, blended with the next one (D7). */
static uint32_t attenuation_at(const gn_frame *frame, const gn_light_view *view, const gn_sample *sample, const int32_t *coord)
{
    uint32_t factor = (uint32_t)sample->value[GN_VALUE_FADE];
    gn_blend blend = GN_BLENDED_CASCADES && sample->cascade != frame->last_cascade ? frame->scene->shadow.blend : GN_BLEND_HARD;
    if (blend == GN_BLEND_HARD || factor >= 65536) return gn_filter_attenuation(frame, view, coord[0], coord[1], coord[2]);
    const gn_light_view *next = view + (frame->cascade[sample->cascade].next - sample->cascade);
    if (blend == GN_BLEND_DITHER && factor >= gradient_noise_uq16(sample->x, sample->y))
        return gn_filter_attenuation(frame, view, coord[0], coord[1], coord[2]);
    uint32_t there = gn_filter_attenuation(frame, next, coord[3], coord[4], coord[5]);
    if (blend == GN_BLEND_DITHER) return there;
    uint32_t here = gn_filter_attenuation(frame, view, coord[0], coord[1], coord[2]);
    return gn_mul_uq16(here, factor) + gn_mul_uq16(there, 65536 - factor);
}
#endif

uint32_t gn_light_shadow(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t light_idx)
{
    const int32_t *value = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * light_idx];
    if (value[0] <= 0) return 0;
#if GN_SHADOWS
    int32_t view_idx = frame->light[light_idx].view_idx;
    if (view_idx < 0 || !(surface->object->flags & GN_OBJECT_RECEIVES) || sample->cascade == GN_CASCADE_NONE) return 65536;
    const gn_light_view *view = &frame->view[view_idx + sample->cascade];
    uint32_t strength = view->strength_uq16;
    if (frame->scene->shadow.distance_mode == GN_DISTANCE_DEPTH)
        strength = gn_mul_uq16(strength, distance_fade(frame, sample->value[GN_VALUE_Z]));
    if (sample->cascade == frame->last_cascade) strength = gn_mul_uq16(strength, (uint32_t)sample->value[GN_VALUE_FADE]); /* D6 */
    if (!strength) return 65536;
    uint32_t attenuation = attenuation_at(frame, view, sample, value + 1);
    return attenuation >= 65536 ? 65536 : 65536 - gn_mul_uq16(strength, 65536 - attenuation); /* M4 */
#else
    (void)frame;
    (void)surface;
    return 65536;
#endif
}

void gn_light_radiance(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t radiance_q20[3])
{
    uint64_t sum[3] = {surface->base_q20[0], surface->base_q20[1], surface->base_q20[2]}; /* <= 9 * 2^28 */
    uint32_t n_lights = surface->object->flags & GN_OBJECT_UNLIT ? 0 : frame->scene->n_lights;
    for (uint32_t l = 0; l < n_lights; l++) {
        uint32_t shadow = gn_light_shadow(frame, surface, sample, l);
        if (!shadow) continue;
        uint32_t diffuse_q24 = (uint32_t)sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * l];
        if (shadow != 65536) diffuse_q24 = gn_mul_uq16(diffuse_q24, shadow);
        const uint32_t *light = surface->light_uq16[l];
        sum[0] += ((uint64_t)light[0] * diffuse_q24 + (1U << 19)) >> 20; /* 2^24 * 2^24 */
        sum[1] += ((uint64_t)light[1] * diffuse_q24 + (1U << 19)) >> 20;
        sum[2] += ((uint64_t)light[2] * diffuse_q24 + (1U << 19)) >> 20;
    }
    for (int c = 0; c < 3; c++) {
        if (surface->coloured) sum[c] = (sum[c] * (uint32_t)gn_max32(sample->value[GN_VALUE_RGB + c], 0) + 0x8000U) >> 16;
        radiance_q20[c] = sum[c] > UINT32_MAX ? UINT32_MAX : (uint32_t)sum[c];
    }
}
