/* Triangle meshes for the scene generator. */
#include "mesh_builder.h"

#include <math.h>
#include <string.h>

double mesh_on_grid(double v)
{
    return floor(v / MESH_GRID + 0.5) * MESH_GRID; /* never -0 */
}

void mesh_begin(mesh_builder *m, unsigned attributes)
{
    memset(m, 0, sizeof *m);
    m->attributes = attributes;
    if (attributes & MESH_COLOURS) mesh_paint(m, 1, 1, 1);
}

void mesh_paint(mesh_builder *m, double r, double g, double b)
{
    m->paint[0] = (float)mesh_on_grid(r);
    m->paint[1] = (float)mesh_on_grid(g);
    m->paint[2] = (float)mesh_on_grid(b);
}

static void store(float *out, mesh_point p)
{
    out[0] = (float)mesh_on_grid(p.x);
    out[1] = (float)mesh_on_grid(p.y);
    out[2] = (float)mesh_on_grid(p.z);
}

/* The index of the vertex, an earlier one if it is the same in everything. */
static uint16_t add_vertex(mesh_builder *m, mesh_point pos, mesh_point nrm)
{
    mesh_vertex v;
    store(v.pos, pos);
    store(v.nrm, nrm);
    memcpy(v.rgb, m->paint, sizeof v.rgb);
    for (size_t i = 0; i < m->n_vertices; i++) {
        if (memcmp(&m->vertex[i], &v, sizeof v) == 0) return (uint16_t)i;
    }
    if (m->n_vertices == MESH_MAX_VERTICES) {
        m->overflow = true;
        return 0;
    }
    m->vertex[m->n_vertices] = v;
    return (uint16_t)m->n_vertices++;
}

static bool same_place(const mesh_builder *m, uint16_t a, uint16_t b)
{
    return memcmp(m->vertex[a].pos, m->vertex[b].pos, sizeof m->vertex[a].pos) == 0;
}

static void add_triangle(mesh_builder *m, uint16_t a, uint16_t b, uint16_t c)
{
    if (same_place(m, a, b) || same_place(m, b, c) || same_place(m, c, a)) return;
    if (m->n_corners + 3 > MESH_MAX_CORNERS) {
        m->overflow = true;
        return;
    }
    m->idx[m->n_corners++] = a;
    m->idx[m->n_corners++] = b;
    m->idx[m->n_corners++] = c;
}

void mesh_polygon(mesh_builder *m, const mesh_point *p, size_t n)
{
    const mesh_point none = {0, 0, 0};
    uint16_t first = add_vertex(m, p[0], none), last = add_vertex(m, p[1], none);
    for (size_t i = 2; i < n; i++) {
        uint16_t next = add_vertex(m, p[i], none);
        add_triangle(m, first, last, next);
        last = next;
    }
}

void mesh_triangle(mesh_builder *m, mesh_point a, mesh_point b, mesh_point c)
{
    mesh_polygon(m, (mesh_point[]){a, b, c}, 3);
}

void mesh_quad(mesh_builder *m, mesh_point a, mesh_point b, mesh_point c, mesh_point d)
{
    mesh_polygon(m, (mesh_point[]){a, b, c, d}, 4);
}

mesh_point mesh_ring_point(double r, double y, size_t k, size_t n_segments)
{
    double angle = 2 * MESH_PI * (double)(k % n_segments) / (double)n_segments;
    return (mesh_point){r * cos(angle), y, r * sin(angle)};
}

/* One section of the profile. (dr, dy) runs upwards on the outside, so (dy, -dr) points outwards. */
static void lathe_section(mesh_builder *m, mesh_profile low, mesh_profile high, size_t n_segments)
{
    double dr = high.r - low.r, dy = high.y - low.y, length = sqrt(dr * dr + dy * dy);
    bool smooth = (m->attributes & MESH_NORMALS) != 0;
    double out = smooth ? dy / length : 0, up = smooth ? -dr / length : 0;
    for (size_t k = 0; k < n_segments; k++) {
        mesh_point n0 = mesh_ring_point(out, up, k, n_segments), n1 = mesh_ring_point(out, up, k + 1, n_segments);
        uint16_t a = add_vertex(m, mesh_ring_point(low.r, low.y, k, n_segments), n0);
        uint16_t b = add_vertex(m, mesh_ring_point(high.r, high.y, k, n_segments), n0);
        uint16_t c = add_vertex(m, mesh_ring_point(high.r, high.y, k + 1, n_segments), n1);
        uint16_t d = add_vertex(m, mesh_ring_point(low.r, low.y, k + 1, n_segments), n1);
        add_triangle(m, a, b, c);
        add_triangle(m, a, c, d);
    }
}

void mesh_lathe(mesh_builder *m, const mesh_profile *profile, size_t n, size_t n_segments)
{
    for (size_t i = 0; i + 1 < n; i++) lathe_section(m, profile[i], profile[i + 1], n_segments);
}

void mesh_box(mesh_builder *m, mesh_point low, mesh_point high)
{
    mesh_point p[8];
    for (int i = 0; i < 8; i++) p[i] = (mesh_point){i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    mesh_quad(m, p[0], p[4], p[6], p[2]);
    mesh_quad(m, p[1], p[3], p[7], p[5]);
    mesh_quad(m, p[0], p[1], p[5], p[4]);
    mesh_quad(m, p[2], p[6], p[7], p[3]);
    mesh_quad(m, p[0], p[2], p[3], p[1]);
    mesh_quad(m, p[4], p[5], p[7], p[6]);
}
