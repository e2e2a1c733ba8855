/* Values between two exact samples of a run.
 *
 * A value that is linear on the surface goes from v0 to v1, where depth goes from z0 to z1, as v0 + (v1 - v0)(1 + s)/2
 * with s = (u + a)/(1 + a u), u = -1..1 along the pixels, a = (z1 - z0)/(z1 + z0). The parabola s = u + a (1 - u^2)
 * meets both ends and the middle; it errs by a^2 u (1 - u^2)/(1 + a u), which is at most 0.385 a^2/(1 - |a|): of v1 -
 * v0, a^2/4 up to |a| = 3/16. The line s = u errs by a/2 of v1 - v0: where that will do, nothing is added to the steps.
 */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_chord.h"

#define GN_BEND_MAX_Q16 12288 /* 3/16 */
#define GN_SHARE_LOG2   10    /* values of range 1, colours and normals, may be off by 2^-10 */
#define GN_SHADOW_LOG2  8     /* tile coordinates of a directional light: 2^-8 texel */
#define GN_PERSP_LOG2   7     /* of spot and point lights: 2^-7 texel */
#define GN_TEXTURE_LOG2 7     /* texture coordinates: 2^-7 texel */
#define GN_IRRADIANCE_LOG2                                                                                             \
    11 /* a point as seen from a spot or point light: 2^-11 of its distance, 0.15 % of what arrives */
#define GN_TURN_MAX_LOG2   4  /* normals: angle^2 up to 1/16 */
#define GN_TURN_LEAST_LOG2 11 /* below, cosines leave a line by 2^-14 */

/* ---- Normals ----------------------------------------------------------------------------------------------------- */

/* From normal n0 to n1: |n1|^2 / |n0|^2 - 1, and the square of the angle; Q16. */
typedef struct {
    int32_t longer_q16, angle2_q16;
} turning;

/* v / of rounded down, Q16; v < of */
GN_HOT static int32_t quotient_q16(uint32_t v, uint32_t of)
{
    int32_t clz = gn_clz32(of);
    return (int32_t)((uint64_t)v * gn_recip_norm(of << clz, 1) >> (47 - clz));
}

/* 0: too far apart for what turn_cosines leaves, which is of third order. */
GN_HOT static int turn_between(turning *out, const int32_t a_q15[3], const int32_t b_q15[3])
{
    uint32_t aa = 0, bb = 0, apart = 0; /* components within 2^15: halved differences within 2^15, sums below 2^32 */
    for (int i = 0; i < 3; i++) {
        int32_t d = (b_q15[i] - a_q15[i]) >> 1;
        aa += (uint32_t)(a_q15[i] * a_q15[i]) >> 2;
        bb += (uint32_t)(b_q15[i] * b_q15[i]) >> 2;
        apart += (uint32_t)(d * d);
    }
    if (apart > aa >> GN_TURN_MAX_LOG2) return 0;
    if (apart <= aa >> GN_TURN_LEAST_LOG2) return 1;
    int32_t longer = quotient_q16(bb < aa ? aa - bb : bb - aa, aa); /* |n1| <= 1.25 |n0|: below 0.57 */
    out->longer_q16 = bb < aa ? -longer : longer;
    out->angle2_q16 = gn_max32(0, quotient_q16(apart, aa) - (longer * longer >> 18));
    return 1;
}

/* ---- Whether parabolas hold -------------------------------------------------------------------------------------- */

/* The share of its change by which a value leaves its line or parabola: num / den, num < 2^31, den < 2^35. */
typedef struct {
    uint32_t num;
    uint64_t den;
} stray_ratio;

/* Whether a value that changes by d stays within `most` < 2^25 of it. */
GN_HOT static int holds(int64_t d, stray_ratio error, uint64_t most)
{
    return gn_abs64(d) * error.num <= most * error.den; /* 2^32 * 2^31, 2^25 * 2^35 */
}

#if GN_PUNCTUAL_LIGHTS
/* The distance, here in the largest component, is at least z / sqrt(3). */
GN_HOT static int punctual_holds(const gn_frame *frame, const gn_light_state *light, int shadowed, const int32_t *a,
                                 const int32_t *b, stray_ratio error)
{
    uint64_t distance = 0, moved = 0; /* in the largest component */
    for (int i = GN_LIGHT_POINT_AT; i < GN_LIGHT_POINT_AT + 3; i++) {
        uint64_t d = gn_abs64((int64_t)b[i] - a[i]);
        if (gn_abs32(a[i]) > distance) distance = gn_abs32(a[i]);
        if (d > moved) moved = d;
    }
    if (moved * 4 > distance) return 0; /* the light is no farther than a few pixels */
    if (!holds((int64_t)moved, error, distance >> GN_IRRADIANCE_LOG2)) return 0;
    if (!shadowed || light->view_idx < 0 || error.num == 0) return 1;
#if GN_SHADOWS
    int64_t texel_q16 = gn_bf_apply((int64_t)distance, frame->view[light->view_idx].fit.persp.texel_per_z, 0);
    return holds((int64_t)moved, error, (uint64_t)gn_clamp64(texel_q16, 0, INT32_MAX) >> GN_PERSP_LOG2);
#else
    (void)frame;
    return 1;
#endif
}
#endif

GN_HOT static int directional_holds(const int32_t *a, const int32_t *b, stray_ratio error)
{
    for (uint32_t i = 1; i < GN_VALUES_PER_LIGHT; i++)
        if (!holds((int64_t)b[i] - a[i], error, 65536U >> GN_SHADOW_LOG2)) return 0;
    return 1;
}

#if GN_SHADOWS && GN_RECEIVER_BIAS
/* B3's terms along the light, its tangent and sine are no lines: of 1/8 in the normal, of 1/32 in the light's direction
 * they bend by 2^-6 of themselves up to 80 degrees. */
GN_HOT static int terms_hold(const gn_frame *frame, const gn_surface *surface, uint32_t slot, const int32_t *a,
                             const int32_t *b, const turning *turned)
{
    const int32_t *terms = frame->scene->lights[surface->light[slot].idx].bias_receiver_q16;
    if (!surface->shadowed || !(terms[0] | terms[1] | terms[3])) return 1;
    if (turned->angle2_q16 > 65536 / 64) return 0;
    if (surface->light[slot].state->kind == GN_LIGHT_DIRECTIONAL) return 1;
    uint64_t distance = 0, moved = 0; /* along the axes */
    for (int i = GN_LIGHT_POINT_AT; i < GN_LIGHT_POINT_AT + 3; i++) {
        distance += gn_abs32(a[i]);
        moved += gn_abs64((int64_t)b[i] - a[i]);
    }
    return moved * 32 <= distance;
}
#endif

GN_HOT static int lights_hold(const gn_frame *frame, const gn_surface *surface, const gn_sample *a, const gn_sample *b,
                              stray_ratio error, const turning *turned)
{
    for (uint32_t i = 0; i < surface->n_lights; i++) {
        uint32_t at = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i;
#if GN_SHADOWS && GN_RECEIVER_BIAS
        if (!terms_hold(frame, surface, i, a->value + at, b->value + at, turned)) return 0;
#endif
#if GN_PUNCTUAL_LIGHTS
        const gn_light_state *light = surface->light[i].state;
        if (light->kind != GN_LIGHT_DIRECTIONAL) {
            if (!punctual_holds(frame, light, surface->shadowed, a->value + at, b->value + at, error)) return 0;
            continue;
        }
#endif
        if (surface->shadowed && !directional_holds(a->value + at, b->value + at, error)) return 0;
    }
    (void)frame, (void)turned;
    return 1;
}

#if GN_TEXTURES
GN_HOT static int texture_holds(const gn_surface *surface, const gn_sample *a, const gn_sample *b, stray_ratio error)
{
    const gn_texture *texture = surface->object->texture;
    const uint8_t log2[2] = {texture->width_log2, texture->height_log2};
    for (int i = 0; i < 2; i++) {
        int64_t d = (int64_t)b->value[GN_VALUE_UV + i] - a->value[GN_VALUE_UV + i];
        if (!holds(d, error, (1U << (20 - GN_TEXTURE_LOG2)) >> log2[i])) return 0;
    }
    return 1;
}
#endif

GN_HOT static int all_hold(const gn_frame *frame, const gn_surface *surface, const gn_sample *a, const gn_sample *b,
                           stray_ratio error, const turning *turned)
{
    int ranged = GN_SMOOTH(surface) | GN_COLOURED(surface) | surface->masked | surface->baked;
    if (ranged && error.num > error.den >> GN_SHARE_LOG2) return 0;
#if GN_TEXTURES
    if (surface->textured && !texture_holds(surface, a, b, error)) return 0;
#endif
    return lights_hold(frame, surface, a, b, error, turned);
}

/* ---- Steps ------------------------------------------------------------------------------------------------------- */

/* d / n rounded towards zero, n = 2^log2 unless log2 is negative; |d / n| < 2^31 */
GN_HOT static int32_t step_of(int64_t d, int32_t n, int32_t log2)
{
    return log2 >= 0 ? (int32_t)((d + ((d >> 63) & (n - 1))) >> log2) : gn_sat32(d) / n;
}

GN_HOT static int32_t log2_of(int32_t n)
{
    return (n & (n - 1)) == 0 ? 31 - gn_clz32((uint32_t)n) : -1;
}

/* The step to the first pixel, so that n of them, each by `bend` longer than the one before, add up to d. */
GN_HOT static int32_t first_step(int64_t d, int32_t bend, int32_t n, int32_t log2)
{
    return step_of(d - bend * (int64_t)(n * (n - 1) / 2), n, log2);
}

/* With t = k/n along the pixels, v0 + (v1 - v0)(t - 2a t (1 - t)). */
GN_HOT static void set_steps(gn_chord *chord, const gn_surface *surface, const gn_sample *a, const gn_sample *b,
                             int32_t n, int32_t bend)
{
    int32_t log2 = log2_of(n), per_px_q30 = 4 * bend / (n * n);
    chord->end = surface->n_values;
    chord->bend_first = surface->first_value;
    chord->bend_end = per_px_q30 ? surface->n_values : chord->bend_first;
    for (int32_t i = surface->first_value; i < (int32_t)surface->n_values; i++) {
        int64_t d = gn_sat32((int64_t)b->value[i] - a->value[i]);
        if (per_px_q30)
            chord->bend[i] = (int32_t)gn_shr64(d * per_px_q30, 30); /* at most 3/4 d / n^2: no value passes v1 */
        chord->step[i] = per_px_q30 ? first_step(d, chord->bend[i], n, log2) : step_of(d, n, log2);
    }
}

/* Cosines n . l of unit normals, and n . p of spot and point lights, p linear, leave the parabola by
 *
 *     (longer/2 (v1 - v0) + angle^2/2 v - (n1 - n0) . (p1 - p0)) t (1 - t)
 *
 * for n = n0 + t (n1 - n0) is shorter by angle^2/2 t (1 - t) than between its ends, and not as long at one as at the
 * other. */
GN_HOT static void turn_cosines(gn_chord *chord, const gn_frame *frame, const gn_surface *surface, const gn_sample *a,
                                const gn_sample *b, int32_t n, const turning *t)
{
    int32_t log2 = log2_of(n);
    if (chord->bend_end == chord->bend_first) { /* the cosines alone bend */
        chord->bend_first = GN_VALUE_LIGHT;
        chord->bend_end = surface->n_values - (GN_VALUES_PER_LIGHT - 1);
        for (int32_t i = GN_VALUE_LIGHT; i < chord->bend_end; i++) chord->bend[i] = 0;
    }
    for (uint32_t i = 0; i < surface->n_lights; i++) {
        uint32_t at = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i;
        int64_t v0 = a->value[at], v1 = b->value[at], d = v1 - v0;
        if (GN_K(frame, vertex_light) && surface->light[i].state->kind == GN_LIGHT_DIRECTIONAL)
            continue;                                      /* no cosine of this normal */
        if ((gn_abs64(v0) | gn_abs64(v1)) >> 30) continue; /* lights so far away are dark, and this must not overflow */
        int64_t more = gn_shr64(t->longer_q16 * d + t->angle2_q16 * ((v0 + v1) >> 1), 16);
#if GN_PUNCTUAL_LIGHTS
        const int32_t *p0 = a->value + at + GN_LIGHT_POINT_AT, *p1 = b->value + at + GN_LIGHT_POINT_AT;
        if (surface->light[i].state->kind != GN_LIGHT_DIRECTIONAL)
            for (int k = 0; k < 3; k++)
                more += gn_shr64((b->normal_q15[k] - a->normal_q15[k]) * ((int64_t)p1[k] - p0[k]), 14);
#endif
        chord->bend[at] -= step_of(more, n * n, log2 < 0 ? log2 : 2 * log2);
        chord->step[at] = first_step(d, chord->bend[at], n, log2);
    }
}

GN_HOT int gn_chord_between(gn_chord *chord, const gn_frame *frame, const gn_surface *surface, const gn_sample *a,
                            const gn_sample *b, int32_t n)
{
    uint32_t za = (uint32_t)a->value[GN_VALUE_Z], zb = (uint32_t)b->value[GN_VALUE_Z], dz = za < zb ? zb - za : za - zb;
    int32_t bend_q30 = 0;
    turning turned = {0, 0};
    if (a->cascade != b->cascade || a->in_reach != b->in_reach) return 0;
    if (GN_SMOOTH(surface) && surface->n_lights && !turn_between(&turned, a->normal_q15, b->normal_q15)) return 0;
    const stray_ratio of_line = {dz, 2 * ((uint64_t)za + zb)}; /* |a| / 2 */
    if (!all_hold(frame, surface, a, b, of_line, &turned)) {
        bend_q30 = (int32_t)gn_quotient_q30(dz, za + zb);
        uint32_t bend_q16 = (uint32_t)(bend_q30 >> 14) + 1;
        const stray_ratio of_parabola = {bend_q16 * bend_q16, (uint64_t)1 << 34}; /* a^2 / 4 */
        if (bend_q16 > GN_BEND_MAX_Q16 || !all_hold(frame, surface, a, b, of_parabola, &turned)) return 0;
    }
    set_steps(chord, surface, a, b, n, za < zb ? bend_q30 : -bend_q30);
    if (turned.angle2_q16 | turned.longer_q16) turn_cosines(chord, frame, surface, a, b, n, &turned);
    return 1;
}
