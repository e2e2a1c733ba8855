/* Lights and their views. */
#include "gn_internal.h"

#include "gn_stages.h"
#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "base/gn_signature.h"
#include "light/gn_bias.h"
#include "light/gn_cascade.h"
#include "light/gn_object.h"
#include "light/gn_punctual.h"
#include "scene/gn_scene.h"
#include "shadow/gn_cull.h"
#include "shadow/gn_ortho.h"
#include "shadow/gn_persp.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_tiles.h"

#define GN_COLOUR_MAX_UQ16 0xFFFFFF /* 255.99 */

static void setup_light(gn_frame *frame, uint32_t light_idx)
{
    const gn_light *light = &frame->scene->lights[light_idx];
    GN_ELEMENT(light);
    gn_light_state *state = &frame->light[light_idx];
    int64_t towards[3];
    for (int k = 0; k < 3; k++) {
        towards[k] = -(int64_t)light->direction[k];
        /* those of spot and point lights keep their exponent: gn_punctual_setup */
        int32_t exp = light->kind == GN_LIGHT_DIRECTIONAL ? light->colour_exp : 0;
        state->colour_uq16[k] = (uint32_t)gn_clamp64(gn_scale64(light->colour_uq16[k], -exp), 0, GN_COLOUR_MAX_UQ16);
    }
    if (!gn_normalise_q30(state->to_light_q30, towards)) /* only a point light has none */
        for (int k = 0; k < 3; k++) state->to_light_q30[k] = 0;
    state->strength_uq16 = light->shadow_strength_uq16;
    state->mask_channel = light->mode == GN_LIGHT_MIXED ? (int8_t)light->mask_channel : -1;
    state->kind = (uint8_t)light->kind;
    state->off = light->mode == GN_LIGHT_BAKED;
#if GN_SHADOWS && GN_AUTO_BIAS
    state->auto_bias = (uint8_t)gn_scene_auto_bias(light);
#endif
    state->view_idx = -1;
    state->n_views = 0;
    state->shadow_state = GN_SHADOW_NOT_WANTED;
#if GN_PUNCTUAL_LIGHTS
    if (light->kind != GN_LIGHT_DIRECTIONAL) gn_punctual_setup(frame, light_idx);
#endif
}

#if GN_SHADOWS
/* DESIGN 1.4: u, v, w from the direction of travel. */
static void view_axes(gn_light_view *view, const int32_t w_q30[3])
{
    int32_t(*axis)[3] = view->axis_q30;
    const uint32_t limit = 15U << 26; /* 15/16 */
    for (int i = 0; i < 3; i++) axis[2][i] = w_q30[i];
    int64_t along_y[3] = {w_q30[2], 0, -(int64_t)w_q30[0]}; /* (0, 1, 0) x w */
    int64_t along_x[3] = {0, -(int64_t)w_q30[2], w_q30[1]}; /* (1, 0, 0) x w */
    gn_normalise_q30(axis[0], gn_abs32(w_q30[1]) < limit ? along_y : along_x);
    gn_cross_q30(axis[1], axis[2], axis[0]);
}

/* F5 */
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
#if GN_DISK_FILTER
    if (filter != GN_FILTER_DISK) return;
    /* 0.004 T for views that are a share of their tile; an orthographic fit says otherwise */
    int64_t radius_q16 =
        gn_shr64((int64_t)shadow->penumbra_uq16 * view->tile_texels * 17179869, 32); /* 2^22 * 2^10 * 2^25 */
    view->filter_idx = (uint8_t)gn_clamp64((radius_q16 + 65535) >> 16, 1, GN_DISK_INDEX_MAX);
    view->disk_radius_q16 = (int32_t)gn_clamp64(radius_q16, 0, (int64_t)view->filter_idx << 16);
#endif
}

static void set_texels(gn_frame *frame, gn_light_view *view)
{
    size_t first = view->first_texel;
    view->depth_bits = (uint8_t)GN_K(frame, depth_bits);
    view->depth = GN_TEXELS_OF(frame->atlas, view->depth_bits);
#if GN_DEPTH_BLOCKS
    if (!view->in_other) view->block = frame->block + first / 64;
#endif
#if GN_OTHER_ATLAS
    if (view->in_other) {
        view->depth_bits = (uint8_t)GN_K(frame, other_depth_bits);
        view->depth = GN_TEXELS_OF(frame->other_atlas, view->depth_bits);
#if GN_DEPTH_BLOCKS
        view->block = frame->other_block + first / 64;
#endif
    }
#endif
    view->depth = gn_texels_at(view->depth, view->depth_bits, first);
}

static void fit_directional(gn_frame *frame, gn_light_view *view, const gn_light *light, int cascaded)
{
    int64_t direction[3] = {light->direction[0], light->direction[1], light->direction[2]};
    int32_t w[3], near_q16 = frame->scene->camera.near_q16, far_q16 = frame->scene->shadow.max_distance_q16;
    gn_normalise_q30(w, direction);
    view_axes(view, w);
    if (cascaded) gn_cascade_slice(frame, view->cascade_idx, &near_q16, &far_q16);
    gn_ortho_fit_view(frame, view, light, near_q16, far_q16);
}

static void fit(gn_frame *frame, gn_light_view *view, const gn_light *light, int cascaded)
{
    view->bias_constant_q16 = light->bias_constant_q16;
    view->bias_slope_q16 = light->bias_slope_q16;
    set_filter(frame, view, light);
    if (!view->perspective) fit_directional(frame, view, light, cascaded);
#if GN_PUNCTUAL_LIGHTS
    if (view->perspective) {
        int32_t w[3];
        for (int i = 0; i < 3; i++) w[i] = -frame->light[view->light_idx].to_light_q30[i];
        if (light->kind == GN_LIGHT_POINT) gn_persp_face_axis(w, view->cascade_idx);
        view_axes(view, w);
        gn_persp_fit_view(frame, view, light);
    }
#endif
#if GN_AUTO_BIAS
    if (frame->light[view->light_idx].auto_bias) {
        gn_bias_auto_view(frame, view);
        return;
    }
#endif
    view->offset_q16 = gn_mul_shr(light->bias_normal_q16, 92682 * (view->filter_idx + 1), 16); /* sqrt(2) in Q16 */
#if GN_RECEIVER_BIAS
    view->offset_q16 += (view->filter_idx + 1) * light->bias_receiver_q16[2];
#endif
}

#if GN_INCREMENTAL
/* A5: whether the schedule lets a cascade keep its tile of an earlier frame, which slot `idx` still holds. After a
 * frame that was begun but not drawn the slot holds a fit that its texels do not belong to. */
static int stays(const gn_frame *frame, uint32_t idx, uint32_t light_idx, uint32_t cascade_idx)
{
    uint32_t period = frame->scene->shadow.refresh[cascade_idx];
    const gn_light_view *view = &frame->view[idx];
    gn_filter filter = resolve_filter(frame->scene->shadow.filter, frame->scene->lights[light_idx].softness);
    if (period < 2 || frame->frame_count % period == 0 || !frame->memory[idx].signature) return 0;
    if (!view->tile_done) return 0;       /* the frame was abandoned: the fit is newer than the texels */
    if (view->filter != filter) return 0; /* what another filter needs was not validated */
    return !view->perspective && !view->empty && view->light_idx == light_idx && view->cascade_idx == cascade_idx;
}

/* Tiles that move within the atlas would be found overwritten: then nothing is kept. */
static void check_layout(gn_frame *frame, const gn_tile_plan *plan)
{
    uint64_t layout = gn_signature_add(GN_SIGNATURE_SEED, (uint64_t)GN_K(frame, depth_bits) << 8 |
                                                              (uint64_t)GN_K(frame, atlas_size) << 32);
#if GN_OTHER_ATLAS
    layout = gn_signature_add(layout, (uint64_t)GN_K(frame, other_depth_bits) << 8 |
                                          (uint64_t)GN_K(frame, other_atlas_size) << 32);
#endif
    layout = gn_signature_add(layout, frame->scene->shadow.cascades_unused);
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        layout = gn_signature_add(layout, (uint64_t)plan[l].n_tiles << 32 | (uint64_t)plan[l].in_other << 16 |
                                              plan[l].tile_log2);
    if (layout == frame->layout) return;
    frame->layout = layout;
    for (uint32_t i = 0; i < GN_VIEWS_MAX; i++) frame->memory[i].signature = frame->memory[i].static_signature = 0;
}
#endif

static void add_view(gn_frame *frame, uint32_t light_idx, const gn_tile_plan *plan, uint32_t cascade_idx,
                     uint32_t *first_texel)
{
    gn_light_view *view = &frame->view[frame->n_views];
    GN_ELEMENT(view);
    view->stale = 0;
#if GN_INCREMENTAL
    view->stale = (uint8_t)(plan->cascaded && stays(frame, frame->n_views, light_idx, cascade_idx));
#endif
    frame->n_views++;
    view->tile_done = 0;
    view->light_idx = (uint16_t)light_idx;
    view->cascade_idx = (uint8_t)cascade_idx;
    view->in_other = plan->in_other;
    view->tile_log2 = plan->tile_log2;
    view->tile_texels = (uint16_t)(1U << plan->tile_log2);
    view->first_texel = *first_texel;
    if (!plan->cascaded || !GN_CASCADE_UNUSED(frame, cascade_idx)) *first_texel += 1U << (2 * plan->tile_log2);
    set_texels(frame, view);
    /* also of an empty one: a light's first view says what kind all of them are */
    view->perspective = frame->light[light_idx].kind != GN_LIGHT_DIRECTIONAL;
    view->border_lit = !view->perspective && !plan->cascaded;
    view->empty = plan->cascaded && frame->cascade[cascade_idx].radius2_q32 == 0;
    if (view->empty) return;
    if (view->stale) gn_ortho_rays(frame, view);
#if GN_AUTO_BIAS
    if (view->stale && frame->light[light_idx].auto_bias) gn_bias_auto_view(frame, view);
#endif
    /* a texel that was fitted to a far narrower picture can leave a ray no fraction bits */
    if (view->stale && view->fit.ortho.ray_shift < 0) view->stale = 0;
    if (!view->stale) fit(frame, view, &frame->scene->lights[light_idx], plan->cascaded);
}

/* Tiles of one atlas lie one behind the other, larger ones first, so that each begins at a multiple of its size. */
static void add_views(gn_frame *frame, const gn_tile_plan *plan)
{
    uint32_t first[GN_MAX_LIGHTS] = {0}, next[2] = {0, 0};                /* every light with tiles gets its first */
    for (int32_t log2 = GN_TILE_IMPORTANCE ? 10 : 3; log2 >= 3; log2--) { /* else one size per atlas */
        for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
            if (!plan[l].n_tiles || (GN_TILE_IMPORTANCE && plan[l].tile_log2 != log2)) continue;
            first[l] = next[plan[l].in_other];
            next[plan[l].in_other] += (uint32_t)plan[l].n_drawn << (2 * plan[l].tile_log2);
        }
    }
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        if (!plan[l].n_tiles) continue;
        frame->light[l].view_idx = (int16_t)frame->n_views;
        frame->light[l].n_views = plan[l].n_tiles;
        frame->has_cascades |= plan[l].cascaded;
        for (uint32_t c = 0; c < plan[l].n_tiles; c++) add_view(frame, l, &plan[l], c, &first[l]);
    }
}

static gn_status setup_views(gn_frame *frame)
{
    gn_tile_plan plan[GN_MAX_LIGHTS];
    frame->has_cascades = 0;
    gn_cascade_setup(frame);
    gn_status status = gn_tiles_plan(frame, plan);
    if (status) return status;
#if GN_INCREMENTAL
    check_layout(frame, plan);
#endif
    add_views(frame, plan);
#if GN_CASTER_CULLING
    gn_cull_begin(frame);
#endif
    frame->frame_count++;
    return GN_OK;
}
#endif

gn_status gn_views_setup(gn_frame *frame)
{
    const gn_scene *scene = frame->scene;
    frame->n_views = 0;
    /* 10^-4 of the model's units, squared distances scale by 4^unit_log2; at least one step */
    int64_t min2 = gn_scale64(429497, -2 * scene->unit_log2);
    frame->min2_q32 = min2 > 0 ? (uint64_t)min2 : 1;
    for (uint32_t i = 0; i < scene->n_lights; i++) setup_light(frame, i);
    gn_status status = GN_OK;
#if GN_BOXES
    status = gn_object_boxes(frame);
#endif
#if GN_PUNCTUAL_LIGHTS || GN_MAX_LIGHTS > GN_SURFACE_LIGHTS
    if (!status) status = gn_object_lights(frame);
#endif
#if GN_SHADOWS
    if (!status) status = setup_views(frame);
#endif
    return status;
}
