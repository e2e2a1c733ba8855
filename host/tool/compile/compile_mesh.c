/* Taking vertices, triangles, meshes, textures, objects and lights out of a compiled scene. Arrays only shrink: in
 * place. */
#include <stdlib.h>
#include <string.h>

#include "compile.h"

/* The arrays are const for the library alone: quantise_scene and the loader allocated them. */
static void *own(const void *array)
{
    return (void *)(uintptr_t)array;
}

/* ---- Vertices ---------------------------------------------------------------------------------------------------- */

static void add(compile_attribute *all, size_t *n, const void *array, size_t bytes)
{
    if (array) all[(*n)++] = (compile_attribute){own(array), bytes};
}

compile_attribute *compile_attributes_of(const compiled *c, const gn_mesh *mesh, size_t *n)
{
    const gn_scene *s = &c->fixed.scene;
    compile_attribute *all = malloc((5 + 4 * (size_t)s->n_objects) * sizeof *all);
    *n = 0;
    if (!all) return NULL;
    add(all, n, mesh->pos, 3 * sizeof *mesh->pos);
    add(all, n, mesh->nrm_q15, 6);
    add(all, n, mesh->rgb_uq16, 6);
    add(all, n, mesh->uv, 4);
    add(all, n, mesh->mask_uv_uq16, 4);
    for (uint32_t i = 0; i < s->n_objects; i++) {
        if (s->objects[i].mesh != mesh) continue;
        add(all, n, s->objects[i].mask_u8, 4);
        add(all, n, s->objects[i].baked_uq12, 6);
        if (!s->objects[i].skin) continue;
        add(all, n, s->objects[i].skin->joint_idx, s->objects[i].skin->per_vertex);
        add(all, n, s->objects[i].skin->weight_u8, s->objects[i].skin->per_vertex);
    }
    return all;
}

/* Moves each vertex to its place in to[]; vertices of one place are alike, and a place is never behind its vertex. */
static void move_vertices(gn_mesh *mesh, const compile_attribute *all, size_t n_attributes, const uint16_t *to,
                          const bool *used, size_t n_left)
{
    uint16_t *idx = own(mesh->idx);
    for (size_t v = 0; v < mesh->n_vertices; v++)
        for (size_t k = 0; used[v] && k < n_attributes; k++)
            memmove(all[k].at + to[v] * all[k].bytes, all[k].at + v * all[k].bytes, all[k].bytes);
    for (size_t i = 0; i < 3 * (size_t)mesh->n_triangles; i++) idx[i] = to[idx[i]];
    mesh->n_vertices = (uint16_t)n_left;
}

static uint32_t hash_of(const compile_attribute *all, size_t n, size_t vertex)
{
    uint32_t hash = 2166136261U;
    for (size_t k = 0; k < n; k++)
        for (size_t b = 0; b < all[k].bytes; b++) hash = (hash ^ all[k].at[vertex * all[k].bytes + b]) * 16777619U;
    return hash;
}

static bool alike(const compile_attribute *all, size_t n, size_t a, size_t b)
{
    for (size_t k = 0; k < n; k++)
        if (memcmp(all[k].at + a * all[k].bytes, all[k].at + b * all[k].bytes, all[k].bytes) != 0) return false;
    return true;
}

enum { BUCKETS = 65536 };

/* Boxes of vertices decide tight fits [D12] and the worth of tiles [A7]: vertices at their ends stay. Boxes of a skin's
 * mesh change with its pose: all of its vertices stay. */
static void use_ends(const compiled *c, const gn_mesh *mesh, bool *used)
{
    size_t end[6] = {0};
    bool skinned = false;
    for (uint32_t i = 0; i < c->fixed.scene.n_objects; i++)
        skinned = skinned || (c->fixed.objects[i].mesh == mesh && c->fixed.objects[i].skin);
    for (size_t v = 0; v < mesh->n_vertices; v++) {
        used[v] = used[v] || skinned;
        for (size_t k = 0; k < 3; k++) {
            if (mesh->pos[3 * v + k] < mesh->pos[3 * end[2 * k] + k]) end[2 * k] = v;
            if (mesh->pos[3 * v + k] > mesh->pos[3 * end[2 * k + 1] + k]) end[2 * k + 1] = v;
        }
    }
    for (size_t i = 0; mesh->n_vertices && i < 6; i++) used[end[i]] = true;
}

/* The first vertex like each; merge: else every vertex is its own. Places are given to those that triangles use. */
static size_t place_vertices(const gn_mesh *mesh, const compile_attribute *all, size_t n_attributes, bool merge,
                             uint16_t *to, bool *used, uint32_t *bucket, uint32_t *next)
{
    size_t n_left = 0;
    memset(bucket, 0xFF, BUCKETS * sizeof *bucket);
    for (size_t v = 0; v < mesh->n_vertices; v++) {
        if (!used[v]) continue;
        uint32_t hash = hash_of(all, n_attributes, v) % BUCKETS, like = merge ? bucket[hash] : UINT32_MAX;
        while (like != UINT32_MAX && !alike(all, n_attributes, like, v)) like = next[like];
        if (like != UINT32_MAX) {
            to[v] = to[like];
            continue;
        }
        to[v] = (uint16_t)n_left++;
        next[v] = bucket[hash];
        bucket[hash] = (uint32_t)v;
    }
    return n_left;
}

static size_t shrink_mesh(const compiled *c, gn_mesh *mesh, bool merge)
{
    size_t n_attributes, before = mesh->n_vertices, n_left = before;
    compile_attribute *all = compile_attributes_of(c, mesh, &n_attributes);
    uint16_t *to = calloc(before + 1, sizeof *to);
    bool *used = calloc(before + 1, sizeof *used);
    uint32_t *bucket = malloc(BUCKETS * sizeof *bucket), *next = malloc((before + 1) * sizeof *next);
    if (all && to && used && bucket && next) {
        for (size_t i = 0; i < 3 * (size_t)mesh->n_triangles; i++) used[mesh->idx[i]] = true;
        if (c->fixed.scene.shadow.fit == GN_FIT_TIGHT || c->fixed.scene.shadow.tile_sizes == GN_TILES_WORTH)
            use_ends(c, mesh, used);
        n_left = place_vertices(mesh, all, n_attributes, merge, to, used, bucket, next);
        if (n_left < before) move_vertices(mesh, all, n_attributes, to, used, n_left);
    }
    free(all);
    free(to);
    free(used);
    free(bucket);
    free(next);
    return before - n_left;
}

size_t compile_merge_vertices(compiled *c, gn_mesh *mesh)
{
    return shrink_mesh(c, mesh, true);
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

void compile_keep_triangles(gn_mesh *mesh, const uint16_t *idx, size_t n_triangles, const bool *gone)
{
    uint16_t *out = own(mesh->idx);
    size_t n = 0;
    for (size_t i = 0; i < n_triangles; i++) {
        if (gone[i]) continue;
        memmove(out + 3 * n, idx + 3 * i, 3 * sizeof *out);
        n++;
    }
    mesh->n_triangles = (uint16_t)n;
}

static bool same_position(const gn_mesh *mesh, uint16_t a, uint16_t b)
{
    return memcmp(mesh->pos + 3 * (size_t)a, mesh->pos + 3 * (size_t)b, 3 * sizeof *mesh->pos) == 0;
}

/* Two corners at one place: no area, from wherever it is seen. */
size_t compile_drop_degenerate(compiled *c, gn_mesh *mesh)
{
    const size_t n = mesh->n_triangles;
    size_t n_gone = 0;
    bool *gone = calloc(n + 1, sizeof *gone);
    (void)c;
    for (size_t t = 0; gone && t < n; t++) {
        const uint16_t *v = mesh->idx + 3 * t;
        gone[t] = same_position(mesh, v[0], v[1]) || same_position(mesh, v[1], v[2]) || same_position(mesh, v[2], v[0]);
        n_gone += gone[t];
    }
    if (n_gone == n) n_gone = 0; /* a mesh without triangles is refused */
    if (n_gone) compile_keep_triangles(mesh, mesh->idx, n, gone);
    free(gone);
    return n_gone;
}

/* ---- Objects, lights, meshes, textures --------------------------------------------------------------------------- */

/* The tracks of what goes, go; the others follow their owners. */
static void renumber_tracks(compiled *c, compile_owner of, const bool *gone)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n_tracks; i++) {
        compile_track t = c->tracks[i];
        if (t.field->of == of) {
            size_t before = 0;
            if (gone[t.idx]) {
                free(t.words);
                continue;
            }
            for (size_t k = 0; k < t.idx; k++) before += gone[k];
            t.idx -= before;
        }
        c->tracks[n++] = t;
    }
    c->n_tracks = n;
}

void compile_drop_objects(compiled *c, const bool *gone)
{
    uint32_t n = 0;
    renumber_tracks(c, COMPILE_OF_OBJECT, gone);
    renumber_tracks(c, COMPILE_OF_SKIN, gone);
    for (uint32_t i = 0; i < c->fixed.scene.n_objects; i++) {
        if (gone[i]) {
            free(own(c->fixed.objects[i].baked_uq12));
            if (c->fixed.objects[i].skin) quantise_free_skin(own(c->fixed.objects[i].skin));
            continue;
        }
        c->object_name[n] = c->object_name[i];
        c->fixed.objects[n++] = c->fixed.objects[i];
    }
    c->fixed.scene.n_objects = n;
}

/* Fits of lights that stay, under their new numbers. */
static void renumber_fits(compiled *c, const bool *gone)
{
    gn_shadow_settings *s = &c->fixed.scene.shadow;
    uint32_t n = 0;
    for (uint32_t i = 0; i < s->n_fixed_fits; i++) {
        gn_fixed_fit fit = c->fixed.fixed_fits[i];
        if (gone[fit.light_idx]) continue;
        uint16_t before = 0;
        for (uint32_t l = 0; l < fit.light_idx; l++) before += gone[l];
        fit.light_idx -= before;
        c->fixed.fixed_fits[n++] = fit;
    }
    s->n_fixed_fits = n;
    if (!n) s->fixed_fits = NULL;
}

void compile_drop_lights(compiled *c, const bool *gone)
{
    uint32_t n = 0;
    renumber_fits(c, gone);
    renumber_tracks(c, COMPILE_OF_LIGHT, gone);
    for (uint32_t i = 0; i < c->fixed.scene.n_lights; i++) {
        if (gone[i]) continue;
        c->light_name[n] = c->light_name[i];
        c->fixed.lights[n++] = c->fixed.lights[i];
    }
    c->fixed.scene.n_lights = n;
}

static bool mesh_is_used(const compiled *c, const gn_mesh *mesh)
{
    for (uint32_t i = 0; i < c->fixed.scene.n_objects; i++)
        if (c->fixed.objects[i].mesh == mesh) return true;
    return false;
}

static void free_mesh(gn_mesh *m)
{
    free(own(m->pos));
    free(own(m->nrm_q15));
    free(own(m->rgb_uq16));
    free(own(m->uv));
    free(own(m->mask_uv_uq16));
    free(own(m->idx));
}

static void drop_meshes(compiled *c)
{
    size_t n = 0;
    for (size_t i = 0; i < c->fixed.n_meshes; i++) {
        gn_mesh *mesh = &c->fixed.meshes[i];
        if (!mesh_is_used(c, mesh)) {
            free_mesh(mesh);
            continue;
        }
        for (uint32_t k = 0; k < c->fixed.scene.n_objects; k++)
            if (c->fixed.objects[k].mesh == mesh) c->fixed.objects[k].mesh = &c->fixed.meshes[n];
        c->mesh_name[n] = c->mesh_name[i];
        c->fixed.meshes[n++] = *mesh;
    }
    c->fixed.n_meshes = n;
}

static void drop_textures(compiled *c)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n_textures; i++) {
        const gn_texture *texture = &c->fixed.textures[i], *to = &c->fixed.textures[n];
        bool used = false;
        for (uint32_t k = 0; k < c->fixed.scene.n_objects; k++) {
            gn_object *o = &c->fixed.objects[k];
            used |= o->texture == texture || o->emissive_texture == texture || o->mask_image == texture;
            if (o->texture == texture) o->texture = to;
            if (o->emissive_texture == texture) o->emissive_texture = to;
            if (o->mask_image == texture) o->mask_image = to;
        }
        if (!used) {
            quantise_free_texture(&c->fixed.textures[i]);
            continue;
        }
        c->texture_name[n] = c->texture_name[i];
        c->fixed.textures[n++] = *texture;
    }
    c->n_textures = c->fixed.n_textures = n;
}

/* Attributes that no object's material looks at. */
static void drop_coordinates(compiled *c)
{
    for (size_t i = 0; i < c->fixed.n_meshes; i++) {
        gn_mesh *mesh = &c->fixed.meshes[i];
        bool textured = false, masked = false;
        for (uint32_t k = 0; k < c->fixed.scene.n_objects; k++) {
            const gn_object *o = &c->fixed.objects[k];
            if (o->mesh != mesh) continue;
            textured |= o->texture != NULL || o->emissive_texture != NULL;
            masked |= o->mask_image != NULL;
        }
        if (!textured) {
            free(own(mesh->uv));
            mesh->uv = NULL;
        }
        if (!masked) {
            free(own(mesh->mask_uv_uq16));
            mesh->mask_uv_uq16 = NULL;
        }
    }
}

void compile_drop_unused(compiled *c)
{
    drop_meshes(c);
    drop_textures(c);
    drop_coordinates(c);
    for (size_t i = 0; i < c->fixed.n_meshes; i++) shrink_mesh(c, &c->fixed.meshes[i], false);
}
