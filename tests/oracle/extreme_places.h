/* Scenes as the library has them, in other units and at the edge of the coordinate range. */
#ifndef GNOMON_TESTS_EXTREME_PLACES_H
#define GNOMON_TESTS_EXTREME_PLACES_H

#include "extreme_cases.h"
#include "../lib/base/gn_q.h"

/* v * 2^k, halves up */
static inline int32_t scaled(int32_t v, int k)
{
    return k >= 0 ? v * (1 << k) : (int32_t)(((int64_t)v + (1 << (-k - 1))) >> -k);
}

static inline void scale_object(gn_affine *a, int k)
{
    const int exp = a->exp + k, down = exp < 0 ? exp : 0;
    a->exp = exp < 0 ? 0 : exp;
    for (int r = 0; r < 3; r++) {
        a->t_q16[r] = scaled(a->t_q16[r], k);
        for (int c = 0; c < 3; c++) a->m_q30[r][c] = scaled(a->m_q30[r][c], down);
    }
}

/* Another unit of length than the host chose: 2^k of them for one. */
static inline void rescale(fixed_scene *f, int k)
{
    gn_scene *s = &f->scene;
    for (uint32_t o = 0; o < s->n_objects; o++) scale_object(&f->objects[o].to_world, k);
    for (uint32_t l = 0; l < s->n_lights; l++) {
        gn_light *light = &f->lights[l];
        light->near_offset_q16 = scaled(light->near_offset_q16, k);
        if (light->kind == GN_LIGHT_DIRECTIONAL) continue;
        for (int i = 0; i < 3; i++) light->position_q16[i] = scaled(light->position_q16[i], k);
        light->range_q16 = (uint32_t)scaled((int32_t)light->range_q16, k);
        light->near_q16 = scaled(light->near_q16, k);
        light->colour_exp += 2 * k;
    }
    for (int i = 0; i < 3; i++) s->camera.to_world.t_q16[i] = scaled(s->camera.to_world.t_q16[i], k);
    s->camera.near_q16 = scaled(s->camera.near_q16, k);
    s->camera.far_q16 = s->camera.far_q16 > INT32_MAX >> 9 ? INT32_MAX : scaled(s->camera.far_q16, k);
    s->shadow.max_distance_q16 = scaled(s->shadow.max_distance_q16, k);
    s->unit_log2 += k;
    f->world_exp += k;
}

/* Coarser units than the host's lose resolution, 2^-16 of a unit: what the floors allow for. */

static inline void near_too_small(fixed_scene *f)
{
    rescale(f, -13);
}

/* Moves everything so that, along each axis, what is farthest out lies on the border of the range. */
static inline void to_the_edge(fixed_scene *f, const int sign[3], double moved[3])
{
    gn_scene *s = &f->scene;
    for (int i = 0; i < 3; i++) {
        int32_t most = s->camera.to_world.t_q16[i] * sign[i];
        for (uint32_t o = 0; o < s->n_objects; o++) most = gn_max32(most, f->objects[o].to_world.t_q16[i] * sign[i]);
        for (uint32_t l = 0; l < s->n_lights; l++) most = gn_max32(most, f->lights[l].position_q16[i] * sign[i]);
        const int32_t by = ((8192 << 16) - most) * sign[i];
        s->camera.to_world.t_q16[i] += by;
        for (uint32_t o = 0; o < s->n_objects; o++) f->objects[o].to_world.t_q16[i] += by;
        for (uint32_t l = 0; l < s->n_lights; l++)
            if (f->lights[l].kind != GN_LIGHT_DIRECTIONAL) f->lights[l].position_q16[i] += by;
        moved[i] = ldexp(by, -16 - f->world_exp);
    }
}

static inline void move_stage(fixture *f, const double by[3])
{
    for (int i = 0; i < 3; i++) {
        f->s.camera.to_world.m[i][3] += by[i];
        for (size_t o = 0; o < f->s.n_objects; o++) f->objects[o].to_world.m[i][3] += by[i];
        for (size_t l = 0; l < f->s.n_lights; l++) f->lights[l].position[i] += by[i];
    }
}

/* The picture of a stage in a corner of the coordinate range, in 2^k of the host's units, and how far that is. */
static inline engine_picture picture_at_edge(const stage *st, int k, int corner, double moved[3])
{
    const int sign[3] = {corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1};
    fixed_scene fixed;
    engine_picture p;
    quantise(&fixed, st);
    rescale(&fixed, k);
    to_the_edge(&fixed, sign, moved);
    CHECK_EQ_INT(draw_library(&p, &fixed.scene, &st->set), GN_OK);
    quantise_free(&fixed);
    return p;
}

#endif
