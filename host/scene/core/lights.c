/* Lights that no file placed, and what files leave open about theirs. */
#include "loader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "seen.h"
#include "vec.h"

static const double first_azimuth_deg = -60; /* from the camera's: to its left, so that shadows fall to the side */
static const double next_azimuth_deg = 100;  /* another light of the same kind stands elsewhere */
static const double elevation_deg = 45;
static const double directional_intensity = 0.85;
static const double too_bright = 100;           /* times what shows white as white: no picture is left */
static const double lamp_light = 0.8;           /* of spot and point lights, at the centre of what they light */
static const double spot_distance_radii = 3;    /* far enough that the cone is not wide ... */
static const double point_distance_radii = 1.6; /* ... and near enough that shadows spread */
static const double range_distances = 3;
static const double spot_inner_margin = 1.15,
                    spot_outer_margin = 1.7; /* times the angle that just covers the casters */
static const double near_ratio = 1.0 / 64;
static const double angle_steps = 65536;

void light_set_defaults(scene_light *light)
{
    light->range = HUGE_VAL;
    light->intensity = 1;
    light->mask_channel = -1;
    light->node_idx = SCENE_NONE;
    light->shadow = true;
    light->strength = 1;
    light->bias_normal = 1; /* where it is not automatic */
    light->auto_bias = SCENE_AUTO_BIAS_DEPTH;
}

static double farthest_corner(const double *from, const double *low, const double *high)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double distance = fmax(fabs(low[k] - from[k]), fabs(high[k] - from[k]));
        sum += distance * distance;
    }
    return sqrt(sum);
}

void lights_set_near(scene *s, const scene_poses *poses, const double *low, const double *high)
{
    for (size_t i = 0; i < s->n_lights; i++) {
        scene_light *light = &s->lights[i];
        if (light->kind == SCENE_LIGHT_DIRECTIONAL || light->near > 0) continue;
        double distance = light->range;
        if (i >= poses->n_lights) distance = fmin(distance, farthest_corner(light->position, low, high));
        for (size_t k = 0; i < poses->n_lights && k < poses->n; k++)
            distance = fmin(distance, farthest_corner(poses->light[k * poses->n_lights + i], low, high));
        light->near = near_ratio * fmax(distance, LIGHT_MIN_RANGE);
    }
}

/* What a light gives from afar: a lamp in the scene's middle, as it were at its rim. */
static double brightness(const scene_light *light, const double *centre, double radius)
{
    double away[3], brightest = 0;
    for (int i = 0; i < 3; i++) brightest = fmax(brightest, light->colour[i]);
    if (light->kind == SCENE_LIGHT_DIRECTIONAL) return brightest;
    vec_sub(away, light->position, centre);
    return brightest / fmax(vec_dot(away, away), radius * radius);
}

bool lights_dim(loader *l, const double *centre, double radius)
{
    double most = 0;
    for (size_t i = 0; i < l->s->n_lights; i++) most = fmax(most, brightness(&l->s->lights[i], centre, radius));
    if (most <= too_bright) return true;
    for (size_t i = 0; i < l->s->n_lights; i++)
        for (int k = 0; k < 3; k++) l->s->lights[i].colour[k] *= directional_intensity / most;
    return loader_remark(l, "lights are %.0f times as bright as what shows white: all are dimmed to 1/%.0f", most,
                         most / directional_intensity);
}

static bool is_caster(const scene *s, const scene_object *object, const double *point)
{
    (void)s;
    (void)point;
    return object->caster != SCENE_CASTER_OFF;
}

static const scene_affine *view_of(const scene *s)
{
    return s->stage.moves ? &s->stage.camera : &s->camera.to_world;
}

/* Whose shadow has a chance to be in the picture. Its sides are not known here: a picture wider than tall is taken. */
static bool is_seen_caster(const scene *s, const scene_object *object, const double *point)
{
    const scene_affine *camera = view_of(s);
    double eye[3], axis[3], out[3], local[3];
    affine_column(eye, camera, 3);
    vec_sub(out, point, eye);
    for (int k = 0; k < 3; k++) {
        affine_column(axis, camera, k);
        local[k] = vec_dot(out, axis);
    }
    double depth = -local[2], half = s->camera.half_height > 0 ? s->camera.half_height : depth / s->camera.focal;
    return is_caster(s, object, point) && depth <= s->shadow.max_distance && fabs(local[0]) <= 1.5 * half &&
           fabs(local[1]) <= half;
}

/* What casts; not the ground, which mostly does not, and is far larger than what stands on it. */
static void find_subject(scene *s, const scene_poses *p, bounds *out)
{
    if (bounds_of_poses(out, s, p, is_seen_caster) || bounds_of_poses(out, s, p, is_caster) ||
        bounds_of_poses(out, s, p, NULL))
        return;
    *out = (bounds){.radius = 1}; /* an empty scene */
}

void lights_find_stage(loader *l)
{
    scene_stage *stage = &l->s->stage;
    scene_seen *kept = l->options->seen;
    bounds subject;
    if (!stage->moves) return;
    if (kept && kept->knows_subject) subject = kept->subject;
    else find_subject(l->s, &l->poses, &subject);
    if (kept) {
        kept->knows_subject = true;
        kept->subject = subject;
    }
    memcpy(stage->centre, subject.centre, sizeof stage->centre);
    stage->radius = subject.radius;
}

static double azimuth_of(const scene *s, scene_light_kind kind)
{
    size_t n_before = 0;
    for (size_t i = 0; i < s->n_lights; i++) n_before += s->lights[i].kind == kind;
    double back[3];
    affine_column(back, view_of(s), 2);
    if (hypot(back[0], back[2]) < 1e-9) affine_column(back, view_of(s), 1); /* looking straight up or down */
    double turn_deg = fmod(first_azimuth_deg + next_azimuth_deg * (double)n_before, 360);
    return atan2(back[0], back[2]) + turn_deg * VEC_PI / 180;
}

static void set_white(scene_light *light, double intensity)
{
    for (int i = 0; i < 3; i++) light->colour[i] = intensity;
}

static double whole_steps(double half_angle)
{
    return round(half_angle / VEC_PI * angle_steps) / angle_steps;
}

static void place_lamp(scene_light *light, const double *centre, double radius, const double *towards)
{
    bool spot = light->kind == SCENE_LIGHT_SPOT;
    double radii = spot ? spot_distance_radii : point_distance_radii, distance = radii * radius;
    for (int i = 0; i < 3; i++) light->position[i] = centre[i] + distance * towards[i];
    light->range = fmax(range_distances * distance, LIGHT_MIN_RANGE);
    double ratio = distance * distance / (light->range * light->range), window = 1 - ratio * ratio;
    set_white(light, lamp_light * fmax(distance * distance, 1e-4) / (window * window)); /* MODEL 8, on the axis */
    light->near = near_ratio * light->range;
    if (!spot) return;
    double covers = asin(1 / radii);
    light->inner = whole_steps(spot_inner_margin * covers);
    light->outer = whole_steps(spot_outer_margin * covers);
}

bool lights_add(loader *l, const char *name, scene_light_kind kind)
{
    scene *s = l->s;
    double azimuth = azimuth_of(s, kind), elevation = elevation_deg * VEC_PI / 180;
    const double towards[3] = {cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth)};
    bounds subject;
    scene_light *light = loader_add_light(l, name);
    if (!light) return false;
    light->kind = kind;
    light_set_defaults(light);
    for (int i = 0; i < 3; i++) light->direction[i] = -towards[i];
    set_white(light, directional_intensity);
    if (kind == SCENE_LIGHT_DIRECTIONAL) return true;
    if (s->stage.radius > 0) {
        place_lamp(light, s->stage.centre, s->stage.radius, towards);
        return true;
    }
    find_subject(s, &l->poses, &subject);
    place_lamp(light, subject.centre, subject.radius, towards);
    return true;
}

int scene_add_light(scene *s, scene_light_kind kind, char *error, size_t error_bytes)
{
    static const char *const names[] = {"directional", "spot", "point"};
    loader l = {.s = s, .path = "added light", .error = error, .error_bytes = error_bytes};
    return lights_add(&l, names[kind], kind) ? 0 : -1;
}

void scene_remove_lights(scene *s)
{
    for (size_t i = 0; i < s->n_lights; i++) free(s->lights[i].name);
    free(s->lights);
    s->lights = NULL;
    s->n_lights = 0;
    s->added.light = false;
}
