/* Receiver bias. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_bias.h"
#include "light/gn_lights.h"
#include "scene/gn_scene.h"

GN_HOT int32_t gn_bias_reach_q16(const gn_frame *frame, const gn_light_view *view, const gn_light *light)
{
    if (GN_AUTO_BIAS && gn_scene_auto_bias(light))
        return gn_bias_auto_reach_q16(frame, view, gn_scene_auto_bias(light));
    int32_t reach = gn_mul_shr(light->bias_normal_q16, GN_SQRT2_Q16, 16); /* <= 8 * 1.42 */
    if (GN_RECEIVER_BIAS) reach += light->bias_receiver_q16[2] + light->bias_receiver_q16[3];
    return reach;
}

/* The receiver's offset in texels, Q16: along * N + towards * L. */
typedef struct {
    int32_t along_q16, towards_q16;
} bias_terms;

/* n_dot_l_q30: N . L of the interpolated normal, not normalised; only the four-term bias needs it. [B2] [B3] */
GN_HOT static bias_terms bias_at(const gn_light_view *view, const gn_light *light, int32_t n_dot_l_q30)
{
    bias_terms bias = {view->offset_q16, 0};
    const int32_t *b = light->bias_receiver_q16;
    if (!GN_RECEIVER_BIAS || !(b[0] | b[1] | b[3])) return bias;
    int32_t reach = view->filter_idx + 1;
    int64_t cosine = gn_clamp64(n_dot_l_q30, 0, 1 << 30);
    int64_t sine = (int64_t)gn_isqrt64((uint64_t)(((int64_t)1 << 60) - cosine * cosine)); /* Q30 */
    int64_t tangent_q16 = 50 << 16;
    if (sine < 50 * cosine) tangent_q16 = gn_bf_apply(sine, gn_bf_recip(gn_bf_from_u64((uint64_t)cosine)), 16);
    bias.along_q16 += reach * (int32_t)gn_shr64(b[3] * sine, 30);
    bias.towards_q16 = reach * (b[0] + (int32_t)gn_shr64(b[1] * tangent_q16, 16)); /* 9 * 8 * 51 * 2^16 < 2^28 */
    return bias;
}

GN_HOT void gn_bias_directional(const gn_frame *frame, const gn_light_view *view, const int32_t n_q30[3],
                                int32_t out_q16[3])
{
    const gn_light_state *state = &frame->light[view->light_idx];
    int32_t n_dot_l = GN_RECEIVER_BIAS ? (int32_t)gn_dot_q30(n_q30, state->to_light_q30) : 0;
    bias_terms bias = bias_at(view, &frame->scene->lights[view->light_idx], n_dot_l);
    for (int i = 0; i < 3; i++) {
        int64_t along_q30 = gn_dot_q30(n_q30, view->axis_q30[i]); /* |n| <= 1 */
        out_q16[i] = (int32_t)gn_shr64(along_q30 * bias.along_q16, 30);
    }
    out_q16[2] -= bias.towards_q16; /* w is the direction of travel */
}

#if GN_PUNCTUAL_LIGHTS
GN_HOT void gn_bias_punctual(const gn_frame *frame, const gn_light_state *light, const int32_t n_q30[3],
                             const int32_t from_q16[3], int32_t out_q16[3])
{
    const gn_light_view *view = &frame->view[light->view_idx];
    const gn_light *scene_light = &frame->scene->lights[view->light_idx];
    int64_t z = 0; /* the light-plane distance */
    if (light->kind == GN_LIGHT_SPOT) z = -gn_dot_q30(from_q16, light->to_light_q30);
    else {
        int face = 0;
        for (int i = 0; i < 3; i++) {
            if ((int64_t)gn_abs32(from_q16[i]) < z) continue;
            z = (int64_t)gn_abs32(from_q16[i]);
            face = 2 * i + (from_q16[i] < 0);
        }
        if (GN_TIGHT_FIT) view += face; /* their texels differ */
    }
    z = gn_clamp64(z, 0, INT32_MAX);
    int32_t to_light[3] = {0, 0, 0}, n_dot_l = 0;
    if (GN_RECEIVER_BIAS) {
        int64_t towards[3] = {-(int64_t)from_q16[0], -(int64_t)from_q16[1], -(int64_t)from_q16[2]};
        gn_normalise_q30(to_light, towards);
        n_dot_l = (int32_t)gn_clamp64(gn_dot_q30(n_q30, to_light), -(1 << 30), (1 << 30));
    }
    bias_terms bias = bias_at(view, scene_light, n_dot_l);
    /* texels to units: 2^27 * 2^31 */
    int64_t along = gn_bf_apply(bias.along_q16 * z, view->fit.persp.texel_per_z, -16);
    int64_t towards = gn_bf_apply(bias.towards_q16 * z, view->fit.persp.texel_per_z, -16);
    for (int i = 0; i < 3; i++)
        out_q16[i] = gn_sat32(gn_shr64(gn_clamp64(along, 0, INT32_MAX) * n_q30[i], 30) +
                              gn_shr64(gn_clamp64(towards, 0, INT32_MAX) * to_light[i], 30));
}
#endif
