/* Half-size levels of textures: which one a view depth reads (MODEL 8). */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "geometry/gn_texel_formats.h"
#include "geometry/gn_texture.h"

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
