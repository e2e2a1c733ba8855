/* Light states, and which object each light affects. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "light/gn_punctual.h"
#include "scene/gn_scene.h"

#define GN_COLOUR_MAX_UQ16 0xFFFFFF /* 255.99 */

/* A light for the frame; a baked one is off. [P1] [M9] */
static void setup_light(gn_frame *frame, uint32_t light_idx)
{
    const gn_light *light = &frame->scene->lights[light_idx];
    gn_light_state *state = &frame->light[light_idx];
    int64_t towards[3];
    for (int k = 0; k < 3; k++) {
        towards[k] = -(int64_t)light->direction[k];
        /* colours of spot and point lights keep their exponent: gn_punctual_setup */
        int32_t exp = light->kind == GN_LIGHT_DIRECTIONAL ? light->colour_exp : 0;
        state->colour_uq16[k] = (uint32_t)gn_clamp64(gn_scale64(light->colour_uq16[k], -exp), 0, GN_COLOUR_MAX_UQ16);
    }
    if (!gn_normalise_q30(state->to_light_q30, towards)) /* only a point light has none */
        for (int k = 0; k < 3; k++) state->to_light_q30[k] = 0;
    state->strength_uq16 = light->shadow_strength_uq16;
    state->mask_channel = light->mode == GN_LIGHT_MIXED ? (int8_t)light->mask_channel : -1;
    state->kind = (uint8_t)light->kind;
    state->off = light->mode == GN_LIGHT_BAKED;
    if (GN_SHADOWS && GN_AUTO_BIAS) state->auto_bias = (uint8_t)gn_scene_auto_bias(light);
    state->view_idx = -1;
    state->n_views = 0;
    state->shadow_state = GN_SHADOW_NOT_WANTED;
    if (GN_PUNCTUAL_LIGHTS && light->kind != GN_LIGHT_DIRECTIONAL) gn_punctual_setup(frame, light_idx);
}

int gn_light_reaches(const gn_frame *frame, uint32_t light_idx, uint32_t object_idx)
{
#if GN_PUNCTUAL_LIGHTS
    const gn_light_state *light = &frame->light[light_idx];
    if (light->kind == GN_LIGHT_DIRECTIONAL || light->range2_q32 == UINT64_MAX) return 1;
    return gn_object_distance2_q32(&frame->object[object_idx], light->position_q16) < light->range2_q32;
#else
    (void)frame, (void)object_idx, (void)light_idx;
    return 1;
#endif
}

/* Light lists of all objects. */
static gn_status list_lights(gn_frame *frame)
{
    uint32_t n_directional = 0, most = 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        n_directional += frame->light[l].kind == GN_LIGHT_DIRECTIONAL && !frame->light[l].off;
    if (GN_PUNCTUAL_LIGHTS) {
        for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
            uint32_t n = gn_object_list_lights(frame, i);
            if (n > most) most = n;
        }
    }
    if (n_directional + most > GN_SURFACE_LIGHTS)
        return gn_fail_capacity(frame, GN_ERR_SURFACE_LIGHTS, n_directional + most, GN_SURFACE_LIGHTS);
    return GN_OK;
}

GN_COLD gn_status gn_lights_setup(gn_frame *frame)
{
    const gn_scene *scene = frame->scene;
    /* 10^-4 of the model's units; squared distances scale by 4^unit_log2; min one step */
    int64_t min2 = gn_scale64(429497, -2 * scene->unit_log2);
    frame->min2_q32 = min2 > 0 ? (uint64_t)min2 : 1;
    for (uint32_t i = 0; i < scene->n_lights; i++) setup_light(frame, i);
    gn_status status = GN_OK;
    if (GN_BOXES) status = gn_object_boxes(frame);
    if (!status && (GN_PUNCTUAL_LIGHTS || GN_MAX_LIGHTS > GN_SURFACE_LIGHTS)) status = list_lights(frame);
    return status;
}
