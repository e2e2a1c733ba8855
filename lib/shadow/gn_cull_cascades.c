/* Casters whose shadows lie wholly in a smaller cascade. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_bias.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_atlas.h"

GN_COLD void gn_cull_begin(gn_frame *frame)
{
    int32_t(*box)[3] = frame->receivers_q16;
    for (int k = 0; k < 3; k++) {
        box[0][k] = INT32_MAX;
        box[1][k] = INT32_MIN;
    }
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        const gn_object_state *object = &frame->object[i];
        if (!(frame->flags[i] & GN_OBJECT_RECEIVES)) continue;
        for (int k = 0; k < 3; k++) {
            box[0][k] = gn_min32(box[0][k], gn_sat32((int64_t)object->centre_q16[k] - object->half_q16[k]));
            box[1][k] = gn_max32(box[1][k], gn_sat32((int64_t)object->centre_q16[k] + object->half_q16[k]));
        }
    }
}

/* |a - b| + 1, Q16; at most 2^32 */
static uint64_t distance_q16(const int64_t a[3], const int64_t b[3])
{
    uint64_t sum = 0;
    for (int k = 0; k < 3; k++) {
        int64_t d = gn_clamp64(a[k] - b[k], -((int64_t)1 << 31), (int64_t)1 << 31);
        sum += (uint64_t)(d * d); /* 3 * 2^62 */
    }
    return (uint64_t)gn_isqrt64(sum) + 1;
}

/* How far the object's shadow, `radius` wide, travels along w until it is past every receiver, Q16. -1: no bound. */
static int64_t shadow_length_q16(const gn_frame *frame, const gn_light_view *view, const int64_t centre[3],
                                 int64_t radius)
{
    int64_t length = -1;
    for (int k = 0; k < 3; k++) {
        int32_t w = view->axis_q30[2][k];
        if (gn_abs32(w) < 1U << 16) continue;
        int64_t way =
            w > 0 ? frame->receivers_q16[1][k] + radius - centre[k] : centre[k] - frame->receivers_q16[0][k] + radius;
        if (way < 0) way = 0;
        gn_bfloat per_w = gn_bf_recip(gn_bf_from_u64(gn_abs32(w)));
        int64_t steps = gn_bf_apply(way, per_w, 30) + 2;
        if (length < 0 || steps < length) length = steps;
    }
    return length;
}

/* Whether a caster may be skipped in a larger cascade. [D8] */
GN_COLD int gn_cull_shown_nearer(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx)
{
    const gn_object_state *object = &frame->object[object_idx];
    const gn_light *light = &frame->scene->lights[view->light_idx];
    int64_t share_uq16 = 52429 - (int64_t)frame->scene->shadow.cascade_fade_uq16; /* 0.8 - c */
    if (share_uq16 <= 0 || light->receiver_plane || GN_VIEW_EDGE(frame, view))
        return 0;                                       /* a tap may compare with a depth far from the receiver's */
    for (uint32_t i = 0; i < GN_N_CASCADES(frame); i++) /* a kept tile may lack the object */
        if (frame->scene->shadow.refresh[i] > 1) return 0;
    const int64_t zero[3] = {0, 0, 0};
    int64_t c[3], end[3], half[3];
    for (int k = 0; k < 3; k++) {
        c[k] = object->centre_q16[k];
        half[k] = object->half_q16[k];
    }
    /* the sphere around the object, widened by the filter radius and bias of a lookup in this view */
    int64_t reach_texels_q16 = (view->filter_idx + 1) * (int64_t)(65536 + gn_bias_reach_q16(frame, view, light)) +
                               131072 + light->bias_caster_q16;
    int64_t radius = (int64_t)distance_q16(half, zero) +
                     gn_bf_apply(reach_texels_q16, gn_bf_recip(view->fit.ortho.inv_texel), 0) + 2;
    int64_t length = shadow_length_q16(frame, view, c, radius);
    if (length < 0 || length > (int64_t)1 << 31) return 0;
    for (int k = 0; k < 3; k++) end[k] = c[k] + gn_shr64(length * view->axis_q30[2][k], 30);
    for (uint32_t i = 0; i < view->cascade_idx; i++) {
        const gn_cascade_state *cascade = &frame->cascade[i];
        if (cascade->radius2_q32 == 0) continue;
        int64_t centre[3], r = (int64_t)gn_isqrt64(cascade->radius2_q32) * share_uq16 >> 16;
        for (int k = 0; k < 3; k++)
            centre[k] = frame->cam.eye_q16[k] + gn_shr64((int64_t)cascade->centre_q16 * frame->cam.axis_q30[2][k], 30);
        /* both ends of the shadow are inside, so all of it is */
        if ((int64_t)distance_q16(c, centre) + radius <= r && (int64_t)distance_q16(end, centre) + radius <= r)
            return 1;
    }
    return 0;
}
