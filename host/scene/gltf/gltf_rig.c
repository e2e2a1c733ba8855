/* The nodes, clips and cameras of a file, for tools that pose a model themselves. */
#include <stdlib.h>
#include <string.h>

#include "gltf.h"

#include "../core/vec.h"

bool gltf_begin_rig(gltf *g)
{
    const size_t n = g->nodes ? g->nodes->n_children : 0;
    scene *s = g->l->s;
    if (!g->l->options->rig) return true;
    s->rig = loader_own(g->l, 1, sizeof *s->rig);
    if (!s->rig || !(s->rig->nodes = loader_own(g->l, n + 1, sizeof *s->rig->nodes))) return false;
    s->rig->n_nodes = n;
    for (size_t i = 0; i < n; i++) {
        const gltf_node *from = &g->node[i];
        scene_node *to = &s->rig->nodes[i];
        to->has_matrix = from->has_matrix;
        to->matrix = from->matrix;
        memcpy(to->translation, from->translation, sizeof to->translation);
        memcpy(to->rotation, from->rotation, sizeof to->rotation);
        memcpy(to->scale, from->scale, sizeof to->scale);
    }
    return true;
}

/* The scene's one camera is the first; here are all. */
static bool keep_camera(gltf *g, size_t node_idx)
{
    loader *l = g->l;
    scene_rig *rig = l->s->rig;
    const scene_camera used = l->s->camera;
    const bool has_camera = l->has_camera;
    const size_t camera_node = g->camera_node;
    const double camera_back = g->camera_back;
    size_t idx = GLTF_NONE;
    if (!gltf_get_ref(g, g->node[node_idx].json, "camera", g->cameras, &idx)) return false;
    if (idx == GLTF_NONE || l->options->orbit) return true;
    const char *name = gltf_name(g, g->node[node_idx].json, "camera");
    l->has_camera = false;
    bool ok = name && gltf_emit_camera(g, node_idx);
    const bool is_read = ok && l->has_camera;
    const scene_camera camera = l->s->camera;
    l->has_camera = has_camera;
    l->s->camera = used;
    g->camera_node = camera_node;
    scene_affine back = affine_identity();
    back.m[2][3] = g->camera_back;
    g->camera_back = camera_back;
    if (!is_read) return ok;
    if (back.m[2][3] > 0 && !loader_add_rig_node(l, node_idx, &back, &node_idx)) return false;
    scene_view *grown = realloc(rig->cameras, (rig->n_cameras + 1) * sizeof *grown);
    if (!grown) return loader_fail(l, "out of memory");
    rig->cameras = grown;
    rig->cameras[rig->n_cameras] = (scene_view){loader_own(l, strlen(name) + 1, 1), node_idx, camera};
    if (!rig->cameras[rig->n_cameras].name) return false;
    strcpy(rig->cameras[rig->n_cameras++].name, name);
    return true;
}

/* up=z: one node more, which all roots stand on. */
static bool turn_rig(gltf *g)
{
    const scene_affine turn = affine_z_up();
    const scene_rig *rig = g->l->s->rig;
    size_t root;
    if (!loader_add_rig_node(g->l, SCENE_NONE, &turn, &root)) return false;
    for (size_t i = 0; i < root; i++)
        if (rig->nodes[i].parent == SCENE_NONE) rig->nodes[i].parent = root;
    return true;
}

bool gltf_end_rig(gltf *g)
{
    scene_rig *rig = g->l->s->rig;
    if (!rig) return true;
    for (size_t i = 0, n = rig->n_nodes; i < n; i++) {
        rig->nodes[i].parent = g->node[i].parent;
        rig->nodes[i].in_scene = g->node[i].in_scene;
        if (g->node[i].in_scene && !keep_camera(g, i)) return false;
    }
    if (g->l->options->up == SCENE_UP_Z && !turn_rig(g)) return false;
    return gltf_keep_clips(g);
}
