/* Lighting of one surface point. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "light/gn_lights.h"
#include "shade/gn_pixel.h"
#include "shade/gn_surface.h"
#include "shadow/gn_views.h"

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

/* ---- What arrives from spot and point lights --------------------------------------------------------------------- */

#if GN_PUNCTUAL_LIGHTS

/* ---- At a point -------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
/* B2 and B3 have moved the point before; B6 does it here, in one of its forms, face by face of a point light. Returns
 * what is to be taken off its depth, Q32. */
GN_HOT static int64_t move_point(const gn_surface *surface, int32_t z_q16, const gn_light_view *view,
                                 gn_auto_bias *form, const int32_t from_q16[3], const int32_t offset_q16[3],
                                 int32_t out_q16[3])
{
#if GN_AUTO_BIAS
    if (*form) return gn_bias_auto_persp(view, form, surface->face_q30, z_q16, from_q16, out_q16);
#endif
    (void)surface, (void)z_q16, (void)view, (void)form;
    for (int i = 0; i < 3; i++) out_q16[i] = gn_sat32((int64_t)from_q16[i] + offset_q16[i]);
    return 0;
}

/* Where the view sees the point in that form. Returns 0 if it is nearer than its near plane. */
GN_HOT static int place_in(const gn_frame *frame, const gn_surface *surface, int32_t z_q16, const gn_light_view *view,
                           gn_auto_bias form, const int32_t from_q16[3], const int32_t offset_q16[3], gn_arrival *out)
{
    int32_t moved[3];
    const int64_t less_q32 = move_point(surface, z_q16 + GN_FLAT_Q16(frame), view, &form, from_q16, offset_q16, moved);
    gn_persp_place at;
    if (!gn_persp_find_place(frame, view, moved, less_q32, &at)) return 0;
    out->u_q16 = at.u_q16;
    out->v_q16 = at.v_q16;
    out->depth_q32 = at.depth_q32;
    return 1;
}

/* B6 along the normal would move what is at a spot's rim out of its tile, whose border says nothing of it: there it
 * goes along the ray. */
GN_HOT int gn_arrival_place(const gn_frame *frame, const gn_surface *surface, const gn_light_view *view, int32_t z_q16,
                            const int32_t from_q16[3], const int32_t offset_q16[3], gn_arrival *out)
{
    const gn_auto_bias form =
        GN_AUTO_BIAS ? (gn_auto_bias)frame->light[view->light_idx].auto_bias : GN_AUTO_BIAS_DEFAULT; /* none */
    int seen = place_in(frame, surface, z_q16, view, form, from_q16, offset_q16, out);
    const uint32_t end = (uint32_t)view->tile_texels << 16;
    if (GN_AUTO_BIAS && seen && form == GN_AUTO_BIAS_NORMAL &&
        ((uint32_t)out->u_q16 > end || (uint32_t)out->v_q16 > end))
        seen = GN_SEEN_OUTSIDE * place_in(frame, surface, z_q16, view, GN_AUTO_BIAS_DEPTH, from_q16, offset_q16, out);
    return seen;
}

/* P5: the face of the unmoved point; the moved one stays in it. */
GN_HOT static void light_space_point(const gn_frame *frame, const gn_surface *surface, const gn_light_state *light,
                                     int32_t z_q16, const int32_t *value, gn_arrival *out)
{
    const int32_t *from = value + GN_LIGHT_POINT_AT;
    uint8_t face = light->kind == GN_LIGHT_POINT ? (uint8_t)gn_persp_face(from) : 0;
    const gn_light_view *view = &frame->view[light->view_idx + face];
    out->face = gn_arrival_place(frame, surface, view, z_q16, from, value + GN_LIGHT_OFFSET, out) ? face : GN_FACE_NONE;
}
#endif

GN_HOT uint32_t gn_arrival_irradiance_q24(const gn_frame *frame, const gn_light_state *light, const int32_t *value,
                                          int *arrives)
{
    gn_punctual_point point;
    *arrives = GN_ARRIVES_NOT;
    if (value[GN_LIGHT_FACING] <= 0 || !gn_punctual_at(frame, light, value + GN_LIGHT_POINT_AT, &point)) return 0;
    GN_COUNT(lights_punctual, 1);
    *arrives = light->kind == GN_LIGHT_SPOT && !point.within_inner ? GN_ARRIVES_RIM : GN_ARRIVES_FULLY;
    return gn_punctual_irradiance_q24(&point, gn_punctual_cosine_q30(&point, value[GN_LIGHT_FACING]));
}

/* `value` is the light's slot of a sample, z the view depth. [P10] */
GN_HOT static void arrive(const gn_frame *frame, const gn_surface *surface, const gn_light_state *light, int32_t z_q16,
                          const int32_t *value, gn_arrival *out)
{
    int arrives;
    out->irradiance_q24 = gn_arrival_irradiance_q24(frame, light, value, &arrives);
    out->reaches = arrives != GN_ARRIVES_NOT;
#if GN_SHADOWS
    out->face = GN_FACE_NONE;
    if (arrives && surface->shadowed && light->view_idx >= 0)
        light_space_point(frame, surface, light, z_q16, value, out);
#else
    (void)surface, (void)z_q16;
#endif
}

GN_HOT void gn_arrivals_at(const gn_frame *frame, const gn_surface *surface, gn_sample *sample)
{
    for (uint32_t i = surface->n_lights - surface->n_punctual; i < surface->n_lights; i++)
        arrive(frame, surface, surface->light[i].state, sample->value[GN_VALUE_Z],
               &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i], &sample->arrival[i]);
}

#endif

/* ---- Pixels of transparent surfaces ------------------------------------------------------------------------------ */

#if GN_LAYERS_MAX

/* A stored pixel, in the low bits. */
GN_HOT static uint32_t load(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y)
{
    int32_t at = x - rows->x0, row = y - rows->y0, i = row * rows->width + at;
    const uint8_t *bytes = rows->pixels->bytes;
    if (!GN_OTHER_FORMATS || frame->picture.format == GN_FORMAT_RGB565) return rows->pixels->rgb565[i];
    switch (frame->picture.format) {
    case GN_FORMAT_RGB565_SWAPPED:
        return rows->pixels->rgb565[i];
    case GN_FORMAT_GREY8:
        return bytes[i];
    case GN_FORMAT_GREY4:
        return (uint32_t)bytes[row * ((rows->width + 1) >> 1) + (at >> 1)] >> (at & 1 ? 0 : 4) & 15U;
    case GN_FORMAT_MONO1:
        return (uint32_t)bytes[row * ((rows->width + 7) >> 3) + (at >> 3)] >> (7 - (at & 7)) & 1U;
    default:
        return (uint32_t)bytes[3 * i] | (uint32_t)bytes[3 * i + 1] << 8 | (uint32_t)bytes[3 * i + 2] << 16;
    }
}

/* Linear light of a level of 8 bits, 65535: 1. */
GN_HOT static uint32_t decode_8(const gn_frame *frame, uint32_t level)
{
    return GN_K(frame, srgb) ? gn_srgb_decode_table[level] : level * 257U;
}

GN_HOT static void decode_565(const gn_frame *frame, uint32_t stored, uint32_t rgb[3])
{
    uint32_t v = frame->picture.format == GN_FORMAT_RGB565_SWAPPED ? stored >> 8 | (stored & 255U) << 8 : stored;
    uint32_t r = v >> 11, g = v >> 5 & 63U, b = v & 31U;
    if (GN_K(frame, srgb)) {
        rgb[0] = gn_linear_31_table[r];
        rgb[1] = gn_linear_63_table[g];
        rgb[2] = gn_linear_31_table[b];
        return;
    }
    rgb[0] = (r * 65535U + 15U) / 31U;
    rgb[1] = (g * 65535U + 31U) / 63U;
    rgb[2] = (b * 65535U + 15U) / 31U;
}

/* A stored pixel's colour in linear light, 65535: 1; of greys three times the luminance. */
GN_HOT static void decode(const gn_frame *frame, uint32_t stored, uint32_t rgb[3])
{
    if (!GN_OTHER_FORMATS) {
        decode_565(frame, stored, rgb);
        return;
    }
    switch (frame->picture.format) {
    case GN_FORMAT_RGB565:
    case GN_FORMAT_RGB565_SWAPPED:
        decode_565(frame, stored, rgb);
        return;
    case GN_FORMAT_GREY8:
        rgb[0] = rgb[1] = rgb[2] = decode_8(frame, stored);
        return;
    case GN_FORMAT_GREY4:
        rgb[0] = rgb[1] = rgb[2] = decode_8(frame, 17U * stored);
        return;
    default:
        for (int c = 0; c < 3; c++) rgb[c] = decode_8(frame, stored >> 8 * c & 255U);
    }
}

/* The mixture, packed: alpha front + (1 - alpha) behind. 65535 * 65536 < 2^32, and with its 2^16th part, too. */
GN_HOT static GN_NOINLINE uint32_t mix(const gn_frame *frame, uint32_t front, uint32_t behind, uint32_t alpha_uq16)
{
    uint32_t a[3], b[3], q20[3];
    decode(frame, front, a);
    decode(frame, behind, b);
    for (int c = 0; c < 3; c++) {
        uint32_t sum = a[c] * alpha_uq16 + b[c] * (65536U - alpha_uq16);
        sum += sum >> 16; /* 65536: 1 */
        q20[c] = (sum >> 12) + (sum >> 11 & 1U);
    }
    return gn_pixel_pack(frame, q20);
}

#if GN_TEXTURES
/* Alpha of the triangle at hand, which has a texture. */
GN_HOT static uint32_t alpha_at(gn_shading *s, int32_t x, int32_t y)
{
    const gn_object *object = s->surface.object;
    const uint16_t n_lights = s->surface.n_lights;
    s->surface.n_lights = 0; /* nothing but texture coordinates is needed */
    gn_sample_at(s->frame, &s->surface, x, y, &s->sample);
    s->surface.n_lights = n_lights;
    const int32_t *uv = &s->sample.value[GN_VALUE_UV];
    return gn_mul_uq16(object->alpha_uq16, gn_texture_alpha(object->texture, uv[0], uv[1]));
}
#else
GN_HOT static uint32_t alpha_at(const gn_shading *s, int32_t x, int32_t y)
{
    (void)x, (void)y;
    return s->surface.object->alpha_uq16;
}
#endif

/* A bit cannot be mixed: as many pixels show what is in front as alpha says. [M8] */
GN_HOT static uint32_t choose(uint32_t front, uint32_t behind, uint32_t alpha_uq16, int32_t x, int32_t y)
{
    return alpha_uq16 >= gn_noise_uq16(x, y) ? front : behind;
}

GN_HOT void gn_mix_begin(gn_shading *s)
{
    s->mixture.front = UINT32_MAX; /* of no pixel */
}

GN_HOT void gn_mix_run(gn_shading *s, int32_t x, int32_t y, int32_t n)
{
    const gn_object *object = s->surface.object;
    gn_mixture *known = &s->mixture;
    gn_pixel_rows tile = s->rows;
    uint32_t alpha = object->alpha_uq16;
    tile.pixels = &s->scratch->pixel;
    for (; n > 0; n--, x++) {
        uint32_t front = load(s->frame, &s->rows, x, y), behind = load(s->frame, &tile, x, y);
        if (GN_TEXTURES && object->texture) alpha = alpha_at(s, x, y);
        if (GN_OTHER_FORMATS && s->frame->picture.format == GN_FORMAT_MONO1) {
            gn_pixel_store(s->frame, &tile, x, y, 65535U * choose(front, behind, alpha, x, y));
            continue;
        }
        if (front != known->front || behind != known->behind || alpha != known->alpha_uq16) {
            known->front = front;
            known->behind = behind;
            known->alpha_uq16 = alpha;
            known->packed = mix(s->frame, front, behind, alpha);
        }
        gn_pixel_store(s->frame, &tile, x, y, known->packed);
    }
}

#endif
