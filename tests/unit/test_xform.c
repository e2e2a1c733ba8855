/* Transforms of vertices: the one with added-up constant terms gives the other's result wherever it gives one, for
 * entries, translations and positions up to the largest. Sanitizers see what overflows. */
#include "geometry/gn_xform.h"
#include "check.h"
#include "rng.h"

static int32_t entry(rng *r)
{
    const int32_t v = rng_below(r, 3) ? 1 << 30 : rng_range(r, 0, 1 << 30);
    const int32_t near = v - (int32_t)(rng_below(r, 2) ? rng_below(r, (uint32_t)v / 8 + 1) : 0);
    return rng_below(r, 2) ? near : -near;
}

int main(void)
{
    rng r = {11};
    long n_fast = 0, n_slow = 0, n_wrong = 0;
    for (int i = 0; i < 100000; i++) {
        gn_xform xform = {0};
        gn_xform_fast fast;
        int32_t pos[3];
        const int bits = (int)rng_below(&r, 4) ? 30 : (int)rng_below(&r, 31), small = (int)rng_below(&r, 20);
        int64_t want[3];
        int32_t got[3];
        xform.shift = rng_range(&r, 0, 44);
        for (int row = 0; row < 3; row++) {
            for (int c = 0; c < 3; c++) xform.m[row][c] = entry(&r) >> small;
            xform.t_q16[row] = entry(&r) >> (30 - bits);
            pos[row] = entry(&r) >> rng_below(&r, 16);
        }
        gn_xform_fast_begin(&fast, &xform);
        gn_xform_point(want, &xform, pos);
        if (!gn_xform_fast_inline(got, &fast, pos)) {
            n_slow++;
            continue;
        }
        n_fast++;
        for (int k = 0; k < 3; k++) n_wrong += got[k] != want[k];
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_fast > 5000 && n_slow > 5000);
    printf("%ld by the fast one, %ld not\n", n_fast, n_slow);
    return check_report();
}
