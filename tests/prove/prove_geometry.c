/* Harnesses for Frama-C's value analysis, as in prove_base.c: transforms, edges, projection, depth. */
#include "prove.h"

#include "base/gn_math.c"
#include "base/gn_tables.c"
#include "geometry/gn_plane.c"
#include "geometry/gn_xform.h"
#include "visible/gn_screen_triangle.c"

/* ---- lib/geometry/gn_walk.h, gn_walk.c ------------------------------------------------------------------------------
 */

/* gn_first_px, gn_walk_lasts: |coordinate| < 2^29 */
void prove_first_px(void)
{
    for (int bits = 1; bits <= 12; bits++) sink = gn_first_px(any_i32(-(1 << 29), 1 << 29), bits);
    sink = gn_walk_lasts(any_u32(0, UINT32_MAX));
}

/* gn_walk_ratio: |a| < 2^28 + 2^26, 0 < b < 2^14 */
void prove_walk_ratio(void)
{
    for (int32_t b = 1; b < 1 << 14; b *= 2) usink = gn_walk_ratio(any_i32(-(5 << 26), 5 << 26), any_i32(b, 2 * b - 1));
}

/* floor_div: |a| < 2^61, 0 < b < 2^30 */
void prove_floor_div(void)
{
    gn_edge edge;
    floor_div(any_i64(-((int64_t)1 << 61), (int64_t)1 << 61), any_i32(1, (1 << 30) - 1), &edge.q, &edge.r);
}

/* exact_begin: |coordinate| < 2^28, y0 <= 0 < y1, the row at most 2^16 from 0 */
void prove_exact_begin(void)
{
    gn_edge edge;
    const int32_t most = 1 << 28;
    for (int bits = 1; bits <= 12; bits++) {
        int32_t y0 = any_i32(-most, 0), y1 = any_i32(1, most);
        exact_begin(&edge, any_i32(-most, most), y0, any_i32(-most, most), y1, bits, any_i32(-65536, 65536));
    }
}

/* exact_next, exact_step: |q|, |dq| < 2^29, r and dr below dy */
void prove_exact_step(void)
{
    gn_edge edge = {any_i32(-(1 << 29), 1 << 29), any_i32(0, (1 << 30) - 1), any_i32(-(1 << 29), 1 << 29),
                    any_i32(0, (1 << 30) - 1), any_i32(1, 1 << 30)};
    sink = exact_step(&edge);
}

/* fixed_for: |coordinate| < 2^29 */
void prove_fixed_for(void)
{
    int32_t x[3];
    for (int i = 0; i < 3; i++) x[i] = any_i32(-(1 << 29), 1 << 29);
    for (int bits = 1; bits <= 12; bits++) sink = fixed_for(x, any_i32(0, 1 << 30), bits);
}

/* ---- lib/geometry/gn_xform.h ----------------------------------------------------------------------------------------
 */

/* gn_xform_fast_inline: what gn_xform_fast_begin leaves, by the shift, for entries up to 2^29; any position */
void prove_xform_fast(void)
{
    for (int s = 3; s <= 62; s++) {
        gn_xform_fast fast;
        int32_t position[3];
        int32_t out[3] = {0, 0, 0};
        int up = s < 32 ? 32 - s : 0, down = s > 32 ? s - 32 : 0;
        fast.up = (uint8_t)up, fast.down = (uint8_t)down, fast.reach = 1U << (31 - (up > 1 ? up : 1));
        for (int r = 0; r < 3; r++) {
            const int64_t t = any_i64(-(1 << 30) + 1, (1 << 30) - 1);
            fast.row[r].t_q16 = down ? (int32_t)t : 0;
            fast.row[r].sum = ((int64_t)1 << (31 + down)) + (down ? 0 : t * ((int64_t)1 << 32));
            for (int c = 0; c < 3; c++) fast.row[r].m[c] = any_i32(-(1 << 29), 1 << 29);
        }
        for (int i = 0; i < 3; i++) position[i] = any_i32(INT32_MIN, INT32_MAX);
        sink = gn_xform_fast_inline(out, &fast, position);
    }
}

/* ---- lib/visible/gn_screen_triangle.c -------------------------------------------------------------------------------
 */

/* snap, depth_margin: coordinates below 2^27, 1 to 12 bits */
void prove_snap(void)
{
    for (int bits = 1; bits <= 12; bits++) {
        sink = snap(any_i32(-(1 << 27), 1 << 27), bits);
        usink = depth_margin(any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX), bits);
    }
}

/* gradient: |n| < 2^60, |f| < 2^31 */
void prove_gradient(void)
{
    const int64_t most = (int64_t)1 << 60;
    int32_t out;
    for (int s = 1; s <= 62; s++) sink = gradient(&out, any_i64(-most, most), any_i32(-INT32_MAX, INT32_MAX), s);
}

static void any_projected(gn_projected *p)
{
    p->x_q16 = any_i32(-(1 << 27), 1 << 27), p->y_q16 = any_i32(-(1 << 27), 1 << 27);
    p->iz_q32 = any_u32(0, UINT32_MAX);
}

/* depth_of_corners: corners in the guard band, the pixel's centre within two pixels */
void prove_depth_of_corners(void)
{
    gn_projected c[3];
    depth_range depth;
    for (int i = 0; i < 3; i++) any_projected(&c[i]);
    depth_of_corners(&depth, &c[0], &c[1], &c[2], any_i32(-131072, 131072), any_i32(-131072, 131072));
}
