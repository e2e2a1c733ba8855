/* Rounding, saturation and shifts: the only place where they are written out.
 *
 * Rounding is to nearest, halves upwards, unless a name says otherwise. Signed right shifts are arithmetic (asserted
 * below: implementation-defined in C99, and so on every compiler we build with); signed left shifts go through
 * multiplication or unsigned.
 */
#ifndef GN_Q_H
#define GN_Q_H

#include <stddef.h>
#include <stdint.h>

#include "base/gn_base_types.h"

typedef char gn_assert_arithmetic_shift[((-5) >> 1) == -3 ? 1 : -1];

/* For wrappers that are shorter than a call: always inlined. */
#if defined(__GNUC__)
#define GN_INLINE static inline __attribute__((always_inline))
#else
#define GN_INLINE static inline
#endif

/* Leading zeros; v != 0. */
GN_HOT static inline int32_t gn_clz32(uint32_t v)
{
#if defined(__GNUC__)
    return (int32_t)__builtin_clz((unsigned int)v) - (int32_t)(sizeof(unsigned int) * 8U - 32U);
#else
    int32_t n = 0;
    while (!(v & 0x80000000U)) {
        v <<= 1;
        n++;
    }
    return n;
#endif
}

GN_HOT static inline int32_t gn_clz64(uint64_t v)
{
    uint32_t hi = (uint32_t)(v >> 32);
    return hi ? gn_clz32(hi) : 32 + gn_clz32((uint32_t)v);
}

GN_HOT static inline int32_t gn_min32(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

GN_HOT static inline int32_t gn_max32(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

GN_HOT static inline int64_t gn_clamp64_inline(int64_t v, int64_t lo, int64_t hi)
{
    return v < lo ? lo : v > hi ? hi : v;
}

GN_HOT static inline int32_t gn_sat32_inline(int64_t v)
{
    if (GN_SELDOM(v != (int32_t)v)) return v < 0 ? INT32_MIN : INT32_MAX;
    return (int32_t)v;
}

/* |v| as unsigned: defined for the most negative value too. */
GN_HOT static inline uint32_t gn_abs32(int32_t v)
{
    return v < 0 ? 0U - (uint32_t)v : (uint32_t)v;
}

GN_HOT static inline uint64_t gn_abs64_inline(int64_t v)
{
    return v < 0 ? 0U - (uint64_t)v : (uint64_t)v;
}

/* v * 2^s; 0 <= s <= 62 and the result fits. */
GN_HOT static inline int64_t gn_shl64(int64_t v, int32_t s)
{
    return (int64_t)((uint64_t)v << s);
}

/* round(v / 2^s); 0 <= s <= 62, |v| < 2^63 - 2^(s - 1). */
GN_HOT static inline int64_t gn_shr64_inline(int64_t v, int32_t s)
{
    return s ? (v + ((int64_t)1 << (s - 1))) >> s : v;
}

/* What 64-bit results saturate at, 2^61 - 1: the sum of three of them and of any 32-bit numbers fits 64 bits, so nobody
 * who adds to such a result need ask whether it is one. */
#define GN_SATURATED INT64_C(0x1FFFFFFFFFFFFFFF)

/* round(v * 2^-s) for any s of either sign. Where s < 0, saturates at +-GN_SATURATED. Inline: 170 bytes each. */
int64_t gn_scale64(int64_t v, int32_t s);

/* round(a * b / 2^s); 1 <= s <= 62, |a * b| <= 2^62. */
GN_HOT static inline int32_t gn_mul_shr_inline(int32_t a, int32_t b, int32_t s)
{
    return (int32_t)(((int64_t)a * b + ((int64_t)1 << (s - 1))) >> s);
}

/* round(a * b / 2^30) for Q1.30 factors whose product fits Q1.30. */
GN_HOT static inline int32_t gn_mul_q30_inline(int32_t a, int32_t b)
{
    return gn_mul_shr_inline(a, b, 30);
}

/* With GN_SIZE_FIRST (-Os) these are calls instead of inline code: gn_math.c has the bodies. */
int64_t gn_far_clamp64(int64_t v, int64_t lo, int64_t hi);
int32_t gn_far_clamp32(int64_t v, int32_t lo, int32_t hi);
int32_t gn_far_sat32(int64_t v);
int64_t gn_far_shr64(int64_t v, int32_t s);
int64_t gn_far_shr30(int64_t v);
int32_t gn_far_mul_shr(int32_t a, int32_t b, int32_t s);
int32_t gn_far_mul_q30(int32_t a, int32_t b);
uint64_t gn_far_abs64(int64_t v);
#if GN_SIZE_FIRST && defined(__GNUC__)
#define GN_IS_INT32_(v) (__builtin_constant_p(v) && (v) >= INT32_MIN && (v) <= INT32_MAX)

GN_INLINE int64_t gn_clamp64(int64_t v, int64_t lo, int64_t hi)
{
    return GN_IS_INT32_(lo) && GN_IS_INT32_(hi) ? gn_far_clamp32(v, (int32_t)lo, (int32_t)hi)
                                                : gn_far_clamp64(v, lo, hi);
}

GN_INLINE int64_t gn_shr64(int64_t v, int32_t s)
{
    if (!__builtin_constant_p(s)) return gn_far_shr64(v, s);
    return s == 30 ? gn_far_shr30(v) : gn_shr64_inline(v, s);
}

#define gn_sat32   gn_far_sat32
#define gn_mul_shr gn_far_mul_shr
#define gn_mul_q30 gn_far_mul_q30
#define gn_abs64   gn_far_abs64
#else
#define gn_clamp64 gn_clamp64_inline
#define gn_shr64   gn_shr64_inline
#define gn_sat32   gn_sat32_inline
#define gn_mul_shr gn_mul_shr_inline
#define gn_mul_q30 gn_mul_q30_inline
#define gn_abs64   gn_abs64_inline
#endif

/* The upper half of a product. On cores without long products a function: shorter than the compiler's, which finds the
 * lower half, too. */
int32_t gn_far_mul_high(int32_t a, int32_t b);
uint32_t gn_far_umul_high(uint32_t a, uint32_t b);
#if GN_CORE_LONG_PRODUCTS
GN_HOT static inline int32_t gn_mul_high(int32_t a, int32_t b)
{
    return (int32_t)((int64_t)a * b >> 32);
}

GN_HOT static inline uint32_t gn_umul_high(uint32_t a, uint32_t b)
{
    return (uint32_t)((uint64_t)a * b >> 32);
}
#else
#define gn_mul_high  gn_far_mul_high
#define gn_umul_high gn_far_umul_high
#endif

/* floor(v * share / 2^16), share at most 1: two short products do as well. */
GN_HOT static inline uint32_t gn_mul_share(uint32_t v, uint32_t share_uq16)
{
    if (GN_CORE_LONG_PRODUCTS) return (uint32_t)((uint64_t)v * share_uq16 >> 16);
    return (v >> 16) * share_uq16 + ((v & 0xFFFFU) * share_uq16 >> 16);
}

/* round(v * share / 2^16), likewise. */
GN_HOT static inline uint32_t gn_mul_uq16(uint32_t v, uint32_t share_uq16)
{
    if (GN_CORE_LONG_PRODUCTS) return (uint32_t)(((uint64_t)v * share_uq16 + 0x8000U) >> 16);
    return (v >> 16) * share_uq16 + (((v & 0xFFFFU) * share_uq16 + 0x8000U) >> 16);
}

/* floor(v * share / 2^17), share below 1. */
GN_HOT static inline int32_t gn_mul_half_share(int32_t v, uint32_t share_uq16)
{
    if (GN_CORE_LONG_PRODUCTS) return gn_mul_high(v, (int32_t)(share_uq16 << 15));
    return ((v >> 16) * (int32_t)share_uq16 + (int32_t)(((uint32_t)v & 0xFFFFU) * share_uq16 >> 16)) >> 1;
}

/* ---- Interleaved gradient noise, for all dithering --------------------------------------------------------------- */

/* frac(52.9829189 * frac(0.06711056 x + 0.00583715 y)) at a pixel's centre, Q0.16: both fractions are wraps of 32 bits.
 * [D7] */
GN_HOT static inline uint32_t gn_noise_uq16(int32_t x, int32_t y)
{
    uint32_t inner =
        (2U * (uint32_t)x + 1) * 144118830U + (2U * (uint32_t)y + 1) * 12535184U; /* 2^31 times the factors */
    return (uint32_t)(((uint64_t)inner * 3555623499U) >> 26) >> 16;               /* 52.9829189 * 2^26 */
}

/* ---- 64-bit signatures of the inputs of a shadow tile, or the pixels of a screen tile [A5] [R6] ------------------ */

/* Two different inputs have the same signature with probability 2^-64. Not secure against adversaries. */

#define GN_SIGNATURE_SEED 0x9E3779B97F4A7C15U

/* Every step is a bijection of the signature for a given word. A difference below bit 32 spreads to all bits above it,
 * which a word of 32 bits cannot take back. */
static inline uint64_t gn_signature_add_inline(uint64_t signature, uint64_t word)
{
    signature = (signature ^ word) * 0xFF51AFD7ED558CCDU;
    return signature ^ signature >> 32;
}

uint64_t gn_far_signature_add(uint64_t signature, uint64_t word);
GN_INLINE uint64_t gn_signature_add(uint64_t signature, uint64_t word)
{
    return GN_SIZE_FIRST ? gn_far_signature_add(signature, word) : gn_signature_add_inline(signature, word);
}

static inline uint64_t gn_signature_words(uint64_t signature, const int32_t *words, size_t n)
{
    for (size_t i = 0; i < n; i++) signature = gn_signature_add(signature, (uint32_t)words[i]);
    return signature;
}

/* Of n bytes. */
uint64_t gn_signature_bytes(uint64_t signature, const void *bytes, size_t n);

/* ---- Kernels that a port may replace, and what they must compute, bit for bit ------------------------------------ */

/* The library is portable without a port. With -DGN_PORT='"gn_port_NAME.h"' that header is included (gn_base_types.h);
 * for each kernel that the port has, it defines gn_kernel_X as the function that replaces gn_portable_X, under the same
 * preconditions: port/gn_port.h is the contract, docs/FIRMWARE.md explains it. */

/* The next lower bit: whether a texel is below a level. */
GN_HOT static inline uint32_t gn_borrow(uint32_t bits, uint32_t texel, uint32_t level)
{
    return bits << 1 | (texel - level) >> 31;
}

/* Four texels of a row. */
GN_HOT static inline uint32_t gn_four_below(const uint16_t *texel, uint32_t level)
{
    return gn_borrow(gn_borrow(gn_borrow(gn_borrow(0, texel[3], level), texel[2], level), texel[1], level), texel[0],
                     level);
}

/* Which of n x n texels, in rows `pitch` apart, shadow a receiver: their depth, as the upper 16 of 32 bits, is below
 * `least`. Bit i of dark[j] is for texel i of row j. Returns the OR of all rows, plus, 16 bits up, their AND. n = 4, 6
 * or 8; least <= 0xFFFF0000. `texel` is aligned to two bytes, not to four. */
GN_HOT static inline uint32_t gn_portable_dark_texels16(const uint16_t *texel, size_t pitch, uint32_t least, int32_t n,
                                                        uint8_t *dark)
{
    uint32_t level = (least + 0xFFFFU) >> 16, any = 0, all = 255;
    if (!GN_SIZE_FIRST && n == 4) { /* without a loop callers keep them in registers */
        uint32_t a = gn_four_below(texel, level), b = gn_four_below(texel + pitch, level),
                 c = gn_four_below(texel + 2 * pitch, level), d = gn_four_below(texel + 3 * pitch, level);
        dark[0] = (uint8_t)a, dark[1] = (uint8_t)b, dark[2] = (uint8_t)c, dark[3] = (uint8_t)d;
        return a | b | c | d | (a & b & c & d) << 16;
    }
    for (uint8_t *end = dark + n; dark < end; dark++, texel += pitch) {
        uint32_t row = 0;
        if (n == 8) row = gn_borrow(gn_borrow(row, texel[7], level), texel[6], level);
        if (n >= 6) row = gn_borrow(gn_borrow(row, texel[5], level), texel[4], level);
        row = row << 4 | gn_four_below(texel, level);
        *dark = (uint8_t)row;
        any |= row;
        all &= row;
    }
    return any | all << 16;
}

#ifndef gn_kernel_dark_texels16
#define gn_kernel_dark_texels16 gn_portable_dark_texels16
#endif

#endif
