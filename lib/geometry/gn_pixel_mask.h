/* Pixels of a small triangle: those of a box of 4 columns and 3 rows that it covers, bit 4 row + column of each. */
#ifndef GN_PIXEL_MASK_H
#define GN_PIXEL_MASK_H

#include <stdint.h>

#include "base/gn_hint.h"
#include "base/gn_q.h"

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
