/* Vertices where a scene's pose has them. */
#include "model.h"

#include <string.h>

#include "vec.h"

void scene_posed(double *out, const scene_mesh *mesh, const scene_object *object, size_t vertex_idx)
{
    const double *at = mesh->pos + 3 * vertex_idx;
    double sum[3] = {0, 0, 0};
    if (object->n_joints == 0) {
        memcpy(out, at, 3 * sizeof *out);
        return;
    }
    for (size_t i = 4 * vertex_idx; i < 4 * vertex_idx + 4; i++) {
        double p[3];
        affine_point(p, &object->joints[mesh->joint[i]].now, at);
        for (int k = 0; k < 3; k++) sum[k] += mesh->weight[i] / 255.0 * p[k];
    }
    memcpy(out, sum, sizeof sum);
}

void scene_vertex(double *out, const scene *s, const scene_object *object, size_t vertex_idx)
{
    double p[3];
    scene_posed(p, &s->meshes[object->mesh_idx], object, vertex_idx);
    affine_point(out, &object->to_world, p);
}

int scene_object_sign(const scene_object *object)
{
    const int sign = affine_sign(&object->to_world);
    for (size_t i = 0; i < object->n_joints; i++) {
        const int joint = affine_sign(&object->joints[i].now);
        if (joint) return sign * joint;
    }
    return sign;
}
