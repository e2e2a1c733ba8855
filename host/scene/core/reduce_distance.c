/* How far two surfaces are apart. */
#include <math.h>

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

/* Less than `limit` if the triangle's box is not farther than that: most triangles need no more. */
static bool box_within(const double *p, const double *a, const double *b, const double *c, double limit2)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double low = fmin(a[k], fmin(b[k], c[k])), high = fmax(a[k], fmax(b[k], c[k]));
        const double out = fmax(fmax(low - p[k], p[k] - high), 0);
        sum += out * out;
    }
    return sum < limit2;
}

/* `enough2`: no need to know a smaller distance than this. The search begins at triangle `*near`, which that of the
 * point before was nearest to: most points need no other. */
static double distance2(const double *p, const reduce_surface *to, double enough2, size_t *near)
{
    const size_t first = *near;
    double nearest2 = (double)INFINITY;
    for (size_t k = 0; k < to->n_triangles && nearest2 > enough2; k++) {
        const size_t t = first + k < to->n_triangles ? first + k : first + k - to->n_triangles;
        const uint32_t *i = to->idx + 3 * t;
        const double *a = to->pos + 3 * (size_t)i[0], *b = to->pos + 3 * (size_t)i[1], *c = to->pos + 3 * (size_t)i[2];
        if (!box_within(p, a, b, c, nearest2)) continue;
        const double d2 = triangle2(p, a, b, c);
        if (d2 >= nearest2) continue;
        nearest2 = d2;
        *near = t;
    }
    return nearest2;
}

double reduce_distance(const reduce_surface *from, const reduce_surface *to)
{
    double farthest2 = 0;
    size_t near = 0;
    if (to->n_triangles == 0) return from->n_triangles ? (double)INFINITY : 0;
    for (size_t t = 0; t < from->n_triangles; t++) {
        double middle[3] = {0, 0, 0};
        for (int i = 0; i < 3; i++) {
            const double *corner = from->pos + 3 * (size_t)from->idx[3 * t + (size_t)i];
            for (int k = 0; k < 3; k++) middle[k] += corner[k] / 3;
            farthest2 = fmax(farthest2, distance2(corner, to, farthest2, &near));
        }
        farthest2 = fmax(farthest2, distance2(middle, to, farthest2, &near));
    }
    return sqrt(farthest2);
}
