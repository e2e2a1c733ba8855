/* A light's shadow on a surface point: distance strength, receiver bias, blending, mixing (MODEL 4, 7, 9). */
#include "ref_internal.h"

#define DEFAULT_SAMPLES 16
#define STEEPEST        50.0 /* tan theta */
#define PLANE_LIMIT     16.0 /* the receiver's gradient in depth ranges per tile */

/* g of MODEL 4 [D5] [D6] [D11]. Without cascades in use there is no sphere to leave. */
static double distance_strength(const ref_frame *frame, const ref_surface *at)
{
    const scene_shadow *shadow = &frame->s->shadow;
    double g;
    if (shadow->distance_mode == SCENE_DISTANCE_RADIUS) {
        const vec3 d = vec3_sub(at->world, frame->camera.position);
        g = vec3_dot(d, d) <= shadow->max_distance * shadow->max_distance ? 1.0 : 0.0;
    } else {
        g = clamp((1.0 - at->view_depth / shadow->max_distance) / fmax(shadow->distance_fade, 0.001), 0.0, 1.0);
    }
    if (!frame->cascades_in_use) return g;
    if (at->selected.here < 0) return 0.0;
    return at->selected.next < 0 ? g * at->selected.fade : g;
}

/* Along the normal [B2], and the four terms [B3], in texels, before the filter's width. N is not renormalised. */
static vec3 receiver_offset(const scene_light *light, vec3 n, vec3 to_light)
{
    const double *b = light->bias_receiver;
    const double cosine = clamp(vec3_dot(n, to_light), 0.0, 1.0), sine = sqrt(1.0 - cosine * cosine);
    const double tangent = cosine > 0.0 ? fmin(STEEPEST, sine / cosine) : STEEPEST;
    return vec3_add(vec3_scale(to_light, b[0] + b[1] * tangent),
                    vec3_scale(n, sqrt(2.0) * light->bias_normal + b[2] + b[3] * sine));
}

static vec3 moved_point(const ref_light_view *view, const scene_light *light, const ref_surface *at, vec3 unmoved,
                        vec3 to_light)
{
    const double texels = ref_texel_at(view, unmoved) * (view->filter_index + 1);
    const vec3 offset = vec3_scale(receiver_offset(light, at->interpolated, to_light), texels);
    return ref_to_light(view, vec3_add(at->world, offset));
}

/* Of the face's own plane, through the unmoved point. [B5] */
static void set_plane(ref_lookup *how, const ref_light_view *view, const ref_surface *at, vec3 in_light)
{
    const vec3 f = at->face;
    const vec3 normal = {vec3_dot(f, vec3_load(view->axis[0])), vec3_dot(f, vec3_load(view->axis[1])),
                         vec3_dot(f, vec3_load(view->axis[2]))};
    const vec2 gradient = ref_depth_gradient(view, normal, in_light);
    double side = 8.0; /* T, or the power of two that both sides fit in */
    while (side < view->tile_texels || side < view->tile_rows) side *= 2.0;
    const double limit = PLANE_LIMIT / side * view->depth_range;
    how->gradient[0] = clamp(gradient.x, -limit, limit);
    how->gradient[1] = clamp(gradient.y, -limit, limit);
}

static double attenuation_in(const ref_frame *frame, const ref_surface *at, size_t l, int i, vec3 to_light)
{
    const ref_light_view *view = &frame->picture->view[l][i];
    const scene_light *light = &frame->s->lights[l];
    const scene_shadow *shadow = &frame->s->shadow;
    if (view->unseen) return 1.0;
    ref_lookup how = {.filter = view->filter,
                      .disk_samples = shadow->disk_samples > 0 ? shadow->disk_samples : DEFAULT_SAMPLES,
                      .edge = view->filter <= SCENE_FILTER_2X2 ? frame->options->edge : 0,
                      .x = at->x,
                      .y = at->y};
    const vec3 unmoved = ref_to_light(view, at->world);
    double less = 0.0;
    const vec3 moved = light->auto_bias != SCENE_AUTO_BIAS_OFF
                           ? vec3_add(unmoved, ref_auto_bias(frame, view, light->auto_bias, at, unmoved, &less))
                           : moved_point(view, light, at, unmoved, to_light);
    if (view->perspective && !(moved.z > view->near)) return 1.0;
    if (light->receiver_plane || how.edge) set_plane(&how, view, at, unmoved);
    vec3 p = ref_project(view, moved);
    const double end = view->tile_texels, end_row = view->tile_rows;
    if (view->perspective && light->auto_bias == SCENE_AUTO_BIAS_NORMAL &&
        (p.x < 0.0 || p.y < 0.0 || p.x > end || p.y > end_row)) {
        const vec3 along = vec3_add(unmoved, ref_auto_bias(frame, view, SCENE_AUTO_BIAS_DEPTH, at, unmoved, &less));
        if (!(along.z > view->near)) return 1.0;
        p = ref_project(view, along);
    }
    const double depth = p.z - less;
    return depth > 0.0 ? ref_filtered(view, &how, p.x, p.y, depth) : 1.0;
}

/* Of two cascades, softly or by the pixel's noise. [D7] */
static double blended_attenuation(const ref_frame *frame, const ref_surface *at, size_t l, vec3 to_light)
{
    const ref_selection *selected = &at->selected;
    const scene_blend blend = selected->next < 0 ? SCENE_BLEND_HARD : frame->s->shadow.blend;
    if (blend == SCENE_BLEND_DITHER)
        return attenuation_in(frame, at, l, selected->fade < at->noise ? selected->next : selected->here, to_light);
    const double here = attenuation_in(frame, at, l, selected->here, to_light);
    if (blend == SCENE_BLEND_HARD || selected->fade >= 1.0) return here;
    return lerp(attenuation_in(frame, at, l, selected->next, to_light), here, selected->fade);
}

/* rt of MODEL 9, from the maps. Only called where g > 0: a light with cascades then has one selected. */
static double mapped_attenuation(const ref_frame *frame, const ref_surface *at, size_t l, vec3 to_light)
{
    const scene_light *light = &frame->s->lights[l];
    if (frame->picture->grant[l].atlas == REF_DIRECTIONAL_ATLAS) return blended_attenuation(frame, at, l, to_light);
    if (light->kind != SCENE_LIGHT_POINT) return attenuation_in(frame, at, l, 0, to_light);
    double from_light[3];
    vec3_store(from_light, vec3_sub(at->world, vec3_load(light->position)));
    return attenuation_in(frame, at, l, ref_point_face(from_light), to_light);
}

/* A single tile around an empty slice is none; an empty cascade is never selected. Who does without maps serves every
 * light that requests it. */
static bool is_served(const ref_frame *frame, size_t l)
{
    if (frame->visibility) return ref_asks_for_tiles(frame, l);
    const ref_grant *grant = &frame->picture->grant[l];
    return grant->n_tiles > 0 && (grant->atlas == REF_DIRECTIONAL_ATLAS || frame->picture->view[l][0].active ||
                                  frame->picture->view[l][0].unseen);
}

/* The realtime shadow, the baked mask, or both. [M6] [M4] */
double ref_mix(scene_mixing mixing, double strength, double g, double m, double rt)
{
    if (!(strength * g > 0.0)) return lerp(1.0, m, strength);
    switch (mixing) {
    case SCENE_MIX_ALWAYS:
        return lerp(1.0, fmin(m, lerp(1.0, rt, g)), strength);
    case SCENE_MIX_DISTANCE:
        return lerp(1.0, lerp(m, rt, g), strength);
    case SCENE_MIX_NONE:
        break;
    }
    return lerp(1.0, rt, strength * g);
}

/* 1 for surfaces that refuse shadows. [M2] */
double ref_shadow(const ref_frame *frame, const ref_surface *at, size_t l, vec3 to_light)
{
    const scene_light *light = &frame->s->lights[l];
    const scene_object *object = at->triangle.object;
    if (!(light->strength > 0.0) || !light->shadow || !object->receives || object->unlit) return 1.0;
    const double m = ref_mask(frame->s, &at->triangle, at->bary, light->mode == SCENE_MIXED ? light->mask_channel : -1);
    const double g = is_served(frame, l) ? distance_strength(frame, at) : 0.0;
    double rt = 1.0;
    if (light->strength * g > 0.0)
        rt = frame->visibility ? frame->visibility(frame->visibility_user, at, l)
                               : mapped_attenuation(frame, at, l, to_light);
    return ref_mix(frame->s->shadow.mixing, light->strength, g, m, rt);
}
