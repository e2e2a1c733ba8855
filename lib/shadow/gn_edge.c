/* Edges finer than texels. [F7] */
#include "gn_internal.h"

#include "shadow/gn_edge.h"

#if GN_EDGE_BUILT

/* How a run ends after `length` texels, up to n: 1 where it steps into the receiver's row, -1 where it steps away. */
GN_HOT static int32_t end_of(uint32_t own, uint32_t other, int32_t at, int32_t length, int32_t n)
{
    if (length >= n) return 0;
    uint32_t a = own >> at & 1U, b = other >> at & 1U;
    return a != b ? 0 : a ? 1 : -1;
}

/* Twice the run's length times how far the outline lies inside of the side, Q16, f along it. Bits of texels that are
 * like the receiver's are 0. */
GN_HOT static int32_t outline(uint32_t own, uint32_t other, int32_t n, uint32_t f_q16, int32_t *length)
{
    const uint32_t run = ~own & other;
    const uint32_t before = ~(run << (32 - n)), after = ~(run >> (n + 1));
    const int32_t left = gn_min32(gn_clz32(before | 1U), n), right = gn_min32(31 - gn_clz32(after & (0U - after)), n);
    const int32_t whole = (left + right + 1) << 16, twice = 2 * ((left << 16) + (int32_t)f_q16);
    *length = left + right + 1;
    return twice < whole ? end_of(own, other, n - 1 - left, left, n) * (whole - twice)
                         : end_of(own, other, n + 1 + right, right, n) * (twice - whole);
}

/* What is left of the receiver's own answer by one side, y inside of it. */
GN_HOT static int32_t share_by_side(uint32_t own, uint32_t other, int32_t n, uint32_t f_q16, int32_t y_q16, int hard)
{
    int32_t length, line = outline(own, other, n, f_q16, &length); /* up to 17 * 2^16 */
    if (hard) return y_q16 * 2 * length < line ? 0 : 65536;
    return gn_max32(0, gn_min32(32768 + y_q16 - line / (2 * length), 65536));
}

GN_HOT uint32_t gn_edge_attenuation(const gn_edge_texels *texels, int reads, int32_t n, int32_t u_q16, int32_t v_q16,
                                    int hard)
{
    const uint32_t fu = (uint32_t)u_q16 & 0xFFFFU, fv = (uint32_t)v_q16 & 0xFFFFU;
    const uint32_t dark = (reads & GN_EDGE_ROWS ? texels->row[1] : texels->column[1]) >> n & 1U, flip = 0U - dark;
    int32_t share = 65536;
    for (int side = 0; side < 4; side++) {
        const int by_row = side < 2;
        if (!(reads & (by_row ? GN_EDGE_ROWS : GN_EDGE_COLUMNS))) continue;
        const uint32_t *line = by_row ? texels->row : texels->column;
        const uint32_t own = line[1] ^ flip, other = line[side & 1 ? 2 : 0] ^ flip, across = by_row ? fv : fu;
        if (!(other >> n & 1U)) continue;
        share = gn_min32(
            share, share_by_side(own, other, n, by_row ? fu : fv, (int32_t)(side & 1 ? 65536 - across : across), hard));
    }
    return (uint32_t)(dark ? 65536 - share : share);
}

#endif
