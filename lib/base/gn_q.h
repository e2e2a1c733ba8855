/* Rounding, saturation and shifts: the only place where they are written out.
 *
 * Rounding is to nearest, halves upwards, unless a name says otherwise. Signed right shifts are arithmetic (asserted
 * below: implementation-defined in C99, and so on every compiler we build with); signed left shifts go through
 * multiplication or unsigned.
 */
#ifndef GN_Q_H
#define GN_Q_H

#include <stdint.h>

#include "base/gn_hint.h"

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

/* With GN_SIZE_FIRST (-Os) these are calls instead of inline code: gn_q.c has the bodies. */
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

#endif
