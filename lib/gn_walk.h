/* Walks the pixels of a triangle row by row, by the top-left rule, exactly.
 *
 * Coordinates have `subpixel_bits` fraction bits, |coordinate| < 2^29. A row of pixels at y crosses an edge at x(y + 1/2); the
 * first pixel whose centre is at or right of it is ceil(x - 1/2) = ceil(M / dy) with an integer M that grows by dx per row
 * (NUMERICS 4.2). Of small triangles M / dy is stepped in fixed point, in so few rows that its error cannot reach the next multiple
 * of 1 / dy; of others as quotient and remainder. Either way nothing is ever off, and two triangles that share an edge get the same
 * numbers: each pixel belongs to exactly one of them.
 */
#ifndef GN_WALK_H
#define GN_WALK_H

#include <stdint.h>

/* M / dy of the current row, rounded up to a pixel in q. */
typedef struct {
    int32_t q, r;   /* quotient and remainder, 0 <= r < dy */
    int32_t dq, dr; /* their steps */
    int32_t dy;
} gn_edge;

typedef struct {
    int16_t x_begin, x_end; /* limited to what 16 bits hold: no picture or tile is as wide */
} gn_span;

typedef struct {
    int32_t x, y;
} gn_walk_corner;

#define GN_WALK_ROWS 16 /* that are walked at a time */

typedef struct {
    gn_walk_corner corner[3]; /* top, left and right of it */
    int32_t row;              /* the next to be walked */
    int32_t row_end[3];       /* first row after the triangle, after the edge from the top to the left, to the right */
    int32_t subpixel_bits;
    int32_t fixed;         /* rows that fixed point lasts, 0: the triangle is too large for it */
    gn_edge edge[2];       /* of others: left, right */
    int32_t first, n_left; /* for gn_walk_row: row of span[0], spans not taken yet */
    gn_span span[GN_WALK_ROWS];
} gn_walk;

/* First row or column whose pixel centre is at or after a coordinate: ceil(c - 1/2). */
static inline int32_t gn_first_px(int32_t coord, int32_t subpixel_bits)
{
    return (coord + ((1 << subpixel_bits) >> 1) - 1) >> subpixel_bits; /* ceil((c - half) / 2^s), as 2^s - 1 - half = half - 1 */
}

/* Walks the first of rows y_lo <= y < y_hi of a triangle of any orientation, from walk->first on: walk->span[0 .. n - 1], empty ones
 * among them. Returns n, 0 if there are none. */
int32_t gn_walk_begin(gn_walk *walk, const int32_t x[3], const int32_t y[3], int32_t subpixel_bits, int32_t y_lo, int32_t y_hi);

/* Walks the next rows, of which there are some. */
int32_t gn_walk_next(gn_walk *walk);

/* Walks the next rows; the same as gn_walk_begin. */
static inline int32_t gn_walk_on(gn_walk *walk)
{
    return walk->row < walk->row_end[0] ? gn_walk_next(walk) : 0;
}

/* One row at a time, after gn_walk_begin: the span x_begin <= x < x_end (possibly empty) of row *y. Returns 0 after the last row. */
static inline int gn_walk_row(gn_walk *walk, int32_t *y, int32_t *x_begin, int32_t *x_end)
{
    if (!walk->n_left && !gn_walk_on(walk)) return 0;
    const gn_span *span = &walk->span[walk->row - walk->first - walk->n_left];
    *y = walk->row - walk->n_left--;
    *x_begin = span->x_begin;
    *x_end = span->x_end;
    return 1;
}

#endif
