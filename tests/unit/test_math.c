/* The number core against exact arithmetic. `test_math soak`, or SOAK in the environment, tries every operand of the
 * reciprocal and of the root. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "exact.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_surface.h"
#include "gnomon.h"
#include "rng.h"

static rng random_state = {1};

/* ---- gn_q.h ------------------------------------------------------------------------------------------------------ */

static const int64_t edges[] = {
    /* clang-format off */
    0, 1, -1, 2, -2, 3, INT32_MAX, INT32_MIN, UINT32_MAX,
    (int64_t)1 << 32, 0x3FFFFFFF, 0x40000000, -0x40000000, INT64_MAX,
    INT64_MAX - 1, INT64_MIN, INT64_MIN + 1, (int64_t)1 << 62, -((int64_t)1 << 62), ((int64_t)1 << 62) - 1,
    /* clang-format on */
};
enum { N_EDGES = sizeof edges / sizeof edges[0] };

/* Every edge value first, then random ones of every width. */
static int64_t operand(uint32_t i)
{
    return i < N_EDGES ? edges[i] : rng_wide_i64(&random_state, 63);
}

static int leading_zeros(uint64_t v, int bits)
{
    int n = 0;
    while (!((v >> (bits - 1 - n)) & 1U)) n++;
    return n;
}

static void test_bits(void)
{
    tally clz = {0}, order = {0};
    for (uint32_t i = 0; i < 100000; i++) {
        uint64_t u = rng_wide_u64(&random_state, 64);
        HOLDS(&clz, gn_clz64(u) == leading_zeros(u, 64), "gn_clz64(%#llx)", (unsigned long long)u);
        uint32_t low = (uint32_t)u | 1U << (u >> 59);
        HOLDS(&clz, gn_clz32(low) == leading_zeros(low, 32), "gn_clz32(%#x)", (unsigned)low);
        int64_t v = operand(i), lo = rng_wide_i64(&random_state, 63), hi = rng_wide_i64(&random_state, 63);
        int32_t a = (int32_t)((uint64_t)v & UINT32_MAX), b = (int32_t)(lo >> 32);
        HOLDS(&order, gn_min32(a, b) == (a < b ? a : b) && gn_max32(a, b) == (a < b ? b : a), "%d %d", (int)a, (int)b);
        HOLDS(&order, gn_abs64(v) == (uint64_t)i128_abs(v), "gn_abs64(%lld)", (long long)v);
        HOLDS(&order, gn_abs32(a) == (uint32_t)i128_abs(a), "gn_abs32(%d)", (int)a);
        HOLDS(&order, gn_sat32(v) == i128_clamp(v, INT32_MIN, INT32_MAX), "gn_sat32(%lld)", (long long)v);
        if (lo <= hi) HOLDS(&order, gn_clamp64(v, lo, hi) == i128_clamp(v, lo, hi), "gn_clamp64(%lld)", (long long)v);
    }
    CHECK_TALLY(clz, "leading zeros");
    CHECK_TALLY(order, "order and magnitude");
}

/* v / 2^s, v * 2^-s and saturation, for every shift that 64 bits can see and far beyond */
static i128 scaled(int64_t v, int32_t s)
{
    if (s >= 0) return i128_round_shr(v, s);
    if (s < -64) s = -64;
    return i128_clamp((i128)v * ((i128)1 << (-s > 63 ? 63 : -s)) * (s < -63 ? 2 : 1), -GN_SATURATED, GN_SATURATED);
}

static void test_shifts(void)
{
    tally shl = {0}, shr = {0}, scale = {0};
    for (uint32_t i = 0; i < 20000; i++) {
        int64_t v = operand(i);
        for (int32_t s = 0; s <= 62; s++) {
            i128 up = (i128)v * ((i128)1 << s);
            if (up >= INT64_MIN && up <= INT64_MAX)
                HOLDS(&shl, gn_shl64(v, s) == up, "gn_shl64(%lld, %d)", (long long)v, (int)s);
            if (gn_abs64(v) <= (uint64_t)1 << 62)
                HOLDS(&shr, gn_shr64(v, s) == i128_round_shr(v, s), "gn_shr64(%lld, %d)", (long long)v, (int)s);
        }
        for (int32_t s = -66; s <= 66; s++)
            HOLDS(&scale, gn_scale64(v, s) == scaled(v, s), "gn_scale64(%lld, %d)", (long long)v, (int)s);
        HOLDS(&scale, gn_scale64(v, 100000) == 0, "gn_scale64(%lld, 100000)", (long long)v);
        HOLDS(&scale, gn_scale64(v, -100000) == scaled(v, -100), "gn_scale64(%lld, -100000)", (long long)v);
    }
    CHECK_TALLY(shl, "gn_shl64");
    CHECK_TALLY(shr, "gn_shr64");
    CHECK_TALLY(scale, "gn_scale64");
}

static void test_products(void)
{
    tally mul = {0};
    for (uint32_t i = 0; i < 400000; i++) {
        int32_t a = i < 32 ? INT32_MIN : rng_wide_i32(&random_state, 31),
                b = i & 1 ? a : rng_wide_i32(&random_state, 31);
        int32_t s = rng_range(&random_state, 1, 62);
        i128 exact = i128_round_shr((i128)a * b, s);
        if (exact == gn_sat32((int64_t)exact))
            HOLDS(&mul, gn_mul_shr(a, b, s) == exact, "gn_mul_shr(%d, %d, %d)", (int)a, (int)b, (int)s);
        exact = i128_round_shr((i128)a * b, 30);
        if (exact == gn_sat32((int64_t)exact))
            HOLDS(&mul, gn_mul_q30(a, b) == exact, "gn_mul_q30(%d, %d)", (int)a, (int)b);
        uint32_t ua = (uint32_t)rng_wide_u64(&random_state, 32), ub = (uint32_t)rng_wide_u64(&random_state, 32);
        if (i == 0) ua = UINT32_MAX, ub = 65536;
        exact = i128_round_shr((i128)ua * ub, 16);
        if (exact <= UINT32_MAX)
            HOLDS(&mul, gn_mul_uq16(ua, ub) == exact, "gn_mul_uq16(%u, %u)", (unsigned)ua, (unsigned)ub);
    }
    CHECK_TALLY(mul, "products");
}

/* ---- Reciprocal and root ----------------------------------------------------------------------------------------- */

typedef struct {
    tally bound[2], range;   /* with one step a mantissa may fall short of 2^31, near m = 2^32, by the step's error */
    u128 below[2], above[2]; /* largest distance below and above the true value, as a difference of products */
    uint32_t m_below[2], m_above[2];
} newton;

static void test_udiv(void)
{
    tally quotients = {0};
    rng random = {64};
    for (int i = 0; i < 1000000; i++) {
        uint64_t a = rng_u64(&random) >> rng_below(&random, 64), b = (rng_u64(&random) >> rng_below(&random, 64)) | 1U,
                 rest;
        uint64_t q = gn_udiv64_rest(a, b, &rest);
        HOLDS(&quotients, q == a / b && rest == a % b && gn_udiv64(a, b) == q, "%llu / %llu", (unsigned long long)a,
              (unsigned long long)b);
    }
    CHECK_TALLY(quotients, "quotients");
}

/* What gn_recip_norm computes where it has no table. */
static void test_recip_table(void)
{
    tally entries = {0};
    for (uint32_t i = 0; i < 256; i++)
        HOLDS(&entries, ((1U << 25) + i + 256U) / (2U * i + 513U) == gn_recip_table[i], "entry %u", (unsigned)i);
    CHECK_TALLY(entries, "entries of the table of reciprocals");
}

/* y * m against 2^63: the relative error of y is (y * m - 2^63) / 2^63. */
static void try_recip(newton *t, uint32_t m)
{
    for (int k = 0; k < 2; k++) {
        uint64_t y = gn_recip_norm(m, k + 1), product = y * m, one = (uint64_t)1 << 63;
        uint64_t below = product < one ? one - product : 0, above = product > one ? product - one : 0;
        HOLDS(&t->bound[k], (below | above) < (uint64_t)1 << (k ? 34 : 46), "m = %u, %d steps: %u", (unsigned)m, k + 1,
              (unsigned)y);
        if (k == 1) HOLDS(&t->range, y >= (uint64_t)1 << 31, "m = %u, %d steps: %u", (unsigned)m, k + 1, (unsigned)y);
        if (below > t->below[k]) t->below[k] = below, t->m_below[k] = m;
        if (above > t->above[k]) t->above[k] = above, t->m_above[k] = m;
    }
}

/* y^2 * m against 2^94: with y = (1 + e) 2^47 / sqrt(m) the quotient is (1 + e)^2. */
static void try_rsqrt(newton *t, uint32_t m)
{
    static const int bits[2] = {15, 28};
    for (int k = 0; k < 2; k++) {
        uint64_t y = gn_rsqrt_norm(m, k + 1), grid = (uint64_t)1 << bits[k];
        u128 square = (u128)(y * y) * m, one = (u128)1 << 94;
        u128 lo = (u128)((grid - 1) * (grid - 1)) << (94 - 2 * bits[k]), hi = (u128)((grid + 1) * (grid + 1))
                                                                              << (94 - 2 * bits[k]);
        HOLDS(&t->bound[k], square > lo && square < hi, "m = %u, %d steps: %u", (unsigned)m, k + 1, (unsigned)y);
        if (k == 1) HOLDS(&t->range, y >= (uint64_t)1 << 31, "m = %u, %d steps: %u", (unsigned)m, k + 1, (unsigned)y);
        if (square < one && one - square > t->below[k]) t->below[k] = one - square, t->m_below[k] = m;
        if (square > one && square - one > t->above[k]) t->above[k] = square - one, t->m_above[k] = m;
    }
}

static void report_newton(const newton *t, const char *name, int one_bits)
{
    CHECK_TALLY(t->range, "mantissa of two steps in [2^31, 2^32)");
    for (int k = 0; k < 2; k++) {
        CHECK_TALLY(t->bound[k], name);
        printf("%s, %d steps: 2^%.3Lf below at m = %u, 2^%.3Lf above at m = %u\n", name, k + 1,
               log2l((long double)t->below[k] + 1e-9L) - one_bits, (unsigned)t->m_below[k],
               log2l((long double)t->above[k] + 1e-9L) - one_bits, (unsigned)t->m_above[k]);
    }
}

static void sweep(newton *t, void (*try)(newton *, uint32_t), uint32_t first, uint64_t stride)
{
    for (uint64_t m = first; m <= UINT32_MAX; m += stride) try(t, (uint32_t)m);
    try(t, UINT32_MAX);
    for (uint64_t start = first; start <= UINT32_MAX;
         start += (uint64_t)1 << 23) /* both ends of every table interval */
        for (int32_t d = 0; d < 64; d++) {
            try(t, (uint32_t)(start + (uint32_t)d));
            try(t, (uint32_t)(start + ((uint64_t)1 << 23) - 1 - (uint32_t)d));
        }
    for (uint32_t i = 0; i < 300000; i++) {
        uint32_t m = rng_u32(&random_state);
        try(t, m < first ? m + first : m);
    }
}

static void test_newton(int soak)
{
    static newton recip, rsqrt;
    sweep(&recip, try_recip, 0x80000000U, soak ? 1 : 2048);
    sweep(&rsqrt, try_rsqrt, 0x40000000U, soak ? 1 : 2048);
    report_newton(&recip, "gn_recip_norm", 63);
    report_newton(&rsqrt, "gn_rsqrt_norm", 95);
}

/* ---- gn_bfloat --------------------------------------------------------------------------------------------------- */

static void test_bf(void)
{
    tally from = {0}, recip = {0}, mul = {0};
    for (uint32_t i = 0; i < 300000; i++) {
        uint64_t u = i ? rng_wide_u64(&random_state, 64) : UINT64_MAX;
        gn_bfloat a = gn_bf_from_u64(u), b = gn_bf_from_u64(rng_wide_u64(&random_state, 64));
        /* in units of 2^-32: exact for every exponent -31 .. 32 */
        u128 value = (u128)a.mant << (a.exp + 32), whole = (u128)u << 32;
        HOLDS(&from, a.mant >> 31 && value <= whole && whole - value < (whole >> 31) + 1, "%#llx",
              (unsigned long long)u);
        gn_bfloat inverse = gn_bf_recip(a);
        uint64_t one = (uint64_t)1 << 63, product = (uint64_t)inverse.mant * a.mant;
        uint64_t error = product > one ? product - one : one - product;
        HOLDS(&recip, inverse.mant >> 31 && inverse.exp == -63 - a.exp && error < (uint64_t)1 << 34, "1 / (%u * 2^%d)",
              (unsigned)a.mant, (int)a.exp);
        gn_bfloat p = gn_bf_mul(a, b);
        uint64_t exact = (uint64_t)a.mant * b.mant;
        int32_t d = p.exp - a.exp - b.exp;
        int ok = p.mant >> 31 && (d == 31 || d == 32);
        uint64_t stored = ok ? (uint64_t)p.mant << d : 0;
        HOLDS(&mul, ok && stored <= exact && exact - stored < exact >> 31, "%u * %u", (unsigned)a.mant,
              (unsigned)b.mant);
    }
    CHECK_TALLY(from, "gn_bf_from_u64");
    CHECK_TALLY(recip, "gn_bf_recip");
    CHECK_TALLY(mul, "gn_bf_mul");
}

/* |result - a mant 2^s| <= max(1, 2^-31 |a mant 2^s|) after saturation; everything times 2^-s if that is whole */
static int apply_ok(int64_t result, int64_t a, uint32_t mant, int32_t s)
{
    i128 exact = (i128)a * mant; /* |exact| < 2^95 */
    if (s >= 0) {
        i128 limit = s > 60 ? 0 : GN_SATURATED >> s;
        if (i128_abs(exact) > limit) exact = a < 0 ? -(i128)GN_SATURATED : GN_SATURATED;
        else exact *= (i128)1 << s;
        i128 error = i128_abs(result - exact), allowed = i128_abs(exact) >> 31;
        return error <= (allowed > 1 ? allowed : 1);
    }
    if (s < -100) return result == 0;
    const int64_t limit = a < 0 ? -GN_SATURATED : GN_SATURATED;
    /* at the limit itself the last dropped bit may round beyond it */
    if (i128_abs(exact) >> -s > GN_SATURATED - (result == limit)) return result == limit;
    i128 unit = (i128)1 << -s, rest = i128_abs(exact) % unit, whole = i128_abs(exact) / unit;
    i128 difference = (a < 0 ? -(i128)result : result) - whole; /* result - exact = difference - rest / unit */
    i128 allowed = whole >> 31;
    if (allowed < 1) allowed = 1;
    /* a product of 64 bits is rounded once */
    if (gn_abs64(a) <= UINT32_MAX && difference != (2 * rest >= unit)) return 0;
    return difference <= allowed && difference >= -allowed + (rest > 0);
}

static void test_bf_apply(void)
{
    tally t = {0}, saturated = {0};
    for (uint32_t i = 0; i < 1000000; i++) {
        int64_t a = i < 64 * N_EDGES ? edges[i % N_EDGES] : rng_wide_i64(&random_state, 63);
        gn_bfloat b = {(uint32_t)rng_wide_u64(&random_state, 32) | 0x80000000U, rng_range(&random_state, -100, 100)};
        int32_t s = i & 1 ? rng_range(&random_state, -100, 66) : rng_range(&random_state, -66, 0);
        int64_t result = gn_bf_apply(a, b, s - b.exp), limit = a < 0 ? -GN_SATURATED : GN_SATURATED;
        HOLDS(&t, apply_ok(result, a, b.mant, s), "%lld * %u * 2^%d: %lld", (long long)a, (unsigned)b.mant, (int)s,
              (long long)result);
        if (s >= 0 && a && (s > 29 || i128_abs((i128)a * b.mant) >> (61 - s)))
            HOLDS(&saturated, result == limit, "%lld * %u * 2^%d: %lld", (long long)a, (unsigned)b.mant, (int)s,
                  (long long)result);
    }
    CHECK_TALLY(t, "gn_bf_apply");
    CHECK_TALLY(saturated, "gn_bf_apply saturates");
}

/* ---- Roots and vectors ------------------------------------------------------------------------------------------- */

static void test_isqrt(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 200000; i++) {
        uint64_t root = rng_wide_u64(&random_state, 32), v = rng_wide_u64(&random_state, 64);
        if (i == 0) root = UINT32_MAX, v = 0;
        if (i == 1) v = UINT64_MAX;
        uint64_t tried[4] = {v, root * root, root * root - 1, root * root + 2 * root};
        for (int k = 0; k < 4; k++) {
            uint64_t r = gn_isqrt64(tried[k]);
            HOLDS(&t, r * r <= tried[k] && (u128)(r + 1) * (r + 1) > tried[k], "%llu", (unsigned long long)tried[k]);
        }
    }
    CHECK_TALLY(t, "gn_isqrt64");
}

static void random_vector(int64_t a[3], uint32_t i)
{
    static const int64_t hard[][3] = {{INT64_MAX, INT64_MAX, INT64_MAX},
                                      {INT64_MIN, INT64_MIN, INT64_MIN},
                                      {INT64_MAX, 0, INT64_MIN},
                                      {1, 0, 0},
                                      {1, 1, 1},
                                      {0, -1, 0},
                                      {INT64_MAX - 0x7FFFFFFF, 1, 0},
                                      {(1 << 30) - 1, 1, 0},
                                      {0x3FFFFFFFF, 7, -3},
                                      {0, 0, INT64_MIN}};
    enum { N_HARD = sizeof hard / sizeof hard[0] };
    uint32_t width = 1 + rng_below(&random_state, 63), same = rng_below(&random_state, 2);
    for (int k = 0; k < 3; k++) {
        if (i < N_HARD) a[k] = hard[i][k];
        else if (same) a[k] = (int64_t)rng_u64(&random_state) >> (63 - width);
        else a[k] = rng_wide_i64(&random_state, width);
    }
}

/* A face without a normal, whose corners lie on a line, looks at the camera. */
static void test_no_normal(void)
{
    static gn_frame frame;
    static gn_surface surface;
    static const gn_normal normal[3] = {0, 0, 0};
    const gn_mesh mesh = {.nrm_q15 = normal};
    const gn_object object = {.mesh = &mesh};
    int32_t out[3] = {7, 7, 7};
    surface.object = &object;
    for (int k = 0; k < 9; k++) frame.cam.axis_q30[k / 3][k % 3] = (k - 4) * 12345;
    gn_surface_face(&frame, &surface, out);
    for (int k = 0; k < 3; k++) CHECK_EQ_INT(out[k], -frame.cam.axis_q30[2][k]);
}

/* Two rows at right angles, and a third that leaves their plane by e / 2^29: to 2^-28 it is flat. */
static void test_det_sign(void)
{
    static const struct {
        int32_t e;
        int sign;
    } cases[] = {{0, 0}, {1, 0}, {-1, 0}, {64, 1}, {-64, -1}, {1 << 29, 1}, {-(1 << 29), -1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const int32_t flat[3] = {1 << 29, 1 << 29, cases[i].e};
        const int32_t m[3][3] = {{1 << 30, 0, 0}, {0, 1 << 30, 0}, {flat[0], flat[1], flat[2]}};
        const int32_t turned[3][3] = {{flat[0], flat[1], flat[2]}, {1 << 30, 0, 0}, {0, 1 << 30, 0}};
        CHECK_EQ_INT(gn_det_sign(m), cases[i].sign);
        CHECK_EQ_INT(gn_det_sign(turned), cases[i].sign);
    }
}

static void test_normalise(void)
{
    tally t = {0}, zero = {0};
    worst w = {0};
    for (uint32_t i = 0; i < 1000000; i++) {
        int64_t a[3];
        int32_t out[3] = {0, 0, 0};
        random_vector(a, i);
        if (!a[0] && !a[1] && !a[2]) a[0] = 1;
        HOLDS(&zero, gn_normalise_q30(out, a) == 1, "%lld %lld %lld", (long long)a[0], (long long)a[1],
              (long long)a[2]);
        long double l = 0;
        for (int k = 0; k < 3; k++)
            l += (long double)a[k] * (long double)a[k]; /* 2^-62 relative: far below the bound */
        l = 1073741824.0L / sqrtl(l);
        for (int k = 0; k < 3; k++) {
            long double e = fabsl((long double)out[k] - (long double)a[k] * l);
            HOLDS(&t, e <= 3.0L, "%lld %lld %lld: [%d] errs by %.3Lf", (long long)a[0], (long long)a[1],
                  (long long)a[2], k, e);
            WORST(&w, e, "%lld %lld %lld", (long long)a[0], (long long)a[1], (long long)a[2]);
        }
    }
    int64_t null[3] = {0, 0, 0};
    int32_t out[3];
    HOLDS(&zero, gn_normalise_q30(out, null) == 0, "zero vector");
    CHECK_TALLY(t, "gn_normalise_q30 within 3 LSB");
    CHECK_TALLY(zero, "gn_normalise_q30 result");
    printf("gn_normalise_q30: %.3Lf LSB at %s\n", w.error, w.at);
}

static int norm_vec_ok(const int32_t out[3], const int64_t a[3], int32_t e)
{
    uint32_t largest = 0;
    for (int k = 0; k < 3; k++) {
        uint32_t v = gn_abs32(out[k]);
        largest = v > largest ? v : largest;
        if (e <= 0 && (i128)out[k] != (i128)a[k] * ((i128)1 << -e)) return 0;
        i128 unit = e > 0 ? (i128)1 << e : 1, error = e > 0 ? i128_abs(out[k] * unit - a[k]) : 0;
        /* half a unit; a whole one where rounding up would have reached 2^30 */
        if (2 * error > unit && !(error <= unit && v == (1U << 30) - 1)) return 0;
    }
    return largest >= 1U << 29 && largest < 1U << 30;
}

static void test_norm_vec(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 400000; i++) {
        int64_t a[3];
        int32_t out[3];
        random_vector(a, i);
        int32_t e = gn_norm_vec(out, a);
        int ok = a[0] || a[1] || a[2] ? norm_vec_ok(out, a, e) : !e && !out[0] && !out[1] && !out[2];
        HOLDS(&t, ok, "%lld %lld %lld: %d %d %d, %d", (long long)a[0], (long long)a[1], (long long)a[2], (int)out[0],
              (int)out[1], (int)out[2], (int)e);
    }
    int64_t null[3] = {0, 0, 0};
    int32_t out[3] = {1, 1, 1};
    HOLDS(&t, gn_norm_vec(out, null) == 0 && !out[0] && !out[1] && !out[2], "zero vector");
    CHECK_TALLY(t, "gn_norm_vec");
}

static void test_cross_dot(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 300000; i++) {
        int32_t a[3], b[3], c30[3];
        int64_t c[3];
        for (int k = 0; k < 3; k++) {
            a[k] = i < 8 ? ((i >> k) & 1U ? (1 << 30) - 1 : -(1 << 30) + 1) : rng_wide_i32(&random_state, 30);
            b[k] = i < 8 ? ((i >> (2 - k)) & 1U ? (1 << 30) - 1 : -(1 << 30) + 1) : rng_wide_i32(&random_state, 30);
        }
        gn_cross64(c, a, b);
        i128 dot = 0, limit = (i128)1 << 60;
        int unit = 1;
        for (int k = 0; k < 3; k++) {
            int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            i128 exact = (i128)a[k1] * b[k2] - (i128)a[k2] * b[k1];
            HOLDS(&t, c[k] == exact, "cross of case %u", (unsigned)i);
            unit = unit && i128_abs(exact) <= limit;
            dot += (i128)a[k] * b[k];
        }
        HOLDS(&t, gn_dot64(a, b) == dot, "dot of case %u", (unsigned)i);
        if (!unit) continue;
        gn_cross_q30(c30, a, b);
        for (int k = 0; k < 3; k++)
            HOLDS(&t, c30[k] == i128_round_shr(c[k], 30), "rounded cross of case %u", (unsigned)i);
    }
    CHECK_TALLY(t, "cross and dot products");
}

/* ---- Angles ------------------------------------------------------------------------------------------------------ */

static void test_sine(void)
{
    tally bound = {0}, symmetry = {0};
    worst w = {0};
    for (uint32_t i = 0; i < 65536; i++) {
        uint16_t a = (uint16_t)i;
        int32_t s = gn_sin_q30(a);
        long double e = fabsl((long double)s - 1073741824.0L * sinl((long double)i * (EXACT_TAU / 65536.0L)));
        WORST(&w, e, "%u", (unsigned)i);
        HOLDS(&bound, e <= 2.0L && s <= 1 << 30 && s >= -(1 << 30), "%u: %d errs by %.3Lf", (unsigned)i, (int)s, e);
        int ok = gn_sin_q30((uint16_t)(0U - i)) == -s && gn_sin_q30((uint16_t)(i + 32768U)) == -s &&
                 gn_cos_q30((uint16_t)(i - 16384U)) == s && gn_sin_q30((uint16_t)(32768U - i)) == s;
        HOLDS(&symmetry, ok, "%u", (unsigned)i);
    }
    CHECK_TALLY(bound, "gn_sin_q30 within 2 LSB");
    CHECK_TALLY(symmetry, "symmetries of the sine");
    CHECK(gn_sin_q30(0) == 0 && gn_sin_q30(16384) == 1 << 30 && gn_sin_q30(49152) == -(1 << 30));
    /* and the same bits everywhere: constants of its series may be off by less than the bound shows */
    uint64_t sum = 0;
    for (uint32_t i = 0; i <= 16384; i++) sum = sum * 0x9E3779B97F4A7C15U + (uint32_t)gn_sin_q30((uint16_t)i);
    CHECK(sum == 0x524819787CA8CD19U);
    printf("gn_sin_q30: %.3Lf LSB at %s\n", w.error, w.at);
}

/* The error comes from the sine's 2 LSB in numerator and denominator: 4 LSB of 2^30 over the smaller of the two. */
static void test_focal(void)
{
    tally t = {0};
    worst w = {0};
    for (uint32_t i = 1; i < 32768; i++) {
        long double angle = (long double)i * (EXACT_TAU / 65536.0L), exact = 16777216.0L / tanl(angle / 2);
        uint32_t focal = gn_focal_from_fov_q24((uint16_t)i);
        if (exact >= 4294967295.0L * 1.0001L) {
            HOLDS(&t, focal == UINT32_MAX, "%u saturates", (unsigned)i);
            continue;
        }
        if (exact < 524288.0L || exact > 4294967295.0L) continue; /* no camera has it */
        long double relative = fabsl((long double)focal - exact) / exact;
        long double allowed = 2.0L / 1073741824.0L * (1 / sinl(angle) + 1 / (1 + cosl(angle))) + 1.0L / exact;
        WORST(&w, relative, "%u", (unsigned)i);
        HOLDS(&t, relative <= allowed, "%u: %u errs by %Lg", (unsigned)i, (unsigned)focal, relative);
    }
    HOLDS(&t, gn_focal_from_fov_q24(0) == UINT32_MAX, "no angle saturates");
    for (uint32_t i = 32768; i < 65536; i++)
        HOLDS(&t, gn_focal_from_fov_q24((uint16_t)i) == 0, "%u: no focal length", (unsigned)i);
    CHECK_TALLY(t, "gn_focal_from_fov_q24");
    printf("gn_focal_from_fov_q24: relative 2^%.2Lf at %s\n", log2l(w.error), w.at);
}

/* The state that a signature of whole words came from: steps are bijections. */
static uint64_t state_before_end(uint64_t signature)
{
    const uint64_t factor = 0xFF51AFD7ED558CCDU;
    uint64_t inverse = factor; /* 3 bits are right, and twice as many with each step */
    for (int i = 0; i < 5; i++) inverse *= 2 - factor * inverse;
    return (signature ^ signature >> 32) * inverse;
}

/* Words that differ by up to 2^31, and the one after them that makes the lower halves equal: the upper ones differ. */
static void test_signature_words(void)
{
    tally t = {0};
    rng random = {2};
    for (int i = 0; i < 200000; i++) {
        const uint32_t d = i < 4096 ? (uint32_t)i + 1 : (rng_u32(&random) >> rng_below(&random, 32) >> 1) + 1;
        const uint32_t x = rng_u32(&random), y = x > UINT32_MAX - d ? x - d : x + d; /* d up to 2^31 */
        const uint32_t low = (uint32_t)GN_SIGNATURE_SEED, first[2] = {x ^ low, y ^ low};
        uint32_t words[2][2] = {{first[0], rng_u32(&random)}, {first[1], 0}};
        const uint64_t a = state_before_end(gn_signature_bytes(GN_SIGNATURE_SEED, first, 4)),
                       b = state_before_end(gn_signature_bytes(GN_SIGNATURE_SEED, first + 1, 4));
        words[1][1] = words[0][1] ^ (uint32_t)a ^ (uint32_t)b;
        HOLDS(&t, a >> 32 != b >> 32, "%08x and %08x", (unsigned)x, (unsigned)y);
        HOLDS(&t,
              gn_signature_bytes(GN_SIGNATURE_SEED, words[0], 8) != gn_signature_bytes(GN_SIGNATURE_SEED, words[1], 8),
              "after %08x and %08x", (unsigned)x, (unsigned)y);
    }
    CHECK_TALLY(t, "gn_signature_bytes, words");
}

/* One bit of many bytes changes their signature, and no other bit takes that back: also none of the uppermost, which
 * products by odd numbers leave alone. */
static void test_signature_bytes(void)
{
    enum { BYTES = 50, BITS = 8 * BYTES };
    static uint8_t bytes[BYTES];
    static uint64_t one[BITS];
    tally t = {0};
    rng random = {1};
    for (int series = 0; series < 4; series++) {
        for (int i = 0; i < BYTES; i++) bytes[i] = series ? (uint8_t)rng_u32(&random) : 0;
        const uint64_t none = gn_signature_bytes(GN_SIGNATURE_SEED, bytes, BYTES);
        for (int i = 0; i < BITS; i++) {
            bytes[i / 8] ^= (uint8_t)(1 << i % 8);
            one[i] = gn_signature_bytes(GN_SIGNATURE_SEED, bytes, BYTES);
            HOLDS(&t, one[i] != none, "bit %d of series %d", i, series);
            for (int j = 0; j < i; j++) {
                bytes[j / 8] ^= (uint8_t)(1 << j % 8);
                const uint64_t two = gn_signature_bytes(GN_SIGNATURE_SEED, bytes, BYTES);
                HOLDS(&t, two != none && one[j] != one[i], "bits %d and %d of series %d", i, j, series);
                bytes[j / 8] ^= (uint8_t)(1 << j % 8);
            }
            bytes[i / 8] ^= (uint8_t)(1 << i % 8);
        }
    }
    CHECK_TALLY(t, "gn_signature_bytes");
}

int main(int argc, char **argv)
{
    test_signature_bytes();
    test_signature_words();
    test_bits();
    test_shifts();
    test_products();
    test_recip_table();
    test_udiv();
    test_newton((argc > 1 && !strcmp(argv[1], "soak")) || getenv("SOAK"));
    test_bf();
    test_bf_apply();
    test_isqrt();
    test_normalise();
    if (GN_VERTEX_NORMALS) test_no_normal();
    test_det_sign();
    test_norm_vec();
    test_cross_dot();
    test_sine();
    test_focal();
    return check_report();
}
