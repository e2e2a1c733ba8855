/* Corners: points of surfaces, and the light that arrives there. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_surface.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_views.h"

/* ---- Once per surface -------------------------------------------------------------------------------------------- */

#if GN_INTERPOLATES
/* Whether the receiver's offset is along the normal, and what lights leave without masks. */
GN_HOT static void begin_light(gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot)
{
    const gn_light_state *light = s->light[slot].state;
    gn_lattice_light *out = &l->light[slot];
    out->lifts = 0;
    out->realtime = s->shadowed && gn_shadow_is_realtime(light, 65536);
    out->masked =
        s->masked && light->mask_channel >= 0 && !(out->realtime && frame->scene->shadow.mixing == GN_MIXING_DISTANCE);
    out->lit_uq16 = out->dark_uq16 = 65536;
    if (out->realtime) out->dark_uq16 = gn_shadow_mixed(frame, light, 65536, 65536, 0);
#if GN_SHADOWS
    if (!s->shadowed || light->view_idx < 0) return;
    const gn_light_view *view = &frame->view[light->view_idx];
    if (light->kind == GN_LIGHT_DIRECTIONAL && !view->border_lit)
        view += GN_LAST_CASCADE(frame); /* the first may be empty */
    const int32_t *b = frame->scene->lights[s->light[slot].idx].bias_receiver_q16;
    out->lifts = !light->auto_bias && view->filter != GN_FILTER_DISK && (!GN_RECEIVER_BIAS || !(b[0] | b[1] | b[3]));
#endif
    (void)frame;
}

GN_HOT void gn_corner_begin_lights(gn_lattice *l, const gn_frame *frame, const gn_surface *s)
{
    l->offset_view = NULL;
    for (uint32_t i = 0; i < s->n_lights; i++) begin_light(l, frame, s, i);
}

GN_HOT int gn_corner_begin(gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_rect *rect)
{
    gn_corner_forget_forms(l);
    l->anchor.found = 0;
    l->cascade = -1;
#if GN_PLANES && GN_SHADOWS
    l->slope_view = NULL;
#endif
    l->plane.fits = gn_screen_plane_find(&l->plane, frame, s, rect);
    l->anchor.known = (uint8_t)!l->plane.fits; /* it has none */
    return l->plane.fits;
}
#endif

GN_HOT void gn_corner_begin_pixels(gn_lattice *l, const gn_frame *frame, gn_surface *s)
{
    gn_surface_use_bary(frame, s);
#if GN_INTERPOLATES
    gn_corner_begin_lights(l, frame, s);
    gn_corner_forget_forms(l);
    l->anchor.known = 1;
    l->anchor.found = 0;
    l->cascade = -1;
    l->plane.fits = 0;
#endif
#if GN_PLANES && GN_SHADOWS
    l->slope_view = NULL;
#endif
    (void)l;
}

/* ---- The point --------------------------------------------------------------------------------------------------- */

/* A point of the plane. */
typedef struct {
    int of_pixel, is_lone; /* is_lone: found in 64 bits */
    int32_t b_q28[2];      /* barycentrics */
    int32_t n_q30[3], unit_q30[3];
#if GN_SPECULAR
    int32_t to_eye_q30[3];
#endif
} corner_point;

#if GN_INTERPOLATES
/* By the plane of the block. Returns 0 where that does not tell, or far off the triangle. */
GN_HOT static int find_point(const gn_screen_plane *plane, const gn_frame *frame, const gn_surface *s, gn_corner *c,
                             corner_point *p)
{
    if (!plane->fits) return 0;
#if GN_ORTHOGRAPHIC
    if (GN_FLAT_Q16(frame)) {
        c->z_q16 = gn_corner_flat_depth(plane, s, c->x, c->y, p->b_q28);
        return c->z_q16 != 0;
    }
#endif
    int32_t dx = c->x - plane->x, dy = c->y - plane->y, w = gn_slope_at(&plane->w, dx, dy);
    if (w < plane->w_least || w >= 1 << 30) return 0;
    const int32_t clz = gn_clz32((uint32_t)w), shift = plane->z_shift - clz;
    const uint32_t recip = gn_recip_norm((uint32_t)w << clz, GN_RECIP_STEPS(frame));
    if (shift < 1 || shift > 31) return 0;
    const uint32_t z = ((gn_umul_high(s->depth_scale.mant, recip) >> (shift - 1)) + 1) >> 1;
    if (z < (uint32_t)s->z_min_q16 >> 1 || z >> 1 > (uint32_t)s->z_max_q16 || z > INT32_MAX) return 0;
    c->z_q16 = (int32_t)z;
    if (!GN_HAS_BARY(s)) return 1;
    int32_t half = (int32_t)(recip >> 1);
    GN_KEEP(half); /* signed: one multiplication */
    GN_UNROLL
    for (int k = 0; k < 2; k++) {
        int32_t at = gn_slope_at(&plane->b[k], dx, dy);
        if (gn_abs32(at) >= 2 * (uint32_t)w) return 0;
        p->b_q28[k] = gn_mul_high(at, half) * (1 << (clz - 2));
    }
    return 1;
}
#endif

/* A pixel of the surface in 64 bits: where pixels are shaded each for itself; where 32 bits do not hold the block's
 * plane; or where the surface is so steep that a pixel's centre lies beside it. Values are limited to the surface's;
 * seen edge on they are those of some point. */
GN_HOT static GN_NOINLINE void find_lone_point(const gn_frame *frame, const gn_surface *s, gn_corner *c,
                                               corner_point *p)
{
    const int32_t px = 2 * c->x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * c->y;
    const uint32_t focal2 = frame->cam.focal2_px_q16;
    int32_t b_q30[2] = {(1 << 30) / 3, (1 << 30) / 3};
    int64_t z = s->z_min_q16;
    gn_ray_recip r;
#if GN_ORTHOGRAPHIC
    const int flat = GN_FLAT_Q16(frame) != 0;
    const gn_plane *plane = flat ? &s->screen : &s->plane;
#else
    const int flat = 0;
    const gn_plane *plane = &s->plane;
#endif
    if (gn_plane_recip(&r, plane, px, py, focal2, flat ? 2 : GN_RECIP_STEPS(frame))) {
        /* of a pair the triangle at hand may be the other one; depth of parallel rays is that beside it, too */
        int beyond = 0;
#if GN_INTERPOLATES || GN_ORTHOGRAPHIC
        if (flat || GN_JOINED(s)) beyond = gn_bary_beyond(b_q30, &s->bary, &r, px, py, focal2);
#endif
        if (!beyond && (flat || GN_HAS_BARY(s))) gn_bary_at(b_q30, &s->bary, &r, px, py, focal2);
#if GN_ORTHOGRAPHIC
        for (int k = 0; flat && k < 3; k++) /* |b| < 2^31, |depth| < 2^31 */
            z = k ? z + gn_shr64((int64_t)b_q30[k - 1] * s->depth_q16[k], 30) : s->depth_q16[0];
        if (flat && !GN_JOINED(s)) gn_bary_at(b_q30, &s->bary, &r, px, py, focal2);
#endif
        if (!flat) {
            const int32_t shift = 95 - r.clz - s->depth_scale.exp;
            const uint64_t depth = (uint64_t)s->depth_scale.mant * r.recip; /* times 2^-shift; 2^62 .. 2^64 */
            z = shift > 63 ? 0 : shift < 33 ? INT32_MAX : (int64_t)(((depth >> (shift - 1)) + 1) >> 1);
        }
    }
    p->is_lone = 1;
    for (int k = 0; k < 2; k++) p->b_q28[k] = b_q30[k] >> 2;
    c->z_q16 = (int32_t)gn_clamp64(z, s->z_min_q16, s->z_max_q16);
}

/* a0 + b1 * a1 + b2 * a2 */
GN_HOT static inline int64_t at_point_64(const corner_point *p, int32_t a0, int32_t a1, int32_t a2)
{
    return a0 + (((int64_t)p->b_q28[0] * a1 + (int64_t)p->b_q28[1] * a2 + (1 << 27)) >> 28);
}

GN_HOT static inline int32_t at_point(const corner_point *p, int32_t a0, int32_t a1, int32_t a2)
{
    return (int32_t)at_point_64(p, a0, a1, a2);
}

/* Returns 0 if a component is 17/16 or more: outside of a triangle that bends much, where it could be up to 9. It is
 * limited to 1. */
GN_HOT static int find_normal(const gn_surface *s, gn_corner *c, corner_point *p)
{
    const int32_t(*n)[3] = s->normal_q30;
    const int64_t most = (1 << 30) + (1 << 26);
    int holds = 1;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        p->n_q30[i] = n[0][i];
        if (GN_SMOOTH(s)) {
            int64_t at = at_point_64(p, n[0][i], n[1][i], n[2][i]);
            if (at >= most || at <= -most) holds = 0;
            p->n_q30[i] = (int32_t)gn_clamp64(at, -(1 << 30), 1 << 30);
        }
#if GN_VERTEX_NORMALS
        c->normal_q30[i] = p->n_q30[i];
#endif
    }
    (void)c;
    return holds;
}

/* Of length 1. Light of the sun that is interpolated has no use for it. */
GN_HOT static void find_unit(const gn_frame *frame, const gn_surface *s, corner_point *p)
{
    GN_UNROLL
    for (int i = 0; i < 3; i++) p->unit_q30[i] = p->n_q30[i];
    if (GN_SMOOTH(s) && (s->n_punctual || s->specular || GN_VERTEX_COSINES != 3 || !GN_K(frame, vertex_light)))
        gn_length_unit(gn_length_of(GN_RECIP_STEPS(frame), p->n_q30), p->n_q30, p->unit_q30);
}

/* ---- Attributes -------------------------------------------------------------------------------------------------- */

GN_HOT static int32_t attribute(const gn_surface *s, const corner_point *p, int i)
{
    return at_point(p, s->attribute_q16[0][i], s->attribute_q16[1][i], s->attribute_q16[2][i]);
}

#if GN_TEXTURES
GN_HOT static void texture_at(const gn_surface *s, const corner_point *p, int32_t uv_q20[2])
{
    const gn_texture *texture = GN_SURFACE_TEXTURE(s);
    const int64_t(*uv)[2] = (const int64_t(*)[2])s->uv.uv_q16;
    (void)uv;
    GN_UNROLL
    for (int i = 0; i < 2; i++) {
#if GN_INTERPOLATES
        const int32_t e1 = (int32_t)uv[1][i], e2 = (int32_t)uv[2][i];
        if (!p->is_lone && e1 == uv[1][i] && e2 == uv[2][i]) { /* 2^29 * 2^31, twice */
            int64_t c_q20 = uv[0][i] * 16 + (((int64_t)p->b_q28[0] * e1 + (int64_t)p->b_q28[1] * e2) >> 24);
            uv_q20[i] = gn_texture_clamps(texture, i) ? gn_sat32(c_q20) : (int32_t)(uint32_t)c_q20;
            continue;
        }
#endif
        const int32_t b_q30[2] = {p->b_q28[0] * 4, p->b_q28[1] * 4};
        uv_q20[i] = gn_texture_coord(&s->uv, texture, b_q30, i);
    }
}
#endif

/* Baked light goes on outside of the triangle and may be negative there: limited to 0 it would bend what is between. */
GN_HOT static void attributes_at(const gn_surface *s, const corner_point *p, gn_corner *c)
{
    const int32_t most_q20 = p->of_pixel ? 1 << 30 : 1 << 23;
    for (int i = 0; i < 3; i++) {
        int32_t q20 = (int32_t)s->base_q20[i]; /* < 2^29 */
        if (GN_BAKED_LIGHT && s->baked) {
            const int64_t baked = (int64_t)s->albedo_uq16[i] * attribute(s, p, GN_ATTRIBUTE_BAKED + i) >> 12;
            q20 += (int32_t)gn_clamp64(baked, -(1 << 23), 1 << 28);
        }
        c->base_q20[i] = gn_min32(q20, most_q20);
#if GN_VERTEX_COLOURS
        if (GN_COLOURED(s)) c->tint_q16[i] = attribute(s, p, GN_ATTRIBUTE_RGB + i);
#endif
    }
#if GN_TEXTURES
    if (s->textured) texture_at(s, p, c->uv_q20);
#endif
#if GN_MASKS
    for (int i = 0; s->masked && s->object->mask_image && i < 2; i++)
        c->mask_uv_uq16[i] = attribute(s, p, GN_ATTRIBUTE_MASK + i);
#endif
}

#if GN_MASKS
/* A mask of the vertices may leave 0 .. 1 at corners outside of the triangle; one of an image does not. */
GN_HOT static int32_t mask_at(const gn_surface *s, const corner_point *p, const gn_corner *c, int32_t channel)
{
    if (!s->masked || channel < 0) return 65536;
    if (s->object->mask_image)
        return (int32_t)gn_texture_mask(s->object->mask_image, c->mask_uv_uq16[0], c->mask_uv_uq16[1],
                                        (uint32_t)channel);
    return attribute(s, p, GN_ATTRIBUTE_MASK + channel);
}
#endif

/* ---- Lights ------------------------------------------------------------------------------------------------------ */

#if GN_SHADOWS
/* The view that the point itself is looked up in. */
GN_HOT static uint8_t own_view(const gn_frame *frame, const gn_surface *s, const gn_light_state *light,
                               const gn_corner *c)
{
    if (!s->shadowed || light->view_idx < 0 || !light->strength_uq16) return GN_VIEW_NONE;
    if (light->kind == GN_LIGHT_SPOT ||
        (light->kind == GN_LIGHT_DIRECTIONAL && frame->view[light->view_idx].border_lit))
        return 0;
#if GN_PUNCTUAL_LIGHTS
    if (light->kind == GN_LIGHT_POINT) {
        int32_t from[3];
        gn_corner_from(c, light, from);
        return (uint8_t)gn_persp_face(from);
    }
#endif
    return c->cascade == GN_CASCADE_NONE ? GN_VIEW_NONE : c->cascade;
}
#endif

#if GN_SPECULAR
/* The direction to the viewer, in the world. */
GN_HOT static void find_eye(const gn_frame *frame, int32_t x, int32_t y, int32_t to_eye_q30[3])
{
    const gn_cam *cam = &frame->cam;
    const int32_t flat = GN_FLAT_Q16(frame), px = flat ? 0 : 2 * x + 1 - frame->picture.width,
                  py = flat ? 0 : frame->picture.height - 1 - 2 * y; /* of parallel rays: the axis */
    int64_t towards[3];
    for (int i = 0; i < 3; i++) /* 2^12 * 2^16 * 2^30, 2^32 * 2^30: halved */
        towards[i] = -((int64_t)cam->axis_q30[0][i] * px + (int64_t)cam->axis_q30[1][i] * py) * 32768 -
                     (int64_t)cam->axis_q30[2][i] * (int64_t)(cam->focal2_px_q16 >> 1);
    gn_normalise_q30(to_eye_q30, towards);
}

/* max(0, n . h)^(2^k), Q30, and h - n. [M3] */
GN_HOT static GN_NOINLINE int32_t highlight_q30(const gn_surface *s, const corner_point *p,
                                                const int32_t to_light_q30[3], int16_t lobe_q12[3])
{
    const int32_t *n_q30 = p->unit_q30, *to_eye_q30 = p->to_eye_q30;
    int32_t h[3];
    int64_t wide[3];
    for (int i = 0; i < 3; i++) wide[i] = (to_light_q30[i] >> 1) + (to_eye_q30[i] >> 1); /* |h| <= 1 */
    const int known = gn_normalise_q30(h, wide);
    for (int i = 0; GN_INTERPOLATES && i < 3; i++) lobe_q12[i] = (int16_t)(gn_sat32((int64_t)h[i] - n_q30[i]) >> 18);
    (void)lobe_q12;
    const int64_t dot = gn_dot_q30(n_q30, h);
    if (!known || dot <= 0) return 0;
    int32_t power = (int32_t)gn_clamp64(dot, 0, 1 << 30);
    for (int32_t k = 0; k < s->object->shininess_log2; k++) power = gn_mul_q30(power, power);
    return power;
}
#endif

#if GN_PUNCTUAL_LIGHTS
#if GN_INTERPOLATES
/* How a spot arrives, by how far a cosine is beyond that of its cone's edge. */
GN_HOT static int8_t arrives_by_rim(const gn_light_state *light, int32_t beyond_q30)
{
    const uint64_t share_q30 = gn_punctual_rim_q30(light, gn_abs32(beyond_q30));
    const int32_t whole = share_q30 >> 32 ? 126 : gn_min32((int32_t)(share_q30 >> 25), 126);
    return (int8_t)(beyond_q30 <= 0 ? -whole : gn_max32(whole, 1));
}
#endif

GN_HOT static void lamp_at(const gn_frame *frame, const gn_surface *s, const gn_light_state *light,
                           const corner_point *p, const gn_corner *c, gn_corner_light *at)
{
    int32_t from_q16[3];
    gn_corner_from(c, light, from_q16);
    const int32_t facing_q16 = gn_sat32(-gn_dot_q30(p->unit_q30, from_q16));
    gn_punctual_point point;
    at->irradiance_q24 = 0;
    at->arrives = GN_CORNER_DARK;
    if (facing_q16 <= 0 && (p->of_pixel || !(GN_SPECULAR && s->specular))) return;
    const int any = gn_punctual_at(frame, light, from_q16, &point);
#if GN_SPECULAR
    if (s->specular && any) {
        int32_t to_light_q30[3];
        for (int i = 0; i < 3; i++) to_light_q30[i] = gn_punctual_cosine_q30(&point, -from_q16[i]);
        at->highlight_q24 = gn_punctual_irradiance_q24(&point, highlight_q30(s, p, to_light_q30, at->lobe_q12));
    }
#endif
    if (facing_q16 <= 0) return;
    if (any) at->arrives = GN_CORNER_FULLY;
#if GN_INTERPOLATES
    if (light->kind == GN_LIGHT_SPOT && point.beyond_q30 != INT32_MAX)
        at->arrives = arrives_by_rim(light, any ? point.beyond_q30 : gn_min32(point.beyond_q30, 0));
#endif
    if (!any) return;
    GN_COUNT(lights_punctual, 1);
    const int32_t e_q24 = gn_punctual_irradiance_q24(&point, gn_punctual_cosine_q30(&point, facing_q16));
    at->irradiance_q24 = p->of_pixel ? e_q24 : gn_min32(e_q24, 1 << 27);
    (void)s;
}
#endif

GN_HOT static void light_at(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                            const corner_point *p, gn_corner *c)
{
    const gn_surface_light *light = &s->light[slot];
    gn_corner_light *at = &c->light[slot];
    (void)l;
#if GN_SPECULAR
    if (s->specular) at->highlight_q24 = at->lobe_q12[0] = at->lobe_q12[1] = at->lobe_q12[2] = 0;
#endif
    if (light->state->kind == GN_LIGHT_DIRECTIONAL) {
        GN_COUNT(corner_lights, 1);
        int32_t cosine = light->cosine_q24[0];
#if GN_VERTEX_COSINES == 3
        if (GN_SMOOTH(s) && GN_K(frame, vertex_light))
            cosine = at_point(p, cosine, light->cosine_q24[1], light->cosine_q24[2]);
#endif
        if (GN_SMOOTH(s) && !GN_K(frame, vertex_light))
            cosine = (int32_t)(gn_dot64(p->unit_q30, light->state->to_light_q30) >> 36);
        at->irradiance_q24 = gn_max32(cosine, 0);
        at->arrives = (int8_t)(cosine > 0 ? GN_CORNER_FULLY : -gn_min32(-(cosine >> 17), 126));
#if GN_SPECULAR
        if (s->specular && (cosine > 0 || !p->of_pixel))
            at->highlight_q24 = highlight_q30(s, p, light->state->to_light_q30, at->lobe_q12) >> 6;
#endif
    }
#if GN_PUNCTUAL_LIGHTS
    else
        lamp_at(frame, s, light->state, p, c, at);
#endif
    if (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32) at->irradiance_q24 = at->arrives > 0 ? 1 << 24 : 0;
#if GN_MASKS
    at->mask_q16 = 65536;
#if GN_INTERPOLATES
    if (l->light[slot].masked || c->g_uq16 != 65536)
#endif
        at->mask_q16 = mask_at(s, p, c, light->state->mask_channel);
#endif
#if GN_SHADOWS
    at->placed = GN_VIEW_NONE;
    at->view = own_view(frame, s, light->state, c);
#endif
}

/* Strength of shadows, cascade, and its share in a blend. */
GN_HOT static void find_cascade(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, gn_corner *c)
{
    (void)l;
    c->cascade = GN_CASCADE_NONE;
    c->g_uq16 = c->fade_uq16 = 65536;
    if (!s->shadowed) return;
#if GN_INTERPOLATES
    c->cascade = (uint8_t)l->cascade;
    if (l->cascade >= 0) return;
#endif
#if GN_SHADOWS
    gn_cascade_point at;
    gn_cascade_at(frame, c->x, c->y, c->z_q16, &at);
    c->cascade = (uint8_t)at.cascade;
    c->fade_uq16 = at.fade_uq16;
    c->g_uq16 = at.g_uq16;
#endif
    (void)frame;
}

GN_HOT void gn_corner_find(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y,
                           int of_pixel, gn_corner *c)
{
    corner_point p;
    int known = 1;
    p.of_pixel = of_pixel;
    p.is_lone = 0;
    GN_COUNT(corners, 1);
    c->x = (int16_t)x;
    c->y = (int16_t)y;
    c->state = GN_CORNER_UNSEEN;
#if GN_INTERPOLATES
    if (!find_point(&l->plane, frame, s, c, &p)) {
        if (!of_pixel) return;
        find_lone_point(frame, s, c, &p);
    }
#else
    find_lone_point(frame, s, c, &p);
#endif
#if GN_PUNCTUAL_LIGHTS
    if (s->n_punctual && !gn_corner_find_ray(frame, s->light[s->n_lights - 1].state, x, y, c->z_q16, c->ray_q16)) {
        const int32_t most = (1 << 30) - 1;
        known = 0;
        for (int i = 0; i < 3; i++) c->ray_q16[i] = gn_max32(-most, gn_min32(c->ray_q16[i], most));
    }
#endif
    attributes_at(s, &p, c);
    if (s->n_lights || (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32)) known &= find_normal(s, c, &p);
    if (!(known | of_pixel)) return;
    c->state = GN_CORNER_KNOWN;
    if (!s->n_lights) return;
    find_cascade(l, frame, s, c);
    find_unit(frame, s, &p);
#if GN_SPECULAR
    if (s->specular) find_eye(frame, x, y, p.to_eye_q30);
#endif
    for (uint32_t i = 0; i < s->n_lights; i++) light_at(l, frame, s, i, &p, c);
}

#if GN_TEXTURES
GN_HOT void gn_corner_find_texture(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y, gn_corner *c)
{
    corner_point p;
    c->x = (int16_t)x;
    c->y = (int16_t)y;
    find_lone_point(frame, s, c, &p);
    texture_at(s, &p, c->uv_q20);
}
#endif

#if GN_SHADOWS && GN_INTERPOLATES
GN_HOT int gn_corner_locate(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot, int32_t x,
                            int32_t y, gn_corner *c)
{
    corner_point p;
    c->x = (int16_t)x;
    c->y = (int16_t)y;
    if (!find_point(&l->plane, frame, s, c, &p) || !find_normal(s, c, &p)) return 0;
    c->light[slot].placed = GN_VIEW_NONE;
    c->light[slot].arrives = GN_CORNER_FULLY; /* for all that is known */
#if GN_PUNCTUAL_LIGHTS
    const gn_light_state *light = s->light[slot].state;
    if (light->kind != GN_LIGHT_DIRECTIONAL) return gn_corner_find_ray(frame, light, x, y, c->z_q16, c->ray_q16);
#endif
    return 1;
}
#endif
