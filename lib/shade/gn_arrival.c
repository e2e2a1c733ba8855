/* What arrives from spot and point lights. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_bias.h"
#include "light/gn_punctual.h"
#include "shade/gn_arrival.h"
#include "shadow/gn_persp.h"

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
