/* A property that changes over time, by keys: of nodes that glTF animates. */
#ifndef GNOMON_HOST_CURVE_H
#define GNOMON_HOST_CURVE_H

#include <stdbool.h>
#include <stddef.h>

typedef enum { CURVE_LINEAR, CURVE_STEP, CURVE_CUBIC } curve_kind;

typedef struct {
    curve_kind kind;
    size_t n_keys, width; /* 3 components, or 4 of a rotation: then linear is along the arc */
    double *times;        /* seconds, ascending */
    double *values;       /* width per key; cubic: in-tangent, value and out-tangent per key */
} scene_curve;

/* At a time, clamped to the ends. False: a rotation without length. */
bool curve_at(const scene_curve *curve, double time, double *out);

#endif
