/* Rows of texels of 16 bits that are compared at once. */
#ifndef GN_TEXEL_ROWS_H
#define GN_TEXEL_ROWS_H

#include <stdint.h>

#include "base/gn_hint.h"
#include "base/gn_kernel.h"
#include "base/gn_q.h"

/* Texels of a row of 16 bits before depths that grow by `step`: bit i for texel i, n > 0. */
GN_INLINE uint32_t gn_texels_before(const uint16_t *texel, int32_t n, int32_t depth_q30, int32_t step_q30)
{
    const uint16_t *at = texel + (n & ~3);
    uint32_t near = 0, step = (uint32_t)step_q30, depth = (uint32_t)depth_q30 + (uint32_t)n * step;
    switch (n & 3) { /* each goes on with those after it */
    case 3:
        near = gn_borrow(near, (uint32_t)at[2] << 14, depth -= step);
        GN_GOES_ON;
    case 2:
        near = gn_borrow(near, (uint32_t)at[1] << 14, depth -= step);
        GN_GOES_ON;
    case 1:
        near = gn_borrow(near, (uint32_t)at[0] << 14, depth -= step);
        GN_GOES_ON;
    default:
        break;
    }
    while (at != texel) {
        at -= 4;
        GN_KEEP(at); /* one pointer */
        near = gn_borrow(near, (uint32_t)at[3] << 14, depth -= step);
        near = gn_borrow(near, (uint32_t)at[2] << 14, depth -= step);
        near = gn_borrow(near, (uint32_t)at[1] << 14, depth -= step);
        near = gn_borrow(near, (uint32_t)at[0] << 14, depth -= step);
    }
    return near;
}

#endif
