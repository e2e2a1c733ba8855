/* Spot and point lights: attenuation, which objects they reach, light lists, and their perspective views
 * (MODEL 5, 8). */
#include "ref_internal.h"

#define LEAST_DISTANCE2 1e-4 /* keeps the light's own position finite */
#define LEAST_RANGE2    1e-4
#define LEAST_CONE      1e-4 /* difference of cosines */
#define STEEPEST        50.0 /* tan theta of receiver bias */
#define MAX_NEAR        1e9  /* where a view sees none of the receivers */
#define WIDEST          2.0  /* the largest half-width of a face */
#define PI              3.14159265358979323846

/* 1 / distance^2, faded out towards the light's range. [P2] */
double ref_distance_factor(const scene_light *light, double distance2)
{
    const double ratio = isinf(light->range) ? 0.0 : distance2 / fmax(light->range * light->range, LEAST_RANGE2);
    const double window = fmax(0.0, 1.0 - ratio * ratio);
    return window * window / fmax(distance2, LEAST_DISTANCE2);
}

/* Inner and outer are edge to edge, in turns: half of one is pi times as many radians. [P3] */
static double cone_factor(const scene_light *light, vec3 to_light)
{
    if (light->kind != SCENE_LIGHT_SPOT) return 1.0;
    const double outer = cos(PI * light->outer), scale = 1.0 / fmax(cos(PI * light->inner) - outer, LEAST_CONE);
    const double ratio = clamp(scale * (-vec3_dot(to_light, vec3_load(light->direction)) - outer), 0.0, 1.0);
    return ratio * ratio;
}

/* Where the light is from a point, and what of it arrives. [P1] */
ref_incidence ref_light_at(const scene_light *light, vec3 p)
{
    if (light->kind == SCENE_LIGHT_DIRECTIONAL)
        return (ref_incidence){.to_light = vec3_scale(vec3_load(light->direction), -1.0), .attenuation = 1.0};
    const vec3 v = vec3_sub(vec3_load(light->position), p);
    const vec3 to_light = vec3_unit(v);
    if (!(vec3_dot(to_light, to_light) > 0.0)) return (ref_incidence){.attenuation = 0.0};
    return (ref_incidence){.to_light = to_light,
                           .attenuation = ref_distance_factor(light, vec3_dot(v, v)) * cone_factor(light, to_light)};
}

double ref_light_attenuation(const scene_light *light, const double point[3])
{
    return ref_light_at(light, vec3_load(point)).attenuation;
}

/* ---- which objects ---- */

double ref_box_distance2(const ref_instance *instance, vec3 p)
{
    const vec3 d = vec3_sub(p, instance->box_centre), half = instance->box_half;
    const vec3 out = {fmax(0.0, fabs(d.x) - half.x), fmax(0.0, fabs(d.y) - half.y), fmax(0.0, fabs(d.z) - half.z)};
    return vec3_dot(out, out);
}

bool ref_reaches(const scene_light *light, const ref_instance *instance)
{
    if (light->kind == SCENE_LIGHT_DIRECTIONAL) return true;
    return sqrt(ref_box_distance2(instance, vec3_load(light->position))) < light->range;
}

/* The largest colour channel times the distance factor: what lights are ranked by. */
static double importance(const scene_light *light, const ref_instance *instance)
{
    const double largest = fmax(light->colour[0], fmax(light->colour[1], light->colour[2]));
    return largest * ref_distance_factor(light, ref_box_distance2(instance, vec3_load(light->position)));
}

static bool is_candidate(const scene_light *light, const ref_instance *instance)
{
    return light->kind != SCENE_LIGHT_DIRECTIONAL && light->mode != SCENE_BAKED && ref_reaches(light, instance);
}

/* The most important candidate that is not in the list yet; ties: the first. SCENE_NONE: there is none. */
static size_t next_in_list(const scene *s, const ref_instance *instance)
{
    size_t best = SCENE_NONE;
    double best_importance = 0.0;
    for (size_t l = 0; l < s->n_lights; l++) {
        if (instance->lit[l] || !is_candidate(&s->lights[l], instance)) continue;
        const double e = importance(&s->lights[l], instance);
        if (best != SCENE_NONE && !(e > best_importance)) continue;
        best = l;
        best_importance = e;
    }
    return best;
}

/* Baked lights are in the vertices already: they take no place. [P9] */
void ref_list_lights(ref_frame *frame)
{
    const scene *s = frame->s;
    for (size_t o = 0; o < s->n_objects; o++) {
        ref_instance *instance = &frame->instances[o];
        const size_t limit = s->shadow.object_lights > 0 ? (size_t)s->shadow.object_lights : s->n_lights;
        for (size_t l = 0; l < s->n_lights; l++)
            instance->lit[l] = s->lights[l].kind == SCENE_LIGHT_DIRECTIONAL && s->lights[l].mode != SCENE_BAKED;
        for (size_t i = 0; i < limit; i++) {
            const size_t l = next_in_list(s, instance);
            if (l == SCENE_NONE) break;
            instance->lit[l] = true;
        }
    }
}

/* ---- views ---- */

/* The cube's face that a point lies in. [P5] */
int ref_point_face(const double from_light[3])
{
    const double x = fabs(from_light[0]), y = fabs(from_light[1]), z = fabs(from_light[2]);
    const int axis = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
    return 2 * axis + (from_light[axis] < 0.0);
}

/* The smaller root of a t^2 - b t + 1, as 2 / (b + sqrt(b^2 - 4 a)): it does not cancel, and is 1 / b where a = 0. [P6]
 */
double ref_face_half_width(int filter_index, double nu, int tile_texels, bool *clamped)
{
    const double big_a = 2.0 * (filter_index + 1) / tile_texels;
    const double p = nu / sqrt(2.0) * big_a;
    const double a = p * (1.0 - big_a), b = 1.0 - p - big_a;
    const double under_root = b * b - 4.0 * a;
    const double t = b > 0.0 && under_root >= 0.0 ? 2.0 / (b + sqrt(under_root)) : HUGE_VAL;
    *clamped = !(t >= 1.0 && t <= WIDEST);
    return *clamped ? WIDEST : t;
}

static vec3 face_axis(int face)
{
    double w[3] = {0.0, 0.0, 0.0};
    w[face / 2] = face % 2 ? -1.0 : 1.0;
    return vec3_load(w);
}

/* The largest m * 2^e <= x with m in {4, 5, 6, 7}. */
static double floor3(double x)
{
    int e;
    const double f = frexp(x, &e);
    return ldexp(floor(f * 8.0), e - 3);
}

/* n of MODEL 5: bias takes no receiver that is seen nearer than that. [D12] */
static double depth_near(const ref_light_view *view, const scene_light *light, const ref_options *options,
                         const ref_seen *seen)
{
    const double *b = light->bias_receiver;
    const double reach = 1.0 + ref_lateral_margin(options, view, light) + b[0] + STEEPEST * b[1];
    const double texels = (view->filter_index + 1) * reach;
    return fmax(light->near, floor3(fmin(seen->lo[2], MAX_NEAR) * fmax(1.0 / 8.0, 1.0 - texels * view->texel)));
}

/* The perspective view of a spot, or of a face of a point light. [P4] */
int ref_fit_face(ref_light_view *view, const scene *s, const scene_light *light, int face, const ref_options *options,
                 int tile_texels, const ref_seen *seen)
{
    const bool point = light->kind == SCENE_LIGHT_POINT;
    const double wanted_radius = 0.004 * s->shadow.penumbra * tile_texels;
    view->active = false;
    view->perspective = true;
    view->clear_border = view->tight = view->clamped = false;
    view->tile_texels = view->tile_rows = tile_texels;
    view->filter = ref_light_filter(&s->shadow, light, REF_OTHER_ATLAS);
    view->filter_index = ref_filter_index(view->filter, wanted_radius);
    view->disk_radius = fmin(wanted_radius, view->filter_index);
    vec3_store(view->position, vec3_load(light->position));
    view->clip = view->near = light->near;
    view->depth_range = 1.0;
    view->t = point ? ref_face_half_width(view->filter_index, ref_lateral_margin(options, view, light), tile_texels,
                                          &view->clamped)
                    : fmax(tan(PI * light->outer), tile_texels / 65535.0);
    view->texel = 2.0 * view->t / tile_texels;
    ref_fit_axes(view, point ? face_axis(face) : vec3_load(light->direction));
    if (seen && seen->any) view->near = depth_near(view, light, options, seen);
    if (!isfinite(view->t) || !(view->t > 0.0) || !isfinite(view->near) || !(view->near > 0.0)) return -1;
    view->active = true;
    return 0;
}

int ref_fit_punctual(ref_light_view *view, const scene *s, const scene_light *light, int face, int tile_texels)
{
    const ref_options options = {.width = 1, .height = 1};
    return ref_fit_face(view, s, light, face, &options, tile_texels, NULL);
}
