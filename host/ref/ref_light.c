/* The light that each pixel's surface sends to the camera (MODEL 3). */
#include "ref_internal.h"

/* Blinn and Phong: the fraction of a light that is mirrored towards the camera, for n . L > 0. [M3] */
static double highlight(const ref_frame *frame, const ref_surface *at, vec3 to_light)
{
    const ref_camera *camera = &frame->camera;
    const vec3 to_camera =
        camera->parallel ? vec3_scale(camera->forward, -1.0) : vec3_unit(vec3_sub(camera->position, at->world));
    const double ndoth = vec3_dot(at->normal, vec3_unit(vec3_add(to_light, to_camera)));
    return pow(fmax(0.0, ndoth), ldexp(1.0, at->triangle.object->shininess_log2));
}

/* At the rim of a cone or a range the library's light ends a rounding earlier or later: what is darker than this
 * fraction of the light is not shown (MODEL 10). */
#define RIM 0x1p-20

static bool at_rim(const scene_light *light, const ref_surface *at, double attenuation)
{
    const vec3 v = vec3_sub(vec3_load(light->position), at->world);
    return light->kind != SCENE_LIGHT_DIRECTIONAL && attenuation * fmax(vec3_dot(v, v), 1e-4) < RIM;
}

/* Knob vertex_light, directional lights: the cosines at the vertices, none below 0, interpolated. */
static double vertex_cosine(const ref_surface *at, vec3 to_light)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        const double ndotl = vec3_dot(at->triangle.instance->normal[at->triangle.idx[k]], to_light);
        sum += at->bary[k] * fmax(0.0, at->behind ? -ndotl : ndotl);
    }
    return sum;
}

static double cosine(const ref_frame *frame, const ref_surface *at, size_t l, vec3 to_light)
{
    const bool interpolate = frame->options->vertex_light && at->triangle.instance->normal &&
                             frame->s->lights[l].kind == SCENE_LIGHT_DIRECTIONAL;
    return interpolate ? vertex_cosine(at, to_light) : vec3_dot(at->normal, to_light);
}

/* What one light adds. Lights that contribute nothing anywhere near leave n . L at -1. [P10] */
static vec3 add_light(ref_frame *frame, const ref_surface *at, size_t l, size_t pixel)
{
    const vec3 none = {0.0, 0.0, 0.0}, specular = vec3_load(at->triangle.object->specular);
    ref_picture *picture = frame->picture;
    if (!at->layer) picture->ndotl[l][pixel] = -1.0;
    if (!at->triangle.instance->lit[l]) return none;
    const ref_incidence incidence = ref_light_at(&frame->s->lights[l], at->world);
    if (!(incidence.attenuation > 0.0)) return none;
    const double ndotl = cosine(frame, at, l, incidence.to_light);
    const bool shown = !at->layer && !at_rim(&frame->s->lights[l], at, incidence.attenuation);
    if (shown) picture->ndotl[l][pixel] = ndotl;
    if (!(ndotl > 0.0)) return none;
    const double shadow = ref_shadow(frame, at, l, incidence.to_light);
    if (shown) picture->shadow[l][pixel] = shadow;
    vec3 reflected = vec3_scale(at->albedo, ndotl);
    if (vec3_dot(specular, specular) > 0.0)
        reflected = vec3_add(reflected, vec3_scale(specular, highlight(frame, at, incidence.to_light)));
    return vec3_scale(vec3_mul(vec3_load(frame->s->lights[l].colour), reflected), incidence.attenuation * shadow);
}

/* Ambient, baked light, what each light adds and the surface emits. [M2] [M9] [M10] */
static vec3 light_surface(ref_frame *frame, const ref_surface *at, size_t pixel)
{
    const ref_triangle *t = &at->triangle;
    vec3 irradiance = vec3_load(frame->s->ambient);
    if (t->object->baked) irradiance = vec3_add(irradiance, ref_mix_vertices(t->object->baked, t->idx, at->bary));
    vec3 radiance = vec3_mul(at->albedo, irradiance);
    for (size_t l = 0; l < frame->s->n_lights; l++) radiance = vec3_add(radiance, add_light(frame, at, l, pixel));
    radiance = vec3_add(radiance, ref_emitted(frame, t, at->bary, at->view_depth));
    return t->object->unlit ? at->albedo : radiance;
}

/* Of a row of pixels, at its middle. [R11] */
static vec3 background_at(const ref_frame *frame, int row)
{
    const vec3 top = vec3_load(frame->s->background), bottom = vec3_load(frame->s->background_bottom);
    const double t = (row + 0.5) / frame->picture->height;
    return frame->s->gradient ? vec3_add(vec3_scale(top, 1.0 - t), vec3_scale(bottom, t)) : top;
}

/* Transparent surfaces over what is behind them. What has no alpha is hidden or none. [M8] */
static vec3 add_layers(ref_frame *frame, size_t pixel, vec3 radiance)
{
    ref_picture *p = frame->picture;
    vec3_store(p->solid + 3 * pixel, radiance);
    for (int k = p->n_layers - 1; k >= 0; k--) {
        ref_layer *layer = &p->layer[pixel * (size_t)p->n_layers + (size_t)k];
        if (!(layer->alpha > 0.0)) continue;
        const ref_hit hit = {.bary = {layer->bary[0], layer->bary[1], layer->bary[2]}, .behind = layer->behind};
        ref_surface at = ref_surface_of(frame, pixel, layer->triangle, &hit, layer->depth);
        at.layer = true;
        const vec3 front = light_surface(frame, &at, pixel);
        vec3_store(layer->rgb, front);
        radiance = vec3_add(vec3_scale(front, layer->alpha), vec3_scale(radiance, 1.0 - layer->alpha));
    }
    return radiance;
}

/* Also what the views of cascades and normals show. [A6] */
void ref_light_pixels(ref_frame *frame)
{
    const size_t n_pixels = (size_t)frame->picture->width * (size_t)frame->picture->height;
    for (size_t i = 0; i < n_pixels; i++) {
        vec3 radiance = background_at(frame, (int)(i / (size_t)frame->picture->width));
        frame->picture->cascade[i] = -1;
        if (frame->picture->triangle[i] >= 0) {
            const ref_surface at = ref_surface_at(frame, i);
            radiance = light_surface(frame, &at, i);
            frame->picture->cascade[i] = (int8_t)at.selected.here;
            vec3_store(frame->picture->normal + 3 * i, at.normal);
        }
        if (frame->picture->n_layers) radiance = add_layers(frame, i, radiance);
        vec3_store(frame->picture->rgb + 3 * i, radiance);
    }
}
