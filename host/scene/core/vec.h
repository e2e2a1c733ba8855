/* Three-vectors and affine transforms in double, for host/scene only. */
#ifndef GNOMON_HOST_VEC_H
#define GNOMON_HOST_VEC_H

#include <math.h>
#include <stdbool.h>

#include "model.h"

#define VEC_PI 3.14159265358979323846

static inline double vec_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void vec_sub(double *out, const double *a, const double *b)
{
    for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}

static inline void vec_cross(double *out, const double *a, const double *b)
{
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/* Scales by the largest component first, so that neither 1e300 nor 1e-300 is lost. False, and v unchanged, for a zero
 * or non-finite vector. */
static inline bool vec_normalise(double *v)
{
    double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    if (!(largest > 0) || !isfinite(v[0]) || !isfinite(v[1]) || !isfinite(v[2])) return false;
    double scaled[3] = {v[0] / largest, v[1] / largest, v[2] / largest};
    double length = sqrt(vec_dot(scaled, scaled));
    for (int i = 0; i < 3; i++) v[i] = scaled[i] / length;
    return true;
}

static inline void affine_point(double *out, const scene_affine *a, const double *p)
{
    for (int i = 0; i < 3; i++) out[i] = vec_dot(a->m[i], p) + a->m[i][3];
}

static inline void affine_column(double *out, const scene_affine *a, int column)
{
    for (int i = 0; i < 3; i++) out[i] = a->m[i][column];
}

static inline scene_affine affine_identity(void)
{
    return (scene_affine){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

/* From a world whose z points up to one whose y does: what faced -y faces +z. */
static inline scene_affine affine_z_up(void)
{
    return (scene_affine){{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}}};
}

/* a after b */
static inline scene_affine affine_multiply(const scene_affine *a, const scene_affine *b)
{
    scene_affine out;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            out.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] + a->m[i][2] * b->m[2][j];
        }
        out.m[i][3] += a->m[i][3];
    }
    return out;
}

static inline bool affine_is_finite(const scene_affine *a)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            if (!isfinite(a->m[i][j])) return false;
        }
    }
    return true;
}

/* Sign of the determinant; 0: there is no inverse, as far as Q1.30 can tell. Rows are normalised, so that scales of any
 * size count alike. */
static inline int affine_sign(const scene_affine *a)
{
    double row[3][3], normal[3], largest = 0;
    int exp;
    for (int i = 0; i < 9; i++) largest = fmax(largest, fabs(a->m[i / 3][i % 3]));
    frexp(largest, &exp);
    for (int i = 0; i < 9; i++) row[i / 3][i % 3] = floor(ldexp(a->m[i / 3][i % 3], 30 - exp) + 0.5);
    for (int i = 0; i < 3; i++)
        if (!vec_normalise(row[i])) return 0;
    vec_cross(normal, row[1], row[2]);
    const double det = vec_dot(row[0], normal);
    return det > 0x1p-28 ? 1 : det < -0x1p-28 ? -1 : 0;
}

#endif
