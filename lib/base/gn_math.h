/* Number core: reciprocals, roots, sine, vectors. Formats, ranges and errors are proved in docs/NUMERICS.md section 2.
 */
#ifndef GN_MATH_H
#define GN_MATH_H

#include <stdint.h>

#include "base/gn_base_types.h"
#include "base/gn_q.h"
#include "gn_knobs.h"
#include "gnomon.h"

/* ---- Constant tables, written by host/generate/gen_tables.c (make tables) ---------------------------------------- */

/* Whether colours of RGB565 are packed by tables: three times as fast as by the curve, with the same bits. Where every
 * pixel is exact they save a twentieth of its instructions, and GN_SIZE_FIRST goes without. */
#define GN_LEVEL_TABLES (GN_RUNTIME_KNOBS || (GN_SRGB && (GN_INTERPOLATES || !GN_SIZE_FIRST)))

extern const uint16_t gn_recip_table[256]; /* Q1.15: 1/x at the middle of [1/2 + i/512, 1/2 + (i+1)/512) */
extern const uint16_t gn_rsqrt_table[192]; /* Q1.15: 1/sqrt(x) for x in [1/4 + i/256, 1/4 + (i+1)/256) */
extern const int32_t gn_sin_table_q30[65]; /* sin(i / 256 turn) */
extern const uint16_t
    gn_srgb_table[577]; /* 65535 * srgb(x), x = 2^(k-9) (1 + j/64) at entry 64 k + j; see gn_pixel.c */
/* For RGB565, of colours below 1: the level where a cell of 1/1024 or 1/512 begins, and where each level ends; 31
 * levels count from 64. */
extern const uint8_t gn_level_63_table[1024], gn_level_31_table[512];
extern const uint32_t gn_level_end_q24[96];
extern const int16_t
    gn_disk_table_q15[128];                 /* x, y of 64 points of the unit disk (MODEL 7), every prefix well spread */
extern const uint16_t gn_tent_sums[32][16]; /* Q12: sums of subsets, a bit each, of the four weights of a tent of 3
                                               texels at 1/32 texel (NUMERICS 4.13) */
/* 65535 * linear light of an sRGB value of 8 bits; of 5 and 6 */
extern const uint16_t gn_srgb_decode_table[256], gn_linear_31_table[32], gn_linear_63_table[64];

/* Block floats and lengths go through calls as 64 bits, the mantissa low: two registers on every core, where the
 * calling convention of ARM returns a structure of 8 bytes in memory. */
GN_INLINE uint64_t gn_bf_bits(gn_bfloat a)
{
    return (uint64_t)(uint32_t)a.exp << 32 | a.mant;
}

GN_INLINE gn_bfloat gn_bf_of_bits(uint64_t bits)
{
    gn_bfloat a = {(uint32_t)bits, (int32_t)(bits >> 32)};
    return a;
}

uint64_t gn_bf_from_u64_bits(uint64_t v);
uint64_t gn_bf_recip_bits(uint64_t a);
uint64_t gn_bf_mul_bits(uint64_t a, uint64_t b);
int64_t gn_bf_apply_bits(int64_t a, uint64_t b);

/* Nearest below: v truncated to 32 significant bits; v > 0. Relative error < 2^-31. */
GN_INLINE gn_bfloat gn_bf_from_u64(uint64_t v)
{
    return gn_bf_of_bits(gn_bf_from_u64_bits(v));
}

/* 2^63 / m for a normalised m in [2^31, 2^32). newton_steps 1: relative error < 2^-17, 2: < 2^-29, and then within
 * [2^31, 2^32). */
uint32_t gn_recip_norm(uint32_t m, int32_t newton_steps);

/* One step of Newton's method towards 1 / x, x = m / 2^32 in [1/2, 1), y in Q1.31: y(2 - xy) exceeds 1 / x only by
 * truncation, so only x near 1/2 reaches 2^32. */
GN_HOT static inline uint32_t gn_recip_step(uint32_t m, uint32_t y)
{
    uint32_t two_minus_xy = 0U - gn_umul_high(m, y); /* Q1.31, near 1: xy is within 2^-8 of 1 */
    uint64_t better = (uint64_t)y * two_minus_xy;
    return better >> 63 ? UINT32_MAX : (uint32_t)(better >> 31);
}

/* gn_recip_norm with two steps, inlined where it is called per vertex. */
GN_HOT static inline uint32_t gn_recip_norm2_inline(uint32_t m)
{
    uint32_t y = (uint32_t)gn_recip_table[(m >> 23) & 255U] << 16, two_minus_xy = 0U - gn_umul_high(m, y);
    /* the first step ends below 2^32: the entry for x next to 1/2 is too far from 2 */
    y = (uint32_t)(((uint64_t)y * two_minus_xy) >> 31);
    GN_KEEP(y); /* 32 bits, of which it knows */
    two_minus_xy = 0U - gn_umul_high(m, y);
    uint64_t better = (uint64_t)y * two_minus_xy;
    y = (uint32_t)(better >> 31) | (uint32_t)((int32_t)(better >> 32) >> 31); /* UINT32_MAX from 2^32 on */
    GN_KEEP(y);
    return y;
}

GN_INLINE uint32_t gn_recip_norm2(uint32_t m)
{
    return GN_SIZE_FIRST ? gn_recip_norm(m, 2) : gn_recip_norm2_inline(m);
}

/* (b - a) / n, rounded towards zero, 0 < n <= 16; |b - a| < 2^31 where n is 1. */
int32_t gn_step_of(int32_t a, int32_t b, int32_t n);

/* num / den to 2^-17 of it, Q30; num <= den */
uint32_t gn_quotient_q30(uint32_t num, uint32_t den);

/* 2^47 / sqrt(m) for m in [2^30, 2^32). newton_steps 1: relative error < 2^-15, 2: < 2^-28, and then within [2^31,
 * 2^32). */
uint32_t gn_rsqrt_norm(uint32_t m, int32_t newton_steps);

/* Relative error < 2^-29 */
GN_INLINE gn_bfloat gn_bf_recip(gn_bfloat a)
{
    return gn_bf_of_bits(gn_bf_recip_bits(gn_bf_bits(a)));
}

/* Relative error < 2^-31 */
GN_INLINE gn_bfloat gn_bf_mul(gn_bfloat a, gn_bfloat b)
{
    return gn_bf_of_bits(gn_bf_mul_bits(gn_bf_bits(a), gn_bf_bits(b)));
}

/* round(a * b.mant * 2^(b.exp + shift)), saturating at +-GN_SATURATED. Error at most 1 LSB or 2^-31 of the result, the
 * larger. */
GN_INLINE int64_t gn_bf_apply(int64_t a, gn_bfloat b, int32_t shift)
{
    b.exp += shift;
    return gn_bf_apply_bits(a, gn_bf_bits(b));
}

uint32_t gn_isqrt64(uint64_t v); /* floor(sqrt(v)) */

/* floor(a / b), b > 0, and the remainder. One step per bit of the quotient: never used per pixel. For short quotients
 * no slower than the compiler's helper, which takes ten times the flash. */
uint64_t gn_udiv64_rest(uint64_t a, uint64_t b, uint64_t *rest);
uint64_t gn_udiv64(uint64_t a, uint64_t b);

/* round(a * 2^q30 / |a|); a any length but zero. Each component errs by at most 3 LSB of Q1.30. Returns 0 if a is zero.
 */
int gn_normalise_q30(int32_t out_q30[3], const int64_t a[3]);

/* A vector of any length to length 1, Q1.30, by its 15 upper bits: off by 2^-13.5 along each axis. 0 stays 0. */
void gn_normalise_15(int32_t v[3]);

/* Shifts n values until the largest has `bits` bits. */
GN_HOT static inline void gn_to_bits(int32_t *v, int32_t n, int32_t bits)
{
    uint32_t any = 1;
    GN_UNROLL
    for (int32_t k = 0; k < n; k++) any |= gn_abs32(v[k]);
    const int32_t down = 32 - bits - gn_clz32(any), less = gn_max32(down, 0), more = gn_max32(-down, 0);
    GN_UNROLL
    for (int32_t k = 0; k < n; k++) v[k] = (int32_t)((uint32_t)v[k] << more) >> less;
}

/* Exact; |components| < 2^30 so that the result fits. */
void gn_cross64(int64_t out[3], const int32_t a[3], const int32_t b[3]);
/* Exact; |sum| < 2^63 */
int64_t gn_far_dot64(const int32_t a[3], const int32_t b[3]);
int64_t gn_far_dot_q30(const int32_t a[3], const int32_t b[3]);
GN_HOT static inline int64_t gn_dot64_inline(const int32_t a[3], const int32_t b[3])
{
    return (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2];
}

/* round(a . b / 2^30) */
GN_HOT static inline int64_t gn_dot_q30_inline(const int32_t a[3], const int32_t b[3])
{
    return gn_shr64_inline(gn_dot64_inline(a, b), 30);
}

GN_INLINE int64_t gn_dot64(const int32_t a[3], const int32_t b[3])
{
    return GN_SIZE_FIRST ? gn_far_dot64(a, b) : gn_dot64_inline(a, b);
}

GN_INLINE int64_t gn_dot_q30(const int32_t a[3], const int32_t b[3])
{
    return GN_SIZE_FIRST ? gn_far_dot_q30(a, b) : gn_dot_q30_inline(a, b);
}

/* 1 / |n| of a vector of Q1.30 components, |n| <= 1 except for rounding: 2^(63 - shift / 2) = root * sqrt(n . n). Zero
 * stays zero. */
typedef struct {
    uint32_t root;
    int32_t shift;
} gn_length;

uint64_t gn_length_bits(int32_t newton_steps, const int32_t n_q30[3]);

GN_INLINE gn_length gn_length_of(int32_t newton_steps, const int32_t n_q30[3])
{
    uint64_t bits = gn_length_bits(newton_steps, n_q30);
    gn_length length = {(uint32_t)bits, (int32_t)(bits >> 32)};
    return length;
}

void gn_length_unit(gn_length length, const int32_t n_q30[3], int32_t out_q30[3]); /* n / |n| */

/* Round Q1.30 cross product of unit vectors. */
void gn_cross_q30(int32_t out_q30[3], const int32_t a_q30[3], const int32_t b_q30[3]);

/* Sign of the determinant of three rows, exact except for rows within 2^-28 of a common plane, which give 0. */
int gn_det_sign(const int32_t m[3][3]);

/* Shifts a vector so that its largest component has its top bit at bit 29: |out| < 2^30. Returns e with a = out * 2^e
 * (rounded when e > 0, exact when e <= 0). A zero vector gives zero and e = 0. */
int32_t gn_norm_vec(int32_t out[3], const int64_t a[3]);

#endif
