/* Transforms for callers: rotations, products, scales and the camera, against long double; what products lose over
 * time. */
#include <stdint.h>

#include "exact.h"
#include "base/gn_q.h"
#include "gnomon.h"
#include "rng.h"

static rng random_state = {2};

#define ONE 1073741824.0L
/* Entries are sums of products of up to three sines, of 2 LSB each, and round three times. */
#define ROTATION_LSB 8.0L

static long double entry(const gn_affine *a, int r, int c)
{
    return ldexpl((long double)a->m_q30[r][c], a->exp - 30);
}

/* The largest |row . row - identity| of a matrix with exponent 0, in units of 2^-30; exact up to the conversion. */
static long double gram_error(const gn_affine *a)
{
    i128 largest = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k <= i; k++) {
            i128 dot = i == k ? -((i128)1 << 60) : 0;
            for (int c = 0; c < 3; c++) dot += (i128)a->m_q30[i][c] * a->m_q30[k][c];
            if (i128_abs(dot) > largest) largest = i128_abs(dot);
        }
    return (long double)largest / ONE;
}

static gn_affine random_rotation(void)
{
    gn_affine a;
    uint64_t angles = rng_u64(&random_state);
    gn_affine_rotation(&a, (uint16_t)angles, (uint16_t)(angles >> 16), (uint16_t)(angles >> 32));
    return a;
}

static void exact_rotation(long double m[3][3], uint32_t yaw, uint32_t pitch, uint32_t roll)
{
    long double turn = EXACT_TAU / 65536.0L;
    long double sy = sinl((long double)yaw * turn), cy = cosl((long double)yaw * turn);
    long double sx = sinl((long double)pitch * turn), cx = cosl((long double)pitch * turn);
    long double sz = sinl((long double)roll * turn), cz = cosl((long double)roll * turn);
    long double y[3][3] = {{cy, 0, sy}, {0, 1, 0}, {-sy, 0, cy}}, x[3][3] = {{1, 0, 0}, {0, cx, -sx}, {0, sx, cx}};
    long double z[3][3] = {{cz, -sz, 0}, {sz, cz, 0}, {0, 0, 1}}, yx[3][3];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) yx[r][c] = y[r][0] * x[0][c] + y[r][1] * x[1][c] + y[r][2] * x[2][c];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) m[r][c] = yx[r][0] * z[0][c] + yx[r][1] * z[1][c] + yx[r][2] * z[2][c];
}

/* Angles on the axes, next to them, and anywhere. */
static uint32_t random_angle(void)
{
    uint32_t a = rng_u32(&random_state);
    return a & 0xF0000U ? a & 0xFFFFU : (a & 0xC000U) + (a >> 30) - 1U;
}

static void test_rotation(void)
{
    tally error = {0}, gram = {0};
    worst w = {0}, worst_gram = {0};
    for (uint32_t i = 0; i < 100000; i++) {
        uint32_t yaw = random_angle() & 0xFFFFU, pitch = random_angle() & 0xFFFFU, roll = random_angle() & 0xFFFFU;
        gn_affine a;
        long double m[3][3];
        gn_affine_rotation(&a, (uint16_t)yaw, (uint16_t)pitch, (uint16_t)roll);
        exact_rotation(m, yaw, pitch, roll);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) {
                long double e = fabsl((long double)a.m_q30[r][c] - ONE * m[r][c]);
                WORST(&w, e, "%u %u %u [%d][%d]", (unsigned)yaw, (unsigned)pitch, (unsigned)roll, r, c);
                HOLDS(&error, e <= ROTATION_LSB && a.exp == 0 && a.t_q16[r] == 0, "%u %u %u [%d][%d] errs by %.3Lf",
                      (unsigned)yaw, (unsigned)pitch, (unsigned)roll, r, c, e);
            }
        long double g = gram_error(&a);
        WORST(&worst_gram, g, "%u %u %u", (unsigned)yaw, (unsigned)pitch, (unsigned)roll);
        HOLDS(&gram, g <= 16.0L, "%u %u %u: %.3Lf", (unsigned)yaw, (unsigned)pitch, (unsigned)roll, g);
    }
    CHECK_TALLY(error, "entries of a rotation");
    CHECK_TALLY(gram, "orthonormal within 2^-26");
    printf("gn_affine_rotation: %.3Lf LSB at %s; rows off orthonormal by %.3Lf LSB at %s\n", w.error, w.at,
           worst_gram.error, worst_gram.at);
}

/* ---- Products and scales ----------------------------------------------------------------------------------------- */

static gn_affine random_affine(int32_t max_exp, uint32_t t_bits)
{
    gn_affine a;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            a.m_q30[r][c] = rng_wide_i32(&random_state, 30);
            if (!rng_below(&random_state, 6)) a.m_q30[r][c] = a.m_q30[r][c] < 0 ? -(1 << 30) : 1 << 30;
        }
        a.t_q16[r] = rng_wide_i32(&random_state, t_bits);
    }
    a.exp = rng_range(&random_state, 0, max_exp);
    return a;
}

/* The smallest exponent 0..14 at which entries of m / 2^bits, moved by slack / 256, fit 1.0 after rounding. */
static int32_t smallest_exp(i128 m[3][3], int bits, int slack)
{
    for (int32_t exp = 0; exp < 14; exp++) {
        i128 lsb = (i128)1 << (bits + exp), limit = ((i128)1 << 30) * lsb + lsb / 2 + lsb / 256 * slack;
        int fits = 1;
        for (int i = 0; i < 9; i++) fits = fits && i128_abs(m[i / 3][i % 3]) < limit;
        if (fits) return exp;
    }
    return 14;
}

/* The matrix is m / 2^bits under the smallest exponent. It is rounded twice (a product to Q58 first): entries may
 * differ from the exact rounding by one, and so may the exponent where an entry lies half an LSB above 1.0. */
static int matrix_ok(const gn_affine *a, i128 m[3][3], int bits)
{
    int ok = a->exp >= smallest_exp(m, bits, 1) && a->exp <= smallest_exp(m, bits, -1);
    for (int i = 0; i < 9; i++) {
        i128 exact = i128_clamp(i128_round_shr(m[i / 3][i % 3], bits + a->exp), -(1 << 30), 1 << 30);
        ok = ok && i128_abs(a->m_q30[i / 3][i % 3] - exact) <= 1;
    }
    return ok;
}

static void product(i128 m[3][3], i128 t[3], const gn_affine *a, const gn_affine *b)
{
    for (int r = 0; r < 3; r++) {
        t[r] = 0;
        for (int c = 0; c < 3; c++) {
            m[r][c] = 0;
            for (int k = 0; k < 3; k++) m[r][c] += (i128)a->m_q30[r][k] * b->m_q30[k][c];
            m[r][c] *= (i128)1 << (a->exp + b->exp);
            t[r] += (i128)a->m_q30[r][c] * b->t_q16[c];
        }
        t[r] = t[r] * ((i128)1 << a->exp) + (i128)a->t_q16[r] * ((i128)1 << 30);
    }
}

static void test_mul(void)
{
    tally matrix = {0}, translation = {0}, alias = {0};
    for (uint32_t i = 0; i < 100000; i++) {
        gn_affine a = random_affine(14, 31), b = random_affine(14, i & 1 ? 31 : 20), out, same;
        i128 m[3][3], t[3];
        if (i & 2) a.exp /= 3, b.exp /= 3; /* mostly without saturation */
        product(m, t, &a, &b);
        gn_affine_mul(&out, &a, &b);
        HOLDS(&matrix, matrix_ok(&out, m, 30), "case %u: exponent %d", (unsigned)i, (int)out.exp);
        for (int r = 0; r < 3; r++) {
            i128 exact = i128_clamp(i128_round_shr(t[r], 30), INT32_MIN, INT32_MAX);
            HOLDS(&translation, i128_abs(out.t_q16[r] - exact) <= 1, "case %u: t[%d] = %d", (unsigned)i, r,
                  (int)out.t_q16[r]);
        }
        same = a;
        gn_affine_mul(&same, &same, &b);
        gn_affine_mul(&b, &a, &b);
        for (int k = 0; k < 12; k++) {
            int32_t e = k < 9 ? out.m_q30[k / 3][k % 3] : out.t_q16[k - 9];
            int ok = e == (k < 9 ? same.m_q30[k / 3][k % 3] : same.t_q16[k - 9]) && same.exp == out.exp;
            ok = ok && e == (k < 9 ? b.m_q30[k / 3][k % 3] : b.t_q16[k - 9]) && b.exp == out.exp;
            HOLDS(&alias, ok, "case %u", (unsigned)i);
        }
    }
    CHECK_TALLY(matrix, "gn_affine_mul: matrix within 1 LSB of the exact product, smallest exponent");
    CHECK_TALLY(translation, "gn_affine_mul: translation within 1 LSB, saturated");
    CHECK_TALLY(alias, "gn_affine_mul: the result may be an operand");
}

static void test_scale(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 100000; i++) {
        gn_affine a = random_affine(14, 30), out = a;
        int32_t scale =
            i & 1 ? (int32_t)(rng_wide_u64(&random_state, 29)) : rng_range(&random_state, 1, 8192 * 65536 - 1);
        i128 m[3][3];
        for (int k = 0; k < 9; k++) m[k / 3][k % 3] = (i128)a.m_q30[k / 3][k % 3] * scale * ((i128)1 << a.exp);
        gn_affine_scale(&out, scale);
        HOLDS(&t, matrix_ok(&out, m, 16), "case %u: scale %d, exponent %d", (unsigned)i, (int)scale, (int)out.exp);
        for (int r = 0; r < 3; r++) HOLDS(&t, out.t_q16[r] == a.t_q16[r], "case %u moves", (unsigned)i);
    }
    gn_affine a;
    gn_affine_identity(&a);
    gn_affine_scale(&a, GN_Q16(1.0));
    HOLDS(&t, a.exp == 0 && a.m_q30[0][0] == 1 << 30 && a.m_q30[0][1] == 0, "scale 1");
    gn_affine_scale(&a, GN_Q16(4096.0));
    HOLDS(&t, a.exp == 12 && a.m_q30[1][1] == 1 << 30, "scale 4096");
    gn_affine_scale(&a, GN_Q16(4.0));
    HOLDS(&t, a.exp == 14 && a.m_q30[2][2] == 1 << 30, "scale 16384");
    CHECK_TALLY(t, "gn_affine_scale");
}

/* T(a) T(b) p against T(ab) p in long double: the composition means what it says. */
static void test_composition(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 20000; i++) {
        gn_affine a = random_rotation(), b = random_rotation(), ab;
        for (int r = 0; r < 3; r++)
            a.t_q16[r] = rng_wide_i32(&random_state, 26), b.t_q16[r] = rng_wide_i32(&random_state, 26);
        gn_affine_scale(&b, rng_range(&random_state, 1 << 14, 1 << 18));
        gn_affine_mul(&ab, &a, &b);
        long double p[3], q[3], lsb = ldexpl(1.0L, ab.exp - 30);
        for (int k = 0; k < 3; k++) p[k] = (long double)rng_range(&random_state, -(1 << 24), 1 << 24);
        for (int r = 0; r < 3; r++)
            q[r] = entry(&b, r, 0) * p[0] + entry(&b, r, 1) * p[1] + entry(&b, r, 2) * p[2] + (long double)b.t_q16[r];
        for (int r = 0; r < 3; r++) {
            long double once =
                entry(&ab, r, 0) * p[0] + entry(&ab, r, 1) * p[1] + entry(&ab, r, 2) * p[2] + (long double)ab.t_q16[r];
            long double twice =
                entry(&a, r, 0) * q[0] + entry(&a, r, 1) * q[1] + entry(&a, r, 2) * q[2] + (long double)a.t_q16[r];
            HOLDS(&t, fabsl(once - twice) <= lsb * (fabsl(p[0]) + fabsl(p[1]) + fabsl(p[2])) + 1.0L,
                  "case %u: %Lf, not %Lf", (unsigned)i, once, twice);
        }
    }
    CHECK_TALLY(t, "composition");
}

/* ---- Camera ------------------------------------------------------------------------------------------------------ */

static void random_eye_target(int32_t eye[3], int32_t target[3], uint32_t i)
{
    uint32_t bits = 1 + rng_below(&random_state, 29);
    for (int k = 0; k < 3; k++) {
        eye[k] = rng_wide_i32(&random_state, 29);
        target[k] = eye[k] + rng_wide_i32(&random_state, bits);
    }
    if (i % 5 == 0) target[0] = eye[0], target[2] = eye[2];                                   /* straight up or down */
    if (i % 5 == 1) target[0] = eye[0] + rng_range(&random_state, -2, 2), target[2] = eye[2]; /* all but */
    if (i % 97 == 0) target[0] = eye[0], target[1] = eye[1], target[2] = eye[2];
}

static void test_look_at(void)
{
    tally forward = {0}, gram = {0}, upright = {0};
    worst w = {0}, worst_gram = {0};
    for (uint32_t i = 0; i < 100000; i++) {
        int32_t eye[3], target[3];
        gn_affine a;
        random_eye_target(eye, target, i);
        gn_camera_look_at(&a, eye, target);
        long double back[3], length = 0;
        for (int k = 0; k < 3; k++) {
            back[k] = (long double)eye[k] - (long double)target[k];
            length += back[k] * back[k];
            HOLDS(&forward, a.t_q16[k] == eye[k] && a.exp == 0, "case %u: position", (unsigned)i);
        }
        if (length == 0) { /* no rotation */
            for (int k = 0; k < 9; k++) HOLDS(&forward, a.m_q30[k / 3][k % 3] == 0, "case %u: a rotation", (unsigned)i);
            continue;
        }
        length = sqrtl(length);
        for (int k = 0; k < 3; k++) {
            long double e = fabsl((long double)a.m_q30[k][2] - ONE * back[k] / length);
            WORST(&w, e, "eye - target %.0Lf %.0Lf %.0Lf", back[0], back[1], back[2]);
            HOLDS(&forward, e <= 3.0L, "case %u: backward axis errs by %.3Lf", (unsigned)i, e);
        }
        long double g = gram_error(&a);
        WORST(&worst_gram, g, "eye - target %.0Lf %.0Lf %.0Lf", back[0], back[1], back[2]);
        HOLDS(&gram, g <= 16.0L, "case %u: off orthonormal by %.3Lf", (unsigned)i, g);
        /* the picture is level and not upside down, and the axes are right-handed */
        i128 det = 0;
        for (int k = 0; k < 3; k++) {
            int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            det += ((i128)a.m_q30[k1][0] * a.m_q30[k2][1] - (i128)a.m_q30[k2][0] * a.m_q30[k1][1]) * a.m_q30[k][2];
        }
        HOLDS(&upright, a.m_q30[1][0] == 0 && a.m_q30[1][1] >= 0 && det > 0, "case %u", (unsigned)i);
    }
    CHECK_TALLY(forward, "gn_camera_look_at: position and direction within 3 LSB");
    CHECK_TALLY(gram, "gn_camera_look_at: orthonormal within 2^-26");
    CHECK_TALLY(upright, "gn_camera_look_at: level, upright, right-handed");
    printf("gn_camera_look_at: direction %.3Lf LSB at %s; rows off orthonormal by %.3Lf LSB at %s\n", w.error, w.at,
           worst_gram.error, worst_gram.at);
}

/* ---- Drift ------------------------------------------------------------------------------------------------------- */

/* Rotating by products loses orthonormality: at worst the step's own error once per product, with steps that differ
 * much less. gn_scene accepts 2^-20 (1024 LSB) in a camera. */
static void test_drift(void)
{
    worst worst_same = {0};
    for (uint32_t i = 0; i < 8; i++) {
        uint16_t yaw = (uint16_t)rng_range(&random_state, 1, 400), pitch = (uint16_t)rng_range(&random_state, 1, 400);
        gn_affine a, step;
        gn_affine_identity(&a);
        gn_affine_rotation(&step, yaw, pitch, 17);
        uint32_t refused = 0;
        for (uint32_t n = 1; n <= 10000; n++) {
            gn_affine_mul(&a, &a, &step);
            if (!refused && gram_error(&a) > 1024.0L) refused = n;
        }
        WORST(&worst_same, gram_error(&a), "step %u %u 17, camera refused after %u", (unsigned)yaw, (unsigned)pitch,
              (unsigned)refused);
    }
    printf("10^4 products with the same rotation: rows off orthonormal by %.1Lf LSB (%s)\n", worst_same.error,
           worst_same.at);
    CHECK(worst_same.error <= 10000 * 16.0L);
    gn_affine a;
    uint32_t refused = 0;
    gn_affine_identity(&a);
    for (uint32_t n = 1; n <= 100000; n++) {
        gn_affine step;
        uint16_t angle[3];
        for (int k = 0; k < 3; k++) angle[k] = (uint16_t)rng_range(&random_state, -200, 200);
        gn_affine_rotation(&step, angle[0], angle[1], angle[2]);
        gn_affine_mul(&a, &a, &step);
        if (!refused && gram_error(&a) > 1024.0L) refused = n;
    }
    printf("10^5 products with different small rotations: rows off orthonormal by %.1Lf LSB, camera refused after %u\n",
           gram_error(&a), (unsigned)refused);
    CHECK(gram_error(&a) <= 100000 * 16.0L);
}

/* A rotation set from an angle has no history: after a million frames frame n is still frame n mod 2^16. [R8] */
static void test_no_drift(void)
{
    tally t = {0};
    uint16_t angle = 0;
    for (uint32_t n = 0; n < 1000000; n++, angle = (uint16_t)(angle + 7919U)) {
        if (n % 10) continue;
        gn_affine a, b;
        gn_affine_rotation(&a, angle, 0, 0);
        gn_affine_rotation(&b, (uint16_t)(n * 7919U), 0, 0);
        int ok = gram_error(&a) <= 16.0L;
        for (int k = 0; k < 9; k++) ok = ok && a.m_q30[k / 3][k % 3] == b.m_q30[k / 3][k % 3];
        HOLDS(&t, ok, "frame %u", (unsigned)n);
    }
    CHECK_TALLY(t, "rotation by angle over a million frames");
}

/* With gn_affine_orthonormalise every 64 products a camera turned step by step is never refused. */
static void test_orthonormalise(void)
{
    gn_affine turn, step;
    long double loss = 0;
    gn_affine_rotation(&step, 335, 185, 17);
    gn_affine_identity(&turn);
    for (uint32_t n = 1; n <= 100000; n++) {
        gn_affine_mul(&turn, &turn, &step);
        if (n % 64 == 0) gn_affine_orthonormalise(&turn);
        loss = gram_error(&turn) > loss ? gram_error(&turn) : loss;
        if (turn.exp != 0) loss = 1e9L;
    }
    CHECK(loss < 1024.0L); /* LSB of Q1.30: 2^-20 */
}

/* Without a depth axis, or with an upward axis along it, there are no axes to find: nothing changes. */
static void test_orthonormalise_degenerate(void)
{
    for (int k = 0; k < 2; k++) {
        gn_affine a, b;
        gn_affine_identity(&a);
        for (int i = 0; i < 3; i++) {
            if (k) a.m_q30[i][1] = a.m_q30[i][2];
            else a.m_q30[i][2] = 0;
        }
        b = a;
        gn_affine_orthonormalise(&a);
        for (int i = 0; i < 9; i++) CHECK_EQ_INT(a.m_q30[i / 3][i % 3], b.m_q30[i / 3][i % 3]);
    }
}

int main(void)
{
    test_rotation();
    test_mul();
    test_scale();
    test_composition();
    test_look_at();
    test_drift();
    test_no_drift();
    test_orthonormalise();
    test_orthonormalise_degenerate();
    return check_report();
}
