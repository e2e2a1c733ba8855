/* Determinants without rounding. */
#include "exact.h"

#include <float.h>
#include <string.h>

_Static_assert(FLT_EVAL_METHOD == 0 && FLT_RADIX == 2 && DBL_MANT_DIG == 53,
               "exact arithmetic stands on plain IEEE doubles");

/* Components that each step needs at most: a difference of doubles 2, a minor 2 * (2 * 2 * 2), a determinant
 * 3 * (2 * 2 * 16), with its weight twice that, and the sum of three of them. */
enum { DIFFERENCE = 2, PRODUCT = 8, MINOR = 16, TERM = 64, DETERMINANT = 192, WEIGHTED = 384, SUM = 1152 };

/* x + y = a + b, x the rounded sum */
static void two_sum(double a, double b, double *x, double *y)
{
    *x = a + b;
    const double b_part = *x - a;
    const double a_part = *x - b_part;
    *y = (a - a_part) + (b - b_part);
}

static void two_product(double a, double b, double *x, double *y)
{
    *x = a * b;
    *y = fma(a, b, -*x);
}

static int append(double *h, int n, double component)
{
    if (component > 0.0 || component < 0.0) h[n++] = component;
    return n;
}

/* The next component of two expansions in order of magnitude. */
static double take_smaller(const double *e, int ne, int *i, const double *f, int nf, int *j)
{
    if (*i < ne && (*j >= nf || fabs(e[*i]) < fabs(f[*j]))) return e[(*i)++];
    return f[(*j)++];
}

/* h = e + f; capacity of h: ne + nf. Shewchuk's fast expansion sum. */
static int add(double *h, const double *e, int ne, const double *f, int nf)
{
    if (ne + nf == 0) return 0;
    int i = 0, j = 0, n = 0;
    double q = take_smaller(e, ne, &i, f, nf, &j), low;
    while (i < ne || j < nf) {
        two_sum(q, take_smaller(e, ne, &i, f, nf, &j), &q, &low);
        n = append(h, n, low);
    }
    return append(h, n, q);
}

/* h = e * b; capacity of h: 2 * ne. Shewchuk's scale expansion. */
static int scale(double *h, const double *e, int ne, double b)
{
    if (ne == 0) return 0;
    double q, low, high, product, rest;
    two_product(e[0], b, &q, &low);
    int n = append(h, 0, low);
    for (int i = 1; i < ne; i++) {
        two_product(e[i], b, &product, &rest);
        two_sum(q, rest, &high, &low);
        n = append(h, n, low);
        two_sum(product, high, &q, &low);
        n = append(h, n, low);
    }
    return append(h, n, q);
}

typedef struct {
    int n;
    double c[DIFFERENCE];
} difference;

/* h = e * f; capacity of h: 4 * ne, at most TERM. */
static int multiply(double *h, const double *e, int ne, const difference *f)
{
    double first[TERM], second[TERM];
    const int n_first = f->n > 0 ? scale(first, e, ne, f->c[0]) : 0,
              n_second = f->n > 1 ? scale(second, e, ne, f->c[1]) : 0;
    return add(h, first, n_first, second, n_second);
}

static int negate(double *h, const double *e, int ne)
{
    for (int i = 0; i < ne; i++) h[i] = -e[i];
    return ne;
}

typedef struct {
    difference x[3];
} row;

static difference subtract(double a, double b)
{
    difference d;
    double high, low;
    two_sum(a, -b, &high, &low);
    d.n = append(d.c, 0, low);
    d.n = append(d.c, d.n, high);
    return d;
}

static row row_between(vec3 to, vec3 from)
{
    return (row){{subtract(to.x, from.x), subtract(to.y, from.y), subtract(to.z, from.z)}};
}

/* Component k of a x b; capacity of h: MINOR. */
static int minor(double *h, const row *a, const row *b, int k)
{
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    double plus[PRODUCT], minus[PRODUCT];
    const int n_plus = multiply(plus, a->x[i].c, a->x[i].n, &b->x[j]);
    int n_minus = multiply(minus, a->x[j].c, a->x[j].n, &b->x[i]);
    n_minus = negate(minus, minus, n_minus);
    return add(h, plus, n_plus, minus, n_minus);
}

/* det(a, b, c) = a . (b x c); capacity of h: DETERMINANT. */
static int determinant(double *h, const row *a, const row *b, const row *c)
{
    double sum[DETERMINANT], term[TERM], m[MINOR];
    int n = 0;
    for (int k = 0; k < 3; k++) {
        const int n_minor = minor(m, b, c, k), n_term = multiply(term, m, n_minor, &a->x[k]);
        n = add(h, sum, n, term, n_term);
        memcpy(sum, h, (size_t)n * sizeof *h);
    }
    return n;
}

/* The components grow: each is more than all before it together, and the last decides the sign. */
static double approximate(const double *e, int ne)
{
    double sum = 0.0;
    for (int i = 0; i < ne; i++) sum += e[i];
    return sum;
}

static int sign(const double *e, int ne)
{
    return ne == 0 ? 0 : e[ne - 1] > 0.0 ? 1 : -1;
}

/* ---- sums over the three vertices of the point: the determinants below are affine in it ---- */

static int add_weighted(double *sum, int n, const double *det, int n_det, double weight)
{
    double weighted[WEIGHTED], total[SUM];
    n = add(total, sum, n, weighted, scale(weighted, det, n_det, weight));
    memcpy(sum, total, (size_t)n * sizeof *sum);
    return n;
}

double exact_edge(const exact_point *p, const exact_target *target, vec3 a, vec3 b)
{
    const vec3 zero = {0.0, 0.0, 0.0};
    double sum[SUM], det[DETERMINANT];
    int n = 0;
    for (int k = 0; k < 3; k++) {
        const vec3 v = p->vertex[k];
        const row to = row_between(target->at, target->infinite ? zero : v), ra = row_between(a, v),
                  rb = row_between(b, v);
        n = add_weighted(sum, n, det, determinant(det, &to, &ra, &rb), p->weight[k]);
    }
    return approximate(sum, n);
}

double exact_volume(const exact_point *p, vec3 a, vec3 b, vec3 c)
{
    double sum[SUM], det[DETERMINANT];
    int n = 0;
    for (int k = 0; k < 3; k++) {
        const vec3 v = p->vertex[k];
        const row ra = row_between(a, v), rb = row_between(b, v), rc = row_between(c, v);
        n = add_weighted(sum, n, det, determinant(det, &ra, &rb, &rc), p->weight[k]);
    }
    return approximate(sum, n);
}

/* The gradient of exact_edge's determinant to p: direction x (b - a), or (b - target) x (a - target). */
static int gradient_sign(const exact_target *target, vec3 a, vec3 b, int k)
{
    const vec3 zero = {0.0, 0.0, 0.0};
    double m[MINOR];
    const row first = target->infinite ? row_between(target->at, zero) : row_between(b, target->at);
    const row second = target->infinite ? row_between(b, a) : row_between(a, target->at);
    return sign(m, minor(m, &first, &second, k));
}

int exact_side(const exact_point *p, const exact_target *target, vec3 a, vec3 b)
{
    const double edge = exact_edge(p, target, a, b);
    int side = (edge > 0.0) - (edge < 0.0);
    for (int k = 0; k < 3 && side == 0; k++) side = gradient_sign(target, a, b, k);
    return side;
}
