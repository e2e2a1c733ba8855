#include "turn.h"

#include <math.h>
#include <string.h>

#include "bounds.h"
#include "vec.h"

static const double pitch_limit_deg = 85, sun_tilt_deg = 25, sun_low_deg = 6;

/* v turned around a unit axis, counter-clockwise if the axis points at who looks. */
static void turn(double *v, const double *axis, double angle)
{
    double side[3], along = vec_dot(axis, v);
    vec_cross(side, axis, v);
    for (int i = 0; i < 3; i++) v[i] = v[i] * cos(angle) + side[i] * sin(angle) + axis[i] * along * (1 - cos(angle));
}

/* How far ahead the camera's centre of rotation is: as the scene's middle. A camera within the scene turns about what
 * is near. */
static double pivot_depth(const scene *s, const double *eye, const double *back)
{
    bounds b;
    const double reach = s->shadow.max_distance;
    if (s->stage.radius > 0) memcpy(b.centre, s->stage.centre, sizeof b.centre); /* the same in every frame */
    else if (!bounds_of_scene(&b, s, NULL)) return reach / 2;
    vec_sub(b.centre, eye, b.centre);
    const double depth = vec_dot(b.centre, back);
    return fmin(fmax(depth, reach / 5), fmax(reach / 2, depth < reach ? depth : 0));
}

/* Degrees to the right and upwards around what the camera looks at; it does not go over the top. */
static void turn_camera(scene *s, double yaw, double pitch)
{
    static const double y_axis[3] = {0, 1, 0};
    scene_affine *m = &s->camera.to_world;
    double axis[4][3], pivot[3];
    for (int k = 0; k < 4; k++) affine_column(axis[k], m, k);
    const double depth = pivot_depth(s, axis[3], axis[2]);
    const double now = asin(fmin(fmax(axis[2][1], -1), 1)), limit = pitch_limit_deg * VEC_PI / 180;
    const double wanted = fmin(fmax(now + pitch * VEC_PI / 180, fmin(-limit, now)), fmax(limit, now));
    const double right[3] = {axis[0][0], axis[0][1], axis[0][2]};
    for (int i = 0; i < 3; i++) pivot[i] = axis[3][i] - depth * axis[2][i];
    for (int k = 0; k < 3; k++) {
        turn(axis[k], right, now - wanted);
        turn(axis[k], y_axis, yaw * VEC_PI / 180);
    }
    for (int i = 0; i < 3; i++) axis[3][i] = pivot[i] + depth * axis[2][i];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++) m->m[i][k] = axis[k][i];
}

/* Where the first directional light stands: from the east at 6 over the south to the west at 18; the equator's arc,
 * tilted. */
static void place_sun(scene *s, double hour)
{
    const double low = sun_low_deg * VEC_PI / 180, tilt = sun_tilt_deg * VEC_PI / 180;
    const double arc = fmin(fmax((hour - 6) / 12 * VEC_PI, low), VEC_PI - low);
    for (size_t i = 0; i < s->n_lights; i++) {
        scene_light *l = &s->lights[i];
        if (l->kind != SCENE_LIGHT_DIRECTIONAL) continue;
        l->direction[0] = -cos(arc);
        l->direction[1] = -sin(arc) * cos(tilt);
        l->direction[2] = -sin(arc) * sin(tilt);
        return;
    }
}

void scene_turn(scene *s, const scene_options *options)
{
    if (options->turn) {
        if (options->turn_yaw != 0 || options->turn_pitch != 0) turn_camera(s, options->turn_yaw, options->turn_pitch);
        s->camera.focal *= options->turn_zoom;
    }
    if (options->at_hour) place_sun(s, options->hour);
}
