/* Cascades of points, parts of the picture, surfaces and objects. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_surface.h"

/* ---- Points ------------------------------------------------------------------------------------------------------ */

#if GN_SHADOWS
#define GN_ONE_UQ16 65536U

GN_HOT uint32_t gn_shadow_distance_fade(const gn_frame *frame, int32_t z_q16)
{
    if (frame->scene->shadow.distance_mode != GN_DISTANCE_DEPTH || (uint32_t)z_q16 <= frame->fade_start_q16)
        return GN_ONE_UQ16;
    int64_t left_q16 = (int64_t)frame->scene->shadow.max_distance_q16 - z_q16;
    if (left_q16 <= 0) return 0;
    return (uint32_t)gn_clamp64(gn_bf_apply(left_q16, frame->fade_scale, 32), 0, GN_ONE_UQ16);
}

/* Square of the distance from the view axis of the point at depth z on a pixel's ray, below 2^61: to 2^-24 of z^2, and
 * as the square of the tangent per pixel is rounded. */
GN_HOT static uint64_t across2_q32(const gn_frame *frame, int32_t x, int32_t y, int32_t z_q16)
{
    const int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y,
                  at = GN_FLAT_Q16(frame) ? GN_FLAT_Q16(frame) : z_q16;
    const uint64_t tan2_q24 = (uint64_t)(uint32_t)(px * px + py * py) * (uint64_t)frame->tan2_per_px2_q44 >> 20 | 1U;
    const int32_t z_up = gn_clz32((uint32_t)at | 1U) - 1, up = gn_clz64(tan2_q24), shift = 40 - up - 2 * z_up;
    const uint32_t z = (uint32_t)at << z_up;
    return (uint64_t)gn_scale64((int64_t)((uint64_t)gn_umul_high(z, (uint32_t)(tan2_q24 << up >> 32)) * z), -shift);
}

/* The first sphere that a point so far from the view axis lies in, and its fade factor. [D4] [D6] */
GN_HOT static void find_sphere(const gn_frame *frame, uint64_t across_q32, int32_t z_q16, gn_cascade_point *out)
{
    for (int32_t i = 0; i < GN_N_CASCADES(frame); i++) {
        const gn_cascade_state *cascade = &frame->cascade[i];
        const int64_t dz = (int64_t)z_q16 - cascade->centre_q16;
        const uint64_t dist2 = across_q32 + (uint64_t)(dz * dz);
        if (dist2 >= cascade->radius2_q32) continue;
        out->cascade = i;
        out->fade_uq16 = GN_ONE_UQ16;
        if (dist2 > cascade->inner2_q32) {
            int64_t factor = gn_bf_apply((int64_t)(cascade->radius2_q32 - dist2), cascade->fade_scale, 48);
            out->fade_uq16 = (uint32_t)gn_clamp64(factor, 0, GN_ONE_UQ16);
        }
        return;
    }
}

/* [D5] [D6] [D11] */
GN_HOT void gn_cascade_at(const gn_frame *frame, int32_t x, int32_t y, int32_t z_q16, gn_cascade_point *out)
{
    const int by_radius = frame->scene->shadow.distance_mode == GN_DISTANCE_RADIUS,
              raw = GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32;
    *out = (gn_cascade_point){GN_CASCADE_NONE, 0, 0};
    if (frame->has_cascades | by_radius | raw) {
        const int64_t m = frame->scene->shadow.max_distance_q16, z = z_q16;
        const uint64_t across_q32 = across2_q32(frame, x, y, z_q16);
        if (by_radius && across_q32 + (uint64_t)(z * z) > (uint64_t)(m * m)) return;
        find_sphere(frame, across_q32, z_q16, out);
    }
    if (frame->has_cascades && out->cascade == GN_CASCADE_NONE) return;
    out->g_uq16 = gn_shadow_distance_fade(frame, z_q16);
    if (frame->has_cascades && out->cascade == GN_LAST_CASCADE(frame))
        out->g_uq16 = gn_mul_uq16(out->g_uq16, out->fade_uq16);
}

#if GN_INTERPOLATES
GN_HOT int64_t gn_cascade_inside_q32(const gn_frame *frame, int32_t x, int32_t y, int32_t z_q16, int32_t cascade_idx)
{
    const gn_cascade_state *cascade = &frame->cascade[cascade_idx];
    const int64_t dz = (int64_t)z_q16 - cascade->centre_q16;
    return (int64_t)(cascade->radius2_q32 - across2_q32(frame, x, y, z_q16) - (uint64_t)(dz * dz));
}
#endif
#endif

/* ---- Parts of the picture, surfaces, objects --------------------------------------------------------------------- */

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

#endif
