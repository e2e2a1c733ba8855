/* Files whose faces are wound the wrong way round: their backs are outside, and are not drawn. */
#include "obj.h"

#include <math.h>
#include <string.h>

#include "../core/vec.h"

static const double closed = 1e-4; /* of a surface's area: the sum of its normals, if it is closed */
static const double thin = 1e-3;   /* of a surface's size: a volume below that says nothing */

/* What hangs together by vertices. The volume is six times, normals and areas are twice what they are. */
typedef struct {
    double normal[3], area, volume;
    size_t first; /* a vertex, from which the volume is measured */
    bool begun;
} body;

static uint32_t root_of(uint32_t *parent, uint32_t v)
{
    while (parent[v] != v) {
        parent[v] = parent[parent[v]];
        v = parent[v];
    }
    return v;
}

static void add_triangle(const obj_file *o, const obj_corner *c, body *b)
{
    double p[3][3], u[3], v[3], normal[3];
    if (!b->begun) *b = (body){.begun = true, .first = c[0].v};
    for (int i = 0; i < 3; i++) vec_sub(p[i], o->v + 3 * (size_t)c[i].v, o->v + 3 * b->first);
    vec_sub(u, p[1], p[0]);
    vec_sub(v, p[2], p[0]);
    vec_cross(normal, u, v);
    for (int k = 0; k < 3; k++) b->normal[k] += normal[k];
    b->area += sqrt(vec_dot(normal, normal));
    b->volume += vec_dot(normal, p[0]);
}

/* Hollows count against what they are in: the sum over all bodies tells. */
static bool measure(const obj_file *o, bool *inside_out)
{
    uint32_t *parent = loader_alloc(o->l, o->n_v, sizeof *parent);
    body *of = loader_alloc(o->l, o->n_v, sizeof *of);
    double volume = 0, size = 0;
    if (!parent || !of) return false;
    for (uint32_t i = 0; i < o->n_v; i++) parent[i] = i;
    for (size_t i = 0; i < 3 * o->n_triangles; i++)
        parent[root_of(parent, o->corner[i].v)] = root_of(parent, o->corner[i - i % 3].v);
    for (size_t i = 0; i < o->n_triangles; i++)
        add_triangle(o, &o->corner[3 * i], &of[root_of(parent, o->corner[3 * i].v)]);
    for (size_t i = 0; i < o->n_v; i++) {
        if (!of[i].begun || sqrt(vec_dot(of[i].normal, of[i].normal)) > closed * of[i].area) continue;
        volume += of[i].volume;
        size += pow(of[i].area, 1.5);
    }
    *inside_out = volume < -thin * size;
    return true;
}

bool obj_remark_inside_out(const obj_file *o)
{
    arena_block *mark = o->l->memory.blocks;
    bool inside_out = false;
    const bool ok = measure(o, &inside_out);
    arena_release(&o->l->memory, mark);
    if (!ok || !inside_out) return ok;
    return loader_remark(o->l, "the surfaces are inside out: their backs, which are not drawn, are outside. Turn the "
                               "faces round in the program that wrote the file");
}
