/* Scenes whose values fall together. random_scene.h draws each value by itself, so two that are equal, or a light in
 * the plane of a surface far from everything small, never came up in 10^6 scenes. Here flat meshes, quarter turns, one
 * scale for the whole scene, lights and cameras in planes, and equal fields are the rule. */
#ifndef GNOMON_TESTS_RANDOM_PLACES_H
#define GNOMON_TESTS_RANDOM_PLACES_H

#include "random_scene.h"

/* -max..max */
static int32_t any_sign(int32_t max)
{
    return pick(-max, max);
}

static int32_t limited_q16(double v)
{
    return v > RANDOM_LIMIT_Q16 ? RANDOM_LIMIT_Q16 : v < -RANDOM_LIMIT_Q16 ? -RANDOM_LIMIT_Q16 : (int32_t)v;
}

/* ---- Meshes, when a scene is made -------------------------------------------------------------------------------- */

/* All vertices in a plane across an axis, on a coarse grid, or in a few places: flat objects, edges that meet,
 * triangles without area. */
static void arrange_mesh(random_scene *g)
{
    const int axis = (int)(rnd() % 3), flat = !one_in(3), coarse = one_in(2);
    const gn_position at = one_in(2) ? 0 : g->pos[axis];
    int32_t most = 1;
    for (int i = 0; i < RANDOM_VERTICES * 3; i++)
        if (g->pos[i] > most) most = g->pos[i];
    const int32_t step = most / 4 + 1;
    for (int i = 0; i < RANDOM_VERTICES * 3; i++) {
        if (coarse) g->pos[i] = (gn_position)(g->pos[i] / step * step);
        if (flat && i % 3 == axis) g->pos[i] = at;
        if (one_in(8)) g->nrm[i] = 0;
    }
    if (one_in(8)) memcpy(g->pos + 3, g->pos, 3 * sizeof *g->pos);
}

/* ---- One scale --------------------------------------------------------------------------------------------------- */

static int reaches_beyond(const random_scene *g, const gn_object *o)
{
    double at[3];
    for (int i = 0; i < RANDOM_VERTICES; i++) {
        place_of(o, g->pos + 3 * i, at);
        for (int k = 0; k < 3; k++)
            if (at[k] > RANDOM_LIMIT_Q16 || at[k] < -RANDOM_LIMIT_Q16) return 1;
    }
    return 0;
}

/* Lengths of the scene times 2^k, away from the camera; all stay within what is allowed. */
static void arrange_scale(random_scene *g, int32_t k)
{
    const double scale = k < 0 ? 1.0 / (1 << -k) : 1 << k;
    gn_camera *camera = &g->scene.camera;
    for (int i = 0; i < 3; i++) {
        const int32_t from = camera->to_world.t_q16[i], to = k < 2 ? from : from >> 3;
        camera->to_world.t_q16[i] = to;
        for (int o = 0; o < RANDOM_OBJECTS; o++) {
            int32_t *at = &g->object[o].to_world.t_q16[i];
            *at = limited_q16(((double)*at - from) * scale + to);
        }
        for (int l = 0; l < GN_MAX_LIGHTS; l++) {
            int32_t *at = &g->light[l].position_q16[i];
            *at = limited_q16(((double)*at - from) * scale + to);
        }
    }
    for (int o = 0; o < RANDOM_OBJECTS; o++) {
        int32_t *exp = &g->object[o].to_world.exp;
        if (*exp < 0 || *exp > 14) continue; /* spoiled */
        *exp = *exp + k < 0 ? 0 : *exp + k > 14 ? 14 : *exp + k;
        while (*exp > 0 && reaches_beyond(g, &g->object[o])) --*exp;
    }
    for (int l = 0; l < GN_MAX_LIGHTS; l++) {
        gn_light *light = &g->light[l];
        const double range = light->range_q16 * scale;
        if (light->range_q16) light->range_q16 = range < 256 ? 256 : range > 4e9 ? UINT32_MAX : (uint32_t)range;
        light->near_q16 = limited_q16(light->near_q16 * scale + 1);
        if (light->range_q16 && (uint32_t)light->near_q16 >= light->range_q16)
            light->near_q16 = (int32_t)(light->range_q16 / 2);
    }
    g->scene.shadow.max_distance_q16 = limited_q16(g->scene.shadow.max_distance_q16 * scale);
    if (g->scene.shadow.max_distance_q16 <= camera->near_q16) g->scene.shadow.max_distance_q16 = RANDOM_LIMIT_Q16;
}

/* ---- Places in planes -------------------------------------------------------------------------------------------- */

/* A point of a triangle's plane: within the triangle, on its edges, or far outside. */
static void place_in_plane(const random_scene *g, const gn_object *o, int32_t out_q16[3])
{
    const uint16_t *idx = g->idx + 3 * (rnd() % RANDOM_TRIANGLES);
    double p[3][3], share[2];
    for (int i = 0; i < 3; i++) place_of(o, g->pos + 3 * (idx[i] % RANDOM_VERTICES), p[i]);
    for (int i = 0; i < 2; i++) share[i] = any_sign(one_in(2) ? 4 : 1 << 20) / (one_in(2) ? 4.0 : 65536.0);
    for (int k = 0; k < 3; k++)
        out_q16[k] = limited_q16(p[0][k] + share[0] * (p[1][k] - p[0][k]) + share[1] * (p[2][k] - p[0][k]));
    for (int k = 0; k < 3; k++) /* just before the plane: lit, at a grazing angle */
        if (one_in(2)) out_q16[k] += one_in(2) ? 1 : -1;
}

/* Along an axis of the world, of the camera, of an edge, or of a plane's normal. */
static void arrange_direction(const random_scene *g, gn_light *l)
{
    const gn_affine *camera = &g->scene.camera.to_world;
    const int k = (int)(rnd() % 3), at = (int)(rnd() % RANDOM_VERTICES);
    const gn_affine *turn = one_in(2) ? camera : &g->object[rnd() % RANDOM_OBJECTS].to_world;
    switch (rnd() % 4) {
    case 0:
        memset(l->direction, 0, sizeof l->direction);
        l->direction[k] = one_in(4) ? (one_in(2) ? INT32_MIN : INT32_MAX) : one_in(2) ? 1 : -1;
        break;
    case 1:
        for (int i = 0; i < 3; i++) l->direction[i] = one_in(2) ? turn->m_q30[i][k] : -turn->m_q30[i][k];
        break;
    case 2:
        for (int i = 0; i < 3; i++) l->direction[i] = g->pos[3 * at + i] / 2 - g->pos[i] / 2;
        l->direction[0] |= 1;
        break;
    default:
        for (int i = 0; i < 3; i++) l->direction[i] = (one_in(2) ? -1 : 1) * (one_in(3) ? 0 : 1 << 20);
        break;
    }
}

/* A field takes the value of another one, or of one beside it. */
static void arrange_equal(random_scene *g)
{
    gn_shadow_settings *s = &g->scene.shadow;
    gn_light *a = &g->light[rnd() % GN_MAX_LIGHTS], *b = &g->light[rnd() % GN_MAX_LIGHTS];
    gn_object *o = &g->object[rnd() % RANDOM_OBJECTS], *p = &g->object[rnd() % RANDOM_OBJECTS];
    switch (rnd() % 8) {
    case 0:
        if (a != b) *a = *b;
        break;
    case 1:
        o->to_world = p->to_world;
        break;
    case 2:
        memcpy(o->to_world.t_q16, p->to_world.t_q16, sizeof o->to_world.t_q16);
        break;
    case 3:
        if (a->range_q16 > 1 && a->range_q16 <= (uint32_t)RANDOM_LIMIT_Q16) a->near_q16 = (int32_t)a->range_q16 - 1;
        break;
    case 4:
        s->max_distance_q16 = g->scene.camera.near_q16 + (one_in(2) ? 1 : 256);
        break;
    case 5:
        for (int i = 0; i < 3; i++) s->cascade_ratio_uq16[i] = one_in(2) ? 0 : 65536;
        break;
    case 6:
        memcpy(g->scene.camera.to_world.t_q16, a->position_q16, sizeof a->position_q16);
        break;
    default:
        a->inner_turn = a->outer_turn = (uint16_t)pick(182, 32587);
        break;
    }
}

/* Many fields at once at the ends of their ranges. */
static void arrange_ends(random_scene *g, gn_light *l)
{
    gn_shadow_settings *s = &g->scene.shadow;
    const uint32_t n = one_in(3) ? 2 : 10; /* most of them, or half of them */
    if (!one_in(n)) l->outer_turn = one_in(4) ? 182 : 32587;
    if (!one_in(n)) l->inner_turn = one_in(2) ? l->outer_turn : 0;
    if (!one_in(n)) l->near_q16 = one_in(4) ? 1 : RANDOM_LIMIT_Q16 >> rnd() % 3;
    if (!one_in(n)) l->range_q16 = one_in(4) ? UINT32_MAX : 0;
    if (GN_AUTO_BIAS && !GN_COMPACT && !one_in(n)) l->auto_bias = (gn_auto_bias)(1 + rnd() % 2);
    if (!GN_COMPACT && one_in(n)) l->colour_exp = one_in(2) ? 100 : -100;
    if (!one_in(n))
        s->filter = s->other_filter = (gn_filter)(one_in(4)           ? GN_FILTER_HARD
                                                  : GN_FILTER_MAX < 4 ? GN_FILTER_MAX
                                                                      : GN_FILTER_7X7);
    if (!one_in(n)) s->penumbra_uq16 = one_in(4) ? 0 : 64 << 16;
    if (!one_in(n)) s->max_distance_q16 = RANDOM_LIMIT_Q16;
}

/* Mostly the first: what is arranged meets there. */
static const gn_object *arranged_object(const random_scene *g)
{
    return &g->object[one_in(2) ? 0 : rnd() % RANDOM_OBJECTS];
}

static void arrange_light(random_scene *g, gn_light *l)
{
    if (one_in(3)) arrange_direction(g, l);
    if (one_in(3)) return;
    place_in_plane(g, arranged_object(g), l->position_q16);
    if (l->kind == GN_LIGHT_DIRECTIONAL && GN_PUNCTUAL_LIGHTS) l->kind = one_in(2) ? GN_LIGHT_SPOT : GN_LIGHT_POINT;
    if (GN_AUTO_BIAS && !GN_COMPACT && one_in(2)) l->auto_bias = (gn_auto_bias)(rnd() % 3);
    if (one_in(2)) arrange_ends(g, l);
    if (l->range_q16 && (uint32_t)l->near_q16 >= l->range_q16) l->near_q16 = (int32_t)(l->range_q16 / 2);
}

/* Before a point of a triangle, so that it is seen: at any distance, or at a scale of the scene. */
static void arrange_camera(random_scene *g)
{
    gn_affine *a = &g->scene.camera.to_world;
    const gn_object *o = arranged_object(g);
    double at[3];
    const double ahead = one_in(4) ? (double)(1 << rnd() % 30) : (double)pick(1 << 14, RANDOM_LIMIT_Q16);
    place_of(o, g->pos + 3 * (g->idx[3 * (rnd() % RANDOM_TRIANGLES)] % RANDOM_VERTICES), at);
    for (int k = 0; k < 3; k++) a->t_q16[k] = limited_q16(at[k] + ahead * a->m_q30[k][2] / (1 << 30));
}

/* Turns by quarters, so that planes of flat meshes lie along axes and places in them are exact. */
static void arrange_turn(gn_affine *a)
{
    const uint16_t yaw = (uint16_t)(rnd() % 4 << 14), pitch = (uint16_t)(rnd() % 4 << 14);
    gn_affine_rotation(a, yaw, pitch, 0);
}

/* After random_scene_make or random_scene_change. `made`: meshes may change, too, as nothing of them is kept. */
static void random_scene_arrange(random_scene *g, int made)
{
    const uint32_t n_lights = g->scene.n_lights < GN_MAX_LIGHTS ? g->scene.n_lights : GN_MAX_LIGHTS;
    if (made && !one_in(3)) arrange_mesh(g);
    for (int i = 0; i < RANDOM_OBJECTS; i++) {
        const int32_t exp = g->object[i].to_world.exp;
        if (one_in(i ? 2 : 8)) continue;
        arrange_turn(&g->object[i].to_world);
        g->object[i].to_world.exp = exp;
    }
    if (one_in(8)) arrange_turn(&g->scene.camera.to_world);
    if (made && one_in(2)) arrange_scale(g, any_sign(14));
    if (one_in(2)) arrange_camera(g);
    for (uint32_t i = 0; i < n_lights; i++)
        if (one_in(2)) arrange_light(g, &g->light[i]);
    if (one_in(8)) place_in_plane(g, &g->object[rnd() % RANDOM_OBJECTS], g->scene.camera.to_world.t_q16);
    while (one_in(3)) arrange_equal(g);
}

#endif
