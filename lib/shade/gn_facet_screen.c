/* A small triangle on the screen. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_facet_screen.h"

#if GN_INTERPOLATES

/* Half pixels from the picture's centre, as rays have them, Q12. Returns 0 far outside. */
GN_HOT static int vertex_on_screen(const gn_frame *frame, const int32_t v_q16[3], int32_t p_q12[2])
{
    int32_t z = GN_FLAT_Q16(frame) ? GN_FLAT_Q16(frame) : v_q16[2], clz = gn_clz32((uint32_t)z),
            focal2 = (int32_t)frame->cam.focal2_px_q16;
    if (clz < 2 || gn_abs32(v_q16[0]) >> 1 >= (uint32_t)z || gn_abs32(v_q16[1]) >> 1 >= (uint32_t)z) return 0;
    int32_t half = (int32_t)(gn_recip_norm((uint32_t)z << clz, GN_K(frame, newton_steps)) >> 1);
    GN_KEEP(half); /* signed: one multiplication */
    GN_KEEP(focal2);
    GN_UNROLL
    for (int i = 0; i < 2; i++) /* (x / z)_q28 times 2 F */
        p_q12[i] = gn_mul_high(gn_mul_high(v_q16[i] * (1 << (clz - 2)), half), focal2);
    return 1;
}

/* v / 2^(32 - up), -32 < up < 32, which fits */
GN_HOT static inline int32_t upper_32(int64_t v, int32_t up)
{
    if (up <= 0) return (int32_t)(v >> 32) >> -up;
    return (int32_t)((uint32_t)((uint64_t)v >> 32) << up | (uint32_t)v >> (32 - up));
}

/* Returns 0 if the triangle does not fit. */
GN_HOT static GN_NOINLINE int find_screen(gn_facet_screen *out, const gn_frame *frame, const gn_surface *s)
{
    int32_t p[3][2], d[3][2];
    uint32_t longest = 0;
    if (frame->cam.focal2_px_q16 >> 31) return 0;
    if (!GN_FLAT_Q16(frame) && s->z_max_q16 - s->z_min_q16 > s->z_min_q16 >> 2) return 0;
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        if (s->v_q16[k][2] < frame->cam.near_q16 || !vertex_on_screen(frame, s->v_q16[k], p[k])) return 0;
        GN_UNROLL
        for (int i = 0; i < 2; i++) {
            d[k][i] = p[k][i] - p[0][i];
            longest = gn_abs32(d[k][i]) > longest ? gn_abs32(d[k][i]) : longest;
        }
    }
    if (longest > (uint32_t)gn_facet_most_px(s) << 13) return 0;
    out->size_log2 = (int8_t)(longest <= 16 << 13 ? 0 : longest <= 32 << 13 ? 1 : 2);
    /* perspective bends by a quarter of the change of depth: up to a pixel along the longest, as of 16 pixels */
    out->bent = !GN_FLAT_Q16(frame) && (uint64_t)(longest >> 13) * (uint32_t)(s->z_max_q16 - s->z_min_q16) >
                                           4 * (uint64_t)(uint32_t)s->z_min_q16;
    int64_t area = (int64_t)d[1][0] * d[2][1] - (int64_t)d[1][1] * d[2][0]; /* Q24, 2^39 */
    uint64_t size = gn_abs64(area);
    if (size >> 12 < longest || !size) return 0; /* 2^12 to 2^40, and 2^12 of what is longest */
    int32_t clz = gn_clz64(size),
            recip = (int32_t)(gn_recip_norm((uint32_t)(size << clz >> 32), GN_K(frame, newton_steps)) >> 1);
    if (area < 0) recip = -recip;
    GN_UNROLL
    for (int i = 0; i < 2; i++) { /* 2 d / area */
        out->along_q24[i][0] = upper_32((int64_t)d[2][1 - i] * recip, clz - 25);
        out->along_q24[i][1] = -upper_32((int64_t)d[1][1 - i] * recip, clz - 25);
    }
    int32_t x = p[0][0] + frame->picture.width * 4096, y = frame->picture.height * 4096 - p[0][1];
    out->x0 = x >> 13;
    out->y0 = y >> 13;
    out->to_first_q13[0] = out->x0 * 8192 + 4096 - x;
    out->to_first_q13[1] = out->y0 * 8192 + 4096 - y;
    return 1;
}

GN_HOT int gn_facet_screen_use(gn_facet_screen *screen, const gn_frame *frame, const gn_surface *surface)
{
    if (!screen->found) screen->found = (int8_t)(find_screen(screen, frame, surface) ? 1 : -1);
    return screen->found > 0;
}

GN_HOT GN_NOINLINE void gn_facet_slope(gn_facet_screen *screen, gn_slope *out, const int32_t at[3])
{
    int32_t slope[2], a = at[1] - at[0], b = at[2] - at[0];
    const int32_t *first = screen->to_first_q13;
    for (int i = 0; i < 2; i++) {
        int64_t v = (int64_t)a * screen->along_q24[i][0] + (int64_t)b * screen->along_q24[i][1];
        if ((uint32_t)((int32_t)(v >> 32) + (1 << 15)) >> 16) v = 0, screen->steep = 1; /* 2^23 per pixel */
        slope[i] = (int32_t)((v + (1 << 23)) >> 24);
    }
    out->at = at[0] + (int32_t)(((int64_t)slope[0] * first[0] + (int64_t)slope[1] * first[1]) >> 13);
    out->dx = slope[0];
    out->dy = slope[1];
}

#define CURVED (1 << 22) /* changes of changes */

/* With b0 = 1 - b1 - b2: m01 b0 b1 + m02 b0 b2 + m12 b1 b2 = m01 b1 + m02 b2 - m01 b1^2 - m02 b2^2 + (m12 - m01 - m02)
 * b1 b2. */
GN_HOT void gn_facet_curve_find(gn_facet_screen *screen, gn_facet_curve *out, const int32_t at[3],
                                const int32_t above[3])
{
    const int32_t *gx = screen->along_q24[0], *gy = screen->along_q24[1];
    const int32_t m[3] = {-above[0], -above[1], above[2] - above[0] - above[1]};
    const int32_t ends[3] = {at[0], at[1] + above[0], at[2] + above[1]};
    const int64_t b1x = (int64_t)m[0] * gx[0] + (((int64_t)m[2] * gx[1]) >> 1), /* half of what b1 and b2 change by */
        b2x = (int64_t)m[1] * gx[1] + (((int64_t)m[2] * gx[0]) >> 1),
                  b1y = (int64_t)m[0] * gy[0] + (((int64_t)m[2] * gy[1]) >> 1),
                  b2y = (int64_t)m[1] * gy[1] + (((int64_t)m[2] * gy[0]) >> 1);
    const int32_t first[2] = {(int32_t)(b1x >> 24), (int32_t)(b2x >> 24)},
                  second[2] = {(int32_t)(b1y >> 24), (int32_t)(b2y >> 24)};
    const int64_t sum[3] = {((int64_t)first[0] * gx[0] + (int64_t)first[1] * gx[1] + (1 << 23)) >> 24,
                            ((int64_t)first[0] * gy[0] + (int64_t)first[1] * gy[1] + (1 << 22)) >> 23,
                            ((int64_t)second[0] * gy[0] + (int64_t)second[1] * gy[1] + (1 << 23)) >> 24};
    int32_t v[3];
    gn_facet_slope(screen, &out->line, ends);
    for (int i = 0; i < 3; i++) {
        v[i] = (int32_t)sum[i];
        if (sum[i] >= CURVED || sum[i] <= -CURVED) v[i] = 0, screen->steep = 1;
    }
    const int64_t x = screen->to_first_q13[0], y = screen->to_first_q13[1];
    const int32_t at_x = (int32_t)((v[0] * x + v[1] * y) >> 13), at_y = (int32_t)(v[2] * y >> 13);
    out->line.at += (int32_t)((at_x * x + at_y * y) >> 13);
    out->line.dx += at_x + (int32_t)(v[0] * x >> 13);
    out->line.dy += 2 * at_y + (int32_t)(v[1] * x >> 13);
    out->xx = v[0];
    out->xy = v[1];
    out->yy = v[2];
}

GN_HOT void gn_facet_lengths(const gn_facet_curve *length2_q22, int32_t right, int32_t down, int32_t n,
                             uint32_t *out_q30)
{
    gn_facet_row row = gn_facet_row_of(length2_q22, right, down);
    for (int32_t i = 0; i < n; i++) {
        uint32_t v = (uint32_t)gn_max32(1 << 20, gn_min32(row.at, (1 << 22) - 1)); /* 1/3 and more on the triangle */
        uint32_t y_q31 = (uint32_t)gn_rsqrt_entry((v >> 14) - 64U) << 16;
        out_q30[i] = gn_umul_high(y_q31, (3U << 30) - gn_umul_high(v << 10, gn_umul_high(y_q31, y_q31)));
        row.at = (int32_t)((uint32_t)row.at + (uint32_t)row.step); /* beyond the row they go anywhere */
        row.step = (int32_t)((uint32_t)row.step + (uint32_t)row.change);
    }
}

GN_HOT void gn_facet_tint(int32_t (*node)[3], int32_t n, const gn_slope tint_q16[3], int32_t right, int32_t down)
{
    int32_t r = gn_facet_at(&tint_q16[0], right, down), g = gn_facet_at(&tint_q16[1], right, down),
            b = gn_facet_at(&tint_q16[2], right, down);
    const int32_t dr = tint_q16[0].dx, dg = tint_q16[1].dx, db = tint_q16[2].dx;
    for (int32_t(*end)[3] = node + n; node < end; node++, r += dr, g += dg, b += db) {
        (*node)[0] = gn_facet_tinted((*node)[0], r);
        (*node)[1] = gn_facet_tinted((*node)[1], g);
        (*node)[2] = gn_facet_tinted((*node)[2], b);
    }
}

#endif
