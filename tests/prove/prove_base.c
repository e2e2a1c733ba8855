/* Harnesses for Frama-C's value analysis (make prove): each calls functions of the library with all the operands that
 * their contracts allow. No alarm means that nothing is undefined for any of them: no overflow, no shift by too much,
 * no access out of bounds, no division by zero. An assertion that holds is a bound proved.
 *
 * any_i32(lo, hi) and its like stand for every value of a range at once. A result goes into `sink` or `usink`, which
 * are volatile, so that it is not left out. Where bounds get lost over a wide range, a loop cuts the range into pieces.
 */
#include "prove.h"

#include "base/gn_math.c"
#include "base/gn_q.h"
#include "base/gn_tables.c"
#include "shadow/gn_filter.c"

/* ---- lib/base/gn_q.h -----------------------------------------------------------------------------------------------
 */

/* gn_clz32, gn_clz64: every number but 0 */
void prove_clz(void)
{
    for (int k = 0; k < 32; k++) {
        int32_t n = gn_clz32(any_u32(1U << k, (1U << k) + ((1U << k) - 1)));
        //@ assert n == 31 - k;
        n = gn_clz64(any_u64((uint64_t)1 << k, ((uint64_t)1 << k) + (((uint64_t)1 << k) - 1)));
        //@ assert n == 63 - k;
        n = gn_clz64(any_u64((uint64_t)1 << (k + 32), ((uint64_t)1 << (k + 32)) + (((uint64_t)1 << (k + 32)) - 1)));
        //@ assert n == 31 - k;
    }
}

/* gn_min32, gn_max32, gn_abs32, gn_abs64_inline, gn_clamp64_inline, gn_sat32_inline */
void prove_saturation(void)
{
    int32_t a = any_i32(INT32_MIN, INT32_MAX), b = any_i32(INT32_MIN, INT32_MAX);
    int64_t wide = any_i64(INT64_MIN, INT64_MAX);
    sink = gn_min32(a, b) + (int64_t)gn_max32(a, b) + gn_abs32(a) + gn_sat32_inline(wide);
    usink = gn_abs64_inline(wide);
    int64_t v = gn_clamp64_inline(wide, -1000, 1000);
    //@ assert -1000 <= v <= 1000;
}

/* gn_shl64, gn_shr64_inline: all shifts */
void prove_shifts(void)
{
    for (int s = 0; s <= 62; s++) {
        int64_t limit = s ? INT64_MAX - ((int64_t)1 << (s - 1)) : INT64_MAX;
        int64_t v = gn_shr64_inline(any_i64(-limit, limit), s);
        //@ assert s == 0 || -(INT64_MAX >> s) - 1 <= v <= (INT64_MAX >> s) + 1;
        sink = gn_shl64(any_i64(-(INT64_MAX >> s), INT64_MAX >> s), s);
    }
}

/* gn_scale64: all numbers, all shifts */
void prove_scale(void)
{
    sink = gn_scale64(any_i64(INT64_MIN, -1), any_i32(-1000, 1000));
    sink = gn_scale64(0, any_i32(-1000, 1000));
    sink = gn_scale64(any_i64(1, INT64_MAX), any_i32(-1000, 1000));
    for (int s = 1; s <= 70; s++) {
        int64_t v = gn_scale64(any_i64(INT64_MIN, INT64_MAX), s);
        //@ assert s > 62 || -(INT64_MAX >> s) - 1 <= v <= (INT64_MAX >> s) + 1;
    }
}

/* gn_mul_shr_inline, gn_mul_q30_inline, gn_mul_high, gn_umul_high, gn_mul_uq16: any number times one of at most 2^30;
 * for gn_mul_q30_inline and gn_mul_uq16 both at most 1; for gn_mul_high and gn_umul_high any two */
void prove_products(void)
{
    for (int s = 1; s <= 62; s++)
        sink = gn_mul_shr_inline(any_i32(INT32_MIN, INT32_MAX), any_i32(-(1 << 30), 1 << 30), s);
    int32_t v = gn_mul_q30_inline(any_i32(-(1 << 30), 1 << 30), any_i32(-(1 << 30), 1 << 30));
    //@ assert -(1 << 30) <= v <= (1 << 30);
    sink = gn_mul_high(any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX));
    usink = gn_umul_high(any_u32(0, UINT32_MAX), any_u32(0, UINT32_MAX));
    uint32_t u = gn_mul_uq16(any_u32(0, 65536), any_u32(0, 65536));
    //@ assert u <= 65536;
}

/* ---- lib/base/gn_math.c --------------------------------------------------------------------------------------------
 */

/* gn_recip_norm, gn_recip_step, gn_recip_norm2_inline: every mantissa 2^31 .. 2^32 - 1, one table entry at a time */
void prove_recip(void)
{
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t first = 0x80000000U + (i << 23), m = any_u32(first, first + 0x7FFFFFU);
        usink = gn_recip_norm(m, 1);
        usink = gn_recip_norm(m, 2);
        usink = gn_recip_norm2_inline(m);
    }
}

/* gn_rsqrt_norm: every mantissa 2^30 .. 2^32 - 1, one table entry at a time; 1 and 2 Newton steps */
void prove_rsqrt(void)
{
    for (uint32_t i = 64; i < 256; i++)
        for (int steps = 1; steps <= 2; steps++) usink = gn_rsqrt_norm(any_u32(i << 24, (i << 24) + 0xFFFFFFU), steps);
}

/* gn_quotient_q30: every divisor but 0, octave by octave; every numerator up to the octave's end */
void prove_quotient(void)
{
    for (int k = 0; k < 32; k++) {
        uint32_t most = (1U << k) + ((1U << k) - 1);
        usink = gn_quotient_q30(any_u32(0, most), any_u32(1U << k, most));
    }
}

/* gn_bf_bits, gn_bf_of_bits, gn_bf_from_u64_bits, gn_bf_recip_bits, gn_bf_mul_bits: gn_bfloat's of every u64 but 0,
 * then every mantissa with exponents of -128 .. 127 */
void prove_bfloat(void)
{
    for (int k = 0; k < 64; k++) {
        uint64_t least = (uint64_t)1 << k;
        gn_bfloat a = gn_bf_from_u64(any_u64(least, least + (least - 1)));
        //@ assert a.mant >= 0x80000000;
        //@ assert a.exp == k - 31;
    }
    for (int e = -128; e < 128; e++) {
        const gn_bfloat a = {any_u32(0x80000000U, UINT32_MAX), e}, b = {any_u32(0x80000000U, UINT32_MAX), 127},
                        c = {any_u32(0x80000000U, UINT32_MAX), -128};
        usink = gn_bf_recip_bits(gn_bf_bits(a));
        usink = gn_bf_mul_bits(gn_bf_bits(a), gn_bf_bits(b));
        usink = gn_bf_mul_bits(gn_bf_bits(a), gn_bf_bits(c));
    }
}

/* gn_udiv64_rest, gn_udiv64, gn_isqrt64 */
void prove_long_division(void)
{
    usink = gn_udiv64(0, any_u64(1, UINT64_MAX));
    usink = gn_udiv64(any_u64(1, UINT64_MAX), any_u64(1, UINT64_MAX));
    usink = gn_isqrt64(any_u64(0, UINT64_MAX));
}

static void any_vector(int32_t v[3], int32_t lo, int32_t hi)
{
    for (int i = 0; i < 3; i++) v[i] = any_i32(lo, hi);
}

/* gn_norm_vec: any vector */
void prove_norm_vec(void)
{
    int64_t a[3];
    int32_t out[3];
    for (int i = 0; i < 3; i++) a[i] = any_i64(INT64_MIN, INT64_MAX);
    if (a[0] > 0) sink = gn_norm_vec(out, a);
    else if (a[0] < 0) sink = gn_norm_vec(out, a);
    else if (a[1] > 0) sink = gn_norm_vec(out, a);
    else if (a[1] < 0) sink = gn_norm_vec(out, a);
    else if (a[2] > 0) sink = gn_norm_vec(out, a);
    else sink = gn_norm_vec(out, a);
    //@ assert \forall integer i; 0 <= i < 3 ==> -(1 << 30) <= out[i] <= (1 << 30);
}

/* gn_cross64, gn_dot64_inline, gn_dot_q30_inline, gn_cross_q30: components up to 2^30 */
void prove_vectors(void)
{
    int32_t a[3], b[3], out[3];
    int64_t wide[3];
    any_vector(a, -(1 << 30), 1 << 30);
    any_vector(b, -(1 << 30), 1 << 30);
    gn_cross64(wide, a, b);
    sink = gn_dot64_inline(a, b) + gn_dot_q30_inline(a, b);
    gn_cross_q30(out, a, b);
}

/* gn_sin_q30, gn_cos_q30: every angle; the table is read within its bounds */
void prove_sine(void)
{
    for (uint32_t i = 0; i < 1024; i++) {
        int32_t v = gn_sin_q30((uint16_t)any_u32(64 * i, 64 * i + 63));
        //@ assert -(1 << 30) <= v <= (1 << 30);
    }
}

/* gn_step_of: n from 2 to 16, whatever a and b are */
void prove_step_of(void)
{
    for (int32_t n = 2; n <= 16; n++)
        sink = gn_step_of(any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX), n);
}

/* ---- lib/base/gn_math.c, gn_noise.h ------------------------------------------------------------------------------
 */

/* gn_noise_uq16 */
void prove_noise(void)
{
    uint32_t v = gn_noise_uq16(any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX));
    //@ assert v <= 65535;
}

/* ---- lib/shadow/gn_filter.h
 * ------------------------------------------------------------------------------------------
 */

/* gn_filter_fraction, gn_tent_weights, gn_linear_weights: every place, 1 to 12 bits */
void prove_tents(void)
{
    uint32_t w[GN_TENT_TAPS_MAX];
    for (int32_t bits = 1; bits <= 12; bits++) {
        uint32_t u = gn_filter_fraction(any_i32(INT32_MIN, INT32_MAX), bits);
        //@ assert u <= (1 << bits);
        for (int32_t k = 1; k <= 3; k++) {
            gn_tent_weights(w, k, u, bits);
            gn_linear_weights(w, k, u, bits);
        }
    }
}

/* gn_weighted, gn_weighted_fraction: weights below 2^30 */
void prove_weighted(void)
{
    uint32_t wu[GN_TENT_TAPS_MAX], wv[GN_TENT_TAPS_MAX];
    uint8_t dark[GN_TENT_TAPS_MAX];
    for (int i = 0; i < GN_TENT_TAPS_MAX; i++) {
        wu[i] = any_u32(0, 1U << 30), wv[i] = any_u32(0, 1U << 30);
        dark[i] = (uint8_t)any_u32(0, 255);
    }
    for (int n = 4; n <= 8; n += 2) usink = gn_weighted(dark, n, wu, wv);
    for (int bits = 4; bits <= 48; bits++)
        usink = gn_weighted_fraction(any_u64(0, UINT64_MAX), bits, any_u32(0, UINT32_MAX));
}
