/* Automatic receiver bias [B6]. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_bias.h"

/* Depth form, both slopes together: planes that the light meets nearly at right angles have the bias of this slope, so
 * that a steeper one beside them does not darken their edge. */
#define GN_LEAST_SLOPE_Q10 512

GN_HOT int32_t gn_bias_auto_reach_q16(const gn_frame *frame, const gn_light_view *view, gn_auto_bias form)
{
    if (form == GN_AUTO_BIAS_DEPTH) return 0;
    return gn_mul_shr(65536 + gn_bias_auto_delta_q16(frame), GN_SQRT2_Q16, 16) +
           (int32_t)((view->tile_texels * (int64_t)65536) >> GN_VIEW_BITS(view)) + 1;
}

GN_HOT void gn_bias_auto_face(const gn_light_view *view, gn_auto_bias form, const int32_t face_q30[3], int32_t out[3])
{
    int64_t n[3];
    GN_UNROLL
    for (int i = 0; i < 3; i++) n[i] = gn_dot_q30(face_q30, view->axis_q30[i]);
    GN_UNROLL
    for (int i = 0; i < 3; i++) out[i] = gn_sat32(n[i]);
    if (form == GN_AUTO_BIAS_NORMAL) return;
    gn_bfloat per_w = gn_bf_recip(gn_bf_from_u64(gn_abs64(n[2]) | 1U));
    GN_UNROLL
    for (int i = 0; i < 2; i++) out[i] = gn_sat32(gn_bf_apply((int64_t)gn_abs64(n[i]), per_w, 10) + 1);
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
    int64_t most_q10 = (int64_t)1 << (11 + range_log2); /* twice the range: half of that lights all */
    u = u < most_q10 ? u : most_q10;
    v = v < most_q10 ? v : most_q10;
    const int64_t slopes_q10 = u + v > GN_LEAST_SLOPE_Q10 ? u + v : GN_LEAST_SLOPE_Q10;
    out_q16[2] = gn_sat32(-((reach_q16 * slopes_q10 >> 10) + view->auto_step + 1)); /* 2^21 * 2^32 */
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
    if (across_q30 < GN_LEAST_SLOPE_Q10 << 20) across_q30 = GN_LEAST_SLOPE_Q10 << 20;
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
