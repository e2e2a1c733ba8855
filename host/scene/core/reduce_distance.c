/* How far two surfaces are apart: nearest triangles are found in a tree of boxes. */
#include <math.h>
#include <stdlib.h>

#include "reduce.h"
#include "vec.h"

/* ---- One triangle ------------------------------------------------------------------------------------------------ */

static double segment2(const double *p, const double *a, const double *b)
{
    double along[3], to[3], rest[3];
    vec_sub(along, b, a);
    vec_sub(to, p, a);
    const double length2 = vec_dot(along, along);
    const double t = length2 > 0 ? fmin(fmax(vec_dot(to, along) / length2, 0), 1) : 0;
    for (int k = 0; k < 3; k++) rest[k] = to[k] - t * along[k];
    return vec_dot(rest, rest);
}

/* The squared distance of a point from a triangle: of its plane where it projects inside, else of the nearest edge. */
static double triangle2(const double *p, const double *a, const double *b, const double *c)
{
    const double *corner[3] = {a, b, c};
    double u[3], v[3], n[3], to[3];
    vec_sub(u, b, a);
    vec_sub(v, c, a);
    vec_cross(n, u, v);
    vec_sub(to, p, a);
    bool inside = vec_dot(n, n) > 0;
    for (int i = 0; inside && i < 3; i++) {
        double edge[3], at[3], across[3];
        vec_sub(edge, corner[(i + 1) % 3], corner[i]);
        vec_sub(at, p, corner[i]);
        vec_cross(across, edge, at);
        inside = vec_dot(across, n) >= 0;
    }
    if (inside) return vec_dot(to, n) * vec_dot(to, n) / vec_dot(n, n);
    return fmin(segment2(p, a, b), fmin(segment2(p, b, c), segment2(p, c, a)));
}

static const double *corner_of(const reduce_surface *s, size_t triangle, int i)
{
    return s->pos + 3 * (size_t)s->idx[3 * triangle + (size_t)i];
}

/* ---- A tree of boxes --------------------------------------------------------------------------------------------- */

enum { LEAF = 4 };

/* Of node i: around its triangles, order[first .. first + n - 1]. If these are more than LEAF, node 2 i + 1 has the
 * first n / 2 of them, and node 2 i + 2 the others. */
typedef struct {
    double low[3], high[3];
} box;

typedef struct {
    const reduce_surface *surface;
    uint32_t *order;
    box *node;
    size_t n_compared;
} tree;

static double middle_of(const reduce_surface *s, size_t triangle, int axis)
{
    return corner_of(s, triangle, 0)[axis] + corner_of(s, triangle, 1)[axis] + corner_of(s, triangle, 2)[axis];
}

static box box_of(const reduce_surface *s, const uint32_t *order, size_t n)
{
    box b;
    for (int k = 0; k < 3; k++) b.low[k] = (double)INFINITY, b.high[k] = -(double)INFINITY;
    for (size_t t = 0; t < n; t++)
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) {
                b.low[k] = fmin(b.low[k], corner_of(s, order[t], i)[k]);
                b.high[k] = fmax(b.high[k], corner_of(s, order[t], i)[k]);
            }
    return b;
}

/* The lower half along an axis comes first: by quickselect. */
static void halve(const reduce_surface *s, uint32_t *order, size_t n, int axis)
{
    size_t from = 0, to = n - 1;
    const size_t half = n / 2;
    while (from < to) {
        const double pivot = middle_of(s, order[from + (to - from) / 2], axis);
        size_t i = from, j = to;
        for (;;) {
            while (middle_of(s, order[i], axis) < pivot) i++;
            while (middle_of(s, order[j], axis) > pivot) j--;
            if (i >= j) break;
            const uint32_t swapped = order[i];
            order[i++] = order[j];
            order[j--] = swapped;
        }
        if (half <= j) to = j;
        else from = j + 1;
    }
}

static void build(tree *t, size_t node, size_t first, size_t n)
{
    box *b = &t->node[node];
    int axis = 0;
    *b = box_of(t->surface, t->order + first, n);
    if (n <= LEAF) return;
    for (int k = 1; k < 3; k++)
        if (b->high[k] - b->low[k] > b->high[axis] - b->low[axis]) axis = k;
    halve(t->surface, t->order + first, n, axis);
    build(t, 2 * node + 1, first, n / 2);
    build(t, 2 * node + 2, first + n / 2, n - n / 2);
}

static int tree_begin(tree *t, const reduce_surface *s)
{
    size_t n_nodes = 1;
    for (size_t n = s->n_triangles; n > LEAF; n -= n / 2) n_nodes = 2 * n_nodes + 1;
    *t = (tree){
        .surface = s, .order = malloc(s->n_triangles * sizeof *t->order), .node = malloc(n_nodes * sizeof *t->node)};
    if (!t->order || !t->node) return -1;
    for (size_t i = 0; i < s->n_triangles; i++) t->order[i] = (uint32_t)i;
    build(t, 0, 0, s->n_triangles);
    return 0;
}

static void tree_free(tree *t)
{
    free(t->order);
    free(t->node);
}

static double box2(const double *p, const box *b)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double out = fmax(fmax(b->low[k] - p[k], p[k] - b->high[k]), 0);
        sum += out * out;
    }
    return sum;
}

/* Lessens *nearest2 to the distance from a node's triangles; no need to know one that is not more than `enough2`. */
static void search(tree *t, size_t node, size_t first, size_t n, const double *p, double enough2, double *nearest2)
{
    if (n <= LEAF) {
        for (size_t i = first; i < first + n; i++) {
            const size_t k = t->order[i];
            const reduce_surface *s = t->surface;
            *nearest2 = fmin(*nearest2, triangle2(p, corner_of(s, k, 0), corner_of(s, k, 1), corner_of(s, k, 2)));
            t->n_compared++;
        }
        return;
    }
    const double to[2] = {box2(p, &t->node[2 * node + 1]), box2(p, &t->node[2 * node + 2])};
    for (int i = 0, half = to[1] < to[0]; i < 2; i++, half = !half) { /* the nearer one first */
        if (to[half] >= *nearest2 || *nearest2 <= enough2) continue;
        search(t, 2 * node + 1 + (size_t)half, half ? first + n / 2 : first, half ? n - n / 2 : n / 2, p, enough2,
               nearest2);
    }
}

static double distance2(tree *t, const double *p, double enough2)
{
    double nearest2 = (double)INFINITY;
    search(t, 0, 0, t->surface->n_triangles, p, enough2, &nearest2);
    return nearest2;
}

/* ---- Two surfaces ------------------------------------------------------------------------------------------------ */

int reduce_distance(const reduce_surface *from, const reduce_surface *to, double *off, size_t *n_compared)
{
    double farthest2 = 0;
    tree t;
    *off = from->n_triangles ? (double)INFINITY : 0;
    if (from->n_triangles == 0 || to->n_triangles == 0) return 0;
    const int failed = tree_begin(&t, to);
    for (size_t k = 0; !failed && k < from->n_triangles; k++) {
        double middle[3] = {0, 0, 0};
        for (int i = 0; i < 3; i++) {
            const double *corner = corner_of(from, k, i);
            for (int axis = 0; axis < 3; axis++) middle[axis] += corner[axis] / 3;
            farthest2 = fmax(farthest2, distance2(&t, corner, farthest2));
        }
        farthest2 = fmax(farthest2, distance2(&t, middle, farthest2));
    }
    *off = sqrt(farthest2);
    *n_compared += t.n_compared;
    tree_free(&t);
    return failed;
}
