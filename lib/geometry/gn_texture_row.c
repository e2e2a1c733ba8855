/* Colours of textures along rows of pixels: steps in texels, weights of 8 bits. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"

#if GN_INTERPOLATES

/* Weights of four texels, from the upper left one on; they sum to 65536. Exact: 8 bits each way. */
GN_HOT static inline void find_weights(uint32_t u_q17, uint32_t v_q17, uint32_t weight_uq16[4])
{
    uint32_t right = u_q17 >> 9 & 255U, down = v_q17 >> 9 & 255U, both = right * down;
    weight_uq16[3] = both;
    weight_uq16[1] = (right << 8) - both;
    weight_uq16[2] = (down << 8) - both;
    weight_uq16[0] = 65536U - (right << 8) - weight_uq16[2];
}

/* Rounded down, and so up to 1 too dark; 65535 * 65536 < 2^32. */
GN_HOT static inline uint16_t weigh(const uint32_t weight_uq16[4], uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return (uint16_t)((weight_uq16[0] * a + weight_uq16[1] * b + weight_uq16[2] * c + weight_uq16[3] * d) >> 16);
}

/* ---- Any pixel --------------------------------------------------------------------------------------------------- */

/* The texel of an axis at a whole coordinate, and the next. Where it repeats, the coordinate is brought back to 0. */
GN_HOT static void find_pair(const gn_texture *t, int axis, int32_t *at_q17, uint32_t pair[2])
{
    int32_t size = (int32_t)gn_texture_size(t, axis), first = *at_q17 >> 17, next = first + 1;
    if (gn_texture_clamps(t, axis)) {
        first = gn_max32(0, gn_min32(first, size - 1));
        next = gn_max32(0, gn_min32(next, size - 1));
    } else {
        int32_t turns = first / size - (first % size < 0);
        *at_q17 -= turns * size * (1 << 17);
        first -= turns * size;
        next = first + 1 < size ? first + 1 : 0;
    }
    pair[0] = (uint32_t)first;
    pair[1] = (uint32_t)next;
}

GN_HOT static gn_texel_rgb texel_of_channels(const uint16_t rgb[3])
{
    gn_texel_rgb out = {rgb[0] | (uint32_t)rgb[1] << 16, rgb[2]};
    return out;
}

/* ---- Pixels whose texels lie inside ------------------------------------------------------------------------------ */

enum { TEXELS_RGBA, TEXELS_565, TEXELS_565A1, TEXELS_PALETTE, TEXELS_GREY };

#define IS_565(kind) (GN_TEXEL_565S && ((kind) == TEXELS_565 || (kind) == TEXELS_565A1))

/* The texture that a row of pixels reads. */
typedef struct {
    const gn_texture *texture;
    const uint8_t *texels;
    uint32_t stride, bits_log2, end_q17[2]; /* coordinates below it need no care */
} row_source;

/* A texel as it is stored: of RGBA or a palette red, green, blue, alpha from the lowest byte on. `kind` is a constant:
 * each kind has a loop of its own, in which nothing is asked twice. */
GN_INLINE uint32_t read_texel(const row_source *s, int kind, const uint8_t *row, uint32_t x)
{
    if (kind == TEXELS_RGBA) return gn_texel_word(row + 4 * x);
    if (IS_565(kind)) return (uint32_t)row[2 * x] | (uint32_t)row[2 * x + 1] << 8;
    uint32_t index = s->bits_log2 == 3 ? row[x] : gn_texel_index(row, x, s->bits_log2);
    if (kind == TEXELS_PALETTE) return gn_texel_word(s->texture->palette + 4 * index);
    return s->bits_log2 == 2 ? index * 17U : index;
}

/* A texel and the next. Where memory may be read at any address the compiler makes one load of four bytes. */
GN_INLINE void read_pair(const row_source *s, int kind, const uint8_t *row, uint32_t x, uint32_t out[2])
{
    if (IS_565(kind)) {
        uint32_t both = gn_texel_word(row + 2 * x);
        out[0] = both & 0xFFFFU;
        out[1] = both >> 16;
        return;
    }
    out[0] = read_texel(s, kind, row, x);
    out[1] = read_texel(s, kind, row, x + 1);
}

/* Where a place's row begins; of whole bytes its texel. */
GN_INLINE const uint8_t *texel_place(const row_source *s, int kind, uint32_t u_q17, uint32_t v_q17)
{
    const uint8_t *row = s->texels + (v_q17 >> 17) * s->stride;
    if (kind == TEXELS_RGBA) return row + 4 * (u_q17 >> 17);
    return IS_565(kind) ? row + 2 * (u_q17 >> 17) : row;
}

/* The texel's column from there on. */
GN_INLINE uint32_t texel_column(int kind, uint32_t u_q17)
{
    return kind == TEXELS_RGBA || IS_565(kind) ? 0 : u_q17 >> 17;
}

/* Red, green or blue of it in linear light. */
GN_INLINE uint32_t red_of(int kind, uint32_t texel)
{
    if (IS_565(kind)) return gn_linear_31_table[texel >> 11];
    return gn_srgb_decode_table[kind == TEXELS_GREY ? texel : texel & 255U];
}

GN_INLINE uint32_t green_of(int kind, uint32_t texel)
{
    if (IS_565(kind) && kind == TEXELS_565) return gn_linear_63_table[texel >> 5 & 63U];
    if (IS_565(kind)) return gn_linear_31_table[texel >> 6 & 31U];
    return gn_srgb_decode_table[texel >> 8 & 255U];
}

GN_INLINE uint32_t blue_of(int kind, uint32_t texel)
{
    if (IS_565(kind)) return gn_linear_31_table[texel & 31U];
    return gn_srgb_decode_table[texel >> 16 & 255U];
}

GN_INLINE void store_texel(int kind, uint32_t texel, gn_texel_rgb *out)
{
    uint32_t red = red_of(kind, texel);
    out->red_green = red | (kind == TEXELS_GREY ? red : green_of(kind, texel)) << 16;
    out->blue = kind == TEXELS_GREY ? red : blue_of(kind, texel);
}

/* Red and green in the lower word, blue in the upper one: two registers. Between four texels; a function of its own, so
 * that pixels between equal ones keep their registers. */
GN_INLINE uint64_t blend_texels(const row_source *s, int kind, const uint8_t *at, uint32_t u_q17, uint32_t v_q17)
{
    uint32_t t[4], weight[4], x = texel_column(kind, u_q17);
    read_pair(s, kind, at, x, t);
    read_pair(s, kind, at + s->stride, x, t + 2);
    find_weights(u_q17, v_q17, weight);
    uint32_t red = weigh(weight, red_of(kind, t[0]), red_of(kind, t[1]), red_of(kind, t[2]), red_of(kind, t[3])),
             green = red, blue = red;
    if (kind != TEXELS_GREY) {
        green = weigh(weight, green_of(kind, t[0]), green_of(kind, t[1]), green_of(kind, t[2]), green_of(kind, t[3]));
        blue = weigh(weight, blue_of(kind, t[0]), blue_of(kind, t[1]), blue_of(kind, t[2]), blue_of(kind, t[3]));
    }
    return red | green << 16 | (uint64_t)blue << 32;
}

GN_HOT static GN_NOINLINE uint64_t blend_rgba(const row_source *s, const uint8_t *at, uint32_t u_q17, uint32_t v_q17)
{
    return blend_texels(s, TEXELS_RGBA, at, u_q17, v_q17);
}

GN_HOT static GN_NOINLINE uint64_t blend_565(const row_source *s, const uint8_t *at, uint32_t u_q17, uint32_t v_q17)
{
    return blend_texels(s, TEXELS_565, at, u_q17, v_q17);
}

GN_HOT static GN_NOINLINE uint64_t blend_565a1(const row_source *s, const uint8_t *at, uint32_t u_q17, uint32_t v_q17)
{
    return blend_texels(s, TEXELS_565A1, at, u_q17, v_q17);
}

GN_HOT static GN_NOINLINE uint64_t blend_palette(const row_source *s, const uint8_t *at, uint32_t u_q17, uint32_t v_q17)
{
    return blend_texels(s, TEXELS_PALETTE, at, u_q17, v_q17);
}

GN_HOT static GN_NOINLINE uint64_t blend_grey(const row_source *s, const uint8_t *at, uint32_t u_q17, uint32_t v_q17)
{
    return blend_texels(s, TEXELS_GREY, at, u_q17, v_q17);
}

GN_INLINE uint64_t blend_kind(const row_source *s, int kind, const uint8_t *at, uint32_t u_q17, uint32_t v_q17)
{
    if (kind == TEXELS_RGBA) return blend_rgba(s, at, u_q17, v_q17);
    if (kind == TEXELS_565) return blend_565(s, at, u_q17, v_q17);
    if (kind == TEXELS_565A1) return blend_565a1(s, at, u_q17, v_q17);
    return kind == TEXELS_PALETTE ? blend_palette(s, at, u_q17, v_q17) : blend_grey(s, at, u_q17, v_q17);
}

/* Copies a texel, one of less than a byte into a whole one. Memory that may be read at any address takes one load. */
GN_INLINE void copy_texel(uint8_t *to, const uint8_t *row, uint32_t x, uint32_t bits_log2, uint32_t factor)
{
    if (bits_log2 == 5) {
        const uint8_t *from = row + 4 * x;
        to[0] = from[0], to[1] = from[1], to[2] = from[2], to[3] = from[3];
    } else if (bits_log2 == 4) {
        const uint8_t *from = row + 2 * x;
        to[0] = from[0], to[1] = from[1];
    } else to[0] = (uint8_t)(gn_texel_index(row, x, bits_log2) * factor);
}

/* Between the four texels of a pixel at the texture's borders, brought side by side: a texture of two by two. */
GN_HOT static uint64_t blend_at_border(const row_source *s, int kind, const int32_t at_q17[2], const uint32_t x[2],
                                       const uint32_t y[2])
{
    uint8_t texel[16];
    const uint32_t bits_log2 = GN_FORMATS == 1 ? 5 : s->bits_log2, bytes_log2 = bits_log2 > 3 ? bits_log2 - 3 : 0,
                   factor = kind == TEXELS_GREY && bits_log2 == 2 ? 17 : 1; /* of 4 bits, as read_texel() has it */
    const row_source side = {s->texture, texel, 2U << bytes_log2, bytes_log2 + 3, {0, 0}};
    for (uint32_t i = 0; i < 2; i++) {
        const uint8_t *row = s->texels + y[i] * s->stride;
        uint8_t *to = texel + (i * 2 << bytes_log2);
        copy_texel(to, row, x[0], bits_log2, factor);
        copy_texel(to + (1U << bytes_log2), row, x[1], bits_log2, factor);
    }
    return blend_kind(&side, kind, texel, (uint32_t)at_q17[0] & 0x1FFFFU, (uint32_t)at_q17[1]);
}

GN_INLINE void store_both(uint64_t rgb, gn_texel_rgb *out)
{
    out->red_green = (uint32_t)rgb;
    out->blue = (uint32_t)(rgb >> 32);
}

/* A pixel whose texels may lie anywhere; a coordinate that repeats is brought back to 0. */
GN_HOT static GN_NOINLINE void any_pixel(const row_source *s, int kind, int32_t at_q17[2], gn_texel_rgb *out)
{
    uint32_t x[2], y[2];
    find_pair(s->texture, 0, &at_q17[0], x);
    find_pair(s->texture, 1, &at_q17[1], y);
    if (s->texture->flags & GN_TEXTURE_BILINEAR) {
        store_both(blend_at_border(s, kind, at_q17, x, y), out);
        return;
    }
    uint16_t rgb[3];
    gn_texture_texel(s->texture, x[0], y[0], rgb);
    *out = texel_of_channels(rgb);
}

GN_INLINE void one_pixel(const row_source *s, int kind, int bilinear, uint32_t u, uint32_t v, gn_texel_rgb *out)
{
    const uint8_t *at = texel_place(s, kind, u, v);
    uint32_t upper[2], lower[2], x = texel_column(kind, u);
    if (!bilinear) {
        store_texel(kind, read_texel(s, kind, at, x), out);
        return;
    }
    GN_KEEP(at); /* computed once */
    if (IS_565(kind)) {
        uint32_t both = gn_texel_word(at);
        if (both == (both >> 16 | both << 16) && both == gn_texel_word(at + s->stride)) {
            store_texel(kind, both & 0xFFFFU, out);
            return;
        }
        store_both(blend_kind(s, kind, at, u, v), out);
        return;
    }
    read_pair(s, kind, at, x, upper);
    if (upper[0] == upper[1]) { /* seldom where no texel is like the next: the others are read only then */
        read_pair(s, kind, at + s->stride, x, lower);
        if (upper[0] == lower[0] && upper[0] == lower[1]) {
            store_texel(kind, upper[0], out);
            return;
        }
    }
    store_both(blend_kind(s, kind, at, u, v), out);
}

GN_INLINE void pixels(const row_source *s, int kind, int bilinear, const gn_texture_line *line, uint32_t bits,
                      gn_texel_rgb *out)
{
    int32_t u = line->at_q17[0], v = line->at_q17[1], u_step = line->step_q17[0], v_step = line->step_q17[1];
    for (; bits; bits >>= 1, out++) {
        if (bits & 1U) {
            if ((uint32_t)u < s->end_q17[0] && (uint32_t)v < s->end_q17[1])
                one_pixel(s, kind, bilinear, (uint32_t)u, (uint32_t)v, out);
            else {
                int32_t at[2] = {u, v}; /* not u and v themselves: they stay in registers */
                any_pixel(s, kind, at, out);
                u = at[0];
                v = at[1];
            }
        }
        u += u_step;
        v += v_step;
        u_step += line->step_change_q17[0];
        v_step += line->step_change_q17[1];
    }
}

GN_INLINE void row_of_kind(const row_source *s, int kind, const gn_texture_line *line, uint32_t bits, gn_texel_rgb *out)
{
    if (s->texture->flags & GN_TEXTURE_BILINEAR) pixels(s, kind, 1, line, bits, out);
    else pixels(s, kind, 0, line, bits, out);
}

GN_HOT void gn_texture_row(const gn_texture *t, const gn_texture_line *line, uint32_t bits, gn_texel_rgb *out)
{
    uint32_t border = t->flags & GN_TEXTURE_BILINEAR ? 1 : 0;
    row_source s = {t, t->rgba, gn_texel_stride(t), gn_texel_bits_log2(t), {0, 0}};
    for (int i = 0; i < 2; i++) s.end_q17[i] = (gn_texture_size(t, i) - border) << 17;
    if (GN_TEXEL_IS(t, GN_TEXTURE_RGBA8888)) row_of_kind(&s, TEXELS_RGBA, line, bits, out);
    else if (GN_TEXEL_IS(t, GN_TEXTURE_RGB565)) row_of_kind(&s, TEXELS_565, line, bits, out);
    else if (GN_TEXEL_IS(t, GN_TEXTURE_RGB565A1)) row_of_kind(&s, TEXELS_565A1, line, bits, out);
    else if (GN_TEXEL_IS_PALETTE(t)) row_of_kind(&s, TEXELS_PALETTE, line, bits, out);
    else if (GN_TEXEL_IS_GREY(t)) row_of_kind(&s, TEXELS_GREY, line, bits, out);
    else
        for (; bits; bits >>= 1, out++) *out = GN_TEXEL_WHITE;
}

#endif

/* ---- Half-size levels of textures -------------------------------------------------------------------------------- */

/* Which one a view depth reads (MODEL 8). */

#if GN_MIPMAPS
/* Twice the triangle's area in turns, Q30. Differences are below 2^32 and, of at most 15 fraction bits, even: 2 * 2^62
 */
GN_HOT static uint64_t texture_area_q30(const gn_texture_triangle *t)
{
    int64_t half[2][2];
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 2; i++) half[k][i] = t->uv_q16[k + 1][i] / 2;
    return gn_abs64(half[0][0] * half[1][1] - half[0][1] * half[1][0]);
}

/* floor(sqrt(a)), at most 2^64 - 1 */
GN_HOT static uint64_t root(gn_bfloat a)
{
    int32_t odd = a.exp & 1, shift = 47 - ((a.exp - odd) / 2 + odd);
    uint32_t mant = a.mant >> odd;
    uint64_t q47 = (uint64_t)mant * gn_rsqrt_norm(mant, 2); /* of mant: below 2^63 */
    if (shift < -1) return UINT64_MAX;
    if (shift < 0) return q47 << 1;
    return shift > 63 ? 0 : q47 >> shift;
}

/* Where log2(S Z^2 / (F d)) = 1/2: Z^4 = 2 F^2 d^2 / S^2, with S^2 the area in texels over |n|, d = det / |n|. */
GN_HOT uint64_t gn_texture_level_depth2(const gn_texture_triangle *triangle, const gn_texture *texture,
                                        const gn_plane *area, const gn_plane *screen, uint32_t focal2_px_q16)
{
    uint64_t turns_q30 = texture_area_q30(triangle);
    if (!turns_q30 || screen->det <= 0) return UINT64_MAX;
    gn_length length = gn_length_of(2, area->n); /* of the longest: 2^(63 - shift / 2) / root */
    gn_bfloat texels = gn_bf_mul(gn_bf_from_u64(turns_q30),
                                 gn_bf_from_u64((uint64_t)gn_texture_size(texture, 0) * gn_texture_size(texture, 1))),
              per_area = gn_bf_mul(gn_bf_from_u64(length.root), gn_bf_recip(texels)),
              seen = gn_bf_mul(gn_bf_from_u64((uint64_t)screen->det), gn_bf_from_u64(focal2_px_q16)),
              depth4 = gn_bf_mul(gn_bf_mul(seen, seen), per_area);
    depth4.exp += length.shift / 2 - 63 + 2 * screen->n_exp - area->n_exp - 3; /* 2F is Q16, areas are Q30 */
    return root(depth4);
}

GN_HOT uint32_t gn_texture_level_at(const gn_texture *texture, uint64_t depth2_q32, int32_t z_q16)
{
    uint32_t level = 0;
    while (gn_texture_level_ends(texture, depth2_q32, level, z_q16)) level++;
    return level;
}

GN_HOT void gn_texture_use_level(gn_texture *out, const gn_texture *texture, uint32_t level)
{
    *out = *texture;
    for (uint32_t i = 0; i < level; i++) {
        out->rgba += gn_texel_stride(out) * gn_texture_size(out, 1);
        out->width = (uint16_t)gn_texture_level_size(texture, 0, i + 1);
        out->height = (uint16_t)gn_texture_level_size(texture, 1, i + 1);
    }
}
#endif
