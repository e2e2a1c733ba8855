/* Skins: joints as fixed point, and of each vertex as many as some vertex has. */
#include <stdlib.h>
#include <string.h>

#include "quantise_internal.h"

/* Joints with a weight, first; the others' weights are 0. Returns how many. */
static size_t pack_vertex(uint8_t joint[4], uint8_t weight[4], const scene_mesh *mesh, size_t vertex_idx)
{
    size_t n = 0;
    memset(joint, 0, 4);
    memset(weight, 0, 4);
    for (size_t i = 4 * vertex_idx; i < 4 * vertex_idx + 4; i++) {
        if (mesh->weight[i] == 0) continue;
        joint[n] = mesh->joint[i];
        weight[n++] = mesh->weight[i];
    }
    return n;
}

static int pack_vertices(gn_skin *out, const scene_mesh *mesh)
{
    uint8_t joint[4], weight[4], *joint_idx = malloc(4 * mesh->n_vertices + 1),
                                 *weight_u8 = malloc(4 * mesh->n_vertices + 1);
    out->joint_idx = joint_idx;
    out->weight_u8 = weight_u8;
    out->per_vertex = 1;
    if (!joint_idx || !weight_u8) return -1;
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        const size_t n = pack_vertex(joint, weight, mesh, i);
        if (n > out->per_vertex) out->per_vertex = (uint8_t)n;
    }
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        pack_vertex(joint, weight, mesh, i);
        memcpy(joint_idx + out->per_vertex * i, joint, out->per_vertex);
        memcpy(weight_u8 + out->per_vertex * i, weight, out->per_vertex);
    }
    return 0;
}

int quantise_skin(gn_skin *out, const scene_mesh *mesh, const scene_object *o, int shift, int world_exp, char *error,
                  size_t error_bytes)
{
    gn_affine *joint = malloc(o->n_joints * sizeof *joint);
    out->joint = joint;
    out->n_joints = (uint16_t)o->n_joints;
    if (!joint || pack_vertices(out, mesh)) return quantise_no_memory(error, error_bytes);
    for (size_t i = 0; i < o->n_joints; i++) {
        if (!quantise_affine(&joint[i], &o->joints[i].now, shift, world_exp)) continue;
        snprintf(error, error_bytes, "object '%s': scale of joint %zu too large", o->name, i);
        return -1;
    }
    return 0;
}

void quantise_free_skin(gn_skin *skin)
{
    free((void *)(uintptr_t)skin->joint);
    free((void *)(uintptr_t)skin->joint_idx);
    free((void *)(uintptr_t)skin->weight_u8);
    *skin = (gn_skin){0};
}
