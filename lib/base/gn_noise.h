/* Interleaved gradient noise, for all dithering. */
#ifndef GN_NOISE_H
#define GN_NOISE_H

#include <stdint.h>

#include "base/gn_hint.h"

/* frac(52.9829189 * frac(0.06711056 x + 0.00583715 y)) at a pixel's centre, Q0.16: both fractions are wraps of 32 bits.
 * [D7] */
GN_HOT static inline uint32_t gn_noise_uq16(int32_t x, int32_t y)
{
    uint32_t inner =
        (2U * (uint32_t)x + 1) * 144118830U + (2U * (uint32_t)y + 1) * 12535184U; /* 2^31 times the factors */
    return (uint32_t)(((uint64_t)inner * 3555623499U) >> 26) >> 16;               /* 52.9829189 * 2^26 */
}

#endif
