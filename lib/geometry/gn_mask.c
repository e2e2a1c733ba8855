/* Mask images. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"

/* The same as find_taps in gn_texture.c for a clamped, bilinear image. It runs once per pixel and light, so it has no
 * branch. */
GN_HOT static gn_texture_taps mask_taps(int32_t c_q16, uint32_t size)
{
    int32_t last = (int32_t)size - 1, at_q16 = gn_max32(0, gn_min32(c_q16, 65536)) * (int32_t)size - 32768;
    int32_t first = at_q16 >> 16; /* -1 .. last */
    return (gn_texture_taps){(uint32_t)gn_max32(first, 0), (uint32_t)gn_min32(first + 1, last),
                             (uint32_t)at_q16 & 0xFFFFU};
}

/* Four equal texels, as in wholly lit or dark areas, need no interpolation. [M5] */
GN_HOT uint32_t gn_texture_mask(const gn_texture *image, int32_t u_q16, int32_t v_q16, uint32_t channel)
{
    const uint32_t bytes_log2 = image->flags & GN_TEXTURE_MASK_1 ? 0 : image->flags & GN_TEXTURE_MASK_2 ? 1 : 2;
    const uint32_t width = gn_texture_size(image, 0);
    GN_COUNT(masked, 1);
    if (channel >> bytes_log2) return 65536;
    const gn_texture_taps u = mask_taps(u_q16, width), v = mask_taps(v_q16, gn_texture_size(image, 1));
    const uint8_t *upper = image->rgba + channel + ((size_t)v.first * width << bytes_log2);
    const uint8_t *lower = image->rgba + channel + ((size_t)v.second * width << bytes_log2);
    const uint32_t left = u.first << bytes_log2, right = u.second << bytes_log2;
    const uint32_t a = upper[left] * 257U, b = upper[right] * 257U, c = lower[left] * 257U, d = lower[right] * 257U;
    if (!((a ^ b) | (a ^ c) | (a ^ d))) return gn_texture_to_uq16(a);
    return gn_texture_to_uq16(
        gn_texture_mix(gn_texture_mix(a, b, u.weight_uq16), gn_texture_mix(c, d, u.weight_uq16), v.weight_uq16));
}

#if GN_INTERPOLATES
GN_HOT int gn_texture_mask_is_even(const gn_texture *image, const int32_t least_q16[2], const int32_t most_q16[2])
{
    const uint32_t bytes_log2 = image->flags & GN_TEXTURE_MASK_1 ? 0 : image->flags & GN_TEXTURE_MASK_2 ? 1 : 2;
    const uint32_t width = gn_texture_size(image, 0), height = gn_texture_size(image, 1);
    uint32_t x0 = mask_taps(least_q16[0], width).first, x1 = mask_taps(most_q16[0], width).second,
             y0 = mask_taps(least_q16[1], height).first, y1 = mask_taps(most_q16[1], height).second;
    const uint8_t *first = image->rgba + (((size_t)y0 * width + x0) << bytes_log2);
    if ((x1 - x0 + 1) * (y1 - y0 + 1) > 64) return 0;
    for (uint32_t y = y0; y <= y1; y++) {
        const uint8_t *row = image->rgba + ((size_t)y * width << bytes_log2);
        for (uint32_t i = x0 << bytes_log2; i < (x1 + 1) << bytes_log2; i++)
            if (row[i] != first[i & ((1U << bytes_log2) - 1)]) return 0;
    }
    return 1;
}
#endif
