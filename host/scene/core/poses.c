/* Poses of a scene, stored and applied. */
#include "poses.h"

size_t poses_count_affines(const scene *s)
{
    size_t n = s->n_objects;
    for (size_t i = 0; i < s->n_objects; i++) n += s->objects[i].n_joints;
    return n;
}

void poses_store(const scene_poses *p, size_t pose_idx, const scene *s)
{
    if (!p->n_objects) return; /* nothing is allocated */
    scene_affine *to = p->affines + pose_idx * p->n_affines;
    for (size_t i = 0; i < p->n_objects; i++) {
        *to++ = s->objects[i].to_world;
        for (size_t k = 0; k < s->objects[i].n_joints; k++) *to++ = s->objects[i].joints[k].now;
    }
}

void poses_apply(const scene_poses *p, size_t pose_idx, scene *s)
{
    if (!p->n_objects) return;
    const scene_affine *from = p->affines + pose_idx * p->n_affines;
    for (size_t i = 0; i < p->n_objects; i++) {
        s->objects[i].to_world = *from++;
        for (size_t k = 0; k < s->objects[i].n_joints; k++) s->objects[i].joints[k].now = *from++;
    }
}
