/* Receiver bias. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
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

/* ---- Automatic receiver bias [B6] -------------------------------------------------------------------------------- */

#if GN_AUTO_BIAS
/* Depth form, both slopes together: planes that the light meets nearly at right angles have the bias of this slope, so
 * that a steeper one beside them does not darken their edge. */
#define GN_LEAST_SLOPE_Q12 2048

GN_HOT int32_t gn_bias_auto_reach_q16(const gn_frame *frame, const gn_light_view *view, gn_auto_bias form)
{
    if (form == GN_AUTO_BIAS_DEPTH) return 0;
    return gn_mul_shr(65536 + gn_bias_auto_delta_q16(frame), GN_SQRT2_Q16, 16) +
           (int32_t)((view->tile_texels * (int64_t)65536) >> GN_VIEW_BITS(view)) + 1;
}

/* n over w, whose reciprocal is 2^63 / (w 2^clz), to Q12, with the sign of n: within +-2^30. */
GN_HOT static int32_t slope_q12(int32_t n_q30, uint32_t recip, int32_t clz)
{
    const uint32_t q = gn_umul_high(gn_abs32(n_q30), recip); /* n / w * 2^(31 - clz) */
    const int32_t down = 19 - clz, up = gn_max32(-down, 0);
    const uint32_t slope = up && q >> (30 - up) ? 1U << 30 : q << up >> gn_max32(down, 0);
    return n_q30 < 0 ? -(int32_t)slope : (int32_t)slope;
}

GN_HOT void gn_bias_slopes(int32_t n[3])
{
    const uint32_t w = (uint32_t)gn_max32((int32_t)gn_abs32(n[2]), 1);
    const int32_t clz = gn_clz32(w), turn = n[2] < 0 ? 1 : -1;
    const uint32_t recip = gn_recip_norm(w << clz, 1);
    for (int i = 0; i < 2; i++) n[i] = turn * slope_q12(n[i], recip, clz);
}

GN_HOT void gn_bias_auto_face(const gn_light_view *view, gn_auto_bias form, const int32_t face_q30[3], int32_t out[3])
{
    GN_UNROLL
    for (int i = 0; i < 3; i++) out[i] = gn_sat32(gn_dot_q30(face_q30, view->axis_q30[i]));
    if (form != GN_AUTO_BIAS_NORMAL) gn_bias_slopes(out);
}

GN_HOT void gn_bias_auto_ortho(const gn_light_view *view, gn_auto_bias form, const int32_t face[3], int32_t out_q16[3])
{
    int64_t reach_q16 = view->offset_q16, u = gn_abs32(face[0]), v = gn_abs32(face[1]); /* < 2^21 */
    int32_t range_log2 = view->tile_log2 + view->depth_log2;
    out_q16[0] = out_q16[1] = 0;
    if (form == GN_AUTO_BIAS_NORMAL) {
        out_q16[2] = -INT32_MAX; /* too steep for the map */
        if ((u > v ? u : v) >> (range_log2 + 1) > (int64_t)gn_abs32(face[2])) return;
        int64_t lift_q16 =
            ((reach_q16 * (u + v) + view->auto_step * (int64_t)gn_abs32(face[2])) >> 30) + 1; /* 2^53 + 2^61 */
        for (int i = 0; i < 3; i++) out_q16[i] = gn_sat32(gn_shr64(lift_q16 * face[i], 30));
        return;
    }
    const uint32_t most_q12 = 1U << gn_min32(13 + range_log2, 30); /* twice the range: half of that lights all */
    uint32_t slopes_q12 = 2;                                       /* the reciprocal is off by 2^-17 */
    for (int i = 0; i < 2; i++) slopes_q12 += gn_abs32(face[i]) < most_q12 ? gn_abs32(face[i]) : most_q12;
    slopes_q12 += slopes_q12 >> 16;
    if (slopes_q12 < GN_LEAST_SLOPE_Q12) slopes_q12 = GN_LEAST_SLOPE_Q12;
    out_q16[2] = gn_sat32(-((reach_q16 * slopes_q12 >> 12) + view->auto_step + 1)); /* 2^21 * 2^32 */
}

#if GN_PUNCTUAL_LIGHTS
GN_HOT int64_t gn_bias_auto_place_q16(const gn_light_view *view, int32_t depth_q16)
{
    return ((int64_t)depth_q16 * view->auto_place >> 40) + GN_AUTO_UNITS + 1;
}

/* Normal: the offset from the plane that the filter radius and the rounding of depths require, as a fraction of the
 * light-plane distance, Q30: A / (1 - A max(0, m_w)), A = radius * tau * (|m_u| + |m_v|) + D_s h / n. Returns -1 where
 * it would be above 2, or the divisor below 1/2. */
GN_HOT static int64_t lift_share_q30(const gn_light_view *view, const gn_auto_plane *plane, uint32_t across_q30,
                                     int32_t m_w_q30, int64_t h_q16)
{
    const int64_t two = (int64_t)2 << 30;
    int64_t share = gn_bf_apply((int64_t)((uint64_t)(uint32_t)plane->reach_q16 * across_q30 >> 16),
                                view->fit.persp.texel_per_z, 0) +
                    2;                                                                 /* 2^21 * 2^31 */
    share += gn_bf_apply((h_q16 + 2) * plane->step_q32, view->fit.persp.per_near, -2); /* 2^32 * 2^24; h is rounded */
    if (share > two) return -1;
    if (m_w_q30 <= 0) return share;
    int64_t left = ((int64_t)1 << 30) - (share * m_w_q30 >> 30); /* seen from behind the light's plane */
    if (left < (int64_t)1 << 29) return -1;
    share = gn_bf_apply(share, gn_bf_recip(gn_bf_from_u64((uint64_t)left)), 30) + 1;
    return share > two ? -1 : share;
}

/* Whether depth changes by more than twice the range over a texel, which casters do not: n tau |m_u| > 2 h. */
GN_HOT static int too_steep(const gn_light_view *view, uint32_t m_q30, int64_t h_q16)
{
    return gn_bf_apply((int64_t)m_q30 * view->fit.persp.near_q16, view->fit.persp.texel_per_z, -31) >
           h_q16; /* 2^31 * 2^29 */
}

/* Depth: radius * (|ds/dU| + |ds/dV|), Q32, with |ds/dU| = n tau |m_u| / h. */
GN_HOT static int64_t slope_share_q32(const gn_light_view *view, int32_t reach_q16, uint32_t across_q30, int64_t h_q16)
{
    const gn_persp_fit *fit = &view->fit.persp;
    if (across_q30 < GN_LEAST_SLOPE_Q12 << 18) across_q30 = GN_LEAST_SLOPE_Q12 << 18;
    gn_bfloat per_h = gn_bf_mul(gn_bf_recip(gn_bf_from_u64((uint64_t)h_q16 | 1U)), fit->texel_per_z);
    int64_t reach_q26 = (int64_t)((uint64_t)(uint32_t)reach_q16 * across_q30 >> 20); /* 2^21 * 2^31 * 2^-20 */
    return gn_clamp64(gn_bf_apply(reach_q26 * fit->near_q16, per_h, 6) + 1, 0, (int64_t)1 << 33); /* 2^32 * 2^29 */
}

GN_HOT void gn_bias_auto_plane(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                               gn_auto_plane *plane)
{
    int64_t h_q16 = (int64_t)gn_abs64(gn_dot_q30(face_q30, from_q16)); /* m . P = -h, behind the face +h */
    uint32_t u_q30 = gn_abs32((int32_t)gn_dot_q30(face_q30, view->axis_q30[0]));
    uint32_t v_q30 = gn_abs32((int32_t)gn_dot_q30(face_q30, view->axis_q30[1])), across_q30 = u_q30 + v_q30;
    int32_t m_w_q30 = (int32_t)gn_dot_q30(face_q30, view->axis_q30[2]);
    plane->less_q32 = 0;
    plane->share_q30 =
        plane->form == GN_AUTO_BIAS_NORMAL ? lift_share_q30(view, plane, across_q30, m_w_q30, h_q16) : -1;
    if (plane->share_q30 >= 0) {
        if (too_steep(view, u_q30 > v_q30 ? u_q30 : v_q30, h_q16)) plane->less_q32 = (int64_t)1 << 33;
        return;
    }
    plane->form = GN_AUTO_BIAS_DEPTH;
    plane->less_q32 = plane->step_q32 + slope_share_q32(view, plane->reach_q16, across_q30, h_q16);
}

GN_HOT int64_t gn_bias_auto_persp(const gn_light_view *view, gn_auto_bias *form, const int32_t face_q30[3],
                                  int32_t depth_q16, const int32_t from_q16[3], int32_t moved_q16[3])
{
    gn_auto_plane plane = {*form, view->offset_q16, view->auto_step, 0, 0};
    gn_bias_auto_plane(view, face_q30, from_q16, &plane);
    int64_t lift_q16 = gn_bias_auto_place_q16(view, depth_q16);
    *form = plane.form;
    if (plane.form == GN_AUTO_BIAS_NORMAL) {
        int64_t z_q16 = gn_clamp64(gn_dot_q30(from_q16, view->axis_q30[2]), 0, INT32_MAX);
        lift_q16 += (z_q16 * plane.share_q30 >> 30) + 1; /* 2^31 * 2^31 */
    }
    for (int i = 0; i < 3; i++) /* 2^33 * 2^30 would not fit, but a lift of 2^31 exceeds any scene */
        moved_q16[i] = gn_sat32(from_q16[i] + gn_shr64(gn_clamp64(lift_q16, 0, INT32_MAX) * face_q30[i], 30));
    return plane.less_q32;
}
#endif
#endif

/* ---- Automatic receiver bias, once per view ---------------------------------------------------------------------- */

/* [B6] */

#if GN_AUTO_BIAS
/* Filter radius: the largest distance to the centre of a texel that the filter reads, per axis; texels, Q16. */
GN_COLD static int32_t taps_q16(const gn_light_view *view)
{
    if (view->filter == GN_FILTER_HARD) return 32768;
    if (view->filter == GN_FILTER_DISK) return view->disk_radius_q16 + 32768;
    return (view->filter_idx + 1) << 16;
}

/* Stored depth, rounded to half a step after up to T rounded ones, and the receiver's, rounded to half of its own finer
 * step, as a fraction of the depth range: 2^-(bits + 1) + 2^-(bits + frac + 1) + (T + 2) 2^-32 + 2^-29, Q32 */
GN_COLD static int64_t depth_step_q32(const gn_light_view *view)
{
    const int64_t half = (int64_t)1 << 31;
    int32_t bits = GN_VIEW_BITS(view);
    return (half >> bits) + (bits == 32 ? 0 : half >> (bits + GN_DEPTH_FRAC_BITS)) + GN_TILE_SIDE(view) + 11;
}

/* sqrt(1 + k^2) times the relative error of view depths, and of a pixel's ray, whose three coefficients are rounded in
 * each axis: 2^-28 of W + H. Q40: 2^7 * (2^-17 + 2^-16) at most. */
GN_COLD static int32_t ray_error_q40(const gn_frame *frame)
{
    uint64_t ray2_q48 = (((uint64_t)1 << 24) + (uint64_t)gn_cascade_tan2_q24(frame)) << 24; /* <= (2^24 + 2^38) 2^24 */
    uint64_t ray_q24 = gn_isqrt64(ray2_q48), pixels = (uint64_t)frame->picture.width + frame->picture.height;
    return gn_sat32((int64_t)((ray_q24 >> (GN_RECIP_STEPS(frame) == 1 ? 1 : 12)) + (ray_q24 * pixels >> 12) + 2));
}

/* Position error of a receiver at the far end of the view's cascade, texels, Q16. */
GN_COLD static int32_t place_error_q16(const gn_frame *frame, const gn_light_view *view)
{
    int64_t farthest_q16 = frame->scene->shadow.max_distance_q16;
    if (!view->border_lit) {
        const gn_cascade_state *cascade = &frame->cascade[view->cascade_idx];
        int64_t end_q16 = (int64_t)cascade->centre_q16 + (int64_t)gn_isqrt64(cascade->radius2_q32);
        farthest_q16 = end_q16 < farthest_q16 ? end_q16 : farthest_q16;
    }
    farthest_q16 += GN_FLAT_Q16(frame); /* MODEL 7 */
    int64_t error_q32 =
        gn_shr64(farthest_q16 * ray_error_q40(frame), 24) + ((int64_t)GN_AUTO_UNITS << 16); /* 2^30 * 2^31 */
    int64_t texels_q16 =
        gn_bf_apply(error_q32, view->fit.ortho.inv_texel, -16) + 17; /* 2^-12: planes of large casters */
    return (int32_t)gn_clamp64(texels_q16, 0, 8 << 16);
}

GN_COLD void gn_bias_auto_view(const gn_frame *frame, gn_light_view *view)
{
    view->offset_q16 = taps_q16(view) + gn_bias_auto_delta_q16(frame);
    if (view->perspective) {
        /* coordinates and n / z have the reciprocal's error: 2^-17 of half a tile, or 2^-29 */
        int one_step = GN_RECIP_STEPS(frame) == 1;
        view->offset_q16 += one_step ? (view->tile_texels + 3) >> 2 : 1;
        view->offset_q16 +=
            (int32_t)(((view->fit.persp.focal2_q16 >> 29) + 1) >> 1); /* x / z is rounded to 2^-30 of T / t */
        /* the caster's plane is rounded to 2^-27, its position to 2^-28 */
        view->auto_step = (int32_t)(depth_step_q32(view) + (one_step ? 32768 : 8) + 64);
        view->auto_place = ray_error_q40(frame);
        return;
    }
    int32_t place_q16 = place_error_q16(frame, view);
    int64_t step_q16 = gn_scale64(depth_step_q32(view), 16 - view->tile_log2 - view->depth_log2) + 1; /* 2^25 * 2^4 */
    view->offset_q16 += place_q16;
    view->auto_step = (int32_t)gn_clamp64(step_q16 + 3 + place_q16, 0, INT32_MAX);
}
#endif
