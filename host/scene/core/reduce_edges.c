/* Reduction of meshes: what a collapse costs, and which ones leave the mesh what it is. */
#include <math.h>
#include <string.h>

#include "reduce_internal.h"
#include "vec.h"

/* Of borders and seams against faces: they are lines that the eye follows. */
#define BORDER_WEIGHT 10.0
/* Of the turn, 45 degrees, that makes a corner of a border. */
#define COS_BORDER 0.7

size_t reduce_corners(const reduce_mesh *m, uint32_t point, uint32_t *out)
{
    size_t n = 0;
    for (uint32_t c = m->head[point]; c != REDUCE_NONE; c = m->next[c]) {
        if (m->dead[c / 3]) continue;
        if (n > REDUCE_CORNERS_MAX) break;
        out[n++] = c;
    }
    return n;
}

/* ---- Quadrics ---------------------------------------------------------------------------------------------------- */

static void add_plane(reduce_quadric *q, const double *n, const double *at, double weight)
{
    static const int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
    const double d = -vec_dot(n, at);
    for (int i = 0; i < 6; i++) q->nn[i] += weight * n[row[i]] * n[column[i]];
    for (int i = 0; i < 3; i++) q->nd[i] += weight * n[i] * d;
    q->dd += weight * d * d;
}

static double quadric_at(const reduce_quadric *q, const double *p)
{
    const double *a = q->nn;
    return p[0] * (a[0] * p[0] + 2 * (a[1] * p[1] + a[2] * p[2] + q->nd[0])) +
           p[1] * (a[3] * p[1] + 2 * (a[4] * p[2] + q->nd[1])) + p[2] * (a[5] * p[2] + 2 * q->nd[2]) + q->dd;
}

/* The normal, as long as twice the area. */
static void face(double *out, const double *a, const double *b, const double *c)
{
    double u[3], v[3];
    vec_sub(u, b, a);
    vec_sub(v, c, a);
    vec_cross(out, u, v);
}

/* The triangles at the edge that begins in `corner`: how many, and of the last other one the corners at its two ends.
 */
static int edge_triangles(const reduce_mesh *m, uint32_t corner, uint32_t other[2])
{
    const uint32_t to = reduce_point(m, reduce_next(corner));
    int n = 0;
    for (uint32_t c = m->head[reduce_point(m, corner)]; c != REDUCE_NONE; c = m->next[c]) {
        const uint32_t b = reduce_next(c), a = reduce_next(b);
        if (m->dead[c / 3] || (reduce_point(m, a) != to && reduce_point(m, b) != to)) continue;
        n++;
        if (c / 3 == corner / 3) continue;
        other[0] = c;
        other[1] = reduce_point(m, a) == to ? a : b;
    }
    return n;
}

static bool same_uv(const scene_mesh *mesh, uint32_t a, uint32_t b)
{
    return !mesh->uv || a == b || memcmp(mesh->uv + 2 * (size_t)a, mesh->uv + 2 * (size_t)b, 2 * sizeof(double)) == 0;
}

/* A plane through a border or seam, upright on its face: moving off it costs. */
static void add_edge(reduce_mesh *m, uint32_t corner, const double *normal)
{
    uint32_t other[2] = {0, 0};
    const uint32_t a = m->mesh->idx[corner], b = m->mesh->idx[reduce_next(corner)];
    const int n = edge_triangles(m, corner, other);
    if (n > 2) m->locked[m->point_of[a]] = m->locked[m->point_of[b]] = true;
    if (n != 1 && same_uv(m->mesh, a, m->mesh->idx[other[0]]) && same_uv(m->mesh, b, m->mesh->idx[other[1]])) return;
    double along[3], upright[3];
    vec_sub(along, m->world + 3 * (size_t)b, m->world + 3 * (size_t)a);
    vec_cross(upright, along, normal);
    if (!vec_normalise(upright)) return;
    const double weight = BORDER_WEIGHT * vec_dot(along, along);
    add_plane(&m->quadric[m->point_of[a]], upright, m->world + 3 * (size_t)a, weight);
    add_plane(&m->quadric[m->point_of[b]], upright, m->world + 3 * (size_t)a, weight);
}

void reduce_quadrics(reduce_mesh *m)
{
    for (uint32_t t = 0; t < m->mesh->n_triangles; t++) {
        const uint32_t *idx = m->mesh->idx + 3 * (size_t)t;
        const double *at = m->world + 3 * (size_t)idx[0];
        double normal[3];
        face(normal, at, m->world + 3 * (size_t)idx[1], m->world + 3 * (size_t)idx[2]);
        const double area = 0.5 * sqrt(vec_dot(normal, normal));
        if (!vec_normalise(normal)) continue;
        for (uint32_t i = 0; i < 3; i++) {
            add_plane(&m->quadric[m->point_of[idx[i]]], normal, at, area);
            add_edge(m, 3 * t + i, normal);
        }
    }
}

double reduce_cost(const reduce_mesh *m, uint32_t from, uint32_t to)
{
    const double *a = m->world + 3 * (size_t)from, *b = m->world + 3 * (size_t)to;
    double step[3];
    vec_sub(step, b, a);
    /* in a plane, where nothing is lost, short moves first */
    const double length2 = vec_dot(step, step),
                 lost = quadric_at(&m->quadric[from], b) + quadric_at(&m->quadric[to], b);
    return fmax(lost, 0) + 1e-6 * length2 * length2;
}

/* ---- What is allowed --------------------------------------------------------------------------------------------- */

/* The points around a point, and by how many triangles each edge to them is. */
typedef struct {
    size_t n;
    uint32_t point[2 * REDUCE_CORNERS_MAX + 2];
    int n_triangles[2 * REDUCE_CORNERS_MAX + 2];
} ring;

static void ring_add(ring *r, uint32_t point)
{
    size_t i = 0;
    while (i < r->n && r->point[i] != point) i++;
    if (i == r->n) {
        r->point[r->n] = point;
        r->n_triangles[r->n++] = 0;
    }
    r->n_triangles[i]++;
}

static void ring_of(ring *r, const reduce_mesh *m, const uint32_t *corner, size_t n)
{
    r->n = 0;
    for (size_t i = 0; i < n; i++) {
        ring_add(r, reduce_point(m, reduce_next(corner[i])));
        ring_add(r, reduce_point(m, reduce_next(reduce_next(corner[i]))));
    }
}

static int ring_edge(const ring *r, uint32_t point)
{
    for (size_t i = 0; i < r->n; i++)
        if (r->point[i] == point) return r->n_triangles[i];
    return 0;
}

static bool is_border(const ring *r)
{
    for (size_t i = 0; i < r->n; i++)
        if (r->n_triangles[i] == 1) return true;
    return false;
}

/* Whether a border goes through the point nearly straight: it has no corner there. */
static bool is_straight(const reduce_mesh *m, const ring *r, uint32_t point)
{
    double edge[2][3];
    size_t n = 0;
    for (size_t i = 0; i < r->n; i++) {
        if (r->n_triangles[i] != 1) continue;
        if (n == 2) return false;
        vec_sub(edge[n], m->world + 3 * (size_t)r->point[i], m->world + 3 * (size_t)point);
        if (!vec_normalise(edge[n++])) return true;
    }
    return n < 2 || vec_dot(edge[0], edge[1]) < -COS_BORDER;
}

/* Something is left: a mesh does not vanish. */
static bool keeps_piece(const reduce_mesh *m, const uint32_t *corner, size_t n, uint32_t other)
{
    for (size_t i = 0; i < n; i++)
        if (reduce_point(m, reduce_next(corner[i])) != other &&
            reduce_point(m, reduce_next(reduce_next(corner[i]))) != other)
            return true;
    return false;
}

/* The link condition: the neighbours of both are the far corners of the triangles that vanish. A point on a border
 * moves along it alone, so that no hole closes and no two borders meet. */
static bool keeps_shape(const ring *a, const ring *b, uint32_t from, uint32_t to)
{
    const int n_shared = ring_edge(a, to);
    int n_common = 0;
    for (size_t i = 0; i < a->n; i++)
        if (a->point[i] != to && a->point[i] != from && ring_edge(b, a->point[i])) n_common++;
    return n_common == n_shared && n_shared == (is_border(a) ? 1 : 2);
}

/* No triangle that moves turns over, loses its area, or falls onto another. */
static bool keeps_faces(const reduce_mesh *m, const reduce_step *step, uint32_t to, const uint32_t *corner_b,
                        size_t n_b)
{
    for (size_t i = 0; i < step->n; i++) {
        const uint32_t c = step->corner[i], p = reduce_point(m, reduce_next(c)),
                       q = reduce_point(m, reduce_next(reduce_next(c)));
        double before[3], after[3];
        if (p == to || q == to) continue;
        const double *at = m->world + 3 * (size_t)reduce_point(m, c), *pw = m->world + 3 * (size_t)p,
                     *qw = m->world + 3 * (size_t)q;
        face(before, at, pw, qw);
        face(after, m->world + 3 * (size_t)to, pw, qw);
        double longest = 0, edge[3];
        const double *corner[3] = {m->world + 3 * (size_t)to, pw, qw};
        for (int k = 0; k < 3; k++) {
            vec_sub(edge, corner[k], corner[(k + 1) % 3]);
            longest = fmax(longest, vec_dot(edge, edge));
        }
        if (!(sqrt(vec_dot(after, after)) > 1e-3 * longest)) return false; /* a sliver */
        if (vec_normalise(before) && (!vec_normalise(after) || vec_dot(before, after) < 0.25)) return false;
        for (size_t k = 0; k < n_b; k++) {
            const uint32_t x = reduce_point(m, reduce_next(corner_b[k])),
                           y = reduce_point(m, reduce_next(reduce_next(corner_b[k])));
            if ((x == p && y == q) || (x == q && y == p)) return false;
        }
    }
    return true;
}

/* The vertex of `to` that the vertex `v` becomes, as the triangles that vanish have both; REDUCE_NONE: they do not say,
 * or say two. */
static uint32_t across(const reduce_mesh *m, const reduce_step *step, uint32_t to, uint32_t v, bool any_of_its_uv)
{
    uint32_t found = REDUCE_NONE;
    for (size_t i = 0; i < step->n; i++) {
        const uint32_t c = step->corner[i], own = m->mesh->idx[c];
        if (any_of_its_uv ? !same_uv(m->mesh, own, v) : own != v) continue;
        for (uint32_t e = reduce_next(c); e != c; e = reduce_next(e)) {
            if (reduce_point(m, e) != to) continue;
            if (found != REDUCE_NONE && found != m->mesh->idx[e]) {
                if (!any_of_its_uv || !same_uv(m->mesh, found, m->mesh->idx[e])) return REDUCE_NONE;
            } else found = m->mesh->idx[e];
        }
    }
    return found;
}

/* What the corners become. A vertex that the vanishing triangles do not have, of a hard edge, keeps its normal and
 * colour, and takes the rest from one of its texture coordinates. */
static bool find_vertices(const reduce_mesh *m, reduce_step *step, uint32_t to)
{
    for (size_t i = 0; i < step->n; i++) {
        const uint32_t c = step->corner[i], v = m->mesh->idx[c];
        step->becomes[i] = step->source[i] = REDUCE_NONE;
        step->keeps[i] = false;
        if (reduce_point(m, reduce_next(c)) == to || reduce_point(m, reduce_next(reduce_next(c))) == to) continue;
        step->becomes[i] = across(m, step, to, v, false);
        if (step->becomes[i] != REDUCE_NONE) continue;
        step->source[i] = across(m, step, to, v, true);
        if (step->source[i] == REDUCE_NONE) return false;
        step->becomes[i] = v;
        step->keeps[i] = true;
    }
    return true;
}

bool reduce_allowed(const reduce_mesh *m, uint32_t from, uint32_t to, reduce_step *step)
{
    uint32_t corner_b[REDUCE_CORNERS_MAX + 1];
    ring a, b;
    if (m->locked[from] || m->locked[to]) return false;
    step->n = reduce_corners(m, from, step->corner);
    const size_t n_b = reduce_corners(m, to, corner_b);
    if (step->n > REDUCE_CORNERS_MAX || n_b > REDUCE_CORNERS_MAX) return false;
    ring_of(&a, m, step->corner, step->n);
    ring_of(&b, m, corner_b, n_b);
    if (!keeps_piece(m, step->corner, step->n, to) && !keeps_piece(m, corner_b, n_b, from)) return false;
    return keeps_shape(&a, &b, from, to) && is_straight(m, &a, from) && find_vertices(m, step, to) &&
           keeps_faces(m, step, to, corner_b, n_b);
}
