/* Determinants without rounding, for the few rays that doubles cannot decide.
 *
 * A value is an expansion: a sum of doubles that do not overlap, smallest first (Dekker; Shewchuk, Adaptive precision
 * floating-point arithmetic, 1997). Sums and products of expansions are exact in round-to-nearest as long as nothing
 * overflows and no rounding error underflows: for coordinates of magnitude 1e-50 to 1e50 (or 0) nothing does.
 */
#ifndef GNOMON_TRUTH_EXACT_H
#define GNOMON_TRUTH_EXACT_H

#include <stdbool.h>

#include "../ref/ref_math.h"

/* The point (sum of weight[k] * vertex[k]) / (sum of weight[k]), by definition: no rounding lies between it and its
 * triangle's plane. Weights are not negative, and not all 0. */
typedef struct {
    vec3 vertex[3];
    double weight[3];
} exact_point;

/* Where a ray goes: a point, or a direction. */
typedef struct {
    vec3 at;
    bool infinite; /* at is a direction, the point infinitely far along it */
} exact_target;

/* det(target - p, a - p, b - p), with the direction itself for target - p if that is infinite; times the sum of the
 * weights. The sign is exact, the value within a few units in its last place. */
double exact_edge(const exact_point *p, const exact_target *target, vec3 a, vec3 b);

/* det(a - p, b - p, c - p) times the sum of the weights, likewise. */
double exact_volume(const exact_point *p, vec3 a, vec3 b, vec3 c);

/* The side of the edge from a to b on which the line from p to the target passes: 1, -1; 0 only if the edge is a point
 * as seen from the target. A line through the edge is judged as that of p + (e, e^2, e^3), e infinitely small: it
 * passes beside every edge, on opposite sides of (a, b) and (b, a). */
int exact_side(const exact_point *p, const exact_target *target, vec3 a, vec3 b);

#endif
