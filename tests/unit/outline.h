/* Outlines of triangles, exactly, and how far a place is from them: what a rasteriser may have wrong near an edge. Who
 * moves corners by no more than e along each axis moves every place of the outline by no more than that, so it decides
 * otherwise only of places that are no farther than e from it, the larger of both coordinates counted. */
#ifndef GNOMON_TESTS_OUTLINE_H
#define GNOMON_TESTS_OUTLINE_H

#include <math.h>

typedef long double real; /* 64 bits of mantissa hold the products of what the library is given */

typedef struct {
    int n;
    real p[4][2];
} outline;

/* The larger of both coordinates' distances from the nearest point of a side: convex along it, so least where two of
 * them meet, at 0, or an end. */
static inline real side_distance(const real a[2], const real b[2], const real q[2])
{
    const real x = a[0] - q[0], y = a[1] - q[1], dx = b[0] - a[0], dy = b[1] - a[1];
    const real over[4][2] = {{-x, dx}, {-y, dy}, {y - x, dx - dy}, {-x - y, dx + dy}};
    real best = fminl(fmaxl(fabsl(x), fabsl(y)), fmaxl(fabsl(x + dx), fabsl(y + dy)));
    for (int i = 0; i < 4; i++) {
        const real t = over[i][0] / over[i][1];
        if (t > 0 && t < 1) best = fminl(best, fmaxl(fabsl(x + t * dx), fabsl(y + t * dy)));
    }
    return best;
}

static inline real outline_distance(const outline *o, const real q[2])
{
    real best = HUGE_VALL;
    for (int i = 0; i < o->n; i++) best = fminl(best, side_distance(o->p[i], o->p[(i + 1) % o->n], q));
    return best;
}

static inline int outline_has(const outline *o, const real q[2])
{
    int more = 0, less = 0;
    for (int i = 0; i < o->n; i++) {
        const real *a = o->p[i], *b = o->p[(i + 1) % o->n];
        const real e = (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]);
        more += e > 0;
        less += e < 0;
    }
    return o->n >= 3 && (more == 0 || less == 0);
}

#endif
