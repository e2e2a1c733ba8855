/* What arrives of a light, by rays. */
#include "bake_internal.h"

static exact_point origin_of(const ref_triangle *t, const double bary[3])
{
    exact_point origin;
    for (int k = 0; k < 3; k++) {
        origin.vertex[k] = t->instance->world[t->idx[k]];
        origin.weight[k] = bary[k];
    }
    return origin;
}

static double arrives(const baker *b, const ref_triangle *t, const double bary[3], size_t l)
{
    const exact_point origin = origin_of(t, bary);
    return truth_transmittance(&b->tracer, &origin, truth_vertex_error(t), t, &b->s->lights[l]);
}

static vec3 point_of(const ref_triangle *t, const double bary[3])
{
    const vec3 *world = t->instance->world;
    return vec3_mix(bary, world[t->idx[0]], world[t->idx[1]], world[t->idx[2]]);
}

static vec3 normal_of(const ref_triangle *t, const double bary[3])
{
    const vec3 *normal = t->instance->normal;
    vec3 n = {0, 0, 0};
    if (normal) n = vec3_unit(vec3_mix(bary, normal[t->idx[0]], normal[t->idx[1]], normal[t->idx[2]]));
    return vec3_dot(n, n) > 0 ? n : ref_face_normal(t);
}

typedef struct {
    const truth_ray *ray;
    const ref_triangle *from;
    double nearest;
    bool behind; /* what is nearest is met from behind */
} outlook;

static bool meet_nearest(void *user, const truth_caster *c)
{
    outlook *out = user;
    truth_hit hit;
    if (c->source.object == out->from->object && c->source.idx == out->from->idx) return true;
    if (!truth_meets_caster(&hit, out->ray, c, true) || hit.t >= out->nearest) return true;
    out->nearest = hit.t;
    out->behind = hit.front && !c->two_sided; /* it faces where the ray goes */
    return true;
}

static bool meets_a_back(const baker *b, const ref_triangle *t, const exact_point *origin, vec3 direction)
{
    const truth_ray ray =
        truth_make_ray(origin, (exact_target){.at = direction, .infinite = true}, truth_vertex_error(t));
    outlook out = {.ray = &ray, .from = t, .nearest = HUGE_VAL};
    truth_visit(&b->tracer, &ray, meet_nearest, &out);
    return out.behind;
}

/* Wherever one looks from the surface, the first thing is the back of something: the point lies inside it, as a floor
 * does under a chest. */
static bool is_inside(const baker *b, const ref_triangle *t, const double bary[3])
{
    enum { AROUND = 6 };
    const exact_point origin = origin_of(t, bary);
    const vec3 up = ref_face_normal(t),
               x = vec3_unit(vec3_cross(up, fabs(up.y) < 0.9 ? (vec3){0, 1, 0} : (vec3){1, 0, 0}));
    const vec3 y = vec3_cross(up, x);
    if (t->object->two_sided || !meets_a_back(b, t, &origin, up)) return false;
    for (int i = 0; i < AROUND; i++) {
        const double angle = 2 * 3.14159265358979323846 * (i + 0.3) / AROUND;
        const vec3 aside = vec3_add(vec3_scale(x, 2 * cos(angle)), vec3_scale(y, 2 * sin(angle)));
        if (!meets_a_back(b, t, &origin, vec3_unit(vec3_add(up, aside)))) return false;
    }
    return true;
}

/* A surface that looks away from a light gets nothing from it; a little less than edge-on counts, for what is
 * interpolated. */
static bool looks_away(const ref_triangle *t, const double bary[3], vec3 to_light)
{
    if (t->object->two_sided) return false;
    return vec3_dot(normal_of(t, bary), to_light) < -0.02;
}

/* Where no light of a channel can be seen it may hold anything: lit, so that nothing dark runs into its neighbours. */
bool bake_masks_at(const baker *b, const ref_triangle *t, const double bary[3], bool look, double mask[BAKE_CHANNELS])
{
    const vec3 at = point_of(t, bary);
    bool dark = false;
    for (int i = 0; i < BAKE_CHANNELS; i++) mask[i] = 1.0;
    for (size_t l = 0; l < b->s->n_lights; l++) {
        if (b->result->fate[l] != BAKE_MASKED) continue;
        const ref_incidence in = ref_light_at(&b->s->lights[l], at);
        if (!(in.attenuation > 0) || looks_away(t, bary, in.to_light)) continue;
        mask[b->channel[l]] = fmin(mask[b->channel[l]], arrives(b, t, bary, l));
        dark = dark || mask[b->channel[l]] < 1;
    }
    return !look || !dark || !is_inside(b, t, bary); /* what is inside is dark, or it does not matter */
}

vec3 bake_light_at(const baker *b, const ref_triangle *t, const double bary[3])
{
    const vec3 at = point_of(t, bary), n = normal_of(t, bary);
    vec3 sum = {0, 0, 0};
    for (size_t l = 0; l < b->s->n_lights; l++) {
        if (b->result->fate[l] != BAKE_WHOLE) continue;
        const scene_light *light = &b->s->lights[l];
        const ref_incidence in = ref_light_at(light, at);
        const double fraction = in.attenuation * fmax(0.0, vec3_dot(n, in.to_light));
        if (!(fraction > 0)) continue;
        sum = vec3_add(
            sum, vec3_scale(vec3_load(light->colour), fraction * lerp(1.0, arrives(b, t, bary, l), light->strength)));
    }
    return sum;
}
