/* Lights and their views. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_views.h"

/* Not inlined: a stage is counted by its name. */
GN_COLD GN_NOINLINE gn_status gn_views_setup(gn_frame *frame, gn_scratch *scratch)
{
#if GN_SHADOWS && GN_TIGHT_FIT
    gn_seen_job *job = &scratch->work.seen;
#else
    gn_seen_job *job = NULL;
    (void)scratch;
#endif
    frame->n_views = 0;
    gn_status status = gn_lights_setup(frame);
    return GN_SHADOWS && !status ? gn_light_views_setup(frame, job) : status;
}

/* ---- Views of lights --------------------------------------------------------------------------------------------- */

/* Their directions, tiles, filters and biases. */

#if GN_SHADOWS
GN_COLD void gn_light_view_axes(int32_t axis[3][3], const int32_t w_q30[3])
{
    const uint32_t limit = 15U << 26; /* 15/16 */
    for (int i = 0; i < 3; i++) axis[2][i] = w_q30[i];
    int64_t along_y[3] = {w_q30[2], 0, -(int64_t)w_q30[0]}; /* (0, 1, 0) x w */
    int64_t along_x[3] = {0, -(int64_t)w_q30[2], w_q30[1]}; /* (1, 0, 0) x w */
    gn_normalise_q30(axis[0], gn_abs32(w_q30[1]) < limit ? along_y : along_x);
    gn_cross_q30(axis[1], axis[2], axis[0]);
}

/* The light's softness overrides the atlas's filter. [F5] */
static gn_filter resolve_filter(gn_filter atlas, gn_softness softness)
{
    if (softness == GN_SOFTNESS_HARD) return atlas == GN_FILTER_HARD ? GN_FILTER_HARD : GN_FILTER_2X2;
    if (softness == GN_SOFTNESS_SOFT && atlas < GN_FILTER_5X5) return GN_FILTER_5X5;
    return atlas;
}

static void set_filter(const gn_frame *frame, gn_light_view *view, const gn_light *light)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    gn_filter filter = resolve_filter(view->in_other ? shadow->other_filter : shadow->filter, light->softness);
    view->filter = (uint8_t)filter;
    view->filter_idx = filter > GN_FILTER_2X2 ? (uint8_t)(filter - GN_FILTER_2X2) : 0;
    view->disk_radius_q16 = 0;
    if (!GN_DISK_FILTER || filter != GN_FILTER_DISK) return;
    /* 0.004 T for perspective views; the orthographic fit overwrites it */
    int64_t radius_q16 =
        gn_shr64((int64_t)shadow->penumbra_uq16 * view->tile_texels * 17179869, 32); /* 2^22 * 2^10 * 2^25 */
    view->filter_idx = (uint8_t)gn_clamp64((radius_q16 + 65535) >> 16, 1, GN_DISK_INDEX_MAX);
    view->disk_radius_q16 = (int32_t)gn_clamp64(radius_q16, 0, (int64_t)view->filter_idx << 16);
}

/* The tile's position in the atlas, and the bits of its texels. [A1] [A4] */
static void set_texels(gn_frame *frame, gn_light_view *view)
{
    view->depth_bits = (uint8_t)GN_K(frame, depth_bits);
    view->depth = GN_TEXELS_OF(frame->atlas, view->depth_bits);
#if GN_OTHER_ATLAS
    if (view->in_other) {
        view->depth_bits = (uint8_t)GN_K(frame, other_depth_bits);
        view->depth = GN_TEXELS_OF(frame->other_atlas, view->depth_bits);
    }
#endif
    view->depth = gn_texels_at(view->depth, view->depth_bits, view->first_texel);
#if GN_DISK_FILTER
    gn_blocks_find(frame, view);
#endif
}

/* The view of one cascade, or of the whole shadow distance. [D1] */
static void fit_directional(gn_frame *frame, gn_light_view *view, const gn_light *light, int cascaded)
{
    int64_t direction[3] = {light->direction[0], light->direction[1], light->direction[2]};
    int32_t w[3], near_q16 = frame->scene->camera.near_q16, far_q16 = frame->scene->shadow.max_distance_q16;
    gn_normalise_q30(w, direction);
    gn_light_view_axes(view->axis_q30, w);
    if (cascaded) gn_cascade_slice(frame, view->cascade_idx, &near_q16, &far_q16);
#if GN_TIGHT_FIT
    if (frame->scene->shadow.fit == GN_FIT_TIGHT && gn_ortho_fit_tight(frame, view, light)) return;
#endif
    gn_ortho_fit_view(frame, view, light, near_q16, far_q16);
}

/* What the receiver's bias is to be in the view. */
static void set_offset(gn_light_view *view, const gn_light *light)
{
    view->offset_q16 = gn_mul_shr(light->bias_normal_q16, 92682 * (view->filter_idx + 1), 16); /* sqrt(2) in Q16 */
    if (GN_RECEIVER_BIAS) view->offset_q16 += (view->filter_idx + 1) * light->bias_receiver_q16[2];
}

static void fit(gn_frame *frame, gn_light_view *view, const gn_light *light, int cascaded)
{
    view->bias_constant_q16 = light->bias_constant_q16;
    view->bias_slope_q16 = light->bias_slope_q16;
    set_filter(frame, view, light);
    if (!view->perspective) fit_directional(frame, view, light, cascaded);
    if (GN_PUNCTUAL_LIGHTS && view->perspective) {
        int32_t w[3];
        for (int i = 0; i < 3; i++) w[i] = -frame->light[view->light_idx].to_light_q30[i];
        if (light->kind == GN_LIGHT_POINT) gn_persp_face_axis(w, view->cascade_idx);
        gn_light_view_axes(view->axis_q30, w);
        gn_persp_fit_view(frame, view, light);
    }
    set_offset(view, light);
    if (GN_PUNCTUAL_LIGHTS && view->perspective)
        view->fit.persp.lift_q31 =
            (int32_t)gn_clamp64(gn_bf_apply(view->offset_q16, view->fit.persp.texel_per_z, 15), 0, INT32_MAX);
    if (GN_AUTO_BIAS && frame->light[view->light_idx].auto_bias) gn_bias_auto_view(frame, view);
}

/* Whether the schedule lets a cascade keep its tile of an earlier frame, which is still in slot `idx`. After a frame
 * that was begun but not drawn, the slot's fit does not belong to its texels. [A5] */
static inline int stays(gn_frame *frame, uint32_t idx, uint32_t light_idx, uint32_t cascade_idx)
{
    uint32_t period = frame->scene->shadow.refresh[cascade_idx];
    gn_light_view *view = &frame->view[idx];
    gn_filter filter = resolve_filter(frame->scene->shadow.filter, frame->scene->lights[light_idx].softness);
    if (period < 2 || frame->frame_count % period == 0 || !gn_kept_holds(frame, idx)) return 0;
    if (!view->tile_done) return 0;       /* the frame was abandoned: the fit is newer than the texels */
    if (view->filter != filter) return 0; /* the kept view's filter was not validated in this scene */
    if (view->perspective || view->empty || view->light_idx != light_idx || view->cascade_idx != cascade_idx) return 0;
    for (int k = 0; k < 3; k++) /* another light, or one that turned by 2 degrees */
        if (gn_abs32((int32_t)((uint32_t)frame->light[light_idx].to_light_q30[k] + (uint32_t)view->axis_q30[2][k])) >>
            25)
            return 0;
#if GN_TIGHT_FIT
    if (frame->scene->shadow.fit == GN_FIT_TIGHT)
        return !view->unseen && gn_ortho_covers(frame, view, &frame->scene->lights[light_idx], &frame->seen[idx]);
#endif
    return 1;
}

/* A square; a tight fit changes its shape. [A7] */
static void set_size(const gn_frame *frame, gn_light_view *view, const gn_tile_plan *plan)
{
    (void)frame;
    view->tile_log2 = plan->tile_log2;
#if GN_TIGHT_FIT
    view->unseen = view->tight = 0;
    if (GN_BY_WORTH(frame)) {
        uint32_t side = frame->seen[view - frame->view].side;
        view->unseen = side == 0;
        view->tile_rows = view->tile_texels = (uint16_t)(side ? side : 8);
        view->tile_log2 = (uint8_t)(32 - gn_clz32(view->tile_texels - 1U));
        return;
    }
    view->tile_rows = (uint16_t)(1U << plan->tile_log2);
#endif
    view->tile_texels = (uint16_t)(1U << plan->tile_log2);
}

/* Texels that the view's atlas reserves for it. */
static uint32_t texels_of_view(const gn_frame *frame, const gn_tile_plan *plan, const gn_light_view *view)
{
#if GN_TIGHT_FIT
    if (GN_BY_WORTH(frame)) {
        uint32_t side = frame->seen[view - frame->view].side;
        return side * side;
    }
#endif
    return plan->cascaded && GN_CASCADE_UNUSED(frame, view->cascade_idx) ? 0 : 1U << (2 * plan->tile_log2);
}

static void add_view(gn_frame *frame, uint32_t light_idx, const gn_tile_plan *plan, uint32_t cascade_idx,
                     uint32_t *first_texel)
{
    gn_light_view *view = &frame->view[frame->n_views];
    view->stale = 0;
    if (GN_INCREMENTAL && plan->cascaded) view->stale = (uint8_t)stays(frame, frame->n_views, light_idx, cascade_idx);
    frame->n_views++;
    view->tile_done = 0;
    view->light_idx = (uint16_t)light_idx;
    view->cascade_idx = (uint8_t)cascade_idx;
    view->in_other = plan->in_other;
    if (!view->stale) set_size(frame, view, plan); /* else it has the shape of its texels */
    view->first_texel = *first_texel;
    *first_texel += texels_of_view(frame, plan, view);
    set_texels(frame, view);
    /* also of an empty view: a light's first view tells the kind of all its views */
    view->perspective = frame->light[light_idx].kind != GN_LIGHT_DIRECTIONAL;
    view->border_lit = !view->perspective && !plan->cascaded;
    view->empty = plan->cascaded && frame->cascade[cascade_idx].radius2_q32 == 0;
    if (view->empty) return;
    if (view->stale) {
        gn_ortho_rays(frame, view);
        set_offset(view, &frame->scene->lights[light_idx]);
    }
    if (GN_AUTO_BIAS && view->stale && frame->light[light_idx].auto_bias) gn_bias_auto_view(frame, view);
    /* a kept fit from a far narrower picture can leave a ray no fraction bits */
    if (view->stale && view->fit.ortho.ray_shift < 0) {
        view->stale = 0;
        set_size(frame, view, plan);
    }
    if (!view->stale) fit(frame, view, &frame->scene->lights[light_idx], plan->cascaded);
}

#if GN_TIGHT_FIT
/* In the order of lights and views; behind them the empty tile. Sides are multiples of 8, tiles of whole blocks. */
static void place_by_worth(const gn_frame *frame, const gn_tile_plan *plan, uint32_t first[GN_MAX_LIGHTS],
                           uint32_t next[2])
{
    uint32_t view_idx = 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        first[l] = next[plan[l].in_other];
        for (uint32_t i = 0; i < plan[l].n_tiles; i++, view_idx++)
            next[plan[l].in_other] += (uint32_t)frame->seen[view_idx].side * frame->seen[view_idx].side;
    }
}
#endif

/* Tiles of one atlas lie one behind the other, larger ones first, so that each begins at a multiple of its size. */
static void place_by_size(const gn_frame *frame, const gn_tile_plan *plan, uint32_t first[GN_MAX_LIGHTS],
                          uint32_t next[2])
{
    for (int32_t log2 = GN_TILE_IMPORTANCE ? 10 : 3; log2 >= 3; log2--) { /* else one size per atlas */
        for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
            if (!plan[l].n_tiles || (GN_TILE_IMPORTANCE && plan[l].tile_log2 != log2)) continue;
            first[l] = next[plan[l].in_other];
            next[plan[l].in_other] += (uint32_t)plan[l].n_drawn << (2 * plan[l].tile_log2);
        }
    }
}

static void add_views(gn_frame *frame, const gn_tile_plan *plan)
{
    uint32_t first[GN_MAX_LIGHTS] = {0}, next[2] = {0, 0}; /* first: set for every light with tiles */
#if GN_TIGHT_FIT
    if (GN_BY_WORTH(frame)) place_by_worth(frame, plan, first, next);
    else
#endif
        place_by_size(frame, plan, first, next);
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        if (!plan[l].n_tiles) continue;
        frame->light[l].view_idx = (int16_t)frame->n_views;
        frame->light[l].n_views = plan[l].n_tiles;
        frame->has_cascades |= plan[l].cascaded;
        for (uint32_t c = 0; c < plan[l].n_tiles; c++) {
            uint32_t *at = &first[l];
#if GN_TIGHT_FIT
            if (GN_BY_WORTH(frame) && !frame->seen[frame->n_views].side) at = &next[plan[l].in_other];
#endif
            add_view(frame, l, &plan[l], c, at);
        }
    }
}

GN_COLD gn_status gn_light_views_setup(gn_frame *frame, gn_seen_job *job)
{
    gn_tile_plan plan[GN_MAX_LIGHTS];
    frame->has_cascades = 0;
    gn_cascade_setup(frame);
    gn_status status = gn_tiles_plan(frame, job, plan);
    if (status) return status;
    if (GN_INCREMENTAL) gn_kept_check_layout(frame, plan);
    add_views(frame, plan);
    if (GN_CASTER_CULLING) gn_cull_begin(frame);
    frame->frame_count++;
    return GN_OK;
}
#endif
