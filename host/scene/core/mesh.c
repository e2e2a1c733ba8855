/* The mesh pipeline behind every loader: unit normals, smooth normals, and cutting to 16-bit meshes. */
#include "loader.h"

#include <stdlib.h>
#include <string.h>

#include "vec.h"

/* Unit face normal by the winding; false for a triangle without area. Edges are normalised first: tiny triangles keep
 * theirs. */
static bool face_normal(const scene_mesh *mesh, size_t triangle, double *normal)
{
    const uint32_t *t = mesh->idx + 3 * triangle;
    double u[3], v[3];
    vec_sub(u, mesh->pos + 3 * (size_t)t[1], mesh->pos + 3 * (size_t)t[0]);
    vec_sub(v, mesh->pos + 3 * (size_t)t[2], mesh->pos + 3 * (size_t)t[0]);
    if (!vec_normalise(u) || !vec_normalise(v)) return false;
    vec_cross(normal, u, v);
    return vec_normalise(normal);
}

/* Replaces the normals that are still zero: by a face normal of a triangle at the vertex, or up if all of those are
 * flat. */
static void fill_zero_normals(scene_mesh *mesh, bool *zero)
{
    for (size_t i = 0; i < mesh->n_triangles; i++) {
        double normal[3];
        const uint32_t *t = mesh->idx + 3 * i;
        if (!(zero[t[0]] || zero[t[1]] || zero[t[2]]) || !face_normal(mesh, i, normal)) continue;
        for (int k = 0; k < 3; k++) {
            if (zero[t[k]]) memcpy(mesh->nrm + 3 * (size_t)t[k], normal, sizeof normal);
            zero[t[k]] = false;
        }
    }
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        if (zero[i]) mesh->nrm[3 * i + 1] = 1;
    }
}

static bool normalise_given(loader *l, scene_mesh *mesh)
{
    size_t n_zero = 0;
    bool *zero = loader_alloc(l, mesh->n_vertices, sizeof *zero);
    if (!zero) return false;
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        zero[i] = !vec_normalise(mesh->nrm + 3 * i);
        n_zero += zero[i];
    }
    if (n_zero == 0) return true;
    fill_zero_normals(mesh, zero);
    return loader_note(l, "%zu normals of '%s' have no length: face normals take their place", n_zero, mesh->name);
}

typedef struct {
    double pos[3];
    size_t vertex_idx;
} placed_vertex;

static int compare_places(const void *a, const void *b)
{
    const placed_vertex *x = a, *y = b;
    for (int i = 0; i < 3; i++) {
        if (x->pos[i] < y->pos[i]) return -1;
        if (x->pos[i] > y->pos[i]) return 1;
    }
    return (x->vertex_idx > y->vertex_idx) - (x->vertex_idx < y->vertex_idx);
}

static bool same_place(const placed_vertex *a, const placed_vertex *b)
{
    for (int i = 0; i < 3; i++) {
        if (a->pos[i] < b->pos[i] || a->pos[i] > b->pos[i]) return false;
    }
    return true;
}

/* group[vertex] = the first vertex at the same position. */
static size_t *group_by_position(loader *l, const scene_mesh *mesh)
{
    size_t n = mesh->n_vertices;
    placed_vertex *sorted = loader_alloc(l, n, sizeof *sorted);
    size_t *group = loader_alloc(l, n, sizeof *group);
    if (!sorted || !group) return NULL;
    for (size_t i = 0; i < n; i++) {
        memcpy(sorted[i].pos, mesh->pos + 3 * i, sizeof sorted[i].pos);
        sorted[i].vertex_idx = i;
    }
    qsort(sorted, n, sizeof *sorted, compare_places);
    for (size_t i = 0; i < n; i++) {
        bool joins = i > 0 && same_place(&sorted[i - 1], &sorted[i]);
        group[sorted[i].vertex_idx] = joins ? group[sorted[i - 1].vertex_idx] : sorted[i].vertex_idx;
    }
    return group;
}

/* The angle weighs a corner, so that how a face is cut into triangles does not bend the normal. */
static double corner_angle(const scene_mesh *mesh, const uint32_t *triangle, int corner)
{
    const double *at = mesh->pos + 3 * (size_t)triangle[corner];
    double u[3], v[3];
    vec_sub(u, mesh->pos + 3 * (size_t)triangle[(corner + 1) % 3], at);
    vec_sub(v, mesh->pos + 3 * (size_t)triangle[(corner + 2) % 3], at);
    if (!vec_normalise(u) || !vec_normalise(v)) return 0;
    return acos(fmin(fmax(vec_dot(u, v), -1), 1));
}

static bool make_smooth(loader *l, scene_mesh *mesh)
{
    size_t *group = group_by_position(l, mesh);
    double *sums = loader_alloc(l, mesh->n_vertices, 3 * sizeof *sums);
    bool *zero = loader_alloc(l, mesh->n_vertices, sizeof *zero);
    if (!group || !sums || !zero) return false;
    for (size_t i = 0; i < mesh->n_triangles; i++) {
        double normal[3];
        if (!face_normal(mesh, i, normal)) continue;
        for (int k = 0; k < 3; k++) {
            double angle = corner_angle(mesh, mesh->idx + 3 * i, k);
            for (int j = 0; j < 3; j++) sums[3 * group[mesh->idx[3 * i + (size_t)k]] + (size_t)j] += angle * normal[j];
        }
    }
    mesh->nrm = loader_alloc(l, mesh->n_vertices, 3 * sizeof *mesh->nrm);
    if (!mesh->nrm) return false;
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        memcpy(mesh->nrm + 3 * i, sums + 3 * group[i], 3 * sizeof *sums);
        zero[i] = !vec_normalise(mesh->nrm + 3 * i);
    }
    fill_zero_normals(mesh, zero);
    return true;
}

bool mesh_prepare_normals(loader *l, scene_mesh *input)
{
    if (input->nrm) return normalise_given(l, input);
    return !l->options->smooth || make_smooth(l, input);
}

bool mesh_splitter_init(mesh_splitter *splitter, loader *l, const scene_mesh *input)
{
    *splitter = (mesh_splitter){.l = l, .input = input};
    splitter->local = loader_alloc(l, input->n_vertices, sizeof *splitter->local);
    splitter->seen = loader_alloc(l, input->n_vertices, sizeof *splitter->seen);
    splitter->source = loader_alloc(l, LOADER_MAX_MESH, sizeof *splitter->source);
    return splitter->local && splitter->seen && splitter->source;
}

/* Numbers the vertices of as many triangles as one mesh holds, in order of first use. */
static size_t take_triangles(mesh_splitter *sp, const uint32_t *idx, size_t n_triangles, size_t *n_vertices)
{
    size_t taken = 0;
    *n_vertices = 0;
    sp->serial++;
    for (; taken < n_triangles && taken < LOADER_MAX_MESH && *n_vertices + 3 <= LOADER_MAX_MESH; taken++) {
        for (int k = 0; k < 3; k++) {
            uint32_t vertex = idx[3 * taken + (size_t)k];
            if (sp->seen[vertex] == sp->serial) continue;
            sp->seen[vertex] = sp->serial;
            sp->local[vertex] = (uint32_t)*n_vertices;
            sp->source[(*n_vertices)++] = vertex;
        }
    }
    return taken;
}

/* Elements of the mesh being filled, to free(); NULL where the input has no such attribute, or *ok becomes false. */
static void *gather(mesh_splitter *sp, const void *from, size_t element_bytes, size_t n_vertices, bool *ok)
{
    if (!from || !*ok) return NULL;
    uint8_t *out = loader_own(sp->l, n_vertices, element_bytes);
    *ok = out != NULL;
    for (size_t i = 0; out && i < n_vertices; i++) {
        memcpy(out + i * element_bytes, (const uint8_t *)from + sp->source[i] * element_bytes, element_bytes);
    }
    return out;
}

static bool gather_all(mesh_splitter *sp, size_t n_vertices, scene_mesh *mesh, mesh_light *light)
{
    bool ok = true;
    mesh->pos = gather(sp, sp->input->pos, 3 * sizeof *mesh->pos, n_vertices, &ok);
    mesh->nrm = gather(sp, sp->input->nrm, 3 * sizeof *mesh->nrm, n_vertices, &ok);
    mesh->rgb = gather(sp, sp->input->rgb, 3 * sizeof *mesh->rgb, n_vertices, &ok);
    mesh->uv = gather(sp, sp->input->uv, 2 * sizeof *mesh->uv, n_vertices, &ok);
    mesh->mask_uv = gather(sp, sp->input->mask_uv, 2 * sizeof *mesh->mask_uv, n_vertices, &ok);
    mesh->joint = gather(sp, sp->input->joint, 4, n_vertices, &ok);
    mesh->weight = gather(sp, sp->input->weight, 4, n_vertices, &ok);
    light->mask = gather(sp, sp->light.mask, 4, n_vertices, &ok);
    light->baked = gather(sp, sp->light.baked, 3 * sizeof *light->baked, n_vertices, &ok);
    return ok;
}

static bool add_taken(mesh_splitter *sp, const char *name, const uint32_t *idx, size_t n_triangles, size_t n_vertices)
{
    scene_mesh *mesh = loader_add_mesh(sp->l, name);
    if (!mesh) return false;
    mesh->n_vertices = n_vertices;
    mesh->n_triangles = n_triangles;
    mesh->idx = loader_own(sp->l, n_triangles, 3 * sizeof *mesh->idx);
    if (!mesh->idx) return false;
    for (size_t i = 0; i < n_triangles; i++) {
        mesh->idx[3 * i] = sp->local[idx[3 * i]];
        mesh->idx[3 * i + 1] = sp->local[idx[3 * i + 1]];
        mesh->idx[3 * i + 2] = sp->local[idx[3 * i + 2]];
    }
    return gather_all(sp, n_vertices, mesh, &sp->l->light_of_mesh[sp->l->s->n_meshes - 1]);
}

bool mesh_split(mesh_splitter *splitter, const char *name, const uint32_t *idx, size_t n_triangles, size_t *first,
                size_t *n_meshes)
{
    loader *l = splitter->l;
    *first = l->s->n_meshes;
    if (!(idx = mesh_order(l, splitter->input, idx, n_triangles))) return false;
    for (size_t at = 0; at < n_triangles;) {
        size_t n_vertices, taken = take_triangles(splitter, idx + 3 * at, n_triangles - at, &n_vertices);
        if (!add_taken(splitter, name, idx + 3 * at, taken, n_vertices)) return false;
        at += taken;
    }
    *n_meshes = l->s->n_meshes - *first;
    return true;
}
