/* Cascades: slices of the frustum, their spheres, and how shadows end with distance. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"

/* k^2 = (W^2 + H^2) / (H focal)^2, Q24, clamped to 2^14 (half-diagonal of 89.5 degrees). */
GN_COLD int64_t gn_cascade_tan2_q24(const gn_frame *frame)
{
    const uint64_t limit = (uint64_t)1 << 38;
    uint32_t w = frame->picture.width, h = frame->picture.height, focal = frame->scene->camera.focal_q24;
    if (GN_FLAT_Q16(frame)) focal = 1U << 24;
    uint64_t k2 = gn_udiv64(((uint64_t)(w * w + h * h) << 24) + h * h / 2, h * h); /* 2^23 * 2^24 */
    for (int i = 0; i < 2; i++) {
        if (k2 > limit) k2 = limit;
        k2 = gn_udiv64((k2 << 24) + focal / 2, focal); /* 2^62 */
    }
    return (int64_t)(k2 < limit ? k2 : limit);
}

#if GN_ORTHOGRAPHIC
/* The sphere of an orthographic camera's slice, which is a box: around its centre, with its corners at the radius where
 * cascades begin to fade. [R10] */
static void flat_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, int64_t q2, int64_t *centre_q24,
                        int64_t *radius_q24)
{
    const int64_t one = (int64_t)1 << 24;
    int64_t n = (int64_t)gn_udiv64((uint64_t)(uint32_t)near_q16 << 24, (uint32_t)far_q16), half = (one - n) / 2;
    uint64_t u_q20 = gn_udiv64((uint64_t)(uint32_t)frame->cam.flat_q16 << 20, (uint32_t)far_q16); /* 2^49 */
    if (u_q20 >> 30) u_q20 = 1U << 30;                                                            /* 2^10 */
    int64_t u2_q24 = (int64_t)(u_q20 * u_q20 >> 16);
    int64_t across2 = gn_bf_apply(u2_q24, gn_bf_from_u64((uint64_t)gn_cascade_tan2_q24(frame)), -24);
    int64_t corner2 = gn_shr64(half * half, 24) + gn_clamp64(across2, 0, (int64_t)1 << 38);
    int64_t r2 = (int64_t)gn_udiv64((uint64_t)corner2 << 24, (uint64_t)q2); /* 2^62 */
    *centre_q24 = (one + n) / 2;
    *radius_q24 = r2 < (int64_t)1 << 38 ? gn_isqrt64((uint64_t)r2 << 24) : (int64_t)gn_isqrt64((uint64_t)r2) << 12;
}
#endif

/* One sphere per cascade: MODEL 4 derives it. [D3] */
GN_COLD void gn_cascade_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, int64_t *centre_q24,
                               int64_t *radius_q24)
{
    const int64_t one = (int64_t)1 << 24;
    int64_t k2 = gn_cascade_tan2_q24(frame);
    int64_t q = 65536 - (int64_t)frame->scene->shadow.cascade_fade_uq16;
    if (q < 8192) q = 8192; /* 1/8: see MODEL 4 */
    int64_t q2 = (q * q) >> 8;
#if GN_ORTHOGRAPHIC
    if (frame->cam.flat_q16) {
        flat_sphere(frame, near_q16, far_q16, q2, centre_q24, radius_q24);
        return;
    }
#endif
    int64_t n = (int64_t)gn_udiv64((uint64_t)(uint32_t)near_q16 << 24, (uint32_t)far_q16); /* < 1 */
    int64_t n2 = gn_shr64(n * n, 24);
    int64_t a = one - q2, b = n - q2;
    int64_t big_c = gn_shr64((one + k2) * (q2 - n2), 24); /* 2^38 * 2^24 */
    int64_t under = b * b + a * big_c;                    /* 2^48 + 2^24 * 2^38 */
    int64_t c = one;
    if (under >= 0 && big_c > 0) {
        int64_t s = gn_isqrt64((uint64_t)under);
        if (s > b) c = gn_clamp64((int64_t)gn_udiv64((uint64_t)big_c << 24, (uint64_t)(s - b)), 0, one);
    }
    int64_t far2 = gn_shr64((one - c) * (one - c), 24) + k2;
    int64_t near2 = (int64_t)gn_udiv64((uint64_t)((c - n) * (c - n) + k2 * n2), (uint64_t)q2); /* 2^48 + 2^62 */
    int64_t r2 = far2 > near2 ? far2 : near2; /* <= (1 + 2^14) * 64 in Q24: 2^44 at the extreme, 2^38 else */
    *centre_q24 = c;
    *radius_q24 = r2 < (int64_t)1 << 38 ? gn_isqrt64((uint64_t)r2 << 24) : (int64_t)gn_isqrt64((uint64_t)r2) << 12;
}

/* Near and far view depth of cascade i. [D3] */
GN_COLD void gn_cascade_slice(const gn_frame *frame, uint32_t i, int32_t *near_q16, int32_t *far_q16)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    int32_t m = shadow->max_distance_q16;
    *near_q16 = frame->scene->camera.near_q16;
    if (i > 0)
        *near_q16 = gn_max32(*near_q16, (int32_t)(((int64_t)m * shadow->cascade_ratio_uq16[i - 1] + 0x8000) >> 16));
    *far_q16 = m;
    if (GN_MANY_CASCADES && i + 1 < GN_N_CASCADES(frame))
        *far_q16 = (int32_t)(((int64_t)m * shadow->cascade_ratio_uq16[i] + 0x8000) >> 16);
}

/* Spheres of all slices; radius_q24 is relative to the slice's end, which slice_of computes again. [D3] [D4] [D6] */
static void setup_spheres(gn_frame *frame)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    uint64_t keep_q32 = (uint64_t)(65536 - shadow->cascade_fade_uq16) * (65536 - shadow->cascade_fade_uq16);
    int beyond = 0; /* there is an unused cascade behind the last */
    frame->last_cascade = 0;
    for (uint32_t i = 0; i < GN_N_CASCADES(frame); i++) {
        gn_cascade_state *cascade = &frame->cascade[i];
        int32_t near_q16, far_q16;
        int64_t centre_q24, radius_q24;
        gn_cascade_slice(frame, i, &near_q16, &far_q16);
        cascade->radius2_q32 = 0;
        if (far_q16 <= near_q16) continue;
        beyond = GN_CASCADE_UNUSED(frame, i);
        if (beyond) continue;
        gn_cascade_sphere(frame, near_q16, far_q16, &centre_q24, &radius_q24);
        cascade->centre_q16 = (int32_t)gn_shr64(centre_q24 * far_q16, 24);
        /* radius < 2^30 in Q16: a sphere that wide contains all view coordinates */
        uint64_t radius_q16 = (uint64_t)gn_clamp64(
            gn_bf_apply(radius_q24, gn_bf_from_u64((uint64_t)(uint32_t)far_q16), -24), 1, (1 << 30) - 1);
        cascade->radius2_q32 = radius_q16 * radius_q16;
        /* r^2 (1 - (1 - fade)^2) */
        gn_bfloat width =
            gn_bf_mul(gn_bf_from_u64(cascade->radius2_q32), gn_bf_from_u64(((uint64_t)1 << 32) - keep_q32));
        cascade->fade_scale = gn_bf_recip(width);
        cascade->inner2_q32 =
            (cascade->radius2_q32 >> 32) * keep_q32 + (((cascade->radius2_q32 & UINT32_MAX) * keep_q32) >> 32);
        frame->cascade[GN_LAST_CASCADE(frame)].next = (int32_t)i;
        frame->last_cascade = (uint8_t)i;
    }
    gn_cascade_state *last = &frame->cascade[GN_LAST_CASCADE(frame)];
    if (beyond && last->radius2_q32) last->inner2_q32 = last->radius2_q32 - 1; /* shadows do not end there */
}

/* Strength 1 up to max distance * (1 - fade), then linear to 0 at max distance. [D5] */
static void setup_distance_fade(gn_frame *frame)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    uint64_t width_q32 = (uint64_t)(uint32_t)shadow->max_distance_q16 * shadow->distance_fade_uq16;
    frame->fade_start_q16 = (uint32_t)shadow->max_distance_q16 - (uint32_t)(width_q32 >> 16);
    frame->fade_scale = gn_bf_recip(gn_bf_from_u64(width_q32));
}

GN_COLD void gn_cascade_setup(gn_frame *frame)
{
    uint32_t n = frame->scene->shadow.n_cascades;
    frame->n_cascades = (uint8_t)(GN_MANY_CASCADES && n ? n : 1);
    int64_t w = frame->picture.width, h = frame->picture.height;
    frame->tan2_q24 = gn_cascade_tan2_q24(frame);
    frame->tan2_per_px2_q44 = (int64_t)gn_udiv64((uint64_t)frame->tan2_q24 << 20, (uint64_t)(w * w + h * h));
    setup_distance_fade(frame);
    setup_spheres(frame);
}

GN_COLD int32_t gn_cascade_fit_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, gn_bfloat *radius)
{
    int64_t centre_q24, radius_q24;
    gn_cascade_sphere(frame, near_q16, far_q16, &centre_q24, &radius_q24);
    if (!radius_q24) radius_q24 = 1; /* a slice, or a parallel view, that is next to nothing beside its distance */
    *radius = gn_bf_mul(gn_bf_from_u64((uint64_t)radius_q24), gn_bf_from_u64((uint64_t)(uint32_t)far_q16));
    radius->exp -= 24 + 16;
    return (int32_t)gn_shr64(centre_q24 * far_q16, 24);
}
