/* Corners of cells. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_arrival.h"
#include "shade/gn_corner.h"
#include "shade/gn_light.h"
#include "shade/gn_shadow.h"
#include "shadow/gn_persp.h"

#if GN_INTERPOLATES

/* ---- Attributes -------------------------------------------------------------------------------------------------- */

GN_HOT static void base_colour(const gn_surface *s, const gn_sample *sample, gn_corner *c)
{
    for (int i = 0; i < 3; i++) {
        uint32_t q20 = s->base_q20[i]; /* < 2^28 */
        if (GN_BAKED_LIGHT && s->baked) {
            uint64_t baked =
                (uint64_t)s->object->albedo_uq16[i] * (uint32_t)gn_max32(sample->value[GN_VALUE_BAKED + i], 0) >> 12;
            q20 = baked > 1U << 23 ? 1U << 23 : q20 + (uint32_t)baked;
        }
        c->base_q24[i] = (int32_t)(q20 > 1U << 23 ? 1U << 23 : q20) << 4;
    }
}

GN_HOT static void attributes_at(const gn_surface *s, const gn_sample *sample, gn_corner *c)
{
    base_colour(s, sample, c);
    for (int i = 0; i < 3; i++) {
#if GN_VERTEX_COLOURS
        if (GN_COLOURED(s)) c->tint_q16[i] = sample->value[GN_VALUE_RGB + i];
#endif
#if GN_VERTEX_NORMALS
        c->normal_q30[i] = GN_SMOOTH(s) ? sample->interpolated_q30[i] : s->normal_q30[0][i];
#endif
    }
    for (int i = 0; i < 2; i++) {
#if GN_TEXTURES
        c->uv_q20[i] = sample->value[GN_VALUE_UV + i];
#endif
#if GN_MASKS
        if (s->masked) c->mask_uv_uq16[i] = sample->value[GN_VALUE_MASK + i];
#endif
    }
    (void)sample, (void)s;
}

/* ---- Lights ------------------------------------------------------------------------------------------------------ */

#if GN_SHADOWS
/* The view that the point itself is looked up in. */
GN_HOT static uint8_t own_view(const gn_frame *frame, const gn_surface *s, const gn_light_state *light,
                               const gn_corner *c, const gn_corner_light *at)
{
    if (!s->shadowed || light->view_idx < 0 || !light->strength_uq16) return GN_VIEW_NONE;
    if (light->kind == GN_LIGHT_SPOT ||
        (light->kind == GN_LIGHT_DIRECTIONAL && frame->view[light->view_idx].border_lit))
        return 0;
#if GN_PUNCTUAL_LIGHTS
    if (light->kind == GN_LIGHT_POINT) return (uint8_t)gn_persp_face(at->from_q16);
#endif
    (void)at;
    return c->cascade == GN_CASCADE_NONE ? GN_VIEW_NONE : c->cascade;
}
#endif

GN_HOT static void light_at(const gn_frame *frame, const gn_surface *s, uint32_t slot, const gn_sample *sample,
                            gn_corner *c)
{
    const gn_light_state *light = s->light[slot].state;
    const int32_t *value = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * slot];
    gn_corner_light *at = &c->light[slot];
    int arrives = GN_ARRIVES_NOT;
    uint32_t irradiance = 0;
#if GN_PUNCTUAL_LIGHTS
    for (int i = 0; light->kind != GN_LIGHT_DIRECTIONAL && i < 3; i++) {
        at->from_q16[i] = value[GN_LIGHT_POINT_AT + i];
        at->offset_q16[i] = value[GN_LIGHT_OFFSET + i];
    }
    if (light->kind != GN_LIGHT_DIRECTIONAL) irradiance = gn_arrival_irradiance_q24(frame, light, value, &arrives);
#endif
    if (light->kind == GN_LIGHT_DIRECTIONAL && value[GN_LIGHT_FACING] > 0) {
        irradiance = (uint32_t)value[GN_LIGHT_FACING];
        arrives = GN_ARRIVES_FULLY;
    }
    if (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32) irradiance = arrives ? 1U << 24 : 0;
    at->irradiance_q24 = (int32_t)(irradiance > 1U << 27 ? 1U << 27 : irradiance);
    at->arrives = (uint8_t)arrives;
#if GN_MASKS
    at->mask_uq16 = gn_shadow_mask(s, sample, light->mask_channel);
#endif
#if GN_SHADOWS
    at->placed = GN_VIEW_NONE;
    at->view = own_view(frame, s, light, c, at);
#endif
#if GN_SPECULAR
    if (s->specular) at->highlight_q24 = (int32_t)gn_light_highlight(frame, s, sample, slot, at->lobe_q30);
#endif
}

GN_HOT void gn_corner_find(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y, gn_sample *sample,
                           gn_corner *c)
{
    c->state = GN_CORNER_UNSEEN;
    GN_COUNT(corners, 1);
    if (!gn_sample_on_plane(frame, s, x, y, sample)) return;
    c->state = GN_CORNER_KNOWN;
    c->x = (int16_t)x;
    c->y = (int16_t)y;
    c->z_q16 = sample->value[GN_VALUE_Z];
    c->cascade = (uint8_t)sample->cascade;
    c->fade_uq16 = (uint32_t)sample->value[GN_VALUE_FADE];
    c->g_uq16 = gn_shadow_distance(frame, s, sample);
    attributes_at(s, sample, c);
    for (uint32_t i = 0; i < s->n_lights; i++) light_at(frame, s, i, sample, c);
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

#if GN_SHADOWS
GN_HOT static void place_directional(const gn_frame *frame, const gn_surface *s, gn_corner *c, uint32_t slot,
                                     const gn_light_view *view)
{
    const int32_t *n = s->normal_q30[0];
    gn_corner_light *at = &c->light[slot];
    int32_t coord[3], up = 14 - view->tile_log2 - view->depth_log2; /* texels, Q16, to a share of the range, Q30 */
#if GN_VERTEX_NORMALS
    n = c->normal_q30;
#endif
    gn_sample_in_view(frame, s, slot, view, c->x, c->y, c->z_q16, n, coord);
    at->u_q16 = coord[0];
    at->v_q16 = coord[1];
    if (up < 0) at->depth_q30 = coord[2] >> gn_min32(-up, 31);
    else at->depth_q30 = gn_max32(-(1 << 29) >> up, gn_min32(coord[2], ((1 << 30) - 1) >> up)) * (1 << up);
    at->seen = 1;
}

#if GN_PUNCTUAL_LIGHTS
GN_HOT static void place_punctual(const gn_frame *frame, const gn_surface *s, const gn_corner *c, gn_corner_light *at,
                                  const gn_light_view *view)
{
    gn_arrival place;
    at->seen = (uint8_t)gn_arrival_place(frame, s, view, c->z_q16, at->from_q16, at->offset_q16, &place);
    if (!at->seen) return;
    at->u_q16 = place.u_q16;
    at->v_q16 = place.v_q16;
    at->depth_q30 = (int32_t)(place.depth_q32 >> 2);
}
#endif

GN_HOT int gn_corner_place(const gn_frame *frame, const gn_surface *s, gn_corner *c, uint32_t slot, uint32_t view_idx)
{
    gn_corner_light *at = &c->light[slot];
    if (at->placed == view_idx) return at->seen;
    const gn_light_state *light = s->light[slot].state;
    const gn_light_view *view = &frame->view[light->view_idx + (int32_t)view_idx];
    at->placed = (uint8_t)view_idx;
    GN_COUNT(places, 1);
#if GN_PUNCTUAL_LIGHTS
    if (light->kind != GN_LIGHT_DIRECTIONAL) {
        place_punctual(frame, s, c, at, view);
        return at->seen;
    }
#endif
    place_directional(frame, s, c, slot, view);
    return 1;
}
#endif

#endif
