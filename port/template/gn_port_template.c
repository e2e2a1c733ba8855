#include "gn_port_template.h"

/* Owes: everything the core wrote is in memory. Without a data cache only a barrier is needed, if stores may linger in
 * a buffer when the DMA engine is started. With a cache: clean every cache line of the n_bytes from `bytes` on, then a
 * barrier. */
void gn_port_before_dma(const void *bytes, size_t n_bytes)
{
    (void)bytes, (void)n_bytes;
}

/* Owes: bit i of dark[j], for i, j < n, is set if (texel[j * pitch + i] << 16) < least, all other bits are 0; returns
 * the OR of all rows plus 65536 times their AND. n is 4, 6 or 8; least <= 0xFFFF0000; texel is aligned to two bytes:
 * use a wider load only if the core does it unaligned. Reads nothing but the n x n texels, and writes nothing but
 * dark[0] to dark[n - 1]. */
GN_PORT_HOT uint32_t gn_port_dark_texels16(const uint16_t *texel, size_t pitch, uint32_t least, int32_t n,
                                           uint8_t *dark)
{
    uint32_t any = 0, all = 255;
    for (int32_t j = 0; j < n; j++, texel += pitch) {
        uint32_t row = 0;
        for (int32_t i = 0; i < n; i++)
            if (texel[i] < (least + 0xFFFFU) >> 16) row |= 1U << i;
        dark[j] = (uint8_t)row;
        any |= row;
        all &= row;
    }
    return any | all << 16;
}
