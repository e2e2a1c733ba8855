/* How far two surfaces are apart. */
#include <math.h>
#include <stdlib.h>

#include "reduce.h"
#include "vec.h"

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

/* ---- A tree of boxes around the triangles of a surface -------------------------------------------------------------
 */

enum { LEAF = 4, STACK_MAX = 64, MORTON_BITS = 10 };

typedef struct {
    double low[3], high[3];
} box;

typedef struct {
    uint32_t code, triangle;
} coded;

typedef struct {
    const reduce_surface *of;
    coded *order; /* the triangles along a Morton curve, which keeps near ones together: LEAF of them per leaf */
    box *node;    /* the children of i are 2 i and 2 i + 1, from 1 on; leaves begin at n_leaves, a power of 2 */
    size_t n_leaves;
    uint32_t near;      /* the triangle that the point before was nearest to */
    size_t *n_compared; /* boxes and triangles that points were compared with */
} tree;

static const double *corner_of(const reduce_surface *s, size_t triangle, int i)
{
    return s->pos + 3 * (size_t)s->idx[3 * triangle + (size_t)i];
}

static const box nothing = {{(double)INFINITY, (double)INFINITY, (double)INFINITY},
                            {-(double)INFINITY, -(double)INFINITY, -(double)INFINITY}};

static void box_add(box *b, const double *low, const double *high)
{
    for (int k = 0; k < 3; k++) {
        if (low[k] < b->low[k]) b->low[k] = low[k];
        if (high[k] > b->high[k]) b->high[k] = high[k];
    }
}

/* The squared distance of a point; of a box around nothing: infinity. */
static double box2(const box *b, const double *p)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double out = p[k] < b->low[k] ? b->low[k] - p[k] : p[k] > b->high[k] ? p[k] - b->high[k] : 0;
        sum += out * out;
    }
    return sum;
}

static uint32_t spread(uint32_t bits)
{
    uint32_t out = 0;
    for (int i = 0; i < MORTON_BITS; i++) out |= (bits >> i & 1) << 3 * i;
    return out;
}

static uint32_t morton(const reduce_surface *s, size_t triangle, const box *all)
{
    uint32_t code = 0;
    for (int k = 0; k < 3; k++) {
        double at = 0;
        for (int i = 0; i < 3; i++) at += corner_of(s, triangle, i)[k] / 3;
        const double size = all->high[k] - all->low[k], cells = (1 << MORTON_BITS) - 1;
        const double cell = size > 0 ? (at - all->low[k]) / size * cells : 0;
        code |= spread((uint32_t)fmin(fmax(cell, 0), cells)) << k;
    }
    return code;
}

static int compare_coded(const void *a, const void *b)
{
    const coded *x = a, *y = b;
    if (x->code != y->code) return x->code < y->code ? -1 : 1;
    return (x->triangle > y->triangle) - (x->triangle < y->triangle);
}

static int tree_begin(tree *t, const reduce_surface *of, size_t *n_compared)
{
    const size_t n = of->n_triangles;
    box all = nothing;
    *t = (tree){.of = of, .n_leaves = 1, .n_compared = n_compared};
    while (t->n_leaves * LEAF < n) t->n_leaves *= 2;
    t->order = malloc(n * sizeof *t->order);
    t->node = malloc(2 * t->n_leaves * sizeof *t->node);
    if (!t->order || !t->node) return -1;
    for (size_t i = 0; i < 3 * n; i++)
        box_add(&all, of->pos + 3 * (size_t)of->idx[i], of->pos + 3 * (size_t)of->idx[i]);
    for (size_t i = 0; i < n; i++) t->order[i] = (coded){morton(of, i, &all), (uint32_t)i};
    qsort(t->order, n, sizeof *t->order, compare_coded);
    for (size_t i = 0; i < 2 * t->n_leaves; i++) t->node[i] = nothing;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) {
            const double *corner = corner_of(of, t->order[i].triangle, k);
            box_add(&t->node[t->n_leaves + i / LEAF], corner, corner);
        }
    for (size_t i = t->n_leaves - 1; i > 0; i--) {
        t->node[i] = t->node[2 * i];
        box_add(&t->node[i], t->node[2 * i + 1].low, t->node[2 * i + 1].high);
    }
    return 0;
}

static void tree_end(tree *t)
{
    free(t->order);
    free(t->node);
}

static double nearest_of(tree *t, const double *p, uint32_t triangle, double nearest2)
{
    const reduce_surface *s = t->of;
    const double d2 = triangle2(p, corner_of(s, triangle, 0), corner_of(s, triangle, 1), corner_of(s, triangle, 2));
    ++*t->n_compared;
    if (d2 >= nearest2) return nearest2;
    t->near = triangle;
    return d2;
}

/* `enough2`: no need to know a smaller distance than this. */
static double distance2(tree *t, const double *p, double enough2)
{
    size_t stack[STACK_MAX], n = 0;
    double nearest2 = nearest_of(t, p, t->near, (double)INFINITY);
    for (stack[n++] = 1; n > 0 && nearest2 > enough2;) {
        const size_t node = stack[--n];
        ++*t->n_compared;
        if (box2(&t->node[node], p) >= nearest2) continue;
        if (node < t->n_leaves) { /* the nearer child is looked at first */
            const size_t nearer =
                box2(&t->node[2 * node], p) <= box2(&t->node[2 * node + 1], p) ? 2 * node : 2 * node + 1;
            stack[n++] = nearer ^ 1;
            stack[n++] = nearer;
            continue;
        }
        const size_t first = (node - t->n_leaves) * LEAF;
        for (size_t i = first; i < first + LEAF && i < t->of->n_triangles; i++)
            nearest2 = nearest_of(t, p, t->order[i].triangle, nearest2);
    }
    return nearest2;
}

double reduce_distance(const reduce_surface *from, const reduce_surface *to, size_t *n_compared)
{
    double farthest2 = 0;
    tree t;
    if (to->n_triangles == 0) return from->n_triangles ? (double)INFINITY : 0;
    const int failed = tree_begin(&t, to, n_compared);
    for (size_t i = 0; !failed && i < from->n_triangles; i++) {
        double middle[3] = {0, 0, 0};
        for (int k = 0; k < 3; k++) {
            const double *corner = corner_of(from, i, k);
            for (int axis = 0; axis < 3; axis++) middle[axis] += corner[axis] / 3;
            farthest2 = fmax(farthest2, distance2(&t, corner, farthest2));
        }
        farthest2 = fmax(farthest2, distance2(&t, middle, farthest2));
    }
    tree_end(&t);
    return failed ? -1 : sqrt(farthest2);
}
