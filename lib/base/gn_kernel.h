/* Kernels that a port may replace, and what they must compute, bit for bit.
 *
 * The library is portable without a port. With -DGN_PORT='"gn_port_NAME.h"' that header is included (gn_hint.h); for
 * each kernel that the port has, it defines gn_kernel_X as the function that replaces gn_portable_X, under the same
 * preconditions: port/gn_port.h is the contract, docs/FIRMWARE.md explains it.
 */
#ifndef GN_KERNEL_H
#define GN_KERNEL_H

#include <stddef.h>
#include <stdint.h>

#include "base/gn_hint.h"

/* The next lower bit: whether a texel is below a level. */
GN_HOT static inline uint32_t gn_borrow(uint32_t bits, uint32_t texel, uint32_t level)
{
    return bits << 1 | (texel - level) >> 31;
}

/* Four texels of a row. */
GN_HOT static inline uint32_t gn_four_below(const uint16_t *texel, uint32_t level)
{
    return gn_borrow(gn_borrow(gn_borrow(gn_borrow(0, texel[3], level), texel[2], level), texel[1], level), texel[0],
                     level);
}

/* Which of n x n texels, in rows `pitch` apart, shadow a receiver: their depth, as the upper 16 of 32 bits, is below
 * `least`. Bit i of dark[j] is for texel i of row j. Returns the OR of all rows, plus, 16 bits up, their AND. n = 4, 6
 * or 8; least <= 0xFFFF0000. `texel` is aligned to two bytes, not to four. */
GN_HOT static inline uint32_t gn_portable_dark_texels16(const uint16_t *texel, size_t pitch, uint32_t least, int32_t n,
                                                        uint8_t *dark)
{
    uint32_t level = (least + 0xFFFFU) >> 16, any = 0, all = 255;
    if (!GN_SIZE_FIRST && n == 4) { /* without a loop callers keep them in registers */
        uint32_t a = gn_four_below(texel, level), b = gn_four_below(texel + pitch, level),
                 c = gn_four_below(texel + 2 * pitch, level), d = gn_four_below(texel + 3 * pitch, level);
        dark[0] = (uint8_t)a, dark[1] = (uint8_t)b, dark[2] = (uint8_t)c, dark[3] = (uint8_t)d;
        return a | b | c | d | (a & b & c & d) << 16;
    }
    for (uint8_t *end = dark + n; dark < end; dark++, texel += pitch) {
        uint32_t row = 0;
        if (n == 8) row = gn_borrow(gn_borrow(row, texel[7], level), texel[6], level);
        if (n >= 6) row = gn_borrow(gn_borrow(row, texel[5], level), texel[4], level);
        row = row << 4 | gn_four_below(texel, level);
        *dark = (uint8_t)row;
        any |= row;
        all &= row;
    }
    return any | all << 16;
}

#ifndef gn_kernel_dark_texels16
#define gn_kernel_dark_texels16 gn_portable_dark_texels16
#endif

#endif
