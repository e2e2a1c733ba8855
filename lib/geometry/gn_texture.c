/* Textures. Positions are exact: coordinates have 20 fraction bits, and so have texels. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"

/* Texels of an axis of `size` <= 4096 at a coordinate. */
GN_HOT static inline gn_texture_taps find_taps(int32_t c_q20, uint32_t size, int clamped, int bilinear)
{
    uint32_t half = bilinear ? 1U << 19 : 0, below = 0;
    uint32_t turn = clamped ? (uint32_t)gn_max32(0, gn_min32(c_q20, (1 << 20) - 1)) : (uint32_t)c_q20 & 0xFFFFFU;
    uint32_t at_q20 = turn * size; /* < 2^32 */
    gn_texture_taps taps;
    if (at_q20 < half) {
        at_q20 += size << 20; /* modulo 2^32, and so is what comes next */
        below = (uint32_t)clamped;
    }
    at_q20 -= half;
    taps.weight_uq16 = at_q20 >> 4 & 0xFFFFU;
    taps.first = at_q20 >> 20;
    taps.second = taps.first + 1 < size ? taps.first + 1 : clamped ? taps.first : 0;
    if (below) taps.first = taps.second = 0;
    return taps;
}

typedef struct {
    gn_texture_taps u, v;
    int bilinear;
} footprint;

GN_HOT static inline void find_texels(footprint *out, const gn_texture *texture, int32_t u_q20, int32_t v_q20)
{
    out->bilinear = (texture->flags & GN_TEXTURE_BILINEAR) != 0;
    out->u = find_taps(u_q20, gn_texture_size(texture, 0), gn_texture_clamps(texture, 0), out->bilinear);
    out->v = find_taps(v_q20, gn_texture_size(texture, 1), gn_texture_clamps(texture, 1), out->bilinear);
}

GN_HOT static uint32_t blend(uint32_t wu, uint32_t wv, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return gn_texture_mix(gn_texture_mix(a, b, wu), gn_texture_mix(c, d, wu), wv);
}

#if GN_CASTER_ALPHA || GN_VISIBLE_ALPHA
/* Alpha of a texel, 65535: 1. */
GN_HOT static inline uint32_t texel_alpha(const gn_texture *t, const uint8_t *row, uint32_t x)
{
    if (GN_TEXEL_IS(t, GN_TEXTURE_RGBA8888)) return row[4 * x + 3] * 257U;
    if (GN_TEXEL_IS(t, GN_TEXTURE_RGB565A1)) return row[2 * x] & 32U ? 65535U : 0;
    if (GN_TEXEL_IS(t, GN_TEXTURE_ALPHA8)) return row[x] * 257U;
    if (GN_TEXEL_IS(t, GN_TEXTURE_ALPHA4)) return gn_texel_index(row, x, 2) * 4369U;
    if (GN_TEXEL_IS_PALETTE(t)) return t->palette[4 * gn_texel_index(row, x, gn_texel_bits_log2(t)) + 3] * 257U;
    return 65535U;
}

/* 65535: 1 */
GN_HOT static uint32_t filtered_alpha(const gn_texture *texture, int32_t u_q20, int32_t v_q20)
{
    footprint f;
    uint32_t stride = gn_texel_stride(texture);
    find_texels(&f, texture, u_q20, v_q20);
    const uint8_t *upper = texture->rgba + f.v.first * stride, *lower = texture->rgba + f.v.second * stride;
    uint32_t a = texel_alpha(texture, upper, f.u.first);
    if (!f.bilinear) return a;
    uint32_t b = texel_alpha(texture, upper, f.u.second), c = texel_alpha(texture, lower, f.u.first),
             d = texel_alpha(texture, lower, f.u.second);
    if ((a ^ b) | (a ^ c) | (a ^ d)) a = blend(f.u.weight_uq16, f.v.weight_uq16, a, b, c, d);
    return a;
}

GN_HOT uint32_t gn_texture_keeps(const gn_texture *texture, const gn_texture_curve *curve, uint32_t bits,
                                 const gn_alpha_test *test)
{
    uint32_t at[2], step[2], kept = 0;
    for (int i = 0; i < 2; i++) {
        at[i] = (uint32_t)curve->at_q28[i];
        step[i] = (uint32_t)curve->step_q28[i];
    }
    for (int32_t k = 0; bits; k++, bits >>= 1) {
        int32_t uv[2];
        for (int i = 0; i < 2; i++) {
            uv[i] = (int32_t)((uint32_t)curve->from_q20[i] + (uint32_t)((int32_t)at[i] >> 8));
            at[i] += step[i];
            step[i] += (uint32_t)curve->bend_q28[i];
        }
        if (bits & 1U && gn_alpha_passes(test, k, filtered_alpha(texture, uv[0], uv[1]))) kept |= 1U << k;
    }
    return kept;
}

GN_HOT uint32_t gn_texture_alpha(const gn_texture *texture, int32_t u_q20, int32_t v_q20)
{
    return gn_texture_to_uq16(filtered_alpha(texture, u_q20, v_q20));
}
#endif

GN_HOT void gn_texture_corners(gn_texture_triangle *out, const gn_mesh *mesh, const gn_texture *texture,
                               const uint16_t idx[3])
{
    for (int i = 0; i < 2; i++) {
        int64_t uv[3];
        for (int k = 0; k < 3; k++)
            uv[k] = (int64_t)mesh->uv[2 * (size_t)idx[k] + (size_t)i] * (1 << (16 - mesh->uv_frac_bits));
        out->uv_q16[0][i] = gn_texture_clamps(texture, i) ? uv[0] : uv[0] & 0xFFFF; /* whole turns change nothing */
        out->uv_q16[1][i] = uv[1] - uv[0];
        out->uv_q16[2][i] = uv[2] - uv[0];
    }
}

GN_HOT int32_t gn_texture_coord(const gn_texture_triangle *triangle, const gn_texture *texture, const int32_t b_q30[2],
                                int32_t which)
{
    /* the lowest bit of differences of at most 15 fraction bits is zero; half of them is below 2^31 */
    int32_t e1 = (int32_t)(triangle->uv_q16[1][which] >> 1), e2 = (int32_t)(triangle->uv_q16[2][which] >> 1),
            b1 = b_q30[0], b2 = b_q30[1];
    GN_KEEP(e1); /* signed: one multiplication */
    GN_KEEP(e2);
    GN_KEEP(b1);
    GN_KEEP(b2);
    int64_t c_q20 = triangle->uv_q16[0][which] * 16 + gn_shr64((int64_t)b1 * e1, 25) + gn_shr64((int64_t)b2 * e2, 25);
    return gn_texture_clamps(texture, which) ? gn_sat32(c_q20) : (int32_t)(uint32_t)c_q20;
}

/* Linear light of a texel: of sRGB colours of 8, 6, 5 or 4 bits. [M11] */
GN_HOT void gn_texture_texel(const gn_texture *t, uint32_t x, uint32_t y, uint16_t rgb[3])
{
    uint32_t bits_log2 = gn_texel_bits_log2(t);
    const uint8_t *row = t->rgba + y * gn_texel_stride(t);
    rgb[0] = rgb[1] = rgb[2] = 65535U;
    if (GN_TEXEL_IS(t, GN_TEXTURE_RGBA8888)) gn_texel_decode_rgba(gn_texel_word(row + 4 * x), rgb);
    else if (GN_TEXEL_IS_565(t))
        gn_texel_decode_565(row[2 * x] | (uint32_t)row[2 * x + 1] << 8, t->format == GN_TEXTURE_RGB565A1, rgb);
    else if (GN_TEXEL_IS_PALETTE(t))
        gn_texel_decode_rgba(gn_texel_word(t->palette + 4 * gn_texel_index(row, x, bits_log2)), rgb);
    else if (GN_TEXEL_IS_GREY(t))
        rgb[0] = rgb[1] = rgb[2] = gn_texel_decode_grey(gn_texel_index(row, x, bits_log2), bits_log2);
}

/* A colour in linear light. [M3] */
GN_HOT void gn_texture_colour(const gn_texture *texture, int32_t u_q20, int32_t v_q20, uint32_t rgb_uq16[3])
{
    footprint f;
    uint16_t texel[4][3];
    find_texels(&f, texture, u_q20, v_q20);
    gn_texture_texel(texture, f.u.first, f.v.first, texel[0]);
    if (f.bilinear) {
        gn_texture_texel(texture, f.u.second, f.v.first, texel[1]);
        gn_texture_texel(texture, f.u.first, f.v.second, texel[2]);
        gn_texture_texel(texture, f.u.second, f.v.second, texel[3]);
    }
    for (int c = 0; c < 3; c++) {
        uint32_t v = texel[0][c];
        if (f.bilinear) v = blend(f.u.weight_uq16, f.v.weight_uq16, v, texel[1][c], texel[2][c], texel[3][c]);
        rgb_uq16[c] = gn_texture_to_uq16(v);
    }
}
