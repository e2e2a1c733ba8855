/* Walks the pixels of a triangle row by row, by the top-left rule, exactly.
 *
 * Coordinates have `subpixel_bits` fraction bits, |coordinate| < 2^29. A row of pixels at y crosses an edge at x(y + 1/2); the
 * first pixel whose centre is at or right of it is ceil(x - 1/2) = ceil(M / dy) with an integer M that grows by dx per row
 * (NUMERICS 4.2). Quotient and remainder are stepped, so nothing is ever rounded, and two triangles that share an edge get
 * the same numbers: each pixel belongs to exactly one of them.
 */
#ifndef GN_WALK_H
#define GN_WALK_H

#include <stdint.h>

typedef struct {
    int32_t q;      /* first pixel right of the edge in the current row */
    int32_t r;      /* its remainder, 0 <= r < dy */
    int32_t dq, dr; /* their steps */
    int32_t dy;
} gn_edge;

typedef struct {
    gn_edge edge[2]; /* the edge over all rows, and the current one of the other two */
    int32_t y, y_mid, y_end;
    int32_t lower[4]; /* end points of the edge that takes over at y_mid: x0 y0 x1 y1 */
    int32_t subpixel_bits;
    int32_t long_edge_left; /* 1: edge[0] is the left border */
} gn_walk;

/* First row or column whose pixel centre is at or after a coordinate: ceil(c - 1/2). */
static inline int32_t gn_first_px(int32_t coord, int32_t subpixel_bits)
{
    return (coord + ((1 << subpixel_bits) >> 1) - 1) >> subpixel_bits; /* ceil((c - half) / 2^s), as 2^s - 1 - half = half - 1 */
}

/* Prepares rows y_lo <= y < y_hi of a triangle of any orientation. Returns 0 if there are none. */
int gn_walk_begin(gn_walk *walk, const int32_t x[3], const int32_t y[3], int32_t subpixel_bits, int32_t y_lo, int32_t y_hi);

/* The second of the two shorter edges takes over at row y_mid. */
void gn_walk_lower_edge(gn_walk *walk);

static inline void gn_edge_step(gn_edge *edge)
{
    edge->q += edge->dq;
    edge->r += edge->dr;
    if (edge->r >= edge->dy) {
        edge->r -= edge->dy;
        edge->q++;
    }
}

/* The span x_begin <= x < x_end (possibly empty) of row *y; steps to the next row. Returns 0 after the last row. */
static inline int gn_walk_row(gn_walk *walk, int32_t *y, int32_t *x_begin, int32_t *x_end)
{
    if (walk->y >= walk->y_end) return 0;
    if (walk->y == walk->y_mid) gn_walk_lower_edge(walk);
    *y = walk->y++;
    *x_begin = walk->edge[!walk->long_edge_left].q;
    *x_end = walk->edge[walk->long_edge_left].q;
    gn_edge_step(&walk->edge[0]);
    gn_edge_step(&walk->edge[1]);
    return 1;
}

#endif
