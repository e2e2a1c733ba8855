/* Exact oracles: 128-bit integers, and tallies for loops of millions of cases. */
#ifndef GNOMON_TESTS_EXACT_H
#define GNOMON_TESTS_EXACT_H

#include <stdint.h>
#include <stdio.h>

#include "check.h"

__extension__ typedef __int128 i128;
__extension__ typedef unsigned __int128 u128;

#define EXACT_TAU 6.283185307179586476925286766559L

static inline i128 i128_abs(i128 v)
{
    return v < 0 ? -v : v;
}

static inline i128 i128_clamp(i128 v, i128 lo, i128 hi)
{
    return v < lo ? lo : v > hi ? hi : v;
}

/* floor(a / b), b > 0 */
static inline i128 i128_floor_div(i128 a, i128 b)
{
    i128 q = a / b;
    return a % b < 0 ? q - 1 : q;
}

/* round(v / 2^s), halves upwards; |v| < 2^100, s >= 0 */
static inline i128 i128_round_shr(i128 v, int s)
{
    if (s == 0) return v;
    if (s > 110) return 0;
    return i128_floor_div(v + ((i128)1 << (s - 1)), (i128)1 << s);
}

/* Twice the signed area of a triangle; |coordinates| < 2^29. */
static inline int64_t exact_area(const int32_t x[3], const int32_t y[3])
{
    return (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
}

/* Whether a triangle of any orientation covers the centre of a pixel, by its edge functions and the top-left rule (y
 * down). */
static inline int exact_covers(const int32_t x[3], const int32_t y[3], int32_t subpixel_bits, int32_t px, int32_t py)
{
    int64_t area = exact_area(x, y), one = (int64_t)1 << subpixel_bits, cx = px * one + one / 2,
            cy = py * one + one / 2;
    if (area == 0) return 0;
    for (int i = 0; i < 3; i++) {
        int a = area > 0 ? i : 2 - i, b = area > 0 ? (i + 1) % 3 : (4 - i) % 3; /* the inside lies at e > 0 */
        int64_t dx = x[b] - x[a], dy = y[b] - y[a], e = dx * (cy - y[a]) - dy * (cx - x[a]);
        if (e < 0 || (e == 0 && !(dy < 0 || (dy == 0 && dx > 0)))) return 0;
    }
    return 1;
}

/* A property over many cases: counted, reported once with the first case that broke it. */
typedef struct {
    unsigned long n, n_bad;
    char first[300];
} tally;

#define HOLDS(t, condition, ...)                                                                                       \
    do {                                                                                                               \
        (t)->n++;                                                                                                      \
        if (!(condition) && !(t)->n_bad++) snprintf((t)->first, sizeof(t)->first, __VA_ARGS__);                        \
    } while (0)

static inline int tally_check(const tally *t, const char *what, const char *file, int line)
{
    char text[500];
    snprintf(text, sizeof text, "%s: %lu of %lu, first: %s", what, t->n_bad, t->n, t->n ? t->first : "no case at all");
    return check_note(t->n > 0 && t->n_bad == 0, file, line, text);
}

#define CHECK_TALLY(t, what) tally_check(&(t), what, __FILE__, __LINE__)

/* The largest error seen and where. */
typedef struct {
    long double error;
    char at[200];
} worst;

#define WORST(w, e, ...)                                                                                               \
    do {                                                                                                               \
        long double worst_error_ = (e);                                                                                \
        if (worst_error_ > (w)->error) {                                                                               \
            (w)->error = worst_error_;                                                                                 \
            snprintf((w)->at, sizeof(w)->at, __VA_ARGS__);                                                             \
        }                                                                                                              \
    } while (0)

#endif
