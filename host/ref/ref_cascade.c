/* Which light has a shadow tile, and the fit of its view to the camera's frustum (DESIGN 1.4). */
#include "ref_internal.h"

#define MAX_TILES 4

int ref_filter_index(scene_filter filter)
{
    switch (filter) {
    case SCENE_FILTER_3X3: return 1;
    case SCENE_FILTER_5X5: return 2;
    case SCENE_FILTER_7X7: return 3;
    case SCENE_FILTER_HARD:
    case SCENE_FILTER_2X2: break;
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

/* The sphere of the slice of the frustum between near and the max distance: centre depth c and radius r of DESIGN 1.4. */
static void fit_sphere(ref_light_view *view, const scene *s, int width, int height)
{
    const double m = s->shadow.max_distance, n = s->camera.near;
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
    view->sphere_radius = sqrt(fmax(far_corner, near_corner));

    const ref_camera camera = ref_make_camera(&s->camera, width, height);
    vec3_store(view->sphere_centre, vec3_add(camera.position, vec3_scale(camera.forward, c)));
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
    for (int i = 0; i < 3; i++)
        view->origin[i] = floor(vec3_dot(centre, vec3_load(view->axis[i])) / view->texel + 0.5) - half;
    view->origin[2] -= pull;
    view->depth_range = view->tile_texels;
    while (view->depth_range < view->tile_texels + pull) view->depth_range *= 2.0;
}

/* Leaves view->depth alone: the atlas stage owns it. -1 if no finite texel covers the sphere. The factor just below 1 keeps the
 * texel of a radius that is a round number off the edge between two of ceil8's steps. */
int ref_fit_light(ref_light_view *view, const scene *s, const scene_light *light, int width, int height, int tile_texels)
{
    const double reach = 2.0 * (ref_filter_index(s->shadow.filter) + 1) * (1.0 + sqrt(2.0) * light->bias_normal);
    view->tile_texels = tile_texels;
    fit_sphere(view, s, width, height);
    const double sphere_texels = fmax(tile_texels - reach - 1.0, tile_texels / 4.0);
    view->texel = ceil8((1.0 - ldexp(1.0, -20)) * 2.0 * view->sphere_radius / sphere_texels);
    if (!isfinite(view->texel) || !(view->texel > 0.0) || !isfinite(light->near_offset)) return -1;
    fit_axes(view, vec3_load(light->direction));
    fit_grid(view, light->near_offset);
    view->active = true;
    return 0;
}

static bool wants_tile(const scene_light *light) { return light->shadow && light->strength > 0.0; }

const char *ref_fit_lights(ref_frame *frame)
{
    const scene *s = frame->s;
    int n_wanted = 0, n_taken = 0;
    for (size_t l = 0; l < s->n_lights; l++) n_wanted += wants_tile(&s->lights[l]);
    const int tile_texels = n_wanted > 1 ? frame->options->atlas_size / 2 : frame->options->atlas_size;
    for (size_t l = 0; l < s->n_lights && n_taken < MAX_TILES; l++) {
        if (!wants_tile(&s->lights[l])) continue;
        n_taken++;
        if (ref_fit_light(&frame->picture->view[l], s, &s->lights[l], frame->picture->width, frame->picture->height, tile_texels))
            return "no light view fits: max distance, near offset or cascade fade out of range";
    }
    return NULL;
}

vec3 ref_to_light(const ref_light_view *view, vec3 world)
{
    return (vec3){vec3_dot(world, vec3_load(view->axis[0])) / view->texel - view->origin[0],
                  vec3_dot(world, vec3_load(view->axis[1])) / view->texel - view->origin[1],
                  vec3_dot(world, vec3_load(view->axis[2])) / view->texel - view->origin[2]};
}
