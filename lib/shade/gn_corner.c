/* Corners of cells. */
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

#if GN_INTERPOLATES

/* ---- Once per surface -------------------------------------------------------------------------------------------- */

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

/* Whether the light lies within 2^30 of the eye. */
GN_HOT static int in_reach(const gn_light_state *light)
{
#if GN_PUNCTUAL_LIGHTS
    for (int i = 0; light->kind != GN_LIGHT_DIRECTIONAL && i < 3; i++)
        if (gn_abs64(light->from_light[i].d_q16) >> 30) return 0;
#endif
    (void)light;
    return 1;
}

GN_HOT int gn_corner_begin_lights(gn_lattice *l, const gn_frame *frame, const gn_surface *s)
{
    l->offset_view = NULL;
    for (uint32_t i = 0; i < s->n_lights; i++) {
        begin_light(l, frame, s, i);
        if (!in_reach(s->light[i].state)) return 0;
    }
    return 1;
}

GN_HOT int gn_corner_begin(gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_rect *rect)
{
    gn_corner_forget_forms(l);
    l->anchor.known = 0;
    l->cascade = -1;
#if GN_PLANES && GN_SHADOWS
    l->slope_view = NULL;
#endif
    return gn_screen_plane_find(&l->plane, frame, s, rect, 1);
}

/* ---- The point --------------------------------------------------------------------------------------------------- */

/* A point of the plane. */
typedef struct {
    int32_t b_q28[2]; /* barycentrics */
    int32_t n_q30[3], unit_q30[3];
} corner_point;

GN_HOT static int find_point(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, gn_corner *c,
                             corner_point *p)
{
    const gn_screen_plane *plane = &l->plane;
#if GN_ORTHOGRAPHIC
    if (GN_FLAT_Q16(frame)) {
        c->z_q16 = gn_corner_flat_depth(plane, s, c->x, c->y, p->b_q28);
        return c->z_q16 != 0;
    }
#endif
    int32_t dx = c->x - plane->x, dy = c->y - plane->y, w = gn_slope_at(&plane->w, dx, dy);
    if (w < plane->w_least || w >= 1 << 30) return 0;
    int32_t clz = gn_clz32((uint32_t)w), shift = plane->z_shift - clz;
    uint32_t recip = gn_recip_norm((uint32_t)w << clz, GN_RECIP_STEPS(frame));
    if (shift < 1 || shift > 31) return 0;
    uint32_t z = gn_umul_high(s->depth_scale.mant, recip);
    z = ((z >> (shift - 1)) + 1) >> 1;
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

/* a0 + b1 * a1 + b2 * a2 */
GN_HOT static inline int64_t at_point_64(const corner_point *p, int32_t a0, int32_t a1, int32_t a2)
{
    return a0 + (((int64_t)p->b_q28[0] * a1 + (int64_t)p->b_q28[1] * a2) >> 28);
}

GN_HOT static inline int32_t at_point(const corner_point *p, int32_t a0, int32_t a1, int32_t a2)
{
    return (int32_t)at_point_64(p, a0, a1, a2);
}

/* Returns 0 if a component is 17/16 or more: outside of a triangle that bends much, where it could be up to 9. */
GN_HOT static int find_normal(const gn_surface *s, gn_corner *c, corner_point *p)
{
    const int32_t(*n)[3] = s->normal_q30;
    const int64_t most = (1 << 30) + (1 << 26);
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        p->n_q30[i] = n[0][i];
        if (GN_SMOOTH(s)) {
            int64_t at = at_point_64(p, n[0][i], n[1][i], n[2][i]);
            if (at >= most || at <= -most) return 0;
            p->n_q30[i] = (int32_t)gn_clamp64(at, -(1 << 30), 1 << 30);
        }
#if GN_VERTEX_NORMALS
        c->normal_q30[i] = p->n_q30[i];
#endif
    }
    (void)c;
    return 1;
}

/* Of length 1. Light of the sun that is interpolated has no use for it. */
GN_HOT static void find_unit(const gn_frame *frame, const gn_surface *s, corner_point *p)
{
    GN_UNROLL
    for (int i = 0; i < 3; i++) p->unit_q30[i] = p->n_q30[i];
    if (GN_SMOOTH(s) && (s->n_punctual || GN_VERTEX_COSINES != 3 || !GN_K(frame, vertex_light)))
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
    GN_UNROLL
    for (int i = 0; i < 2; i++) {
        int32_t e1 = (int32_t)uv[1][i], e2 = (int32_t)uv[2][i];
        if (e1 != uv[1][i] || e2 != uv[2][i]) {
            const int32_t b_q30[2] = {p->b_q28[0] * 4, p->b_q28[1] * 4};
            uv_q20[i] = gn_texture_coord(&s->uv, texture, b_q30, i);
            continue;
        }
        /* 2^29 * 2^31, twice */
        int64_t c_q20 = uv[0][i] * 16 + (((int64_t)p->b_q28[0] * e1 + (int64_t)p->b_q28[1] * e2) >> 24);
        uv_q20[i] = gn_texture_clamps(texture, i) ? gn_sat32(c_q20) : (int32_t)(uint32_t)c_q20;
    }
}
#endif

/* Baked light goes on outside of the triangle and may be negative there: limited to 0 it would bend what is between. */
GN_HOT static void attributes_at(const gn_surface *s, const corner_point *p, gn_corner *c)
{
    for (int i = 0; i < 3; i++) {
        int32_t q20 = (int32_t)s->base_q20[i]; /* < 2^29 */
        if (GN_BAKED_LIGHT && s->baked) {
            const int64_t baked = (int64_t)s->albedo_uq16[i] * attribute(s, p, GN_ATTRIBUTE_BAKED + i) >> 12;
            q20 += (int32_t)gn_clamp64(baked, -(1 << 23), 1 << 23);
        }
        c->base_q24[i] = gn_min32(q20, 1 << 23) * 16;
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

#if GN_PUNCTUAL_LIGHTS
/* A length along a ray, saturated: times 2^shift / 2^32. */
GN_HOT static int32_t ray_length(int32_t length, int32_t a, int32_t shift)
{
    int32_t v = gn_mul_high(length, a);
    if (shift <= 0) return v >> gn_min32(-shift, 31);
    return (int32_t)gn_clamp64(v * ((int64_t)1 << gn_min32(shift, 31)), -INT32_MAX, INT32_MAX);
}

/* From the eye to the point, along the world's axes: the same for all lights. Returns 0 if it is 2^30 away. */
GN_HOT static int find_ray(const gn_frame *frame, const gn_light_state *any, int32_t x, int32_t y, int32_t z_q16,
                           int32_t ray_q16[3])
{
    uint32_t beyond = 0;
    gn_corner_ray ray;
    gn_corner_ray_begin(&ray, frame, any->ray_shift, x, y, z_q16);
    int32_t z_shift = 33 - any->ray_shift - gn_clz32((uint32_t)z_q16);
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        const gn_ray_plane *r = &any->from_light[i];
        uint32_t across = (uint32_t)r->ax * (uint32_t)ray.px + (uint32_t)r->ay * (uint32_t)ray.py;
        int32_t more = 0;
#if GN_ORTHOGRAPHIC
        if (ray.flat) {
            more = ray_length(ray.flat, (int32_t)across, 33 - any->ray_shift - gn_clz32((uint32_t)GN_FLAT_Q16(frame)));
            beyond |= (uint32_t)more + (1U << 30);
            across = 0;
        }
#endif
        int32_t at = ray_length(ray.z, (int32_t)((uint32_t)r->a0 + across), z_shift);
        beyond |= (uint32_t)at + (1U << 30);
        ray_q16[i] = (int32_t)((uint32_t)at + (uint32_t)more);
        beyond |= (uint32_t)ray_q16[i] + (1U << 30);
    }
    return !(beyond >> 31);
}

#endif

#if GN_SHADOWS
/* Whether the surface's plane is seen at a pixel: then it is the anchor. */
GN_HOT static int anchor_at(gn_lattice *l, const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y)
{
    const int32_t z = gn_corner_seen_depth(l, frame, s, x, y);
    if (z <= 0) return 0;
    l->anchor.x = (int16_t)x;
    l->anchor.y = (int16_t)y;
    l->anchor.z_q16 = z;
#if GN_PUNCTUAL_LIGHTS
    if (s->n_punctual) return find_ray(frame, s->light[s->n_lights - 1].state, x, y, z, l->anchor.ray_q16);
#endif
    return 1;
}

/* Its middle, or else one of its corners. */
GN_HOT GN_NOINLINE int gn_corner_find_anchor(gn_lattice *l, const gn_frame *frame, const gn_surface *s)
{
    const gn_rect *r = &l->block;
    if (l->anchor.known) return l->anchor.found;
    l->anchor.known = 1;
    l->anchor.found = (uint8_t)anchor_at(l, frame, s, (r->x0 + r->x1) >> 1, (r->y0 + r->y1) >> 1);
    for (int i = 0; i < 4 && !l->anchor.found; i++)
        l->anchor.found = (uint8_t)anchor_at(l, frame, s, i & 1 ? r->x1 : r->x0, i & 2 ? r->y1 : r->y0);
    return l->anchor.found;
}

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

GN_HOT static void light_at(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                            const corner_point *p, gn_corner *c)
{
    const gn_surface_light *light = &s->light[slot];
    gn_corner_light *at = &c->light[slot];
    if (light->state->kind == GN_LIGHT_DIRECTIONAL) {
        int32_t cosine = light->cosine_q24[0];
#if GN_VERTEX_COSINES == 3
        if (GN_SMOOTH(s) && GN_K(frame, vertex_light))
            cosine = at_point(p, cosine, light->cosine_q24[1], light->cosine_q24[2]);
#endif
        if (GN_SMOOTH(s) && !GN_K(frame, vertex_light))
            cosine = (int32_t)(gn_dot64(p->unit_q30, light->state->to_light_q30) >> 36);
        at->irradiance_q24 = gn_max32(cosine, 0);
        at->arrives = (int8_t)(cosine > 0 ? GN_CORNER_FULLY : -gn_min32(-(cosine >> 17), 126));
    }
#if GN_PUNCTUAL_LIGHTS
    else {
        int32_t from[3];
        gn_corner_from(c, light->state, from);
        at->irradiance_q24 = gn_corner_irradiance(frame, light->state, from, gn_corner_distance2_q32(from),
                                                  gn_sat32(-gn_dot_q30(p->unit_q30, from)), at, NULL);
    }
#endif
    (void)l;
    if (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32) at->irradiance_q24 = at->arrives > 0 ? 1 << 24 : 0;
#if GN_MASKS
    at->mask_q16 = l->light[slot].masked || c->g_uq16 != 65536 ? mask_at(s, p, c, light->state->mask_channel) : 65536;
#endif
#if GN_SHADOWS
    at->placed = GN_VIEW_NONE;
    at->view = own_view(frame, s, light->state, c);
#endif
}

/* Strength of shadows, cascade, and its share in a blend. */
GN_HOT static void find_cascade(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, gn_sample *sample,
                                gn_corner *c)
{
    c->cascade = (uint8_t)l->cascade;
    c->g_uq16 = c->fade_uq16 = 65536;
    if (l->cascade >= 0 || !s->shadowed) return;
    gn_sample_find_cascade(frame, 2 * c->x + 1 - frame->picture.width, frame->picture.height - 1 - 2 * c->y, c->z_q16,
                           sample);
    c->cascade = (uint8_t)sample->cascade;
    c->fade_uq16 = (uint32_t)sample->value[GN_VALUE_FADE];
    c->g_uq16 = gn_shadow_distance(frame, s, sample);
}

GN_HOT void gn_corner_find(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y,
                           gn_sample *sample, gn_corner *c)
{
    corner_point p;
    GN_COUNT(corners, 1);
    c->state = GN_CORNER_UNSEEN;
    c->x = (int16_t)x;
    c->y = (int16_t)y;
    if (!find_point(l, frame, s, c, &p)) return;
#if GN_PUNCTUAL_LIGHTS
    if (s->n_punctual && !find_ray(frame, s->light[s->n_lights - 1].state, x, y, c->z_q16, c->ray_q16)) return;
#endif
    c->state = GN_CORNER_KNOWN;
    attributes_at(s, &p, c);
    if (!s->n_lights) return;
    find_cascade(l, frame, s, sample, c);
    if (!find_normal(s, c, &p)) {
        c->state = GN_CORNER_UNSEEN;
        return;
    }
    find_unit(frame, s, &p);
    for (uint32_t i = 0; i < s->n_lights; i++) light_at(l, frame, s, i, &p, c);
#if GN_SPECULAR
    if (!s->specular) return;
    if (!gn_sample_on_plane(frame, s, x, y, sample)) {
        c->state = GN_CORNER_UNSEEN; /* else its highlights would be those of a corner before */
        return;
    }
    for (uint32_t i = 0; i < s->n_lights; i++) {
        int32_t lobe_q30[3];
        c->light[i].highlight_q24 = (int32_t)gn_light_highlight(frame, s, sample, i, lobe_q30);
        for (int k = 0; k < 3; k++) c->light[i].lobe_q12[k] = (int16_t)(lobe_q30[k] >> 18);
    }
#endif
}

#if GN_SHADOWS
GN_HOT int gn_corner_locate(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot, int32_t x,
                            int32_t y, gn_corner *c)
{
    corner_point p;
    c->x = (int16_t)x;
    c->y = (int16_t)y;
    if (!find_point(l, frame, s, c, &p) || !find_normal(s, c, &p)) return 0;
    c->light[slot].placed = GN_VIEW_NONE;
    c->light[slot].arrives = GN_CORNER_FULLY; /* for all that is known */
#if GN_PUNCTUAL_LIGHTS
    const gn_light_state *light = s->light[slot].state;
    if (light->kind != GN_LIGHT_DIRECTIONAL) return find_ray(frame, light, x, y, c->z_q16, c->ray_q16);
#endif
    return 1;
}
#endif

#endif
