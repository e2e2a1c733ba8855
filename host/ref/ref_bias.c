/* Receiver bias: the offset of every kind (MODEL 4, 5), and the automatic one (MODEL 7). */
#include "ref_internal.h"

#define COORDINATE_LSB 0x1p-16 /* of texels */
#define PLANE_ERROR    0x1p-12 /* of planes through far corners of large casters, texels */
#define PLACE_UNITS    8.0     /* roundings of a point and of its triangle's corners, in units of length */
#define LEAST_SLOPE    0.5     /* depth form: of both slopes together */
#define MAX_RATIO      2.0     /* of the light-plane distance: farther no point is moved along its normal */

static double half_cell(int bits)
{
    return bits > 0 ? ldexp(1.0, -bits - 1) : 0.0;
}

/* delta */
static double tap_error(const ref_options *o)
{
    return half_cell(o->shadow_subpixel_bits) + half_cell(o->weight_bits) + 2.0 * COORDINATE_LSB;
}

/* R */
static double tap_radius(const ref_light_view *view)
{
    if (view->filter == SCENE_FILTER_HARD) return 0.5;
    if (view->filter == SCENE_FILTER_DISK) return view->disk_radius + 0.5;
    return view->filter_index + 1.0;
}

static int view_bits(const ref_options *o, const ref_light_view *view)
{
    return view->perspective || view->clear_border ? o->other_depth_bits : o->depth_bits;
}

/* e: a fraction of the range */
static double step_error(const ref_options *o, const ref_light_view *view)
{
    const int bits = view_bits(o, view);
    if (bits <= 0) return 0.0;
    const double receiver = bits < 32 ? half_cell(bits + o->shadow_depth_frac) : 0.0;
    return half_cell(bits) + receiver +
           ldexp((view->tile_rows > view->tile_texels ? view->tile_rows : view->tile_texels) + 2.0, -32) +
           ldexp(1.0, -29);
}

/* Relative: of view depths, and of the quotients x/z, y/z, n/z of perspective views. */
static double depth_error(const ref_options *o)
{
    return o->newton_steps == 1 ? ldexp(1.0, -17) : o->newton_steps == 2 ? ldexp(1.0, -28) : 0.0;
}
/* Of a pixel's ray, whose three coefficients along each axis are rounded, relative to a point's depth. */
static double ray_error(const ref_options *o)
{
    return o->newton_steps > 0 ? ldexp(o->width + o->height, -28) : 0.0;
}

static double quotient_error(const ref_options *o)
{
    return o->newton_steps == 1 ? ldexp(1.0, -17) : o->newton_steps == 2 ? ldexp(1.0, -29) : 0.0;
}

double ref_lateral_margin(const ref_options *options, const ref_light_view *view, const scene_light *light)
{
    if (light->auto_bias == SCENE_AUTO_BIAS_OFF)
        return sqrt(2.0) * light->bias_normal + light->bias_receiver[2] + light->bias_receiver[3];
    if (light->auto_bias == SCENE_AUTO_BIAS_DEPTH) return 0.0;
    const int bits = view_bits(options, view);
    return sqrt(2.0) * (1.0 + tap_error(options)) + (bits > 0 ? ldexp(view->tile_texels, -bits) : 0.0);
}

/* eta: how far off its plane a point at a view depth may be, in units of the world. */
static double place_error(const ref_frame *frame, double view_depth)
{
    const ref_camera *camera = &frame->camera;
    const double x = camera->half_width_px / camera->focal_px, y = camera->half_height_px / camera->focal_px;
    if (camera->parallel) { /* the picture's half-diagonal over half its height is what x and y are in perspective */
        const double half_height = camera->half_height_px / camera->focal_px;
        return (view_depth + half_height) * sqrt(1.0 + (x * x + y * y) / (half_height * half_height)) *
                   (depth_error(frame->options) + ray_error(frame->options)) +
               PLACE_UNITS * frame->options->unit;
    }
    return view_depth * sqrt(1.0 + x * x + y * y) * (depth_error(frame->options) + ray_error(frame->options)) +
           PLACE_UNITS * frame->options->unit;
}

/* The farthest view depth that is looked up in a directional view. */
static double farthest(const ref_frame *frame, const ref_light_view *view)
{
    const double max = frame->s->shadow.max_distance;
    if (view->clear_border) return max;
    const vec3 d = vec3_sub(vec3_load(view->sphere_centre), frame->camera.position);
    return fmin(max, vec3_dot(d, frame->camera.forward) + view->sphere_radius);
}

/* Slopes are no steeper than twice the range: half of that lets all be lit. */
static double steepness(double part, double along, double max)
{
    return fabs(part) > 0.0 ? fmin(max, fabs(part / along)) : 0.0;
}

static vec3 ortho_bias(const ref_frame *frame, const ref_light_view *view, scene_auto_bias form, vec3 n)
{
    const double error = place_error(frame, farthest(frame, view)) / view->texel + PLANE_ERROR;
    const double radius = tap_radius(view) + tap_error(frame->options) + error, max = 2.0 * view->depth_range;
    const double step = view->depth_range * step_error(frame->options, view) + 3.0 * COORDINATE_LSB + error;
    if (form == SCENE_AUTO_BIAS_NORMAL && fmax(fabs(n.x), fabs(n.y)) > max * fabs(n.z))
        return (vec3){0.0, 0.0, -2.0 * max};
    if (form == SCENE_AUTO_BIAS_NORMAL) return vec3_scale(n, radius * (fabs(n.x) + fabs(n.y)) + step * fabs(n.z));
    const double slopes = fmax(LEAST_SLOPE, steepness(n.x, n.z, max) + steepness(n.y, n.z, max));
    return (vec3){0.0, 0.0, -radius * slopes - step};
}

/* Of depths in a perspective view: steps over the tile, and the plane that is stepped. */
static double plane_error(const ref_options *o, const ref_light_view *view)
{
    return view_bits(o, view) > 0 ? ldexp(64.0, -32) : 0.0;
}

static vec3 persp_bias(const ref_frame *frame, const ref_light_view *view, scene_auto_bias form, vec3 m, vec3 point,
                       double view_depth, double *less)
{
    const ref_options *o = frame->options;
    const double radius = tap_radius(view) + tap_error(o) + view->tile_texels / 2.0 * quotient_error(o);
    const double across = fabs(m.x) + fabs(m.y), lift = place_error(frame, view_depth), h = fabs(vec3_dot(m, point));
    *less = step_error(o, view) + quotient_error(o) + plane_error(o, view);
    const double a = radius * view->texel * across + *less * h / view->near, left = 1.0 - a * fmax(0.0, m.z),
                 ratio = a / left;
    if (form == SCENE_AUTO_BIAS_DEPTH || a > MAX_RATIO || left < 0.5 || ratio > MAX_RATIO) {
        *less += fmin(2.0, radius * view->near * view->texel * fmax(LEAST_SLOPE, across) / h);
        return vec3_scale(m, lift);
    }
    *less = view->near * view->texel * fmax(fabs(m.x), fabs(m.y)) > 2.0 * h ? 2.0 : 0.0;
    return vec3_scale(m, lift + point.z * ratio);
}

/* The least bias that leaves a plane without a shadow of its own, in two forms. [B6] */
vec3 ref_auto_bias(const ref_frame *frame, const ref_light_view *view, scene_auto_bias form, const ref_surface *at,
                   vec3 in_light, double *less)
{
    const vec3 ray = frame->camera.parallel ? frame->camera.forward : vec3_sub(at->world, frame->camera.position);
    const vec3 face = vec3_dot(at->face, ray) > 0.0 ? vec3_scale(at->face, -1.0) : at->face;
    const vec3 n = {vec3_dot(face, vec3_load(view->axis[0])), vec3_dot(face, vec3_load(view->axis[1])),
                    vec3_dot(face, vec3_load(view->axis[2]))};
    *less = 0.0;
    if (!view->perspective) return ortho_bias(frame, view, form, n);
    return persp_bias(frame, view, form, n, in_light, at->view_depth, less);
}
