/* glTF primitives -> scene meshes, and mesh nodes -> scene objects.
 *
 * Nodes that instance a mesh share its scene meshes, one per primitive (more if it is too large for 16-bit indices).
 * Where a node's transform mirrors, the engines turn the winding, as glTF asks for. */
#include "gltf.h"

#include <string.h>

#include "../core/vec.h"

enum { MODE_TRIANGLES = 4, MODE_STRIP = 5, MODE_FAN = 6 };

/* The list of vertices that the mode walks over: the indices, or 0, 1, 2 ... */
static bool read_indices(gltf *g, const json_value *primitive, size_t n_vertices, uint32_t **out, size_t *n)
{
    size_t accessor = GLTF_NONE;
    gltf_array a = {.count = n_vertices};
    const json_value *where = json_get(primitive, "indices");
    if (!gltf_get_ref(g, primitive, "indices", g->accessors, &accessor)) return false;
    if (where && !gltf_read_accessor(g, accessor, &a)) return false;
    bool is_index = a.component_type == GLTF_UBYTE || a.component_type == GLTF_USHORT || a.component_type == GLTF_UINT;
    if (where && (a.n_components != 1 || a.normalized || !is_index))
        return gltf_fail(g, where, "SCALAR of unsigned integers is expected");
    *n = a.count;
    *out = loader_alloc(g->l, a.count, sizeof **out);
    if (!*out) return false;
    for (size_t i = 0; i < a.count; i++) {
        double index = where ? a.values[i] : (double)i;
        if (index >= (double)n_vertices)
            return gltf_fail(g, where, "index %zu is %.0f, there are %zu vertices", i, index, n_vertices);
        (*out)[i] = (uint32_t)index;
    }
    return true;
}

/* Corner k of triangle i among the walked vertices. Strips: every other triangle is turned round, so all wind alike. */
static size_t corner_of(size_t mode, size_t i, size_t k)
{
    if (mode == MODE_TRIANGLES) return 3 * i + k;
    if (mode == MODE_FAN) return k == 0 ? 0 : i + k;
    return k == 0 ? i : i + (i % 2 == 0 ? k : 3 - k);
}

/* Takes out the triangles that have a lost vertex. */
static bool drop_lost(gltf *g, scene_mesh *mesh, const bool *lost)
{
    size_t n_kept = 0;
    for (size_t i = 0; i < mesh->n_triangles; i++) {
        const uint32_t *t = mesh->idx + 3 * i;
        if (lost && (lost[t[0]] || lost[t[1]] || lost[t[2]])) continue;
        memmove(mesh->idx + 3 * n_kept++, t, 3 * sizeof *t);
    }
    const size_t n_lost = mesh->n_triangles - n_kept;
    mesh->n_triangles = n_kept;
    return n_lost == 0 ||
           loader_remark(g->l, "%zu faces of '%s' are left out: places of their vertices are not finite, or beyond %g",
                         n_lost, mesh->name, LOADER_MAX_COORDINATE);
}

static bool assemble(gltf *g, const json_value *primitive, size_t mode, scene_mesh *out)
{
    uint32_t *walk = NULL;
    size_t n = 0;
    if (!read_indices(g, primitive, out->n_vertices, &walk, &n)) return false;
    out->n_triangles = mode == MODE_TRIANGLES ? n / 3 : n < 3 ? 0 : n - 2;
    if (mode == MODE_TRIANGLES && n % 3 != 0 &&
        !loader_note(g->l, "the last %zu corners of '%s' make no triangle", n % 3, out->name))
        return false;
    out->idx = loader_alloc(g->l, out->n_triangles, 3 * sizeof *out->idx);
    if (!out->idx) return false;
    for (size_t i = 0; i < out->n_triangles; i++) {
        for (size_t k = 0; k < 3; k++) out->idx[3 * i + k] = walk[corner_of(mode, i, k)];
    }
    return true;
}

/* Whether positions are there uncompressed, too. */
static bool has_data(gltf *g, const json_value *attributes)
{
    size_t accessor = GLTF_NONE;
    return !gltf_get_ref(g, attributes, "POSITION", g->accessors, &accessor) || accessor == GLTF_NONE ||
           json_get(g->accessors->children[accessor], "bufferView") ||
           json_get(g->accessors->children[accessor], "sparse");
}

/* n_triangles stays 0 for what is skipped, with a note. */
static bool read_primitive(gltf *g, const json_value *primitive, const char *name, const gltf_wants *wants,
                           scene_mesh *out, gltf_beside *beside)
{
    const json_value *attributes = NULL;
    size_t mode = MODE_TRIANGLES;
    *out = (scene_mesh){.name = loader_format(g->l, "%s", name)};
    if (!out->name) return false;
    if (!gltf_get_size(g, primitive, "mode", &mode) || !gltf_get(g, primitive, "attributes", JSON_OBJECT, &attributes))
        return false;
    if (!attributes) return gltf_fail(g, primitive, "attributes is missing");
    if (mode > MODE_FAN) return gltf_fail(g, json_get(primitive, "mode"), "mode %zu is unknown", mode);
    if (mode < MODE_TRIANGLES)
        return loader_remark(g->l, "points and lines of mesh '%s' ignored: only triangles are drawn", name);
    if (json_get(json_get(primitive, "extensions"), "KHR_draco_mesh_compression") && !has_data(g, attributes))
        return gltf_fail(g, primitive, "mesh '%s' is compressed, which is not supported%s", name, GLTF_COMPRESSED);
    if (!json_get(attributes, "POSITION"))
        return loader_remark(g->l, "primitive of mesh '%s' ignored: it has no POSITION", name);
    if (json_get(primitive, "targets") &&
        !loader_remark(g->l, "morph targets of mesh '%s' ignored: they are not supported", name))
        return false;
    if (!gltf_read_attributes(g, attributes, wants, out, beside)) return false;
    if (out->n_vertices == 0) return true;
    return assemble(g, primitive, mode, out) && drop_lost(g, out, beside->lost) &&
           (out->n_triangles == 0 || mesh_prepare_normals(g->l, out));
}

static bool load_primitive(gltf *g, const json_value *json, const char *name, const gltf_material *material,
                           gltf_primitive *out)
{
    const gltf_wants wants = {.uv_set = material->uv_set, .uv = &material->uv, .mask_uv = g->has_mask_texture};
    scene_mesh mesh;
    gltf_beside beside = {0};
    if (out->loaded) return true;
    out->loaded = true;
    arena_block *mark = g->l->memory.blocks;
    bool ok = read_primitive(g, json, name, &wants, &mesh, &beside);
    if (ok && mesh.n_triangles > 0) ok = gltf_split_mesh(g, material, &mesh, &beside, out);
    arena_release(&g->l->memory, mark); /* many primitives may share one large vertex buffer */
    return ok;
}

/* A texture needs coordinates. */
static bool check_coordinates(gltf *g, const json_value *json, const scene_mesh *mesh, bool has_uv,
                              scene_object *object)
{
    if (object->mask_texture_idx != SCENE_NONE && !mesh->mask_uv) {
        return gltf_fail(g, json, "a mask_texture is looked up at TEXCOORD_1, which is missing");
    }
    const bool coloured = object->texture_idx != SCENE_NONE, glows = object->emissive_texture_idx != SCENE_NONE;
    if (has_uv) return true;
    object->texture_idx = object->emissive_texture_idx = SCENE_NONE;
    for (int i = 0; glows && i < 3; i++) object->emissive[i] = 0;
    return (!coloured || loader_remark(g->l, "base colour texture of mesh '%s' ignored: it has no texture coordinates",
                                       mesh->name)) &&
           (!glows ||
            loader_remark(g->l, "emissive texture of mesh '%s' ignored: it has no texture coordinates", mesh->name));
}

/* Where the object is; a skinned one is where its joints take it, and its node does not count. */
static void place(scene_object *object, const gltf *g, const gltf_node *node, const gltf_skin *skin)
{
    object->to_world = skin->n ? affine_identity() : node->world;
    object->at_rest = skin->n ? affine_identity() : node->rest;
    object->node_idx = skin->n ? SCENE_NONE : (size_t)(node - g->node);
}

static bool emit_primitive(gltf *g, const gltf_node *node, const json_value *json, const char *mesh_name,
                           const gltf_skin *skin, gltf_primitive *primitive)
{
    gltf_material material;
    if (!gltf_read_material(g, json, node->moves || skin->moves, &material) ||
        !gltf_material_knobs(g, node->json, &material))
        return false;
    if (!load_primitive(g, json, mesh_name, &material, primitive)) return false;
    if (primitive->n_meshes == 0) return true; /* skipped, with a note */
    scene_object object = material.surface;
    place(&object, g, node, skin);
    const scene_mesh *mesh = &g->l->s->meshes[primitive->first_mesh];
    if (!check_coordinates(g, json, mesh, mesh->uv && !primitive->has_ramp, &object)) return false;
    if (primitive->has_ramp) object.texture_idx = g->ramp_idx;
    if (skin->n && !mesh->joint) return gltf_fail(g, json, "joints or weights have no elements");
    const char *name = gltf_name(g, node->json, "node");
    object.name = name ? loader_format(g->l, "%s", name) : NULL;
    const size_t first = g->l->s->n_objects;
    return object.name && loader_add_objects(g->l, &object, primitive->first_mesh, primitive->n_meshes) &&
           gltf_add_joints(g, json, skin, first);
}

static bool mesh_primitives(gltf *g, size_t mesh_idx, const json_value **out)
{
    const json_value *mesh = g->meshes->children[mesh_idx];
    if (!gltf_get(g, mesh, "primitives", JSON_ARRAY, out)) return false;
    if (!*out) return gltf_fail(g, mesh, "primitives are missing");
    if (g->primitive[mesh_idx]) return true;
    g->primitive[mesh_idx] = loader_alloc(g->l, (*out)->n_children + 1, sizeof **g->primitive);
    return g->primitive[mesh_idx] != NULL;
}

/* Whether the attribute is there and has elements. */
static bool has_elements(gltf *g, const json_value *attributes, const char *name)
{
    const json_value *idx = json_get(attributes, name);
    const size_t n = g->accessors ? g->accessors->n_children : 0;
    if (!idx || idx->type != JSON_NUMBER || !(idx->number < (double)n)) return idx != NULL; /* an error elsewhere */
    const json_value *count = json_get(g->accessors->children[(size_t)idx->number], "count");
    return count && count->type == JSON_NUMBER && count->number > 0;
}

/* Whether the skin moves the primitive. */
static bool is_skinned(gltf *g, const json_value *json, const gltf_skin *skin, const char *name, bool *out)
{
    const json_value *attributes = json_get(json, "attributes");
    *out = has_elements(g, attributes, "JOINTS_0") && has_elements(g, attributes, "WEIGHTS_0");
    return *out || skin->n == 0 ||
           loader_remark(g->l, "mesh '%s' has a skin, but no JOINTS_0 or no WEIGHTS_0: it stays at rest", name);
}

bool gltf_emit_mesh(gltf *g, size_t node_idx)
{
    static const gltf_skin none;
    const gltf_node *node = &g->node[node_idx];
    const json_value *primitives = NULL;
    size_t mesh_idx = GLTF_NONE;
    if (!gltf_get_ref(g, node->json, "mesh", g->meshes, &mesh_idx)) return false;
    if (mesh_idx == GLTF_NONE) return true;
    const char *name = gltf_name(g, g->meshes->children[mesh_idx], "mesh");
    if (!name || !mesh_primitives(g, mesh_idx, &primitives)) return false;
    gltf_skin skin;
    if (primitives->n_children == 0) return loader_remark(g->l, "mesh '%s' ignored: it has no primitives", name);
    if (!gltf_read_skin(g, node_idx, &skin)) return false;
    for (size_t i = 0; i < primitives->n_children; i++) {
        const json_value *json = primitives->children[i];
        if (json->type != JSON_OBJECT) return gltf_fail(g, json, "an object is expected");
        bool skinned;
        if (!is_skinned(g, json, &skin, name, &skinned)) return false;
        if (!emit_primitive(g, node, json, name, skinned ? &skin : &none, &g->primitive[mesh_idx][i])) return false;
    }
    return true;
}
