/* Kernels that a port may replace, and what they must compute, bit for bit.
 *
 * The library is portable without a port. With -DGN_PORT='"gn_port_NAME.h"' that header is included here; for each kernel that the port has,
 * it defines gn_kernel_X as the function that takes the place of gn_portable_X, under the same preconditions: port/gn_port.h is the
 * contract, docs/PORTING.md explains it.
 */
#ifndef GN_KERNEL_H
#define GN_KERNEL_H

#include <stddef.h>
#include <stdint.h>

#ifdef GN_PORT
#include GN_PORT
#endif

/* Sum of the weights of those of n texels of a row that let a receiver be lit: whose depth, as the upper 16 of 32 bits, is at least
 * `least`. n = 4, 6 or 8; least <= 0xFFFF0000; the sum of all weights is below 2^32. `texel` lies on two bytes, not on four. */
static inline uint32_t gn_portable_tent_row16(const uint16_t *texel, uint32_t least, int32_t n, const uint32_t *weight)
{
    uint32_t sum = 0;
    for (int32_t i = 0; i < n; i++)
        if ((uint32_t)texel[i] << 16 >= least) sum += weight[i];
    return sum;
}

#ifndef gn_kernel_tent_row16
#define gn_kernel_tent_row16 gn_portable_tent_row16
#endif

#endif
