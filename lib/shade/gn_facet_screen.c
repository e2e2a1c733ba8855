/* A small triangle on the screen. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_facet_screen.h"

#if GN_INTERPOLATES

/* Half pixels from the picture's centre, as rays have them, Q12. Returns 0 far outside. */
GN_HOT static int vertex_on_screen(const gn_frame *frame, const int32_t v_q16[3], int32_t p_q12[2])
{
    int32_t z = v_q16[2], clz = gn_clz32((uint32_t)z), focal2 = (int32_t)frame->cam.focal2_px_q16;
    if (clz < 2 || gn_abs32(v_q16[0]) >> 1 >= (uint32_t)z || gn_abs32(v_q16[1]) >> 1 >= (uint32_t)z) return 0;
    int32_t half = (int32_t)(gn_recip_norm((uint32_t)z << clz, GN_K(frame, newton_steps)) >> 1);
    for (int i = 0; i < 2; i++) { /* (x / z)_q28 times 2 F */
        int64_t p = (int64_t)gn_mul_high(v_q16[i] * (1 << (clz - 2)), half) * focal2 >> 32;
        p_q12[i] = (int32_t)p;
        if (p != p_q12[i]) return 0;
    }
    return 1;
}

GN_HOT int gn_facet_screen_find(gn_facet_screen *out, const gn_frame *frame, const gn_surface *s, const gn_rect *box)
{
    int32_t p[3][2], d[3][2];
    uint32_t longest = 0;
    if (s->z_max_q16 - s->z_min_q16 > s->z_min_q16 >> 3 || frame->cam.focal2_px_q16 >> 31) return 0;
    for (int k = 0; k < 3; k++) {
        if (s->v_q16[k][2] < frame->cam.near_q16 || !vertex_on_screen(frame, s->v_q16[k], p[k])) return 0;
        for (int i = 0; i < 2; i++) {
            d[k][i] = p[k][i] - p[0][i];
            longest = gn_abs32(d[k][i]) > longest ? gn_abs32(d[k][i]) : longest;
        }
    }
    if (longest > GN_FACET_PX << 13) return 0;
    int64_t area = (int64_t)d[1][0] * d[2][1] - (int64_t)d[1][1] * d[2][0]; /* Q24, 2^35 */
    uint64_t size = gn_abs64(area);
    if (size >> 12 < longest || !size) return 0;
    int32_t clz = gn_clz64(size),
            recip = (int32_t)(gn_recip_norm((uint32_t)(size << clz >> 32), GN_K(frame, newton_steps)) >> 1);
    if (area < 0) recip = -recip;
    for (int i = 0; i < 2; i++) { /* 2 d / area */
        out->along_q24[i][0] = (int32_t)((int64_t)d[2][1 - i] * recip >> (57 - clz));
        out->along_q24[i][1] = -(int32_t)((int64_t)d[1][1 - i] * recip >> (57 - clz));
    }
    out->to_first_q13[0] = (2 * box->x0 + 1 - frame->picture.width) * 4096 - p[0][0];
    out->to_first_q13[1] = p[0][1] - (frame->picture.height - 1 - 2 * box->y0) * 4096;
    out->box = box;
    out->steep = 0;
    return 1;
}

#define STEEP (1 << 23)

GN_HOT GN_NOINLINE void gn_facet_slope(gn_facet_screen *screen, gn_slope *out, int32_t at0, int32_t at1, int32_t at2)
{
    int32_t slope[2], a = at1 - at0, b = at2 - at0;
    const int32_t *first = screen->to_first_q13;
    for (int i = 0; i < 2; i++) {
        int64_t v = ((int64_t)a * screen->along_q24[i][0] + (int64_t)b * screen->along_q24[i][1]) >> 24;
        if (v >= STEEP || v <= -STEEP) v = 0, screen->steep = 1;
        slope[i] = (int32_t)v;
    }
    out->at = at0 + (int32_t)(((int64_t)slope[0] * first[0] + (int64_t)slope[1] * first[1]) >> 13);
    out->dx = slope[0];
    out->dy = slope[1];
}

#endif
