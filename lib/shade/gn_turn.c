/* Pieces of smooth surfaces. Ranges and errors: NUMERICS 4.12. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_piece.h"
#include "shade/gn_turn.h"

#if GN_TURNING

/* ---- Once per piece ---------------------------------------------------------------------------------------------- */

/* At least the length of a vector of absolute values. */
GN_HOT static uint32_t length_below(const uint32_t a[3])
{
    uint32_t most = a[0] > a[1] ? a[0] : a[1];
    if (a[2] > most) most = a[2];
    return (most + a[0] + a[1] + a[2]) >> 1;
}

/* a . b / 2^shift; components < 2^30 */
GN_HOT static int32_t dot(const int32_t a[3], const int32_t b[3], int32_t shift)
{
    return (int32_t)(gn_dot64(a, b) >> shift);
}

/* N . L, N the normal times n . ray over that of the middle: at, and by how much it changes. */
GN_HOT static void find_facing(gn_pieces *p, const int32_t at[3], const int32_t dx[3], const int32_t dy[3])
{
    for (uint32_t i = 0; i < p->surface->n_lights; i++) {
        const int32_t *to_light = p->surface->light[i].state->to_light_q30;
        gn_slope *facing = &p->turning.facing_q28[i];
        facing->at = dot(at, to_light, 30); /* < 2^28 */
        facing->dx = dot(dx, to_light, 30);
        facing->dy = dot(dy, to_light, 30);
    }
}

GN_HOT int gn_turn_select(gn_pieces *p, const gn_slope n_q28[3], uint32_t half_w, uint32_t half_h)
{
    gn_turning *t = &p->turning;
    int32_t at[3], dx[3], dy[3];
    uint32_t turned[3], along[3];
    for (int i = 0; i < 3; i++) {
        const gn_slope *n = &n_q28[i];
        if (gn_abs32(n->at) > 1U << 28 || (gn_abs32(n->dx) | gn_abs32(n->dy)) >> 27) return 0;
        at[i] = n->at;
        dx[i] = n->dx + gn_mul_high(n->at, p->w_dx_q30) * 4; /* 2^27 + 2^25 */
        dy[i] = n->dy + gn_mul_high(n->at, p->w_dy_q30) * 4;
        along[i] = gn_abs32(dx[i]) >> 12; /* Q16 */
        turned[i] = along[i] * half_w + (gn_abs32(dy[i]) >> 12) * half_h;
    }
    uint32_t size_q28 = (uint32_t)dot(at, at, 28), turned_q16 = length_below(turned);
    if (size_q28 < 1U << 26 || turned_q16 > 2U << 16) return 0;
    t->size_q28 = size_q28;
    t->size_dx = 2 * (uint32_t)dot(at, dx, 28);
    t->size_dy = 2 * (uint32_t)dot(at, dy, 28);
    t->size_dxx = (uint32_t)dot(dx, dx, 28);
    t->size_dxy = 2 * (uint32_t)dot(dx, dy, 28);
    t->size_dyy = (uint32_t)dot(dy, dy, 28);
    /* 1 / sqrt(s) is below 1 + (1 - s) 4/3 from 1/4 to 1 */
    uint32_t left_q16 = size_q28 < 1U << 28 ? ((1U << 28) - size_q28) >> 12 : 0;
    t->per_px_q16 = length_below(along) * (256 + (left_q16 >> 8) * 4 / 3) >> 8; /* 2^18 * 2^9 */
    if (turned_q16 * (turned_q16 >> 4) > size_q28 >> 2) t->per_px_q16 = 65535;  /* |N| is less than half elsewhere */
    find_facing(p, at, dx, dy);
    return 1;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* A part of a row over which vertex colours are linear. */
typedef struct {
    const gn_pieces *p;
    int32_t x, y; /* its first pixel, from the middle of the piece */
    uint32_t size_q28, size_dx;
    int32_t tint_q28[3], tint_step[3];
} tinted_row;

GN_INLINE void begin_tint(tinted_row *r, int c, int32_t n, int32_t half_right, int32_t per_w_q30)
{
    int32_t step, at = gn_colour_near(r->p, &r->p->tint_q24[c], half_right, 2 * r->y, per_w_q30, &step);
    r->tint_step[c] = step * 16;
    r->tint_q28[c] = at * 16 - step * 8 * (n - 1);
}

GN_HOT static void begin_row(tinted_row *r, const gn_pieces *p, int32_t x, int32_t y, int32_t n)
{
    const gn_turning *t = &p->turning;
    r->p = p;
    r->x = x - p->x;
    r->y = y - p->y;
    uint32_t right = (uint32_t)r->x, down = (uint32_t)r->y, slope = t->size_dx + down * t->size_dxy;
    r->size_dx = slope + 2 * right * t->size_dxx;
    r->size_q28 = t->size_q28 + right * (slope + right * t->size_dxx) + down * (t->size_dy + down * t->size_dyy);
    if (!p->tinted) {
        r->tint_q28[0] = r->tint_q28[1] = r->tint_q28[2] = 1 << 28;
        r->tint_step[0] = r->tint_step[1] = r->tint_step[2] = 0;
        return;
    }
    int32_t half_right = 2 * r->x + n - 1,
            per_w_q30 = gn_per_w((p->w_dx_q30 * half_right + p->w_dy_q30 * 2 * r->y) >> 1);
    begin_tint(r, 0, n, half_right, per_w_q30);
    begin_tint(r, 1, n, half_right, per_w_q30);
    begin_tint(r, 2, n, half_right, per_w_q30);
}

/* The colour at its pixel i, `share` of the light with the shadow let through. Returns a bit per light that shines on
 * it. */
GN_HOT static uint32_t colour_at(const tinted_row *r, int32_t i, uint32_t share_uq16, int32_t colour_q24[3])
{
    const gn_pieces *p = r->p;
    const gn_surface *s = p->surface;
    uint32_t lit = 0, n_lights = s->n_lights,
             size_q28 = r->size_q28 + (uint32_t)i * (r->size_dx + (uint32_t)i * p->turning.size_dxx);
    if (size_q28 < 65536) size_q28 = 65536;
    int32_t up = gn_clz32(size_q28) & 30;                                        /* 14 at most, for |N| of 2^-6 */
    uint32_t root = gn_rsqrt_norm(size_q28 << up, GN_K(p->frame, newton_steps)); /* 2^(33 - up / 2) / |N| */
    int32_t red = (int32_t)(s->base_q20[0] << 8), green = (int32_t)(s->base_q20[1] << 8),
            blue = (int32_t)(s->base_q20[2] << 8);
    for (uint32_t k = 0; k < n_lights; k++) { /* colours in Q28, below 2^30 and 2^-13 of that */
        int32_t facing = gn_along(&p->turning.facing_q28[k], r->x + i, r->y);
        if (facing <= 0) continue;
        lit |= 1U << (k & 31);
        int32_t cosine_q30 = gn_mul_high(facing, (int32_t)(root >> 1)) * (4 << (up >> 1)); /* 2^(28 - up / 2) */
        if ((int32_t)k == p->shadow_slot && share_uq16 < 65536)
            cosine_q30 = gn_mul_high(cosine_q30, (int32_t)(share_uq16 << 14)) * 4;
        const uint32_t *radiance_uq16 = s->light[k].radiance_uq16;
        red += 4 * gn_mul_high((int32_t)(radiance_uq16[0] << 12), cosine_q30);
        green += 4 * gn_mul_high((int32_t)(radiance_uq16[1] << 12), cosine_q30);
        blue += 4 * gn_mul_high((int32_t)(radiance_uq16[2] << 12), cosine_q30);
    }
    colour_q24[0] = gn_mul_high(red, r->tint_q28[0] + i * r->tint_step[0]);
    colour_q24[1] = gn_mul_high(green, r->tint_q28[1] + i * r->tint_step[1]);
    colour_q24[2] = gn_mul_high(blue, r->tint_q28[2] + i * r->tint_step[2]);
    return lit;
}

GN_HOT static uint32_t lit_fraction(const gn_pieces *p, uint32_t attenuation)
{
    return p->turning.keep_uq16 + ((65536 - p->turning.keep_uq16) * (attenuation >> 1) >> 15);
}

/* From one colour to another, `ahead` pixels further on: 1 to 16, or a power of two. */
GN_HOT static inline void ramp_steps(gn_ramp *ramp, const int32_t to_q24[3], int32_t ahead)
{
    const int32_t *from = ramp->from_q24;
    int32_t *step = ramp->step_q24, log2 = 31 - gn_clz32((uint32_t)ahead);
    if (ahead & (ahead - 1)) {
        for (int c = 0; c < 3; c++) step[c] = gn_step_of(from[c], to_q24[c], ahead);
        return;
    }
    for (int c = 0; c < 3; c++) step[c] = (to_q24[c] - from[c]) >> log2;
}

/* Ramps as long as they may be, shorter where a light begins or ends to shine. One ends where the next begins, the last
 * on its last pixel. */
GN_HOT static void ramps(const tinted_row *r, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t n,
                         uint32_t share)
{
    gn_ramp ramp;
    int32_t *from = ramp.from_q24, to[3];
    uint32_t lit = colour_at(r, 0, share, from), lit_there;
    for (int32_t i = 0; i < n;) {
        int32_t left = n - i, length = r->p->ramp_px, ahead;
        if (left == 1) {
            gn_pixel_dot(r->p->frame, rows, x + i, y, from);
            return;
        }
        if (left <= length && left <= 17) length = left;
        while (length > left) length >>= 1;
        ahead = length - (length == left && left <= 17);
        while ((lit_there = colour_at(r, i + ahead, share, to)) != lit && ahead > 1) length = ahead >>= 1;
        if (ahead == 1 && lit_there != lit) length = 1;
        ramp_steps(&ramp, to, ahead);
        gn_pixel_ramp(r->p->frame, rows, x + i, y, length, &ramp);
        for (int c = 0; c < 3; c++) from[c] = to[c];
        lit = lit_there;
        i += length;
    }
}

GN_HOT static void each_pixel(const tinted_row *r, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t i,
                              int32_t n, const uint32_t *attenuation, uint32_t share)
{
    for (; n > 0; n--, i++) {
        int32_t colour[3];
        colour_at(r, i, attenuation ? lit_fraction(r->p, attenuation[i]) : share, colour);
        gn_pixel_dot(r->p->frame, rows, x + i, y, colour);
    }
}

/* Without the light that casts a shadow, or with what is left of it. */
GN_HOT static void dark_at(const tinted_row *r, int32_t i, int32_t colour_q24[3])
{
    const gn_surface *s = r->p->surface;
    if (s->n_lights > 1 || r->p->turning.keep_uq16) {
        colour_at(r, i, r->p->turning.keep_uq16, colour_q24);
        return;
    }
    for (int c = 0; c < 3; c++)
        colour_q24[c] = gn_mul_high((int32_t)(s->base_q20[c] << 8), r->tint_q28[c] + i * r->tint_step[c]);
}

/* n <= 17 pixels from i on, no longer than a ramp, each as far between two ramps as its light is let through. */
GN_HOT static void mixed_row(const tinted_row *r, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t i, int32_t n,
                             const uint32_t *attenuation)
{
    gn_ramp dark, lit;
    int32_t ahead = n - 1, dark_to[3], lit_to[3];
    if (n < 3 || colour_at(r, i, 65536, lit.from_q24) != colour_at(r, i + ahead, 65536, lit_to)) {
        each_pixel(r, rows, y, x, i, n, attenuation, 0);
        return;
    }
    dark_at(r, i, dark.from_q24);
    dark_at(r, i + ahead, dark_to);
    ramp_steps(&dark, dark_to, ahead);
    ramp_steps(&lit, lit_to, ahead);
    gn_pixel_mix(r->p->frame, rows, x + i, y, n, &dark, &lit, attenuation + i);
}

GN_HOT void gn_turn_row(const gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t n,
                        const uint32_t *attenuation, int all)
{
    uint32_t share = lit_fraction(p, all ? 65536 : 0);
    tinted_row r;
    for (int32_t end = x + n; x < end; x += n) {
        n = gn_min32(end - x, p->tint_px);
        begin_row(&r, p, x, y, n);
        if (p->ramp_px < 4) each_pixel(&r, rows, y, x, 0, n, attenuation, share);
        else if (!attenuation) ramps(&r, rows, y, x, n, share);
        else
            for (int32_t i = 0; i < n; i += p->ramp_px)
                mixed_row(&r, rows, y, x, i, gn_min32(n - i, p->ramp_px), attenuation);
        if (attenuation) attenuation += n;
    }
}

#endif
