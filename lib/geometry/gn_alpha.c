/* Triangles that alpha cuts; mask images. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "geometry/gn_xform.h"

#if GN_CASTER_ALPHA || GN_VISIBLE_ALPHA
GN_HOT void gn_alpha_begin(gn_alpha_cut *cut, const gn_object *object, gn_alpha mode, const uint16_t idx[3])
{
    cut->object = object;
    cut->mode = mode;
    cut->textured = GN_TEXTURES && object->texture;
    if (GN_TEXTURES && cut->textured) gn_alpha_corners(cut, idx);
}

/* The least alpha of a texture that times `whole` is at least `least`. */
GN_HOT static uint32_t least_of_texture(uint32_t whole, uint32_t least)
{
    if (whole == 65536 || !least) return least;
    return whole ? (least * 65536U - 32769U) / whole + 1 : UINT32_MAX; /* a product modulo 2^32 */
}

/* Clip cuts below the cutoff, dither below the noise, blend what cannot be seen. [M1] [M8] */
GN_HOT uint32_t gn_alpha_keeps(gn_alpha_cut *cut, int32_t x, uint32_t asked)
{
    const gn_object *object = cut->object;
    const int clips = cut->mode == GN_ALPHA_CLIP;
    const uint32_t whole = object->alpha_uq16, least = least_of_texture(whole, clips ? object->alpha_cutoff_uq16 : 1);
    gn_alpha_test test = {least - (least > 32768), whole, !clips && !(GN_LAYERS_MAX && cut->mode == GN_ALPHA_BLEND), x,
                          cut->y};
    uint32_t kept = 0;
#if GN_TEXTURES
    for (uint32_t left = cut->textured ? asked : 0, part; left; left ^= part) {
        int32_t i = 31 - gn_clz32(left & (0U - left));
        gn_texture_curve curve;
        test.x = x + i;
        uint32_t n = (uint32_t)gn_alpha_coords(cut, test.x, &curve);
        part = left & (n + (uint32_t)i < 32 ? (1U << (n + (uint32_t)i)) - 1 : UINT32_MAX);
        kept |= gn_texture_keeps(object->texture, &curve, part >> i, &test) << i;
    }
    if (cut->textured) return kept;
#endif
    for (int32_t i = 0; i < 32; i++) kept |= (uint32_t)gn_alpha_passes(&test, i, 65535) << i;
    return kept & asked;
}

/* ---- Texture coordinates along a row of a triangle that alpha cuts ----------------------------------------------- */

#if GN_TEXTURES
GN_HOT void gn_alpha_corners(gn_alpha_cut *cut, const uint16_t idx[3])
{
    gn_texture_triangle uv;
    gn_texture_corners(&uv, cut->object->mesh, cut->object->texture, idx);
    for (int i = 0; i < 2; i++) {
        cut->axis[i].from_q16 = (int32_t)uv.uv_q16[0][i];
        for (int k = 0; k < 2; k++) cut->axis[i].change_q15[k] = (int32_t)(uv.uv_q16[k + 1][i] >> 1); /* exact */
    }
}

/* |c| < 2^30; rounded to a unit of c. */
GN_HOT static inline void cut_form(gn_screen_form *out, const int32_t c[3], uint32_t focal2_px_q16)
{
    out->at = gn_shr64((int64_t)c[2] * (int64_t)focal2_px_q16, 16);
    out->x = c[0];
    out->y = c[1];
}

/* As gn_plane_at, / 2^16, but what the row and column do not change is added up beforehand: below 2^46 + 2 * 2^43. */
GN_HOT static inline int64_t screen_form_at(const gn_screen_form *form, int32_t px, int32_t py)
{
    return form->at + (int64_t)form->x * px + (int64_t)form->y * py;
}

/* Both barycentrics' forms, times what the coordinate changes with them, are one, aligned to the larger exponent of
 * those that count. Changes are below 2^(32 - up), up 1..31; least and most below 2^29. */
GN_HOT static void find_axis(gn_alpha_axis *axis, const gn_bary *bary, uint32_t focal2_px_q16)
{
    const int32_t a = axis->change_q15[0], b = axis->change_q15[1], up = gn_clz32(gn_abs32(a) | gn_abs32(b) | 1U),
                  exp = !a || (b && bary->exp[0] < bary->exp[1]) ? bary->exp[1] : bary->exp[0];
    int64_t sum[3];
    int32_t form[3];
    for (int k = 0; k < 3; k++) { /* 2 * 2^31 * 2^30 */
        sum[k] = a ? gn_scale64((int64_t)a * bary->form[0][k], exp - bary->exp[0]) : 0;
        if (b) sum[k] += gn_scale64((int64_t)b * bary->form[1][k], exp - bary->exp[1]);
    }
    axis->exp = gn_norm_vec(form, sum) + exp - (32 - up);
    cut_form(&axis->form, form, focal2_px_q16);
    axis->least = (int32_t)((int64_t)gn_min32(gn_min32(a, b), 0) * (1 << (up - 1)) >> 2);
    axis->most = (int32_t)((int64_t)gn_max32(gn_max32(a, b), 0) * (1 << (up - 1)) >> 2);
    axis->down = up - 8;
}

GN_HOT void gn_alpha_plane(gn_alpha_cut *cut, const gn_frame *frame, int32_t (*v)[3], uint32_t focal2_px_q16,
                           int32_t width, int32_t newton_steps)
{
    gn_plane plane;
    gn_bary bary;
    gn_plane_setup(&plane, v[0], v[1], v[2]);
    gn_bary_setup(&bary, &plane, v[0], v[1], v[2]);
    if (!plane.det) plane.n[0] = plane.n[1] = plane.n[2] = 0;
    cut_form(&cut->n_ray, plane.n, focal2_px_q16);
    for (int i = 0; i < 2; i++) find_axis(&cut->axis[i], &bary, focal2_px_q16);
    cut->width = width;
    cut->newton_steps = newton_steps;
    cut->px_per_step = gn_min32(GN_K(frame, persp_step), 8);
    if (gn_min32(cut->axis[0].down, cut->axis[1].down) < -1)
        cut->px_per_step = 1; /* 2^10 turns and more: modulo 2^12 */
}

/* v * 2^-s, off by less than 1, saturated */
GN_HOT static inline int32_t half_share(int64_t v, int32_t s)
{
    return gn_sat32((uint32_t)s > 63 ? gn_scale64(v, s) : v >> s);
}

/* Q20: modulo 2^12 turns, saturated where it is clamped. |change| <= 2^29, down is -7..23. */
GN_HOT static inline int32_t coord_at(const gn_alpha_axis *axis, int32_t change, int clamps)
{
    int64_t c_q20;
    if (axis->down > 0) c_q20 = (change + (1 << axis->down >> 1)) >> axis->down;
    else c_q20 = (int64_t)change * (1 << -axis->down);
    if (clamps) return gn_sat32(c_q20 + (int64_t)axis->from_q16 * 16);
    return (int32_t)((uint32_t)c_q20 + (uint32_t)axis->from_q16 * 16U);
}

/* By division. */
GN_HOT static void find_exact(const gn_alpha_cut *cut, gn_alpha_exact *at, int32_t x)
{
    const int32_t px = 2 * x + 1 - cut->width, py = cut->py;
    const int64_t w = screen_form_at(&cut->n_ray, px, py);
    at->x = x;
    at->w_norm = 0;
    int32_t recip_q30 = 0; /* 0: where nothing is seen, the coordinates are those of vertex 0 */
    if (w > 0) {
        at->clz = gn_clz64((uint64_t)w);
        at->w_norm = (uint32_t)((uint64_t)w << at->clz >> 32);
        recip_q30 = (int32_t)(gn_recip_norm(at->w_norm, cut->newton_steps) >> 1); /* 2^62 / w_norm */
    }
    GN_UNROLL
    for (int i = 0; i < 2; i++) {
        const gn_alpha_axis *axis = &cut->axis[i];
        int32_t change = 0;
        if (recip_q30) {
            change = half_share(screen_form_at(&axis->form, px, py), 33 - at->clz - axis->exp);
            GN_KEEP(change); /* 32 bits: one multiplication */
            change = gn_mul_high(change, recip_q30);
        }
        change = gn_max32(gn_min32(change, axis->most), axis->least); /* of a corner, at most */
        at->uv_q20[i] = coord_at(axis, change, gn_texture_clamps(cut->object->texture, i));
    }
}

#define GN_ALPHA_BEND_MAX_Q30 (3 << 26) /* 3/16; the parabola is in NUMERICS 4.9 */
#define GN_ALPHA_TEXEL_LOG2   8         /* maximum distance of coordinates from the parabola: 2^-8 texel */
#define GN_ALPHA_LONG_PX      32        /* tried first, before cut->px_per_step */

/* (z1 - z0) / (z1 + z0), Q30, of depths z = 1 / w. */
GN_HOT static int32_t bend_between(const gn_alpha_exact *a, const gn_alpha_exact *b)
{
    int32_t larger = a->clz - b->clz; /* w1, by so many bits */
    uint32_t w0 = a->w_norm >> 1 >> gn_min32(gn_max32(larger, 0), 31),
             w1 = b->w_norm >> 1 >> gn_min32(gn_max32(-larger, 0), 31);
    int32_t bend_q30 = (int32_t)gn_quotient_q30(w0 < w1 ? w1 - w0 : w0 - w1, w0 + w1);
    return w0 < w1 ? -bend_q30 : bend_q30;
}

/* A coordinate that changes by d over n <= 32 pixels, 1 / n of them as share_q31. Returns 0 if that is two turns or
 * more, or if its distance from the parabola is above the limit. */
GN_HOT static int step_coord(gn_alpha_steps *steps, int axis, int32_t d, int32_t n, int32_t share_q31, int32_t bend_q30,
                             uint32_t size_log2)
{
    uint32_t bend_q16 = (gn_abs32(bend_q30) >> 14) + 1; /* at most 2^13.6 */
    if (gn_abs32(d) >> 21) return 0;
    if ((uint64_t)gn_abs32(d) * (bend_q16 * bend_q16) > (uint64_t)1 << (34 + 20 - GN_ALPHA_TEXEL_LOG2 - size_log2))
        return 0;                                                                         /* a^2/4 */
    const int32_t d_q28 = d * 256, bend_q28 = (int32_t)((int64_t)d_q28 * bend_q30 >> 28), /* 2^29 * 3/4 */
        bend = gn_mul_high(2 * bend_q28, 2 * gn_mul_high(share_q31, share_q31));
    steps->bend_q28[axis] = bend;
    steps->step_q28[axis] = gn_mul_high(2 * (d_q28 - bend * (n * (n - 1) / 2)), share_q31); /* 2^29 + 2^29 * 3/8 */
    return 1;
}

/* The pixels from `at` on between two exact samples, px apart, or where the triangle's row begins and ends. Returns 0
 * if they are too far apart for the limit. */
GN_HOT static int find_steps(gn_alpha_cut *cut, int32_t at, int32_t px)
{
    const gn_texture *texture = cut->object->texture;
    gn_alpha_steps *steps = &cut->steps;
    gn_alpha_exact from = cut->exact;
    steps->first = gn_max32(at, cut->x_begin);
    steps->end = gn_min32(at + px, cut->x_end);
    steps->hold = 0;
    int32_t last = gn_min32(at + px, cut->x_end - 1), n = last - steps->first;
    if (n < 2) return 1;
    if (from.x != steps->first) find_exact(cut, &from, steps->first);
    find_exact(cut, &cut->exact, last);
    if (!from.w_norm || !cut->exact.w_norm) return 0;
    int32_t bend_q30 = bend_between(&from, &cut->exact);
    if (gn_abs32(bend_q30) > GN_ALPHA_BEND_MAX_Q30) return 0;
    const int32_t share_q31 = (int32_t)((1U << 31) / (uint32_t)n);
    for (int i = 0; i < 2; i++) {
        const int32_t u = from.uv_q20[i], to = cut->exact.uv_q20[i], d = (int32_t)((uint32_t)to - (uint32_t)u);
        if ((d < 0) != (to < u) && gn_texture_clamps(texture, i)) return 0; /* modulo whole turns, if it repeats */
        steps->from_q20[i] = from.uv_q20[i];
        if (!step_coord(steps, i, d, n, share_q31, bend_q30, gn_texture_size_log2(texture, i))) return 0;
    }
    steps->hold = 1;
    return 1;
}

/* The span around x: all of a short row. What it is does not depend on the pixels before: a row in two screen tiles is
 * one row. */
GN_HOT static void alpha_steps(gn_alpha_cut *cut, int32_t x)
{
    const int32_t at = cut->x_end - cut->x_begin <= GN_ALPHA_LONG_PX ? cut->x_begin : x & -GN_ALPHA_LONG_PX;
    if (cut->steps.bent != at && find_steps(cut, at, GN_ALPHA_LONG_PX)) return;
    cut->steps.bent = at;
    find_steps(cut, x & -cut->px_per_step, cut->px_per_step);
}

GN_HOT int32_t gn_alpha_coords(gn_alpha_cut *cut, int32_t x, gn_texture_curve *curve)
{
    const gn_alpha_steps *steps = &cut->steps;
    if (GN_ALPHA_STEPS && cut->px_per_step > 1) {
        if (x >= steps->end || x < steps->first) alpha_steps(cut, x);
        if (steps->hold) {
            int32_t k = x - steps->first, bends = k * (k - 1) / 2;
            for (int i = 0; i < 2; i++) {
                curve->from_q20[i] = steps->from_q20[i];
                curve->at_q28[i] = k * steps->step_q28[i] + bends * steps->bend_q28[i] + 128;
                curve->step_q28[i] = steps->step_q28[i] + k * steps->bend_q28[i];
                curve->bend_q28[i] = steps->bend_q28[i];
            }
            return steps->end - x;
        }
    }
    gn_alpha_exact at;
    find_exact(cut, &at, x);
    for (int i = 0; i < 2; i++) {
        curve->from_q20[i] = at.uv_q20[i];
        curve->at_q28[i] = curve->step_q28[i] = curve->bend_q28[i] = 0;
    }
    return 1;
}
#endif
#endif

/* ---- Mask images ------------------------------------------------------------------------------------------------- */

#if GN_MASKS
/* The same as find_taps in gn_texture.c for a clamped, bilinear image. It runs once per pixel and light, so it has no
 * branch. */
GN_HOT static gn_texture_taps mask_taps(int32_t c_q16, uint32_t size)
{
    int32_t last = (int32_t)size - 1, at_q16 = gn_max32(0, gn_min32(c_q16, 65536)) * (int32_t)size - 32768;
    int32_t first = at_q16 >> 16; /* -1 .. last */
    return (gn_texture_taps){(uint32_t)gn_max32(first, 0), (uint32_t)gn_min32(first + 1, last),
                             (uint32_t)at_q16 & 0xFFFFU};
}

/* Four equal texels, as in wholly lit or dark areas, need no interpolation. [M5] */
GN_HOT uint32_t gn_texture_mask(const gn_texture *image, int32_t u_q16, int32_t v_q16, uint32_t channel)
{
    const uint32_t bytes_log2 = image->flags & GN_TEXTURE_MASK_1 ? 0 : image->flags & GN_TEXTURE_MASK_2 ? 1 : 2;
    const uint32_t width = gn_texture_size(image, 0);
    GN_COUNT(masked, 1);
    if (channel >> bytes_log2) return 65536;
    const gn_texture_taps u = mask_taps(u_q16, width), v = mask_taps(v_q16, gn_texture_size(image, 1));
    const uint8_t *upper = image->rgba + channel + ((size_t)v.first * width << bytes_log2);
    const uint8_t *lower = image->rgba + channel + ((size_t)v.second * width << bytes_log2);
    const uint32_t left = u.first << bytes_log2, right = u.second << bytes_log2;
    const uint32_t a = upper[left] * 257U, b = upper[right] * 257U, c = lower[left] * 257U, d = lower[right] * 257U;
    if (!((a ^ b) | (a ^ c) | (a ^ d))) return gn_texture_to_uq16(a);
    return gn_texture_to_uq16(
        gn_texture_mix(gn_texture_mix(a, b, u.weight_uq16), gn_texture_mix(c, d, u.weight_uq16), v.weight_uq16));
}

#if GN_INTERPOLATES
GN_HOT int gn_texture_mask_is_even(const gn_texture *image, const int32_t least_q16[2], const int32_t most_q16[2])
{
    const uint32_t bytes_log2 = image->flags & GN_TEXTURE_MASK_1 ? 0 : image->flags & GN_TEXTURE_MASK_2 ? 1 : 2;
    const uint32_t width = gn_texture_size(image, 0), height = gn_texture_size(image, 1);
    uint32_t x0 = mask_taps(least_q16[0], width).first, x1 = mask_taps(most_q16[0], width).second,
             y0 = mask_taps(least_q16[1], height).first, y1 = mask_taps(most_q16[1], height).second;
    const uint8_t *first = image->rgba + (((size_t)y0 * width + x0) << bytes_log2);
    if ((x1 - x0 + 1) * (y1 - y0 + 1) > 64) return 0;
    for (uint32_t y = y0; y <= y1; y++) {
        const uint8_t *row = image->rgba + ((size_t)y * width << bytes_log2);
        for (uint32_t i = x0 << bytes_log2; i < (x1 + 1) << bytes_log2; i++)
            if (row[i] != first[i & ((1U << bytes_log2) - 1)]) return 0;
    }
    return 1;
}
#endif
#endif
