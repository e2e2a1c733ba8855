/* Where views of lights see corners. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_surface.h"

#if GN_INTERPOLATES && GN_SHADOWS

/* Normal of the surface at the corner. */
GN_HOT static const int32_t *normal_of(const gn_surface *s, const gn_corner *c)
{
#if GN_VERTEX_NORMALS
    (void)s;
    return c->normal_q30;
#else
    (void)c;
    return s->normal_q30[0];
#endif
}

GN_HOT const int32_t *gn_corner_flat_offset(gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                            const gn_light_view *view)
{
    if (l->offset_view != view) gn_sample_offset(frame, s, slot, view, s->normal_q30[0], l->offset_q16);
    l->offset_view = view;
    return l->offset_q16;
}

/* View depth of the plane at a pixel, up to its largest on the triangle. */
GN_HOT static inline int32_t plane_depth(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, int32_t x,
                                         int32_t y)
{
    const gn_screen_plane *p = &l->plane;
#if GN_ORTHOGRAPHIC
    int32_t b_q28[2];
    if (GN_FLAT_Q16(frame)) return gn_max32(1, gn_min32(gn_corner_flat_depth(p, s, x, y, b_q28), s->z_max_q16));
#endif
    int32_t w = gn_max32(gn_slope_at(&p->w, x - p->x, y - p->y), 1 << 10), clz = gn_clz32((uint32_t)w);
    uint32_t z = gn_umul_high(s->depth_scale.mant, gn_recip_norm((uint32_t)w << clz, GN_RECIP_STEPS(frame)));
    int32_t shift = p->z_shift - clz;
    if (shift < 1) return s->z_max_q16;
    z = shift > 31 ? 0 : ((z >> (shift - 1)) + 1) >> 1;
    return gn_max32(1, gn_min32((int32_t)(z & INT32_MAX), s->z_max_q16));
}

GN_HOT int32_t gn_corner_depth(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y)
{
    return plane_depth(l, frame, s, x, y);
}

GN_HOT int32_t gn_corner_uv(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_light_view *view,
                            int32_t x, int32_t y, const int32_t offset_q16[3], int32_t uv_q16[2])
{
    gn_corner_ray ray;
    const int32_t z_q16 = gn_corner_seen_depth(l, frame, s, x, y);
    if (z_q16 <= 0 || !gn_corner_ray_begin(&ray, frame, view->fit.ortho.ray_shift, x, y, z_q16)) return 0;
    uint32_t beyond = 0; /* its sign: a sum has another than both of its terms */
    GN_UNROLL
    for (int i = 0; i < 2; i++) {
        const uint32_t at = (uint32_t)gn_corner_ortho(&view->fit.ortho.ray[i], &ray), offset = (uint32_t)offset_q16[i],
                       sum = at + offset;
        beyond |= (at ^ sum) & (offset ^ sum);
        uv_q16[i] = (int32_t)sum;
    }
    if (beyond >> 31) return 0;
    return z_q16;
}

GN_HOT GN_NOINLINE void gn_corner_coords(gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_corner *c,
                                         uint32_t slot, const gn_light_view *view, int32_t coord[3])
{
    gn_corner_ray ray;
    const int fits = gn_corner_ray_begin(&ray, frame, view->fit.ortho.ray_shift, c->x, c->y, c->z_q16);
    if (fits && (!GN_SMOOTH(s) || (GN_AUTO_BIAS && s->light[slot].state->auto_bias))) {
        const int32_t *offset_q16 = gn_corner_flat_offset(l, frame, s, slot, view);
        GN_UNROLL
        for (int i = 0; i < 3; i++) /* automatic bias may say: lit */
            coord[i] = gn_sat32((int64_t)gn_corner_ortho(&view->fit.ortho.ray[i], &ray) + offset_q16[i]);
    } else gn_sample_in_view(frame, s, slot, view, c->x, c->y, c->z_q16, normal_of(s, c), coord);
}

GN_HOT static void place_directional(gn_lattice *l, const gn_frame *frame, const gn_surface *s, gn_corner *c,
                                     uint32_t slot, const gn_light_view *view)
{
    gn_corner_light *at = &c->light[slot];
    int32_t coord[3];
    gn_corner_coords(l, frame, s, c, slot, view, coord);
    at->u_q16 = coord[0];
    at->v_q16 = coord[1];
    at->depth_q30 = gn_depth_q30(view, coord[2]);
    at->seen = 1;
}

#if GN_PUNCTUAL_LIGHTS
/* Returns how the point is seen. */
GN_HOT static GN_NOINLINE int place_persp(const gn_frame *frame, const gn_surface *s, const gn_corner *c,
                                          gn_corner_light *at, const gn_light_view *view)
{
    const gn_light_state *light = &frame->light[view->light_idx];
    int32_t offset[3] = {0, 0, 0}, from[3];
    gn_arrival place;
    gn_corner_from(c, light, from);
    if (!(GN_AUTO_BIAS && light->auto_bias)) gn_bias_punctual(frame, light, normal_of(s, c), from, offset);
    at->seen = (uint8_t)gn_arrival_place(frame, s, view, c->z_q16, from, offset, &place);
    if (!at->seen) return 0;
    at->u_q16 = place.u_q16;
    at->v_q16 = place.v_q16;
    at->depth_q30 = (int32_t)(place.depth_q32 >> 2);
    return at->seen;
}

#endif

GN_HOT void gn_corner_slopes(gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_light_view *view,
                             int32_t slope_q28[2])
{
    slope_q28[0] = slope_q28[1] = 0;
#if GN_PLANES
    if (!gn_shadow_has_plane(frame, view)) return;
    if (l->slope_view != view) {
        int32_t from[3] = {0, 0, 0};
        l->slope_view = view;
        l->slope_q28[0] = l->slope_q28[1] = 0;
        if (view->perspective && !gn_corner_find_anchor(l, frame, s)) return;
#if GN_PUNCTUAL_LIGHTS
        if (view->perspective) gn_corner_from_ray(l->anchor.ray_q16, &frame->light[view->light_idx], from);
#endif
        gn_shadow_slopes(frame, s, view, from, l->slope_q28);
    }
    slope_q28[0] = l->slope_q28[0];
    slope_q28[1] = l->slope_q28[1];
#endif
    (void)l, (void)frame, (void)s, (void)view;
}

GN_HOT int gn_corner_place_any(gn_lattice *l, const gn_frame *frame, const gn_surface *s, gn_corner *c, uint32_t slot,
                               const gn_light_view *view)
{
#if GN_PUNCTUAL_LIGHTS
    if (view->perspective) return place_persp(frame, s, c, &c->light[slot], view);
#endif
    place_directional(l, frame, s, c, slot, view);
    return 1;
}

#endif

/* ---- Cascades of surfaces, parts and pixels ---------------------------------------------------------------------- */

#if GN_INTERPOLATES && GN_SHADOWS

/* Points of a part of the picture: between two depths, and between two squared tangents from the axis. */
typedef struct {
    int32_t z_lo_q16, z_hi_q16;
    uint64_t tan2_lo_q24, tan2_hi_q24;
} extent;

/* Square of the distance from the view axis at a depth and a tangent; 0 to 2^32 too little. */
GN_HOT static uint64_t across2_of_q32(const gn_frame *frame, int32_t z_q16, uint64_t tan2_q24)
{
    int64_t z = GN_FLAT_Q16(frame) ? GN_FLAT_Q16(frame) : z_q16;
    return ((uint64_t)(z * z) >> 24) * tan2_q24;
}

/* The same from the cascade's centre. */
GN_HOT static uint64_t distance2_q32(const gn_frame *frame, const gn_cascade_state *cascade, int32_t z_q16,
                                     uint64_t tan2_q24)
{
    int64_t dz = (int64_t)z_q16 - cascade->centre_q16;
    return across2_of_q32(frame, z_q16, tan2_q24) + (uint64_t)(dz * dz);
}

/* Whether shadows may fade with distance up to a view depth. */
GN_HOT static inline int fades_by_distance(const gn_frame *frame, int32_t z_q16)
{
    return frame->scene->shadow.distance_mode != GN_DISTANCE_DEPTH || (uint32_t)z_q16 > frame->fade_start_q16;
}

/* Views of cascades that points may look into, a bit each, and GN_VIEWS_FADE if the last one may fade. */
GN_HOT static uint32_t views_of_cascades(const gn_frame *frame, const extent *e)
{
    const int blends = GN_BLENDED_CASCADES && frame->scene->shadow.blend != GN_BLEND_HARD;
    const uint64_t rounding = e->tan2_hi_q24 + 1;
    uint32_t views = 0;
    const int32_t z = e->z_hi_q16 | GN_FLAT_Q16(frame);
    const int beyond = z >> 30 || e->tan2_hi_q24 >> (z >> 27 ? 26 : 28); /* what distance2_q32() takes */
    for (int32_t i = 0; i < GN_N_CASCADES(frame); i++) {
        const gn_cascade_state *c = &frame->cascade[i];
        if (!c->radius2_q32) continue; /* empty */
        int32_t nearest = gn_max32(e->z_lo_q16, gn_min32(c->centre_q16, e->z_hi_q16));
        int64_t dz = (int64_t)nearest - c->centre_q16;
        if (!beyond && across2_of_q32(frame, e->z_lo_q16, e->tan2_lo_q24) + (uint64_t)(dz * dz) >= c->radius2_q32)
            continue;
        views |= 1U << i;
        uint64_t farthest = UINT64_MAX;
        if (!beyond) {
            const uint64_t a = distance2_q32(frame, c, e->z_lo_q16, e->tan2_hi_q24),
                           b = distance2_q32(frame, c, e->z_hi_q16, e->tan2_hi_q24);
            farthest = (a > b ? a : b) + rounding;
        }
        if (farthest >= c->inner2_q32) {
            if (i == GN_LAST_CASCADE(frame)) views |= GN_VIEWS_FADE;
            else if (blends) views |= 1U << c->next;
        }
        if (farthest < c->radius2_q32) return views;
    }
    return views | GN_VIEWS_FADE;
}

/* The same of lights that may have none, and of distance, too. */
GN_HOT static uint32_t possible_views(const gn_frame *frame, const extent *e)
{
    return (fades_by_distance(frame, e->z_hi_q16) ? GN_VIEWS_FADE : 0) |
           (frame->has_cascades ? views_of_cascades(frame, e) : 0);
}

/* The cascade of all points, if none of them fades or blends there; -1 if it is not certain. */
GN_HOT static int16_t certain_cascade(uint32_t views)
{
    if (!views) return GN_CASCADE_NONE;
    return (int16_t)(views & (views - 1) || views == GN_VIEWS_FADE ? -1 : 31 - gn_clz32(views));
}

GN_HOT void gn_corner_begin_cascade(gn_lattice *l, const gn_frame *frame, const gn_surface *s)
{
    const extent all = {s->z_min_q16, s->z_max_q16, 0, (uint64_t)frame->tan2_q24};
    l->views = s->shadowed ? (uint16_t)possible_views(frame, &all) : 0;
    l->surface_cascade = l->cascade = s->shadowed ? certain_cascade(l->views) : -1;
}

/* Squares of the least and the largest distance from 0 of lo .. hi. */
GN_HOT static void squares_of(int32_t lo, int32_t hi, uint32_t *least, uint32_t *largest)
{
    uint32_t a = gn_abs32(lo), b = gn_abs32(hi), near = (lo < 0) != (hi < 0) ? 0 : a < b ? a : b, far = a > b ? a : b;
    *least += near * near;
    *largest += far * far;
}

/* Squared tangents of pixels x0 .. x1, y0 .. y1. */
GN_HOT static void find_tangents(const gn_frame *frame, int32_t x0, int32_t x1, int32_t y0, int32_t y1, extent *e)
{
    uint32_t least = 0, largest = 0;
    squares_of(2 * x0 + 1 - frame->picture.width, 2 * x1 + 1 - frame->picture.width, &least, &largest);
    squares_of(frame->picture.height - 1 - 2 * y1, frame->picture.height - 1 - 2 * y0, &least, &largest);
    e->tan2_lo_q24 = least * (uint64_t)frame->tan2_per_px2_q44 >> 20;
    e->tan2_hi_q24 = (largest * (uint64_t)(frame->tan2_per_px2_q44 + 1) >> 20) + 1;
}

GN_HOT int32_t gn_cascade_of_region(const gn_frame *frame, int32_t z_lo_q16, int32_t z_hi_q16, const gn_rect *px)
{
    extent e = {z_lo_q16, z_hi_q16, 0, 0};
    if (!frame->has_cascades) return 0;
    find_tangents(frame, px->x0, px->x1 - 1, px->y0, px->y1 - 1, &e);
    return certain_cascade(views_of_cascades(frame, &e));
}

GN_HOT int32_t gn_cascade_of_object(const gn_frame *frame, uint32_t object_idx)
{
#if GN_BOXES
    const gn_object_state *o = &frame->object[object_idx];
    const gn_rect all = {0, 0, frame->picture.width, frame->picture.height};
    int64_t z = 0, half = 0; /* |centre| + half <= 2^31, |eye| <= 2^30, an axis of length 1: below 2^63 */
    for (int i = 0; i < 3; i++) {
        const int32_t axis_q30 = frame->cam.axis_q30[2][i];
        z += ((int64_t)o->centre_q16[i] - frame->cam.eye_q16[i]) * axis_q30;
        half += (int64_t)o->half_q16[i] * (int32_t)gn_abs32(axis_q30);
    }
    const int64_t lo = gn_shr64(z - half, 30) - 2, hi = gn_shr64(z + half, 30) + 2;
    const int32_t nearest = lo > frame->cam.near_q16 ? (int32_t)lo : frame->cam.near_q16;
    if (hi >= GN_VIEW_LIMIT_Q16 || hi <= nearest || fades_by_distance(frame, (int32_t)hi)) return -1;
    return gn_cascade_of_region(frame, nearest, (int32_t)hi, &all);
#else
    (void)frame, (void)object_idx;
    return -1;
#endif
}

GN_HOT void gn_corner_begin_part(gn_lattice *l, const gn_frame *frame, const gn_surface *s)
{
    extent e = {INT32_MAX, 0, 0, 0};
    const int32_t x[2] = {l->block.x0, l->block.x1 - 1}, y[2] = {l->block.y0, l->block.y1 - 1};
    l->cascade = l->surface_cascade;
    if (l->cascade >= 0 || !s->shadowed) return;
    for (int i = 0; i < 4; i++) {
        int32_t z = gn_corner_depth(l, frame, s, x[i & 1], y[i >> 1]);
        e.z_lo_q16 = gn_min32(e.z_lo_q16, z);
        if (GN_FLAT_Q16(frame) && z == 1) z = s->z_max_q16; /* far off the triangle: any depth */
        e.z_hi_q16 = gn_max32(e.z_hi_q16, z);
    }
    e.z_lo_q16 = gn_max32(e.z_lo_q16 - 1, s->z_min_q16);
    e.z_hi_q16 = gn_min32(e.z_hi_q16 + 1, s->z_max_q16);
    find_tangents(frame, x[0], x[1], y[0], y[1], &e);
    l->views = (uint16_t)possible_views(frame, &e);
    l->cascade = certain_cascade(l->views);
}

GN_HOT void gn_corner_cascade(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y,
                              gn_sample *sample)
{
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    gn_sample_find_cascade(frame, px, py, gn_corner_depth(l, frame, s, x, y), sample);
}

#endif

/* ---- Spot and point lights at corners of cells ------------------------------------------------------------------- */

#if GN_INTERPOLATES && GN_PUNCTUAL_LIGHTS

/* clamp(share, 0, 1)^2 of a spot's rim, Q30. */
GN_HOT static int32_t rim_q30(const gn_light_state *light, int32_t cosine_q30, gn_corner_light *out)
{
    int32_t beyond = cosine_q30 - light->cos_outer_q30;
    uint64_t share = gn_corner_rim_q30(light, gn_abs32(beyond));
    int32_t whole = share >> 32 ? 126 : (int32_t)(share >> 25), q30 = (int32_t)share;
    out->arrives = (int8_t)(beyond <= 0 ? -whole : gn_max32(whole, 1));
    if (beyond <= 0) return 0;
    return share >= 1U << 30 ? 1 << 30 : 4 * gn_mul_high(q30, q30);
}

/* The share alone, within 2^8: a rim is 10^-4 wide or more, so that where one vertex is limited and another is lit, the
 * bound of what is linear in between is above 1. */
GN_HOT static int32_t rim_share_q20(const gn_light_state *light, int32_t cosine_q30)
{
    int32_t beyond = cosine_q30 - light->cos_outer_q30;
    uint64_t share = gn_corner_rim_q30(light, gn_abs32(beyond)) >> 10;
    int32_t q20 = share >> 28 ? 1 << 28 : (int32_t)share;
    return beyond < 0 ? -q20 : q20;
}

GN_HOT int32_t gn_corner_irradiance(const gn_frame *frame, const gn_light_state *light, const int32_t from_q16[3],
                                    uint64_t d2, int32_t facing_q16, gn_corner_light *out, int32_t *rim_q20)
{
    out->arrives = GN_CORNER_DARK;
    if (facing_q16 <= 0) return 0;
    if (d2 >= light->range2_q32 || d2 >> 62) return 0;
    int steps = light->kind == GN_LIGHT_SPOT && light->angle_scale.exp >= GN_NARROW_EXP ? 2 : GN_RECIP_STEPS(frame);
    int32_t shift = gn_clz64(d2) & ~1, half = (shift >> 1) - 1, most = INT32_MAX >> half, factor = 1 << 30;
    uint32_t root = gn_rsqrt_norm((uint32_t)((d2 << shift) >> 32), steps);
    int32_t root_q31 = (int32_t)(root >> 1);
    GN_KEEP(root_q31); /* signed: one multiplication; factor, too */
    out->arrives = GN_CORNER_FULLY;
    if (light->kind == GN_LIGHT_SPOT) {
        int32_t reach = (int32_t)gn_clamp64(-gn_dot_q30(from_q16, light->to_light_q30), -most, most),
                cosine = 2 * gn_mul_high(reach * (1 << half), root_q31);
        if (rim_q20) *rim_q20 = rim_share_q20(light, cosine);
        else if (reach > 0) factor = rim_q30(light, cosine, out);
        else factor = 0, out->arrives = 1 - GN_CORNER_FULLY;
        if (!factor) return 0;
    }
    GN_KEEP(factor);
    if (light->range2_q32 != UINT64_MAX) factor = 4 * gn_mul_high(factor, gn_corner_window_q30(light, d2));
    int32_t cosine = 2 * gn_mul_high(gn_min32(facing_q16, most) << half, root_q31);
    GN_KEEP(factor);
    int32_t share = 4 * gn_mul_high(factor, cosine);
    if (d2 < frame->min2_q32) { /* cosines are of the true distance */
        shift = gn_clz64(frame->min2_q32) & ~1;
        root = gn_rsqrt_norm((uint32_t)((frame->min2_q32 << shift) >> 32), steps);
    }
    /* 1 / d^2 = root^2 * 2^(shift - 94), of which 31 bits are used */
    int32_t root2 = (int32_t)(gn_umul_high(root, root) >> 1);
    GN_KEEP(root2);
    int32_t q = gn_mul_high(share, root2), down = 35 - shift - light->colour_exp;
    if (down >= 0) return gn_min32(down > 31 ? 0 : q >> down, 1 << 27);
    return down < -27 || q >> (27 + down) ? 1 << 27 : q << -down;
}

#endif
