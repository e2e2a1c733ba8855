/* Shadows on patches: the places of the corners in a light's view, and attenuations along rows of pixels. */
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

/* Where the corners are looked up: u, v in texels, Q16, and depth, a share of the view's range, Q30. */
typedef struct {
    int32_t u[3], v[3], depth[3];
    int32_t slope_q12[2]; /* of depth over u and v, both in texels: directional views */
} patch_places;

/* ---- Reach ------------------------------------------------------------------------------------------------------- */

/* The cascade of the triangle, and the strength of shadows at each corner. Returns 0 if it lies in several, strength is
 * not close to linear between corners, or distance is measured from the camera. Found once. [D4] [D6] */
GN_HOT static int find_patch_reach(gn_shading *s)
{
    gn_patch *p = &s->lattice.from.patch;
    const gn_patch_record *r = &p->record;
    const gn_frame *frame = s->frame;
    int32_t lo = INT32_MAX, hi = 0;
    uint32_t any = 0;
    if (p->reach != GN_REACH_UNKNOWN) return p->reach == GN_REACH_EVEN;
    p->reach = GN_REACH_EVEN;
    gn_record_find_depths(&p->record, frame);
    p->cascade = p->shared->of.cascade;
    for (int k = 0; k < 3; k++) p->strength_uq16[k] = 65536;
    if (p->cascade >= 0) return 1;
    p->reach = GN_REACH_UNEVEN;
    if (frame->scene->shadow.distance_mode == GN_DISTANCE_RADIUS) return 0;
    for (int k = 0; k < 3; k++) {
        const int32_t z = gn_record_depth(r, k);
        lo = gn_min32(lo, z), hi = gn_max32(hi, z);
        any |= p->strength_uq16[k] = gn_shadow_distance_fade(frame, z);
    }
    if (gn_cell_fading(frame, p->strength_uq16, 3) < 0) return 0;
    lo -= (lo >> 16) + 1, hi += (hi >> 16) + 1; /* what depths are off by */
    const gn_rect px = {r->x0 - r->px - 1, r->y0 - 1, r->x0 + r->px + 2, r->y0 + r->px + 2};
    p->cascade = any ? gn_cascade_of_region(frame, lo, hi, &px) : 0;
    p->reach = p->cascade < 0 ? GN_REACH_UNEVEN : GN_REACH_EVEN;
    return p->cascade >= 0;
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

/* In a directional view. Returns GN_PATCH_EDGE, GN_PATCH_LIT where bias lights everything, or GN_PATCH_UNEVEN far
 * outside, or where its range ends. */
GN_HOT static int place_in_ortho(gn_shading *s, const gn_light_view *view, gn_auto_bias form, patch_places *out)
{
    const gn_ortho_fit *fit = &view->fit.ortho;
    const int32_t *face = gn_patch_face(s);
    int32_t slope[3], normal[3], offset[3];
    gn_bias_auto_face(view, GN_AUTO_BIAS_DEPTH, face, slope);
    if (form == GN_AUTO_BIAS_NORMAL) gn_bias_auto_face(view, form, face, normal);
    gn_bias_auto_ortho(view, form, form == GN_AUTO_BIAS_NORMAL ? normal : slope, offset);
    for (int i = 0; i < 2; i++) out->slope_q12[i] = slope[i];
    if (offset[2] <= -TOO_FAR) return GN_PATCH_LIT;
    if ((gn_abs32(offset[0]) | gn_abs32(offset[1]) | gn_abs32(offset[2])) >> 29) return GN_PATCH_UNEVEN;
    if (!gn_record_places(&s->lattice.from.patch.record, s->frame, &fit->ray[0], fit->ray_shift, out->u) ||
        !gn_record_places(&s->lattice.from.patch.record, s->frame, &fit->ray[1], fit->ray_shift, out->v) ||
        !gn_record_places(&s->lattice.from.patch.record, s->frame, &fit->ray[2], fit->ray_shift, out->depth))
        return GN_PATCH_UNEVEN;
    int n_near = 0, n_far = 0;
    for (int k = 0; k < 3; k++) {
        out->u[k] += offset[0];
        out->v[k] += offset[1];
        out->depth[k] = gn_depth_q30(view, out->depth[k] + offset[2]);
        n_near += out->depth[k] <= GN_DEPTH_LEAST_Q30;
        n_far += out->depth[k] >= GN_DEPTH_END_Q30;
    }
    return n_near % 3 || n_far % 3 ? GN_PATCH_UNEVEN : GN_PATCH_EDGE; /* some bend the plane */
}

#if GN_PUNCTUAL_LIGHTS
/* In a spot's view, or the face of a cube that sees all corners. Returns 0 if the corners differ, or places between
 * them are not linear; 2 where nothing is nearer than the near plane. */
GN_HOT static int place_in_persp(gn_shading *s, const gn_light_view **view, const gn_light_state *light,
                                 patch_places *out)
{
    const gn_patch *p = &s->lattice.from.patch;
    int32_t nearest = INT32_MAX, farthest = 0, seen = 0;
    const int32_t face = light->kind == GN_LIGHT_POINT ? gn_persp_face(p->from_q16[0]) : 0;
    *view += face;
    for (int k = 0; k < 3; k++) {
        gn_auto_bias form = (gn_auto_bias)light->auto_bias;
        gn_persp_place at;
        int32_t moved[3];
        if (light->kind == GN_LIGHT_POINT && gn_persp_face(p->from_q16[k]) != face) return 0;
        const int64_t less =
            gn_bias_auto_persp(*view, &form, gn_patch_face(s), gn_record_depth(&p->record, k), p->from_q16[k], moved);
        if (form != (gn_auto_bias)light->auto_bias) return 0;
        const int beyond = gn_persp_find_place(s->frame, *view, moved, less, &at);
        seen += beyond;
        if (!beyond) continue;
        if ((gn_abs32(at.u_q16) | gn_abs32(at.v_q16)) >> 28) return 0;
        out->u[k] = at.u_q16, out->v[k] = at.v_q16, out->depth[k] = (int32_t)(at.depth_q32 >> 2);
        nearest = gn_min32(nearest, at.far_q16), farthest = gn_max32(farthest, at.far_q16);
    }
    if (!seen) return 2;
    if (seen != 3 || (farthest - nearest) > nearest >> 3) return 0;
    for (int k = 1; k < 3; k++) /* a quarter of the change of distance: an eighth of a texel */
        if (gn_abs32(out->u[k] - out->u[0]) >> 18 || gn_abs32(out->v[k] - out->v[0]) >> 18)
            if ((farthest - nearest) > nearest >> 6) return 0;
    return 1;
}
#endif

/* ---- Texels before the triangle's plane -------------------------------------------------------------------------- */

enum { ROUND_3X3 = 1024 /* half of 1/32 texel, Q16 */ };
enum { ASK_PX = 4 /* smaller triangles are looked up at once */ };
enum { TEXELS_UNKNOWN, TEXELS_LIT, TEXELS_DARK, TEXELS_EDGE };

GN_HOT static inline int32_t smallest(const int32_t v[3])
{
    return gn_min32(gn_min32(v[0], v[1]), v[2]);
}

GN_HOT static inline int32_t largest(const int32_t v[3])
{
    return gn_max32(gn_max32(v[0], v[1]), v[2]);
}

/* Sets the texels that pixels may read. Returns 0 if they are many, or beyond the tile. */
GN_HOT static int find_texels_read(const gn_light_view *view, const patch_places *at, gn_patch_texels *out)
{
    const int32_t k = view->filter_idx, part = ROUND_3X3 + 1024; /* and roundings of places between the corners */
    out->u = ((smallest(at->u) - part + 32768) >> 16) - (k + 1);
    out->v = ((smallest(at->v) - part + 32768) >> 16) - (k + 1);
    out->w = ((largest(at->u) + part + 32768) >> 16) + k + 1 - out->u;
    out->h = ((largest(at->v) + part + 32768) >> 16) + k + 1 - out->v;
    if ((out->u | out->v) < 0 || out->u + out->w > view->tile_texels || out->v + out->h > GN_TILE_ROWS(view)) return 0;
    return out->w <= GN_PATCH_TEXELS && out->h <= GN_PATCH_TEXELS;
}

/* Compares texels with the plane through the places, which bias has moved: what a filter's taps, which are compared
 * with the pixel's own depth, do on average. Only directional views: places in others need the filter's precision near
 * a caster's foot. */
GN_HOT static int ask_texels(gn_shading *s, const gn_light_view *view, const patch_places *at, gn_patch_texels *out)
{
    if (s->lattice.from.patch.record.px < ASK_PX || view->perspective || GN_VIEW_BITS(view) != 16)
        return TEXELS_UNKNOWN;
    const int32_t range_log2 = view->tile_log2 + view->depth_log2, up = 18 - range_log2;
    if (view->filter > GN_FILTER_3X3 || up < 0 || !find_texels_read(view, at, out)) return TEXELS_UNKNOWN;
    if ((gn_abs32(at->slope_q12[0]) | gn_abs32(at->slope_q12[1])) >> (7 + range_log2))
        return TEXELS_UNKNOWN; /* 2^-5 of the range per texel: steps below 2^25 */
    const int32_t across = at->slope_q12[0] * (1 << up), down = at->slope_q12[1] * (1 << up),
                  rise = across * (out->w - 1), fall = down * (out->h - 1);
    const int64_t to_u = out->u * 65536 + 32768 - at->u[0], to_v = out->v * 65536 + 32768 - at->v[0]; /* 2^22 */
    const int64_t first = at->depth[0] + ((across * to_u + down * to_v) >> 16);                       /* 2^30 + 2^31 */
    if (first < 0 || first > GN_DEPTH_END_Q30) return TEXELS_UNKNOWN;
    int32_t depth = (int32_t)first;
    const uint16_t *texel = view->depth.d16 + out->v * view->tile_texels + out->u;
    uint32_t any = 0, all = UINT32_MAX >> (32 - out->w);
    if (depth + gn_min32(rise, 0) + gn_min32(fall, 0) < 0) return TEXELS_UNKNOWN;
    if (depth + gn_max32(rise, 0) + gn_max32(fall, 0) > GN_DEPTH_END_Q30) return TEXELS_UNKNOWN;
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
    if (said == TEXELS_DARK && !light->fades) return GN_PATCH_DARK;
    if (s->lattice.from.patch.record.bent) return GN_PATCH_UNEVEN;
    light->view = view;
    light->has_words = said == TEXELS_EDGE;
    gn_patch_set(&light->u_q16, at->u[0], at->u[1], at->u[2]);
    gn_patch_set(&light->v_q16, at->v[0], at->v[1], at->v[2]);
    gn_patch_set(&light->depth_q30, at->depth[0], at->depth[1], at->depth[2]);
    return GN_PATCH_EDGE;
}

GN_HOT int gn_patch_find_shadow(gn_shading *s, uint32_t light_idx, gn_patch_light *light)
{
    const gn_frame *frame = s->frame;
    const gn_light_state *state = &frame->light[light_idx];
    gn_patch *p = &s->lattice.from.patch;
    const gn_light_view *view;
    uint32_t k[3], any = 0;
    patch_places at;
    if (!gn_shadow_is_realtime(state, 65536)) return GN_PATCH_LIT;
    view = &frame->view[state->view_idx];
    if (!state->auto_bias || gn_shadow_has_plane(frame, view) || !find_patch_reach(s)) return GN_PATCH_UNEVEN;
    for (int i = 0; i < 3; i++) any |= k[i] = gn_mul_uq16(state->strength_uq16, p->strength_uq16[i]);
    if (!any) return GN_PATCH_LIT;
    light->fades = (k[0] & k[1] & k[2]) != 65536; /* at most that */
    if (light->fades) gn_patch_set(&light->strength_q16, (int32_t)k[0], (int32_t)k[1], (int32_t)k[2]);
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

/* Attenuations by the words of texels: 1, 2x2 or 4x4 of them a pixel. */
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

/* Attenuations by the filter, of n receivers from r on. */
GN_HOT static void attenuation_by_filter(gn_shading *s, const gn_patch_light *light, const gn_patch_span *span,
                                         gn_receiver *r, int32_t u_step, int32_t v_step, int32_t n)
{
    gn_row_value depth = gn_patch_row(&light->depth_q30, span);
    for (uint32_t *out = s->lattice.from.patch.attenuation, *end = out + n; out < end; out++, depth.at += depth.step) {
        r->depth_q32 = (uint32_t)gn_max32(0, gn_min32(depth.at, (1 << 30) - 1)) << 2;
        GN_NOTE_LOOKUP(&s->scratch->squares, s->frame, light->view, r);
        *out = gn_filter_attenuation(s->frame, light->view, r);
        r->u_q16 += u_step;
        r->v_q16 += v_step;
        r->pixel_x++;
    }
}

GN_HOT void gn_patch_attenuation(gn_shading *s, const gn_patch_light *light, const gn_patch_span *span, int32_t x,
                                 int32_t y, int32_t n)
{
    const gn_row_value u = gn_patch_row(&light->u_q16, span), v = gn_patch_row(&light->v_q16, span);
    uint32_t *out = s->lattice.from.patch.attenuation;
    GN_COUNT(edge_lookups, n);
    if (light->has_words) attenuation_by_words(s, light, u, v, n);
    else {
        gn_receiver r = {u.at, v.at, 0, {0, 0}, x, y};
        attenuation_by_filter(s, light, span, &r, u.step, v.step, n);
    }
    if (!light->fades) return;
    gn_row_value strength = gn_patch_row(&light->strength_q16, span);
    for (int32_t i = 0; i < n; i++, strength.at += strength.step)
        out[i] = 65536U - gn_mul_uq16(65536U - out[i], (uint32_t)gn_max32(0, gn_min32(strength.at, 65536)));
}
#else
GN_HOT int gn_patch_find_shadow(gn_shading *s, uint32_t light_idx, gn_patch_light *light)
{
    (void)light;
    return GN_SHADOWS && gn_shadow_is_realtime(&s->frame->light[light_idx], 65536) ? GN_PATCH_UNEVEN : GN_PATCH_LIT;
}

GN_HOT void gn_patch_attenuation(gn_shading *s, const gn_patch_light *light, const gn_patch_span *span, int32_t x,
                                 int32_t y, int32_t n)
{
    (void)light, (void)span, (void)x, (void)y;
    for (int32_t i = 0; i < n; i++) s->lattice.from.patch.attenuation[i] = 65536;
}
#endif

#endif
