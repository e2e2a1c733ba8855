/* Lighting of one surface point. */
#include "gn_light.h"
#include "gn_count.h"
#include "gn_punctual.h"
#include "gn_q.h"
#include "gn_shadow.h"
#include "gn_texture.h"

/* What arrives from one light, before its shadow. */
typedef struct {
    const gn_light_state *light;
    const int32_t *value;
    int32_t cosine_q24; /* directional */
#if GN_PUNCTUAL_LIGHTS
    gn_punctual_point point;
    int32_t cosine_q30;
#endif
} arriving;

/* Returns 0 where the surface faces away or no light arrives (P10). */
static int arrives(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t slot, arriving *a)
{
    (void)frame;
    a->light = surface->light[slot].state;
    a->value = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * slot];
    a->cosine_q24 = a->value[GN_LIGHT_FACING];
    if (a->value[GN_LIGHT_FACING] <= 0) return 0;
#if GN_PUNCTUAL_LIGHTS
    if (a->light->kind != GN_LIGHT_DIRECTIONAL) GN_COUNT(lights_punctual, 1);
    if (a->light->kind == GN_LIGHT_DIRECTIONAL) return 1;
    if (!gn_punctual_at(frame, a->light, a->value + GN_LIGHT_POINT_AT, &a->point)) return 0;
    a->cosine_q30 = gn_punctual_cosine_q30(&a->point, a->value[GN_LIGHT_FACING]);
#endif
    return 1;
}

/* Irradiance of a light whose colour is 1, Q24. */
static uint32_t diffuse_q24(const arriving *a)
{
#if GN_PUNCTUAL_LIGHTS
    if (a->light->kind != GN_LIGHT_DIRECTIONAL) return gn_punctual_irradiance_q24(&a->point, a->cosine_q30);
#endif
    return (uint32_t)a->cosine_q24;
}

#if GN_SPECULAR
/* max(0, n . h)^(2^k), Q30 */
static int32_t highlight_q30(const gn_surface *surface, const gn_sample *sample, const int32_t to_light_q30[3])
{
    int32_t h[3];
    for (int i = 0; i < 3; i++) h[i] = (to_light_q30[i] >> 1) + (sample->to_eye_q30[i] >> 1); /* |h| <= 1 */
    int64_t wide[3] = {h[0], h[1], h[2]};
    if (!gn_normalise_q30(h, wide)) return 0;
    int64_t dot = gn_shr64(gn_dot64(sample->normal_q30, h), 30);
    if (dot <= 0) return 0;
    int32_t power = (int32_t)gn_clamp64(dot, 0, 1 << 30);
    for (int32_t k = 0; k < surface->object->shininess_log2; k++) power = gn_mul_q30(power, power);
    return power;
}

/* The same times what arrives, Q24. */
static uint32_t specular_q24(const gn_surface *surface, const gn_sample *sample, const arriving *a)
{
#if GN_PUNCTUAL_LIGHTS
    if (a->light->kind != GN_LIGHT_DIRECTIONAL) {
        int32_t to_light[3];
        for (int i = 0; i < 3; i++) to_light[i] = gn_punctual_cosine_q30(&a->point, -a->value[GN_LIGHT_POINT_AT + i]);
        return gn_punctual_irradiance_q24(&a->point, highlight_q30(surface, sample, to_light));
    }
#endif
    return (uint32_t)(highlight_q30(surface, sample, a->light->to_light_q30) >> 6);
}
#endif

uint32_t gn_light_shadow(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t light_idx)
{
    arriving a;
    for (uint32_t i = 0; i < surface->n_lights; i++)
        if (surface->light[i].idx == light_idx && arrives(frame, surface, sample, i, &a))
            return gn_shadow_factor(frame, surface, sample, i, gn_shadow_distance(frame, surface, sample));
    return 0;
}

/* Light of Q24 irradiance times a colour, Q16, to Q20; 2^24 * 2^31 */
static void add(uint64_t sum_q20[3], const uint32_t colour_uq16[3], uint32_t irradiance_q24)
{
    for (int c = 0; c < 3; c++) sum_q20[c] += ((uint64_t)colour_uq16[c] * irradiance_q24 + (1U << 19)) >> 20;
}

/* Vertex colour and texture. */
static void modulate(const gn_surface *surface, const gn_sample *sample, uint64_t sum[3])
{
    if (surface->coloured)
        for (int c = 0; c < 3; c++) sum[c] = (sum[c] * (uint32_t)gn_max32(sample->value[GN_VALUE_RGB + c], 0) + 0x8000U) >> 16;
#if GN_TEXTURES
    uint32_t texture[3];
    if (!surface->textured) return;
    GN_COUNT(textured, 1);
    gn_texture_colour(surface->object->texture, sample->value[GN_VALUE_UV], sample->value[GN_VALUE_UV + 1], texture);
    for (int c = 0; c < 3; c++) sum[c] = (sum[c] * texture[c] + 0x8000U) >> 16;
#endif
}

void gn_light_radiance(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t radiance_q20[3])
{
    uint64_t sum[3] = {surface->base_q20[0], surface->base_q20[1], surface->base_q20[2]}; /* < 2^28 and 2^35 per light */
#if GN_SPECULAR
    uint64_t highlights[3] = {0, 0, 0};
#endif
    uint32_t g = surface->shadowed ? gn_shadow_distance(frame, surface, sample) : 0;
#if GN_BAKED_LIGHT
    for (int c = 0; surface->baked && c < 3; c++) /* 2^20 * 2^17 */
        sum[c] += (uint64_t)surface->object->albedo_uq16[c] * (uint32_t)gn_max32(sample->value[GN_VALUE_BAKED + c], 0) >> 12;
#endif
    for (uint32_t i = 0; i < surface->n_lights; i++) {
        arriving a;
        if (!arrives(frame, surface, sample, i, &a)) continue;
        uint32_t shadow = gn_shadow_factor(frame, surface, sample, i, g);
        GN_COUNT(lights, 1);
        if (!shadow) continue;
        uint32_t diffuse = diffuse_q24(&a);
        add(sum, surface->light[i].radiance_uq16, shadow == 65536 ? diffuse : gn_mul_uq16(diffuse, shadow));
#if GN_SPECULAR
        if (surface->specular) {
            GN_COUNT(highlights, 1);
            uint32_t colour[3];
            for (int c = 0; c < 3; c++) colour[c] = gn_mul_uq16(a.light->colour_uq16[c], surface->object->specular_uq16[c]);
            add(highlights, colour, gn_mul_uq16(specular_q24(surface, sample, &a), shadow));
        }
#endif
    }
    modulate(surface, sample, sum);
    for (int c = 0; c < 3; c++) {
#if GN_SPECULAR
        sum[c] += highlights[c];
#endif
        radiance_q20[c] = sum[c] > UINT32_MAX ? UINT32_MAX : (uint32_t)sum[c];
    }
}
