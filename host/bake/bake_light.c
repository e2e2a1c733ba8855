/* What arrives of a light, by rays. */
#include "bake_internal.h"

static double arrives(const baker *b, const ref_triangle *t, const double bary[3], size_t l)
{
    exact_point origin;
    for (int k = 0; k < 3; k++) {
        origin.vertex[k] = t->instance->world[t->idx[k]];
        origin.weight[k] = bary[k];
    }
    return truth_transmittance(&b->tracer, &origin, truth_vertex_error(t), t, &b->s->lights[l]);
}

static vec3 point_of(const ref_triangle *t, const double bary[3])
{
    const vec3 *world = t->instance->world;
    return vec3_mix(bary, world[t->idx[0]], world[t->idx[1]], world[t->idx[2]]);
}

/* Where no light of a channel reaches it may hold anything: lit, so that nothing dark runs into its neighbours. */
void bake_masks_at(const baker *b, const ref_triangle *t, const double bary[3], double mask[BAKE_CHANNELS])
{
    const vec3 at = point_of(t, bary);
    for (int i = 0; i < BAKE_CHANNELS; i++) mask[i] = 1.0;
    for (size_t l = 0; l < b->s->n_lights; l++) {
        if (b->result->fate[l] != BAKE_MASKED || !(ref_light_at(&b->s->lights[l], at).attenuation > 0)) continue;
        mask[b->channel[l]] = fmin(mask[b->channel[l]], arrives(b, t, bary, l));
    }
}

static vec3 normal_of(const ref_triangle *t, const double bary[3])
{
    const vec3 *normal = t->instance->normal;
    vec3 n = {0, 0, 0};
    if (normal) n = vec3_unit(vec3_mix(bary, normal[t->idx[0]], normal[t->idx[1]], normal[t->idx[2]]));
    return vec3_dot(n, n) > 0 ? n : ref_face_normal(t);
}

vec3 bake_light_at(const baker *b, const ref_triangle *t, const double bary[3])
{
    const vec3 at = point_of(t, bary), n = normal_of(t, bary);
    vec3 sum = {0, 0, 0};
    for (size_t l = 0; l < b->s->n_lights; l++) {
        if (b->result->fate[l] != BAKE_WHOLE) continue;
        const scene_light *light = &b->s->lights[l];
        const ref_incidence in = ref_light_at(light, at);
        const double share = in.attenuation * fmax(0.0, vec3_dot(n, in.to_light));
        if (!(share > 0)) continue;
        sum = vec3_add(sum, vec3_scale(vec3_load(light->colour), share * lerp(1.0, arrives(b, t, bary, l), light->strength)));
    }
    return sum;
}
