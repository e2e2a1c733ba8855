/* Cascades of surfaces, parts and pixels. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "shade/gn_corner.h"
#include "shade/gn_shadow.h"

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

/* Views of cascades that points may look into, a bit each, and GN_VIEWS_FADE. */
GN_HOT static uint32_t possible_views(const gn_frame *frame, const extent *e)
{
    const int blends = GN_BLENDED_CASCADES && frame->scene->shadow.blend != GN_BLEND_HARD;
    const uint64_t rounding = e->tan2_hi_q24 + 1;
    uint32_t views = 0;
    if (frame->scene->shadow.distance_mode != GN_DISTANCE_DEPTH || (uint32_t)e->z_hi_q16 > frame->fade_start_q16)
        views |= GN_VIEWS_FADE;
    if (!frame->has_cascades) return views;
    const int beyond = (e->z_hi_q16 | GN_FLAT_Q16(frame)) >> 27 || e->tan2_hi_q24 >> 28; /* what distance2_q32 takes */
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

GN_HOT void gn_corner_begin_box(gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_rect *box)
{
    extent e = {s->z_min_q16, s->z_max_q16, 0, 0};
    l->views = 0;
    if (!s->shadowed) return;
    find_tangents(frame, box->x0, box->x1 - 1, box->y0, box->y1 - 1, &e);
    l->views = (uint16_t)possible_views(frame, &e);
}

GN_HOT void gn_corner_begin_part(gn_lattice *l, const gn_frame *frame, const gn_surface *s)
{
    extent e = {INT32_MAX, 0, 0, 0};
    int32_t x[2] = {l->x, gn_min32(l->x + GN_PART_WIDTH, l->x_end) - 1},
            y[2] = {l->y, gn_min32(l->y + l->n_rows, l->y_end) - 1};
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
