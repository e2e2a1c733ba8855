/* Surfaces piece by piece. Scales and errors: NUMERICS 4.12. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_bias.h"
#include "shade/gn_piece.h"
#include "shade/gn_turn.h"
#include "shadow/gn_filter.h"

#if GN_PIECES

GN_HOT int32_t gn_step_of(int32_t a, int32_t b, int32_t n)
{
    static const uint32_t inverse[17] = {0,           0xFFFFFFFFU, 0x80000000U, 0x55555555U, 0x40000000U, 0x33333333U,
                                         0x2AAAAAAAU, 0x24924924U, 0x20000000U, 0x1C71C71CU, 0x19999999U, 0x1745D174U,
                                         0x15555555U, 0x13B13B13U, 0x12492492U, 0x11111111U, 0x10000000U};
    uint32_t d = b < a ? (uint32_t)a - (uint32_t)b : (uint32_t)b - (uint32_t)a;
    int32_t size = (int32_t)((uint64_t)d * inverse[n] >> 32);
    return b < a ? -size : size;
}

/* ---- Once per surface -------------------------------------------------------------------------------------------- */

/* A linear form of view space, at least 2^29 long, on the screen: at the middle of `rect` times 2^-shift. Returns 0 if
 * it leaves +-2^31 within `rect`, as it does everywhere with a small shift. */
GN_HOT static int form_on_screen(gn_slope *out, const gn_pieces *p, const int32_t form[3], int32_t shift,
                                 const gn_rect *rect)
{
    const gn_frame *frame = p->frame;
    int32_t px = 2 * p->ref_x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * p->ref_y, s = shift - 17;
    if (s < 1 || s > 45) return 0;
    int64_t at = gn_plane_at(form, px, py, frame->cam.focal2_px_q16) >> (s + 16);
    if (at != (int32_t)at) return 0;
    s = gn_min32(s, 31);
    out->at = ((int32_t)at + 1) >> 1;
    out->dx = ((form[0] >> (s - 1)) + 1) >> 1;
    out->dy = -(((form[1] >> (s - 1)) + 1) >> 1);
    uint32_t dx = gn_abs32(out->dx), dy = gn_abs32(out->dy), w = (uint32_t)(rect->x1 - rect->x0),
             h = (uint32_t)(rect->y1 - rect->y0);
    return gn_abs32(out->at) < 1U << 30 && (dx | dy) < 1U << 28 && (uint64_t)dx * w + (uint64_t)dy * h < 1U << 30;
}

/* Forms of the surface at a common scale, at which n . ray is below 2^27 on the triangle. */
GN_HOT static int forms(gn_pieces *p, const gn_rect *rect)
{
    const gn_surface *s = p->surface;
    int32_t shift = s->depth_scale.exp + 32 - (31 - gn_clz32((uint32_t)s->z_min_q16)) - 27;
    p->z_shift = 31 + shift - s->depth_scale.exp;
    p->ref_x = (rect->x0 + rect->x1) >> 1;
    p->ref_y = (rect->y0 + rect->y1) >> 1;
    if (!form_on_screen(&p->w, p, s->plane.n, shift, rect)) return 0;
    for (int k = 0; s->has_bary && k < 2; k++)
        if (!form_on_screen(&p->b[k], p, s->bary.form[k], shift - s->bary.exp[k], rect)) return 0;
    return 1;
}

#if GN_SHADOWS
/* Whether the offset of the only light with a shadow is linear in the interpolated normal. */
GN_HOT static int shadow_light(gn_pieces *p)
{
    const gn_frame *frame = p->frame;
    const gn_surface *s = p->surface;
    const gn_surface_light *light = &s->light[p->shadow_slot];
    const gn_light *scene_light = &frame->scene->lights[light->idx];
    const gn_light_view *view = &frame->view[light->state->view_idx];
    if (!view->border_lit) view += frame->last_cascade;
    if (view->perspective || view->filter == GN_FILTER_DISK) return 0;
    if (GN_RECEIVER_PLANE && scene_light->receiver_plane) return 0;
    for (int i = 0; i < 3; i++) p->offset_q16[i] = GN_SMOOTH(s) ? 0 : light->flat_offset_q16[i];
    const int32_t *b = scene_light->bias_receiver_q16;
    return !GN_SMOOTH(s) || !GN_RECEIVER_BIAS || light->state->auto_bias || !(b[0] | b[1] | b[3]);
}

/* The light whose shadow may fall here. Returns 0 if there are several. */
GN_HOT static int find_shadow(gn_pieces *p)
{
    const gn_surface *s = p->surface;
    for (uint32_t i = 0; s->shadowed && i < s->n_lights; i++) {
        if (s->light[i].state->view_idx < 0 || !s->light[i].state->strength_uq16) continue;
        if (p->shadow_slot >= 0) return 0;
        p->shadow_slot = (int32_t)i;
    }
    return p->shadow_slot < 0 || shadow_light(p);
}
#endif

/* Light of all lamps together, from straight ahead, that 32 bits of colours in Q24 are made for: 4. Factors that are
 * found between vertices, cosines and colours of vertices, stay within +-2 all over a piece (stays_within_2): 2^27 for
 * what arrives, 2^28 times a colour, and a row of that, stepped from end to end, below 2^30. */
#define GN_PIECE_LIGHT_Q20 (1U << 22)

GN_HOT int gn_pieces_fit(const gn_frame *frame, const gn_surface *s)
{
    if (GN_K(frame, persp_step) == 1 || frame->picture.format == GN_FORMAT_RAW32) return 0;
    if ((s->textured | s->masked | s->baked | s->specular) || s->n_punctual || s->plane.det <= 0) return 0;
    for (int c = 0; c < 3; c++) {
        uint64_t all_q20 = s->base_q20[c]; /* < 2^30, and 2^36 per light */
        for (uint32_t i = 0; i < s->n_lights; i++) all_q20 += (uint64_t)s->light[i].radiance_uq16[c] << 4;
        if (all_q20 >= GN_PIECE_LIGHT_Q20) return 0;
    }
    return 1;
}

GN_HOT int gn_pieces_begin(gn_pieces *p, const gn_frame *frame, const gn_surface *s, const gn_rect *rect)
{
    p->frame = frame;
    p->surface = s;
    p->shadow_slot = -1;
#if GN_SHADOWS
    if (!find_shadow(p)) return 0;
#endif
    return forms(p, rect);
}

/* ---- Once per piece ---------------------------------------------------------------------------------------------- */

/* The surface in the middle of a piece. */
typedef struct {
    uint32_t recip; /* 2^63 / (w << clz) */
    int32_t clz;
    int32_t z_q16;
    gn_slope b_q28[2];
    gn_slope n_q28[3];          /* interpolated normal of smooth surfaces */
    int32_t w_dx_q30, w_dy_q30; /* change of w per pixel, relative to w */
} middle;

GN_HOT static int32_t piece_depth(const gn_pieces *p, uint32_t recip, int32_t clz)
{
    int32_t shift = p->z_shift - clz;
    uint32_t z = (uint32_t)((uint64_t)p->surface->depth_scale.mant * recip >> 32);
    if (shift < 1) return p->surface->z_max_q16;
    z = shift > 31 ? 0 : ((z >> (shift - 1)) + 1) >> 1;
    return gn_max32(gn_min32((int32_t)(z & INT32_MAX), p->surface->z_max_q16), p->surface->z_min_q16);
}

/* Returns 0 where the plane is seen too steeply. */
GN_HOT static int find_middle(const gn_pieces *p, middle *m)
{
    int32_t dx = p->x - p->ref_x, dy = p->y - p->ref_y;
    int32_t w = gn_along(&p->w, dx, dy);
    if (w < 1 << 10 || w >= 1 << 28) return 0;
    if (gn_abs32(p->w.dx) > (uint32_t)w >> 3 || gn_abs32(p->w.dy) > (uint32_t)w >> 3) return 0;
    m->clz = gn_clz32((uint32_t)w);
    m->recip = gn_recip_norm((uint32_t)w << m->clz, GN_K(p->frame, newton_steps));
    m->z_q16 = piece_depth(p, m->recip, m->clz);
    int32_t half = (int32_t)(m->recip >> 1); /* 2^62 / (w << clz) */
    m->w_dx_q30 = gn_mul_high(p->w.dx, half) * (1 << m->clz);
    m->w_dy_q30 = gn_mul_high(p->w.dy, half) * (1 << m->clz);
    for (int k = 0; p->surface->has_bary && k < 2; k++) {
        const gn_slope *b = &p->b[k];
        int32_t at = gn_along(b, dx, dy), up = 1 << (m->clz - 2);
        uint32_t most = (uint32_t)w + ((uint32_t)w >> 1); /* within +-3/2, and slopes, with what w adds, +-27/16 */
        if (gn_abs32(at) >= most || gn_abs32(b->dx) >= most || gn_abs32(b->dy) >= most) return 0;
        gn_slope *out = &m->b_q28[k];
        out->at = gn_mul_high(at, half) * up;
        out->dx = gn_mul_high(b->dx, half) * up - gn_mul_high(out->at, m->w_dx_q30) * 4;
        out->dy = gn_mul_high(b->dy, half) * up - gn_mul_high(out->at, m->w_dy_q30) * 4;
    }
    return 1;
}

/* v0 + b1 d1 + b2 d2 with `drop` of the 28 fraction bits of b dropped, on to the unit of v0. With |v0| <= 1 and |d| <=
 * 2 in that unit it is within +-7, its slopes within +-6.75: below 2^31 for a unit of 2^28. */
GN_HOT static gn_slope piece_slope(const middle *m, int32_t v0, int32_t d1, int32_t d2, int32_t drop)
{
    const gn_slope *a = &m->b_q28[0], *b = &m->b_q28[1];
    gn_slope out = {v0 + (int32_t)(((int64_t)a->at * d1 + (int64_t)b->at * d2) >> drop),
                    (int32_t)(((int64_t)a->dx * d1 + (int64_t)b->dx * d2) >> drop),
                    (int32_t)(((int64_t)a->dy * d1 + (int64_t)b->dy * d2) >> drop)};
    return out;
}

/* Times a factor below 8; c stays within +-2. */
GN_HOT static gn_slope times_q24(const gn_slope *c, int32_t factor)
{
    gn_slope out = {gn_mul_q24(factor, c->at), gn_mul_q24(factor, c->dx), gn_mul_q24(factor, c->dy)};
    return out;
}

/* Half the sides of a piece, in pixels. */
typedef struct {
    uint32_t w, h;
} half_size;

/* By how much a value changes from the middle of a piece to its corners, without the lower `drop` bits. Halves are at
 * most 32 and 4: it fits for slopes below 2^26, or 2^31 with 5 bits dropped. */
GN_HOT static uint32_t change_of(const gn_slope *s, half_size half, int32_t drop)
{
    return (gn_abs32(s->dx) >> drop) * half.w + (gn_abs32(s->dy) >> drop) * half.h;
}

/* A factor in Q24, its slopes as piece_slope() leaves them. */
GN_HOT static int stays_within_2(const gn_slope *factor, half_size half)
{
    return (gn_abs32(factor->at) >> 8) + change_of(factor, half, 8) <= 2U << 16;
}

/* How far linear colours may stray from the true ones: 2^-this. */
GN_HOT static int32_t tolerance_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 16 ? 7 : GN_K(frame, persp_step) == 8 ? 9 : 10;
}

#if GN_VERTEX_NORMALS
/* The interpolated normal in the middle, Q28; what is outside of +-1 there is looked at no further. */
GN_HOT static void find_normal(const gn_surface *s, middle *m)
{
    for (int i = 0; i < 3; i++)
        m->n_q28[i] = piece_slope(m, s->normal_q30[0][i] / 4, s->normal_q30[1][i], s->normal_q30[2][i], 30);
}
#endif

/* All of it within GN_PIECE_LIGHT_Q20 times 2. */
GN_HOT static void piece_add_light(gn_slope *sum, uint32_t colour_uq16, const gn_slope *cosine_q24)
{
    sum->at += (int32_t)((int64_t)(int32_t)colour_uq16 * cosine_q24->at >> 16);
    sum->dx += (int32_t)((int64_t)(int32_t)colour_uq16 * cosine_q24->dx >> 16);
    sum->dy += (int32_t)((int64_t)(int32_t)colour_uq16 * cosine_q24->dy >> 16);
}

/* What arrives without the light that casts a shadow, and with all of its. Returns 0 if that is not close to linear. */
GN_HOT static int arriving(gn_pieces *p, const middle *m, half_size half)
{
    const gn_surface *s = p->surface;
    (void)m, (void)half;
    for (int c = 0; c < 3; c++) {
        gn_slope dark = {(int32_t)(s->base_q20[c] << 4), 0, 0};
        p->dark[c].slope_q24 = p->lit[c].slope_q24 = dark;
    }
    for (uint32_t i = 0; i < s->n_lights; i++) {
        const gn_surface_light *light = &s->light[i];
        gn_slope facing = {light->cosine_q24[0], 0, 0};
#if GN_VERTEX_NORMALS && (GN_RUNTIME_KNOBS || GN_VERTEX_LIGHT)
        const int32_t *at = light->cosine_q24;
        if (GN_SMOOTH(s)) facing = piece_slope(m, at[0], at[1], at[2], 28);
        if (!stays_within_2(&facing, half)) return 0;
#endif
        for (int c = 0; c < 3; c++) {
            piece_add_light(&p->lit[c].slope_q24, light->radiance_uq16[c], &facing);
            if ((int32_t)i != p->shadow_slot) piece_add_light(&p->dark[c].slope_q24, light->radiance_uq16[c], &facing);
        }
    }
    return 1;
}

/* Times the vertices' colours. Two values that both change are multiplied row by row. */
GN_HOT static int piece_colours(gn_pieces *p, middle *m, half_size half)
{
    const gn_surface *s = p->surface;
    p->tinted = GN_COLOURED(s) && GN_SMOOTH(s);
    p->turns = 0;
#if GN_VERTEX_NORMALS
    if (GN_SMOOTH(s)) find_normal(s, m);
#endif
#if GN_TURNING
    p->turns = GN_SMOOTH(s) && !GN_K(p->frame, vertex_light);
    p->turning.keep_uq16 = 65536;
#endif
    if (!p->turns && !arriving(p, m, half)) return 0;
#if GN_TURNING
    if (p->turns && !gn_turn_select(p, m->n_q28, half.w, half.h)) return 0;
#endif
    for (int c = 0; GN_COLOURED(s) && c < 3; c++) {
        gn_slope colour =
            piece_slope(m, s->attribute_q16[0][GN_ATTRIBUTE_RGB + c] * 256, s->attribute_q16[1][GN_ATTRIBUTE_RGB + c],
                        s->attribute_q16[2][GN_ATTRIBUTE_RGB + c], 20);
        if (!stays_within_2(&colour, half)) return 0;
        p->tint_q24[c] = colour;
        if (p->tinted) continue; /* else what arrives is the same all over */
        p->dark[c].slope_q24 = times_q24(&colour, p->dark[c].slope_q24.at);
        p->lit[c].slope_q24 = times_q24(&colour, p->lit[c].slope_q24.at);
    }
    return 1;
}

/* Whether w changes by at most an eighth over half a piece. */
GN_HOT static int piece_is_uniform(const gn_pieces *p, half_size half)
{
    return (uint64_t)gn_abs32(p->w_dx_q30) * half.w + (uint64_t)gn_abs32(p->w_dy_q30) * half.h <= 1U << 27;
}

/* How many pixels n a ramp may have, a power of two, if it bends by n^2 / 4 of `bend`: n^2 / 4 of that is below 2^(46 -
 * tolerance). */
GN_HOT static int32_t longest_ramp(uint64_t bend_q46, int32_t tolerance, int32_t least_log2)
{
    int32_t bits = 64 - gn_clz64(bend_q46 | 1U), log2 = (48 - tolerance - bits) >> 1;
    if (log2 < 1) least_log2 = 0; /* 4 pixels would bend by more than 4 times the tolerance */
    return 1 << gn_max32(least_log2, gn_min32(log2, GN_PIECE_WIDTH_LOG2));
}

#if GN_TURNING
/* How long ramps may be where normals turn: over n pixels a colour bends by a quarter of the product of what it and w,
 * relative to w, or two factors change over them, and a cosine by an eighth of the square of the angle. Returns 0 if
 * something changes too fast. */
GN_HOT static int turning_ramps(gn_pieces *p)
{
    int32_t tolerance = tolerance_log2(p->frame);
    uint32_t fastest = 0, product = 0, turn = p->turning.per_px_q16;
    for (int c = 0; p->tinted && c < 3; c++) {
        uint32_t tint_dx = gn_abs32(p->tint_q24[c].dx) >> 8; /* Q16 */
        if ((tint_dx | turn) >> 16) return 0;
        product = (uint32_t)gn_max32((int32_t)product, (int32_t)(turn * (tint_dx >> 2))); /* Q30 */
        if (tint_dx > fastest) fastest = tint_dx;
    }
    uint64_t bend_q46 = (uint64_t)fastest * gn_abs32(p->w_dx_q30);
    p->tint_px = longest_ramp(bend_q46, tolerance, 2);
    p->ramp_px = longest_ramp(bend_q46 + ((uint64_t)product << 16) + ((uint64_t)turn * turn << 13), tolerance, 0);
    return 1;
}
#endif

/* v or -1 - v, whichever is not negative: what several have set together is at least all of them, and less than twice
 * the largest. */
GN_HOT static inline uint32_t size_of(int32_t v)
{
    return (uint32_t)(v ^ (v >> 31));
}

/* How steep several slopes are, at most. */
typedef struct {
    uint32_t dx, dy;
} steepness;

GN_HOT static inline void include(steepness *all, const gn_slope *s)
{
    all->dx |= size_of(s->dx);
    all->dy |= size_of(s->dy);
}

/* A colour times that of the vertices. Slopes of factors are below 1 per pixel, and within 8 and 2 at the place: those
 * of the product below 2^28. */
GN_HOT static void tint_curve(gn_curve *curve, const gn_slope *tint)
{
    gn_slope *s = &curve->slope_q24;
    if (!(s->dx | s->dy)) { /* ambient light */
        *s = times_q24(tint, s->at);
        return;
    }
    int32_t at = s->at, dx = s->dx * 64, dy = s->dy * 64, tint_dx = tint->dx * 64, tint_dy = tint->dy * 64;
    s->at = gn_mul_q24(at, tint->at);
    s->dx = gn_mul_q24(at, tint->dx) + gn_mul_q24(s->dx, tint->at);
    s->dy = gn_mul_q24(at, tint->dy) + gn_mul_q24(s->dy, tint->at);
    curve->dxx_q28 = gn_mul_high(dx, tint_dx);
    curve->dxy_q28 = gn_mul_high(dx, tint_dy) + gn_mul_high(dy, tint_dx);
    curve->dyy_q28 = gn_mul_high(dy, tint_dy);
}

/* What perspective adds: g / (1 + t) is g - g t to the second order. */
GN_HOT static void bend_curve(const gn_pieces *p, gn_curve *curve)
{
    int32_t dx = curve->slope_q24.dx * 8, dy = curve->slope_q24.dy * 8, w_dx = p->w_dx_q30 * 8, w_dy = p->w_dy_q30 * 8;
    curve->dxx_q28 -= gn_mul_high(dx, w_dx);
    curve->dxy_q28 -= gn_mul_high(dx, w_dy) + gn_mul_high(dy, w_dx);
    curve->dyy_q28 -= gn_mul_high(dy, w_dy);
}

/* By how much values change from the middle of a piece to its corners, Q16. */
GN_HOT static inline uint32_t change_q16(const steepness *s, half_size half)
{
    return (s->dx >> 8) * half.w + (s->dy >> 8) * half.h;
}

/* Whether what lies beyond the second order, g t^2 / (1 + t), and up to 5/2 t times the product of the factors'
 * changes, is within the tolerance all over a piece. */
GN_HOT static int curves_hold(const gn_pieces *p, const steepness *light, const steepness *tint, const steepness *both,
                              half_size half)
{
    uint32_t t_q15 = (gn_abs32(p->w_dx_q30) * half.w + gn_abs32(p->w_dy_q30) * half.h) >> 15; /* 2^12 */
    uint64_t linear_q34 = (uint64_t)change_q16(both, half) * ((t_q15 * t_q15) >> 12);
    uint64_t product_q32 = (uint64_t)change_q16(light, half) * change_q16(tint, half); /* 2^22 each */
    return linear_q34 * 5 / 4 + (product_q32 * t_q15 >> 13) * 5 / 2 <= (uint64_t)1 << (34 - tolerance_log2(p->frame));
}

/* Makes colours of what arrives, and finds how long their ramps may be. Returns 0 if they change too fast. */
GN_HOT static int curves(gn_pieces *p, half_size half)
{
    steepness light = {0, 0}, tint = {0, 0}, both = {0, 0};
    uint32_t most = 0;
    int32_t bend = 0;
    for (int c = 0; c < 3; c++) {
        include(&light, &p->dark[c].slope_q24);
        include(&light, &p->lit[c].slope_q24);
        if (p->tinted) include(&tint, &p->tint_q24[c]);
    }
    if ((light.dx | light.dy | tint.dx | tint.dy) >> 24) return 0;
    for (int i = 0; i < 6; i++) {
        gn_curve *curve = i < 3 ? &p->dark[i] : &p->lit[i - 3];
        curve->dxx_q28 = curve->dxy_q28 = curve->dyy_q28 = 0;
        if (p->tinted) tint_curve(curve, &p->tint_q24[i < 3 ? i : i - 3]);
        include(&both, &curve->slope_q24);
        most |= size_of(curve->dxx_q28) | size_of(curve->dxy_q28) | size_of(curve->dyy_q28);
        bend = gn_max32(bend, (int32_t)size_of(curve->dxx_q28));
    }
    if (most >> 23) return 0; /* 1/32: a row is within 2^31 */
    bend += 1 + gn_mul_high((int32_t)both.dx * 8, (int32_t)gn_abs32(p->w_dx_q30) * 8);
    p->ramp_px = longest_ramp((uint64_t)(uint32_t)bend << 18, tolerance_log2(p->frame), 2);
    p->steep = !curves_hold(p, &light, &tint, &both, half);
    for (int i = 0; !p->steep && i < 6; i++) bend_curve(p, i < 3 ? &p->dark[i] : &p->lit[i - 3]);
    return 1;
}

#if GN_SHADOWS
/* Bounds of what lies in a piece. */
typedef struct {
    int32_t z_lo, z_hi;
    uint64_t across2_lo, across2_hi; /* squared distance from the view's axis, Q32 */
} extent;

/* |2x + 1 - size| over lo <= x < hi */
GN_HOT static void pixel_range(int32_t lo, int32_t hi, int32_t size, int32_t *least, int32_t *most)
{
    int32_t a = 2 * lo + 1 - size, b = 2 * (hi - 1) + 1 - size;
    *most = gn_max32(-a, b);
    *least = a > 0 ? a : b < 0 ? -b : 0;
}

GN_HOT static uint64_t across2(const gn_frame *frame, int32_t z_q16, int32_t px, int32_t py)
{
    int64_t x = gn_bf_apply((int64_t)z_q16 * px, frame->cam.inv_focal2, 16);
    int64_t y = gn_bf_apply((int64_t)z_q16 * py, frame->cam.inv_focal2, 16);
    x = gn_clamp64(x, 0, 1 << 30);
    y = gn_clamp64(y, 0, 1 << 30);
    return (uint64_t)(x * x) + (uint64_t)(y * y);
}

GN_HOT static void find_extent(const gn_pieces *p, const middle *m, const gn_rect *rect, extent *e)
{
    const gn_frame *frame = p->frame;
    int32_t x_lo, x_hi, y_lo, y_hi, half_w = (rect->x1 - rect->x0 + 1) >> 1, half_h = (rect->y1 - rect->y0 + 1) >> 1;
    int32_t bend_q30 = (int32_t)(gn_abs32(m->w_dx_q30) * (uint32_t)half_w + gn_abs32(m->w_dy_q30) * (uint32_t)half_h);
    int32_t dz = (gn_mul_high(m->z_q16, bend_q30) + 1) * 5; /* z / (1 - 1/8) is below z (1 + 5/4 / 8) */
    e->z_lo = gn_max32(m->z_q16 - dz, p->surface->z_min_q16);
    e->z_hi = gn_min32(gn_sat32((int64_t)m->z_q16 + dz), p->surface->z_max_q16);
    pixel_range(rect->x0, rect->x1, frame->picture.width, &x_lo, &x_hi);
    pixel_range(rect->y0, rect->y1, frame->picture.height, &y_lo, &y_hi);
    e->across2_hi = across2(frame, e->z_hi, x_hi, y_hi);
    e->across2_lo = 0;
    if (frame->n_cascades > 1 || frame->scene->shadow.distance_mode == GN_DISTANCE_RADIUS)
        e->across2_lo = across2(frame, e->z_lo, x_lo, y_lo);
}

enum { REACH_NONE, REACH_ALL, REACH_SOME };

/* D5, D11: whether the distance leaves all or nothing of shadows. */
GN_HOT static int reach_of_distance(const gn_frame *frame, const extent *e)
{
    int64_t m = frame->scene->shadow.max_distance_q16;
    if (frame->scene->shadow.distance_mode == GN_DISTANCE_DEPTH) {
        if ((uint32_t)e->z_hi <= frame->fade_start_q16) return REACH_ALL;
        return e->z_lo >= m ? REACH_NONE : REACH_SOME;
    }
    if (e->across2_hi + (uint64_t)((int64_t)e->z_hi * e->z_hi) <= (uint64_t)(m * m)) return REACH_ALL;
    return e->across2_lo + (uint64_t)((int64_t)e->z_lo * e->z_lo) > (uint64_t)(m * m) ? REACH_NONE : REACH_SOME;
}

/* D4, D6, D7: whether one cascade, and all of it, is that of the whole piece. */
GN_HOT static int reach_of_cascades(const gn_frame *frame, const extent *e, int32_t *cascade)
{
    int blends = GN_BLENDED_CASCADES && frame->scene->shadow.blend != GN_BLEND_HARD;
    for (int32_t i = 0; i < frame->n_cascades; i++) {
        const gn_cascade_state *state = &frame->cascade[i];
        int64_t before = (int64_t)state->centre_q16 - e->z_lo, behind = (int64_t)e->z_hi - state->centre_q16;
        int64_t far = before > behind ? before : behind, near = before < 0 ? -before : behind < 0 ? -behind : 0;
        if (e->across2_lo + (uint64_t)(near * near) >= state->radius2_q32) continue;
        *cascade = i;
        uint64_t within = blends || i == frame->last_cascade ? state->inner2_q32 : state->radius2_q32 - 1;
        return e->across2_hi + (uint64_t)(far * far) <= within ? REACH_ALL : REACH_SOME;
    }
    return REACH_NONE;
}

/* The point of a ray's plane at depth z, and its changes. With z in Q30 and `shift` bits more than 32 to drop from
 * products, they are below 2^29 and 2^30; the sum with the origin fits. */
GN_HOT static gn_slope on_ray(const gn_ray_plane *ray, int32_t px, int32_t py, int32_t z_q30, int32_t z_dx_q30,
                              int32_t z_dy_q30, int32_t shift)
{
    int32_t a =
        (int32_t)((uint32_t)ray->a0 + (uint32_t)ray->ax * (uint32_t)px + (uint32_t)ray->ay * (uint32_t)py); /* < 2^31 */
    gn_slope out = {(int32_t)((uint32_t)(gn_mul_high(z_q30, a) >> shift) + (uint32_t)ray->d_q16),
                    (gn_mul_high(z_dx_q30, a) + 2 * gn_mul_high(z_q30, ray->ax)) >> shift,
                    (gn_mul_high(z_dy_q30, a) - 2 * gn_mul_high(z_q30, ray->ay)) >> shift};
    return out;
}

#if GN_VERTEX_NORMALS
/* Moves places so many texels, Q16, along the interpolated normal. */
GN_HOT static void move_along_normal(gn_slope place[3], const middle *m, const int32_t axis_q30[3][3],
                                     int32_t along_q16)
{
    const gn_slope *n = m->n_q28; /* within +-7: 3 * 2^61 */
    const int32_t at[3] = {n[0].at, n[1].at, n[2].at}, dx[3] = {n[0].dx, n[1].dx, n[2].dx},
                  dy[3] = {n[0].dy, n[1].dy, n[2].dy};
    int32_t along_q22 = along_q16 * 64; /* < 2^23 * 2^6; products of Q26 and Q22 */
    for (int i = 0; i < 3; i++) {
        place[i].at += gn_mul_high((int32_t)(gn_dot64(at, axis_q30[i]) >> 32), along_q22);
        place[i].dx += gn_mul_high((int32_t)(gn_dot64(dx, axis_q30[i]) >> 32), along_q22);
        place[i].dy += gn_mul_high((int32_t)(gn_dot64(dy, axis_q30[i]) >> 32), along_q22);
    }
}
#endif

/* Where the light sees the piece. Returns 0 where that is not close enough to linear over the piece. */
GN_HOT static int piece_light_space(gn_pieces *p, const middle *m, half_size half)
{
    const gn_ortho_fit *fit = &p->view->fit.ortho;
    int32_t px = 2 * p->x + 1 - p->frame->picture.width, py = p->frame->picture.height - 1 - 2 * p->y;
    int32_t up = gn_clz32((uint32_t)m->z_q16) - 2, z_q30 = m->z_q16 * (1 << up), shift = fit->ray_shift + up - 32;
    int32_t z_dx_q30 = -4 * gn_mul_high(z_q30, m->w_dx_q30), z_dy_q30 = -4 * gn_mul_high(z_q30, m->w_dy_q30); /* 2^27 */
    uint32_t most = 0, fastest = 0;
    if (shift < 0 || shift > 31) return 0;
    for (int i = 0; i < 3; i++) {
        p->place[i] = on_ray(&fit->ray[i], px, py, z_q30, z_dx_q30, z_dy_q30, shift);
        p->place[i].at = (int32_t)((uint32_t)p->place[i].at + (uint32_t)p->offset_q16[i]);
    }
#if GN_VERTEX_NORMALS
    if (p->along_q16) move_along_normal(p->place, m, p->view->axis_q30, p->along_q16);
#endif
    for (int i = 0; i < 3; i++) {
        uint32_t dx = gn_abs32(p->place[i].dx), dy = gn_abs32(p->place[i].dy), across = dx * half.w + dy * half.h;
        if ((dx | dy) >> 22) return 0; /* 64 texels per pixel */
        if (across > most) most = across;
        if (dx > fastest) fastest = dx;
        p->cell_reach[i] = (int32_t)((dx + dy) * (GN_CELL / 2 + 1) + 2048);
    }
    /* g t^2 within 1/32 texel; from end to end of a chunk of n pixels a chord bends by g t / 4 */
    uint32_t bend_q15 = (gn_abs32(m->w_dx_q30) * half.w + gn_abs32(m->w_dy_q30) * half.h) >> 15;
    if ((uint64_t)most * ((bend_q15 * bend_q15) >> 15) >> 15 > 2048) return 0;
    p->chunk_px = GN_K(p->frame, persp_step);
    while (p->chunk_px > 1 &&
           ((uint64_t)fastest * (uint32_t)p->chunk_px * ((gn_abs32(m->w_dx_q30) * (uint32_t)p->chunk_px) >> 8)) >> 22 >
               4 * 2048)
        p->chunk_px >>= 1;
    return 1;
}

GN_HOT static int pick_view(gn_pieces *p, const gn_surface_light *light, int32_t cascade)
{
    const gn_frame *frame = p->frame;
    p->view = &frame->view[light->state->view_idx];
    if (!p->view->border_lit) p->view += cascade;
    int32_t up = 15 - p->view->tile_log2 - p->view->depth_log2; /* texels, Q16, to a share of the range, Q31 */
    p->along_q16 = GN_SMOOTH(p->surface) ? p->view->offset_q16 : 0;
    p->depth_up = gn_max32(up, 0);
    p->depth_least = -((1 << 30) >> p->depth_up);
    p->depth_most = 0x7FFF8000 >> p->depth_up;
#if GN_AUTO_BIAS
    gn_auto_bias form = (gn_auto_bias)light->state->auto_bias;
    if (form && !GN_CURVED(p->surface)) {
        gn_bias_auto_ortho(p->view, form, light->flat_offset_q16, p->offset_q16);
        return up >= 0;
    }
    if (form) {
        gn_bias_directional(frame, p->view, p->surface->lift_q30, p->offset_q16);
        p->along_q16 = GN_BENT(p->surface) ? 0 : p->view->auto_place;
    }
#endif
    return up >= 0;
}

/* What becomes of the light's shadow in the piece. Returns 0 where it fades or changes cascades. */
GN_HOT static int shadow(gn_pieces *p, const middle *m, const gn_rect *rect, half_size half)
{
    const gn_frame *frame = p->frame;
    const gn_surface_light *light = &p->surface->light[p->shadow_slot];
    extent e;
    int32_t cascade = 0;
    find_extent(p, m, rect, &e);
    int reach = reach_of_distance(frame, &e);
    if (reach == REACH_ALL && frame->has_cascades) reach = reach_of_cascades(frame, &e, &cascade);
    if (reach == REACH_SOME) return 0;
    uint32_t keep = reach == REACH_NONE ? 65536 : 65536 - light->state->strength_uq16;
#if GN_TURNING
    p->turning.keep_uq16 = keep;
#endif
    for (int c = 0; keep && !p->turns && c < 3; c++) {
        gn_slope *dark = &p->dark[c].slope_q24, *lit = &p->lit[c].slope_q24;
        dark->at += gn_mul_shr(lit->at - dark->at, (int32_t)keep, 16);
        dark->dx += gn_mul_shr(lit->dx - dark->dx, (int32_t)keep, 16);
        dark->dy += gn_mul_shr(lit->dy - dark->dy, (int32_t)keep, 16);
    }
    p->looks_up = reach == REACH_ALL;
    if (p->looks_up && (!pick_view(p, light, cascade) || !piece_light_space(p, m, half))) return 0;
    return 1;
}
#endif

GN_HOT static uint32_t packed(const gn_frame *frame, const gn_curve *colour)
{
    uint32_t q20[3];
    for (int c = 0; c < 3; c++) q20[c] = (uint32_t)gn_max32(colour[c].slope_q24.at, 0) >> 4;
    return gn_pixel_pack(frame, q20);
}

GN_HOT int gn_pieces_select(gn_pieces *p, const gn_rect *rect)
{
    middle m;
    p->x = (rect->x0 + rect->x1) >> 1;
    p->y = (rect->y0 + rect->y1) >> 1;
    if (!find_middle(p, &m)) return 0;
    p->w_dx_q30 = m.w_dx_q30;
    p->w_dy_q30 = m.w_dy_q30;
    p->varies = GN_COLOURED(p->surface) || GN_SMOOTH(p->surface);
    half_size half = {(uint32_t)(rect->x1 - rect->x0 + 1) >> 1, (uint32_t)(rect->y1 - rect->y0 + 1) >> 1};
    if (!piece_is_uniform(p, half) || !piece_colours(p, &m, half)) return 0;
    p->looks_up = 0;
#if GN_SHADOWS
    p->x0 = rect->x0;
    p->y0 = rect->y0;
    p->cells = 0;
    if (p->shadow_slot >= 0 && !shadow(p, &m, rect, half)) return 0;
#endif
#if GN_TURNING
    if (p->turns) return turning_ramps(p);
#endif
    if (!p->varies) {
        p->dark_pixel = packed(p->frame, p->dark);
        p->lit_pixel = packed(p->frame, p->lit);
        return 1;
    }
    if (!curves(p, half)) return 0;
#if GN_SHADOWS
    if (p->chunk_px > p->ramp_px) p->chunk_px = p->ramp_px;
#endif
    return 1;
}

#endif
