/* Textures. Positions are exact: coordinates have 20 fraction bits, texels 16. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "base/gn_tables.h"
#include "geometry/gn_texture.h"

/* Texels of an axis of 2^size_log2 <= 4096 at a coordinate, modulo 2^6 turns, or clamped and within 2^5. */
GN_HOT static inline gn_texture_taps find_taps(int32_t c_q26, int32_t size_log2, int clamped, int bilinear)
{
    int32_t last = (1 << size_log2) - 1, shift = 26 - size_log2, half = bilinear ? 1 << (shift - 1) : 0, first;
    gn_texture_taps taps;
    if (clamped) c_q26 = gn_max32(0, gn_min32(c_q26, 1 << 26));
    c_q26 = (int32_t)((uint32_t)c_q26 - (uint32_t)half);
    first = c_q26 >> shift;
    taps.weight_uq16 = (uint32_t)c_q26 << (32 - shift) >> 16;
    taps.first = (uint32_t)(clamped ? gn_max32(0, gn_min32(first, last)) : first & last);
    taps.second = (uint32_t)(clamped ? gn_min32(first + 1, last) : (first + 1) & last);
    return taps;
}

/* A coordinate with 20 fraction bits in the form of find_taps(). */
GN_HOT static inline int32_t to_q26(int32_t c_q20, int clamped)
{
    return clamped ? gn_max32(0, gn_min32(c_q20, 1 << 20)) * 64 : (int32_t)((uint32_t)c_q20 << 6);
}

typedef struct {
    const uint8_t *texel[4]; /* upper left, upper right, lower left, lower right; nearest: the first */
    uint32_t right_uq16, down_uq16;
    int bilinear;
} footprint;

GN_HOT static GN_SHARED void find_texels(footprint *out, const gn_texture *texture, int32_t u_q20, int32_t v_q20)
{
    out->bilinear = (texture->flags & GN_TEXTURE_BILINEAR) != 0;
    int clamp_u = gn_texture_clamps(texture, 0), clamp_v = gn_texture_clamps(texture, 1);
    gn_texture_taps u = find_taps(to_q26(u_q20, clamp_u), texture->width_log2, clamp_u, out->bilinear);
    gn_texture_taps v = find_taps(to_q26(v_q20, clamp_v), texture->height_log2, clamp_v, out->bilinear);
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

/* Colours of the texels that a reader is at. */
GN_HOT static GN_NOINLINE void decode(gn_texture_reader *r, const gn_texture_taps *u, const gn_texture_taps *v)
{
    const uint8_t *upper = r->texture->rgba + 4 * ((size_t)v->first << r->texture->width_log2),
                  *lower = r->texture->rgba + 4 * ((size_t)v->second << r->texture->width_log2);
    const uint8_t *const t[4] = {upper + 4 * u->first, upper + 4 * u->second, lower + 4 * u->first,
                                 lower + 4 * u->second};
    int differ = 0;
    for (int c = 0; r->bilinear && c < 3; c++)
        differ |= (t[0][c] ^ t[1][c]) | (t[0][c] ^ t[2][c]) | (t[0][c] ^ t[3][c]);
    r->uniform = !differ;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < (differ ? 4 : 1); i++) r->linear[c][i] = (uint16_t)gn_srgb_decode_entry(t[i][c]);
}

GN_HOT void gn_texture_read_begin(gn_texture_reader *reader, const gn_texture *texture)
{
    reader->texture = texture;
    reader->at = UINT32_MAX;
    reader->bilinear = (texture->flags & GN_TEXTURE_BILINEAR) != 0;
    reader->clamp[0] = gn_texture_clamps(texture, 0);
    reader->clamp[1] = gn_texture_clamps(texture, 1);
}

GN_HOT int gn_texture_move(gn_texture_reader *r, int32_t u_q26, int32_t v_q26)
{
    gn_texture_taps u = find_taps(u_q26, r->texture->width_log2, r->clamp[0], r->bilinear);
    gn_texture_taps v = find_taps(v_q26, r->texture->height_log2, r->clamp[1], r->bilinear);
    uint32_t at =
        v.first << 12 | u.first | (uint32_t)(u.second == u.first) << 24 | (uint32_t)(v.second == v.first) << 25;
    r->weight_uq16[0] = u.weight_uq16;
    r->weight_uq16[1] = v.weight_uq16;
    if (at == r->at) return r->uniform;
    r->at = at;
    decode(r, &u, &v);
    return 0;
}

/* A colour in linear light. [M3] */
GN_HOT void gn_texture_read(const gn_texture_reader *r, uint32_t rgb_uq16[3])
{
    uint32_t right_uq16 = r->weight_uq16[0];
    for (int c = 0; c < 3; c++) {
        const uint16_t *v = r->linear[c];
        uint32_t value = v[0];
        if (!r->uniform)
            value = gn_texture_mix(gn_texture_mix(v[0], v[1], right_uq16), gn_texture_mix(v[2], v[3], right_uq16),
                                   r->weight_uq16[1]);
        rgb_uq16[c] = gn_texture_to_uq16(value);
    }
}

GN_HOT void gn_texture_colour(const gn_texture *texture, int32_t u_q20, int32_t v_q20, uint32_t rgb_uq16[3])
{
    gn_texture_reader reader;
    gn_texture_read_begin(&reader, texture);
    gn_texture_move(&reader, to_q26(u_q20, reader.clamp[0]), to_q26(v_q20, reader.clamp[1]));
    gn_texture_read(&reader, rgb_uq16);
}
