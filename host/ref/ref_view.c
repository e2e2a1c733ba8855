/* What all light views share: filters and their margins, axes, and the way from the world into the map
 * (MODEL 4, 5, 7). */
#include "ref_internal.h"

#define WIDEST_DISK 8 /* texels */

static int clamp_to_disk(double wanted_radius)
{
    return (int)clamp(ceil(wanted_radius), 1.0, WIDEST_DISK);
}

/* The disk is as wide as its radius needs. [F4] */
int ref_filter_index(scene_filter filter, double wanted_radius)
{
    switch (filter) {
    case SCENE_FILTER_3X3:
        return 1;
    case SCENE_FILTER_5X5:
        return 2;
    case SCENE_FILTER_7X7:
        return 3;
    case SCENE_FILTER_DISK:
        return clamp_to_disk(wanted_radius);
    case SCENE_FILTER_HARD:
    case SCENE_FILTER_2X2:
        break;
    }
    return 0;
}

/* 5x5, 7x7 and the disk are soft. [F5] [A1] */
scene_filter ref_light_filter(const scene_shadow *shadow, const scene_light *light, ref_atlas atlas)
{
    const scene_filter own = atlas == REF_OTHER_ATLAS ? shadow->other_filter : shadow->filter;
    const bool is_soft = own == SCENE_FILTER_5X5 || own == SCENE_FILTER_7X7 || own == SCENE_FILTER_DISK;
    switch (light->softness) {
    case SCENE_SOFT_HARD:
        return own == SCENE_FILTER_HARD ? SCENE_FILTER_HARD : SCENE_FILTER_2X2;
    case SCENE_SOFT_SOFT:
        return is_soft ? own : SCENE_FILTER_5X5;
    case SCENE_SOFT_DEFAULT:
        break;
    }
    return own;
}

void ref_fit_axes(ref_light_view *view, vec3 w)
{
    const vec3 hint = fabs(w.y) < 15.0 / 16.0 ? (vec3){0.0, 1.0, 0.0} : (vec3){1.0, 0.0, 0.0};
    const vec3 u = vec3_unit(vec3_cross(hint, w));
    vec3_store(view->axis[0], u);
    vec3_store(view->axis[1], vec3_cross(w, u));
    vec3_store(view->axis[2], w);
}

static vec3 along_axes(const ref_light_view *view, vec3 p)
{
    return (vec3){vec3_dot(p, vec3_load(view->axis[0])), vec3_dot(p, vec3_load(view->axis[1])),
                  vec3_dot(p, vec3_load(view->axis[2]))};
}

vec3 ref_to_light(const ref_light_view *view, vec3 world)
{
    if (view->perspective) return along_axes(view, vec3_sub(world, vec3_load(view->position)));
    const vec3 p = along_axes(view, world);
    return vec3_sub((vec3){p.x / view->texel, p.y / view->texel, p.z / view->texel}, vec3_load(view->origin));
}

vec3 ref_project(const ref_light_view *view, vec3 p)
{
    if (!view->perspective) return p;
    const double half = view->tile_texels / 2.0, width = p.z * view->t;
    return (vec3){half * (1.0 + p.x / width), half * (1.0 + p.y / width), 1.0 - view->near / p.z};
}

double ref_texel_at(const ref_light_view *view, vec3 in_light)
{
    return view->perspective ? view->texel * in_light.z : view->texel;
}

/* A plane seen edge-on has no finite gradient; one whose normal has nothing along an axis has none along it. */
static double slope(double part, double along)
{
    return fabs(part) > 0.0 ? -part / along : 0.0;
}

/* Perspective: on the plane N . P = c, 1/z = (N_x x/z + N_y y/z + N_z) / c, and x/z grows by a texel at distance 1 per
 * texel. */
vec2 ref_depth_gradient(const ref_light_view *view, vec3 normal, vec3 on_plane)
{
    if (!view->perspective) return (vec2){slope(normal.x, normal.z), slope(normal.y, normal.z)};
    const double c = vec3_dot(normal, on_plane), unit = view->near * view->texel;
    return (vec2){slope(unit * normal.x, c), slope(unit * normal.y, c)};
}
