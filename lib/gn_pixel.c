/* Linear colour to output pixels. */
#include "gn_pixel.h"
#include "gn_q.h"
#include "gn_tables.h"

#define GN_ONE_Q20 (1U << 20)

static inline uint32_t srgb_encode(uint32_t linear_q20)
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

/* round(levels * v / 65535): x / 65535 is (x + 1 + (x >> 16)) >> 16 below 2^32 - 2^16 */
static inline uint32_t quantise(uint32_t v, uint32_t levels)
{
    uint32_t x = v * levels + 32767U;
    return (x + 1 + (x >> 16)) >> 16;
}

uint32_t gn_srgb_encode(uint32_t linear_q20)
{
    return srgb_encode(linear_q20);
}

static uint32_t linear_encode(uint32_t linear_q20)
{
    uint32_t limited = linear_q20 < GN_ONE_Q20 ? linear_q20 : GN_ONE_Q20;
    return (uint32_t)(((uint64_t)limited * 65535U + (1U << 19)) >> 20);
}

uint32_t gn_pixel_pack(const gn_frame *frame, const uint32_t linear_q20[3])
{
    int srgb = GN_K(frame, srgb) != 0;
    uint32_t r = srgb ? srgb_encode(linear_q20[0]) : linear_encode(linear_q20[0]);
    uint32_t g = srgb ? srgb_encode(linear_q20[1]) : linear_encode(linear_q20[1]);
    uint32_t b = srgb ? srgb_encode(linear_q20[2]) : linear_encode(linear_q20[2]);
    if (frame->picture.format == GN_FORMAT_RGB565) return quantise(r, 31) << 11 | quantise(g, 63) << 5 | quantise(b, 31);
    return quantise(r, 255) | quantise(g, 255) << 8 | quantise(b, 255) << 16;
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
