/* Textures: colour in linear light, and alpha (MODEL 8). */
#ifndef GN_TEXTURE_H
#define GN_TEXTURE_H

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "gnomon.h"

/* Alpha, 0..65536. u and v of any value, v downwards, 20 fraction bits: 1/256 of a texel of the largest texture. */
uint32_t gn_texture_alpha(const gn_texture *texture, int32_t u_q20, int32_t v_q20);

/* Coordinates along a row of pixels, k < 32 of them on: from + (at + k step + k (k - 1) / 2 bend), of the sum in
 * brackets without its lowest 8 bits. */
typedef struct {
    int32_t from_q20[2], at_q28[2], step_q28[2], bend_q28[2];
} gn_texture_curve;

/* Which pixels a row's alphas keep: those of at least `least`, 65535: 1; if it dithers, those of which alpha times
 * `whole` is at least the noise. */
typedef struct {
    uint32_t least, whole_uq16;
    int dithers;
    int32_t x, y; /* the row's first pixel */
} gn_alpha_test;

/* Of the pixels `bits` of such a row those that are kept; the lowest bit is the first. */
uint32_t gn_texture_keeps(const gn_texture *texture, const gn_texture_curve *curve, uint32_t bits,
                          const gn_alpha_test *test);

/* A channel of a mask image: bilinear and clamped, whatever its flags say, and lit in a channel that it lacks. */
uint32_t gn_texture_mask(const gn_texture *image, int32_t u_q16, int32_t v_q16, uint32_t channel);

/* Whether a mask image is the same in all channels wherever u and v (0, 1) are between least and most; at most 64
 * texels are looked at. */
int gn_texture_mask_is_even(const gn_texture *image, const int32_t least_q16[2], const int32_t most_q16[2]);

/* Whether a coordinate (0: u, 1: v) ends at the texture's borders; otherwise it repeats. */
GN_HOT static inline int gn_texture_clamps(const gn_texture *texture, int axis)
{
    return (texture->flags & (axis ? GN_TEXTURE_CLAMP_V : GN_TEXTURE_CLAMP_U)) != 0;
}

/* Texels along u (0) or v (1), 1..4096. */
GN_HOT static inline uint32_t gn_texture_size(const gn_texture *texture, int axis)
{
    uint32_t size = axis ? texture->height : texture->width;
    return size ? size : 1U << (axis ? texture->height_log2 : texture->width_log2);
}

/* Rounded up. */
GN_HOT static inline uint32_t gn_texture_size_log2(const gn_texture *texture, int axis)
{
    uint32_t size = gn_texture_size(texture, axis);
    return size > 1 ? 32U - (uint32_t)gn_clz32(size - 1) : 0;
}

/* The view depth from which on the first smaller level is read, squared: each further one begins at twice that.
 * UINT64_MAX: none is. `area` is that of the plane that `screen` projects: the same, but of an orthographic camera.
 * MODEL 8. [M11] */
uint64_t gn_texture_level_depth2(const gn_texture_triangle *triangle, const gn_texture *texture, const gn_plane *area,
                                 const gn_plane *screen, uint32_t focal2_px_q16);

GN_HOT static inline int gn_texture_has_levels(const gn_texture *texture)
{
    return (texture->flags & GN_TEXTURE_MIPMAPPED) != 0;
}

/* Texels of a level along an axis. */
GN_HOT static inline uint32_t gn_texture_level_size(const gn_texture *texture, int axis, uint32_t level)
{
    uint32_t size = gn_texture_size(texture, axis) >> level;
    return size ? size : 1;
}

/* Whether a view depth that is beyond the beginning of a level is beyond its end: so depth2 << level is below 2^63. */
GN_HOT static inline int gn_texture_level_ends(const gn_texture *texture, uint64_t depth2_q32, uint32_t level,
                                               int32_t z_q16)
{
    uint32_t sides = (gn_texture_size(texture, 0) | gn_texture_size(texture, 1)) >> level;
    return (uint64_t)z_q16 * (uint64_t)z_q16 >= depth2_q32 << level && sides > 1;
}

/* The level at a view depth. */
uint32_t gn_texture_level_at(const gn_texture *texture, uint64_t depth2_q32, int32_t z_q16);

/* A level as a texture of its own. */
void gn_texture_use_level(gn_texture *out, const gn_texture *texture, uint32_t level);

void gn_texture_corners(gn_texture_triangle *out, const gn_mesh *mesh, const gn_texture *texture,
                        const uint16_t idx[3]);

/* The coordinate (0: u, 1: v) of the point with barycentrics b1, b2, Q20: modulo 2^12 turns, saturated where it is
 * clamped. */
int32_t gn_texture_coord(const gn_texture_triangle *triangle, const gn_texture *texture, const int32_t b_q30[2],
                         int32_t which);

/* Red, green, blue in linear light, 0..65536 each: texels are decoded before they are filtered. */
void gn_texture_colour(const gn_texture *texture, int32_t u_q20, int32_t v_q20, uint32_t rgb_uq16[3]);

#define GN_TEXEL_WHITE ((gn_texel_rgb){0xFFFFFFFFU, 65535U})

/* Coordinates along a row of pixels, in texels: a quadratic from its first pixel on; |.| < 2^14. A bilinear texture's
 * are half a texel less, and 1/512 more, for weights of 8 bits. */
typedef struct {
    int32_t at_q17[2], step_q17[2], step_change_q17[2];
} gn_texture_line;

/* Colours of the pixels `bits`, the lowest first; at most 16. */
void gn_texture_row(const gn_texture *texture, const gn_texture_line *line, uint32_t bits, gn_texel_rgb *texel);

/* ---- Common to the files of textures ----------------------------------------------------------------------------- */

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

#if GN_CASTER_ALPHA || GN_VISIBLE_ALPHA
/* Whether the row's pixel i, whose alpha is 0..65535, is kept. */
GN_HOT static inline int gn_alpha_passes(const gn_alpha_test *test, int32_t i, uint32_t alpha)
{
    if (!test->dithers) return alpha >= test->least;
    return gn_mul_uq16(test->whole_uq16, gn_texture_to_uq16(alpha)) >= gn_noise_uq16(test->x + i, test->y);
}
#endif

/* A texel's colour in linear light, 65535: 1. */
void gn_texture_texel(const gn_texture *texture, uint32_t x, uint32_t y, uint16_t rgb[3]);

/* ---- Texels of each format --------------------------------------------------------------------------------------- */

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
    rgb[0] = gn_srgb_decode_table[word & 255U];
    rgb[1] = gn_srgb_decode_table[word >> 8 & 255U];
    rgb[2] = gn_srgb_decode_table[word >> 16 & 255U];
}

GN_HOT static inline void gn_texel_decode_565(uint32_t texel, int has_alpha, uint16_t rgb[3])
{
    rgb[0] = gn_linear_31_table[texel >> 11 & 31U];
    rgb[1] = has_alpha ? gn_linear_31_table[texel >> 6 & 31U] : gn_linear_63_table[texel >> 5 & 63U];
    rgb[2] = gn_linear_31_table[texel & 31U];
}

GN_HOT static inline uint16_t gn_texel_decode_grey(uint32_t value, uint32_t bits_log2)
{
    return gn_srgb_decode_table[bits_log2 == 2 ? value * 17U : value];
}

/* ---- Triangles that alpha cuts ----------------------------------------------------------------------------------- */

/* Clip and dither (MODEL 6, 8), as the camera or a light sees them, along the rows that are walked. */

/* A triangle of an object. If it has a texture, cut->textured, gn_alpha_plane comes next. */
void gn_alpha_begin(gn_alpha_cut *cut, const gn_object *object, gn_alpha mode, const uint16_t idx[3]);

/* Its corners, as gn_plane_setup takes them, in a picture `width` pixels wide. */
void gn_alpha_plane(gn_alpha_cut *cut, const gn_frame *frame, int32_t (*v)[3], uint32_t focal2_px_q16, int32_t width,
                    int32_t newton_steps);

/* Row y, seen along the ray py, of which the triangle covers x_begin <= x < x_end, inside the screen tile or not. */
GN_HOT static inline void gn_alpha_row(gn_alpha_cut *cut, int32_t y, int32_t py, int32_t x_begin, int32_t x_end)
{
    cut->y = y;
    cut->py = py;
#if GN_TEXTURES
    cut->x_begin = x_begin;
    cut->x_end = x_end;
    cut->steps.end = x_begin; /* none yet */
    cut->steps.bent = INT32_MIN;
    cut->exact.x = x_end; /* nor this: never the first column of a row */
#else
    (void)x_begin, (void)x_end;
#endif
}

/* Of pixels x .. x + 31 of the row those of `asked` that are not cut: the lowest bit is pixel x, and all that are asked
 * are of x_begin .. x_end - 1. (x, y) picks the noise of the dither. */
uint32_t gn_alpha_keeps(gn_alpha_cut *cut, int32_t x, uint32_t asked);

/* ---- Textured ones ---------------------------------------------------------------------------- */

/* Texture coordinates of the triangle's corners. */
void gn_alpha_corners(gn_alpha_cut *cut, const uint16_t idx[3]);

/* Texture coordinates from pixel x >= 0 of the row on. Returns for how many pixels: with persp_step > 1 they are
 * interpolated between exact ones, up to 32 pixels apart; error below 2^-8 texel (NUMERICS 4.9). */
int32_t gn_alpha_coords(gn_alpha_cut *cut, int32_t x, gn_texture_curve *curve);

#endif
