/* The glTF node hierarchy, and the camera. */
#include "gltf.h"

#include <math.h>
#include <string.h>

#include "../core/vec.h"

static bool read_matrix(gltf *g, gltf_node *node)
{
    double m[16]; /* column-major */
    if (!json_get(node->json, "matrix")) return true;
    if (!gltf_get_numbers(g, node->json, "matrix", m, 16)) return false;
    if (fabs(m[3]) + fabs(m[7]) + fabs(m[11]) + fabs(m[15] - 1) > 1e-6) {
        return gltf_fail(g, json_get(node->json, "matrix"), "the last row is not 0 0 0 1");
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) node->matrix.m[i][j] = m[4 * j + i];
    }
    node->has_matrix = true;
    return true;
}

static bool read_node(gltf *g, const json_value *json, gltf_node *node)
{
    *node = (gltf_node){.json = json, .parent = GLTF_NONE, .rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    return read_matrix(g, node) && gltf_get_numbers(g, json, "translation", node->translation, 3) &&
           gltf_get_numbers(g, json, "rotation", node->rotation, 4) &&
           gltf_get_numbers(g, json, "scale", node->scale, 3);
}

static bool link_children(gltf *g, size_t node_idx)
{
    const json_value *children = NULL;
    if (!gltf_get(g, g->node[node_idx].json, "children", JSON_ARRAY, &children)) return false;
    for (size_t i = 0; children && i < children->n_children; i++) {
        const json_value *child = children->children[i];
        size_t child_idx;
        if (!gltf_to_size(g, child, &child_idx)) return false;
        if (child_idx >= g->nodes->n_children)
            return gltf_fail(g, child, "there are only %zu nodes", g->nodes->n_children);
        if (g->node[child_idx].parent != GLTF_NONE)
            return gltf_fail(g, child, "node %zu has a parent already", child_idx);
        g->node[child_idx].parent = node_idx;
    }
    return true;
}

bool gltf_read_nodes(gltf *g)
{
    size_t n = g->nodes ? g->nodes->n_children : 0;
    g->node = loader_alloc(g->l, n + 1, sizeof *g->node);
    if (!g->node) return false;
    for (size_t i = 0; i < n; i++) {
        if (!read_node(g, g->nodes->children[i], &g->node[i])) return false;
    }
    for (size_t i = 0; i < n; i++) {
        if (!link_children(g, i)) return false;
    }
    return true;
}

static bool local_transform(gltf *g, const gltf_node *node, scene_affine *out)
{
    double q[4], length = 0;
    if (node->has_matrix) {
        *out = node->matrix;
        return true;
    }
    for (int i = 0; i < 4; i++) length = fmax(length, fabs(node->rotation[i]));
    if (!(length > 0) && !loader_remark(g->l, "a rotation of a node is zero: none is taken")) return false;
    for (int i = 0; i < 4; i++) q[i] = length > 0 ? node->rotation[i] / length : i == 3;
    length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                            {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                            {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) out->m[i][j] = r[i][j] * node->scale[j];
        out->m[i][3] = node->translation[i];
    }
    return true;
}

/* A scene ought to name roots alone. Viewers draw others as if they were roots: three.js takes such a node from its
 * parent, glTF-Sample-Viewer begins a walk at it; so its own transform counts, and not those above it. Here it leaves
 * its parent too, whose scene it may also be in: it is drawn once. */
static bool show_as_root(gltf *g, size_t node_idx)
{
    gltf_node *node = &g->node[node_idx];
    if (node->parent == GLTF_NONE) return true;
    const char *name = gltf_name(g, node->json, "node");
    node->parent = GLTF_NONE;
    return name && loader_remark(g->l,
                                 "'%.100s' is in the scene and a child of another node: it is drawn as a root, "
                                 "without the transforms above it",
                                 name);
}

static bool mark_roots(gltf *g, const json_value *used_scene)
{
    const json_value *roots = NULL;
    if (!gltf_get(g, used_scene, "nodes", JSON_ARRAY, &roots)) return false;
    for (size_t i = 0; roots && i < roots->n_children; i++) {
        size_t root, n = g->nodes ? g->nodes->n_children : 0;
        if (!gltf_to_size(g, roots->children[i], &root)) return false;
        if (root >= n) return gltf_fail(g, roots->children[i], "there are only %zu nodes", n);
        if (!show_as_root(g, root)) return false;
        g->node[root].in_scene = true;
    }
    return true;
}

static bool place_node(gltf *g, gltf_node *node)
{
    scene_affine local;
    if (!local_transform(g, node, &local)) return false;
    node->world = local;
    if (node->parent == GLTF_NONE && g->l->options->up == SCENE_UP_Z) {
        const scene_affine turn = affine_z_up();
        node->world = affine_multiply(&turn, &local);
    }
    if (node->parent != GLTF_NONE) {
        const gltf_node *parent = &g->node[node->parent];
        node->world = affine_multiply(&parent->world, &local);
        node->in_scene = parent->in_scene;
        node->moves = node->moves || parent->moves;
    }
    return affine_is_finite(&node->world) || gltf_fail(g, node->json, "the transform is too large");
}

/* Parents before children, without recursion: a chain of nodes may be as long as the file. Every node has at most one
 * parent, so a node that no root reaches is on a cycle or below one. */
static bool order_nodes(gltf *g, size_t *order, size_t n)
{
    size_t n_reached = 0;
    bool *reached = loader_alloc(g->l, n + 1, sizeof *reached);
    if (!reached) return false;
    for (size_t i = 0; i < n; i++) {
        if (g->node[i].parent == GLTF_NONE) order[n_reached++] = i;
    }
    for (size_t i = 0; i < n_reached; i++) {
        const json_value *children = json_get(g->node[order[i]].json, "children");
        reached[order[i]] = true;
        for (size_t k = 0; children && k < children->n_children; k++)
            order[n_reached++] = (size_t)children->children[k]->number;
    }
    for (size_t i = 0; i < n; i++) {
        if (!reached[i]) return gltf_fail(g, g->node[i].json, "the hierarchy has a cycle");
    }
    return true;
}

bool gltf_place_nodes(gltf *g, const json_value *used_scene)
{
    size_t n = g->nodes ? g->nodes->n_children : 0;
    size_t *order = loader_alloc(g->l, n + 1, sizeof *order);
    if (!order || !order_nodes(g, order, n) || !mark_roots(g, used_scene)) return false;
    for (size_t i = 0; i < n; i++) {
        gltf_node *node = &g->node[order[i]];
        if (!used_scene && node->parent == GLTF_NONE) node->in_scene = true;
        if (!place_node(g, node)) return false;
    }
    return true;
}

void gltf_keep_rest(gltf *g)
{
    size_t n = g->nodes ? g->nodes->n_children : 0;
    for (size_t i = 0; i < n; i++) g->node[i].rest = g->node[i].world;
}

bool gltf_camera_axes(gltf *g, const gltf_node *node, scene_affine *out)
{
    double right[3], up[3], back[3];
    affine_column(up, &node->world, 1);
    affine_column(back, &node->world, 2);
    bool ok = vec_normalise(back) && vec_normalise(up);
    vec_cross(right, up, back);
    ok = ok && vec_dot(right, right) > 1e-24 && vec_normalise(right);
    vec_cross(up, back, right);
    for (int i = 0; i < 3; i++) {
        out->m[i][0] = right[i];
        out->m[i][1] = up[i];
        out->m[i][2] = back[i];
        out->m[i][3] = node->world.m[i][3] + g->camera_back * back[i];
        ok = ok && fabs(out->m[i][3]) <= LOADER_MAX_COORDINATE;
    }
    return ok || gltf_fail(g, node->json, "the camera's transform has no direction or is too large");
}

static bool read_perspective(gltf *g, const json_value *perspective, scene_camera *out)
{
    double fov = 0, near_distance = 0, far_distance = HUGE_VAL;
    if (!gltf_get_number(g, perspective, "yfov", &fov) || !gltf_get_number(g, perspective, "znear", &near_distance) ||
        !gltf_get_number(g, perspective, "zfar", &far_distance))
        return false;
    if (!(fov > 1e-6 && fov < VEC_PI - 1e-6)) return gltf_fail(g, perspective, "yfov %g is not between 0 and pi", fov);
    if (!(near_distance > 0)) {
        if (!loader_remark(g->l, "znear %g of the camera is not positive: another is taken", near_distance))
            return false;
        near_distance = 1e-30; /* to be moved */
    }
    if (!(far_distance > near_distance)) {
        if (!loader_remark(g->l, "zfar %g of the camera is not beyond its znear, and ignored", far_distance))
            return false;
        far_distance = HUGE_VAL;
    }
    out->focal = 1 / tan(fov / 2);
    out->near = near_distance;
    out->far = far_distance;
    return loader_limit_focal(g->l, &out->focal);
}

/* The picture's own shape decides how much is seen to the sides. A near plane of 0, which the library does not have, is
 * moved where nobody sees it; for one behind the camera, the camera goes back: along its axis all looks the same. [R10]
 */
static bool read_orthographic(gltf *g, const json_value *orthographic, scene_camera *out)
{
    double height = 0, near_distance = 0, far_distance = 0;
    if (!gltf_get_number(g, orthographic, "ymag", &height) ||
        !gltf_get_number(g, orthographic, "znear", &near_distance) ||
        !gltf_get_number(g, orthographic, "zfar", &far_distance))
        return false;
    if (height < 0 && !loader_remark(g->l, "ymag %g of the camera is negative: %g is taken", height, -height))
        return false;
    height = fabs(height);
    if (!(height > 0 && height <= LOADER_MAX_COORDINATE))
        return gltf_fail(g, orthographic, "ymag %g is 0, or too large", height);
    if (!(far_distance > near_distance))
        return gltf_fail(g, orthographic, "zfar %g is not beyond znear %g", far_distance, near_distance);
    out->focal = 1;
    out->half_height = height;
    const double least = 1e-3 * fmin(height, far_distance - fmin(near_distance, 0));
    g->camera_back = near_distance < 0 ? least - near_distance : 0;
    out->near = fmax(near_distance + g->camera_back, least);
    out->far = far_distance + g->camera_back;
    return g->camera_back <= 0 ||
           loader_note(g->l, "znear %g of the camera is behind it: the camera is moved back by %g", near_distance,
                       g->camera_back);
}

static bool read_lens(gltf *g, const json_value *camera, bool is_orthographic, scene_camera *out)
{
    const json_value *lens = NULL;
    const char *key = is_orthographic ? "orthographic" : "perspective";
    if (!gltf_get(g, camera, key, JSON_OBJECT, &lens)) return false;
    if (!lens) return gltf_fail(g, camera, "%s is missing", key);
    g->camera_back = 0;
    return is_orthographic ? read_orthographic(g, lens, out) : read_perspective(g, lens, out);
}

bool gltf_emit_camera(gltf *g, size_t node_idx)
{
    size_t idx = GLTF_NONE;
    const gltf_node *node = &g->node[node_idx];
    if (!gltf_get_ref(g, node->json, "camera", g->cameras, &idx)) return false;
    if (idx == GLTF_NONE) return true;
    const json_value *camera = g->cameras->children[idx];
    const char *name = gltf_name(g, camera, "camera"), *type = "";
    if (!name || !gltf_get_string(g, camera, "type", &type)) return false;
    const bool is_orthographic = strcmp(type, "orthographic") == 0;
    if (!is_orthographic && strcmp(type, "perspective") != 0) return gltf_fail(g, camera, "type '%s' is unknown", type);
    g->l->file_has_camera = true;
    if (g->l->options->orbit) return loader_note(g->l, "camera '%s' ignored: --orbit takes its place", name);
    if (g->l->has_camera) return loader_note(g->l, "camera '%s' ignored: the first camera is used", name);
    g->l->has_camera = true;
    g->camera_node = node_idx;
    return read_lens(g, camera, is_orthographic, &g->l->s->camera) &&
           gltf_camera_axes(g, node, &g->l->s->camera.to_world);
}
