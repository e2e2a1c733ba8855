/* Texels of each format. */
#ifndef GN_TEXEL_FORMATS_H
#define GN_TEXEL_FORMATS_H

#include "base/gn_q.h"
#include "base/gn_tables.h"
#include "geometry/gn_texture.h"

/* Whether a texture has a format. Of formats that are not built the compiler drops what asks; where one is built alone
 * nothing is asked. */
#define GN_TEXEL_IS(t, of) (GN_FORMATS == 1 << (of) || (GN_FORMATS >> (of)&1 && (t)->format == (of)))

/* The same of formats that are decoded alike; 565, palettes and greys are neighbours. */
#define GN_TEXEL_AMONG(t, first, last)                                                                                 \
    ((GN_FORMATS & ((2 << (last)) - (1 << (first)))) != 0 && (t)->format >= (first) && (t)->format <= (last))
#define GN_TEXEL_IS_565(t)     GN_TEXEL_AMONG(t, GN_TEXTURE_RGB565, GN_TEXTURE_RGB565A1)
#define GN_TEXEL_IS_PALETTE(t) GN_TEXEL_AMONG(t, GN_TEXTURE_PALETTE8, GN_TEXTURE_PALETTE1)
#define GN_TEXEL_IS_GREY(t)    GN_TEXEL_AMONG(t, GN_TEXTURE_GREY8, GN_TEXTURE_GREY4)

#define GN_TEXEL_565S (GN_FORMATS & 6)

/* Bits of a texel, as a power of two. */
GN_HOT static inline uint32_t gn_texel_bits_log2(const gn_texture *t)
{
    static const uint8_t log2[GN_TEXTURE_FORMAT_COUNT] = {5, 4, 4, 3, 2, 0, 3, 2, 3, 2};
    return GN_FORMATS == 1 ? 5 : log2[t->format];
}

/* Bytes of a row. */
GN_HOT static inline uint32_t gn_texel_stride(const gn_texture *t)
{
    return ((gn_texture_size(t, 0) << gn_texel_bits_log2(t)) + 7) >> 3;
}

/* A texel of 8, 4 or 1 bits. */
GN_HOT static inline uint32_t gn_texel_index(const uint8_t *row, uint32_t x, uint32_t bits_log2)
{
    uint32_t bit = x << bits_log2, n = 1U << bits_log2;
    return (uint32_t)row[bit >> 3] >> (8 - n - (bit & 7U)) & ((1U << n) - 1);
}

/* Red, green, blue, alpha from the lowest byte on. */
GN_HOT static inline uint32_t gn_texel_word(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

GN_HOT static inline void gn_texel_decode_rgba(uint32_t word, uint16_t rgb[3])
{
    rgb[0] = (uint16_t)gn_srgb_decode_entry(word & 255U);
    rgb[1] = (uint16_t)gn_srgb_decode_entry(word >> 8 & 255U);
    rgb[2] = (uint16_t)gn_srgb_decode_entry(word >> 16 & 255U);
}

GN_HOT static inline void gn_texel_decode_565(uint32_t texel, int has_alpha, uint16_t rgb[3])
{
    rgb[0] = gn_linear_31_table[texel >> 11 & 31U];
    rgb[1] = has_alpha ? gn_linear_31_table[texel >> 6 & 31U] : gn_linear_63_table[texel >> 5 & 63U];
    rgb[2] = gn_linear_31_table[texel & 31U];
}

GN_HOT static inline uint16_t gn_texel_decode_grey(uint32_t value, uint32_t bits_log2)
{
    return (uint16_t)gn_srgb_decode_entry(bits_log2 == 2 ? value * 17U : value);
}

#endif
