#include "gn_port_portable.h"

uint32_t gn_oracle_tent_row16(const uint16_t *texel, uint32_t least, int32_t n, const uint32_t *weight)
{
    uint32_t sum = 0;
    for (int32_t i = 0; i < n; i++) {
        uint32_t depth = texel[i] * 65536U;
        sum += depth >= least ? weight[i] : 0;
    }
    return sum;
}

/* A volatile pointer: or the compiler makes a call of memset of it. */
void gn_oracle_memset(uint8_t *to, uint8_t value, size_t n)
{
    for (volatile uint8_t *out = to; n; n--) *out++ = value;
}

/* By addition alone. */
uint64_t gn_oracle_mul64(uint64_t a, uint64_t b)
{
    uint64_t sum = 0;
    for (; b; b >>= 1, a += a)
        if (b & 1U) sum += a;
    return sum;
}
