/* How far gn_pose is from double precision: the library itself is asked, at many times. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../scene/core/vec.h"
#include "rig.h"

enum { CHECKS = 97 }; /* no multiple of what keys are a multiple of */

typedef struct {
    gn_affine *nodes;
    gn_object *objects;
    gn_light *lights;
    gn_camera *cameras;
    scene_affine *exact;
} stage;

static void take(double *most, double v)
{
    if (v > *most) *most = v;
}

static void check_object(rig_error *e, const fixed_rig *r, const stage *st, const gn_rig_link *link)
{
    const gn_affine *got = &st->objects[link->idx].to_world;
    const scene_affine *exact = &st->exact[r->s->objects[link->idx].node_idx];
    const int shift = link->exp - r->frame_exp[link->node];
    double largest = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) take(&largest, fabs(exact->m[i][k]));
    for (int i = 0; i < 3; i++)
        for (int k = 0; largest > 0 && k < 3; k++)
            take(&e->turned, fabs(ldexp(got->m_q30[i][k], got->exp - 30 - shift) - exact->m[i][k]) / largest);
}

static void check_place(rig_error *e, const fixed_rig *r, const int32_t t_q16[3], const scene_affine *exact)
{
    for (int i = 0; i < 3; i++)
        take(&e->moved, fabs(ldexp(t_q16[i], -16) - ldexp(exact->m[i][3], r->world_exp)) / 4096);
}

/* Matrices of joints, and where they take the origin. */
static void check_skin(rig_error *e, const fixed_rig *r, const fixed_scene *f, const stage *st, size_t object_idx)
{
    const scene_object *o = &r->s->objects[object_idx];
    const int shift = f->shift[object_idx];
    for (size_t j = 0; j < o->n_joints; j++) {
        const gn_affine *got = &st->nodes[r->first_joint[object_idx] + j];
        const scene_affine exact = affine_multiply(&st->exact[o->joints[j].node_idx], &o->joints[j].bind);
        double largest = 0;
        check_place(e, r, got->t_q16, &exact);
        for (int k = 0; k < 9; k++) take(&largest, fabs(exact.m[k / 3][k % 3]));
        for (int k = 0; largest > 0 && k < 9; k++)
            take(&e->turned,
                 fabs(ldexp(got->m_q30[k / 3][k % 3], got->exp - 30 - shift) - exact.m[k / 3][k % 3]) / largest);
    }
}

static void check_pose(fixed_rig *r, const fixed_scene *f, const stage *st, size_t clip)
{
    rig_error *e = &r->error[clip];
    for (size_t i = 0; i < r->s->n_objects; i++)
        if (r->first_joint[i] != SCENE_NONE) check_skin(e, r, f, st, i);
    for (size_t i = 0; i < r->fixed.n_links; i++) {
        const gn_rig_link *link = &r->links[i];
        const size_t node = link->kind == GN_RIG_OBJECT  ? r->s->objects[link->idx].node_idx
                            : link->kind == GN_RIG_LIGHT ? r->s->lights[link->idx].node_idx
                                                         : r->s->rig->cameras[link->idx].node;
        const int32_t *t = link->kind == GN_RIG_OBJECT  ? st->objects[link->idx].to_world.t_q16
                           : link->kind == GN_RIG_LIGHT ? st->lights[link->idx].position_q16
                                                        : st->cameras[link->idx].to_world.t_q16;
        check_place(e, r, t, &st->exact[node]);
        if (link->kind == GN_RIG_OBJECT) check_object(e, r, st, link);
    }
}

int rig_measure(fixed_rig *r, const fixed_scene *f, char *error, size_t bytes)
{
    const scene *s = r->s;
    stage st = {calloc(r->fixed.n_nodes + 1U, sizeof(gn_affine)), calloc(s->n_objects + 1, sizeof(gn_object)),
                calloc(s->n_lights + 1, sizeof(gn_light)), calloc(s->rig->n_cameras + 1, sizeof(gn_camera)),
                calloc(s->rig->n_nodes + 1, sizeof(scene_affine))};
    int failed = !st.nodes || !st.objects || !st.lights || !st.cameras || !st.exact;
    for (size_t clip = 0; !failed && clip < r->fixed.n_clips; clip++) {
        for (uint32_t i = 0; !failed && i <= CHECKS; i++) {
            const uint32_t time_q16 = (uint32_t)((uint64_t)r->clips[clip].duration_q16 * i / CHECKS);
            failed = rig_place(s, clip, ldexp(time_q16, -16), st.exact);
            gn_pose(&r->fixed, (uint32_t)clip, time_q16, st.nodes, st.objects, st.lights, st.cameras);
            if (!failed) check_pose(r, f, &st, clip);
        }
    }
    if (failed) snprintf(error, bytes, "out of memory");
    free(st.nodes);
    free(st.objects);
    free(st.lights);
    free(st.cameras);
    free(st.exact);
    return failed ? -1 : 0;
}
