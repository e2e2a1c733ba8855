/* What arrives from spot and point lights. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_bias.h"
#include "light/gn_punctual.h"
#include "shade/gn_arrival.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_persp.h"

#if GN_PUNCTUAL_LIGHTS

/* ---- At a point -------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
/* T / 2 * (1 + x / (z t)), Q16: the clamps keep what is far outside the tile outside. */
GN_HOT static int32_t persp_coord(const gn_light_view *view, int64_t x_q16, uint32_t recip, int32_t clz)
{
#if !GN_SIZE_FIRST
    if (gn_abs64(x_q16) < (uint64_t)UINT32_MAX >> clz && clz >= 2 &&
        !(view->fit.persp.focal2_q16 >> 30)) {         /* |x| < 2 z: the same, of which nothing needs a clamp */
        int32_t x = (int32_t)x_q16 * (1 << (clz - 2)); /* x / z = x * recip / 2^61: below 2^29 * 4 */
        int32_t ratio_q28 = (int32_t)((((int64_t)x * (int64_t)recip >> 32) + 1) >> 1);
        return (int32_t)(((int64_t)ratio_q28 * (int64_t)view->fit.persp.focal2_q16 + (1 << 28)) >> 29) +
               (view->tile_texels << 15);
    }
#endif
    /* times focal2 within 2^60, and 2^14 texels or more: beyond every tile */
    const int64_t bound = (int64_t)1 << (28 + gn_clz32(view->fit.persp.focal2_q16)), x_most = INT32_MAX;
    int64_t ratio_q28 = gn_scale64(gn_clamp64(x_q16, -x_most, x_most) * (int64_t)recip, 35 - clz); /* 2^31 * 2^32 */
    int64_t texels = gn_shr64(gn_clamp64(ratio_q28, -bound, bound) * (int64_t)view->fit.persp.focal2_q16, 29);
    return gn_sat32(texels + ((int64_t)view->tile_texels << 15));
}

/* B2 and B3 have moved the point at the sample; B6 does it here, in one of its forms, face by face of a point light.
 * Returns what is to be taken off its depth, Q32. */
GN_HOT static int64_t moved_point(const gn_frame *frame, const gn_surface *surface, int32_t z_q16,
                                  const gn_light_view *view, gn_auto_bias *form, const int32_t *value,
                                  int32_t moved_q16[3])
{
    const int32_t *from = value + GN_LIGHT_POINT_AT, *offset = value + GN_LIGHT_OFFSET;
#if GN_AUTO_BIAS
    if (*form && !GN_CURVED(surface)) return gn_bias_auto_persp(view, form, surface->face_q30, z_q16, from, moved_q16);
#endif
    (void)frame, (void)surface, (void)z_q16, (void)view, (void)form;
    for (int i = 0; i < 3; i++) moved_q16[i] = gn_sat32((int64_t)from[i] + offset[i]);
#if GN_AUTO_BIAS
    return *form ? view->auto_step : 0;
#else
    return 0;
#endif
}

/* Where the view sees the point in that form. Returns 0 if it is nearer than its near plane. */
GN_HOT static int place_in(const gn_frame *frame, const gn_surface *surface, int32_t z_q16, const gn_light_view *view,
                           gn_auto_bias form, const int32_t *value, gn_arrival *out)
{
    int32_t moved[3];
    int64_t at[3], less_q32 = moved_point(frame, surface, z_q16, view, &form, value, moved);
    for (int i = 0; i < 3; i++) at[i] = gn_dot_q30(moved, view->axis_q30[i]); /* sqrt(3) * 2^61 */
    if (at[2] <= view->fit.persp.near_q16) return 0;
    uint32_t z = at[2] > UINT32_MAX ? UINT32_MAX : (uint32_t)at[2];
#if GN_ARRIVAL_STEPS
    if (form == GN_AUTO_BIAS_DEPTH) out->side |= GN_SIDE_DEPTH;
#endif
    int32_t clz = gn_clz32(z);
    uint32_t recip = gn_recip_norm(z << clz, GN_K(frame, newton_steps));
    /* 1 - n / z: n * recip * 2^(clz - 31) */
    uint64_t inverse = (uint64_t)(uint32_t)view->fit.persp.near_q16 * recip >> (31 - clz);
    out->u_q16 = persp_coord(view, at[0], recip, clz);
    out->v_q16 = persp_coord(view, at[1], recip, clz);
    out->depth_q32 = (uint32_t)gn_clamp64(UINT32_MAX - (int64_t)inverse - less_q32, 0, UINT32_MAX);
    return 1;
}

/* Where the light's view sees the point. B6 along the normal would move what is at a spot's rim out of its tile, whose
 * border says nothing of it: there it goes along the ray. */
GN_HOT static void light_space_point(const gn_frame *frame, const gn_surface *surface, const gn_light_state *light,
                                     int32_t z_q16, const int32_t *value, gn_arrival *out)
{
    /* P5: the face of the unmoved point; the moved one stays in it */
    uint8_t face = light->kind == GN_LIGHT_POINT ? (uint8_t)gn_persp_face(value + GN_LIGHT_POINT_AT) : 0;
    const gn_light_view *view = &frame->view[light->view_idx + face];
    gn_auto_bias form = GN_AUTO_BIAS_DEFAULT; /* none */
#if GN_AUTO_BIAS
    form = (gn_auto_bias)light->auto_bias;
#endif
    int seen = place_in(frame, surface, z_q16, view, form, value, out);
#if GN_AUTO_BIAS
    uint32_t end = (uint32_t)view->tile_texels << 16;
    if (seen && form == GN_AUTO_BIAS_NORMAL && !GN_CURVED(surface) &&
        ((uint32_t)out->u_q16 > end || (uint32_t)out->v_q16 > end))
        seen = place_in(frame, surface, z_q16, view, GN_AUTO_BIAS_DEPTH, value, out);
#endif
    out->face = seen ? face : GN_FACE_NONE;
}
#endif

/* `value` is the light's slot of a sample, z the view depth. [P10] */
GN_HOT static void arrive(const gn_frame *frame, const gn_surface *surface, const gn_light_state *light, int32_t z_q16,
                          const int32_t *value, gn_arrival *out)
{
    gn_punctual_point point;
    out->irradiance_q24 = 0;
    out->reaches = value[GN_LIGHT_FACING] > 0 && gn_punctual_at(frame, light, value + GN_LIGHT_POINT_AT, &point);
    if (!out->reaches) return;
    GN_COUNT(lights_punctual, 1);
    out->irradiance_q24 = gn_punctual_irradiance_q24(&point, gn_punctual_cosine_q30(&point, value[GN_LIGHT_FACING]));
#if GN_ARRIVAL_STEPS
    out->side = point.within_inner ? GN_SIDE_INNER : 0;
    out->shadow = GN_SHADOW_UNDECIDED;
#endif
#if GN_SHADOWS
    out->face = GN_FACE_NONE;
    if (surface->shadowed && light->view_idx >= 0) light_space_point(frame, surface, light, z_q16, value, out);
#else
    (void)surface, (void)z_q16;
#endif
}

GN_HOT void gn_arrivals_at(const gn_frame *frame, const gn_surface *surface, gn_sample *sample)
{
    for (uint32_t i = surface->n_lights - surface->n_punctual; i < surface->n_lights; i++)
        arrive(frame, surface, surface->light[i].state, sample->value[GN_VALUE_Z],
               &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i], &sample->arrival[i]);
}

#if GN_ARRIVAL_STEPS
/* ---- Between two points ------------------------------------------------------------------------------------------ */

/* Value i of a chord after m pixels. */
GN_HOT static int32_t after(const gn_chord *chord, const int32_t *value, int32_t i, int32_t m)
{
    int32_t bend = i >= chord->bend_first && i < chord->bend_end ? chord->bend[i] : 0;
    return (int32_t)((uint32_t)value[i] + (uint32_t)m * (uint32_t)chord->step[i] +
                     (uint32_t)(m * (m - 1) / 2) * (uint32_t)bend); /* within the chord's ends */
}

/* A parabola of whole steps through v0, vm after m and vn after n pixels, n <= 16. Returns 0 if they are too far apart,
 * or so large that what lies between, up to 5/3 of the largest, might not fit. */
GN_HOT static int parabola(int32_t v0, int32_t vm, int32_t vn, int32_t m, int32_t n, int32_t *step, int32_t *bend)
{
    if ((gn_abs32(v0) | gn_abs32(vm) | gn_abs32(vn)) >> 30) return 0;
    int32_t to_m = vm - v0, to_n = vn - v0;
    if ((gn_abs32(to_m) | gn_abs32(to_n)) >> 30) return 0;
    int32_t first = to_m / m;
    *bend = 2 * (to_n / n - first) / (n - m);
    *step = first - *bend * (m - 1) / 2;
    return 1;
}

/* NUMERICS 4.13: what is left out is of third order in the way as a share of the distance. That is an eighth at most,
 * an eleventh where a spot fades out. */
GN_HOT static int is_far(const int32_t *from_q16, const int32_t *to_q16, int fades)
{
    uint64_t distance2 = 0, moved2 = 0;
    for (int i = 0; i < 3; i++) {
        int64_t moved = (int64_t)to_q16[i] - from_q16[i];
        if (gn_abs64(moved) >> 27) return 0; /* 3 * 2^54 * 2^7 */
        distance2 += (uint64_t)((int64_t)from_q16[i] * from_q16[i]);
        moved2 += (uint64_t)(moved * moved);
    }
    return moved2 << (fades ? 7 : 6) <= distance2;
}
#if GN_SHADOWS
/* A place is off by no more than 0.08 of how far it moves times the square of how much nearer the light is at one end
 * than at the other, as a share: 1/64 texel is left. */
GN_HOT static int places_hold(const gn_arrival *a, const gn_arrival *b)
{
    uint64_t moved_q8 = (gn_abs64((int64_t)b->u_q16 - a->u_q16) + gn_abs64((int64_t)b->v_q16 - a->v_q16)) >> 8;
    uint64_t change = gn_abs64((int64_t)b->depth_q32 - a->depth_q32) >> 12,
             rest = (a->depth_q32 > b->depth_q32 ? ~a->depth_q32 : ~b->depth_q32) >> 12;
    return moved_q8 < 1U << 20 && change * change * moved_q8 <= rest * rest * 50; /* 2^40 * 2^20 */
}

GN_HOT static int32_t min_of_three(int32_t a, int32_t b, int32_t c)
{
    return gn_min32(a, gn_min32(b, c));
}

GN_HOT static int32_t most_of(int32_t a, int32_t b, int32_t c)
{
    return gn_max32(a, gn_max32(b, c));
}

/* Widens lo .. hi of three values by how far the parabola through them goes beyond. */
GN_HOT static void widen_range(int32_t a, int32_t b, int32_t c, int32_t *lo, int32_t *hi)
{
    int32_t beyond = (int32_t)((gn_abs64((int64_t)a - b) + gn_abs64((int64_t)b - c)) >> 2) + 64;
    *lo = gn_sat32((int64_t)min_of_three(a, b, c) - beyond);
    *hi = gn_sat32((int64_t)most_of(a, b, c) + beyond);
}

/* Whether bounds of depth tell the attenuation of all that lies between. */
GN_HOT static void decide(const gn_frame *frame, const gn_light_state *light, const gn_arrival *a, const gn_arrival *m,
                          const gn_arrival *b, gn_arrival *out)
{
    const gn_light_view *view = &frame->view[light->view_idx + a->face];
    gn_receiver_step lo, hi;
    uint32_t attenuation;
    if (view->filter == GN_FILTER_DISK) return;
    widen_range(a->u_q16, m->u_q16, b->u_q16, &lo.u_q16, &hi.u_q16);
    widen_range(a->v_q16, m->v_q16, b->v_q16, &lo.v_q16, &hi.v_q16);
    widen_range((int32_t)(a->depth_q32 >> 1), (int32_t)(m->depth_q32 >> 1), (int32_t)(b->depth_q32 >> 1), &lo.depth_q31,
                &hi.depth_q31);
    if (gn_filter_decides(frame, view, &lo, &hi, &attenuation))
        out->shadow = attenuation ? GN_SHADOW_NONE : GN_SHADOW_FULL;
}

/* 1 - depth: n / z and the bias, times 2^(up - 2). */
GN_HOT static int32_t nearness(const gn_arrival *at, int32_t up)
{
    return (int32_t)(up < 2 ? ~at->depth_q32 >> (2 - up) : ~at->depth_q32 << (up - 2));
}

/* U, V in Q20 and nearness with all bits that fit, for steps are whole. */
GN_HOT static int step_places(gn_arrival_steps *steps, const gn_arrival *a, const gn_arrival *m, const gn_arrival *b,
                              int32_t middle, int32_t n)
{
    const gn_arrival *at[3] = {a, m, b};
    int32_t value[3][3];
    steps->up = gn_clz32(~a->depth_q32 | ~m->depth_q32 | ~b->depth_q32 | 1U);
    for (int i = 0; i < 3; i++) {
        if ((gn_abs32(at[i]->u_q16) | gn_abs32(at[i]->v_q16)) >> 26) return 0; /* and outside every tile */
        value[0][i] = at[i]->u_q16 * 16;
        value[1][i] = at[i]->v_q16 * 16;
        value[2][i] = nearness(at[i], steps->up);
    }
    for (int k = 0; k < 3; k++) {
        steps->at[k] = value[k][0];
        if (!parabola(value[k][0], value[k][1], value[k][2], middle, n, &steps->step[k + 1], &steps->bend[k + 1]))
            return 0;
    }
    return 1;
}

/* The same of places and shadow. */
GN_HOT static GN_NOINLINE int places_between(const gn_frame *frame, const gn_surface_light *light,
                                             gn_arrival_steps *steps, gn_arrival *a, const gn_arrival *m,
                                             const gn_arrival *b, int32_t middle, int32_t n)
{
#if GN_RECEIVER_PLANE
    if (frame->scene->lights[light->idx].receiver_plane) return 0; /* slopes ask for the point */
#endif
    if (a->face != b->face || a->face != m->face) return 0;
    if (a->face == GN_FACE_NONE) return 1;
    if (!a->depth_q32 || !b->depth_q32 || !m->depth_q32) return 0; /* limited */
    if (!places_hold(a, b)) return 0;
    decide(frame, light->state, a, m, b, a);
    return a->shadow != GN_SHADOW_UNDECIDED || step_places(steps, a, m, b, middle, n);
}
#endif

/* Whether nothing arrives between two points that nothing arrives at. Range and cone are convex: from the middle of the
 * way, which is no farther than half of it from every other point of it, to the surface of one of them it must be
 * farther than that. */
GN_HOT static GN_NOINLINE int stays_dark(const gn_surface *surface, const gn_light_state *light, const int32_t *a,
                                         const int32_t *b)
{
    const int32_t *a_q16 = a + GN_LIGHT_POINT_AT, *b_q16 = b + GN_LIGHT_POINT_AT;
    int32_t middle_q16[3];
    uint64_t size = 0, way = 64, d2 = 0, scaled2 = 0; /* along the axes, and what steps may be off by; Q32 */
    uint32_t any = 0;
    if (!GN_SMOOTH(surface) && a[GN_LIGHT_FACING] <= 0 && b[GN_LIGHT_FACING] <= 0) return 1;
    for (int i = 0; i < 3; i++) {
        middle_q16[i] = (int32_t)(((int64_t)a_q16[i] + b_q16[i]) >> 1);
        uint32_t m = gn_abs32(middle_q16[i]);
        way += gn_abs64((int64_t)b_q16[i] - a_q16[i]);
        size += m;
        any |= m;
        d2 += (uint64_t)m * m;
    }
    way >>= 1;
    if (8 * way > size) return 0; /* and what follows fits */
    if (d2 >= light->range2_q32 && d2 - light->range2_q32 > 2 * way * size + way * way)
        return 1; /* (r + way)^2, r no more than the size */
    if (light->kind != GN_LIGHT_SPOT) return 0;
    /* cos(outer / 2) |p| is more than the light-plane distance, even if both change by the way; what a root of one step
     * may be off by is added */
    int32_t drop = gn_max32(0, 17 - gn_clz32(any | 1U)); /* to 15 bits */
    int64_t along = (-gn_dot_q30(middle_q16, light->to_light_q30) + (int64_t)(2 * way + (size >> 12))) >> drop;
    if (along < 0) return 1;
    if (along >= 65535) return 0;
    for (int i = 0; i < 3; i++)
        scaled2 += (uint64_t)(gn_abs32(middle_q16[i]) >> drop) * (gn_abs32(middle_q16[i]) >> drop);
    uint64_t cosine = (uint64_t)(light->cos_outer_q30 >> 15);
    return scaled2 * (cosine * cosine) > (uint64_t)((along + 1) * (along + 1)) << 30; /* 3 * 2^30 * 2^30, 2^32 * 2^30 */
}

/* Sets the steps of one light. Returns 0 where no parabola will do: at the rim of a cone, at a terminator, from face to
 * face. */
GN_HOT static int between(const gn_frame *frame, const gn_surface *surface, uint32_t slot, gn_chord *chord,
                          gn_sample *sa, const gn_sample *sb, int32_t n)
{
    const gn_surface_light *light = &surface->light[slot];
    gn_arrival *a = &sa->arrival[slot], m = {0};
    const gn_arrival *b = &sb->arrival[slot];
    int32_t first = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * (int32_t)slot, middle = n >> 1, value[GN_VALUES_PER_LIGHT];
    gn_arrival_steps *steps = &chord->arrival[slot];
    if (!a->reaches && !b->reaches) return stays_dark(surface, light->state, sa->value + first, sb->value + first);
    if (!a->reaches || !b->reaches || a->side != b->side) return 0;
    int fades = light->state->kind == GN_LIGHT_SPOT && !(a->side & GN_SIDE_INNER);
    if (!is_far(sa->value + first + GN_LIGHT_POINT_AT, sb->value + first + GN_LIGHT_POINT_AT, fades)) return 0;
    for (int32_t i = 0; i < GN_VALUES_PER_LIGHT; i++) value[i] = after(chord, sa->value, first + i, middle);
    arrive(frame, surface, light->state, after(chord, sa->value, GN_VALUE_Z, middle), value, &m);
    if (!m.reaches || a->side != m.side) return 0;
    if (!parabola((int32_t)a->irradiance_q24, (int32_t)m.irradiance_q24, (int32_t)b->irradiance_q24, middle, n,
                  &steps->step[0], &steps->bend[0]))
        return 0;
#if GN_SHADOWS
    if (light->state->view_idx < 0 || !surface->shadowed) return 1;
    return places_between(frame, light, steps, a, &m, b, middle, n);
#else
    return 1;
#endif
}

GN_HOT void gn_arrivals_between(gn_chord *chord, const gn_frame *frame, const gn_surface *surface, gn_sample *a,
                                const gn_sample *b, int32_t n)
{
    int32_t end = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * (int32_t)(surface->n_lights - surface->n_punctual);
    for (uint32_t i = surface->n_lights - surface->n_punctual; i < surface->n_lights; i++) {
        chord->arrival[i].holds = n > 2 && between(frame, surface, i, chord, a, b, n);
        if (!chord->arrival[i].holds) end = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * (int32_t)(i + 1);
    }
    chord->end = end;
    chord->bend_end = gn_min32(chord->bend_end, end);
}

#if GN_SHADOWS
/* A parabola may leave 0 .. 1. */
GN_HOT static uint32_t stepped_depth(const gn_arrival_steps *steps)
{
    uint32_t near = (uint32_t)gn_max32(steps->at[2], 0);
    if (steps->up >= 2) return ~(near >> (steps->up - 2));
    return near >> (30 + steps->up) ? 0 : ~(near << (2 - steps->up));
}
#endif

GN_HOT static void step(gn_arrival_steps *steps, gn_arrival *out)
{
    if (!out->reaches) return; /* nor will it */
    out->irradiance_q24 = (uint32_t)gn_max32(0, (int32_t)out->irradiance_q24 + steps->step[0]);
    steps->step[0] += steps->bend[0];
#if GN_SHADOWS
    if (out->face == GN_FACE_NONE || out->shadow != GN_SHADOW_UNDECIDED) return;
    for (int i = 0; i < 3; i++) {
        steps->at[i] += steps->step[i + 1];
        steps->step[i + 1] += steps->bend[i + 1];
    }
    out->u_q16 = steps->at[0] >> 4;
    out->v_q16 = steps->at[1] >> 4;
    out->depth_q32 = stepped_depth(steps);
#endif
}

GN_HOT void gn_arrivals_next(gn_chord *chord, const gn_frame *frame, const gn_surface *surface, gn_sample *sample)
{
    for (uint32_t i = surface->n_lights - surface->n_punctual; i < surface->n_lights; i++) {
        if (chord->arrival[i].holds) step(&chord->arrival[i], &sample->arrival[i]);
        else
            arrive(frame, surface, surface->light[i].state, sample->value[GN_VALUE_Z],
                   &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i], &sample->arrival[i]);
    }
}
#endif

#endif
