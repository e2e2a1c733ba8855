/* A surface at a pixel's centre. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "light/gn_lights.h"
#include "shade/gn_surface.h"

#define GN_ONE_Q30 (1 << 30)

typedef struct {
    int32_t z_q16;
    int32_t b_q30[2];
} hit;

/* Z = depth_scale.mant * recip * 2^-s, the product in [2^62, 2^64) */
GN_HOT static uint64_t depth_at(const gn_surface *s, const gn_ray_recip *r)
{
    uint64_t p = (uint64_t)s->depth_scale.mant * r->recip;
    int32_t shift = 63 + 32 - r->clz - s->depth_scale.exp;
    return shift > 63 ? 0 : shift < 33 ? (uint64_t)INT32_MAX : ((p >> (shift - 1)) + 1) >> 1;
}

#if GN_ORTHOGRAPHIC
/* The same for parallel rays: the divisor is constant, and depth is interpolated like any attribute. Two Newton steps:
 * its error would tilt the whole triangle. [R10] */
GN_HOT static GN_NOINLINE void intersect_flat(const gn_frame *frame, const gn_surface *s, int32_t px, int32_t py,
                                              hit *h)
{
    gn_ray_recip r;
    int32_t b_q30[2];
    uint32_t focal2 = frame->cam.focal2_px_q16;
    h->b_q30[0] = h->b_q30[1] = b_q30[0] = b_q30[1] = GN_ONE_Q30 / 3;
    if (gn_plane_recip(&r, &s->screen, px, py, focal2, 2)) {
        gn_bary_at(h->b_q30, &s->bary, &r, px, py, focal2);
        /* depth is that of the plane beyond the edges, too: else the point would lie off it */
        if (!gn_bary_beyond(b_q30, &s->bary, &r, px, py, focal2)) b_q30[0] = h->b_q30[0], b_q30[1] = h->b_q30[1];
        else if (GN_JOINED(s)) h->b_q30[0] = b_q30[0], h->b_q30[1] = b_q30[1];
    }
    int64_t z = s->depth_q16[0]; /* |b| < 2^31, |depth| < 2^31 */
    for (int i = 0; i < 2; i++) z += gn_shr64((int64_t)b_q30[i] * s->depth_q16[i + 1], 30);
    h->z_q16 = (int32_t)gn_clamp64(z, s->z_min_q16, s->z_max_q16);
}
#endif

/* The intersection of the ray through a pixel centre with the plane. Values are clamped to the triangle: a snapped edge
 * may cover a centre just outside the unsnapped triangle. */
GN_HOT static void intersect(const gn_frame *frame, const gn_surface *s, int32_t px, int32_t py, hit *h)
{
    gn_ray_recip r;
#if GN_ORTHOGRAPHIC
    if (frame->cam.flat_q16) {
        intersect_flat(frame, s, px, py, h);
        return;
    }
#endif
    if (!gn_plane_recip(&r, &s->plane, px, py, frame->cam.focal2_px_q16, GN_RECIP_STEPS(frame))) {
        h->z_q16 = s->z_min_q16; /* edge on: any point of the triangle will do */
        h->b_q30[0] = h->b_q30[1] = GN_ONE_Q30 / 3;
        return;
    }
    h->z_q16 = (int32_t)gn_clamp64((int64_t)depth_at(s, &r), s->z_min_q16, s->z_max_q16);
    if (!GN_HAS_BARY(s)) return;
#if GN_INTERPOLATES
    if (s->joined && gn_bary_beyond(h->b_q30, &s->bary, &r, px, py, frame->cam.focal2_px_q16)) return;
#endif
    gn_bary_at(h->b_q30, &s->bary, &r, px, py, frame->cam.focal2_px_q16);
}

/* a0 + b1 * a1 + b2 * a2 */
GN_HOT static int32_t at_hit(const hit *h, int32_t a0, int32_t a1, int32_t a2)
{
    return gn_sat32(a0 + gn_shr64((int64_t)h->b_q30[0] * a1 + (int64_t)h->b_q30[1] * a2, 30));
}

GN_HOT static void normal_at(const gn_surface *s, const hit *h, int32_t n_q30[3])
{
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        int32_t n = s->normal_q30[0][i];
        if (GN_SMOOTH(s)) n = at_hit(h, n, s->normal_q30[1][i], s->normal_q30[2][i]);
        n_q30[i] = gn_max32(-GN_ONE_Q30, gn_min32(n, GN_ONE_Q30)); /* outside of the triangle it may be longer */
    }
}

#if GN_SHADOWS || GN_PUNCTUAL_LIGHTS
/* A point at depth z on a pixel's ray, along three axes. |z| * |a| < 2^31 * 2^31 by the choice of the shift */
GN_HOT static void point_on_ray(const gn_frame *frame, const gn_ray_plane ray[3], int32_t ray_shift, int32_t px,
                                int32_t py, int32_t z_q16, int64_t out_q16[3])
{
    for (int i = 0; GN_FLAT_Q16(frame) && i < 3; i++) { /* 2^61 and 2^60 */
        int64_t across = ((int64_t)ray[i].ax * px + (int64_t)ray[i].ay * py) * GN_FLAT_Q16(frame);
        out_q16[i] = gn_shr64((int64_t)z_q16 * ray[i].a0 + across, ray_shift) + ray[i].d_q16;
    }
    if (GN_FLAT_Q16(frame)) return;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        const gn_ray_plane *r = &ray[i]; /* the sum is below 2^31 */
        const int32_t a = (int32_t)((uint32_t)r->a0 + (uint32_t)r->ax * (uint32_t)px + (uint32_t)r->ay * (uint32_t)py);
        out_q16[i] = gn_shr64((int64_t)z_q16 * a, ray_shift) + ray[i].d_q16;
    }
}
#endif

#if GN_SHADOWS
/* Tile coordinates of the point at depth z on a pixel's ray. */
GN_HOT static void light_coords(const gn_frame *frame, const gn_light_view *view, int32_t px, int32_t py, int32_t z_q16,
                                const int32_t offset_q16[3], int32_t *out)
{
    int64_t at[3];
    point_on_ray(frame, view->fit.ortho.ray, view->fit.ortho.ray_shift, px, py, z_q16, at);
    GN_UNROLL
    for (int i = 0; i < 3; i++) out[i] = gn_sat32(at[i] + offset_q16[i]);
}

/* Whether a light has cascades, or shadows end at a distance from the camera. */
GN_HOT static int asks_for_cascades(const gn_frame *frame)
{
    return frame->has_cascades || frame->scene->shadow.distance_mode == GN_DISTANCE_RADIUS;
}

/* Square of the distance from the view axis of the point at depth z on a pixel's ray. */
GN_HOT static uint64_t across2_q32(const gn_frame *frame, int32_t px, int32_t py, int64_t z)
{
    gn_bfloat per_px = frame->cam.inv_focal2;
    const int64_t most = 1 << 30; /* of a point of the triangle: pixels of a plane seen edge on may lie outside it */
    int64_t at = GN_FLAT_Q16(frame) ? GN_FLAT_Q16(frame) : z,
            x = gn_clamp64(gn_bf_apply(at * px, per_px, 16), -most, most),
            y = gn_clamp64(gn_bf_apply(at * py, per_px, 16), -most, most);
    return (uint64_t)(x * x) + (uint64_t)(y * y);
}

/* The cascade of a point so far from the view axis, and its fade factor; the caller begins with none and 0. [D4] [D6]
 * [D11] */
GN_HOT static void cascade_within(const gn_frame *frame, uint64_t across, gn_sample *sample)
{
    int64_t z = sample->value[GN_VALUE_Z];
    int64_t m = frame->scene->shadow.max_distance_q16;
    sample->in_reach =
        frame->scene->shadow.distance_mode != GN_DISTANCE_RADIUS || across + (uint64_t)(z * z) <= (uint64_t)(m * m);
    if (!sample->in_reach) return;
    for (int32_t i = 0; i < GN_N_CASCADES(frame); i++) {
        const gn_cascade_state *cascade = &frame->cascade[i];
        int64_t dz = z - cascade->centre_q16;
        uint64_t dist2 = across + (uint64_t)(dz * dz);
        if (dist2 >= cascade->radius2_q32) continue;
        sample->cascade = i;
        sample->value[GN_VALUE_FADE] = 65536;
        if (dist2 > cascade->inner2_q32) {
            int64_t factor = gn_bf_apply((int64_t)(cascade->radius2_q32 - dist2), cascade->fade_scale, 48);
            sample->value[GN_VALUE_FADE] = (int32_t)gn_clamp64(factor, 0, 65536);
        }
        return;
    }
}

GN_HOT static void select_cascade(const gn_frame *frame, int32_t px, int32_t py, gn_sample *sample)
{
    cascade_within(frame, across2_q32(frame, px, py, sample->value[GN_VALUE_Z]), sample);
}

/* The surface's offset in a view, if it differs between the views of a light: for smooth surfaces; for the disk, whose
 * index and radius depend on the cascade; and for automatic bias, whose depth steps do. */
GN_HOT static const int32_t *own_offset(const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                        const gn_light_view *view, const int32_t n_q30[3], int32_t moved_q16[3])
{
    const int32_t *flat = s->light[slot].flat_offset_q16;
    gn_auto_bias form = (gn_auto_bias)s->light[slot].state->auto_bias;
    if (GN_AUTO_BIAS && form) {
        gn_bias_auto_ortho(view, form, flat, moved_q16);
        return moved_q16;
    }
    if (!GN_SMOOTH(s) && !(GN_DISK_FILTER && view->filter == GN_FILTER_DISK)) return flat;
    gn_bias_directional(frame, view, n_q30, moved_q16);
    return moved_q16;
}

GN_HOT void gn_sample_offset(const gn_frame *frame, const gn_surface *s, uint32_t slot, const gn_light_view *view,
                             const int32_t n_q30[3], int32_t offset_q16[3])
{
    int32_t moved[3];
    const int32_t *offset = own_offset(frame, s, slot, view, n_q30, moved);
    for (int i = 0; i < 3; i++) offset_q16[i] = offset[i];
}

GN_HOT void gn_sample_in_view(const gn_frame *frame, const gn_surface *s, uint32_t slot, const gn_light_view *view,
                              int32_t x, int32_t y, int32_t z_q16, const int32_t n_q30[3], int32_t coord_q16[3])
{
    int32_t moved[3], px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    light_coords(frame, view, px, py, z_q16, own_offset(frame, s, slot, view, n_q30, moved), coord_q16);
}

/* Light-space coordinates of the point in a directional light's view; with cascades also in the next one. */
GN_HOT static void directional_coords(const gn_frame *frame, const gn_surface *s, uint32_t slot, int32_t px, int32_t py,
                                      const int32_t n_q30[3], const gn_sample *sample, int32_t *out)
{
    const gn_light_state *light = s->light[slot].state;
    if (light->view_idx < 0) return;
    const gn_light_view *view = &frame->view[light->view_idx];
    int cascaded = !view->border_lit;
    if (cascaded && sample->cascade == GN_CASCADE_NONE) return;
    if (cascaded) view += sample->cascade;
    int32_t moved[3];
    const int32_t *offset = own_offset(frame, s, slot, view, n_q30, moved);
    light_coords(frame, view, px, py, sample->value[GN_VALUE_Z], offset, out);
    if (!GN_BLENDED_CASCADES || !cascaded || frame->scene->shadow.blend == GN_BLEND_HARD ||
        sample->cascade == GN_LAST_CASCADE(frame))
        return;
    view += frame->cascade[sample->cascade].next - sample->cascade;
    int same = view->filter != GN_FILTER_DISK && !(GN_AUTO_BIAS && light->auto_bias);
    if (!same) offset = own_offset(frame, s, slot, view, n_q30, moved);
    light_coords(frame, view, px, py, sample->value[GN_VALUE_Z], offset, out + 3);
}

GN_HOT int64_t gn_sample_inside_q32(const gn_frame *frame, int32_t x, int32_t y, int32_t z_q16, int32_t cascade_idx)
{
    const gn_cascade_state *cascade = &frame->cascade[cascade_idx];
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    int64_t dz = (int64_t)z_q16 - cascade->centre_q16;
    return (int64_t)(cascade->radius2_q32 - across2_q32(frame, px, py, z_q16) - (uint64_t)(dz * dz));
}
#else
GN_HOT static int asks_for_cascades(const gn_frame *frame)
{
    (void)frame;
    return 0;
}

GN_HOT static void select_cascade(const gn_frame *frame, int32_t px, int32_t py, gn_sample *sample)
{
    (void)frame, (void)px, (void)py, (void)sample;
}

GN_HOT static void directional_coords(const gn_frame *frame, const gn_surface *s, uint32_t slot, int32_t px, int32_t py,
                                      const int32_t n_q30[3], const gn_sample *sample, int32_t *out)
{
    (void)frame, (void)s, (void)slot, (void)px, (void)py, (void)n_q30, (void)sample, (void)out;
}
#endif

#if GN_PUNCTUAL_LIGHTS
GN_HOT static void punctual_values(const gn_frame *frame, const gn_surface *s, uint32_t slot, int32_t px, int32_t py,
                                   const int32_t n_q30[3], const int32_t unit_q30[3], const gn_sample *sample,
                                   int32_t *out)
{
    const gn_light_state *light = s->light[slot].state;
    int64_t at[3];
    point_on_ray(frame, light->from_light, light->ray_shift, px, py, sample->value[GN_VALUE_Z], at);
    GN_UNROLL
    for (int i = 0; i < 3; i++) out[GN_LIGHT_POINT_AT + i] = (int32_t)gn_clamp64(at[i], -INT32_MAX, INT32_MAX);
    out[GN_LIGHT_FACING] = gn_sat32(-gn_dot_q30(unit_q30, out + GN_LIGHT_POINT_AT));
    int own = GN_AUTO_BIAS && light->auto_bias; /* of the face, later */
    if (GN_SHADOWS && light->view_idx >= 0 && s->shadowed && !own)
        gn_bias_punctual(frame, light, n_q30, out + GN_LIGHT_POINT_AT, out + GN_LIGHT_OFFSET);
    else out[GN_LIGHT_OFFSET] = out[GN_LIGHT_OFFSET + 1] = out[GN_LIGHT_OFFSET + 2] = 0;
}
#else
GN_HOT static void punctual_values(const gn_frame *frame, const gn_surface *s, uint32_t slot, int32_t px, int32_t py,
                                   const int32_t n_q30[3], const int32_t unit_q30[3], const gn_sample *sample,
                                   int32_t *out)
{
    (void)frame, (void)s, (void)slot, (void)px, (void)py, (void)n_q30, (void)unit_q30, (void)sample, (void)out;
}
#endif

#if GN_SPECULAR
/* The normal, and the direction to the viewer, in the world. */
GN_HOT static void specular_values(const gn_frame *frame, int32_t px, int32_t py, const int32_t unit_q30[3],
                                   gn_sample *sample)
{
    const gn_cam *cam = &frame->cam;
    int64_t towards[3];
    if (GN_FLAT_Q16(frame)) px = py = 0; /* rays are parallel */
    for (int i = 0; i < 3; i++) {        /* 2^12 * 2^16 * 2^30, 2^32 * 2^30: halved */
        towards[i] = -((int64_t)cam->axis_q30[0][i] * px + (int64_t)cam->axis_q30[1][i] * py) * 32768 -
                     (int64_t)cam->axis_q30[2][i] * (int64_t)(cam->focal2_px_q16 >> 1);
        sample->normal_q30[i] = unit_q30[i];
    }
    gn_normalise_q30(sample->to_eye_q30, towards);
}
#else
GN_HOT static void specular_values(const gn_frame *frame, int32_t px, int32_t py, const int32_t unit_q30[3],
                                   gn_sample *sample)
{
    (void)frame, (void)px, (void)py, (void)unit_q30, (void)sample;
}
#endif

/* n . L of a directional light: of the interpolated normal, or interpolated. */
GN_HOT static int32_t directional_cosine_q24(const gn_frame *frame, const gn_surface *s, const gn_surface_light *light,
                                             const hit *h, gn_length length, const int32_t n_q30[3])
{
    const int32_t *at = light->cosine_q24;
    if (!GN_SMOOTH(s)) return at[0];
    if (GN_K(frame, vertex_light)) return at_hit(h, at[0], at[1], at[2]);
    return gn_length_cosine_q24(length, n_q30, light->state->to_light_q30);
}

GN_HOT static void light_values(const gn_frame *frame, const gn_surface *s, const hit *h, int32_t px, int32_t py,
                                const int32_t n_q30[3], int with_places, gn_sample *sample)
{
    gn_length length = {0, 0};
    int needs_length = !GN_K(frame, vertex_light) || s->n_punctual || s->specular;
    int32_t unit_q30[3] = {n_q30[0], n_q30[1], n_q30[2]};
    if (GN_SMOOTH(s) && needs_length) {
        length = gn_length_of(GN_RECIP_STEPS(frame), n_q30);
        if (GN_PUNCTUAL_LIGHTS || GN_SPECULAR) gn_length_unit(length, n_q30, unit_q30);
    }
    for (uint32_t i = 0; i < s->n_lights; i++) {
        int32_t *out = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i];
        if (GN_PUNCTUAL_LIGHTS && s->light[i].state->kind != GN_LIGHT_DIRECTIONAL) {
            GN_COUNT(sample_lights_punctual, 1);
            punctual_values(frame, s, i, px, py, n_q30, unit_q30, sample, out);
            continue;
        }
        GN_COUNT(sample_lights, 1);
        out[0] = directional_cosine_q24(frame, s, &s->light[i], h, length, n_q30);
        if (GN_VALUES_PER_LIGHT > 1) out[1] = out[2] = out[3] = 0; /* places are not always set */
        if (GN_VALUES_PER_LIGHT > 4) out[4] = out[5] = out[6] = 0;
        if (s->shadowed && with_places) directional_coords(frame, s, i, px, py, n_q30, sample, out + 1);
    }
    if (s->specular) specular_values(frame, px, py, unit_q30, sample);
}

GN_HOT static int32_t attribute_at(const gn_surface *s, const hit *h, int i)
{
    return at_hit(h, s->attribute_q16[0][i], s->attribute_q16[1][i], s->attribute_q16[2][i]);
}

GN_HOT static void extra_values(const gn_surface *s, const hit *h, int32_t *value)
{
#if GN_TEXTURES
    for (int i = 0; s->textured && i < 2; i++)
        value[GN_VALUE_UV + i] = gn_texture_coord(&s->uv, GN_SURFACE_TEXTURE(s), h->b_q30, i);
    for (int i = 0; !s->textured && i < 2; i++) value[GN_VALUE_UV + i] = 0;
#endif
    for (int i = 0; GN_MASKS && i < 4; i++)
        value[GN_VALUE_MASK + i] = s->masked ? attribute_at(s, h, GN_ATTRIBUTE_MASK + i) : 0;
    for (int i = 0; GN_BAKED_LIGHT && i < 3; i++)
        value[GN_VALUE_BAKED + i] = s->baked ? attribute_at(s, h, GN_ATTRIBUTE_BAKED + i) : 0;
}

/* Everything that shading interpolates, at an intersection. */
GN_HOT static void sample_values(const gn_frame *frame, const gn_surface *s, const hit *h, int32_t px, int32_t py,
                                 int with_places, gn_sample *sample)
{
    GN_COUNT(samples, 1);
    if (GN_HAS_BARY(s)) GN_COUNT(samples_smooth, 1);
    sample->value[GN_VALUE_Z] = h->z_q16;
    sample->value[GN_VALUE_FADE] = 0;
    sample->cascade = GN_CASCADE_NONE;
    sample->in_reach = 1;
    GN_UNROLL
    for (int i = 0; i < 3; i++)
        sample->value[GN_VALUE_RGB + i] = GN_COLOURED(s) ? attribute_at(s, h, GN_ATTRIBUTE_RGB + i) : 0;
    if (s->first_value < GN_VALUE_Z) extra_values(s, h, sample->value);
    if (!s->n_lights) return;
    int32_t n[3];
    normal_at(s, h, n);
    if (s->shadowed && asks_for_cascades(frame)) select_cascade(frame, px, py, sample);
    light_values(frame, s, h, px, py, n, with_places, sample);
}

/* At a pixel's centre. [R4] */
GN_HOT void gn_sample_at(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y, gn_sample *sample)
{
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    hit h;
    intersect(frame, s, px, py, &h);
    sample_values(frame, s, &h, px, py, 1, sample);
}

#if GN_INTERPOLATES
#if GN_SHADOWS
/* across2_q32 to 2^-24 of z^2, for corners of cells. */
GN_HOT static uint64_t corner_across2_q32(const gn_frame *frame, int32_t px, int32_t py, int32_t z_q16)
{
    uint64_t tan2_q24 = (uint64_t)((uint32_t)(px * px) + (uint32_t)(py * py)) * (uint64_t)frame->tan2_per_px2_q44 >> 20;
    int32_t up = gn_clz32((uint32_t)z_q16 | 1U) - 1;
    if (GN_FLAT_Q16(frame) || tan2_q24 >> 27 || up < 2) return across2_q32(frame, px, py, z_q16);
    uint32_t z = (uint32_t)z_q16 << up;
    return (uint64_t)gn_umul_high(z, (uint32_t)tan2_q24 << 4) * z >> (2 * up - 4); /* 2^30 * 2^31 */
}

GN_HOT static void corner_cascade(const gn_frame *frame, int32_t px, int32_t py, gn_sample *sample)
{
    if (!asks_for_cascades(frame)) return;
    cascade_within(frame, corner_across2_q32(frame, px, py, sample->value[GN_VALUE_Z]), sample);
}
#else
GN_HOT static void corner_cascade(const gn_frame *frame, int32_t px, int32_t py, gn_sample *sample)
{
    (void)frame, (void)px, (void)py, (void)sample;
}
#endif

GN_HOT void gn_sample_find_cascade(const gn_frame *frame, int32_t px, int32_t py, int32_t z_q16, gn_sample *sample)
{
    sample->value[GN_VALUE_Z] = z_q16;
    sample->value[GN_VALUE_FADE] = 0;
    sample->cascade = GN_CASCADE_NONE;
    sample->in_reach = 1;
    corner_cascade(frame, px, py, sample);
}

GN_HOT int gn_sample_on_plane(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y, gn_sample *sample)
{
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    gn_ray_recip r;
    hit h;
    if (!gn_plane_recip(&r, &s->plane, px, py, frame->cam.focal2_px_q16, GN_RECIP_STEPS(frame))) return 0;
    uint64_t z = depth_at(s, &r);
    if (z < (uint64_t)(s->z_min_q16 >> 1) || z > 2 * (uint64_t)s->z_max_q16 || z > INT32_MAX || !z) return 0;
    h.z_q16 = (int32_t)z;
    if (GN_HAS_BARY(s) && !gn_bary_beyond(h.b_q30, &s->bary, &r, px, py, frame->cam.focal2_px_q16)) return 0;
    sample_values(frame, s, &h, px, py, 0, sample);
    return 1;
}
#endif

GN_HOT uint32_t gn_sample_cascade(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y)
{
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    hit h;
    gn_sample sample;
    intersect(frame, s, px, py, &h);
    sample.value[GN_VALUE_Z] = h.z_q16;
    sample.cascade = GN_CASCADE_NONE;
    select_cascade(frame, px, py, &sample);
    return (uint32_t)sample.cascade;
}

GN_HOT void gn_sample_normal(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y, int32_t normal_q30[3])
{
    hit h;
    intersect(frame, s, 2 * x + 1 - frame->picture.width, frame->picture.height - 1 - 2 * y, &h);
    normal_at(s, &h, normal_q30);
}
