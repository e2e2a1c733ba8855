/* Pixels that are corners of their own. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_pixel.h"
#include "shade/gn_surface.h"
#include "shadow/gn_filter.h"

/* ---- Realtime shadows and baked masks ---------------------------------------------------------------------------- */

#define GN_ONE_UQ16 65536U

/* lerp(1, x, k) */
GN_HOT static uint32_t faded(uint32_t x_uq16, uint32_t k_uq16)
{
    return x_uq16 >= GN_ONE_UQ16 ? GN_ONE_UQ16 : GN_ONE_UQ16 - gn_mul_uq16(k_uq16, GN_ONE_UQ16 - x_uq16);
}

/* Realtime shadow and baked mask, by the light's strength. [M4] [M6] */
GN_HOT static inline uint32_t mix_shadow(const gn_frame *frame, const gn_light_state *light, uint32_t mask_uq16,
                                         uint32_t g_uq16, uint32_t realtime_uq16)
{
    uint32_t strength = light->strength_uq16, realtime = realtime_uq16;
    switch (frame->scene->shadow.mixing) {
    case GN_MIXING_ALWAYS:
        realtime = faded(realtime, g_uq16);
        return faded(realtime < mask_uq16 ? realtime : mask_uq16, strength);
    case GN_MIXING_DISTANCE:
        return faded(gn_mul_uq16(mask_uq16, GN_ONE_UQ16 - g_uq16) + gn_mul_uq16(realtime, g_uq16), strength);
    default:
        return faded(realtime, gn_mul_uq16(strength, g_uq16));
    }
}

GN_HOT uint32_t gn_shadow_mixed(const gn_frame *frame, const gn_light_state *light, uint32_t mask_uq16, uint32_t g_uq16,
                                uint32_t realtime_uq16)
{
    return mix_shadow(frame, light, mask_uq16, g_uq16, realtime_uq16);
}

GN_HOT uint32_t gn_shadow_mixed_ends(const gn_frame *frame, const gn_light_state *light, uint32_t mask_uq16,
                                     uint32_t g_uq16, uint32_t *lit_uq16)
{
    *lit_uq16 = mix_shadow(frame, light, mask_uq16, g_uq16, GN_ONE_UQ16);
    return mix_shadow(frame, light, mask_uq16, g_uq16, 0);
}

GN_HOT uint32_t gn_shadow_baked(const gn_light_state *light, uint32_t mask_uq16)
{
    return faded(mask_uq16, light->strength_uq16);
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
/* A lookup where a view of the light sees the corner. */
GN_HOT static GN_NOINLINE uint32_t look_up_place(gn_shading *s, const gn_corner *c, uint32_t slot,
                                                 const gn_light_view *view)
{
    const gn_corner_light *at = &c->light[slot];
    const int32_t depth_q30 = gn_max32(0, gn_min32(at->depth_q30, (1 << 30) - 1));
    gn_receiver r = {at->u_q16, at->v_q16, (uint32_t)depth_q30 << 2, {0, 0}, c->x, c->y};
    gn_corner_slopes(&s->lattice, s->frame, &s->surface, view, c, r.slope_q28);
    GN_COUNT(lookups, 1);
    GN_NOTE_LOOKUP(&s->scratch->squares, s->frame, view, &r);
    return gn_filter_attenuation(s->frame, view, &r);
}

/* What is left of a light in one of its views. */
GN_HOT static uint32_t attenuation_in(gn_shading *s, gn_corner *c, uint32_t slot, uint32_t view_idx)
{
    if (!gn_corner_place(&s->lattice, s->frame, &s->surface, c, slot, view_idx)) return 65536;
    return look_up_place(s, c, slot, &s->frame->view[s->surface.light[slot].state->view_idx + (int32_t)view_idx]);
}

/* In its shadow maps: of a cascade that blends into the next one, in both [D7]. */
GN_HOT static uint32_t looked_up(gn_shading *s, gn_corner *c, uint32_t slot)
{
    const gn_light_state *light = s->surface.light[slot].state;
    const uint32_t view = c->light[slot].view, fade_uq16 = c->fade_uq16;
    if (view == GN_VIEW_NONE) return 65536;
    const gn_blend blend = GN_BLENDED_CASCADES && light->kind == GN_LIGHT_DIRECTIONAL &&
                                   !s->frame->view[light->view_idx].border_lit && fade_uq16 < 65536 &&
                                   (int32_t)view != GN_LAST_CASCADE(s->frame)
                               ? s->frame->scene->shadow.blend
                               : GN_BLEND_HARD;
    if (blend == GN_BLEND_HARD || (blend == GN_BLEND_DITHER && fade_uq16 >= gn_noise_uq16(c->x, c->y)))
        return attenuation_in(s, c, slot, view);
    const uint32_t there = attenuation_in(s, c, slot, (uint32_t)s->frame->cascade[view].next);
    if (blend == GN_BLEND_DITHER) return there;
    return gn_mul_uq16(attenuation_in(s, c, slot, view), fade_uq16) + gn_mul_uq16(there, 65536U - fade_uq16);
}
#else
GN_HOT static uint32_t looked_up(gn_shading *s, gn_corner *c, uint32_t slot)
{
    (void)s, (void)c, (void)slot;
    return 65536;
}
#endif

GN_HOT GN_NOINLINE uint32_t gn_corner_share(gn_shading *s, gn_corner *c, uint32_t slot)
{
    const gn_light_state *light = s->surface.light[slot].state;
    uint32_t mask = 65536;
    if (!(s->surface.shadowed | s->surface.masked)) return 65536;
#if GN_MASKS
    mask = gn_corner_mask_uq16(&c->light[slot]);
#endif
    if (!s->surface.shadowed || !gn_shadow_is_realtime(light, c->g_uq16)) return gn_shadow_baked(light, mask);
    return gn_shadow_mixed(s->frame, light, mask, c->g_uq16, looked_up(s, c, slot));
}

/* ---- Colours ----------------------------------------------------------------------------------------------------- */

/* Light of Q24 irradiance times a colour, Q16, to Q20; 2^31 * 2^31 */
GN_HOT static void add(uint64_t sum_q20[3], const uint32_t colour_uq16[3], uint32_t irradiance_q24)
{
    GN_UNROLL
    for (int i = 0; i < 3; i++) sum_q20[i] += ((uint64_t)colour_uq16[i] * irradiance_q24 + (1U << 19)) >> 20;
}

#if GN_TEXTURES
/* A texture of the surface, whose smaller levels begin at depth2. */
GN_HOT static GN_NOINLINE void look_up(const gn_frame *frame, const gn_corner *c, const gn_texture *texture,
                                       uint64_t depth2_q32, uint32_t colour_uq16[3])
{
#if GN_MIPMAPS
    gn_texture level;
    if (gn_texture_has_levels(texture)) {
        int32_t z_q16 = GN_FLAT_Q16(frame) ? GN_FLAT_Q16(frame) : c->z_q16;
        gn_texture_use_level(&level, texture, gn_texture_level_at(texture, depth2_q32, z_q16));
        texture = &level;
    }
#endif
    (void)frame, (void)depth2_q32;
    GN_COUNT(textured, 1);
    gn_texture_colour(texture, c->uv_q20[0], c->uv_q20[1], colour_uq16);
}
#endif

/* Vertex colour and texture. [M3] */
GN_HOT static inline void modulate(const gn_frame *frame, const gn_surface *surface, const gn_corner *c,
                                   uint64_t sum[3])
{
#if GN_VERTEX_COLOURS
    for (int i = 0; GN_COLOURED(surface) && i < 3; i++)
        sum[i] = (sum[i] * (uint32_t)gn_max32(c->tint_q16[i], 0) + 0x8000U) >> 16;
#endif
#if GN_TEXTURES
    uint32_t colour[3];
    if (!surface->textured || !surface->object->texture) return;
    look_up(frame, c, surface->object->texture, GN_LEVEL_DEPTH2(surface), colour);
    for (int i = 0; i < 3; i++) sum[i] = (sum[i] * colour[i] + 0x8000U) >> 16;
#endif
    (void)frame, (void)surface, (void)c, (void)sum;
}

/* Light that the surface emits, of which texture and colours take nothing away. [M10] */
GN_HOT static void add_glow(const gn_frame *frame, const gn_surface *surface, const gn_corner *c, uint64_t sum[3])
{
    const uint32_t *emissive = surface->object->emissive_uq16;
    if (!GN_GLOWS(surface)) return;
#if GN_GLOW_TEXTURES
    uint32_t colour[3];
    if (surface->glow) {
        look_up(frame, c, surface->glow, GN_GLOW_DEPTH2(surface), colour);
        for (int i = 0; i < 3; i++) sum[i] += ((uint64_t)emissive[i] * colour[i] + 0x800U) >> 12; /* 2^24 * 2^16 */
        return;
    }
#endif
    for (int i = 0; i < 3; i++) sum[i] += emissive[i] << 4;
    (void)frame, (void)c;
}

/* What surfaces with colours of vertices or a texture do with the light. */
GN_HOT static GN_NOINLINE void tint(const gn_frame *frame, const gn_surface *surface, const gn_corner *c,
                                    uint64_t sum_q20[3])
{
    modulate(frame, surface, c, sum_q20);
    add_glow(frame, surface, c, sum_q20);
}

/* Highlights, which neither textures nor the vertices' colours dim. */
GN_HOT static inline void add_highlight(const gn_surface *surface, const gn_corner *c, uint32_t slot, uint32_t share,
                                        uint64_t sum_q20[3])
{
#if GN_SPECULAR
    const gn_light_state *light = surface->light[slot].state;
    uint32_t colour[3];
    GN_COUNT(highlights, 1);
    GN_UNROLL
    for (int i = 0; i < 3; i++) colour[i] = gn_mul_uq16(light->colour_uq16[i], surface->object->specular_uq16[i]);
    add(sum_q20, colour, gn_mul_uq16((uint32_t)c->light[slot].highlight_q24, share));
#else
    (void)surface, (void)c, (void)slot, (void)share, (void)sum_q20;
#endif
}

/* A shadow is looked up only where light arrives. [P10] [M9] */
GN_HOT void gn_corner_radiance(gn_shading *s, gn_corner *c, uint32_t radiance_q20[3])
{
    const gn_surface *surface = &s->surface;
    uint64_t sum[3], highlights[3] = {0, 0, 0}; /* 2^30 and 2^42 per light */
    for (int i = 0; i < 3; i++) sum[i] = (uint32_t)gn_max32(c->base_q20[i], 0);
    for (uint32_t slot = 0; slot < surface->n_lights; slot++) {
        const uint32_t e = (uint32_t)c->light[slot].irradiance_q24;
        if (!e) continue;
        const uint32_t share = gn_corner_share(s, c, slot);
        GN_COUNT(lights, 1);
        if (!share) continue;
        add(sum, surface->light[slot].radiance_uq16, share == 65536 ? e : gn_mul_uq16(e, share));
        if (GN_SPECULAR && surface->specular) add_highlight(surface, c, slot, share, highlights);
    }
    if (surface->textured | GN_COLOURED(surface)) tint(s->frame, surface, c, sum);
    for (int i = 0; GN_SPECULAR && i < 3; i++) sum[i] += highlights[i];
    for (int i = 0; i < 3; i++) radiance_q20[i] = sum[i] > UINT32_MAX ? UINT32_MAX : (uint32_t)sum[i];
}

/* ---- Raw views --------------------------------------------------------------------------------------------------- */

/* [A6] */

#if GN_RAW_VIEWS
/* Q1.30 to 10 bits, offset 512 */
GN_HOT static uint32_t pack_axis(int64_t v_q30)
{
    return (uint32_t)(512 + gn_clamp64(gn_shr64(v_q30 * 511, 30), -511, 511));
}

GN_HOT static uint32_t raw_normal(const gn_surface *surface, const gn_corner *c)
{
    int32_t unit[3];
#if GN_VERTEX_NORMALS
    const int32_t *n = c->normal_q30;
#else
    const int32_t *n = surface->normal_q30[0];
#endif
    const int64_t wide[3] = {n[0], n[1], n[2]};
    (void)surface, (void)c;
    if (!gn_normalise_q30(unit, wide)) return 512U << 20 | 512U << 10 | 512U;
    return pack_axis(unit[0]) << 20 | pack_axis(unit[1]) << 10 | pack_axis(unit[2]);
}

GN_HOT static uint32_t cascade_of(const gn_frame *frame, const gn_corner *c)
{
#if GN_SHADOWS
    gn_cascade_point at;
    gn_cascade_at(frame, c->x, c->y, c->z_q16, &at);
    return (uint32_t)at.cascade;
#else
    (void)frame, (void)c;
    return GN_CASCADE_NONE;
#endif
}

GN_HOT static uint32_t raw_value(gn_shading *s, gn_corner *c)
{
    uint32_t q20[3];
    switch (s->frame->picture.view) {
    case GN_VIEW_SHADOW: /* of one light whose colour and irradiance are 1 */
        gn_corner_radiance(s, c, q20);
        return q20[0] >> 4;
    case GN_VIEW_DEPTH:
        return (uint32_t)c->z_q16;
    case GN_VIEW_CASCADE:
        return cascade_of(s->frame, c);
    case GN_VIEW_NORMAL:
        return raw_normal(&s->surface, c);
    default:
        return (uint32_t)s->tri->object_idx << 16 | s->tri->triangle_idx;
    }
}
#endif

/* ---- Pixels ------------------------------------------------------------------------------------------------------ */

GN_HOT GN_NOINLINE void gn_corner_pixel(gn_shading *s, int32_t x, int32_t y)
{
    gn_corner *c = &s->lattice.corner;
    uint32_t q20[3];
    gn_corner_find(&s->lattice, s->frame, &s->surface, x, y, 1, c);
#if GN_RAW_VIEWS
    if (s->frame->picture.format == GN_FORMAT_RAW32) {
        s->scratch->pixel.raw[(y - s->rect.y0) * s->rows.width + x - s->rect.x0] = raw_value(s, c);
        return;
    }
#endif
    GN_COUNT(shaded, 1);
    gn_corner_radiance(s, c, q20);
    gn_pixel_store(s->frame, &s->rows, x, y, gn_exact_pack(s, q20));
}
