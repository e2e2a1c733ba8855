/* A small deterministic generator (splitmix64) and the operand shapes that arithmetic tests want. */
#ifndef GNOMON_TESTS_RNG_H
#define GNOMON_TESTS_RNG_H

#include <stdint.h>

typedef struct {
    uint64_t state;
} rng;

static inline uint64_t rng_u64(rng *r)
{
    uint64_t z = r->state += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
}

static inline uint32_t rng_u32(rng *r)
{
    return (uint32_t)(rng_u64(r) >> 32);
}

/* 0 <= result < n; n > 0 */
static inline uint32_t rng_below(rng *r, uint32_t n)
{
    return (uint32_t)(((uint64_t)rng_u32(r) * n) >> 32);
}

/* lo <= result <= hi */
static inline int32_t rng_range(rng *r, int32_t lo, int32_t hi)
{
    return (int32_t)(lo + (int64_t)rng_below(r, (uint32_t)((int64_t)hi - lo) + 1U));
}

/* 1 .. max_bits significant bits, each width as likely; now and then a power of two or its neighbours; never 0. */
static inline uint64_t rng_wide_u64(rng *r, uint32_t max_bits)
{
    uint64_t top = (uint64_t)1 << rng_below(r, max_bits), below = top - 1;
    switch (rng_below(r, 8)) {
    case 0:
        return top;
    case 1:
        return top | 1U;
    case 2:
        return top | below;
    case 3:
        return top | (below & ~(uint64_t)1);
    default:
        return top | (rng_u64(r) & below);
    }
}

/* The same with a sign: magnitudes below 2^max_bits, max_bits <= 63; sometimes 0. */
static inline int64_t rng_wide_i64(rng *r, uint32_t max_bits)
{
    int64_t v = (int64_t)rng_wide_u64(r, max_bits);
    uint32_t shape = rng_below(r, 32);
    return shape == 0 ? 0 : shape & 1U ? -v : v;
}

static inline int32_t rng_wide_i32(rng *r, uint32_t max_bits)
{
    return (int32_t)rng_wide_i64(r, max_bits);
}

#endif
