/* Shadows on patches: places in a light's view, and attenuations along rows of pixels. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_lattice.h"
#include "shade/gn_patch.h"
#include "shade/gn_surface.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_views.h"

#if GN_INTERPOLATES

/* Other bias than the automatic one is of each pixel. */
#if GN_SHADOWS && GN_AUTO_BIAS

enum { TOO_FAR = 1 << 29 /* texels, Q16: of an offset that no tile is deep enough for */ };

/* Where the triangle is looked up: u, v in texels, Q16, and depth, a share of the view's range, Q30. */
typedef struct {
    gn_slope u, v, depth;
    int32_t slope_q12[2]; /* of depth over u and v, both in texels: directional views */
} patch_places;

/* ---- Reach ------------------------------------------------------------------------------------------------------- */

/* Whether one cascade is that of all of the triangle, and what distance leaves of its shadows in the middle, which is
 * within the tolerance of cells elsewhere: found once. [D4] [D5] */
GN_HOT static int find_patch_reach(gn_shading *s)
{
    gn_patch *p = &s->lattice.from.patch;
    const gn_patch_record *r = &p->record;
    const gn_frame *frame = s->frame;
    if (p->reach != GN_REACH_UNKNOWN) return p->reach;
    p->reach = GN_REACH_EVEN;
    p->cascade = p->shared->of.cascade;
    p->g_uq16 = 65536;
    if (p->cascade < 0) {
        const int32_t half = r->px / 2 + 1;
        int32_t lo, hi;
        gn_record_depths(r, frame, &lo, &hi);
        const gn_rect px = {r->x - half, r->y - half, r->x + half + 1, r->y + half + 1};
        const uint32_t most = gn_shadow_distance_fade(frame, lo), least = gn_shadow_distance_fade(frame, hi);
        p->reach = GN_REACH_UNEVEN;
        if (frame->scene->shadow.distance_mode == GN_DISTANCE_RADIUS ||
            (most - least) >> (16 - gn_cell_fade_log2(frame)))
            return p->reach;
        p->g_uq16 = most == least ? most : gn_shadow_distance_fade(frame, gn_record_depth(r));
        p->cascade = p->g_uq16 ? gn_cascade_of_region(frame, lo, hi, &px) : GN_CASCADE_NONE;
        p->reach = p->cascade < 0 ? GN_REACH_UNEVEN : GN_REACH_EVEN;
    }
    if (p->cascade == GN_CASCADE_NONE) p->reach = GN_REACH_NONE;
    return p->reach;
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

/* Slopes of depth over u and v, Q12: normal to both changes on the screen, whose scale counts for nothing. */
GN_HOT static void find_slopes_of_depth(const gn_slope *depth, patch_places *at)
{
    int32_t x[3] = {at->u.dx, at->v.dx, depth->dx}, y[3] = {at->u.dy, at->v.dy, depth->dy};
    gn_to_bits(x, 3, 14);
    gn_to_bits(y, 3, 14);
    int32_t n[3] = {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]}; /* 2^29 */
    gn_bias_slopes(n);
    for (int i = 0; i < 2; i++)
        at->slope_q12[i] = n[i] + (n[i] >> 11); /* 14 bits are off by so much: bias must not be less */
}

/* Depth in texels, Q16, as a share of the view's range. Returns GN_PATCH_EDGE, or GN_PATCH_UNEVEN where the range ends.
 */
GN_HOT static int limit_depth(const gn_light_view *view, const gn_patch_record *r, const gn_slope *depth_q16,
                              gn_slope *out_q30)
{
    const int32_t up = 14 - view->tile_log2 - view->depth_log2;
    const uint32_t spread =
        (gn_abs32(depth_q16->dx) + gn_abs32(depth_q16->dy)) * (uint32_t)(r->px / 2 + 1); /* 17 * 2^24 */
    const int32_t lo = gn_depth_q30(view, depth_q16->at - (int32_t)spread),
                  hi = gn_depth_q30(view, depth_q16->at + (int32_t)spread);
    *out_q30 = (gn_slope){hi, 0, 0};
    if (hi <= GN_DEPTH_LEAST_Q30 || lo >= GN_DEPTH_END_Q30) return GN_PATCH_EDGE;
    if (lo <= GN_DEPTH_LEAST_Q30 || hi >= GN_DEPTH_END_Q30) return GN_PATCH_UNEVEN; /* it bends the plane */
    out_q30->at = gn_depth_q30(view, depth_q16->at);
    out_q30->dx = up >= 0 ? depth_q16->dx * (1 << up) : depth_q16->dx >> gn_min32(-up, 31);
    out_q30->dy = up >= 0 ? depth_q16->dy * (1 << up) : depth_q16->dy >> gn_min32(-up, 31);
    return GN_PATCH_EDGE;
}

/* In a directional view. Returns GN_PATCH_EDGE, GN_PATCH_LIT where bias lights everything, or GN_PATCH_UNEVEN far
 * outside, or where its range ends. */
GN_HOT static int place_in_ortho(gn_shading *s, const gn_light_view *view, gn_auto_bias form, patch_places *out)
{
    const gn_ortho_fit *fit = &view->fit.ortho;
    const gn_patch_record *r = &s->lattice.from.patch.record;
    int32_t normal[3], offset[3];
    gn_slope depth;
    if (!gn_record_place(r, s->frame, &fit->ray[0], fit->ray_shift, &out->u) ||
        !gn_record_place(r, s->frame, &fit->ray[1], fit->ray_shift, &out->v) ||
        !gn_record_place(r, s->frame, &fit->ray[2], fit->ray_shift, &depth))
        return GN_PATCH_UNEVEN;
    find_slopes_of_depth(&depth, out);
    if (form == GN_AUTO_BIAS_NORMAL) gn_bias_auto_face(view, form, gn_patch_face(s), normal);
    gn_bias_auto_ortho(view, form, form == GN_AUTO_BIAS_NORMAL ? normal : out->slope_q12, offset);
    if (offset[2] <= -TOO_FAR) return GN_PATCH_LIT;
    if ((gn_abs32(offset[0]) | gn_abs32(offset[1]) | gn_abs32(offset[2])) >> 29) return GN_PATCH_UNEVEN;
    out->u.at += offset[0];
    out->v.at += offset[1];
    depth.at += offset[2];
    return limit_depth(view, r, &depth, &out->depth);
}

#if GN_PUNCTUAL_LIGHTS
/* In a spot's view, or the face of a cube that sees all corners. Returns 0 if the corners differ, or places between
 * them are not linear; 2 where nothing is nearer than the near plane. */
GN_HOT static int place_in_persp(gn_shading *s, const gn_light_view **view, const gn_light_state *light,
                                 patch_places *out)
{
    const gn_patch *p = &s->lattice.from.patch;
    int32_t nearest = INT32_MAX, farthest = 0, seen = 0, u[3] = {0, 0, 0}, v[3] = {0, 0, 0}, depth[3] = {0, 0, 0};
    const int32_t face = light->kind == GN_LIGHT_POINT ? gn_persp_face(p->from_q16[0]) : 0;
    *view += face;
    for (int k = 0; k < 3; k++) {
        gn_auto_bias form = (gn_auto_bias)light->auto_bias;
        gn_persp_place at;
        int32_t moved[3];
        if (light->kind == GN_LIGHT_POINT && gn_persp_face(p->from_q16[k]) != face) return 0;
        const int64_t less =
            gn_bias_auto_persp(*view, &form, gn_patch_face(s), gn_record_depth(&p->record), p->from_q16[k], moved);
        if (form != (gn_auto_bias)light->auto_bias) return 0;
        const int beyond = gn_persp_find_place(s->frame, *view, moved, less, &at);
        seen += beyond;
        if (!beyond) continue;
        if ((gn_abs32(at.u_q16) | gn_abs32(at.v_q16)) >> 28) return 0;
        u[k] = at.u_q16, v[k] = at.v_q16, depth[k] = (int32_t)(at.depth_q32 >> 2);
        nearest = gn_min32(nearest, at.far_q16), farthest = gn_max32(farthest, at.far_q16);
    }
    if (!seen) return 2;
    if (seen != 3 || (farthest - nearest) > nearest >> 3) return 0;
    for (int k = 1; k < 3; k++) /* a quarter of the change of distance: an eighth of a texel */
        if (gn_abs32(u[k] - u[0]) >> 18 || gn_abs32(v[k] - v[0]) >> 18)
            if ((farthest - nearest) > nearest >> 6) return 0;
    for (int k = 1; k < 3; k++) /* half of what slopes hold */
        if ((gn_abs32(u[k] - u[0]) | gn_abs32(v[k] - v[0]) | gn_abs32(depth[k] - depth[0])) >> 26) return 0;
    gn_record_slope(&p->record, s->frame, u[0], u[1], u[2], &out->u);
    gn_record_slope(&p->record, s->frame, v[0], v[1], v[2], &out->v);
    gn_record_slope(&p->record, s->frame, depth[0], depth[1], depth[2], &out->depth);
    return 1;
}
#endif

/* ---- Texels before the triangle's plane -------------------------------------------------------------------------- */

enum { ROUND_3X3 = 1024 /* half of 1/32 texel, Q16 */ };
enum { ASK_PX = 4 /* smaller triangles are looked up at once */ };
enum { TEXELS_UNKNOWN, TEXELS_LIT, TEXELS_DARK, TEXELS_EDGE };

/* Texels along an axis that pixels may read: from the first on. The record is not deep. */
GN_HOT static inline int32_t texels_read(const gn_patch_record *r, const gn_frame *frame, const gn_slope *at, int32_t k,
                                         int32_t *first)
{
    const int32_t part = ROUND_3X3 + 1024; /* and roundings of places */
    int32_t lo = INT32_MAX, hi = INT32_MIN;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        const int64_t more = (int64_t)at->dx * r->at[i][0] + (int64_t)at->dy * r->at[i][1];
        const int32_t corner = (int32_t)(more >> GN_K(frame, subpixel_bits));
        lo = gn_min32(lo, corner), hi = gn_max32(hi, corner);
    }
    *first = ((at->at + lo - part + 32768) >> 16) - (k + 1);
    return ((at->at + hi + part + 32768) >> 16) + k + 1 - *first;
}

/* Sets the texels that pixels may read. Returns 0 if they are many, or beyond the tile. */
GN_HOT static int find_texels_read(const gn_shading *s, const gn_light_view *view, const patch_places *at,
                                   gn_patch_texels *out)
{
    const gn_patch_record *r = &s->lattice.from.patch.record;
    out->w = texels_read(r, s->frame, &at->u, view->filter_idx, &out->u);
    out->h = texels_read(r, s->frame, &at->v, view->filter_idx, &out->v);
    if ((out->u | out->v) < 0 || out->u + out->w > view->tile_texels || out->v + out->h > GN_TILE_ROWS(view)) return 0;
    return out->w <= GN_PATCH_TEXELS && out->h <= GN_PATCH_TEXELS;
}

/* Compares texels with the plane through the places, which bias has moved: what a filter's taps, which are compared
 * with the pixel's own depth, do on average. Only directional views: places in others need the filter's precision near
 * a caster's foot. */
GN_HOT static int ask_texels(gn_shading *s, const gn_light_view *view, const patch_places *at, gn_patch_texels *out)
{
    if (s->lattice.from.patch.record.px < ASK_PX || s->lattice.from.patch.record.deep || view->perspective ||
        GN_VIEW_BITS(view) != 16)
        return TEXELS_UNKNOWN;
    const int32_t range_log2 = view->tile_log2 + view->depth_log2, up = 18 - range_log2;
    if (view->filter > GN_FILTER_3X3 || up < 0 || !find_texels_read(s, view, at, out)) return TEXELS_UNKNOWN;
    if ((gn_abs32(at->slope_q12[0]) | gn_abs32(at->slope_q12[1])) >> (7 + range_log2))
        return TEXELS_UNKNOWN; /* 2^-5 of the range per texel: steps below 2^25 */
    const int32_t across = at->slope_q12[0] * (1 << up), down = at->slope_q12[1] * (1 << up),
                  rise = across * (out->w - 1), fall = down * (out->h - 1);                           /* 2^30 each */
    const int64_t to_u = out->u * 65536 + 32768 - at->u.at, to_v = out->v * 65536 + 32768 - at->v.at; /* 2^22 */
    const int64_t first = at->depth.at + ((across * to_u + down * to_v) >> 16);                       /* 2^30 + 2^31 */
    if (first < 0 || first > GN_DEPTH_END_Q30) return TEXELS_UNKNOWN;
    int32_t depth = (int32_t)first;
    const uint16_t *texel = view->depth.d16 + out->v * view->tile_texels + out->u;
    uint32_t any = 0, all = UINT32_MAX >> (32 - out->w);
    if (first + gn_min32(rise, 0) + gn_min32(fall, 0) < 0) return TEXELS_UNKNOWN;
    if (first + gn_max32(rise, 0) + gn_max32(fall, 0) > GN_DEPTH_END_Q30) return TEXELS_UNKNOWN;
    GN_COUNT(windows, 1);
    GN_NOTE_TEXELS(&s->scratch->squares, view, out->u, out->v, out->w, out->h);
    for (int32_t row = 0; row < out->h; row++, texel += view->tile_texels, depth += down) {
        const uint32_t bits = gn_texels_before(texel, out->w, depth, across);
        out->word[row] = bits;
        any |= bits;
        all &= bits;
    }
    if (!any) return TEXELS_LIT;
    return all == UINT32_MAX >> (32 - out->w) ? TEXELS_DARK : TEXELS_EDGE;
}

/* Sets the values that pixels look up, if any. Returns what gn_patch_find_shadow() does. */
GN_HOT static int set_places(gn_shading *s, const gn_light_view *view, const patch_places *at, gn_patch_light *light)
{
    const int said = ask_texels(s, view, at, &light->texels);
    if (said == TEXELS_LIT) return GN_PATCH_LIT;
    if (said == TEXELS_DARK && light->strength_uq16 == 65536) return GN_PATCH_DARK;
    if ((gn_abs32(at->depth.dx) | gn_abs32(at->depth.dy)) >> 25) return GN_PATCH_UNEVEN;
    light->view = view;
    light->has_words = said == TEXELS_EDGE;
    light->u_q16 = at->u;
    light->v_q16 = at->v;
    light->depth_q30 = at->depth;
    return GN_PATCH_EDGE;
}

GN_HOT int gn_patch_find_shadow(gn_shading *s, uint32_t light_idx, gn_patch_light *light)
{
    const gn_frame *frame = s->frame;
    const gn_light_state *state = &frame->light[light_idx];
    gn_patch *p = &s->lattice.from.patch;
    const gn_light_view *view;
    patch_places at;
    if (!gn_shadow_is_realtime(state, 65536)) return GN_PATCH_LIT;
    view = &frame->view[state->view_idx];
    if (!state->auto_bias || gn_shadow_has_plane(frame, view)) return GN_PATCH_UNEVEN;
    const int reach = find_patch_reach(s);
    if (reach != GN_REACH_EVEN) return reach == GN_REACH_NONE ? GN_PATCH_LIT : GN_PATCH_UNEVEN;
    light->strength_uq16 = gn_mul_uq16(state->strength_uq16, p->g_uq16);
#if GN_PUNCTUAL_LIGHTS
    if (view->perspective) {
        const int placed = place_in_persp(s, &view, state, &at);
        if (placed != 1) return placed ? GN_PATCH_LIT : GN_PATCH_UNEVEN;
        return set_places(s, view, &at, light);
    }
#endif
    if (!view->border_lit) view += p->cascade;
    const int placed = place_in_ortho(s, view, (gn_auto_bias)state->auto_bias, &at);
    if (placed != GN_PATCH_EDGE) return placed;
    return set_places(s, view, &at, light);
}

/* Attenuations by the words of texels: 1, 2x2 or 4x4 of them a pixel, from (u, v) on. */
GN_HOT static void attenuation_by_words(gn_shading *s, const gn_patch_light *light, gn_row_value u, gn_row_value v,
                                        int32_t n)
{
    const gn_patch_texels *t = &light->texels;
    const int32_t filter = light->view->filter,
                  taps = filter == GN_FILTER_HARD  ? 1
                         : filter == GN_FILTER_3X3 ? 4
                                                   : 2,
                  bits = GN_FILTER_BITS(s->frame);
    const int32_t first = (taps == 4 ? ROUND_3X3 : 0) + 32768 - taps * 32768; /* of the first tap */
    const uint32_t ones = (1U << taps) - 1;
    u.at += first - t->u * 65536, v.at += first - t->v * 65536;
    for (uint32_t *out = s->lattice.from.patch.attenuation, *end = out + n; out < end;
         out++, u.at += u.step, v.at += v.step) {
        const int32_t left = gn_max32(0, gn_min32(u.at >> 16, t->w - taps)), /* roundings: up to a texel beyond */
            top = gn_max32(0, gn_min32(v.at >> 16, t->h - taps));
        const uint32_t *word = t->word + top;
        const uint32_t upper = word[0] >> left & ones, lower = word[taps - 1] >> left & ones;
        uint32_t any = upper | lower, all = upper & lower, b = 0, c = 0;
        if (GN_FILTER_MAX >= 2 && taps == 4) {
            b = word[1] >> left & ones, c = word[2] >> left & ones;
            any |= b | c, all &= b & c;
        }
        if (!any) *out = 65536U;
        else if (all == ones) *out = 0;
        else if (GN_FILTER_MAX >= 2 && taps == 4) *out = gn_tent_of_4x4(upper, b, c, lower, u.at, v.at);
        else *out = gn_tent_of_2x2(upper, lower, u.at, v.at, bits);
    }
}

/* Attenuations by the filter, of n receivers from r on, at depths that are limited to the view's range. */
GN_HOT static void attenuation_by_filter(gn_shading *s, const gn_light_view *view, gn_receiver *r, int32_t u_step,
                                         int32_t v_step, gn_row_value depth_q30, int32_t n)
{
    for (uint32_t *out = s->lattice.from.patch.attenuation, *end = out + n; out < end;
         out++, depth_q30.at += depth_q30.step) {
        r->depth_q32 = (uint32_t)gn_max32(0, gn_min32(depth_q30.at, (1 << 30) - 1)) << 2;
        GN_NOTE_LOOKUP(&s->scratch->squares, s->frame, view, r);
        *out = gn_filter_attenuation(s->frame, view, r);
        r->u_q16 += u_step;
        r->v_q16 += v_step;
        r->pixel_x++;
    }
}

GN_HOT void gn_patch_attenuation(gn_shading *s, const gn_patch_light *light, int32_t x, int32_t y, int32_t n)
{
    const gn_patch_record *record = &s->lattice.from.patch.record;
    const gn_row_value u = gn_record_row_of(record, &light->u_q16, x, y),
                       v = gn_record_row_of(record, &light->v_q16, x, y);
    uint32_t *out = s->lattice.from.patch.attenuation;
    GN_COUNT(edge_lookups, n);
    if (light->has_words) attenuation_by_words(s, light, u, v, n);
    else {
        gn_receiver r = {u.at, v.at, 0, {0, 0}, x, y};
        attenuation_by_filter(s, light->view, &r, u.step, v.step, gn_record_row_of(record, &light->depth_q30, x, y), n);
    }
    for (int32_t i = 0; light->strength_uq16 != 65536 && i < n; i++)
        out[i] = 65536U - gn_mul_uq16(65536U - out[i], light->strength_uq16);
}
#else
GN_HOT int gn_patch_find_shadow(gn_shading *s, uint32_t light_idx, gn_patch_light *light)
{
    (void)light;
    return GN_SHADOWS && gn_shadow_is_realtime(&s->frame->light[light_idx], 65536) ? GN_PATCH_UNEVEN : GN_PATCH_LIT;
}

GN_HOT void gn_patch_attenuation(gn_shading *s, const gn_patch_light *light, int32_t x, int32_t y, int32_t n)
{
    (void)light, (void)x, (void)y;
    for (int32_t i = 0; i < n; i++) s->lattice.from.patch.attenuation[i] = 65536;
}
#endif

#endif
