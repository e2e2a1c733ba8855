/* Does a ray from a surface point meet a triangle?
 *
 * With a, b, c the corners relative to the origin and L the way to the target, the line meets the triangle if the three
 * edge functions
 *
 *     e0 = det(L, b, c)    e1 = det(L, c, a)    e2 = det(L, a, b)
 *
 * have one sign, at t = det(a, b, c) / (e0 + e1 + e2), with barycentrics e / (e0 + e1 + e2); positive ones belong to a
 * triangle that faces the target. All that is decided here are signs of determinants. Each is computed in doubles along
 * with a bound on its error (below), and where the bound leaves the sign open, again without rounding (exact.c).
 *
 * Watertight: the sign of an edge function is thus the true one, so two triangles that share an edge, each from its own
 * side, never both see the line outside of it; there is no gap. Where an edge function is exactly 0 the line is judged
 * as one moved infinitely little, the same way for every edge (exact_side), so of the triangles around an edge or a
 * vertex that a line passes through it meets just those that the moved line meets: none twice, and none missed. Dither
 * casters multiply, and need the first as well.
 *
 * Self-hits: the origin is not a rounded point but the exact combination of its triangle's corners with the weights of
 * the visible surface. It lies in the plane of its own triangle without any error (det(a, b, c) is 0, which is no hit),
 * on the edges of its neighbours if a weight is 0, and behind or before them as the corners say. There is no distance
 * that a ray would have to start off by. (That its own triangle is skipped by name only saves the exact determinant.)
 *
 * What is left is that the corners themselves are rounded, where an object's transform put them into the world: faces
 * of two objects that should lie in one plane miss each other by such roundings. A hit counts if the origin is farther
 * behind the caster's plane than the two errors together: less, and rounding may have made it. That distance, det(a, b,
 * c) / |(B - A) x (C - A)|, is compared with the sum of the bounds of truth_vertex_error().
 */
#include "truth.h"

#include <float.h>

#define UNIT (DBL_EPSILON / 2.0) /* of the error of one operation */

static double largest(vec3 a)
{
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}

static double length(vec3 a)
{
    return sqrt(vec3_dot(a, a));
}

/* m0 x + m1 y + m2 z + m3 as ref_xform.c computes it: three products and three sums, none of the four terms in more
 * than four of them. gamma_4 is 4 u (1 + 4 u + ...): the 5 pays for that and for the roundings here. */
double truth_vertex_error(const ref_triangle *triangle)
{
    double worst = 0.0;
    for (int k = 0; k < 3; k++) {
        double p[3];
        scene_posed(p, triangle->mesh, triangle->object, triangle->idx[k]);
        double magnitude[3];
        for (int r = 0; r < 3; r++) {
            const double *m = triangle->object->to_world.m[r];
            magnitude[r] = fabs(m[0] * p[0]) + fabs(m[1] * p[1]) + fabs(m[2] * p[2]) + fabs(m[3]);
        }
        worst = fmax(worst, length(vec3_load(magnitude)));
    }
    return 5.0 * UNIT * worst;
}

/* Weights too small for exact arithmetic are none: this defines the point, 2^-100 of a triangle beside. */
static exact_point without_dust(const exact_point *p)
{
    exact_point out = *p;
    const double threshold = ldexp(fmax(p->weight[0], fmax(p->weight[1], p->weight[2])), -100);
    for (int k = 0; k < 3; k++)
        if (!(p->weight[k] > threshold)) out.weight[k] = 0.0;
    return out;
}

/* The numerator has a product and two sums, the divisor two sums, then the division: gamma_6 of the largest corner; and
 * the subtraction of the origin one more unit. */
truth_ray truth_make_ray(const exact_point *origin, exact_target target, double uncertainty)
{
    truth_ray ray = {.origin = without_dust(origin), .target = target, .uncertainty = uncertainty};
    const exact_point *o = &ray.origin;
    const double sum = o->weight[0] + o->weight[1] + o->weight[2];
    const double corner = fmax(largest(o->vertex[0]), fmax(largest(o->vertex[1]), largest(o->vertex[2])));
    const vec3 numerator = vec3_mix(o->weight, o->vertex[0], o->vertex[1], o->vertex[2]);
    ray.from = (vec3){numerator.x / sum, numerator.y / sum, numerator.z / sum};
    ray.from_error = 7.0 * UNIT * corner;
    ray.to = target.infinite ? target.at : vec3_sub(target.at, ray.from);
    ray.to_error = target.infinite ? 0.0 : ray.from_error + 2.0 * UNIT * largest(ray.to);
    return ray;
}

/* A triangle seen from the ray's origin, in doubles.
 *
 * Bounds: let M be the largest coordinate of a, b, c, in error by at most e each (the origin's error, and u M of the
 * subtraction), and L's largest by d. A determinant is six products of three. Errors of its entries change each by at
 * most (L + d)(M + e)^2 - L M^2 = d (M + e)^2 + L (2 M e + e^2); its own roundings, at most six on the way of any
 * product, by 6 u of L M^2 <= L M e * 6. Seven times the sum, for six, covers the second order and the roundings of the
 * bound itself. */
typedef struct {
    vec3 a, b, c;
    double edge_bound;   /* of e0, e1, e2 */
    double volume_bound; /* of det(a, b, c) */
} seen;

static seen look_at(const truth_ray *ray, const vec3 p[3])
{
    seen s = {.a = vec3_sub(p[0], ray->from), .b = vec3_sub(p[1], ray->from), .c = vec3_sub(p[2], ray->from)};
    const double m = fmax(largest(s.a), fmax(largest(s.b), largest(s.c))), e = ray->from_error + 2.0 * UNIT * m;
    const double l = largest(ray->to), d = ray->to_error;
    s.edge_bound = 7.0 * (d * (m + e) * (m + e) + l * e * (8.0 * m + e));
    s.volume_bound = 7.0 * e * (9.0 * m * m + 3.0 * m * e + e * e);
    return s;
}

/* Where one edge function is surely positive and another surely negative the line passes by: the common case, and the
 * only one that costs no more than nine products. */
static bool passes_by(const double edge[3], double bound)
{
    const double low = fmin(edge[0], fmin(edge[1], edge[2])), high = fmax(edge[0], fmax(edge[1], edge[2]));
    return low < -bound && high > bound;
}

/* The sign that the three edges have in common, or 0. */
static int common_side(const truth_ray *ray, const vec3 p[3], const double edge[3], double bound)
{
    int sum = 0;
    for (int k = 0; k < 3; k++) {
        if (edge[k] > bound) sum += 1;
        else if (edge[k] < -bound) sum -= 1;
        else sum += exact_side(&ray->origin, &ray->target, p[(k + 1) % 3], p[(k + 2) % 3]);
    }
    return sum == 3 ? 1 : sum == -3 ? -1 : 0;
}

/* Is the origin farther than the uncertainty behind the plane, as seen from the target? */
static bool lies_behind(const truth_ray *ray, const vec3 p[3], const seen *s, int side, double uncertainty)
{
    const double threshold = uncertainty * length(vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0])));
    const double volume = side * vec3_dot(s->a, vec3_cross(s->b, s->c));
    if (volume > threshold + s->volume_bound) return true;
    if (volume < threshold - s->volume_bound) return false;
    const double sum = ray->origin.weight[0] + ray->origin.weight[1] + ray->origin.weight[2];
    return side * exact_volume(&ray->origin, p[0], p[1], p[2]) / sum > threshold;
}

/* Values only from here on, nothing is decided by them but alpha, and near planes. */
static void locate(truth_hit *hit, const seen *s, const double edge[3], int side)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum += hit->bary[k] = fmax(0.0, side * edge[k]);
    for (int k = 0; k < 3; k++) hit->bary[k] = sum > 0.0 ? hit->bary[k] / sum : 1.0 / 3.0;
    hit->t = sum > 0.0 ? fmax(0.0, side * vec3_dot(s->a, vec3_cross(s->b, s->c)) / sum) : 0.0;
    hit->front = side > 0;
}

bool truth_meets(truth_hit *hit, const truth_ray *ray, const vec3 triangle[3], double uncertainty, bool two_sided)
{
    const seen s = look_at(ray, triangle);
    const double edge[3] = {vec3_dot(ray->to, vec3_cross(s.b, s.c)), vec3_dot(ray->to, vec3_cross(s.c, s.a)),
                            vec3_dot(ray->to, vec3_cross(s.a, s.b))};
    if (passes_by(edge, s.edge_bound)) return false;
    const int side = common_side(ray, triangle, edge, s.edge_bound);
    if (side == 0 || (side < 0 && !two_sided)) return false;
    if (!lies_behind(ray, triangle, &s, side, ray->uncertainty + uncertainty)) return false;
    locate(hit, &s, edge, side);
    return ray->target.infinite || hit->t < 1.0;
}

bool truth_meets_caster(truth_hit *hit, const truth_ray *ray, const truth_caster *c, bool two_sided)
{
    if (!truth_meets(hit, ray, c->p, c->uncertainty, true)) return false;
    if (c->source.instance->sign < 0) hit->front = !hit->front;
    return hit->front || two_sided;
}
