/* The tables of gn_tables.c as polynomials, for GN_SIZE_FIRST: the same values, entry by entry (a test compares each
 * with its table). Coefficients are a least-squares fit of the curve at the table's entries, weighted to minimise the
 * largest error, and adjusted in their last bits until every entry rounds to the table's value. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "base/gn_tables.h"

/* c[0] + c[1] x + ... + c[n] x^n, rounded down at every step; |x| <= 1 in Q30, and |sums| < 2^31. */
GN_HOT static int32_t polynomial(const int32_t *c, int32_t n, int32_t x_q30)
{
    int32_t v = c[n];
    while (n-- > 0) v = c[n] + (int32_t)(((int64_t)v * x_q30) >> 30);
    return v;
}

GN_HOT uint32_t gn_far_recip_entry(uint32_t i)
{
    /* 1 / 2x, Q30 */
    static const int32_t c[10] = {714896980, -237989530, 79224729, -26371872, 8792698,
                                  -2932873,  939692,     -304578,  143127,    -51760};
    return (uint32_t)(polynomial(c, 9, ((int32_t)i - 128) * (1 << 23)) + (1 << 13)) >> 14;
}

GN_HOT uint32_t gn_far_rsqrt_entry(uint32_t i)
{
    /* 1 / 2 sqrt(x), Q30 */
    static const int32_t c[12] = {678035878, -270366371, 161764520, -107673755, 74082433, -51468802,
                                  45948855,  -41149281,  1286127,   12044016,   38854416, -38223736};
    return (uint32_t)(polynomial(c, 11, ((int32_t)i - 96) * (1 << 23)) + (1 << 13)) >> 14;
}

GN_HOT uint32_t gn_far_srgb_entry(uint32_t i)
{
    /* (1 + j/64)^(1/2.4), Q30; 65535 * 1.055 * 2^((k - 9)/2.4), Q15 */
    static const int32_t root[8] = {1073741852, 447388474, -130398815, 68064408,
                                    -40847001,  22387561,  -8709680,   1646608};
    static const uint32_t octave[10] = {168388805, 224772088, 300034741,  400498330,  534601132,
                                        713606897, 952550927, 1271502940, 1697252799, 2265560678};
    if (i < 39) return ((64 + i) * 1693424U + 0x8000U) >> 16; /* 12.92 * 65535 / 2^15 */
    int64_t v_q29 = (int64_t)polynomial(root, 7, (int32_t)(i & 63U) << 24) * octave[i >> 6] >> 16; /* 2^31 * 2^31 */
    return (uint32_t)((v_q29 - 1935110936986 + (1 << 28)) >> 29);                                  /* 65535 * 0.055 */
}

GN_HOT uint32_t gn_far_srgb_decode_entry(uint32_t i)
{
    /* ((v + 0.055) / 1.055)^2.4, Q29 */
    static const int32_t c[10] = {115889053, 250668534, 158145895, 18998604, -2610766,
                                  771687,    -175232,   57710,     -185463,  112925};
    if (i < 11) return (i * 1303619U + 0x8000U) >> 16; /* 257 / 12.92 */
    return (uint32_t)(((int64_t)polynomial(c, 9, ((int32_t)i - 128) * (1 << 23)) * 65535 + (1 << 28)) >> 29);
}
