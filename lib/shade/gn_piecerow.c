/* Rows of patches. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_piece.h"
#include "shade/gn_turn.h"
#include "shadow/gn_filter.h"

#if GN_PIECES

#if GN_SHADOWS
enum { CELL_UNKNOWN, CELL_LIT, CELL_DARK, CELL_MIXED };
#endif

/* v + s g + s^2 q in the middle of a row, with g its first and q its second order and s = 1 / (1 + t), and its slope
 * there. */
GN_HOT static GN_NOINLINE void steep_ramp(const gn_pieces *p, const gn_curve *colour, int32_t right, int32_t down,
                                          int32_t n, gn_ramp *ramp)
{
    int32_t scale_q30 = gn_per_w((p->w_dx_q30 * right + p->w_dy_q30 * down) >> 1); /* right, down: in half pixels */
    for (int c = 0; c < 3; c++, colour++) {
        const gn_slope *v = &colour->slope_q24;
        int32_t across = right * colour->dxx_q28 >> 5, slope = across + (down * colour->dxy_q28 >> 5),
                g = (right * v->dx + down * v->dy) >> 1;
        int32_t q = 4 * gn_mul_high((right * slope + down * (down * colour->dyy_q28 >> 5)) >> 1, scale_q30);
        int32_t bent = slope + across - 4 * gn_mul_high(g + 2 * q, p->w_dx_q30);
        int32_t step = 4 * gn_mul_high(v->dx + 4 * gn_mul_high(bent, scale_q30), scale_q30);
        ramp->step_q24[c] = step;
        ramp->from_q24[c] = v->at + 4 * gn_mul_high(g + q, scale_q30) - ((step * (n - 1)) >> 1);
    }
}

/* From the first to the last of n pixels. */
GN_INLINE void curve_ramp(const gn_curve *colour, int32_t right, int32_t down, int32_t both, int c, gn_ramp *ramp)
{
    const gn_slope *s = &colour[c].slope_q24;
    int32_t slope = s->dx + (down * colour[c].dxy_q28 >> 4), bent = colour[c].dxx_q28;
    int32_t left = s->at + down * (s->dy + (down * colour[c].dyy_q28 >> 4));
    ramp->from_q24[c] = left + right * (slope + (right * bent >> 4));
    ramp->step_q24[c] = slope + (both * bent >> 4);
}

/* A row of n pixels from (x, y) on. */
GN_INLINE void ramp_of(const gn_pieces *p, const gn_curve *colour, int32_t x, int32_t y, int32_t n, gn_ramp *ramp)
{
    int32_t right = x - p->x, down = y - p->y, both = 2 * right + n - 1;
    if (p->steep) {
        steep_ramp(p, colour, both, 2 * down, n, ramp);
        return;
    }
    curve_ramp(colour, right, down, both, 0, ramp);
    curve_ramp(colour, right, down, both, 1, ramp);
    curve_ramp(colour, right, down, both, 2, ramp);
}

/* A row of pixels that are all lit or all in shadow. */
GN_HOT static void plain_row(const gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t n, int lit)
{
    if (!p->varies) {
        gn_pixel_fill(p->frame, rows, x, y, n, lit ? p->lit_pixel : p->dark_pixel);
        return;
    }
#if GN_TURNING
    if (p->turns) {
        gn_turn_row(p, rows, y, x, n, NULL, lit);
        return;
    }
#endif
    for (int32_t end = x + n; x < end; x += n) {
        gn_ramp ramp;
        n = gn_min32(end - x, p->ramp_px);
        ramp_of(p, lit ? p->lit : p->dark, x, y, n, &ramp);
        gn_pixel_ramp(p->frame, rows, x, y, n, &ramp);
    }
}

#if GN_SHADOWS
GN_HOT static void colours_of(const gn_pieces *p, const gn_curve *colour, int32_t x, int32_t y, int32_t n,
                              gn_ramp *ramp)
{
    if (p->varies) {
        ramp_of(p, colour, x, y, n, ramp);
        return;
    }
    for (int c = 0; c < 3; c++) {
        ramp->from_q24[c] = colour[c].slope_q24.at;
        ramp->step_q24[c] = 0;
    }
}

/* Light-space coordinates at a pixel: v + g / (1 + t), g the change by the slope, t that of w, is v + g - g t with an
 * error of g t^2. */
GN_INLINE int32_t place_at(const gn_slope *place, int32_t dx, int32_t dy, int32_t t_q30)
{
    int32_t g = place->dx * dx + place->dy * dy;
    return place->at + g - gn_mul_high(g, t_q30) * 4;
}

GN_HOT static void receiver_at(const gn_pieces *p, int32_t x, int32_t y, gn_receiver_step *out)
{
    int32_t dx = x - p->x, dy = y - p->y, t_q30 = p->w_dx_q30 * dx + p->w_dy_q30 * dy;
    out->u_q16 = place_at(&p->place[0], dx, dy, t_q30);
    out->v_q16 = place_at(&p->place[1], dx, dy, t_q30);
    out->depth_q31 =
        gn_max32(p->depth_least, gn_min32(place_at(&p->place[2], dx, dy, t_q30), p->depth_most)) * (1 << p->depth_up);
}

/* (b - a) / n of two clamped values */
GN_HOT static GN_NOINLINE int32_t limited_step(const gn_pieces *p, gn_receiver_step *from, gn_receiver_step *to,
                                               int32_t n)
{
    from->depth_q31 = gn_max32(p->depth_least, gn_min32(from->depth_q31, p->depth_most));
    to->depth_q31 = gn_max32(p->depth_least, gn_min32(to->depth_q31, p->depth_most));
    return gn_step_of(from->depth_q31 * (1 << p->depth_up), to->depth_q31 * (1 << p->depth_up), n);
}

/* Step per pixel from a pixel with g and t to the one `n` pixels on: the chord of v + g - g t, whose slope is that of
 * the middle. */
GN_INLINE int32_t place_step(const gn_pieces *p, const gn_slope *place, int32_t both, int32_t down, int32_t t2_q30)
{
    int32_t g2 = place->dx * both + place->dy * 2 * down;
    return place->dx - (int32_t)(((int64_t)g2 * p->w_dx_q30 + (int64_t)place->dx * t2_q30) >> 31);
}

/* The first and the last of n > 1 receivers, and the step from each to the next. */
GN_HOT static GN_SHARED void receivers(const gn_pieces *p, int32_t x, int32_t y, int32_t n, gn_receiver_step *from,
                                       gn_receiver_step *to, gn_receiver_step *step)
{
    int32_t right = x - p->x, down = y - p->y, both = 2 * right + n,
            t2_q30 = p->w_dx_q30 * both + p->w_dy_q30 * 2 * down;
    int32_t t_q30 = p->w_dx_q30 * right + p->w_dy_q30 * down;
    from->u_q16 = place_at(&p->place[0], right, down, t_q30);
    from->v_q16 = place_at(&p->place[1], right, down, t_q30);
    from->depth_q31 = place_at(&p->place[2], right, down, t_q30);
    step->u_q16 = place_step(p, &p->place[0], both, down, t2_q30);
    step->v_q16 = place_step(p, &p->place[1], both, down, t2_q30);
    step->depth_q31 = place_step(p, &p->place[2], both, down, t2_q30);
    to->u_q16 = from->u_q16 + n * step->u_q16;
    to->v_q16 = from->v_q16 + n * step->v_q16;
    to->depth_q31 = from->depth_q31 + n * step->depth_q31;
    if (gn_min32(from->depth_q31, to->depth_q31) < p->depth_least ||
        gn_max32(from->depth_q31, to->depth_q31) > p->depth_most)
        step->depth_q31 = limited_step(p, from, to, n);
    else step->depth_q31 *= 1 << p->depth_up;
    from->depth_q31 *= 1 << p->depth_up;
    to->depth_q31 *= 1 << p->depth_up;
}

/* n pixels, each interpolated between the dark and the lit ramp by its attenuation. */
GN_HOT static GN_SHARED void partly_lit_row(const gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x,
                                            int32_t n, const uint32_t *attenuation)
{
    gn_ramp dark, lit;
    colours_of(p, p->dark, x, y, n, &dark);
    colours_of(p, p->lit, x, y, n, &lit);
    gn_pixel_mix(p->frame, rows, x, y, n, &dark, &lit, attenuation);
}

enum { ROW_DRAWN, ROW_DARK, ROW_LIT };

/* n <= 17 pixels from x on, looked up one by one. If all are alike, as in most short rows, the caller draws them as one
 * kind. */
GN_HOT static GN_SHARED int looked_up_row(const gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x,
                                          int32_t n)
{
    uint32_t attenuation[17];
    gn_receiver_step from, to, step;
    receivers(p, x, y, n - 1, &from, &to, &step);
    gn_filter_row(p->frame, p->view, &from, &to, &step, n, attenuation);
    int32_t alike = 1;
    while (alike < n && attenuation[alike] == attenuation[0]) alike++;
    if (alike == n && attenuation[0] - 1 >= 65535) return attenuation[0] ? ROW_LIT : ROW_DARK;
#if GN_TURNING
    if (p->turns) {
        gn_turn_row(p, rows, y, x, n, attenuation, 0);
        return ROW_DRAWN;
    }
#endif
    partly_lit_row(p, rows, y, x, n, attenuation);
    return ROW_DRAWN;
}

enum { CELLS_ACROSS = GN_PIECE_WIDTH / GN_CELL };

/* The verdict of depth bounds on a cell of the patch. */
GN_HOT static GN_NOINLINE uint32_t judge_cell(gn_pieces *p, uint32_t cell)
{
    int32_t x = p->x0 + (int32_t)(cell % CELLS_ACROSS * GN_CELL), y = p->y0 + (int32_t)(cell / CELLS_ACROSS * GN_CELL);
    gn_receiver_step middle_of, a, b;
    receiver_at(p, x + GN_CELL / 2, y + GN_CELL / 2, &middle_of);
    a.u_q16 = middle_of.u_q16 - p->cell_reach[0];
    b.u_q16 = middle_of.u_q16 + p->cell_reach[0];
    a.v_q16 = middle_of.v_q16 - p->cell_reach[1];
    b.v_q16 = middle_of.v_q16 + p->cell_reach[1];
    int32_t reach = gn_min32(p->cell_reach[2], INT32_MAX >> p->depth_up) * (1 << p->depth_up);
    a.depth_q31 = gn_max32(middle_of.depth_q31, -(1 << 30)) - gn_min32(reach, 1 << 30);
    b.depth_q31 = middle_of.depth_q31 > 0x7FFF8000 - reach ? 0x7FFF8000 : middle_of.depth_q31 + reach;
    uint32_t attenuation, state = CELL_MIXED;
    if (gn_filter_decides(p->frame, p->view, &a, &b, &attenuation)) state = attenuation ? CELL_LIT : CELL_DARK;
    p->cells |= state << 2 * cell;
    return state;
}

GN_INLINE uint32_t state_of(gn_pieces *p, uint32_t cell)
{
    uint32_t state = p->cells >> 2 * cell & 3U;
    return state != CELL_UNKNOWN ? state : judge_cell(p, cell);
}

/* Draws a group of cells of one kind at a time. */
GN_HOT static void shadowed_row(gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t x_end)
{
    uint32_t across = (uint32_t)(x - p->x0) / GN_CELL, cell = across + (uint32_t)(y - p->y0) / GN_CELL * CELLS_ACROSS;
    int32_t end = p->x0 + (int32_t)across * GN_CELL;
    uint32_t next = state_of(p, cell);
    while (x < x_end) {
        uint32_t state = next;
        do {
            end += GN_CELL;
            cell++;
            if (end >= x_end) {
                end = x_end;
                break;
            }
            next = state_of(p, cell);
        } while (next == state);
        if (state != CELL_MIXED) {
            plain_row(p, rows, y, x, end - x, state == CELL_LIT);
            x = end;
        }
        for (int32_t n; x < end; x += n) {
            n = gn_min32(end - x, p->chunk_px);
            int alike = looked_up_row(p, rows, y, x, n);
            if (alike != ROW_DRAWN) plain_row(p, rows, y, x, n, alike == ROW_LIT);
        }
    }
}
#endif

GN_HOT void gn_pieces_row(gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x_begin, int32_t x_end)
{
#if GN_SHADOWS
    if (p->looks_up) {
        shadowed_row(p, rows, y, x_begin, x_end);
        return;
    }
#endif
    plain_row(p, rows, y, x_begin, x_end - x_begin, 0);
}

#endif
