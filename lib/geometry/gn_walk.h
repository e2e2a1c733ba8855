/* The rows and spans that a triangle covers, and small triangles' pixels as masks. */
#ifndef GN_WALK_H
#define GN_WALK_H

#include <stdint.h>

#include "base/gn_base_types.h"
#include "base/gn_q.h"

/* Walks the pixels of a triangle row by row, by the top-left rule, exactly.
 *
 * Coordinates have `subpixel_bits` fraction bits, |coordinate| < 2^29. A row of pixels at y crosses an edge at x(y +
 * 1/2); the first pixel whose centre is at or right of it is ceil(x - 1/2) = ceil(M / dy) with an integer M that grows
 * by dx per row (NUMERICS 4.2). For small triangles M / dy is stepped in fixed point, over so few rows that its error
 * stays below 1 / dy; for others as quotient and remainder. Both are exact, and two triangles with a common edge get
 * the same numbers: each pixel belongs to exactly one of them.
 */

/* M / dy of the current row, rounded up to a pixel in q. */
typedef struct {
    int32_t q, r;   /* quotient and remainder, 0 <= r < dy */
    int32_t dq, dr; /* their steps */
    int32_t dy;
} gn_edge;

typedef struct {
    int16_t x_begin, x_end; /* clamped to 16 bits: no picture or tile is as wide */
} gn_span;

typedef struct {
    int32_t x, y;
} gn_walk_corner;

#define GN_WALK_ROWS 16 /* rows that are walked at a time */

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
GN_HOT static inline int32_t gn_first_px(int32_t coord, int32_t subpixel_bits)
{
    return (coord + ((1 << subpixel_bits) >> 1) - 1) >>
           subpixel_bits; /* ceil((c - half) / 2^s), as 2^s - 1 - half = half - 1 */
}

/* ---- Fixed point ------------------------------------------------------------------------------------------------- */

/* 18 fraction bits leave 14 for pixels. Start and step err by less than one unit each, upwards or downwards: after n
 * rows x is within n of M / dy. x must not be below a multiple of 1 / dy that M / dy has reached, nor at the next one:
 * so x starts n higher, and 2 n * dy <= 2^18. */
#define GN_FIXED_BITS  18
#define GN_FIXED_SMALL (1 << 13) /* dx, dy of edges that are walked 16 rows at a time; twice that: 8 rows */

/* For how many rows fixed point is exact, for a triangle with dx | dy of its edges, within 2^12 pixels of 0: 16, 8 or
 * none. */
GN_HOT static inline int32_t gn_walk_lasts(uint32_t size)
{
    return size >= 2 * GN_FIXED_SMALL ? 0 : size >= GN_FIXED_SMALL ? GN_WALK_ROWS / 2 : GN_WALK_ROWS;
}

/* a * 2^18 / b modulo 2^32, within one unit; 0 < b < 2^14 */
GN_HOT static inline uint32_t gn_walk_ratio(int32_t a, int32_t b)
{
    const int32_t unit = 1 << GN_FIXED_BITS, most = 1 << (31 - GN_FIXED_BITS);
    GN_KEEP(a); /* a constant factor would not fit an instruction's immediate */
    if (a < most && a >= -most) return (uint32_t)(a * unit / b);
    int32_t q = a / b, r = a - q * b;
    if (r < 0) {
        r += b;
        q--;
    }
    return ((uint32_t)q << GN_FIXED_BITS) + ((uint32_t)r << GN_FIXED_BITS) / (uint32_t)b;
}

/* Where an edge crosses a row, as the first pixel at or right of it above GN_FIXED_BITS, modulo 2^32; its step per row.
 */
typedef struct {
    uint32_t x, step;
} gn_walk_line;

/* The edge from (x0, y0) down to (x1, y1), y0 < y1, at row y, which it crosses; exact for n_rows, at most those of
 * gn_walk_lasts. */
GN_HOT static inline gn_walk_line gn_walk_line_at(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t y,
                                                  int32_t n_rows, int32_t subpixel_bits)
{
    int32_t one = 1 << subpixel_bits, half = one >> 1, dx = x1 - x0, dy = y1 - y0,
            row = y * one + half - y0; /* 0 .. dy */
    x0 -= half;
    /* ceil(M) + dy - 1, from the upper end's pixel; 2^26 + 2^28 */
    int32_t m = dy + (((x0 & (one - 1)) * dy + row * dx - 1) >> subpixel_bits);
    gn_walk_line line;
    line.x = ((uint32_t)(x0 >> subpixel_bits) << GN_FIXED_BITS) + gn_walk_ratio(m, dy) + (uint32_t)n_rows;
    line.step = gn_walk_ratio(dx, dy);
    return line;
}

/* Walks the first of rows y_lo <= y < y_hi of a triangle of any orientation, from walk->first on: walk->span[0 .. n -
 * 1], empty ones among them. Returns n, 0 if there are none. */
int32_t gn_walk_begin(gn_walk *walk, const int32_t x[3], const int32_t y[3], int32_t subpixel_bits, int32_t y_lo,
                      int32_t y_hi);

/* Walks the next rows; at least one is left. */
int32_t gn_walk_next(gn_walk *walk);

/* Walks the next rows; the same as gn_walk_begin. */
GN_HOT static inline int32_t gn_walk_on(gn_walk *walk)
{
    return walk->row < walk->row_end[0] ? gn_walk_next(walk) : 0;
}

/* One row at a time, after gn_walk_begin: the span x_begin <= x < x_end (possibly empty) of row *y. Returns 0 after the
 * last row. */
GN_HOT static inline int gn_walk_row(gn_walk *walk, int32_t *y, int32_t *x_begin, int32_t *x_end)
{
    if (!walk->n_left && !gn_walk_on(walk)) return 0;
    const gn_span *span = &walk->span[walk->row - walk->first - walk->n_left];
    *y = walk->row - walk->n_left--;
    *x_begin = span->x_begin;
    *x_end = span->x_end;
    return 1;
}

/* Pixels of a small triangle: those of a box of 4 columns and 3 rows that it covers, bit 4 row + column of each. */

enum { GN_MASK_WIDTH = 4, GN_MASK_HEIGHT = 3 };

/* 0 inside of the edge with these differences from one corner to the next, 1 where a pixel on it is outside: on the
 * right and below. |dx|, |dy| < 2^15. */
static inline int32_t gn_mask_rule(int32_t dx, int32_t dy)
{
    return ((dx - dy * 65536) >> 31) + 1;
}

/* The pixels of a triangle, by the rule of gn_walk.h. Sides lead from its first corner to the second (ax, ay) and to
 * the third (bx, by), whose order is that of gn_tri; (x, y) is the centre of the box' first pixel from the first
 * corner. All in steps of the subpixel grid, within 5 pixels, so that forms are below 2^31 at 12 bits. */
static inline uint32_t gn_pixel_mask(int32_t x, int32_t y, int32_t ax, int32_t ay, int32_t bx, int32_t by,
                                     int32_t width, int32_t height, int32_t bits)
{
    /* of the edges from the first corner to the second, third to first, second to third: not negative inside */
    int32_t a = ay * x - ax * y, b = bx * y - by * x, c = bx * ay - ax * by - a - b;
    a -= gn_mask_rule(ax, ay);
    b -= gn_mask_rule(-bx, -by);
    c -= gn_mask_rule(bx - ax, by - ay);
    if ((width | height) == 1) return ~(uint32_t)((a | b | c) >> 31) & 1U;
    const int32_t one = 1 << bits, a_dx = ay * one, a_dy = ax * one, b_dx = by * one, b_dy = bx * one;
    uint32_t mask = 0, first = 1;
    do {
        int32_t row_a = a, row_b = b, row_c = c;
        uint32_t bit = first, end = first << width;
        do {
            if ((row_a | row_b | row_c) >= 0) mask |= bit;
            row_a += a_dx, row_b -= b_dx, row_c += b_dx - a_dx;
            bit <<= 1;
        } while (bit != end);
        a -= a_dy, b += b_dy, c += a_dy - b_dy;
        first <<= GN_MASK_WIDTH;
    } while (--height);
    return mask;
}

/* What is left of a mask within width x height pixels, the first pixel of its box is at (x, y) of them. */
static inline uint32_t gn_mask_cut(uint32_t mask, int32_t x, int32_t y, int32_t width, int32_t height)
{
    uint32_t columns = 0;
    for (int32_t i = 0; i < GN_MASK_WIDTH; i++) columns |= (uint32_t)((uint32_t)(x + i) < (uint32_t)width) << i;
    for (int32_t i = 0; i < GN_MASK_HEIGHT; i++)
        mask &= ~(((uint32_t)(y + i) < (uint32_t)height ? 15U & ~columns : 15U) << (GN_MASK_WIDTH * i));
    return mask;
}

#endif
