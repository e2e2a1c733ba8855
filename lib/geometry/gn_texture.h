/* Textures: colour in linear light, and single channels as they are stored (DESIGN 1.8). */
#ifndef GN_TEXTURE_H
#define GN_TEXTURE_H

#include "gnomon.h"

enum { GN_CHANNEL_RED, GN_CHANNEL_GREEN, GN_CHANNEL_BLUE, GN_CHANNEL_ALPHA };

/* One channel, not decoded: 0..65536. u and v of any value, v downwards, 20 fraction bits: 1/256 of a texel of the
 * largest texture. */
uint32_t gn_texture_channel(const gn_texture *texture, int32_t u_q20, int32_t v_q20, uint32_t channel);

/* The same of a mask image: bilinear and clamped, whatever its flags say, and lit in a channel that it lacks. */
uint32_t gn_texture_mask(const gn_texture *image, int32_t u_q16, int32_t v_q16, uint32_t channel);

/* Whether a mask image is the same in all channels wherever u and v (0, 1) are between least and most; at most 64
 * texels are looked at. */
int gn_texture_mask_is_even(const gn_texture *image, const int32_t least_q16[2], const int32_t most_q16[2]);

/* Whether a coordinate (0: u, 1: v) ends at the texture's borders; otherwise it repeats. */
GN_HOT static inline int gn_texture_clamps(const gn_texture *texture, int axis)
{
    return (texture->flags & (axis ? GN_TEXTURE_CLAMP_V : GN_TEXTURE_CLAMP_U)) != 0;
}

void gn_texture_corners(gn_texture_triangle *out, const gn_mesh *mesh, const gn_texture *texture,
                        const uint16_t idx[3]);

/* The coordinate (0: u, 1: v) of the point with barycentrics b1, b2, Q20: modulo 2^12 turns, saturated where it is
 * clamped. */
int32_t gn_texture_coord(const gn_texture_triangle *triangle, const gn_texture *texture, const int32_t b_q30[2],
                         int32_t which);

/* Where colours are read, one after the other: between four texels, decoded. */
typedef struct {
    const gn_texture *texture;
    uint32_t at; /* the first one's column and row, and whether the others are at the same; UINT32_MAX: none yet */
    int bilinear, clamp[2];
    int uniform; /* the first one's colour is that of all */
    uint32_t weight_uq16[2];
    uint16_t linear[3][4]; /* of a channel: upper left, upper right, lower left, lower right; 65535: 1 */
} gn_texture_reader;

void gn_texture_read_begin(gn_texture_reader *reader, const gn_texture *texture);

/* Coordinates with 26 fraction bits, modulo 2^6 turns; clamped: within 2^5. Returns whether the colour there is that of
 * the last place. */
int gn_texture_move(gn_texture_reader *reader, int32_t u_q26, int32_t v_q26);

/* The colour there, as gn_texture_colour() says it. */
void gn_texture_read(const gn_texture_reader *reader, uint32_t rgb_uq16[3]);

/* Red, green, blue in linear light, 0..65536 each: texels are decoded before they are filtered. */
void gn_texture_colour(const gn_texture *texture, int32_t u_q20, int32_t v_q20, uint32_t rgb_uq16[3]);

/* ---- Common to textures and masks -------------------------------------------------------------------------------- */

/* The two texels of an axis and the second one's weight of 65536; nearest: the first alone. */
typedef struct {
    uint32_t first, second, weight_uq16;
} gn_texture_taps;

/* Until the end 65535 means 1, so that a product with a weight fits 32 bits. Each axis is followed by rounding to 16
 * bits; the last step makes 65536 = 1. 65535 * 65536 + 32768 < 2^32; two equal values stay unchanged. */
GN_HOT static inline uint32_t gn_texture_mix(uint32_t a, uint32_t b, uint32_t weight_uq16)
{
    return (a * (65536U - weight_uq16) + b * weight_uq16 + 32768U) >> 16;
}

/* round(v * 65536 / 65535) */
GN_HOT static inline uint32_t gn_texture_to_uq16(uint32_t v)
{
    return v + (v >> 15);
}

#endif
