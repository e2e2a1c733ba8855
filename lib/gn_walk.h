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
    gn_edge edge[2];       /* the edge over all rows, and the current one of the other two */
    int32_t y, y_mid, y_end;
    int32_t lower[4];      /* end points of the edge that takes over at y_mid: x0 y0 x1 y1 */
    int32_t subpixel_bits;
    int32_t long_edge_left; /* 1: edge[0] is the left border */
} gn_walk;

/* First row or column whose pixel centre is at or after a coordinate: ceil(c - 1/2). */
int32_t gn_first_px(int32_t coord, int32_t subpixel_bits);

/* Prepares rows y_lo <= y < y_hi of a triangle of any orientation. Returns 0 if there are none. */
int gn_walk_begin(gn_walk *walk, const int32_t x[3], const int32_t y[3], int32_t subpixel_bits, int32_t y_lo, int32_t y_hi);

/* The span x_begin <= x < x_end (possibly empty) of row *y; steps to the next row. Returns 0 after the last row. */
int gn_walk_row(gn_walk *walk, int32_t *y, int32_t *x_begin, int32_t *x_end);

#endif
