/* Filters that weigh texels: tents, and the linear kernels of the same width. */
#ifndef GN_TENT_H
#define GN_TENT_H

#include "shadow/gn_lookup.h"

#define GN_TENT_TAPS_MAX 8

/* Weights of the 2 (k + 1) texels of a tent along one axis, k = 1, 2, 3: exact rationals over (2k + 1)^2 F^2, which
 * they sum to. u = F * frac(centre + 1/2), 0 <= u <= F, F = 2^weight_bits <= 4096: everything stays below 2^30. */
void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits);

/* The same for the linear kernels: over 4 F, 12 F, 52 F. */
void gn_linear_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits);

/* Attenuation by the kernel of index k that the scene asks for: tent or linear. */
uint32_t gn_tent_attenuation(const gn_frame *frame, const gn_lookup *l, int32_t k, int32_t weight_bits);

/* ---- What rows of receivers share with single ones --------------------------------------------------------------- */

/* round to weight_bits; F itself is allowed: the weights are continuous there */
GN_HOT static inline uint32_t gn_filter_fraction(int32_t c_q16, int32_t weight_bits)
{
    return (((uint32_t)c_q16 & 0xFFFFU) + (0x8000U >> weight_bits)) >> (16 - weight_bits);
}

GN_HOT static inline void gn_tent_weights_inline(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits)
{
    uint32_t f = 1U << weight_bits, ff = f * f, uf4 = 4 * u * f, h = 2 * u;
    uint32_t m = h < f ? f - h : 0, p = h > f ? h - f : 0; /* |2u - F| left and right of the texel's centre */
    int32_t n = 2 * (k + 1);
    w[0] = 2 * (f - u) * (f - u);
    w[n - 1] = 2 * u * u;
    for (int32_t i = 1; i <= k; i++) {
        /* rising towards the peak 4i + 2, falling after it; the peak's corner is cut off the middle ones */
        w[i] = (uint32_t)(4 * i + 2) * ff - uf4 - (i == k ? m * m : 0);
        w[n - 1 - i] = (uint32_t)(4 * i - 2) * ff + uf4 - (i == k ? p * p : 0);
    }
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

/* Sum of the products of weights of the dark texels of n x n. narrow: they stay below 2^32 together. */
GN_HOT static inline uint64_t gn_weighted(const uint8_t *dark, int32_t n, const uint32_t *wu, const uint32_t *wv,
                                          int narrow)
{
    uint64_t sum = 0;
    uint32_t left[16], right[16];
    gn_subset_sums(left, wu);
    if (n > 4) gn_subset_sums(right, wu + 4);
    for (int32_t j = 0; j < n; j++) {
        uint32_t across = left[dark[j] & 15U];
        if (n > 4) across += right[dark[j] >> 4];
        if (narrow) sum += across * wv[j];
        else sum += (uint64_t)across * wv[j];
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

#endif
