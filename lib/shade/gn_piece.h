/* A surface piece by piece: parts of the screen over which its colours are linear, closely enough. Within a piece a row
 * of pixels is stepped by additions, and only a shadow's edge is looked up pixel by pixel. Not every surface can be
 * shaded so; the rest, and everything where every pixel is to be exact, is sampled (gn_sample). */
#ifndef GN_PIECE_H
#define GN_PIECE_H

#include "shade/gn_pixel.h"
#include "visible/gn_setup.h"
#include "shade/gn_surface.h"

/* Pixels: the largest piece, and parts of it whose shadow is asked for once. */
enum { GN_PIECE_WIDTH_LOG2 = 6, GN_PIECE_WIDTH = 1 << GN_PIECE_WIDTH_LOG2, GN_PIECE_ROWS = 16, GN_CELL = 8 };

/* The upper half of a product. */
GN_HOT static inline int32_t gn_mul_high(int32_t a, int32_t b)
{
    return (int32_t)((int64_t)a * b >> 32);
}

GN_HOT static inline int32_t gn_mul_q24(int32_t a, int32_t b)
{
    return (int32_t)((int64_t)a * b >> 24);
}

GN_HOT static inline int32_t gn_along(const gn_slope *s, int32_t dx, int32_t dy)
{
    return s->at + s->dx * dx + s->dy * dy;
}

/* 1 / (1 + t), Q30, |t| <= 1/8: t^4 off, 2^-12. */
GN_HOT static inline int32_t gn_per_w(int32_t t_q30)
{
    int32_t t2_q30 = 4 * gn_mul_high(t_q30, t_q30);
    return (1 << 30) - t_q30 + t2_q30 - 4 * gn_mul_high(t2_q30, t_q30);
}

/* A colour at (x, y), and its change per pixel there: v + g / (1 + t), g the change by the slope and t that of w.
 * `right` and `down` are from the middle of the piece, in half pixels. */
GN_HOT static inline int32_t gn_colour_near(const gn_pieces *p, const gn_slope *colour, int32_t right, int32_t down,
                                            int32_t per_w_q30, int32_t *step)
{
    int32_t g = 4 * gn_mul_high((colour->dx * right + colour->dy * down) >> 1, per_w_q30);
    *step = 4 * gn_mul_high(colour->dx - 4 * gn_mul_high(g, p->w_dx_q30), per_w_q30);
    return colour->at + g;
}

/* (b - a) / n, rounded towards zero, n <= 16 */
int32_t gn_step_of(int32_t a, int32_t b, int32_t n);

/* Whether the surface may be shaded so. */
int gn_pieces_fit(const gn_frame *frame, const gn_surface *surface);

/* Makes it ready for pixels of `rect`. Returns 0 if it cannot be shaded so there. */
int gn_pieces_begin(gn_pieces *pieces, const gn_frame *frame, const gn_surface *surface, const gn_rect *rect);

/* Makes a part of it the piece, if it is close enough to linear there. */
int gn_pieces_select(gn_pieces *pieces, const gn_rect *rect);

/* Shades pixels x_begin <= x < x_end of one row, all in the piece and of the surface. */
void gn_pieces_row(gn_pieces *pieces, const gn_pixel_rows *rows, int32_t y, int32_t x_begin, int32_t x_end);

#endif
