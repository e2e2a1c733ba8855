/* Lighting of one surface point. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "light/gn_punctual.h"
#include "shade/gn_light.h"
#include "shade/gn_shadow.h"

#if GN_SPECULAR
/* max(0, n . h)^(2^k), Q30, and h - n. [M3] */
GN_HOT static int32_t highlight_q30(const gn_surface *surface, const gn_sample *sample, const int32_t to_light_q30[3],
                                    int32_t lobe_q30[3])
{
    int32_t h[3];
    for (int i = 0; i < 3; i++) h[i] = (to_light_q30[i] >> 1) + (sample->to_eye_q30[i] >> 1); /* |h| <= 1 */
    int64_t wide[3] = {h[0], h[1], h[2]};
    int known = gn_normalise_q30(h, wide);
    for (int i = 0; i < 3; i++) lobe_q30[i] = gn_sat32((int64_t)h[i] - sample->normal_q30[i]);
    int64_t dot = gn_dot_q30(sample->normal_q30, h);
    if (!known || dot <= 0) return 0;
    int32_t power = (int32_t)gn_clamp64(dot, 0, 1 << 30);
    for (int32_t k = 0; k < surface->object->shininess_log2; k++) power = gn_mul_q30(power, power);
    return power;
}

GN_HOT GN_NOINLINE uint32_t gn_light_highlight(const gn_frame *frame, const gn_surface *surface,
                                               const gn_sample *sample, uint32_t slot, int32_t lobe_q30[3])
{
    const gn_light_state *light = surface->light[slot].state;
    const int32_t *from = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * slot + GN_LIGHT_POINT_AT];
    for (int i = 0; i < 3; i++) lobe_q30[i] = 0;
    if (GN_PUNCTUAL_LIGHTS && light->kind != GN_LIGHT_DIRECTIONAL) {
        gn_punctual_point point;
        int32_t to_light[3];
        if (!gn_punctual_at(frame, light, from, &point)) return 0;
        for (int i = 0; i < 3; i++) to_light[i] = gn_punctual_cosine_q30(&point, -from[i]);
        return gn_punctual_irradiance_q24(&point, highlight_q30(surface, sample, to_light, lobe_q30));
    }
    return (uint32_t)(highlight_q30(surface, sample, light->to_light_q30, lobe_q30) >> 6);
}
#else
GN_HOT uint32_t gn_light_highlight(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                   uint32_t slot, int32_t lobe_q30[3])
{
    (void)frame, (void)surface, (void)sample, (void)slot, (void)lobe_q30;
    return 0;
}
#endif

/* Incident light of a spot or point light of the list. */
GN_HOT static inline const gn_arrival *arrival_of(const gn_sample *sample, uint32_t slot)
{
#if GN_PUNCTUAL_LIGHTS
    return &sample->arrival[slot];
#else
    (void)sample, (void)slot;
    return NULL;
#endif
}

GN_HOT uint32_t gn_light_shadow(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                uint32_t light_idx)
{
    uint32_t slot = 0;
    while (slot < surface->n_lights && surface->light[slot].idx != light_idx) slot++;
    if (slot == surface->n_lights) return 0;
    const int32_t *value = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * slot];
    if (value[GN_LIGHT_FACING] <= 0) return 0;
    if (GN_PUNCTUAL_LIGHTS && surface->light[slot].state->kind != GN_LIGHT_DIRECTIONAL &&
        !arrival_of(sample, slot)->reaches)
        return 0;
    return gn_shadow_factor(frame, surface, sample, slot, gn_shadow_distance(frame, surface, sample));
}

/* Light of Q24 irradiance times a colour, Q16, to Q20; 2^24 * 2^31 */
GN_HOT static void add(uint64_t sum_q20[3], const uint32_t colour_uq16[3], uint32_t irradiance_q24)
{
    GN_UNROLL
    for (int c = 0; c < 3; c++) sum_q20[c] += ((uint64_t)colour_uq16[c] * irradiance_q24 + (1U << 19)) >> 20;
}

#if GN_TEXTURES
/* A texture of the surface, whose smaller levels begin at depth2. */
GN_HOT static GN_NOINLINE void look_up(const gn_frame *frame, const gn_sample *sample, const gn_texture *texture,
                                       uint64_t depth2_q32, uint32_t colour_uq16[3])
{
#if GN_MIPMAPS
    gn_texture level;
    if (gn_texture_has_levels(texture)) {
        int32_t z_q16 = GN_FLAT_Q16(frame) ? GN_FLAT_Q16(frame) : sample->value[GN_VALUE_Z];
        gn_texture_use_level(&level, texture, gn_texture_level_at(texture, depth2_q32, z_q16));
        texture = &level;
    }
#endif
    (void)frame, (void)depth2_q32;
    GN_COUNT(textured, 1);
    gn_texture_colour(texture, sample->value[GN_VALUE_UV], sample->value[GN_VALUE_UV + 1], colour_uq16);
}
#endif

/* Vertex colour and texture. [M3] */
GN_HOT static inline void modulate(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                   uint64_t sum[3])
{
    if (GN_COLOURED(surface))
        for (int c = 0; c < 3; c++)
            sum[c] = (sum[c] * (uint32_t)gn_max32(sample->value[GN_VALUE_RGB + c], 0) + 0x8000U) >> 16;
#if GN_TEXTURES
    uint32_t colour[3];
    if (!surface->textured || !surface->object->texture) return;
    look_up(frame, sample, surface->object->texture, GN_LEVEL_DEPTH2(surface), colour);
    for (int c = 0; c < 3; c++) sum[c] = (sum[c] * colour[c] + 0x8000U) >> 16;
#endif
    (void)frame;
}

/* Light that the surface emits, of which texture and colours take nothing away. [M10] */
GN_HOT static void add_glow(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint64_t sum[3])
{
    const uint32_t *emissive = surface->object->emissive_uq16;
    if (!GN_GLOWS(surface)) return;
#if GN_GLOW_TEXTURES
    uint32_t colour[3];
    if (surface->glow) {
        look_up(frame, sample, surface->glow, GN_GLOW_DEPTH2(surface), colour);
        for (int c = 0; c < 3; c++) sum[c] += ((uint64_t)emissive[c] * colour[c] + 0x800U) >> 12; /* 2^24 * 2^16 */
        return;
    }
#endif
    for (int c = 0; c < 3; c++) sum[c] += emissive[c] << 4;
    (void)frame, (void)sample;
}

GN_HOT GN_NOINLINE void gn_light_modulate(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                          uint64_t sum_q20[3])
{
    modulate(frame, surface, sample, sum_q20);
    add_glow(frame, surface, sample, sum_q20);
}

/* Adds the highlight of a light of the list. */
GN_HOT static inline void add_highlight(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                        uint32_t slot, uint32_t shadow_uq16, uint64_t sum_q20[3])
{
    const gn_light_state *light = surface->light[slot].state;
    uint32_t colour[3];
    int32_t lobe[3];
    GN_COUNT(highlights, 1);
    GN_UNROLL
    for (int c = 0; c < 3; c++) colour[c] = gn_mul_uq16(light->colour_uq16[c], surface->object->specular_uq16[c]);
    add(sum_q20, colour, gn_mul_uq16(gn_light_highlight(frame, surface, sample, slot, lobe), shadow_uq16));
}

/* Baked light and all lights; a shadow is looked up only where light arrives. [P10] [M9] */
GN_HOT void gn_light_radiance(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                              uint32_t radiance_q20[3])
{
    uint64_t sum[3] = {surface->base_q20[0], surface->base_q20[1],
                       surface->base_q20[2]}; /* < 2^28 and 2^35 per light */
    uint64_t highlights[3] = {0, 0, 0};
    uint32_t g = surface->shadowed ? gn_shadow_distance(frame, surface, sample) : 0;
    for (int c = 0; GN_BAKED_LIGHT && surface->baked && c < 3; c++) /* 2^20 * 2^17 */
        sum[c] += (uint64_t)surface->albedo_uq16[c] * (uint32_t)gn_max32(sample->value[GN_VALUE_BAKED + c], 0) >> 12;
    for (uint32_t i = 0; i < surface->n_lights; i++) {
        const gn_surface_light *light = &surface->light[i];
        const int32_t *value = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i];
        uint32_t diffuse = (uint32_t)gn_max32(value[GN_LIGHT_FACING], 0);
        if (GN_PUNCTUAL_LIGHTS && light->state->kind != GN_LIGHT_DIRECTIONAL)
            diffuse = arrival_of(sample, i)->irradiance_q24;
        if (!diffuse) continue;
        uint32_t shadow = gn_shadow_factor(frame, surface, sample, i, g);
        GN_COUNT(lights, 1);
        if (!shadow) continue;
        add(sum, light->radiance_uq16, shadow == 65536 ? diffuse : gn_mul_uq16(diffuse, shadow));
        if (GN_SPECULAR && surface->specular) add_highlight(frame, surface, sample, i, shadow, highlights);
    }
    gn_light_modulate(frame, surface, sample, sum);
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        if (GN_SPECULAR) sum[c] += highlights[c];
        radiance_q20[c] = sum[c] > UINT32_MAX ? UINT32_MAX : (uint32_t)sum[c];
    }
}
