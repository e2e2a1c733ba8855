/* A surface's plane on the screen. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_corner.h"
#include "shade/gn_surface.h"

#if GN_INTERPOLATES

/* A linear form of view space at the plane's pixel. */
GN_HOT static inline int64_t form_at(const gn_frame *frame, const gn_screen_plane *p, const int32_t form[3])
{
    return gn_plane_at(form, 2 * p->x + 1 - frame->picture.width, frame->picture.height - 1 - 2 * p->y,
                       frame->cam.focal2_px_q16);
}

/* A linear form of view space, at least 2^29 long, on the screen, times 2^-shift; `at`: form_at(). Returns 0 if it,
 * or a part of its sum, leaves 32 bits where the plane is asked for, as it does everywhere with a small shift. */
GN_HOT static int form_on_screen(gn_slope *out, const gn_screen_plane *p, const int32_t form[3], int64_t at,
                                 int32_t shift)
{
    int32_t s = shift - 17;
    if (s < 1 || s > 45) return 0;
    at >>= s + 16;
    if (at != (int32_t)at) return 0;
    s = gn_min32(s, 31);
    out->at = ((int32_t)at + 1) >> 1;
    out->dx = ((form[0] >> (s - 1)) + 1) >> 1;
    out->dy = -(((form[1] >> (s - 1)) + 1) >> 1);
    const uint64_t most = gn_abs32(out->at) + (uint64_t)gn_abs32(out->dx) * (uint32_t)p->w_px +
                          (uint64_t)gn_abs32(out->dy) * (uint32_t)p->h_px;
    return gn_abs32(out->at) < 1U << 30 && !(most >> 31);
}

#if GN_ORTHOGRAPHIC
GN_HOT static void times_per_w(int32_t *v, uint32_t recip, int32_t clz)
{
    *v = (int32_t)((*v * (int64_t)recip) >> (35 - clz)); /* 2^30 * 2^32 */
}

/* Barycentrics of parallel rays, whose n . ray is the same everywhere: below 7, and sums of steps below 2^31, where
 * the plane is asked for. */
GN_HOT static int find_flat_plane(gn_screen_plane *p, const gn_frame *frame, const gn_surface *s)
{
    const int64_t w = gn_plane_at(s->screen.n, 0, 0, frame->cam.focal2_px_q16);
    if (w < (int64_t)1 << 45) return 0;
    const int32_t shift = 37 - gn_clz64((uint64_t)w);
    const uint32_t w_q27 = (uint32_t)(w >> shift);
    const int32_t clz = gn_clz32(w_q27);
    const uint32_t recip = gn_recip_norm(w_q27 << clz, 2);
    for (int k = 0; k < 2; k++) {
        gn_slope *b = &p->b[k];
        if (!form_on_screen(b, p, s->bary.form[k], form_at(frame, p, s->bary.form[k]), shift - s->bary.exp[k]))
            return 0;
        const uint32_t most = gn_abs32(b->at) + gn_abs32(b->dx) * (uint32_t)p->w_px + /* 2^30 and 2^30 */
                              gn_abs32(b->dy) * (uint32_t)p->h_px;
        if (most >= 7 * w_q27) return 0;
        times_per_w(&b->at, recip, clz);
        times_per_w(&b->dx, recip, clz);
        times_per_w(&b->dy, recip, clz);
    }
    return 1;
}

GN_HOT int32_t gn_corner_flat_depth(const gn_screen_plane *p, const gn_surface *s, int32_t x, int32_t y,
                                    int32_t b_q28[2])
{
    int64_t z = 0; /* 2^29 * 2^31, twice */
    for (int k = 0; k < 2; k++) {
        b_q28[k] = gn_slope_at(&p->b[k], x - p->x, y - p->y);
        if (gn_abs32(b_q28[k]) >> 29) return 0;
        z += (int64_t)b_q28[k] * s->depth_q16[k + 1];
    }
    z = s->depth_q16[0] + (z >> 28);
    return z > 0 && z >> 30 == 0 ? (int32_t)z : 0;
}
#endif

/* How far 64 bits of n . ray, below 2^62, are to be shifted for it to stay below 2^30 where the plane is asked for.
 * Steps: 2^31 times 2^11 pixels, both axes, times 2^17. */
GN_HOT static inline int32_t shift_of(const gn_screen_plane *p, const int32_t form[3], int64_t at)
{
    const uint64_t steps = (uint64_t)gn_abs32(form[0]) * (uint32_t)p->w_px +
                           (uint64_t)gn_abs32(form[1]) * (uint32_t)p->h_px,
                   most = gn_abs64(at) + (steps << 17);
    return 34 - gn_clz64(most | 1U);
}

/* At the finest scale at which n . ray is below 2^30 there, or, for barycentrics that are larger, one up to that at
 * which it is below 2^27 on the triangle. */
GN_HOT int gn_screen_plane_find(gn_screen_plane *p, const gn_frame *frame, const gn_surface *s, const gn_rect *rect)
{
    if (s->plane.det <= 0) return 0;
    p->x = (rect->x0 + rect->x1) >> 1;
    p->y = (rect->y0 + rect->y1) >> 1;
    p->w_px = ((rect->x1 - rect->x0) >> 1) + 2;
    p->h_px = ((rect->y1 - rect->y0) >> 1) + 2;
#if GN_ORTHOGRAPHIC
    if (GN_FLAT_Q16(frame)) return find_flat_plane(p, frame, s);
#endif
    const int32_t coarsest = s->depth_scale.exp + 32 - (31 - gn_clz32((uint32_t)s->z_min_q16)) - 27;
    const int64_t at = form_at(frame, p, s->plane.n);
    p->w_least = (p->w_px + p->h_px) << 16;
    for (int32_t shift = gn_min32(shift_of(p, s->plane.n, at), coarsest); shift <= coarsest; shift++) {
        p->z_shift = 31 + shift - s->depth_scale.exp;
        int fits = form_on_screen(&p->w, p, s->plane.n, at, shift);
        for (int k = 0; fits && GN_HAS_BARY(s) && k < 2; k++) {
            const int32_t *form = s->bary.form[k];
            fits = form_on_screen(&p->b[k], p, form, form_at(frame, p, form), shift - s->bary.exp[k]);
        }
        if (fits) return 1;
    }
    return 0;
}

#endif
