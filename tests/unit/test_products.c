/* Products by halves, for cores that multiply two words to one (GN_CORE_LONG_PRODUCTS 0): the same as those of 64
 * bits. */
#define GN_CORE_LONG_PRODUCTS 0

#include "base/gn_q.h"
#include "check.h"
#include "rng.h"
#include "shade/gn_corner.h"

enum { CASES = 300000 };

static rng random_state = {5};

/* Any width, and the ends of halves and words. */
static uint32_t operand(void)
{
    static const uint32_t edge[] = {0, 1, 0x7FFF, 0x8000, 0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000U, 0xFFFFFFFFU};
    if (rng_below(&random_state, 4)) return (uint32_t)rng_wide_u64(&random_state, 32);
    return edge[rng_below(&random_state, sizeof edge / sizeof *edge)];
}

static uint32_t share(void)
{
    return rng_below(&random_state, 4) ? rng_below(&random_state, 65537) : operand() & 1U ? 65536 : 65535;
}

static void test_upper_halves(void)
{
    for (int k = 0; k < CASES; k++) {
        const uint32_t a = operand(), b = operand();
        if (!CHECK_EQ_INT(gn_umul_high(a, b), (uint64_t)a * b >> 32)) return;
        if (!CHECK_EQ_INT(gn_mul_high((int32_t)a, (int32_t)b), (int64_t)(int32_t)a * (int32_t)b >> 32)) return;
    }
}

static void test_shares(void)
{
    for (int k = 0; k < CASES; k++) {
        const uint32_t v = operand(), part = share(), below = part & 0xFFFFU;
        const uint64_t whole = (uint64_t)v * part;
        if (!CHECK_EQ_INT(gn_mul_share(v, part), whole >> 16)) return;
        if (!CHECK_EQ_INT(gn_mul_uq16(v, part), (whole + 0x8000U) >> 16)) return;
        if (!CHECK_EQ_INT(gn_mul_half_share((int32_t)v, below), (int64_t)(int32_t)v * below >> 17)) return;
    }
}

#if GN_INTERPOLATES
/* Colours may be above 1; products are limited to 8. */
static void test_colours(void)
{
    for (int k = 0; k < CASES; k++) {
        const uint32_t colour = rng_below(&random_state, 8) ? share() : operand() >> 8, e = operand();
        const uint64_t product = (uint64_t)colour * e >> 16;
        if (!CHECK_EQ_INT(gn_corner_times(colour, (int32_t)e), product >> 27 ? 1 << 27 : product)) return;
    }
}
#else
static void test_colours(void)
{
}
#endif

int main(void)
{
    test_upper_halves();
    test_shares();
    test_colours();
    return check_report();
}
