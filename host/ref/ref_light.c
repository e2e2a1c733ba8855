/* Surface attributes at the hit points (DESIGN 1.2), light and shadow (DESIGN 1.3, 1.6). */
#include "ref_internal.h"

typedef struct {
    const scene_object *object;
    vec3 world;
    vec3 interpolated; /* N, turned towards the viewer */
    vec3 normal;       /* n */
    vec3 albedo;
    double view_depth;
    ref_selection selected;
    double noise; /* of the dither */
} surface;

static vec3 interpolated_normal(const ref_instance *instance, const uint32_t idx[3], const ref_hit *hit)
{
    vec3 n = {0.0, 0.0, 0.0};
    if (instance->normal) n = vec3_mix(hit->bary, instance->normal[idx[0]], instance->normal[idx[1]], instance->normal[idx[2]]);
    if (!(vec3_dot(n, n) > 0.0)) { /* no normals, or they cancel: the face's */
        const vec3 p0 = instance->world[idx[0]];
        n = vec3_unit(vec3_cross(vec3_sub(instance->world[idx[1]], p0), vec3_sub(instance->world[idx[2]], p0)));
    }
    return hit->behind ? vec3_scale(n, -1.0) : n;
}

static vec3 surface_albedo(const scene_object *object, const scene_mesh *mesh, const uint32_t idx[3], const ref_hit *hit)
{
    const vec3 albedo = vec3_load(object->albedo);
    if (!mesh->rgb) return albedo;
    const vec3 c = vec3_mix(hit->bary, vec3_load(mesh->rgb + 3 * (size_t)idx[0]), vec3_load(mesh->rgb + 3 * (size_t)idx[1]),
                            vec3_load(mesh->rgb + 3 * (size_t)idx[2]));
    return (vec3){albedo.x * c.x, albedo.y * c.y, albedo.z * c.z};
}

static surface surface_at(const ref_frame *frame, size_t pixel)
{
    const int64_t id = frame->picture->triangle[pixel];
    const size_t o = (size_t)(id >> 32), triangle = (size_t)(id & 0xffffffff);
    const scene_object *object = &frame->s->objects[o];
    const scene_mesh *mesh = &frame->s->meshes[object->mesh_idx];
    const ref_instance *instance = &frame->instances[o];
    const ref_hit *hit = &frame->hits[pixel];
    const uint32_t *idx = mesh->idx + 3 * triangle;
    const vec3 n = interpolated_normal(instance, idx, hit);
    const vec3 world = vec3_mix(hit->bary, instance->world[idx[0]], instance->world[idx[1]], instance->world[idx[2]]);
    const int x = (int)(pixel % (size_t)frame->picture->width), y = (int)(pixel / (size_t)frame->picture->width);
    return (surface){
        .object = object,
        .world = world,
        .interpolated = n,
        .normal = vec3_unit(n),
        .albedo = surface_albedo(object, mesh, idx, hit),
        .view_depth = frame->picture->depth[pixel],
        .selected = ref_select_cascade(frame, world),
        .noise = ref_dither_noise(x, y),
    };
}

static double frac(double x)
{
    return x - floor(x);
}

double ref_dither_noise(int x, int y)
{
    return frac(52.9829189 * frac(0.06711056 * (x + 0.5) + 0.00583715 * (y + 0.5)));
}

/* g of DESIGN 1.3 and 1.4 (D5, D6, D11) */
static double distance_strength(const ref_frame *frame, const surface *at)
{
    const scene_shadow *shadow = &frame->s->shadow;
    double g;
    if (shadow->distance_mode == SCENE_DISTANCE_RADIUS) {
        const vec3 d = vec3_sub(at->world, frame->camera.position);
        g = vec3_dot(d, d) <= shadow->max_distance * shadow->max_distance ? 1.0 : 0.0;
    } else {
        g = clamp((1.0 - at->view_depth / shadow->max_distance) / fmax(shadow->distance_fade, 0.001), 0.0, 1.0);
    }
    return at->selected.next < 0 ? g * at->selected.fade : g;
}

static double attenuation_in(const ref_frame *frame, const surface *at, size_t l, int cascade)
{
    const ref_light_view *view = &frame->picture->view[l][cascade];
    const scene_filter filter = frame->s->shadow.filter;
    const double offset = frame->s->lights[l].bias_normal * sqrt(2.0) * (ref_filter_index(filter) + 1) * view->texel;
    const vec3 p = ref_to_light(view, vec3_add(at->world, vec3_scale(at->interpolated, offset)));
    return ref_attenuation(view, filter, p.x, p.y, p.z);
}

/* D7 */
static double blended_attenuation(const ref_frame *frame, const surface *at, size_t l)
{
    const ref_selection *selected = &at->selected;
    const scene_blend blend = selected->next < 0 ? SCENE_BLEND_HARD : frame->s->shadow.blend;
    if (blend == SCENE_BLEND_DITHER)
        return attenuation_in(frame, at, l, selected->fade < at->noise ? selected->next : selected->here);
    const double here = attenuation_in(frame, at, l, selected->here);
    if (blend == SCENE_BLEND_HARD || selected->fade >= 1.0) return here;
    const double next = attenuation_in(frame, at, l, selected->next);
    return next + selected->fade * (here - next);
}

/* shadow_l of DESIGN 1.3 for a surface that faces the light. */
static double shadow_factor(const ref_frame *frame, const surface *at, size_t l)
{
    const int cascade = at->selected.here;
    if (cascade < 0 || !frame->picture->view[l][cascade].active || !at->object->receives || at->object->unlit) return 1.0;
    const double strength = frame->s->lights[l].strength * distance_strength(frame, at);
    return strength > 0.0 ? 1.0 + strength * (blended_attenuation(frame, at, l) - 1.0) : 1.0;
}

static vec3 light_surface(ref_frame *frame, const surface *at, size_t pixel)
{
    vec3 irradiance = vec3_load(frame->s->ambient);
    for (size_t l = 0; l < frame->s->n_lights; l++) {
        const scene_light *light = &frame->s->lights[l];
        const double ndotl = -vec3_dot(at->normal, vec3_load(light->direction));
        const double shadow = ndotl > 0.0 ? shadow_factor(frame, at, l) : 0.0;
        frame->picture->ndotl[l][pixel] = ndotl;
        frame->picture->shadow[l][pixel] = shadow;
        irradiance = vec3_add(irradiance, vec3_scale(vec3_load(light->colour), fmax(0.0, ndotl) * shadow));
    }
    if (at->object->unlit) return at->albedo;
    return (vec3){at->albedo.x * irradiance.x, at->albedo.y * irradiance.y, at->albedo.z * irradiance.z};
}

void ref_light_pixels(ref_frame *frame)
{
    const size_t n_pixels = (size_t)frame->picture->width * (size_t)frame->picture->height;
    for (size_t i = 0; i < n_pixels; i++) {
        vec3 radiance = vec3_load(frame->s->background);
        frame->picture->cascade[i] = -1;
        if (frame->picture->triangle[i] >= 0) {
            const surface at = surface_at(frame, i);
            radiance = light_surface(frame, &at, i);
            frame->picture->cascade[i] = (int8_t)at.selected.here;
            vec3_store(frame->picture->normal + 3 * i, at.normal);
        }
        vec3_store(frame->picture->rgb + 3 * i, radiance);
    }
}
