/* What the harnesses of make prove share: any value of a range, and where results go. */
#ifndef GNOMON_TESTS_PROVE_H
#define GNOMON_TESTS_PROVE_H

#include "gn_internal.h"

/* Contracts that stand for their functions where these are called; prove.sh has those of which the code does. */
#ifndef WHOLE_CLZ
/* Proved by prove_clz. */
/*@ requires v != 0;
    assigns \result \from v;
    ensures 0 <= \result <= 31; */
static inline int32_t gn_clz32(uint32_t v);

/*@ requires v != 0;
    assigns \result \from v;
    ensures 0 <= \result <= 63; */
static inline int32_t gn_clz64(uint64_t v);

#endif

#ifndef WHOLE_DIVISION
/* Assumed, and tested by test_math.c: the value analysis does not relate quotient, remainder and operands. */
/*@ requires b != 0;
    assigns \result \from a, b;
    assigns *rest \from a, b;
    ensures \initialized(rest);
    ensures \result <= a;
    ensures *rest < b; */
uint64_t gn_udiv64_rest(uint64_t a, uint64_t b, uint64_t *rest);
#endif

#include <__fc_builtin.h>

static int32_t any_i32(int32_t lo, int32_t hi)
{
    return Frama_C_interval(lo, hi);
}
static uint32_t any_u32(uint32_t lo, uint32_t hi)
{
    return Frama_C_unsigned_int_interval(lo, hi);
}
static int64_t any_i64(int64_t lo, int64_t hi)
{
    return Frama_C_long_long_interval(lo, hi);
}
static uint64_t any_u64(uint64_t lo, uint64_t hi)
{
    return Frama_C_unsigned_long_long_interval(lo, hi);
}

static volatile int64_t sink;
static volatile uint64_t usink;

#endif
