/* Alpha of COLOR_0, which neither engine has per vertex.
 *
 * Where it is the same all over a face it belongs to the factor of an object: faces of different alpha become different
 * meshes. Where it varies and the surface has no texture, a texture of two texels is looked up: between them alpha is
 * linear, as it is between vertices. Where it varies over a texture, a face has the mean of its vertices. [M8] */
#include "gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = 256, MOST_PARTS = 16 }; /* of alpha; meshes that a primitive is cut into, but for one */

static const double same = 1.0 / 1024; /* so near are alphas of vertices that are meant to be equal */

static double mean_of(const scene_mesh *mesh, const double *alpha, size_t triangle)
{
    const uint32_t *t = mesh->idx + 3 * triangle;
    return fabs(alpha[t[0]] - alpha[t[1]]) + fabs(alpha[t[0]] - alpha[t[2]]) > 0
               ? (alpha[t[0]] + alpha[t[1]] + alpha[t[2]]) / 3
               : alpha[t[0]];
}

static bool varies(const scene_mesh *mesh, const double *alpha)
{
    for (size_t i = 0; i < mesh->n_triangles; i++) {
        const uint32_t *t = mesh->idx + 3 * i;
        if (fabs(alpha[t[0]] - alpha[t[1]]) > same || fabs(alpha[t[0]] - alpha[t[2]]) > same) return true;
    }
    return false;
}

/* The texture of two texels; one for all of the scene. */
static bool make_ramp(gltf *g)
{
    static const uint8_t texels[8] = {255, 255, 255, 0, 255, 255, 255, 255};
    const texture_use use = {.clamp_u = true, .clamp_v = true, .bilinear = true};
    if (g->has_ramp) return true;
    g->has_ramp = true;
    rgba8_picture picture = {.w = 2, .h = 1, .depth = 8, .rgba = malloc(sizeof texels)};
    if (!picture.rgba) return loader_fail(g->l, "out of memory");
    memcpy(picture.rgba, texels, sizeof texels);
    return texture_add(g->l, "alpha of vertices", &picture, &use, &g->ramp_idx);
}

/* From the middle of the first texel to that of the second. */
static bool look_up_ramp(gltf *g, scene_mesh *mesh, const double *alpha)
{
    mesh->uv = loader_alloc(g->l, mesh->n_vertices, 2 * sizeof *mesh->uv);
    for (size_t i = 0; mesh->uv && i < mesh->n_vertices; i++) {
        mesh->uv[2 * i] = 0.25 + 0.5 * alpha[i];
        mesh->uv[2 * i + 1] = 0.5;
    }
    return mesh->uv && make_ramp(g);
}

/* Of every triangle the part that it belongs to: 256 levels of alpha, or if too many are there, fewer. */
static uint8_t *find_parts(gltf *g, const scene_mesh *mesh, const double *alpha)
{
    uint8_t *part = loader_alloc(g->l, mesh->n_triangles, 1);
    bool there[LEVELS] = {false};
    size_t n = 0;
    for (size_t i = 0; part && i < mesh->n_triangles; i++) {
        part[i] = (uint8_t)(mean_of(mesh, alpha, i) * (LEVELS - 1) + 0.5);
        n += !there[part[i]];
        there[part[i]] = true;
    }
    for (size_t i = 0; part && n > MOST_PARTS && i < mesh->n_triangles; i++)
        part[i] = (uint8_t)(mean_of(mesh, alpha, i) * MOST_PARTS + 0.5);
    return part;
}

static bool add_part(gltf *g, mesh_splitter *splitter, const double *alpha, const uint8_t *part, int wanted,
                     gltf_primitive *out)
{
    const scene_mesh *mesh = splitter->input;
    uint32_t *idx = loader_alloc(g->l, mesh->n_triangles, 3 * sizeof *idx);
    size_t n = 0, first, n_meshes;
    double sum = 0;
    for (size_t i = 0; idx && i < mesh->n_triangles; i++) {
        if (part[i] != wanted) continue;
        memcpy(idx + 3 * n++, mesh->idx + 3 * i, 3 * sizeof *idx);
        sum += mean_of(mesh, alpha, i);
    }
    if (!idx || n == 0) return idx != NULL;
    if (!mesh_split(splitter, mesh->name, idx, n, &first, &n_meshes)) return false;
    if (out->n_meshes == 0) out->first_mesh = first;
    out->n_meshes += n_meshes;
    for (size_t i = 0; i < n_meshes; i++) g->l->light_of_mesh[first + i].alpha = sum / (double)n;
    return true;
}

static bool is_cut(const scene_object *o)
{
    return o->visible_alpha != SCENE_ALPHA_OPAQUE || o->caster == SCENE_CASTER_CLIP || o->caster == SCENE_CASTER_DITHER;
}

bool gltf_split_mesh(gltf *g, const gltf_material *material, scene_mesh *mesh, const gltf_beside *beside,
                     gltf_primitive *out)
{
    const double *alpha = is_cut(&material->surface) ? beside->alpha : NULL;
    const bool changes = alpha && varies(mesh, alpha);
    mesh_splitter splitter;
    out->has_ramp = changes && !mesh->uv;
    if (out->has_ramp && !look_up_ramp(g, mesh, alpha)) return false;
    if (changes && !out->has_ramp &&
        !loader_remark(g->l, "alpha of COLOR_0 of '%s' varies over a texture: each face has the mean of its vertices",
                       mesh->name))
        return false;
    if (!mesh_splitter_init(&splitter, g->l, mesh)) return false;
    splitter.light = beside->light;
    if (!alpha || out->has_ramp)
        return mesh_split(&splitter, mesh->name, mesh->idx, mesh->n_triangles, &out->first_mesh, &out->n_meshes);
    const uint8_t *part = find_parts(g, mesh, alpha);
    for (int i = 0; part && i < LEVELS; i++) {
        arena_block *mark = g->l->memory.blocks;
        const bool ok = add_part(g, &splitter, alpha, part, i, out);
        arena_release(&g->l->memory, mark);
        if (!ok) return false;
    }
    return part != NULL;
}
