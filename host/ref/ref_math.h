/* Vectors of the reference engine, double precision. */
#ifndef GNOMON_REF_MATH_H
#define GNOMON_REF_MATH_H

#include <math.h>

typedef struct {
    double x, y;
} vec2;
typedef struct {
    double x, y, z;
} vec3;

static inline vec3 vec3_load(const double *p)
{
    return (vec3){p[0], p[1], p[2]};
}
static inline void vec3_store(double *p, vec3 a)
{
    p[0] = a.x;
    p[1] = a.y;
    p[2] = a.z;
}
static inline vec3 vec3_add(vec3 a, vec3 b)
{
    return (vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline vec3 vec3_sub(vec3 a, vec3 b)
{
    return (vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline vec3 vec3_scale(vec3 a, double f)
{
    return (vec3){a.x * f, a.y * f, a.z * f};
}
static inline vec3 vec3_mul(vec3 a, vec3 b)
{
    return (vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}
static inline double vec3_dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3 vec3_cross(vec3 a, vec3 b)
{
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* The zero vector stays zero: callers choose their own fallback. Divided by the largest component first, so that the
 * squares of the area vectors of tiny or huge triangles neither vanish nor overflow. */
static inline vec3 vec3_unit(vec3 a)
{
    const double largest = fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
    if (!(largest > 0.0)) return (vec3){0.0, 0.0, 0.0};
    const vec3 b = {a.x / largest, a.y / largest, a.z / largest};
    return vec3_scale(b, 1.0 / sqrt(vec3_dot(b, b)));
}

/* f[0] a[0] + f[1] a[1] + f[2] a[2]: interpolation with barycentrics. */
static inline vec3 vec3_mix(const double f[3], vec3 a0, vec3 a1, vec3 a2)
{
    return vec3_add(vec3_scale(a0, f[0]), vec3_add(vec3_scale(a1, f[1]), vec3_scale(a2, f[2])));
}

static inline double clamp(double x, double low, double high)
{
    return fmin(fmax(x, low), high);
}

static inline double lerp(double a, double b, double f)
{
    return a + f * (b - a);
}

static inline double frac(double x)
{
    return x - floor(x);
}

/* a x b in the plane. The operands are ordered first, so that cross2(b, a) is bit for bit -cross2(a, b) even where the
 * compiler fuses multiply and add: two triangles that share an edge then always disagree about the side of a point. */
static inline double cross2(vec2 a, vec2 b)
{
    if (a.x < b.x || (!(b.x < a.x) && a.y < b.y)) return a.x * b.y - a.y * b.x;
    return -(b.x * a.y - b.y * a.x);
}

/* The top-left rule as a perturbation: a sample on an edge is judged as if it lay infinitesimally to the right, and by
 * less still below. edge: value of the edge function at the sample; d_right, d_down: its derivatives. Returns -1 or 1;
 * 0 if the edge is a point. */
static inline int edge_side(double edge, double d_right, double d_down)
{
    if (edge > 0.0 || edge < 0.0) return edge > 0.0 ? 1 : -1;
    if (d_right > 0.0 || d_right < 0.0) return d_right > 0.0 ? 1 : -1;
    return (d_down > 0.0) - (d_down < 0.0);
}

#endif
