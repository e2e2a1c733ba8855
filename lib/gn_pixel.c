/* Linear colour to output pixels. */
#include "gn_pixel.h"
#include "gn_q.h"
#include "gn_tables.h"

#define GN_ONE_Q20 (1U << 20)

uint32_t gn_srgb_encode(uint32_t linear_q20)
{
    if (linear_q20 >= GN_ONE_Q20) return 65535;
    /* below 2^-9 the curve is its linear part: 12.92 * 65535 / 2^20 = 0.807494 = 52920 / 2^16 */
    if (linear_q20 < 1U << 11) return (linear_q20 * 52920U + 0x8000U) >> 16;
    int32_t octave = 20 - gn_clz32(linear_q20); /* 0..8: linear in [2^(octave - 9), 2^(octave - 8)) */
    int32_t shift = octave + 5;                 /* bits below the 64 steps of an octave */
    const uint16_t *entry = gn_srgb_table + ((uint32_t)octave << 6) + ((linear_q20 >> shift) & 63U);
    uint32_t rest = linear_q20 & ((1U << shift) - 1);
    return entry[0] + (((uint32_t)(entry[1] - entry[0]) * rest + ((1U << shift) >> 1)) >> shift); /* 2^11 * 2^14 */
}

/* round(levels * v / 65535) */
static uint32_t quantise(uint32_t v, uint32_t levels)
{
    return (v * levels + 32767U) / 65535U;
}

uint32_t gn_pixel_pack(const gn_frame *frame, const uint32_t linear_q20[3])
{
    uint32_t v[3];
    for (int c = 0; c < 3; c++) {
        if (GN_K(frame, srgb)) v[c] = gn_srgb_encode(linear_q20[c]);
        else v[c] = (uint32_t)(((uint64_t)(linear_q20[c] < GN_ONE_Q20 ? linear_q20[c] : GN_ONE_Q20) * 65535U + (1U << 19)) >> 20);
    }
    if (frame->picture.format == GN_FORMAT_RGB565) return quantise(v[0], 31) << 11 | quantise(v[1], 63) << 5 | quantise(v[2], 31);
    return quantise(v[0], 255) | quantise(v[1], 255) << 8 | quantise(v[2], 255) << 16;
}

void gn_pixel_fill(const gn_frame *frame, uint32_t *buffer, int32_t i, int32_t n, uint32_t packed)
{
    if (frame->picture.format == GN_FORMAT_RGB565) {
        uint16_t *out = (uint16_t *)buffer + i;
        while (n-- > 0) *out++ = (uint16_t)packed;
        return;
    }
    uint8_t *out = (uint8_t *)buffer + 3 * (size_t)(uint32_t)i;
    while (n-- > 0) {
        *out++ = (uint8_t)packed;
        *out++ = (uint8_t)(packed >> 8);
        *out++ = (uint8_t)(packed >> 16);
    }
}
