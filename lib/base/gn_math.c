/* Number core. Every step states the range that keeps it from overflowing. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"

GN_HOT int64_t gn_far_dot64(const int32_t a[3], const int32_t b[3])
{
    return gn_dot64_inline(a, b);
}

GN_HOT int64_t gn_far_dot_q30(const int32_t a[3], const int32_t b[3])
{
    return gn_dot_q30_inline(a, b);
}

GN_HOT GN_NOINLINE uint64_t gn_bf_from_u64_bits(uint64_t v)
{
    int32_t clz = gn_clz64(v);
    gn_bfloat out = {(uint32_t)((v << clz) >> 32), 32 - clz};
    return gn_bf_bits(out);
}

/* Entry i of gn_recip_table is 2^25 / (2i + 513), rounded. With GN_SIZE_FIRST, on a core that divides, it is computed.
 */
GN_INLINE uint32_t recip_start(uint32_t i)
{
    return GN_SIZE_FIRST && GN_CORE_DIVIDES ? ((1U << 25) + i + 256U) / (2U * i + 513U) : gn_recip_table[i];
}

GN_HOT uint32_t gn_recip_norm(uint32_t m, int32_t newton_steps)
{
    uint32_t y = gn_recip_step(m, recip_start((m >> 23) & 255U) << 16);
    return newton_steps > 1 ? gn_recip_step(m, y) : y;
}

GN_HOT uint32_t gn_quotient_q30(uint32_t num, uint32_t den)
{
    int32_t clz = gn_clz32(den);
    return (uint32_t)((uint64_t)num * gn_recip_norm(den << clz, 1) >>
                      (33 - clz)); /* num <= den: at most 2^30, and 2^13 */
}

GN_HOT uint32_t gn_rsqrt_norm(uint32_t m, int32_t newton_steps)
{
    /* x = m / 2^32 in [1/4, 1); y ~ 1/sqrt(x) in Q1.31; y(3 - xy^2)/2 */
    uint32_t y = (uint32_t)gn_rsqrt_table[(m >> 24) - 64U] << 16;
    for (int32_t i = 0; i < newton_steps; i++) {
        uint32_t yy = gn_umul_high(y, y);                 /* Q2.30, <= 4 (table entries are < 2 in Q1.15) */
        uint32_t less = (3U << 30) - gn_umul_high(m, yy); /* Q2.30, near 2 */
        uint64_t better = (uint64_t)y * less;
        y = better >> 63 ? UINT32_MAX : (uint32_t)(better >> 31);
        GN_KEEP(y); /* 32 bits */
    }
    return y;
}

GN_HOT GN_NOINLINE uint64_t gn_bf_recip_bits(uint64_t bits)
{
    gn_bfloat a = gn_bf_of_bits(bits);
    gn_bfloat out = {gn_recip_norm(a.mant, 2), -a.exp - 63};
    return gn_bf_bits(out);
}

GN_HOT uint64_t gn_bf_mul_bits(uint64_t a_bits, uint64_t b_bits)
{
    gn_bfloat a = gn_bf_of_bits(a_bits), b = gn_bf_of_bits(b_bits);
    gn_bfloat out = gn_bf_from_u64((uint64_t)a.mant * b.mant);
    out.exp += a.exp + b.exp;
    return gn_bf_bits(out);
}

GN_HOT int64_t gn_bf_apply_bits(int64_t a, uint64_t b_bits)
{
    gn_bfloat b = gn_bf_of_bits(b_bits);
    if (a == 0) return 0;
    uint64_t ua = gn_abs64(a);
    int32_t s = b.exp;
    uint64_t r;
    if (ua >> 32) {
        /* the 96-bit product without its low 32 bits: (hi * 2^32 + lo) * mant / 2^32 */
        uint64_t lo = (ua & UINT32_MAX) * b.mant;
        r = (ua >> 32) * b.mant + ((lo + 0x80000000U) >> 32);
        s += 32;
    } else {
        r = ua * b.mant;
    }
    if (s >= 0) {
        r = s > 62 || (r && gn_clz64(r) <= s) ? UINT64_MAX : r << s;
    } else {
        /* truncate, then round by the last dropped bit: no addition that could overflow; half of r, or less: r is at
         * most 2^64 - 2^33 + 1 */
        r = s < -64 ? 0 : s == -64 ? r >> 63 : (r >> -s) + ((r >> (-s - 1)) & 1U);
    }
    if (r >> 61) r = GN_SATURATED;
    return a < 0 ? -(int64_t)r : (int64_t)r;
}

GN_HOT uint64_t gn_udiv64_rest(uint64_t a, uint64_t b, uint64_t *rest)
{
    uint64_t quotient = 0;
    int32_t bit = a ? gn_clz64(b) - gn_clz64(a) : -1;
    for (b = bit > 0 ? b << bit : b; bit >= 0; bit--, b >>= 1) {
        quotient <<= 1;
        if (a >= b) {
            a -= b;
            quotient |= 1U;
        }
    }
    *rest = a;
    return quotient;
}

GN_HOT uint64_t gn_udiv64(uint64_t a, uint64_t b)
{
    return gn_udiv64_rest(a, b, &a);
}

GN_HOT uint32_t gn_isqrt64(uint64_t v)
{
    uint64_t root = 0;
    for (uint64_t bit = (uint64_t)1 << 62; bit; bit >>= 2) {
        if (v >= root + bit) {
            v -= root + bit;
            root = (root >> 1) + bit;
        } else {
            root >>= 1;
        }
    }
    return (uint32_t)root;
}

/* The upper 32 bits of a * 2^s, 0 <= s < 64; what is above them is the sign's. */
GN_HOT static inline int32_t upper32(int64_t a, int32_t s)
{
    uint32_t hi = (uint32_t)((uint64_t)a >> 32), lo = (uint32_t)a;
    return (int32_t)(s < 32 ? hi << s | (lo >> 1) >> (31 - s) : lo << (s - 32));
}

/* Half of it, rounded */
GN_HOT static inline int32_t halved(int32_t v)
{
    return (v >> 1) + (v & 1);
}

GN_HOT int32_t gn_norm_vec(int32_t out[3], const int64_t a[3])
{
    uint64_t any = gn_abs64(a[0]) | gn_abs64(a[1]) | gn_abs64(a[2]);
    int32_t clz = any ? gn_clz64(any) : 34, s = clz - 1; /* one bit more than the result, for rounding */
    if (s < 0 || (any << clz) >> 33 == 0x7FFFFFFFU) {    /* one may be rounded up to 2^30 */
        for (int i = 0; i < 3; i++) {
            int32_t v = halved(s < 0 ? (int32_t)(a[i] >> 33) : upper32(a[i], s));
            out[i] = v == 1 << 30 ? v - 1 : v == -(1 << 30) ? v + 1 : v;
        }
    } else {
        out[0] = halved(upper32(a[0], s));
        out[1] = halved(upper32(a[1], s));
        out[2] = halved(upper32(a[2], s));
    }
    return 34 - clz; /* bits above 30 */
}

GN_HOT int gn_det_sign(const int32_t m[3][3])
{
    int32_t row[3][3], n[3];
    int64_t wide[3];
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) wide[c] = m[r][c];
        gn_norm_vec(row[r], wide);
    }
    gn_cross64(wide, row[1], row[2]);
    gn_norm_vec(n, wide);
    int64_t det =
        gn_dot64(row[0], n); /* rows and n have a component of at least 2^29, so the angle's sine is det / 2^60 */
    return det > (int64_t)1 << 32 ? 1 : det < -((int64_t)1 << 32) ? -1 : 0;
}

GN_HOT int gn_normalise_q30(int32_t out_q30[3], const int64_t a[3])
{
    int32_t n[3];
    gn_norm_vec(n, a);
    /* squares sum below 3 * 2^60; the largest component is at least 2^29 */
    uint64_t sum = (uint64_t)gn_dot64(n, n);
    if (!sum) return 0;
    int32_t s = gn_clz64(sum) & ~1; /* even shift to [2^62, 2^64) */
    uint32_t r =
        gn_rsqrt_norm((uint32_t)((sum << s) >> 32), 2); /* 2^47 / sqrt(sum << s >> 32) = 2^63 / sqrt(sum << s) */
    /* n / sqrt(sum) = n * r * 2^(s/2 - 63), s = 2 or 4; the factor r, from 2^31 on, as r - 2^32 and once more */
    int32_t below = (int32_t)(r - 0x80000000U - 0x80000000U);
    GN_KEEP(below); /* signed: one multiplication */
    for (int i = 0; i < 3; i++) {
        int32_t twice = s == 4 ? 2 * n[i] : n[i];
        int64_t p = (int64_t)twice * below;
        int32_t v = (int32_t)(p >> 32) + twice + (int32_t)((uint32_t)p >> 31);
        out_q30[i] = gn_max32(-(1 << 30), gn_min32(v, 1 << 30));
    }
    return 1;
}

GN_HOT void gn_normalise_15(int32_t v[3])
{
    gn_to_bits(v, 3, 15);
    const uint32_t n2 = (uint32_t)(v[0] * v[0]) + (uint32_t)(v[1] * v[1]) + (uint32_t)(v[2] * v[2]); /* 3 * 2^30 */
    const int32_t up = gn_clz32(n2 | 1U) & ~1, more = up / 2;
    const int32_t root = (int32_t)(gn_rsqrt_norm((n2 | 1U) << up, 1) >> 1); /* 2^(46 - more) / length */
    GN_UNROLL
    for (int i = 0; i < 3; i++) v[i] = 4 * gn_mul_high(v[i] * (1 << (14 + more)), root); /* length 2^more < 2^16 */
}

GN_HOT GN_NOINLINE void gn_cross64(int64_t out[3], const int32_t a[3], const int32_t b[3])
{
    out[0] = (int64_t)a[1] * b[2] - (int64_t)a[2] * b[1];
    out[1] = (int64_t)a[2] * b[0] - (int64_t)a[0] * b[2];
    out[2] = (int64_t)a[0] * b[1] - (int64_t)a[1] * b[0];
}

GN_HOT void gn_cross_q30(int32_t out_q30[3], const int32_t a_q30[3], const int32_t b_q30[3])
{
    int64_t c[3];
    gn_cross64(c, a_q30, b_q30);
    for (int i = 0; i < 3; i++) out_q30[i] = (int32_t)gn_shr64(c[i], 30);
}

GN_HOT int32_t gn_sin_q30(uint16_t angle_turn)
{
    /* fold to the first quarter, then sin(A + b) with A on a grid of 1/256 turn and |b| <= 1/512 turn = 0.0123 rad */
    uint32_t a = angle_turn & 0x7FFFU;
    if (a > 0x4000U) a = 0x8000U - a;
    uint32_t i = (a + 128U) >> 8;
    int32_t b_turn = (int32_t)a - (int32_t)(i << 8);
    int32_t b = (int32_t)gn_shr64((int64_t)b_turn * 105414358, 10); /* radians, Q30: 2 pi * 2^40 / 2^16 = 105414357.9 */
    int32_t b2 = gn_mul_q30(b, b);
    int32_t sin_b = b - gn_mul_q30(gn_mul_q30(b2, b), 178956971);                                    /* 2^30 / 6 */
    int32_t cos_b = (1 << 30) - (int32_t)gn_shr64(b2, 1) + gn_mul_q30(gn_mul_q30(b2, b2), 44739243); /* 2^30 / 24 */
    int64_t s = (int64_t)gn_sin_table_q30[i] * cos_b + (int64_t)gn_sin_table_q30[64U - i] * sin_b;
    int32_t v = gn_min32((int32_t)gn_shr64(s, 30), 1 << 30);
    return angle_turn & 0x8000U ? -v : v;
}

GN_HOT int32_t gn_cos_q30(uint16_t angle_turn)
{
    return gn_sin_q30((uint16_t)(angle_turn + 0x4000U));
}

GN_HOT uint32_t gn_focal_from_fov_q24(uint16_t vertical_fov_turn)
{
    /* 1 / tan(a / 2) = (1 + cos a) / sin a needs no half angle */
    int32_t s = gn_sin_q30(vertical_fov_turn);
    if (s <= 0) return vertical_fov_turn ? 0 : UINT32_MAX;
    int64_t numerator = ((int64_t)(1 << 30) + gn_cos_q30(vertical_fov_turn)) << 24;
    uint64_t q = gn_udiv64((uint64_t)numerator + (uint32_t)s / 2, (uint32_t)s);
    return q > UINT32_MAX ? UINT32_MAX : (uint32_t)q;
}

GN_HOT int32_t gn_step_of(int32_t a, int32_t b, int32_t n)
{
    static const uint32_t inverse[17] = {0,           0xFFFFFFFFU, 0x80000000U, 0x55555555U, 0x40000000U, 0x33333333U,
                                         0x2AAAAAAAU, 0x24924924U, 0x20000000U, 0x1C71C71CU, 0x19999999U, 0x1745D174U,
                                         0x15555555U, 0x13B13B13U, 0x12492492U, 0x11111111U, 0x10000000U};
    uint32_t d = b < a ? (uint32_t)a - (uint32_t)b : (uint32_t)b - (uint32_t)a;
    int32_t size = (int32_t)gn_umul_high(d, inverse[n]);
    return b < a ? -size : size;
}

GN_HOT uint64_t gn_length_bits(int32_t newton_steps, const int32_t n_q30[3])
{
    uint64_t nn = (uint64_t)gn_dot64(n_q30, n_q30); /* Q60, at most 1 + rounding */
    uint32_t shift = nn ? (uint32_t)gn_clz64(nn) & ~1U : 0;
    uint32_t root = nn ? gn_rsqrt_norm((uint32_t)((nn << shift) >> 32), newton_steps) : 0;
    return (uint64_t)shift << 32 | root;
}

GN_HOT void gn_length_unit(gn_length length, const int32_t n_q30[3], int32_t out_q30[3])
{
    for (int i = 0; i < 3; i++) {
        int64_t v = gn_scale64((int64_t)n_q30[i] * (int64_t)length.root, 63 - 30 - length.shift / 2);
        out_q30[i] = (int32_t)gn_clamp64(v, -(1 << 30), 1 << 30);
    }
}

/* ---- Functions in place of inline code --------------------------------------------------------------------------- */

/* gn_scale64; with GN_SIZE_FIRST or without long products the others, see gn_q.h. The linker drops unused ones. */

GN_HOT GN_NOINLINE int64_t gn_far_clamp64(int64_t v, int64_t lo, int64_t hi)
{
    return gn_clamp64_inline(v, lo, hi);
}

GN_HOT GN_NOINLINE int32_t gn_far_clamp32(int64_t v, int32_t lo, int32_t hi)
{
    return (int32_t)gn_clamp64_inline(v, lo, hi);
}

GN_HOT GN_NOINLINE int32_t gn_far_sat32(int64_t v)
{
    return v == (int32_t)v ? (int32_t)v : v < 0 ? INT32_MIN : INT32_MAX;
}

GN_HOT GN_NOINLINE int64_t gn_far_shr64(int64_t v, int32_t s)
{
    return gn_shr64_inline(v, s);
}

GN_HOT GN_NOINLINE int64_t gn_far_shr30(int64_t v)
{
    return gn_shr64_inline(v, 30);
}

GN_HOT GN_NOINLINE int64_t gn_scale64(int64_t v, int32_t s)
{
    if (s > 63) return 0;
    if (s > 0) return (v >> s) + ((v >> (s - 1)) & 1); /* no addition that could overflow */
    if (s == 0) return v;
    if (v == 0) return 0;
    if (gn_clz64(gn_abs64_inline(v)) - 3 < -s) return v < 0 ? -GN_SATURATED : GN_SATURATED;
    return gn_shl64(v, -s);
}

GN_HOT GN_NOINLINE int32_t gn_far_mul_shr(int32_t a, int32_t b, int32_t s)
{
    return gn_mul_shr_inline(a, b, s);
}

GN_HOT GN_NOINLINE int32_t gn_far_mul_q30(int32_t a, int32_t b)
{
    return gn_mul_q30_inline(a, b);
}

GN_HOT GN_NOINLINE uint64_t gn_far_abs64(int64_t v)
{
    return gn_abs64_inline(v);
}

GN_HOT GN_NOINLINE uint64_t gn_far_signature_add(uint64_t signature, uint64_t word)
{
    return gn_signature_add_inline(signature, word);
}

/* For many bytes: the lower half x of the state, with a word, becomes x (2^32 + k) plus the upper half, modulo 2^64.
 * Two x that differ by d differ in the upper half by d (1 + k / 2^32), rounded, which the next word cannot take back: 1
 * to 2^32 - 1 for all |d| up to 2^31, 0 for no more than two d above. */
GN_HOT uint64_t gn_signature_bytes(uint64_t signature, const void *bytes, size_t n)
{
    const uint8_t *at = (const uint8_t *)bytes;
    uint32_t word;
    for (; n >= sizeof word; n -= sizeof word, at += sizeof word) {
        GN_COPY_WORDS(&word, at, sizeof word);
        word ^= (uint32_t)signature;
        signature = (uint64_t)word * 0xFF51AFD7U + (signature >> 32) + ((uint64_t)word << 32);
    }
    for (word = 0; n; n--) word = word << 8 | *at++;
    return gn_signature_add_inline(signature, word);
}

/* By halves: what is above the lower product's upper half carries. */
GN_HOT GN_NOINLINE int32_t gn_far_mul_high(int32_t a, int32_t b)
{
    const int32_t a_low = a & 0xFFFF, b_low = b & 0xFFFF, a_high = a >> 16, b_high = b >> 16;
    const int32_t one = a_high * b_low + (int32_t)((uint32_t)a_low * (uint32_t)b_low >> 16),
                  other = (one & 0xFFFF) + a_low * b_high;
    return a_high * b_high + (one >> 16) + (other >> 16);
}

GN_HOT GN_NOINLINE uint32_t gn_far_umul_high(uint32_t a, uint32_t b)
{
    const uint32_t a_low = a & 0xFFFFU, b_low = b & 0xFFFFU, a_high = a >> 16, b_high = b >> 16;
    const uint32_t one = a_high * b_low + (a_low * b_low >> 16), other = (one & 0xFFFFU) + a_low * b_high;
    return a_high * b_high + (one >> 16) + (other >> 16);
}
