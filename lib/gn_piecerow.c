/* Rows of pieces. */
#include "gn_count.h"
#include "gn_filter.h"
#include "gn_piece.h"
#include "gn_q.h"
#include "gn_turn.h"

#if GN_PIECES

#if GN_SHADOWS
enum { CELL_UNKNOWN, CELL_LIT, CELL_DARK, CELL_MIXED };
#endif

/* v + s g + s^2 q in the middle of a row, with g its first and q its second order and s = 1 / (1 + t), and its slope there. */
static void steep_ramp(const gn_pieces *p, const gn_curve *colour, int32_t right, int32_t down, int32_t n, gn_ramp *ramp)
{
    int32_t scale_q30 = gn_per_w((p->w_dx_q30 * right + p->w_dy_q30 * down) >> 1); /* right, down: in half pixels */
    for (int c = 0; c < 3; c++, colour++) {
        const gn_slope *v = &colour->slope_q24;
        int32_t across = right * colour->dxx_q28 >> 5, slope = across + (down * colour->dxy_q28 >> 5), g = (right * v->dx + down * v->dy) >> 1;
        int32_t q = 4 * gn_mul_high((right * slope + down * (down * colour->dyy_q28 >> 5)) >> 1, scale_q30);
        int32_t bent = slope + across - 4 * gn_mul_high(g + 2 * q, p->w_dx_q30);
        int32_t step = 4 * gn_mul_high(v->dx + 4 * gn_mul_high(bent, scale_q30), scale_q30);
        ramp->step_q24[c] = step;
        ramp->from_q24[c] = v->at + 4 * gn_mul_high(g + q, scale_q30) - ((step * (n - 1)) >> 1);
    }
}

/* A row of n pixels from (x, y) on. */
static void ramp_of(const gn_pieces *p, const gn_curve *colour, int32_t x, int32_t y, int32_t n, gn_ramp *ramp)
{
    int32_t right = x - p->x, down = y - p->y, both = 2 * right + n - 1;
    if (p->steep) {
        steep_ramp(p, colour, both, 2 * down, n, ramp);
        return;
    }
    for (int c = 0; c < 3; c++, colour++) { /* from the first to the last of n */
        const gn_slope *s = &colour->slope_q24;
        int32_t slope = s->dx + (down * colour->dxy_q28 >> 4), bent = colour->dxx_q28;
        int32_t left = s->at + down * (s->dy + (down * colour->dyy_q28 >> 4));
        ramp->from_q24[c] = left + right * (slope + (right * bent >> 4));
        ramp->step_q24[c] = slope + (both * bent >> 4);
    }
}

/* A row of pixels that the light reaches all over, or not at all. */
static void plain_row(const gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t n, int lit)
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
static void colours_of(const gn_pieces *p, const gn_curve *colour, int32_t x, int32_t y, int32_t n, gn_ramp *ramp)
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

/* Where the light sees the surface at a pixel: v + g / (1 + t), g the change by the slope, t that of w, is v + g - g t but for g t^2. */
static void receiver_at(const gn_pieces *p, int32_t x, int32_t y, gn_receiver_step *out)
{
    int32_t dx = x - p->x, dy = y - p->y, t_q30 = p->w_dx_q30 * dx + p->w_dy_q30 * dy;
    int32_t u = p->place[0].dx * dx + p->place[0].dy * dy, v = p->place[1].dx * dx + p->place[1].dy * dy;
    int32_t d = p->place[2].dx * dx + p->place[2].dy * dy;
    out->u_q16 = p->place[0].at + u - gn_mul_high(u, t_q30) * 4;
    out->v_q16 = p->place[1].at + v - gn_mul_high(v, t_q30) * 4;
    d = p->place[2].at + d - gn_mul_high(d, t_q30) * 4;
    out->depth_q31 = gn_max32(p->depth_least, gn_min32(d, p->depth_most)) * (1 << p->depth_up);
}

/* (b - a) / n, rounded towards zero, n <= 16 */
static int32_t step_of(int32_t a, int32_t b, int32_t n)
{
    static const uint32_t inverse[17] = {0,           0xFFFFFFFFU, 0x80000000U, 0x55555555U, 0x40000000U, 0x33333333U,
                                         0x2AAAAAAAU, 0x24924924U, 0x20000000U, 0x1C71C71CU, 0x19999999U, 0x1745D174U,
                                         0x15555555U, 0x13B13B13U, 0x12492492U, 0x11111111U, 0x10000000U};
    uint32_t d = b < a ? (uint32_t)a - (uint32_t)b : (uint32_t)b - (uint32_t)a;
    int32_t size = (int32_t)((uint64_t)d * inverse[n] >> 32);
    return b < a ? -size : size;
}

/* n <= 17 pixels from x on, looked up one by one. */
static void looked_up_row(const gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t n)
{
    uint32_t attenuation[17];
    gn_receiver_step from, to, step = {0, 0, 0};
    receiver_at(p, x, y, &from);
    to = from;
    if (n > 1) {
        receiver_at(p, x + n - 1, y, &to);
        step.u_q16 = step_of(from.u_q16, to.u_q16, n - 1);
        step.v_q16 = step_of(from.v_q16, to.v_q16, n - 1);
        step.depth_q31 = step_of(from.depth_q31, to.depth_q31, n - 1);
    }
    gn_filter_row(p->frame, p->view, &from, &to, &step, n, attenuation);
    int32_t alike = 1;
    while (alike < n && attenuation[alike] == attenuation[0]) alike++;
    if (alike == n && attenuation[0] - 1 >= 65535) { /* all or nothing, as most short rows */
        plain_row(p, rows, y, x, n, attenuation[0] != 0);
        return;
    }
#if GN_TURNING
    if (p->turns) {
        gn_turn_row(p, rows, y, x, n, attenuation, 0);
        return;
    }
#endif
    gn_ramp dark, lit;
    colours_of(p, p->dark, x, y, n, &dark);
    colours_of(p, p->lit, x, y, n, &lit);
    gn_pixel_mix(p->frame, rows, x, y, n, &dark, &lit, attenuation);
}

/* What bounds of depth say of a cell of the piece. */
static uint32_t judge_cell(const gn_pieces *p, int32_t x, int32_t y)
{
    gn_receiver_step middle_of, a, b;
    receiver_at(p, x + GN_CELL / 2, y + GN_CELL / 2, &middle_of);
    a.u_q16 = middle_of.u_q16 - p->cell_reach[0];
    b.u_q16 = middle_of.u_q16 + p->cell_reach[0];
    a.v_q16 = middle_of.v_q16 - p->cell_reach[1];
    b.v_q16 = middle_of.v_q16 + p->cell_reach[1];
    int32_t reach = gn_min32(p->cell_reach[2], INT32_MAX >> p->depth_up) * (1 << p->depth_up);
    a.depth_q31 = gn_max32(middle_of.depth_q31, -(1 << 30)) - gn_min32(reach, 1 << 30);
    b.depth_q31 = middle_of.depth_q31 > 0x7FFF8000 - reach ? 0x7FFF8000 : middle_of.depth_q31 + reach;
    uint32_t attenuation;
    if (!gn_filter_decides(p->frame, p->view, &a, &b, &attenuation)) return CELL_MIXED;
    return attenuation ? CELL_LIT : CELL_DARK;
}

static void shadowed_row(gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x, int32_t x_end)
{
    int32_t cell_y = (y - p->y0) / GN_CELL;
    while (x < x_end) {
        uint32_t state = CELL_UNKNOWN;
        int32_t end = x;
        do { /* on through cells of one kind */
            int32_t cell_x = (end - p->x0) / GN_CELL, shift = 2 * (cell_x + cell_y * (GN_PIECE_WIDTH / GN_CELL));
            uint32_t here = p->cells >> shift & 3U;
            if (here == CELL_UNKNOWN) {
                here = judge_cell(p, p->x0 + cell_x * GN_CELL, p->y0 + cell_y * GN_CELL);
                p->cells |= here << shift;
            }
            if (state == CELL_UNKNOWN) state = here;
            if (here != state) break;
            end = p->x0 + (cell_x + 1) * GN_CELL;
        } while (end < x_end && (state != CELL_MIXED || end - x < p->chunk_px));
        int32_t n = gn_min32(end, x_end) - x;
        if (state == CELL_MIXED) {
            n = gn_min32(n, p->chunk_px);
            looked_up_row(p, rows, y, x, n);
        } else plain_row(p, rows, y, x, n, state == CELL_LIT);
        x += n;
    }
}
#endif

void gn_pieces_row(gn_pieces *p, const gn_pixel_rows *rows, int32_t y, int32_t x_begin, int32_t x_end)
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
