/* From linear light to pixels of the picture's format. Colours are Q20 or Q24, 1 is white; encoded values are 0..65535,
 * levels 0..31 or 0..63 of a channel of RGB565. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_pixel.h"

#define GN_ONE_Q20 (1U << 20)

/* The sRGB curve, 0..65535: linear between the entries of a table that has 64 per octave. */
GN_HOT static inline uint32_t srgb_encode(uint32_t linear_q20)
{
    if (linear_q20 >= GN_ONE_Q20) return 65535;
    /* below 2^-9 the curve is its linear part: 12.92 * 65535 / 2^20 = 0.807494 = 52920 / 2^16 */
    if (linear_q20 < 1U << 11) return (linear_q20 * 52920U + 0x8000U) >> 16;
    int32_t zeros = gn_clz32(linear_q20); /* 12..20: linear in [2^(11 - zeros), 2^(12 - zeros)) */
    uint32_t m = linear_q20 << zeros;     /* below its 64 steps an octave has up to 13 bits */
    uint32_t i = (uint32_t)((20 - zeros) << 6) + (m >> 25 & 63U), here = gn_srgb_table[i], next = gn_srgb_table[i + 1];
    return here + (((next - here) * (m >> 12 & 0x1FFFU) + (1U << 12)) >> 13); /* the product: below 2^11 * 2^13 */
}

/* levels * v / 65535 and a half, Q16: x / 65535 is (x + 1 + (x >> 16)) >> 16 below 2^32 - 2^16 */
GN_HOT static inline uint32_t level_uq16(uint32_t v, uint32_t levels)
{
    uint32_t x = v * levels + 32767U;
    return x + 1 + (x >> 16);
}

/* round(levels * v / 65535) */
GN_HOT static inline uint32_t quantise(uint32_t v, uint32_t levels)
{
    return level_uq16(v, levels) >> 16;
}

GN_HOT uint32_t gn_srgb_encode(uint32_t linear_q20)
{
    return srgb_encode(linear_q20);
}

/* Without the curve: round(65535 * linear), at most 65535. */
GN_HOT static uint32_t linear_encode(uint32_t linear_q20)
{
    uint32_t limited = linear_q20 < GN_ONE_Q20 ? linear_q20 : GN_ONE_Q20;
    return (uint32_t)(((uint64_t)limited * 65535U + (1U << 19)) >> 20);
}

/* From linear light to the display's encoding. [M7] */
GN_HOT static uint32_t encode(const gn_frame *frame, uint32_t linear_q20)
{
    return GN_K(frame, srgb) ? srgb_encode(linear_q20) : linear_encode(linear_q20);
}

/* Rec. 709 weights in Q16; they sum to 65536. Channels are clamped first, so that one cannot outshine the others. */
GN_HOT static uint32_t luminance_q20(const uint32_t c[3])
{
    uint32_t r = c[0] < GN_ONE_Q20 ? c[0] : GN_ONE_Q20, g = c[1] < GN_ONE_Q20 ? c[1] : GN_ONE_Q20,
             b = c[2] < GN_ONE_Q20 ? c[2] : GN_ONE_Q20;
    return (uint32_t)(((uint64_t)r * 13933U + (uint64_t)g * 46871U + (uint64_t)b * 4732U + 0x8000U) >> 16);
}

/* RGB565 by the curve: what the tables of pack_565() were made from, bit for bit. */
GN_HOT static uint32_t by_curve_565(const gn_frame *frame, const uint32_t c[3])
{
    return quantise(encode(frame, c[0]), 31) << 11 | quantise(encode(frame, c[1]), 63) << 5 |
           quantise(encode(frame, c[2]), 31);
}

/* One less than the level of a colour in 0 .. 1; the caller adds 1. `levels` has the level with which each interval of
 * 2^shift colours begins. At most one level ends in an interval, so a single compare with that end tells whether the
 * colour has this level or the next. */
GN_HOT static inline uint32_t level_before(const uint8_t *levels, uint32_t v_q24, int shift)
{
    uint32_t level = levels[v_q24 >> shift];
    return level - ((v_q24 - gn_level_end_q24[level]) >> 31);
}

/* RGB565 of a colour in 0 .. 1 by tables; bits from 16 on are not cleared. The table of 31 levels counts from 64. */
GN_HOT static inline uint32_t pack_565(uint32_t r_q24, uint32_t g_q24, uint32_t b_q24)
{
    uint32_t red = level_before(gn_level_31_table, r_q24, 15), green = level_before(gn_level_63_table, g_q24, 14);
    return (red << 11) + (green << 5) + level_before(gn_level_31_table, b_q24, 15) + (1U << 11) + (1U << 5) + 1 -
           64; /* blue's 64; red's, 64 << 11, lies above the 16 bits */
}

GN_HOT static inline int32_t limited_q24(int32_t v)
{
    return gn_min32(gn_max32(v, 0), (1 << 24) - 1);
}

/* RGB565 of any colour; bits from 16 on are not cleared. */
GN_HOT static inline uint32_t limit_and_pack_565(int32_t r_q24, int32_t g_q24, int32_t b_q24)
{
    if (GN_SELDOM((uint32_t)(r_q24 | g_q24 | b_q24) >> 24))
        r_q24 = limited_q24(r_q24), g_q24 = limited_q24(g_q24), b_q24 = limited_q24(b_q24);
    return pack_565((uint32_t)r_q24, (uint32_t)g_q24, (uint32_t)b_q24);
}

/* RGB565 of any colour; what is above 1 becomes 1. */
GN_HOT static uint32_t any_565(const gn_frame *frame, const uint32_t c[3])
{
    if (GN_LEVEL_TABLES && GN_K(frame, srgb)) {
        uint32_t q24[3];
        GN_UNROLL
        for (int i = 0; i < 3; i++) q24[i] = c[i] < GN_ONE_Q20 ? c[i] << 4 : (1U << 24) - 1;
        return pack_565(q24[0], q24[1], q24[2]) & 0xFFFFU;
    }
    return by_curve_565(frame, c);
}

/* RGB565 in the byte order of the format. */
GN_HOT static uint32_t pack_16(const gn_frame *frame, const uint32_t linear_q20[3])
{
    uint32_t v = any_565(frame, linear_q20);
    return frame->picture.format == GN_FORMAT_RGB565 ? v : gn_pixel_swapped(v);
}

/* A colour in the picture's format. [R5] */
GN_HOT uint32_t gn_pixel_pack(const gn_frame *frame, const uint32_t linear_q20[3])
{
    if (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32)
        return linear_q20[0] >> 20 ? 65536 : linear_q20[0] >> 4; /* a share */
    if (!GN_OTHER_FORMATS) return pack_16(frame, linear_q20);
    switch (frame->picture.format) {
    case GN_FORMAT_RGB565:
    case GN_FORMAT_RGB565_SWAPPED:
        return pack_16(frame, linear_q20);
    case GN_FORMAT_GREY8:
        return quantise(encode(frame, luminance_q20(linear_q20)), 255);
    case GN_FORMAT_GREY4:
        return quantise(encode(frame, luminance_q20(linear_q20)), 15);
    case GN_FORMAT_MONO1:
        return linear_encode(luminance_q20(linear_q20));
    default:
        return quantise(encode(frame, linear_q20[0]), 255) | quantise(encode(frame, linear_q20[1]), 255) << 8 |
               quantise(encode(frame, linear_q20[2]), 255) << 16;
    }
}

/* The threshold of an 8x8 ordered dither at a pixel, 1..127 of 128: the bits of x ^ y and y, interleaved and reversed.
 */
GN_HOT static uint32_t threshold(int32_t x, int32_t y)
{
    uint32_t a = (uint32_t)(x ^ y), b = (uint32_t)y;
    uint32_t rank = (a & 1U) << 5 | (b & 1U) << 4 | (a & 2U) << 2 | (b & 2U) << 1 | (a & 4U) >> 1 | (b & 4U) >> 2;
    return 2 * rank + 1;
}

/* n pixels of a row of 1 bit each, the leftmost in the highest bit: `at` is the first's index in the row, (x, y) its
 * place in the picture, luminance linear, 0..65535. */
GN_HOT static void fill_mono(uint8_t *row, int32_t at, int32_t x, int32_t y, int32_t n, uint32_t luminance)
{
    for (int32_t i = 0; i < n; i++) {
        uint8_t bit = (uint8_t)(0x80U >> ((at + i) & 7));
        if (luminance * 128U > threshold(x + i, y) * 65535U) row[(at + i) >> 3] |= bit;
        else row[(at + i) >> 3] &= (uint8_t)~bit;
    }
}

/* n pixels of 4 bits, the left one of a byte in its high half. */
GN_HOT static void fill_grey4(uint8_t *row, int32_t at, int32_t n, uint32_t level)
{
    for (int32_t i = at; i < at + n; i++) {
        uint8_t *out = &row[i >> 1];
        *out = i & 1 ? (uint8_t)((*out & 0xF0U) | level) : (uint8_t)((*out & 0x0FU) | level << 4);
    }
}

/* n pixels of a packed colour. [R5] */
GN_HOT void gn_pixel_fill(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, int32_t n,
                          uint32_t packed)
{
    int32_t at = x - rows->x0, row = y - rows->y0, i = row * rows->width + at;
    uint8_t *bytes = rows->pixels->bytes;
    if (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32) {
        while (n-- > 0) rows->pixels->raw[i++] = packed;
    } else if (!GN_OTHER_FORMATS || frame->picture.format == GN_FORMAT_RGB565 ||
               frame->picture.format == GN_FORMAT_RGB565_SWAPPED) {
        gn_pixel_fill_16(rows->pixels, (uint32_t)i, (uint32_t)n, packed & 0xFFFFU);
    } else if (frame->picture.format == GN_FORMAT_GREY8) {
        while (n-- > 0) bytes[i++] = (uint8_t)packed;
    } else if (frame->picture.format == GN_FORMAT_GREY4) {
        fill_grey4(bytes + row * ((rows->width + 1) >> 1), at, n, packed);
    } else if (frame->picture.format == GN_FORMAT_MONO1) {
        fill_mono(bytes + row * ((rows->width + 7) >> 3), at, x, y, n, packed);
    } else {
        uint8_t *out = bytes + 3 * (size_t)(uint32_t)i;
        while (n-- > 0) {
            *out++ = (uint8_t)packed;
            *out++ = (uint8_t)(packed >> 8);
            *out++ = (uint8_t)(packed >> 16);
        }
    }
}

GN_HOT size_t gn_pixel_bytes(const gn_frame *frame, int32_t width, int32_t height)
{
    uint32_t w = (uint32_t)width, h = (uint32_t)height;
    if (!GN_OTHER_FORMATS && (!GN_RAW_VIEWS || frame->picture.format != GN_FORMAT_RAW32)) return (size_t)2 * w * h;
    return gn_format_bytes(frame->picture.format, w, h);
}

#if GN_INTERPOLATES
/* Whether pack_565() makes the picture's pixels. */
GN_HOT static int has_levels(const gn_frame *frame)
{
    return GN_LEVEL_TABLES && frame->picture.format == GN_FORMAT_RGB565 && GN_K(frame, srgb);
}

GN_HOT static uint16_t *pixel_565(const gn_pixel_rows *rows, int32_t x, int32_t y)
{
    return rows->pixels->rgb565 + (y - rows->y0) * rows->width + x - rows->x0;
}

/* Pixels of `bits`, a node each. */
GN_HOT static inline void nodes_565(uint16_t *out, uint32_t bits, const int32_t (*node)[3])
{
    for (; bits; bits >>= 1, out++, node++)
        if (bits & 1U) *out = (uint16_t)limit_and_pack_565((*node)[0], (*node)[1], (*node)[2]);
}

/* A pixel of any format, in a raw view a share of 65536. */
GN_HOT static void store_colour(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y,
                                const int32_t colour_q24[3])
{
    if (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32) {
        rows->pixels->raw[(y - rows->y0) * rows->width + x - rows->x0] =
            (uint32_t)gn_max32(0, gn_min32((colour_q24[0] + 128) >> 8, 65536));
        return;
    }
    uint32_t q20[3];
    GN_UNROLL
    for (int c = 0; c < 3; c++) q20[c] = (uint32_t)gn_max32(colour_q24[c], 0) >> 4;
    gn_pixel_store(frame, rows, x, y, gn_pixel_pack(frame, q20));
}

/* A line's colour at its pixel i: linear between the nodes before and after it. */
GN_HOT static inline void colour_at(const gn_pixel_line *line, int32_t i, int32_t colour_q24[3])
{
    int32_t log2 = line->spacing_log2, k = i >> log2, t = i & ((1 << log2) - 1);
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        int32_t from = line->node[k][c];
        colour_q24[c] = t ? from + t * ((line->node[k + 1][c] - from) >> log2) : from;
    }
}

#if GN_TEXTURES
/* A texel's channel, 65535: 1, times a colour below 1, Q16: Q24. 65535 * 65535 < 2^32 */
GN_INLINE uint32_t tinted_q24(uint32_t texel, uint32_t colour_uq16)
{
    return texel * colour_uq16 >> 8;
}

GN_INLINE uint32_t tinted_565(gn_texel_rgb texel, uint32_t r_uq16, uint32_t g_uq16, uint32_t b_uq16)
{
    return pack_565(tinted_q24(texel.red_green & 0xFFFFU, r_uq16), tinted_q24(texel.red_green >> 16, g_uq16),
                    tinted_q24(texel.blue, b_uq16));
}

/* Pixels of `bits` of one light: where the texture repeats a colour, so does the picture. */
GN_HOT static inline void evenly_lit_565(uint16_t *out, uint32_t bits, const gn_texel_rgb *texel, uint32_t r_uq16,
                                         uint32_t g_uq16, uint32_t b_uq16)
{
    gn_texel_rgb last = {0, 0}; /* black */
    uint32_t packed = 0;
    for (; bits; bits >>= 1, out++, texel++) {
        if (!(bits & 1U)) continue;
        if (texel->red_green != last.red_green || texel->blue != last.blue) {
            last = *texel;
            packed = tinted_565(last, r_uq16, g_uq16, b_uq16);
        }
        *out = (uint16_t)packed;
    }
}

/* Pixels of `bits`, each with a node of its own. */
GN_HOT static inline void apart_lit_565(uint16_t *out, uint32_t bits, const gn_texel_rgb *texel,
                                        const int32_t (*node)[3])
{
    for (; bits; bits >>= 1, out++, texel++, node++)
        if (bits & 1U)
            *out = (uint16_t)tinted_565(*texel, (uint32_t)(*node)[0] >> 8, (uint32_t)(*node)[1] >> 8,
                                        (uint32_t)(*node)[2] >> 8);
}

/* Pixels of `bits` between two nodes; colours lie in 0 .. 1. */
GN_HOT static inline void textured_565(uint16_t *out, uint32_t bits, const gn_texel_rgb *texel,
                                       const int32_t (*node)[3], int32_t log2)
{
    uint32_t r = (uint32_t)node[0][0], g = (uint32_t)node[0][1], b = (uint32_t)node[0][2];
    int32_t r_step = (node[1][0] - node[0][0]) >> log2, g_step = (node[1][1] - node[0][1]) >> log2,
            b_step = (node[1][2] - node[0][2]) >> log2;
    if (!(r_step | g_step | b_step)) {
        evenly_lit_565(out, bits, texel, r >> 8, g >> 8, b >> 8);
        return;
    }
    for (; bits; bits >>= 1, out++, texel++) {
        if (bits & 1U) *out = (uint16_t)tinted_565(*texel, r >> 8, g >> 8, b >> 8);
        r += (uint32_t)r_step;
        g += (uint32_t)g_step;
        b += (uint32_t)b_step;
    }
}

/* A channel of 65535. */
GN_HOT static inline uint32_t texel_channel(gn_texel_rgb texel, int c)
{
    return c == 2 ? texel.blue : texel.red_green >> (16 * c) & 0xFFFFU;
}

#if GN_GLOW_APART
/* Light that the surface emits, at the pixel of a texel: 2^27 * 2^16 */
GN_HOT static uint32_t glow_q20(const gn_pixel_line *line, const gn_texel_rgb *texel, int c)
{
    uint32_t glow_q24 = (uint32_t)line->glow_q24[c];
#if GN_GLOW_TEXTURES
    if (line->glow) return (uint32_t)((uint64_t)glow_q24 * texel_channel(line->glow[texel - line->texel], c) >> 20);
#else
    (void)texel;
#endif
    return glow_q24 >> 4;
}
#endif

/* The same of any colours and formats. */
GN_HOT static void textured_any(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, uint32_t bits,
                                const gn_pixel_line *line)
{
    for (int32_t i = 0; bits >> i; i++) {
        const gn_texel_rgb *texel = line->texel + i;
        int32_t colour[3];
        uint32_t q20[3];
        if (!(bits >> i & 1U)) continue;
        colour_at(line, i, colour);
        for (int c = 0; c < 3; c++) {
            uint64_t light_uq16 = (uint32_t)gn_max32(colour[c], 0) >> 8; /* as tinted_q24() has it */
            q20[c] = (uint32_t)(light_uq16 * texel_channel(*texel, c) >> 12);
#if GN_GLOW_APART
            q20[c] += glow_q20(line, texel, c);
#endif
        }
        gn_pixel_store(frame, rows, x + i, y, gn_pixel_pack(frame, q20));
    }
}

GN_HOT static GN_NOINLINE void textured_line(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y,
                                             uint32_t bits, const gn_pixel_line *line)
{
    int quick = GN_LEVEL_TABLES && line->inside && has_levels(frame);
    for (uint32_t rest = bits; GN_COUNTERS && rest; rest &= rest - 1) GN_COUNT(textured_rows, 1);
#if GN_GLOW_APART
    if (line->glow_q24[0] | line->glow_q24[1] | line->glow_q24[2]) quick = 0;
#endif
    if (!GN_LEVEL_TABLES || !quick) {
        textured_any(frame, rows, x, y, bits, line);
        return;
    }
    const int32_t log2 = line->spacing_log2, n = 1 << log2;
    const gn_texel_rgb *texel = line->texel;
    uint16_t *out = pixel_565(rows, x, y);
    if (!log2) {
        apart_lit_565(out, bits, texel, line->node);
        return;
    }
    for (const int32_t(*node)[3] = line->node; bits; bits >>= n, out += n, texel += n, node++) {
        uint32_t part = bits & ((1U << n) - 1);
        if (part) textured_565(out, part, texel, node, log2);
    }
}
#endif

GN_HOT void gn_pixel_store_line(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, uint32_t bits,
                                const gn_pixel_line *line)
{
#if GN_TEXTURES
    if (line->texel) {
        textured_line(frame, rows, x, y, bits, line);
        return;
    }
#endif
    if (GN_LEVEL_TABLES && has_levels(frame)) {
        nodes_565(pixel_565(rows, x, y), bits, line->node);
        return;
    }
    for (int32_t i = 0; bits >> i; i++) {
        int32_t colour[3];
        if (!(bits >> i & 1U)) continue;
        colour_at(line, i, colour);
        store_colour(frame, rows, x + i, y, colour);
    }
}

/* ---- Runs -------------------------------------------------------------------------------------------------------- */

GN_HOT static inline void run_of_colours_565(uint16_t *out, int32_t n, int32_t r, int32_t g, int32_t b,
                                             const int32_t step[3], int inside)
{
    const int32_t r_step = step[0], g_step = step[1], b_step = step[2];
    for (const uint16_t *end = out + n; out < end; r += r_step, g += g_step, b += b_step)
        *out++ = (uint16_t)(inside ? pack_565((uint32_t)r, (uint32_t)g, (uint32_t)b) : limit_and_pack_565(r, g, b));
}

GN_HOT void gn_pixel_store_run(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, int32_t n,
                               const int32_t from_q24[3], const int32_t step[3])
{
    int32_t r = from_q24[0], g = from_q24[1], b = from_q24[2];
    if (GN_LEVEL_TABLES && has_levels(frame)) {
        const int32_t all = r | g | b | (r + (n - 1) * step[0]) | (g + (n - 1) * step[1]) | (b + (n - 1) * step[2]);
        uint16_t *out = pixel_565(rows, x, y);
        if (all >> 24) run_of_colours_565(out, n, r, g, b, step, 0);
        else run_of_colours_565(out, n, r, g, b, step, 1);
        return;
    }
    for (; n > 0; n--, r += step[0], g += step[1], b += step[2], x++) {
        const int32_t colour[3] = {r, g, b};
        store_colour(frame, rows, x, y, colour);
    }
}

GN_HOT void gn_pixel_store_bits(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, uint32_t bits,
                                uint32_t packed)
{
    if (frame->picture.format == GN_FORMAT_RGB565) {
        for (uint16_t *out = pixel_565(rows, x, y); bits; bits >>= 1, out++)
            if (bits & 1U) *out = (uint16_t)packed;
        return;
    }
    for (; bits; bits >>= 1, x++)
        if (bits & 1U) gn_pixel_store(frame, rows, x, y, packed);
}
#endif
