/* What a light's casters leave of it at a point (MODEL 6, without the maps). */
#include "truth.h"

typedef struct {
    const truth_tracer *tracer;
    const truth_ray *ray;
    const ref_triangle *skip;
    double near;          /* of spot and point lights */
    double plane_from;    /* light-plane distance of the origin */
    double transmittance; /* so far */
} passage;

/* M1. Where dither cuts depends on noise that is evenly spread over 0..1: in the mean the fraction 1 - alpha. */
static double passes(const scene *s, const ref_triangle *t, const double bary[3])
{
    switch (t->object->caster) {
    case SCENE_CASTER_CLIP:
        return ref_alpha_cuts(SCENE_ALPHA_CLIP, ref_alpha(s, t, bary), t->object->alpha_cutoff, 0, 0) ? 1.0 : 0.0;
    case SCENE_CASTER_DITHER:
        return 1.0 - clamp(ref_alpha(s, t, bary), 0.0, 1.0);
    case SCENE_CASTER_OFF:
        return 1.0;
    case SCENE_CASTER_ON:
        break;
    }
    return 0.0;
}

static bool meet_caster(void *user, const truth_caster *c)
{
    passage *way = user;
    truth_hit hit;
    if (way->skip && c->source.object == way->skip->object && c->source.idx == way->skip->idx) return true;
    if (!truth_meets_caster(&hit, way->ray, c, c->two_sided)) return true;
    /* P4: the light-plane distance shrinks evenly on the way to the light. Directional lights have no near plane (D9).
     */
    if (!way->ray->target.infinite && !(way->plane_from * (1.0 - hit.t) >= way->near)) return true;
    way->transmittance *= passes(way->tracer->s, &c->source, hit.bary);
    return way->transmittance > 0.0;
}

/* Along the axis of a spot, or of the face of the cube that the point lies in (MODEL 5). */
static double light_plane_distance(const scene_light *light, vec3 point)
{
    const vec3 from_light = vec3_sub(point, vec3_load(light->position));
    double v[3];
    vec3_store(v, from_light);
    if (light->kind == SCENE_LIGHT_SPOT) return vec3_dot(from_light, vec3_load(light->direction));
    return fabs(v[ref_point_face(v) / 2]);
}

double truth_transmittance(const truth_tracer *tracer, const exact_point *origin, double uncertainty,
                           const ref_triangle *skip, const scene_light *light)
{
    const bool directional = light->kind == SCENE_LIGHT_DIRECTIONAL;
    const vec3 at = directional ? vec3_scale(vec3_load(light->direction), -1.0) : vec3_load(light->position);
    const truth_ray ray = truth_make_ray(origin, (exact_target){.at = at, .infinite = directional}, uncertainty);
    passage way = {.tracer = tracer, .ray = &ray, .skip = skip, .near = light->near, .transmittance = 1.0};
    if (!directional) way.plane_from = light_plane_distance(light, ray.from);
    truth_visit(tracer, &ray, meet_caster, &way);
    return way.transmittance;
}
