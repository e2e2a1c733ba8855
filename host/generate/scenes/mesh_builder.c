/* Triangle meshes for the scene generator. */
#include "mesh_builder.h"

#include <math.h>
#include <string.h>

double mesh_on_grid(double v)
{
    return floor(v / MESH_GRID + 0.5) * MESH_GRID; /* never -0 */
}

mesh_point mesh_add(mesh_point a, mesh_point b)
{
    return (mesh_point){a.x + b.x, a.y + b.y, a.z + b.z};
}

mesh_point mesh_sub(mesh_point a, mesh_point b)
{
    return (mesh_point){a.x - b.x, a.y - b.y, a.z - b.z};
}

mesh_point mesh_scale(mesh_point a, double s)
{
    return (mesh_point){a.x * s, a.y * s, a.z * s};
}

mesh_point mesh_cross(mesh_point a, mesh_point b)
{
    return (mesh_point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double mesh_dot(mesh_point a, mesh_point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

mesh_point mesh_unit(mesh_point a)
{
    return mesh_scale(a, 1 / sqrt(mesh_dot(a, a)));
}

/* The frame's axes, weighed by p. */
static mesh_point along_axes(const mesh_frame *f, mesh_point p)
{
    return mesh_add(mesh_add(mesh_scale(f->x, p.x), mesh_scale(f->y, p.y)), mesh_scale(f->z, p.z));
}

void mesh_begin(mesh_builder *m, unsigned attributes)
{
    memset(m, 0, sizeof *m);
    m->attributes = attributes;
    mesh_place(m, mesh_frame_at((mesh_point){0, 0, 0}, 0, 0));
    if (attributes & MESH_COLOURS) mesh_paint(m, 1, 1, 1);
}

void mesh_paint(mesh_builder *m, double r, double g, double b)
{
    m->paint[0] = (float)mesh_on_grid(r);
    m->paint[1] = (float)mesh_on_grid(g);
    m->paint[2] = (float)mesh_on_grid(b);
}

void mesh_place(mesh_builder *m, mesh_frame place)
{
    m->place = place;
}

mesh_frame mesh_frame_at(mesh_point origin, double yaw_deg, double tip_deg)
{
    double cy = cos(yaw_deg * MESH_PI / 180), sy = sin(yaw_deg * MESH_PI / 180);
    double ct = cos(tip_deg * MESH_PI / 180), st = sin(tip_deg * MESH_PI / 180);
    return (mesh_frame){origin, {cy, 0, -sy}, {sy * st, ct, cy * st}, {sy * ct, -st, cy * ct}};
}

void mesh_repaint(mesh_builder *m, void (*paint)(mesh_point at, double *rgb))
{
    for (size_t i = 0; i < m->n_vertices; i++) {
        const float *p = m->vertex[i].pos;
        double rgb[3];
        paint((mesh_point){(double)p[0], (double)p[1], (double)p[2]}, rgb);
        for (int k = 0; k < 3; k++) m->vertex[i].rgb[k] = (float)mesh_on_grid(rgb[k]);
    }
}

static void store(float *out, mesh_point p)
{
    out[0] = (float)mesh_on_grid(p.x);
    out[1] = (float)mesh_on_grid(p.y);
    out[2] = (float)mesh_on_grid(p.z);
}

/* The index of the vertex, an earlier one if it is the same in everything. */
static uint16_t add_vertex(mesh_builder *m, mesh_point pos, mesh_point nrm, mesh_uv uv)
{
    mesh_vertex v = {.uv = {(float)mesh_on_grid(uv.u), (float)mesh_on_grid(uv.v)}};
    store(v.pos, mesh_add(along_axes(&m->place, pos), m->place.origin));
    store(v.nrm, along_axes(&m->place, nrm));
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

/* Of the largest triangle of the fan; zero without MESH_NORMALS. */
static mesh_point polygon_normal(const mesh_builder *m, const mesh_point *p, size_t n)
{
    mesh_point best = {0, 0, 0};
    if (!(m->attributes & MESH_NORMALS)) return best;
    for (size_t i = 2; i < n; i++) {
        mesh_point normal = mesh_cross(mesh_sub(p[i - 1], p[0]), mesh_sub(p[i], p[0]));
        if (mesh_dot(normal, normal) > mesh_dot(best, best)) best = normal;
    }
    return mesh_unit(best);
}

void mesh_polygon_uv(mesh_builder *m, const mesh_point *p, const mesh_uv *uv, size_t n)
{
    const mesh_uv none = {0, 0};
    mesh_point nrm = polygon_normal(m, p, n);
    uint16_t first = add_vertex(m, p[0], nrm, uv ? uv[0] : none), last = add_vertex(m, p[1], nrm, uv ? uv[1] : none);
    for (size_t i = 2; i < n; i++) {
        uint16_t next = add_vertex(m, p[i], nrm, uv ? uv[i] : none);
        add_triangle(m, first, last, next);
        last = next;
    }
}

void mesh_polygon(mesh_builder *m, const mesh_point *p, size_t n)
{
    mesh_polygon_uv(m, p, NULL, n);
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
    const mesh_uv no_uv = {0, 0};
    bool smooth = (m->attributes & MESH_NORMALS) != 0;
    double out = smooth ? dy / length : 0, up = smooth ? -dr / length : 0;
    for (size_t k = 0; k < n_segments; k++) {
        mesh_point n0 = mesh_ring_point(out, up, k, n_segments), n1 = mesh_ring_point(out, up, k + 1, n_segments);
        uint16_t a = add_vertex(m, mesh_ring_point(low.r, low.y, k, n_segments), n0, no_uv);
        uint16_t b = add_vertex(m, mesh_ring_point(high.r, high.y, k, n_segments), n0, no_uv);
        uint16_t c = add_vertex(m, mesh_ring_point(high.r, high.y, k + 1, n_segments), n1, no_uv);
        uint16_t d = add_vertex(m, mesh_ring_point(low.r, low.y, k + 1, n_segments), n1, no_uv);
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
    for (int i = 0; i < 8; i++)
        p[i] = (mesh_point){i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    mesh_quad(m, p[0], p[4], p[6], p[2]);
    mesh_quad(m, p[1], p[3], p[7], p[5]);
    mesh_quad(m, p[0], p[1], p[5], p[4]);
    mesh_quad(m, p[2], p[6], p[7], p[3]);
    mesh_quad(m, p[0], p[2], p[3], p[1]);
    mesh_quad(m, p[4], p[5], p[7], p[6]);
}

mesh_frame mesh_frame_along(mesh_point origin, mesh_point y)
{
    mesh_point aside = fabs(y.y) < 0.9 ? (mesh_point){0, 1, 0} : (mesh_point){0, 0, 1};
    mesh_point x = mesh_unit(mesh_cross(y, aside));
    return (mesh_frame){origin, x, y, mesh_cross(x, y)};
}

void mesh_rod(mesh_builder *m, mesh_point a, mesh_point b, double radius, size_t n_segments)
{
    const mesh_frame outer = m->place;
    mesh_point axis = mesh_sub(b, a);
    double length = sqrt(mesh_dot(axis, axis));
    m->place = mesh_frame_along(mesh_add(along_axes(&outer, a), outer.origin), mesh_unit(along_axes(&outer, axis)));
    mesh_lathe(m, (mesh_profile[]){{0, 0}, {radius, 0}, {radius, length}, {0, length}}, 4, n_segments);
    m->place = outer;
}

void mesh_ball(mesh_builder *m, mesh_point centre, double radius, size_t n_rings, size_t n_segments)
{
    const mesh_uv no_uv = {0, 0};
    const bool smooth = (m->attributes & MESH_NORMALS) != 0;
    for (size_t i = 0; i < n_rings; i++) {
        for (size_t k = 0; k < n_segments; k++) {
            uint16_t corner[4]; /* low, high, high and next, low and next */
            for (size_t c = 0; c < 4; c++) {
                double angle = MESH_PI * (double)(i + (c == 1 || c == 2)) / (double)n_rings;
                mesh_point out = mesh_ring_point(sin(angle), -cos(angle), k + c / 2, n_segments);
                corner[c] = add_vertex(m, mesh_add(centre, mesh_scale(out, radius)), mesh_scale(out, smooth), no_uv);
            }
            add_triangle(m, corner[0], corner[1], corner[2]);
            add_triangle(m, corner[0], corner[2], corner[3]);
        }
    }
}
