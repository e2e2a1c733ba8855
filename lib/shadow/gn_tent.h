/* Filters that weigh texels: tents (F3). Compares come first, weights are exact integers, and one division, done as a
 * multiplication, comes last. Inline, as each has one caller per pixel. */
#ifndef GN_TENT_H
#define GN_TENT_H

#include "base/gn_count.h"
#include "base/gn_kernel.h"
#include "base/gn_tables.h"
#include "shadow/gn_lookup.h"

#define GN_TENT_TAPS_MAX 8

/* Weights of the 2 (k + 1) texels of a tent along one axis, k = 1, 2, 3: exact rationals over (2k + 1)^2 F^2, which
 * they sum to. u = F * frac(centre + 1/2), 0 <= u <= F, F = 2^bits <= 4096: everything stays below 2^30. */
void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t bits);

/* Rounded to `bits`; F itself is allowed: the weights are continuous there */
GN_HOT static inline uint32_t gn_filter_fraction(int32_t c_q16, int32_t bits)
{
    return (((uint32_t)c_q16 & 0xFFFFU) + (0x8000U >> bits)) >> (16 - bits);
}

/* Sums of the weights in all subsets of four: bit i for weight i. */
GN_HOT static inline void gn_subset_sums(uint32_t sums[16], const uint32_t w[4])
{
    uint32_t a = w[0], b = w[1], c = w[2], d = w[3], ab = a + b, cd = c + d;
    sums[0] = 0, sums[1] = a, sums[2] = b, sums[3] = ab;
    sums[4] = c, sums[5] = a + c, sums[6] = b + c, sums[7] = ab + c;
    sums[8] = d, sums[9] = a + d, sums[10] = b + d, sums[11] = ab + d;
    sums[12] = cd, sums[13] = a + cd, sums[14] = b + cd, sums[15] = ab + cd;
}

/* Sum of the products of weights of the dark texels of n x n, by subsets of the weights. */
GN_HOT static inline uint64_t gn_weighted(const uint8_t *dark, int32_t n, const uint32_t *wu, const uint32_t *wv)
{
    uint64_t sum = 0;
    uint32_t left[16], right[16];
    gn_subset_sums(left, wu);
    if (n > 4) gn_subset_sums(right, wu + 4);
    for (int32_t j = 0; j < n; j++) {
        uint32_t across = left[dark[j] & 15U];
        if (n > 4) across += right[dark[j] >> 4];
        sum += (uint64_t)across * wv[j];
    }
    return sum;
}

/* sum / (N * 2^scale_bits) in Q16, scale = round(2^32 / N): 20 fraction bits are kept, kept <= N * 2^20 < 2^32. */
GN_HOT static inline uint32_t gn_weighted_fraction(uint64_t sum, int32_t scale_bits, uint32_t scale)
{
    int32_t drop = scale_bits - 20;
    uint64_t kept = drop >= 0 ? sum >> drop : sum << -drop;
    return (uint32_t)((kept * scale + ((uint64_t)1 << 35)) >> 36);
}

/* Which of n x n texels from (u, v) on keep the receiver dark: bit i of dark[j] for texel i of row j. Returns the OR of
 * all rows, and in the upper half their AND. */
GN_HOT static inline uint32_t gn_tent_dark(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint8_t *dark)
{
    int32_t depth_bits = GN_VIEW_BITS(l->view);
    int is_plain = gn_lookup_is_plain(l, u, v, n);
    uint32_t any = 0, all = 255;
    if (is_plain && depth_bits == 16)
        return gn_kernel_dark_texels16(gn_view_texels(l->view, u, v).d16, l->view->tile_texels, l->least, n, dark);
    for (int32_t j = 0; j < n; j++) {
        uint32_t row_dark = 0;
        if (is_plain) {
            gn_texels row = gn_view_texels(l->view, u, v + j);
            for (int32_t i = 0; i < n; i++)
                row_dark |= (uint32_t)(gn_texel_load(row, depth_bits, (uint32_t)i) < l->least) << i;
        } else row_dark = gn_lookup_dark(l, u, v + j, n);
        dark[j] = (uint8_t)row_dark;
        any |= row_dark;
        all &= row_dark;
    }
    return any | all << 16;
}

/* Attenuation of a lookup with both dark and lit texels, a byte of `dark` per row, by the tent of index k.
 * cu, cv: the receiver, half a texel down and right, Q16, of which the fraction counts. */
GN_HOT static inline uint32_t gn_tent_of_dark(const uint8_t *dark, int32_t k, int32_t cu, int32_t cv, int32_t bits)
{
    uint32_t wu[GN_TENT_TAPS_MAX], wv[GN_TENT_TAPS_MAX];
    uint32_t u = gn_filter_fraction(cu, bits), v = gn_filter_fraction(cv, bits);
    gn_tent_weights(wu, k, u, bits);
    gn_tent_weights(wv, k, v, bits);
    /* along a row <= 49 F^2 < 2^30, all <= (2k + 1)^4 F^4 <= 2401 * 2^48 */
    uint32_t whole = k == 1 ? 81 : k == 2 ? 625 : 2401;
    uint64_t sum = ((uint64_t)whole << 4 * bits) - gn_weighted(dark, 2 * (k + 1), wu, wv);
    return gn_weighted_fraction(sum, 4 * bits,
                                k == 1   ? 53024288U
                                : k == 2 ? 6871948U
                                         : 1788824U); /* round(2^32 / whole) */
}

/* Attenuation by the 3x3 filter of four rows of four texels, a bit each that is dark, to 1/32 texel: u, v in Q16, half
 * a texel down and right, and rounded: 1024 more. */
GN_HOT static inline uint32_t gn_tent_of_4x4(uint32_t a, uint32_t b, uint32_t c, uint32_t d, int32_t u, int32_t v)
{
    const uint16_t *across = gn_tent_sums[u >> 11 & 31], *down = gn_tent_sums[v >> 11 & 31];
    const uint32_t sum = across[a] * (uint32_t)down[1] + across[b] * (uint32_t)down[2] + across[c] * (uint32_t)down[4];
    return 65536 - ((sum + across[d] * (uint32_t)down[8]) >> 8); /* 2^12 * 2^12 */
}

/* Attenuation by 2x2 texels, a bit each that is dark; u, v as gn_tent_of_dark() has them. */
GN_HOT static inline uint32_t gn_tent_of_2x2(uint32_t upper, uint32_t lower, int32_t u, int32_t v, int32_t bits)
{
    const uint32_t wu = gn_filter_fraction(u, bits), wv = gn_filter_fraction(v, bits), one = 1U << bits;
    const uint32_t above = (upper & 1U ? one - wu : 0) + (upper & 2U ? wu : 0),
                   below = (lower & 1U ? one - wu : 0) + (lower & 2U ? wu : 0),
                   lit = (one << bits) - (one - wv) * above - wv * below; /* <= F^2 <= 2^24 */
    return bits <= 8 ? lit << (16 - 2 * bits) : (lit + ((1U << (2 * bits - 16)) >> 1)) >> (2 * bits - 16);
}

/* gn_tent_dark() on the receiver's plane. Returns 0 if gn_lookup_on_plane() does not tell. */
GN_HOT static inline int gn_tent_on_plane(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint8_t *dark,
                                          uint32_t *found)
{
#if GN_PLANES && !GN_SIZE_FIRST
    if (l->sloped) return gn_lookup_on_plane(l, u, v, n, dark, found);
#endif
    (void)l, (void)u, (void)v, (void)n, (void)dark, (void)found;
    return 0;
}

/* Attenuation by the tent of index k. [F3] */
GN_HOT static inline uint32_t gn_tent_attenuation(const gn_lookup *l, int32_t k, int32_t bits)
{
    int32_t cu = l->u_q16 + 32768, cv = l->v_q16 + 32768, n = 2 * (k + 1);
    int32_t u0 = (cu >> 16) - (k + 1), v0 = (cv >> 16) - (k + 1);
    uint8_t dark[GN_TENT_TAPS_MAX];
    uint32_t found;
    if (!gn_tent_on_plane(l, u0, v0, n, dark, &found)) {
        GN_COUNT(undecided, 1);
        GN_COUNT(taps_tent, n * n);
        found = gn_tent_dark(l, u0, v0, n, dark);
    }
    if (!(found & 0xFFFFU)) return 65536;
    if (found >> 16 == (1U << n) - 1) return 0;
    return gn_tent_of_dark(dark, k, cu, cv, bits);
}

#endif
