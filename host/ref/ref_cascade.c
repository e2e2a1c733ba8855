/* Cascades: their spheres in the camera's frustum, which lights have tiles and how their views fit, which cascade a point is looked
 * up in (DESIGN 1.4). */
#include "ref_internal.h"

#define MAX_TILED_LIGHTS 4 /* D1 */
#define MIN_TILE         8 /* A2 */

int ref_filter_index(scene_filter filter)
{
    switch (filter) {
    case SCENE_FILTER_3X3:
        return 1;
    case SCENE_FILTER_5X5:
        return 2;
    case SCENE_FILTER_DISK:
        break;
    case SCENE_FILTER_7X7:
        return 3;
    case SCENE_FILTER_HARD:
    case SCENE_FILTER_2X2:
        break;
    }
    return 0;
}

/* The smallest m * 2^e >= x with 128 <= m <= 255, for x > 0. frexp gives x = f * 2^e with f in [1/2, 1); m = 256 is the same number
 * as 128 * 2 and needs no case of its own. */
static double ceil8(double x)
{
    int e;
    const double f = frexp(x, &e);
    return ldexp(ceil(f * 256.0), e - 8);
}

/* m_i of DESIGN 1.4 */
static double cascade_end(const scene_shadow *shadow, int cascade)
{
    return shadow->max_distance * (cascade < shadow->n_cascades - 1 ? shadow->cascade_ratio[cascade] : 1.0);
}

bool ref_ratios_ascend(const scene_shadow *shadow)
{
    double previous = 0.0;
    for (int i = 0; i < shadow->n_cascades - 1; i++) {
        const double ratio = shadow->cascade_ratio[i];
        if (!(ratio >= previous && ratio <= 1.0)) return false;
        previous = ratio;
    }
    return true;
}

/* The sphere of the slice of the frustum from depth n to m: centre depth c and radius r of DESIGN 1.4. */
static ref_sphere fit_sphere(const scene *s, int cascade, int width, int height)
{
    const double m = cascade_end(&s->shadow, cascade);
    const double n = cascade > 0 ? fmax(s->camera.near, cascade_end(&s->shadow, cascade - 1)) : s->camera.near;
    if (!(m > n)) return (ref_sphere){.empty = true};
    const double q = fmax(1.0 - s->shadow.cascade_fade, 1.0 / 8.0);
    const double k = sqrt((double)width * width + (double)height * height) / (height * s->camera.focal);
    const double a = 1.0 - q * q;
    const double b = n - q * q * m;
    const double big_c = (1.0 + k * k) * (q * q * m * m - n * n);
    double c = m;
    if (big_c > 0.0 && b * b + a * big_c >= 0.0) {
        const double divisor = sqrt(b * b + a * big_c) - b;
        if (divisor > 0.0) c = fmin(m, big_c / divisor);
    }
    const double far_corner = (m - c) * (m - c) + k * k * m * m;
    const double near_corner = ((c - n) * (c - n) + k * k * n * n) / (q * q);

    const ref_camera camera = ref_make_camera(&s->camera, width, height);
    return (ref_sphere){.centre = vec3_add(camera.position, vec3_scale(camera.forward, c)),
                        .radius = sqrt(fmax(far_corner, near_corner))};
}

static void fit_axes(ref_light_view *view, vec3 w)
{
    const vec3 hint = fabs(w.y) < 15.0 / 16.0 ? (vec3){0.0, 1.0, 0.0} : (vec3){1.0, 0.0, 0.0};
    const vec3 u = vec3_unit(vec3_cross(hint, w));
    vec3_store(view->axis[0], u);
    vec3_store(view->axis[1], vec3_cross(w, u));
    vec3_store(view->axis[2], w);
}

/* Integer origins around the sphere's centre; the near offset pulls the depth origin back, and the range grows with it. */
static void fit_grid(ref_light_view *view, double near_offset)
{
    const double half = view->tile_texels / 2.0;
    const double pull = ceil(near_offset / view->texel);
    const vec3 centre = vec3_load(view->sphere_centre);
    for (int i = 0; i < 3; i++) view->origin[i] = floor(vec3_dot(centre, vec3_load(view->axis[i])) / view->texel + 0.5) - half;
    view->origin[2] -= pull;
    view->depth_range = view->tile_texels;
    while (view->depth_range < view->tile_texels + pull) view->depth_range *= 2.0;
}

/* Leaves view->depth alone: the atlas stage owns it. -1 if no finite texel covers the sphere. The factor just below 1 keeps the
 * texel of a radius that is a round number off the edge between two of ceil8's steps. */
int ref_fit_light(ref_light_view *view, const scene *s, const scene_light *light, int cascade, int width, int height,
                  int tile_texels)
{
    const double reach = 2.0 * (ref_filter_index(s->shadow.filter) + 1) * (1.0 + sqrt(2.0) * light->bias_normal);
    const double sphere_texels = fmax(tile_texels - reach - 1.0, tile_texels / 4.0);
    const ref_sphere sphere = fit_sphere(s, cascade, width, height);
    view->active = false;
    if (sphere.empty) return 0;
    view->tile_texels = tile_texels;
    vec3_store(view->sphere_centre, sphere.centre);
    view->sphere_radius = sphere.radius;
    view->texel = ceil8((1.0 - ldexp(1.0, -20)) * 2.0 * view->sphere_radius / sphere_texels);
    if (!isfinite(view->texel) || !(view->texel > 0.0) || !isfinite(light->near_offset)) return -1;
    fit_axes(view, vec3_load(light->direction));
    fit_grid(view, light->near_offset);
    view->active = true;
    return 0;
}

static bool wants_tile(const scene_light *light)
{
    return light->shadow && light->strength > 0.0;
}

/* D1: without a caster, or without a receiver, no light needs a tile. */
static bool shadows_possible(const scene *s)
{
    bool casts = false, receives = false;
    for (size_t i = 0; i < s->n_objects; i++) {
        casts = casts || (s->objects[i].caster != SCENE_CASTER_OFF);
        receives = receives || s->objects[i].receives;
    }
    return casts && receives;
}

/* The atlas is split into 1, 4 or 16 equal tiles (A2); those of empty cascades count. */
static int tile_side(int atlas_texels, int n_tiles)
{
    return n_tiles > 4 ? atlas_texels / 4 : n_tiles > 1 ? atlas_texels / 2 : atlas_texels;
}

const char *ref_fit_lights(ref_frame *frame)
{
    const scene *s = frame->s;
    const int n_cascades = s->shadow.n_cascades, width = frame->picture->width, height = frame->picture->height;
    int n_lights = 0, n_taken = 0;
    for (size_t l = 0; shadows_possible(s) && l < s->n_lights; l++)
        n_lights += wants_tile(&s->lights[l]) && n_lights < MAX_TILED_LIGHTS;
    const int tile_texels = tile_side(frame->options->atlas_size, n_lights * n_cascades);
    if (tile_texels < MIN_TILE) return "shadow tiles of less than 8 texels a side: too many cascades and lights for the atlas";
    for (int c = 0; c < n_cascades; c++) frame->sphere[c] = fit_sphere(s, c, width, height);
    for (size_t l = 0; l < s->n_lights && n_taken < n_lights; l++) {
        if (!wants_tile(&s->lights[l])) continue;
        n_taken++;
        for (int c = 0; c < n_cascades; c++)
            if (ref_fit_light(&frame->picture->view[l][c], s, &s->lights[l], c, width, height, tile_texels))
                return "no light view fits: max distance, near offset or cascade fade out of range";
    }
    return NULL;
}

double ref_fade_factor(double t, double cascade_fade)
{
    const double inner = 1.0 - fmax(cascade_fade, 0.001);
    return clamp((1.0 - t) / (1.0 - inner * inner), 0.0, 1.0);
}

ref_selection ref_select_cascade(const ref_frame *frame, vec3 world)
{
    ref_selection selected = {.here = -1, .next = -1};
    for (int c = 0; c < frame->s->shadow.n_cascades; c++) {
        const ref_sphere *sphere = &frame->sphere[c];
        if (sphere->empty) continue;
        if (selected.here >= 0) {
            selected.next = c;
            break;
        }
        const vec3 d = vec3_sub(world, sphere->centre);
        const double t = vec3_dot(d, d) / (sphere->radius * sphere->radius);
        if (!(t < 1.0)) continue;
        selected.here = c;
        selected.fade = ref_fade_factor(t, frame->s->shadow.cascade_fade);
    }
    return selected;
}

vec3 ref_to_light(const ref_light_view *view, vec3 world)
{
    return (vec3){vec3_dot(world, vec3_load(view->axis[0])) / view->texel - view->origin[0],
                  vec3_dot(world, vec3_load(view->axis[1])) / view->texel - view->origin[1],
                  vec3_dot(world, vec3_load(view->axis[2])) / view->texel - view->origin[2]};
}
