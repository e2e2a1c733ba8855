/* The oracle: every kernel in the plainest C, for the tests of ports. */
#include "gn_port_portable.h"

uint32_t gn_oracle_dark_texels16(const uint16_t *texel, size_t pitch, uint32_t least, int32_t n, uint8_t *dark)
{
    uint32_t any = 0, all = 0;
    for (int32_t j = 0; j < n; j++) dark[j] = 0;
    for (int32_t i = 0; i < n; i++) {
        uint32_t bit = 1U << i, n_dark = 0;
        for (int32_t j = 0; j < n; j++) {
            uint32_t depth = texel[(size_t)j * pitch + (size_t)i] * 65536U;
            if (depth >= least) continue;
            dark[j] = (uint8_t)(dark[j] + bit);
            n_dark++;
        }
        if (n_dark) any += bit;
        if (n_dark == (uint32_t)n) all += bit;
    }
    return any + 65536U * all;
}

/* A volatile pointer: otherwise the compiler would turn the loop into a call of memset. */
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
