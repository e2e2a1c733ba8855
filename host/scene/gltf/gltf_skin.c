/* Skins: the joints that move a mesh's vertices. [R12]
 *
 * A joint takes a vertex from the mesh's space by its inverse bind matrix to its own, and by its node to the world. The
 * node that has the mesh does not count: so the format says. */
#include "gltf.h"

#include <math.h>
#include <string.h>

#include "../core/vec.h"

enum { JOINTS_MAX = 256 };

/* Column-major, as node matrices are; identities where the file gives none. */
static bool read_binds(gltf *g, const json_value *json, size_t n, scene_joint *out)
{
    size_t accessor = GLTF_NONE;
    gltf_array a = {0};
    const json_value *where = json_get(json, "inverseBindMatrices");
    if (!gltf_get_ref(g, json, "inverseBindMatrices", g->accessors, &accessor)) return false;
    if (where && !gltf_read_accessor(g, accessor, &a)) return false;
    if (a.count > 0 && (a.n_components != 16 || a.count < n))
        return gltf_fail(g, where, "%zu MAT4 are expected, one per joint", n);
    for (size_t i = 0; i < n; i++) {
        const double *m = a.values ? a.values + 16 * i : NULL;
        out[i].bind = affine_identity();
        if (m && fabs(m[3]) + fabs(m[7]) + fabs(m[11]) + fabs(m[15] - 1) > 1e-6)
            return gltf_fail(g, where, "matrix %zu: the last row is not 0 0 0 1", i);
        for (int r = 0; m && r < 3; r++)
            for (int c = 0; c < 4; c++) out[i].bind.m[r][c] = m[4 * c + r];
    }
    return true;
}

/* Where each joint takes a vertex: now, and at rest (a node's transform without animation). */
static bool read_joints(gltf *g, const json_value *list, gltf_skin *out)
{
    const size_t n_nodes = g->nodes ? g->nodes->n_children : 0;
    for (size_t i = 0; i < list->n_children; i++) {
        scene_joint *joint = &out->joints[i];
        if (!gltf_to_size(g, list->children[i], &joint->node_idx)) return false;
        if (joint->node_idx >= n_nodes) return gltf_fail(g, list->children[i], "there are only %zu nodes", n_nodes);
        const gltf_node *node = &g->node[joint->node_idx];
        joint->now = affine_multiply(&node->world, &joint->bind);
        joint->rest = affine_multiply(&node->rest, &joint->bind);
        out->moves = out->moves || node->moves;
        if (!affine_is_finite(&joint->now))
            return gltf_fail(g, list->children[i], "the joint's transform is too large");
    }
    out->n = list->n_children;
    return true;
}

bool gltf_read_skin(gltf *g, size_t node_idx, gltf_skin *out)
{
    size_t idx = GLTF_NONE;
    const json_value *list = NULL;
    *out = (gltf_skin){0};
    if (!gltf_get_ref(g, g->node[node_idx].json, "skin", g->skins, &idx)) return false;
    if (idx == GLTF_NONE) return true;
    const json_value *json = g->skins->children[idx];
    if (!gltf_get(g, json, "joints", JSON_ARRAY, &list)) return false;
    if (!list || list->n_children == 0) return gltf_fail(g, json, "joints are missing");
    if (list->n_children > JOINTS_MAX)
        return loader_remark(g->l, "a skin of %zu joints is ignored, its mesh stays at rest: %d are possible",
                             list->n_children, (int)JOINTS_MAX);
    out->joints = loader_alloc(g->l, list->n_children, sizeof *out->joints);
    return out->joints && read_binds(g, json, list->n_children, out->joints) && read_joints(g, list, out);
}

/* Every vertex names joints that there are. */
static bool check_indices(gltf *g, const json_value *where, const scene_mesh *mesh, size_t n_joints)
{
    for (size_t i = 0; i < 4 * mesh->n_vertices; i++)
        if (mesh->joint[i] >= n_joints)
            return gltf_fail(g, where, "JOINTS_0 has joint %u, the skin has %zu", mesh->joint[i], n_joints);
    return true;
}

bool gltf_add_joints(gltf *g, const json_value *where, const gltf_skin *skin, size_t first_object)
{
    scene *s = g->l->s;
    for (size_t i = first_object; skin->n && i < s->n_objects; i++) {
        scene_object *o = &s->objects[i];
        const scene_mesh *mesh = &s->meshes[o->mesh_idx];
        if (!check_indices(g, where, mesh, skin->n)) return false;
        o->joints = loader_own(g->l, skin->n, sizeof *o->joints);
        if (!o->joints) return false;
        memcpy(o->joints, skin->joints, skin->n * sizeof *o->joints);
        o->n_joints = skin->n;
    }
    return true;
}
