/* Textures. Positions are exact: coordinates have 20 fraction bits, texels 16. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "base/gn_tables.h"
#include "geometry/gn_texture.h"

/* Texels of a coordinate, Q16, of 2^size_log2 <= 4096. A repeating one is modulo 2^12 turns, whole numbers of texels.
 */
GN_HOT static int32_t texels_q16(int32_t c_q20, int32_t size_log2)
{
    return size_log2 >= 4 ? (int32_t)((uint32_t)c_q20 << (size_log2 - 4)) : c_q20 >> (4 - size_log2);
}

GN_HOT static GN_SHARED gn_texture_taps find_taps(int32_t c_q20, int32_t size_log2, int clamped, int bilinear)
{
    uint32_t last = (1U << size_log2) - 1;
    int32_t half = bilinear ? 32768 : 0;
    gn_texture_taps taps;
    if (clamped) {
        int32_t at_q16 = texels_q16(gn_max32(0, gn_min32(c_q20, 1 << 20)), size_log2) - half; /* <= 2^28 */
        taps.first = (uint32_t)gn_max32(0, gn_min32(at_q16 >> 16, (int32_t)last));
        taps.second = (uint32_t)gn_min32((at_q16 >> 16) + 1, (int32_t)last);
        taps.weight_uq16 = (uint32_t)at_q16 & 0xFFFFU;
    } else {
        uint32_t at_q16 = (uint32_t)texels_q16(c_q20, size_log2) - (uint32_t)half; /* modulo a multiple of the size */
        taps.first = (at_q16 >> 16) & last;
        taps.second = (taps.first + 1) & last;
        taps.weight_uq16 = at_q16 & 0xFFFFU;
    }
    return taps;
}

typedef struct {
    const uint8_t *texel[4]; /* upper left, upper right, lower left, lower right; nearest: the first */
    uint32_t right_uq16, down_uq16;
    int bilinear;
} footprint;

GN_HOT static GN_SHARED void find_texels(footprint *out, const gn_texture *texture, int32_t u_q20, int32_t v_q20)
{
    out->bilinear = (texture->flags & GN_TEXTURE_BILINEAR) != 0;
    gn_texture_taps u = find_taps(u_q20, texture->width_log2, texture->flags & GN_TEXTURE_CLAMP_U, out->bilinear);
    gn_texture_taps v = find_taps(v_q20, texture->height_log2, texture->flags & GN_TEXTURE_CLAMP_V, out->bilinear);
    const uint8_t *upper = texture->rgba + 4 * ((size_t)v.first << texture->width_log2);
    const uint8_t *lower = texture->rgba + 4 * ((size_t)v.second << texture->width_log2);
    out->texel[0] = upper + 4 * u.first;
    out->texel[1] = upper + 4 * u.second;
    out->texel[2] = lower + 4 * u.first;
    out->texel[3] = lower + 4 * u.second;
    out->right_uq16 = u.weight_uq16;
    out->down_uq16 = v.weight_uq16;
}

/* Whether all four are the same, as in areas of one colour. */
GN_HOT static inline int is_uniform(const footprint *f, uint32_t channel)
{
    const uint8_t *const *t = f->texel;
    return !GN_SIZE_FIRST &&
           !((t[0][channel] ^ t[1][channel]) | (t[0][channel] ^ t[2][channel]) | (t[0][channel] ^ t[3][channel]));
}

GN_HOT static uint32_t blend(const footprint *f, const uint32_t value[4])
{
    return gn_texture_mix(gn_texture_mix(value[0], value[1], f->right_uq16),
                          gn_texture_mix(value[2], value[3], f->right_uq16), f->down_uq16);
}

GN_HOT uint32_t gn_texture_channel(const gn_texture *texture, int32_t u_q20, int32_t v_q20, uint32_t channel)
{
    footprint f;
    uint32_t value[4];
    find_texels(&f, texture, u_q20, v_q20);
    if (!f.bilinear || is_uniform(&f, channel)) return gn_texture_to_uq16(f.texel[0][channel] * 257U);
    for (int i = 0; i < 4; i++) value[i] = f.texel[i][channel] * 257U;
    return gn_texture_to_uq16(blend(&f, value));
}

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
    int64_t at = triangle->uv_q16[0][which], e1 = triangle->uv_q16[1][which], e2 = triangle->uv_q16[2][which];
    /* 2^30 * 2^33 would not fit; the lowest bit of differences of at most 15 fraction bits is zero */
    int64_t c_q20 = at * 16 + gn_shr64(b_q30[0] * (e1 >> 1), 25) + gn_shr64(b_q30[1] * (e2 >> 1), 25);
    return gn_texture_clamps(texture, which) ? gn_sat32(c_q20) : (int32_t)(uint32_t)c_q20;
}

/* A colour in linear light. [M3] */
GN_HOT void gn_texture_colour(const gn_texture *texture, int32_t u_q20, int32_t v_q20, uint32_t rgb_uq16[3])
{
    footprint f;
    uint32_t value[4];
    find_texels(&f, texture, u_q20, v_q20);
    for (int c = 0; c < 3; c++) {
        if (f.bilinear && !is_uniform(&f, (uint32_t)c)) {
            for (int i = 0; i < 4; i++) value[i] = gn_srgb_decode_entry(f.texel[i][c]);
            rgb_uq16[c] = gn_texture_to_uq16(blend(&f, value));
        } else {
            rgb_uq16[c] = gn_texture_to_uq16(gn_srgb_decode_entry(f.texel[0][c]));
        }
    }
}
