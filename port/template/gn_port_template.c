#include "gn_port_template.h"

/* Owes: what the core wrote is in memory. Nothing to do without a data cache, but for a barrier where stores may linger in a buffer
 * when the DMA engine is started. With a cache: clean every line that n_bytes from `bytes` on touch, then a barrier. */
void gn_port_before_dma(const void *bytes, size_t n_bytes)
{
    (void)bytes, (void)n_bytes;
}

/* Owes: the sum of weight[i] over all i < n with (texel[i] << 16) >= least, modulo 2^32. n is 4, 6 or 8; least <= 0xFFFF0000; texel lies on
 * two bytes: a wider load must be one that the core does unaligned. Reads nothing beyond texel[n - 1] and weight[n - 1]. */
uint32_t gn_port_tent_row16(const uint16_t *texel, uint32_t least, int32_t n, const uint32_t *weight)
{
    uint32_t sum = 0;
    for (const uint32_t *end = weight + n; weight < end; texel++, weight++)
        if (*texel >= (least + 0xFFFFU) >> 16) sum += *weight;
    return sum;
}
