/* Automatic receiver bias, once per view. [B6] */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_bias.h"
#include "light/gn_lights.h"

/* Filter radius: the largest distance to the centre of a texel that the filter reads, per axis; texels, Q16. */
static int32_t taps_q16(const gn_light_view *view)
{
    if (view->filter == GN_FILTER_HARD) return 32768;
    if (view->filter == GN_FILTER_DISK) return view->disk_radius_q16 + 32768;
    return (view->filter_idx + 1) << 16;
}

/* Stored depth, rounded to half a step after up to T rounded ones, and the receiver's, rounded to half of its own finer
 * step, as a fraction of the depth range: 2^-(bits + 1) + 2^-(bits + frac + 1) + (T + 2) 2^-32 + 2^-29, Q32 */
static int64_t depth_step_q32(const gn_light_view *view)
{
    const int64_t half = (int64_t)1 << 31;
    int32_t bits = GN_VIEW_BITS(view);
    return (half >> bits) + (bits == 32 ? 0 : half >> (bits + GN_DEPTH_FRAC_BITS)) + GN_TILE_SIDE(view) + 11;
}

/* sqrt(1 + k^2) times the relative error of view depths, and of a pixel's ray, whose three coefficients are rounded in
 * each axis: 2^-28 of W + H. Q40: 2^7 * (2^-17 + 2^-16) at most. */
static int32_t ray_error_q40(const gn_frame *frame)
{
    uint64_t ray2_q48 = (((uint64_t)1 << 24) + (uint64_t)gn_cascade_tan2_q24(frame)) << 24; /* <= (2^24 + 2^38) 2^24 */
    uint64_t ray_q24 = gn_isqrt64(ray2_q48), pixels = (uint64_t)frame->picture.width + frame->picture.height;
    return gn_sat32((int64_t)((ray_q24 >> (GN_RECIP_STEPS(frame) == 1 ? 1 : 12)) + (ray_q24 * pixels >> 12) + 2));
}

/* Position error of a receiver at the far end of the view's cascade, texels, Q16. */
static int32_t place_error_q16(const gn_frame *frame, const gn_light_view *view)
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
