/* Shadow of one light at a sample. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "shade/gn_surface.h"
#include "shadow/gn_filter.h"

#define GN_ONE_UQ16 65536U

/* lerp(1, x, k) */
GN_HOT static uint32_t faded(uint32_t x_uq16, uint32_t k_uq16)
{
    return x_uq16 >= GN_ONE_UQ16 ? GN_ONE_UQ16 : GN_ONE_UQ16 - gn_mul_uq16(k_uq16, GN_ONE_UQ16 - x_uq16);
}

#if GN_SHADOWS
GN_HOT uint32_t gn_shadow_distance_fade(const gn_frame *frame, int32_t z_q16)
{
    if (frame->scene->shadow.distance_mode != GN_DISTANCE_DEPTH || (uint32_t)z_q16 <= frame->fade_start_q16)
        return GN_ONE_UQ16;
    int64_t left_q16 = (int64_t)frame->scene->shadow.max_distance_q16 - z_q16;
    if (left_q16 <= 0) return 0;
    return (uint32_t)gn_clamp64(gn_bf_apply(left_q16, frame->fade_scale, 32), 0, GN_ONE_UQ16);
}

/* Shadow strength after fading with distance; 65536: full. [D5] [D6] [D11] */
GN_HOT uint32_t gn_shadow_distance(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample)
{
    if (!surface->shadowed || !sample->in_reach) return 0;
    const uint32_t g = gn_shadow_distance_fade(frame, sample->value[GN_VALUE_Z]);
    if (!frame->has_cascades) return g;
    if (sample->cascade == GN_CASCADE_NONE) return 0;
    return sample->cascade == GN_LAST_CASCADE(frame) ? gn_mul_uq16(g, (uint32_t)sample->value[GN_VALUE_FADE]) : g;
}

/* ---- Lookups ----------------------------------------------------------------------------------------------------- */

/* Normal of the face, where the receiver's plane is built. */
GN_HOT static inline const int32_t *face_of(const gn_surface *surface)
{
#if GN_PLANES
    return surface->face_q30;
#else
    (void)surface;
    return NULL;
#endif
}

/* The slope of depth over one texel, a quotient of two components of the face's normal, clamped to 16 / T of the depth
 * range. [B5] */
GN_HOT static int32_t limit_slope(const gn_light_view *view, int64_t slope_q28)
{
    int64_t most = (int64_t)1 << GN_SLOPE_LIMIT_LOG2(view);
    return (int32_t)gn_clamp64(slope_q28, -most, most);
}

GN_HOT static void ortho_slopes(const gn_light_view *view, const int32_t face_q30[3], int32_t slope_q28[2])
{
    int64_t w = gn_dot_q30(face_q30, view->axis_q30[2]);
    gn_bfloat per_w = gn_bf_recip(gn_bf_from_u64(gn_abs64(w) | 1U));
    for (int i = 0; i < 2; i++) {
        int64_t u = gn_dot_q30(face_q30, view->axis_q30[i]);
        slope_q28[i] = limit_slope(view, gn_bf_apply(w < 0 ? u : -u, per_w, 28 - view->tile_log2 - view->depth_log2));
    }
}

#if GN_PUNCTUAL_LIGHTS
/* With m . P = h on the face: n / z = n (m_u x/z + m_v y/z + m_w) / h is linear over the tile. */
GN_HOT static void persp_slopes(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                                int32_t slope_q28[2])
{
    const gn_persp_fit *fit = &view->fit.persp;
    int64_t h = gn_dot_q30(face_q30, from_q16);
    gn_bfloat per_h = gn_bf_mul(gn_bf_recip(gn_bf_from_u64(gn_abs64(h) | 1U)), fit->texel_per_z);
    for (int i = 0; i < 2; i++) {
        int64_t m = gn_dot_q30(face_q30, view->axis_q30[i]) * fit->near_q16; /* Q46, 2^59 */
        slope_q28[i] = limit_slope(view, gn_bf_apply(h < 0 ? m : -m, per_h, -2));
    }
}
#else
GN_HOT static void persp_slopes(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                                int32_t slope_q28[2])
{
    (void)view, (void)face_q30, (void)from_q16, (void)slope_q28;
}
#endif

GN_HOT void gn_shadow_plane_slopes(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                                   int32_t slope_q28[2])
{
    if (GN_PUNCTUAL_LIGHTS && view->perspective) persp_slopes(view, face_q30, from_q16, slope_q28);
    else ortho_slopes(view, face_q30, slope_q28);
}

GN_HOT void gn_shadow_slopes(const gn_frame *frame, const gn_surface *surface, const gn_light_view *view,
                             const int32_t from_q16[3], int32_t slope_q28[2])
{
    slope_q28[0] = slope_q28[1] = 0;
    if (GN_PLANES && gn_shadow_has_plane(frame, view))
        gn_shadow_plane_slopes(view, face_of(surface), from_q16, slope_q28);
}

GN_HOT static uint32_t ortho_attenuation(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                         const gn_light_view *view, const int32_t coord[3])
{
    GN_COUNT(lookups, 1);
    gn_receiver r = {coord[0], coord[1], 0, {0, 0}, sample->x, sample->y};
    /* texels, Q16, to a fraction of T * 2^J texels */
    int32_t up = 16 - view->tile_log2 - view->depth_log2;
    if (coord[2] > 0) {
        uint64_t share = up >= 0 ? (uint64_t)(uint32_t)coord[2] << up : (uint32_t)coord[2] >> -up;
        r.depth_q32 = share > UINT32_MAX ? UINT32_MAX : (uint32_t)share;
    }
    gn_shadow_slopes(frame, surface, view, NULL, r.slope_q28);
    GN_NOTE_LOOKUP(surface->squares, frame, view, &r);
    return gn_filter_attenuation(frame, view, &r);
}

/* Attenuation in the sample's cascade, blended with the next one [D7]. */
GN_HOT static uint32_t cascaded_attenuation(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                            const gn_light_view *first, const int32_t *coord)
{
    const gn_light_view *view = first + sample->cascade;
    uint32_t factor = (uint32_t)sample->value[GN_VALUE_FADE];
    gn_blend blend =
        GN_BLENDED_CASCADES && sample->cascade != GN_LAST_CASCADE(frame) ? frame->scene->shadow.blend : GN_BLEND_HARD;
    if (blend == GN_BLEND_HARD || factor >= GN_ONE_UQ16) return ortho_attenuation(frame, surface, sample, view, coord);
    const gn_light_view *next = first + frame->cascade[sample->cascade].next;
    if (blend == GN_BLEND_DITHER && factor >= gn_noise_uq16(sample->x, sample->y))
        return ortho_attenuation(frame, surface, sample, view, coord);
    uint32_t there = ortho_attenuation(frame, surface, sample, next, coord + 3);
    if (blend == GN_BLEND_DITHER) return there;
    uint32_t here = ortho_attenuation(frame, surface, sample, view, coord);
    return gn_mul_uq16(here, factor) + gn_mul_uq16(there, GN_ONE_UQ16 - factor);
}

#if GN_PUNCTUAL_LIGHTS
GN_HOT static GN_NOINLINE uint32_t persp_attenuation(const gn_frame *frame, const gn_surface *surface,
                                                     const gn_sample *sample, uint32_t slot)
{
    const gn_arrival *at = &sample->arrival[slot];
    GN_COUNT(lookups_persp, 1);
    if (at->face == GN_FACE_NONE) return GN_ONE_UQ16;
    const gn_light_view *view = &frame->view[surface->light[slot].state->view_idx + at->face];
    gn_receiver r = {at->u_q16, at->v_q16, at->depth_q32, {0, 0}, sample->x, sample->y};
    const int32_t *from = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * slot + GN_LIGHT_POINT_AT];
    gn_shadow_slopes(frame, surface, view, from, r.slope_q28);
    GN_NOTE_LOOKUP(surface->squares, frame, view, &r);
    return gn_filter_attenuation(frame, view, &r);
}
#else
GN_HOT static uint32_t persp_attenuation(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                         uint32_t slot)
{
    (void)frame, (void)surface, (void)sample, (void)slot;
    return GN_ONE_UQ16;
}
#endif

GN_HOT static uint32_t attenuation_of(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                      uint32_t slot)
{
    const gn_light_state *light = surface->light[slot].state;
    const gn_light_view *first = &frame->view[light->view_idx];
    if (GN_PUNCTUAL_LIGHTS && first->perspective) return persp_attenuation(frame, surface, sample, slot);
    const int32_t *value = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * slot];
    if (first->border_lit) return ortho_attenuation(frame, surface, sample, first, value + 1);
    return cascaded_attenuation(frame, surface, sample, first, value + 1);
}
#else
GN_HOT uint32_t gn_shadow_distance(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample)
{
    (void)frame, (void)surface, (void)sample;
    return 0;
}

GN_HOT static uint32_t attenuation_of(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                      uint32_t slot)
{
    (void)frame, (void)surface, (void)sample, (void)slot;
    return GN_ONE_UQ16;
}
#endif

/* ---- Mixing ------------------------------------------------------------------------------------------------------ */

/* The mask of a light's channel, 65536: lit, or no mask. [M5] */
GN_HOT uint32_t gn_shadow_mask(const gn_surface *surface, const gn_sample *sample, int32_t channel)
{
    if (!GN_MASKS || !surface->masked || channel < 0) return GN_ONE_UQ16;
    const int32_t *value = &sample->value[GN_VALUE_MASK];
    if (surface->object->mask_image)
        return gn_texture_mask(surface->object->mask_image, value[0], value[1], (uint32_t)channel);
    return (uint32_t)gn_max32(0, gn_min32(value[channel], 65536));
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

GN_HOT uint32_t gn_shadow_factor(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                                 uint32_t slot, uint32_t g_uq16)
{
    if (!(surface->shadowed | surface->masked)) return GN_ONE_UQ16;
    const gn_light_state *light = surface->light[slot].state;
    if (!light->strength_uq16) return GN_ONE_UQ16;
    uint32_t mask = gn_shadow_mask(surface, sample, light->mask_channel);
    if (!gn_shadow_is_realtime(light, g_uq16)) return gn_shadow_baked(light, mask);
    uint32_t realtime = attenuation_of(frame, surface, sample, slot);
    return gn_shadow_mixed(frame, light, mask, g_uq16, realtime);
}
