/* Shadows on patches: the places of the corners in a light's view, and attenuations along rows of pixels. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "light/gn_bias.h"
#include "shade/gn_patch.h"
#include "shade/gn_record.h"
#include "shade/gn_shadow.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_persp.h"

#if GN_INTERPOLATES

#if GN_SHADOWS

enum { TOO_FAR = 1 << 29 /* texels, Q16: of an offset that no tile is deep enough for */ };

/* Where the corners are looked up: u, v in texels, Q16, and depth, a share of the view's range, Q30. */
typedef struct {
    int32_t u[3], v[3], depth[3];
} patch_places;

/* The cascade of all three corners, and the strength of shadows at each. Returns 0 if the corners differ, or cascades
 * are blended. Found once. */
GN_HOT static int find_patch_cascade(gn_shading *s)
{
    gn_patch *p = &s->patch;
    const gn_frame *frame = s->frame;
    const gn_patch_record *r = &p->record;
    if (p->reach != GN_REACH_UNKNOWN) return p->reach == GN_REACH_EVEN;
    p->reach = GN_REACH_UNEVEN;
    s->surface.shadowed = 1;
    gn_record_find_depths(&p->record, frame);
    for (int k = 0; k < 3; k++) {
        const int32_t bits = GN_K(frame, subpixel_bits) - 1, z_q16 = gn_record_depth(r, k);
        gn_sample_find_cascade(frame, r->tri->x[k] >> bits, -r->tri->y[k] >> bits, z_q16, &s->sample);
        p->strength_uq16[k] = gn_shadow_distance(frame, &s->surface, &s->sample);
        if (k && s->sample.cascade != p->cascade) return 0;
        p->cascade = s->sample.cascade;
        const int blends = GN_BLENDED_CASCADES && frame->scene->shadow.blend != GN_BLEND_HARD;
        if (blends && p->cascade != GN_CASCADE_NONE && p->cascade != GN_LAST_CASCADE(frame) &&
            s->sample.value[GN_VALUE_FADE] != 65536)
            return 0;
    }
    p->reach = GN_REACH_EVEN;
    return 1;
}

/* Texels along a directional view's axis, Q16, as a share of its range. */
GN_HOT static inline int32_t depth_share_q30(const gn_light_view *view, int32_t depth_q16)
{
    const int32_t up = 14 - view->tile_log2 - view->depth_log2;
    if (up < 0) return depth_q16 >> gn_min32(-up, 31);
    return gn_max32(-(1 << 29) >> up, gn_min32(depth_q16, ((1 << 30) - 1) >> up)) * (1 << up);
}

/* In a directional view. Returns 0 where bias lights everything. */
GN_HOT static int place_in_ortho(gn_shading *s, const gn_light_view *view, gn_auto_bias form, patch_places *out)
{
    const gn_ortho_fit *fit = &view->fit.ortho;
    int32_t face[3], offset[3];
    gn_bias_auto_face(view, form, gn_patch_face(s), face);
    gn_bias_auto_ortho(view, form, face, offset);
    if (offset[2] <= -TOO_FAR) return 0;
    for (int k = 0; k < 3; k++) {
        out->u[k] = gn_record_place(&s->patch.record, s->frame, k, &fit->ray[0], fit->ray_shift) + offset[0];
        out->v[k] = gn_record_place(&s->patch.record, s->frame, k, &fit->ray[1], fit->ray_shift) + offset[1];
        const int32_t depth = gn_record_place(&s->patch.record, s->frame, k, &fit->ray[2], fit->ray_shift) + offset[2];
        out->depth[k] = depth_share_q30(view, depth);
    }
    return 1;
}

#if GN_PUNCTUAL_LIGHTS
/* In a spot's view, or the face of a cube that sees all corners. Returns 0 if the corners differ, or places between
 * them are not linear; 2 where nothing is nearer than the near plane. */
GN_HOT static int place_in_persp(gn_shading *s, const gn_light_view **view, const gn_light_state *light, patch_places *out)
{
    const gn_patch *p = &s->patch;
    int32_t nearest = INT32_MAX, farthest = 0, seen = 0;
    const int32_t face = light->kind == GN_LIGHT_POINT ? gn_persp_face(p->from_q16[0]) : 0;
    *view += face;
    for (int k = 0; k < 3; k++) {
        gn_auto_bias form = (gn_auto_bias)light->auto_bias;
        gn_persp_place at;
        int32_t moved[3];
        if (light->kind == GN_LIGHT_POINT && gn_persp_face(p->from_q16[k]) != face) return 0;
        const int64_t less = gn_bias_auto_persp(*view, &form, gn_patch_face(s), gn_record_depth(&p->record, k),
                                                p->from_q16[k], moved);
        if (form != (gn_auto_bias)light->auto_bias) return 0;
        seen += gn_persp_find_place(s->frame, *view, moved, less, &at);
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

/* Sets the values that pixels look up. */
GN_HOT static void set_places(gn_patch_light *light, const patch_places *at)
{
    gn_patch_set(&light->u_q16, at->u[0], at->u[1], at->u[2]);
    gn_patch_set(&light->v_q16, at->v[0], at->v[1], at->v[2]);
    gn_patch_set(&light->depth_q30, at->depth[0], at->depth[1], at->depth[2]);
}

GN_HOT int gn_patch_find_shadow(gn_shading *s, uint32_t light_idx, gn_patch_light *light)
{
    const gn_frame *frame = s->frame;
    const gn_light_state *state = &frame->light[light_idx];
    gn_patch *p = &s->patch;
    const gn_light_view *view = &frame->view[state->view_idx];
    uint32_t k[3], any = 0;
    patch_places at;
    if (!gn_shadow_is_realtime(state, 65536)) return 1;
    if (!state->auto_bias || gn_shadow_has_plane(frame, view) || !find_patch_cascade(s)) return 0;
    for (int i = 0; i < 3; i++) any |= k[i] = gn_mul_uq16(state->strength_uq16, p->strength_uq16[i]);
    if (!any) return 1;
    gn_patch_set(&light->strength_q16, (int32_t)k[0], (int32_t)k[1], (int32_t)k[2]);
#if GN_PUNCTUAL_LIGHTS
    if (view->perspective) {
        const int placed = place_in_persp(s, &view, state, &at);
        if (placed != 1) return placed;
        light->view = view;
        set_places(light, &at);
        return 1;
    }
#endif
    if (!view->border_lit) view += p->cascade;
    if (!place_in_ortho(s, view, (gn_auto_bias)state->auto_bias, &at)) return 1;
    light->view = view;
    set_places(light, &at);
    return 1;
}

GN_HOT void gn_patch_attenuation(gn_shading *s, const gn_patch_light *light, const gn_patch_weights ends[2], int32_t x,
                                 int32_t y, int32_t n)
{
    const gn_row_value u = gn_patch_row(&light->u_q16, ends, n), v = gn_patch_row(&light->v_q16, ends, n),
                       depth = gn_patch_row(&light->depth_q30, ends, n),
                       strength = gn_patch_row(&light->strength_q16, ends, n);
    gn_receiver r = {u.at, v.at, 0, {0, 0}, x, y};
    int32_t depth_q30 = depth.at, strength_q16 = strength.at;
    uint32_t *out = s->patch.attenuation;
    GN_COUNT(edge_lookups, n);
    for (const uint32_t *end = out + n; out < end; out++) {
        r.depth_q32 = (uint32_t)gn_max32(0, gn_min32(depth_q30, (1 << 30) - 1)) << 2;
        *out = gn_filter_attenuation(s->frame, light->view, &r);
        if (strength_q16 != 65536)
            *out = 65536U - gn_mul_uq16(65536U - *out, (uint32_t)gn_max32(0, gn_min32(strength_q16, 65536)));
        r.u_q16 += u.step;
        r.v_q16 += v.step;
        depth_q30 += depth.step;
        strength_q16 += strength.step;
        r.pixel_x++;
    }
}
#else
GN_HOT int gn_patch_find_shadow(gn_shading *s, uint32_t light_idx, gn_patch_light *light)
{
    (void)s, (void)light_idx, (void)light;
    return 1;
}

GN_HOT void gn_patch_attenuation(gn_shading *s, const gn_patch_light *light, const gn_patch_weights ends[2], int32_t x,
                                 int32_t y, int32_t n)
{
    (void)light, (void)ends, (void)x, (void)y;
    for (int32_t i = 0; i < n; i++) s->patch.attenuation[i] = 65536;
}
#endif

#endif
