/* Functions in place of inline code: gn_scale64; with GN_SIZE_FIRST or without long products the others, see gn_q.h.
 * The linker drops unused ones. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "base/gn_signature.h"

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
