/* OBJ corners -> vertices -> meshes. */
#include "obj.h"

#include <string.h>

#include "../core/vec.h"

/* Corners with the same position, normal and (if their material has a texture) texture coordinate share a vertex. In a
 * file that has normals, a corner without one takes its face's, and shares with nobody: vn is then OBJ_NONE and tag
 * tells the triangle. */
typedef struct {
    uint32_t v, vt, vn, tag;
} vertex_key;

typedef struct {
    const obj_file *o;
    scene_mesh mesh;
    uint32_t *first; /* of every vertex, the first corner that has it */
    uint32_t *slot;  /* open addressing, a power of two, at most half full: 1 + vertex; 0: none */
    size_t n_slots;
} vertex_table;

static bool is_textured(const obj_material *material)
{
    return material->texture_idx != SCENE_NONE || material->emissive_texture_idx != SCENE_NONE;
}

static bool has_texture(const obj_file *o, size_t triangle)
{
    return is_textured(&o->material[o->material_of[triangle]]);
}

static bool any_texture(const obj_file *o)
{
    for (size_t i = 0; i < o->n_triangles; i++) {
        if (has_texture(o, i)) return true;
    }
    return false;
}

static bool same_key(const vertex_key *a, const vertex_key *b)
{
    return a->v == b->v && a->vt == b->vt && a->vn == b->vn && a->tag == b->tag;
}

static vertex_key corner_key(const obj_file *o, size_t i)
{
    const obj_corner *corner = &o->corner[i];
    uint32_t tag = o->has_vn && corner->vn == OBJ_NONE ? (uint32_t)(i / 3) : 0;
    return (vertex_key){corner->v, has_texture(o, i / 3) ? corner->vt : OBJ_NONE, corner->vn, tag};
}

static uint32_t *find_slot(vertex_table *table, const vertex_key *key)
{
    uint64_t hash = (key->v * UINT64_C(0x9E3779B97F4A7C15)) ^ (key->vt * UINT64_C(0xD6E8FEB86659FD93)) ^
                    (key->vn * UINT64_C(0xC2B2AE3D27D4EB4F)) ^ (key->tag * UINT64_C(0x165667B19E3779F9));
    for (size_t at = (size_t)(hash >> 20);; at++) {
        uint32_t *slot = &table->slot[at & (table->n_slots - 1)];
        if (*slot == 0) return slot;
        vertex_key found = corner_key(table->o, table->first[*slot - 1]);
        if (same_key(&found, key)) return slot;
    }
}

static void corner_face_normal(const obj_file *o, size_t triangle, double *normal)
{
    const obj_corner *c = o->corner + 3 * triangle;
    double u[3], v[3];
    vec_sub(u, o->v + 3 * (size_t)c[1].v, o->v + 3 * (size_t)c[0].v);
    vec_sub(v, o->v + 3 * (size_t)c[2].v, o->v + 3 * (size_t)c[0].v);
    vec_normalise(u);
    vec_normalise(v);
    vec_cross(normal, u, v);
    if (!vec_normalise(normal)) memcpy(normal, (const double[3]){0, 1, 0}, 3 * sizeof *normal);
}

static void fill_vertex(vertex_table *table, size_t i)
{
    const obj_file *o = table->o;
    scene_mesh *mesh = &table->mesh;
    vertex_key vertex = corner_key(o, table->first[i]), *key = &vertex;
    memcpy(mesh->pos + 3 * i, o->v + 3 * (size_t)key->v, 3 * sizeof *mesh->pos);
    if (mesh->rgb) memcpy(mesh->rgb + 3 * i, o->rgb + 3 * (size_t)key->v, 3 * sizeof *mesh->rgb);
    if (mesh->uv && key->vt != OBJ_NONE) {
        mesh->uv[2 * i] = o->vt[2 * (size_t)key->vt];
        mesh->uv[2 * i + 1] = 1 - o->vt[2 * (size_t)key->vt + 1]; /* upwards in the file, downwards in the scene */
    }
    if (!mesh->nrm) return;
    if (key->vn == OBJ_NONE) corner_face_normal(o, table->first[i] / 3, mesh->nrm + 3 * i);
    else memcpy(mesh->nrm + 3 * i, o->vn + 3 * (size_t)key->vn, 3 * sizeof *mesh->nrm);
}

/* Which corners share a vertex: first, idx and n_vertices. */
static bool join_corners(vertex_table *table)
{
    const obj_file *o = table->o;
    size_t n_bare = 0, n_corners = 3 * o->n_triangles;
    for (table->n_slots = 16; table->n_slots < 2 * n_corners;) table->n_slots *= 2;
    table->slot = loader_alloc(o->l, table->n_slots, sizeof *table->slot);
    table->first = loader_alloc(o->l, n_corners, sizeof *table->first);
    table->mesh.idx = loader_alloc(o->l, n_corners, sizeof *table->mesh.idx);
    if (!table->slot || !table->first || !table->mesh.idx) return false;
    for (size_t i = 0; i < n_corners; i++) {
        const vertex_key key = corner_key(o, i);
        uint32_t *slot = find_slot(table, &key);
        n_bare += has_texture(o, i / 3) && key.vt == OBJ_NONE;
        if (*slot == 0) {
            table->first[table->mesh.n_vertices++] = (uint32_t)i;
            *slot = (uint32_t)table->mesh.n_vertices;
        }
        table->mesh.idx[i] = *slot - 1;
    }
    return n_bare == 0 || loader_note(o->l, "%zu corners with a texture have no coordinates: they take 0, 0", n_bare);
}

static bool fill_vertices(vertex_table *table)
{
    const obj_file *o = table->o;
    scene_mesh *mesh = &table->mesh;
    size_t n = mesh->n_vertices;
    bool has_uv = any_texture(o);
    mesh->name = loader_format(o->l, "%s", o->l->path);
    mesh->n_triangles = o->n_triangles;
    mesh->pos = loader_alloc(o->l, n, 3 * sizeof *mesh->pos);
    if (o->has_vn) mesh->nrm = loader_alloc(o->l, n, 3 * sizeof *mesh->nrm);
    if (o->has_rgb) mesh->rgb = loader_alloc(o->l, n, 3 * sizeof *mesh->rgb);
    if (has_uv) mesh->uv = loader_alloc(o->l, n, 2 * sizeof *mesh->uv);
    if (!mesh->name || !mesh->pos || (o->has_vn && !mesh->nrm) || (o->has_rgb && !mesh->rgb) || (has_uv && !mesh->uv))
        return false;
    for (size_t i = 0; i < n; i++) fill_vertex(table, i);
    return true;
}

/* Triangles of one object and material. */
typedef struct {
    const char *object;
    const obj_material *material;
    const uint32_t *idx;
    size_t n_triangles;
} obj_part;

static bool emit_part(obj_file *o, mesh_splitter *splitter, const obj_part *part)
{
    size_t first, n_meshes;
    const obj_material *material = part->material;
    scene_object object = object_defaults();
    memcpy(object.albedo, material->albedo, sizeof object.albedo);
    memcpy(object.emissive, material->emissive, sizeof object.emissive);
    object.texture_idx = material->texture_idx;
    object.emissive_texture_idx = material->emissive_texture_idx;
    object.alpha = material->alpha;
    if (material->alpha < 1) {
        object.visible_alpha = SCENE_ALPHA_BLEND;
        object.caster = SCENE_CASTER_DITHER;
    }
    object.name = loader_format(o->l, "%s", *part->object ? part->object : material->name);
    return object.name && mesh_split(splitter, object.name, part->idx, part->n_triangles, &first, &n_meshes) &&
           loader_add_objects(o->l, &object, first, n_meshes);
}

/* A counting sort of triangles by a key, which keeps the order of equal ones. */
static uint32_t *sort_by(loader *l, const uint32_t *order, const uint32_t *key, size_t n, size_t n_keys)
{
    uint32_t *sorted = loader_alloc(l, n, sizeof *sorted);
    size_t *next = loader_alloc(l, n_keys + 1, sizeof *next);
    if (!sorted || !next) return NULL;
    for (size_t i = 0; i < n; i++) next[key[i] + 1]++;
    for (size_t k = 0; k < n_keys; k++) next[k + 1] += next[k];
    for (size_t i = 0; i < n; i++) {
        const uint32_t triangle = order ? order[i] : (uint32_t)i;
        sorted[next[key[triangle]]++] = triangle;
    }
    return sorted;
}

static bool emit_parts(obj_file *o, const scene_mesh *mesh)
{
    mesh_splitter splitter;
    const size_t n = mesh->n_triangles;
    scene_mesh plain = *mesh;
    plain.uv = NULL;
    uint32_t *idx = loader_alloc(o->l, 3 * n, sizeof *idx),
             *order = idx ? sort_by(o->l, NULL, o->material_of, n, o->n_materials) : NULL;
    if (order) order = sort_by(o->l, order, o->object_of, n, o->n_objects);
    if (!order || !mesh_splitter_init(&splitter, o->l, mesh)) return false;
    for (size_t first = 0, end; first < n; first = end) {
        const uint32_t object = o->object_of[order[first]], material = o->material_of[order[first]];
        for (end = first; end < n && o->object_of[order[end]] == object && o->material_of[order[end]] == material;
             end++)
            memcpy(idx + 3 * end, mesh->idx + 3 * (size_t)order[end], 3 * sizeof *idx);
        const obj_part part = {o->object[object].name, &o->material[material], idx + 3 * first, end - first};
        splitter.input = is_textured(part.material) ? mesh : &plain;
        if (!emit_part(o, &splitter, &part)) return false;
    }
    return true;
}

/* A material that is invisible is meant so, unless the others are too. */
static bool show_something(obj_file *o)
{
    for (size_t i = 0; i < o->n_triangles; i++)
        if (o->material[o->material_of[i]].alpha > 0) return true;
    for (size_t i = 0; i < o->n_materials; i++) o->material[i].alpha = 1;
    return loader_remark(o->l, "d of the materials is ignored: all that has faces were invisible");
}

bool obj_emit(obj_file *o)
{
    vertex_table table = {.o = o};
    /* Before the split into parts, so that smooth normals have no seam between them. */
    return show_something(o) && join_corners(&table) && fill_vertices(&table) &&
           mesh_prepare_normals(o->l, &table.mesh) && emit_parts(o, &table.mesh);
}
