/* Parts of gn_facet: a small triangle on the screen, on which values at the vertices are linear, or quadratic. */
#ifndef GN_FACET_SCREEN_H
#define GN_FACET_SCREEN_H

#include "gnomon.h"

#if GN_INTERPOLATES

enum { GN_FACET_PX = 64, GN_FACET_FLAT_PX = 32, GN_FACET_ROW_PX = 16 /* of a span, at a time */ };

/* Small is up to so many pixels each way: windows of flat surfaces are quicker sooner. */
GN_HOT static inline int32_t gn_facet_most_px(const gn_surface *s)
{
    return GN_SMOOTH(s) ? GN_FACET_PX : GN_FACET_FLAT_PX;
}

/* Found once, when something varies. Returns 0 if the triangle is large, deep, or narrower than half a pixel. */
int gn_facet_screen_use(gn_facet_screen *screen, const gn_frame *frame, const gn_surface *surface);

/* Through values at the vertices, |.| <= 2^30: all pixels of the triangle stay within 32 bits, or `steep` is set. */
void gn_facet_slope(gn_facet_screen *screen, gn_slope *out, const int32_t at[3]);

/* Through values at the vertices, and in the middles of the edges 01, 02, 12, where it is a quarter of `above` more
 * than the mean of the ends. */
void gn_facet_curve_find(gn_facet_screen *screen, gn_facet_curve *out, const int32_t at[3], const int32_t above[3]);

/* Parts of a sum may go beyond 32 bits, which cancels out. */
GN_HOT static inline int32_t gn_facet_at(const gn_slope *s, int32_t right, int32_t down)
{
    return (int32_t)((uint32_t)s->at + (uint32_t)s->dx * (uint32_t)right + (uint32_t)s->dy * (uint32_t)down);
}

/* Along a row of pixels: the value at the first, the step to the next, and by how much steps change. */
typedef struct {
    int32_t at, step, change;
} gn_facet_row;

GN_HOT static inline gn_facet_row gn_facet_row_of(const gn_facet_curve *c, int32_t right, int32_t down)
{
    const uint32_t x = (uint32_t)right, y = (uint32_t)down, xx = (uint32_t)c->xx,
                   to_right = (uint32_t)c->line.dx + xx * x + (uint32_t)c->xy * y,
                   to_down = (uint32_t)c->line.dy + (uint32_t)c->yy * y;
    const gn_facet_row row = {(int32_t)((uint32_t)c->line.at + to_right * x + to_down * y),
                              (int32_t)(to_right + xx * (x + 1)), 2 * c->xx};
    return row;
}

/* 1 / |n| of n pixels of a row, |n|^2 in 1/4 .. 1: as gn_rsqrt_norm() finds it in one step. */
void gn_facet_lengths(const gn_facet_curve *length2_q22, int32_t right, int32_t down, int32_t n, uint32_t *out_q30);

/* A colour's channel times that of a vertex colour. */
GN_HOT static inline int32_t gn_facet_tinted(int32_t v_q24, int32_t tint_q16)
{
    return (int32_t)((int64_t)v_q24 * tint_q16 >> 16);
}

/* The same of n pixels of a row, whose vertex colours are linear. */
void gn_facet_tint(int32_t (*node)[3], int32_t n, const gn_slope tint_q16[3], int32_t right, int32_t down);

#endif

#endif
