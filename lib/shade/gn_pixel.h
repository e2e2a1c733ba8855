/* From linear light to pixels of the picture's format. */
#ifndef GN_PIXEL_H
#define GN_PIXEL_H

#include "base/gn_base_types.h"
#include "base/gn_q.h"
#include "gnomon.h"

/* 65535 * srgb(x), x in Q20 clamped to 1; error below 1.5 LSB. */
uint32_t gn_srgb_encode(uint32_t linear_q20);

/* Encodes a colour for the picture's format: RGB565 as stored; red | green << 8 | blue << 16; grey as 8 or 4 bits; for
 * MONO1 the luminance in linear light, 0..65535, which the dither compares. Greys encode the luminance 0.2126 R +
 * 0.7152 G + 0.0722 B. */
uint32_t gn_pixel_pack(const gn_frame *frame, const uint32_t linear_q20[3]);

/* Bytes of a tile of finished pixels. */
size_t gn_pixel_bytes(const gn_frame *frame, int32_t width, int32_t height);

/* Stores a packed pixel n times from (x, y) of the picture on, within one row. */
void gn_pixel_fill(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, int32_t n, uint32_t packed);

/* Stores a line's pixels from (x, y) of the picture on: those whose bit in `bits` is set, bit i for pixel i; at
 * most 16.
 */
void gn_pixel_store_line(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, uint32_t bits,
                         const gn_pixel_line *line);

/* Stores n pixels from (x, y) of the picture on; colours begin with `from` and go on by `step`, and are within 2^30 up
 * to the one behind the last. */
void gn_pixel_store_run(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, int32_t n,
                        const int32_t from_q24[3], const int32_t step_q24[3]);

/* RGB565 in the other order of bytes. */
GN_HOT static inline uint32_t gn_pixel_swapped(uint32_t v)
{
    return v >> 8 | (v & 255U) << 8;
}

/* Stores one packed colour in the pixels whose bit in `bits` is set, bit i for pixel (x + i, y). */
void gn_pixel_store_bits(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, uint32_t bits,
                         uint32_t packed);

/* Stores a 16-bit pixel n times from index i of the tile on, two per word if there are many. */
GN_HOT static inline void gn_pixel_fill_16(gn_tile_pixels *pixels, uint32_t i, uint32_t n, uint32_t packed)
{
    uint32_t end = i + n;
    if (n >= 8) {
        uint32_t both = packed | packed << 16, word = (i + 1) >> 1, words = end >> 1;
        if (i & 1U) pixels->rgb565[i] = (uint16_t)packed;
        for (; word + 4 <= words; word += 4)
            pixels->raw[word] = pixels->raw[word + 1] = pixels->raw[word + 2] = pixels->raw[word + 3] = both;
        for (; word < words; word++) pixels->raw[word] = both;
        i = 2 * words;
    }
    for (; i < end; i++) pixels->rgb565[i] = (uint16_t)packed;
}

/* Stores one packed pixel at (x, y) of the picture; RGB565 is tested first: most panels use it. */
GN_HOT static inline void gn_pixel_store(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y,
                                         uint32_t packed)
{
    if (frame->picture.format == GN_FORMAT_RGB565 || (!GN_OTHER_FORMATS && !GN_RAW_VIEWS))
        rows->pixels->rgb565[(y - rows->y0) * rows->width + x - rows->x0] = (uint16_t)packed;
    else gn_pixel_fill(frame, rows, x, y, 1, packed);
}

/* ---- Pixels between two colours, in steps of 1 / 64, each encoded once ------------------------------------------- */

#if GN_INTERPOLATES && GN_SHADOWS

/* Sets the two ends: the colour in shadow, and what the light adds to it. */
void gn_levels_use(gn_lattice *lattice, const int32_t dark_q24[3], const int32_t more_q24[3]);

/* Forgets the encoded levels: of another picture. */
GN_HOT static inline void gn_levels_forget(gn_lattice *lattice)
{
    gn_levels *l = &lattice->levels;
    l->known[0] = l->known[1] = l->known[2] = 0;
}

/* Encodes a level. */
uint32_t gn_levels_find(gn_shading *s, uint32_t level);

/* The pixel of an attenuation, 0 .. 65536. */
GN_HOT static inline uint32_t gn_levels_pixel(gn_shading *s, uint32_t attenuation)
{
    uint32_t level = (attenuation + 512) >> 10;
    const gn_levels *l = &s->lattice.levels;
    if (l->known[level >> 5] >> (level & 31) & 1U) return l->pixel[level];
    return gn_levels_find(s, level);
}

#endif

#endif
