/* Where perspective views see flat surfaces: linear forms on the screen (NUMERICS 4.12). */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_surface.h"

#if GN_INTERPOLATES && GN_SHADOWS && GN_PUNCTUAL_LIGHTS

/* Linear on the screen, in 64 bits: at the plane's pixel, per pixel to the right, per pixel down. */
typedef struct {
    int64_t at, dx, dy;
} wide_slope;

/* Narrows a form to values below 2^30 on the part of the screen that the plane is asked for. Returns the bits that were
 * dropped. */
GN_HOT static int32_t narrow(const gn_screen_plane *p, const wide_slope *s, gn_slope *out)
{
    uint64_t largest = gn_abs64(s->at) + gn_abs64(s->dx) * (uint32_t)p->w_px + gn_abs64(s->dy) * (uint32_t)p->h_px;
    int32_t shift = gn_max32(34 - gn_clz64(largest | 1U), 0);
    const int64_t half = (int64_t)1 << shift >> 1;
    out->at = (int32_t)((s->at + half) >> shift);
    out->dx = (int32_t)((s->dx + half) >> shift);
    out->dy = (int32_t)((s->dy + half) >> shift);
    return shift;
}

GN_HOT static void drop_bits(gn_slope *s, int32_t n)
{
    const int32_t half = n > 30 ? 0 : 1 << n >> 1;
    n = gn_min32(n, 31);
    s->at = (s->at + half) >> n;
    s->dx = (s->dx + half) >> n;
    s->dy = (s->dy + half) >> n;
}

/* Adds a length over view depth, by 31 bits of it. Returns 0 if it is too long. */
GN_HOT static int add_over_depth(const gn_slope *w, int32_t length_q16, uint32_t inverse_depth, int32_t down,
                                 wide_slope *out)
{
    int32_t up = gn_max32(gn_clz32(gn_abs32(length_q16) | 1U) - 1, 0);
    int64_t e = (int64_t)(length_q16 * (1 << up)) * inverse_depth >> 32;
    down += up;
    if (down < 0 || down > 62) return 0;
    out->at += e * w->at >> down;
    out->dx += e * w->dx >> down;
    out->dy += e * w->dy >> down;
    return 1;
}

/* A row of the matrix, f * axis + c * axis of depth, times what points are from the light: on the screen, and at the
 * eye, below 2^30, Q16. Returns 0 if that is too far. */
GN_HOT static GN_NOINLINE int find_form(const gn_frame *frame, const gn_screen_plane *p, const gn_light_view *view,
                                        int i, const int32_t by_q27[2], wide_slope *out, int32_t *eye_q16)
{
    int32_t px = 2 * p->x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * p->y;
    int64_t at = 0, dx = 0, dy = 0, eye = 0; /* |row| < 2^30.2, |a| <= 2^30 */
    GN_UNROLL
    for (int j = 0; j < 3; j++) {
        const gn_ray_plane *r = &frame->light[view->light_idx].from_light[j];
        int32_t row_q27 =
            (int32_t)(((int64_t)view->axis_q30[i][j] * by_q27[0] + (int64_t)view->axis_q30[2][j] * by_q27[1]) >> 30);
        int32_t a = (int32_t)((uint32_t)r->a0 + (uint32_t)r->ax * (uint32_t)px + (uint32_t)r->ay * (uint32_t)py);
        at += (int64_t)row_q27 * a;
        dx += (int64_t)row_q27 * r->ax;
        dy -= (int64_t)row_q27 * r->ay;
        eye += (int64_t)row_q27 * (int32_t)r->d_q16;
    }
    out->at = at >> 21;
    out->dx = dx >> 20;
    out->dy = dy >> 20;
    *eye_q16 = (int32_t)(eye >> 27);
    return !(gn_abs64(eye) >> 57);
}

/* How bias moves points of a surface along a normal: by a share of their distance along the view's axis, by a share of
 * view depth and by a length, Q16. */
typedef struct {
    const int32_t *n_q30;
    int32_t share_q31, depth_share_q40, length_q16;
} point_mover;

/* What the last two do to a form, of which `by_q27` is a row before the first. */
GN_HOT static GN_NOINLINE void add_lengths(const gn_light_view *view, const point_mover *move, int32_t ray_shift, int i,
                                           const int32_t by_q27[2], wide_slope *out, int32_t *eye_q16)
{
    int32_t along_q27 = (int32_t)((gn_dot_q30(move->n_q30, view->axis_q30[i]) * by_q27[0] +
                                   gn_dot_q30(move->n_q30, view->axis_q30[2]) * by_q27[1]) >>
                                  30);
    out->at += (int64_t)along_q27 * move->depth_share_q40 >> (61 - ray_shift);
    *eye_q16 += (int32_t)((int64_t)along_q27 * move->length_q16 >> 27);
}

/* As shares of view depth, coordinates in the view are linear on the screen: of the ray's direction, and of 1 / depth,
 * which the plane's w is. Bias leaves them linear. */
GN_HOT static GN_NOINLINE int make_forms(gn_view_forms *out, const gn_screen_plane *plane, const gn_frame *frame,
                                         const gn_surface *s, const point_mover *move)
{
    const gn_light_view *view = out->view;
    const gn_persp_fit *fit = &view->fit.persp;
    const int32_t log2 = view->tile_log2, ray_shift = frame->light[view->light_idx].ray_shift;
    const int32_t down = 56 - ray_shift - plane->z_shift;
    const uint32_t inverse = gn_recip_norm(s->depth_scale.mant, 2);
    gn_slope *form[3] = {&out->u, &out->v, &out->z};
    int32_t shift[3], most = 0, moved_q30[3], eye_q16;
    if (log2 > 12 || fit->focal2_q16 >> (19 + log2)) return 0; /* so that f is below 4 */
    for (int i = 0; i < 3; i++)
        moved_q30[i] = 4 * gn_mul_high(move->share_q31 >> 1, (int32_t)(gn_dot64(move->n_q30, view->axis_q30[i]) >> 30));
    const int32_t depth_q27 = ((1 << 30) + moved_q30[2]) >> 3;
    const int32_t f_q27 = (int32_t)(log2 < 10 ? fit->focal2_q16 << (10 - log2) : fit->focal2_q16 >> (log2 - 10));
    wide_slope wide;
    for (int i = 0; i < 3; i++) {
        int32_t by_q27[2] = {0, depth_q27}, unmoved_q27[2] = {0, 1 << 27};
        if (i < 2) { /* the tile's middle, too */
            by_q27[0] = unmoved_q27[0] = f_q27;
            unmoved_q27[1] = view->tile_texels << (26 - log2);
            by_q27[1] =
                4 * gn_mul_high(moved_q30[i], f_q27) + (int32_t)((int64_t)depth_q27 * view->tile_texels >> (log2 + 1));
        }
        if (!find_form(frame, plane, view, i, by_q27, &wide, &eye_q16)) return 0;
        if (GN_AUTO_BIAS && move->length_q16) add_lengths(view, move, ray_shift, i, unmoved_q27, &wide, &eye_q16);
        if (!add_over_depth(&plane->w, eye_q16, inverse, down, &wide)) return 0;
        shift[i] = narrow(plane, &wide, form[i]);
        most = gn_max32(most, shift[i]);
    }
    for (int i = 0; i < 3; i++)
        if (shift[i] < most) drop_bits(form[i], most - shift[i]);
    wide = (wide_slope){0, 0, 0};
    if (!add_over_depth(&plane->w, fit->near_q16, inverse, down, &wide)) return 0;
    out->near_up = most - narrow(plane, &wide, &out->near);
    return 1;
}

#if GN_AUTO_BIAS
/* Automatic bias of the plane through the lattice's own corner, with room for what forms are off. Returns 0 if forms
 * are not to be told so. */
GN_HOT static GN_NOINLINE int move_by_auto_bias(const gn_lattice *l, const gn_surface *s, uint32_t slot,
                                                gn_view_forms *out, point_mover *move)
{
    const gn_light_view *view = out->view;
    const int32_t most_px = l->plane.w_px + l->plane.h_px + 1;
    gn_auto_plane plane = {(gn_auto_bias)s->light[slot].state->auto_bias, 0, 0, 0, 0};
    int32_t from[3];
    gn_corner_from_ray(l->anchor.ray_q16, s->light[slot].state, from);
    plane.reach_q16 = view->offset_q16 + (most_px * view->tile_texels >> 9) + 1;
    plane.step_q32 = view->auto_step + 48 * most_px; /* 3 / 2 of 2^32 / 2^27 */
    gn_bias_auto_plane(view, s->face_q30, from, &plane);
    if (plane.share_q30 >> 29 > 0) return 0; /* a half or more */
    out->in_tile = plane.form == GN_AUTO_BIAS_NORMAL;
    out->z_least = 1 << 27;
    out->less_q30 = (int32_t)((gn_clamp64(plane.less_q32, 0, (int64_t)1 << 32) + 3) >> 2);
    move->n_q30 = s->face_q30;
    move->share_q31 = plane.share_q30 < 0 ? 0 : (int32_t)plane.share_q30 * 2;
    move->depth_share_q40 = view->auto_place;
    move->length_q16 = GN_AUTO_UNITS + 3;
    return 1;
}

#endif

/* What bias does to the surface as the view of the forms sees it. Returns 0 if forms are not to be told so. */
GN_HOT static GN_NOINLINE int find_move(gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                        gn_view_forms *out, point_mover *move)
{
    const gn_light_view *view = out->view;
    if (GN_FLAT_Q16(frame) || !l->plane.fits) return 0;
    *move = (point_mover){s->normal_q30[0], view->fit.persp.lift_q31, 0, 0};
    out->less_q30 = out->in_tile = 0;
    out->z_least = 1 << 22;
#if GN_AUTO_BIAS
    if (s->light[slot].state->auto_bias) {
        if (view->filter == GN_FILTER_DISK || !gn_corner_find_anchor(l, frame, s)) return 0;
        return move_by_auto_bias(l, s, slot, out, move);
    }
#endif
    return l->light[slot].lifts && move->share_q31 != INT32_MAX;
}

/* Those of the view, if need be new ones. */
GN_HOT static inline const gn_view_forms *forms_of(gn_lattice *l, const gn_frame *frame, const gn_surface *s,
                                                   uint32_t slot, const gn_light_view *view)
{
    gn_view_forms *forms = &l->forms[(uint32_t)(view - frame->view) & (GN_VIEW_FORMS - 1)];
    if (forms->view == view) return forms;
    forms->view = view;
    point_mover move;
    if (!find_move(l, frame, s, slot, forms, &move) || !make_forms(forms, &l->plane, frame, s, &move))
        forms->near_up = INT32_MAX;
    return forms;
}

GN_HOT int gn_corner_place_flat(gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                const gn_light_view *view, int32_t x, int32_t y, gn_corner_light *at)
{
    const gn_view_forms *forms = forms_of(l, frame, s, slot, view);
    if (forms->near_up == INT32_MAX) return 0;
    const int32_t dx = x - l->plane.x, dy = y - l->plane.y;
    int32_t u = gn_slope_at(&forms->u, dx, dy), v = gn_slope_at(&forms->v, dx, dy), z = gn_slope_at(&forms->z, dx, dy);
    /* what roundings of slopes do not matter to, nor carry to 2^30 */
    if ((uint32_t)(z - forms->z_least) >= (uint32_t)((1 << 30) - forms->z_least)) return 0;
    int32_t clz = gn_clz32((uint32_t)z), down = 12 - view->tile_log2, near = gn_slope_at(&forms->near, dx, dy);
    uint32_t recip = gn_recip_norm((uint32_t)z << clz, GN_RECIP_STEPS(frame)); /* 2^63 / (z 2^clz) */
    uint32_t share = near < 0 ? 0 : gn_umul_high((uint32_t)near, recip);
    int32_t half = (int32_t)(recip >> 1);
    GN_KEEP(half);
    int32_t up = clz - 1 - forms->near_up;
    if (up >= 0) {
        at->seen = up < 30 && !(share >> (30 - up));
        share <<= up & 31;
    } else {
        share = up < -31 ? 0 : share >> -up;
        at->seen = !(share >> 30);
    }
    if (!at->seen) return 1;
    if (gn_abs32(u) >> 1 >= (uint32_t)z || gn_abs32(v) >> 1 >= (uint32_t)z) return 0;
    at->u_q16 = gn_mul_high(u * (1 << (clz - 2)), half) >> down;
    at->v_q16 = gn_mul_high(v * (1 << (clz - 2)), half) >> down;
    at->depth_q30 = (int32_t)((1U << 30) - 1 - share);
#if GN_AUTO_BIAS
    const uint32_t end = (uint32_t)view->tile_texels << 16;
    at->depth_q30 = gn_max32(at->depth_q30 - forms->less_q30, 0);
    if (forms->in_tile && ((uint32_t)at->u_q16 > end || (uint32_t)at->v_q16 > end)) at->seen = GN_SEEN_OUTSIDE;
#endif
    return 1;
}

#endif
