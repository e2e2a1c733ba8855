/* Edges finer than texels. [F7] */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "shadow/gn_lookup.h"

#if GN_EDGE_BUILT

/* A run of texels like the receiver's beside texels that are not: how many lie before and after it, up to n. */
typedef struct {
    int32_t length[2];
    int32_t end[2]; /* bits of the texel after the last: 1 in the receiver's line, 2 in the other, where dark differs */
} texel_run;

/* Along a row; bit n, 1 .. 8, is the receiver's texel. Bits of texels like it are 0; those above 2n may be any, as runs
 * end there. Shifts are up to 31. */
GN_HOT static inline void run_of_row(uint32_t own, uint32_t other, int32_t n, texel_run *run)
{
    const uint32_t bits = ~own & other, before = ~(bits << (32 - n)), after = ~(bits >> (n + 1));
    const int32_t left = gn_min32(gn_clz32(before | 1U), n), right = gn_min32(31 - gn_clz32(after & (0U - after)), n);
    run->length[0] = left;
    run->length[1] = right;
    own <<= 1; /* one texel before the first */
    other <<= 1;
    run->end[0] = (int32_t)((own >> (n - left) & 1U) | (other >> (n - left) & 1U) << 1);
    run->end[1] = (int32_t)((own >> (n + 2 + right) & 1U) | (other >> (n + 2 + right) & 1U) << 1);
}

/* Along a column, from the receiver's row on. */
GN_HOT static inline void run_of_column(const uint32_t *row, int32_t own, int32_t other, uint32_t flip, int32_t n,
                                        texel_run *run)
{
    for (int side = 0; side < 2; side++) {
        const uint32_t *at = row;
        int32_t k = 0, end;
        do {
            at += side ? 1 : -1;
            end = (int32_t)(((*at ^ flip) >> own & 1U) | ((*at ^ flip) >> other & 1U) << 1);
        } while (end == 2 && ++k < n);
        run->length[side] = k;
        run->end[side] = end;
    }
}

/* What is left of the receiver's own answer by one side: f along it, y inside of it. The outline lies half a texel
 * inside of the side where the run ends in a step towards the receiver, as much outside where it steps away, and on it
 * in the run's middle. */
GN_HOT static int32_t share_by_side(const texel_run *run, int32_t n, uint32_t f_q16, int32_t y_q16, int hard)
{
    const int32_t length = run->length[0] + run->length[1] + 1;
    int32_t from_end = 2 * ((run->length[0] << 16) + (int32_t)f_q16), side = 0;
    if (from_end >= length << 16) {
        from_end = (length << 17) - from_end;
        side = 1;
    }
    int32_t line = (length << 16) - from_end; /* up to 17 * 2^16: half a texel times twice the length */
    const int32_t end = run->length[side] >= n ? 1 : run->end[side];
    if (end == 0) line = -line;
    else if (end != 3) line = 0;
    /* all below 2^22: y up to 2^16, length up to 17 */
    if (hard) return y_q16 * 2 * length < line ? 0 : 65536;
    return gn_max32(0, gn_min32(32768 + y_q16 - line / (2 * length), 65536));
}

GN_HOT uint32_t gn_edge_attenuation(const uint32_t *row, int32_t s, int32_t n, int32_t u_q16, int32_t v_q16, int hard)
{
    const uint32_t f[2] = {(uint32_t)u_q16 & 0xFFFFU, (uint32_t)v_q16 & 0xFFFFU};
    const uint32_t dark = row[0] >> s & 1U, flip = 0U - dark;
    int32_t share = 65536;
    GN_COUNT(outlines, 1);
    for (int side = 0; side < 4; side++) {
        const int by_column = side >> 1, step = side & 1 ? 1 : -1;
        const uint32_t *beside = by_column ? row : row + step;
        const int32_t t = by_column ? s + step : s;
        texel_run run;
        const uint32_t across = f[!by_column];
        const int32_t y_q16 = (int32_t)(step > 0 ? 65536 - across : across);
        if ((*beside >> t & 1U) == dark || (hard && y_q16 >= 32768)) continue;
        if (by_column) run_of_column(row, s, t, flip, n, &run);
        else run_of_row((row[0] ^ flip) >> (s - n), (*beside ^ flip) >> (s - n), n, &run);
        share = gn_min32(share, share_by_side(&run, n, f[by_column], y_q16, hard));
        if (!share) break;
    }
    return (uint32_t)(dark ? 65536 - share : share);
}

#endif
