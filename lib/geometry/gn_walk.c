/* Exact edge walkers. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_walk.h"

/* ---- Quotient and remainder -------------------------------------------------------------------------------------- */

/* Rounded towards minus infinity; b > 0 */
GN_HOT static void floor_div(int64_t a, int32_t b, int32_t *q, int32_t *r)
{
    int64_t quotient, rest;
    if (a == (int32_t)a) { /* 32-bit division where the operands fit: always at 4 subpixel bits */
        quotient = (int32_t)a / b;
        rest = (int32_t)a % b;
    } else {
        uint64_t left;
        quotient = (int64_t)gn_udiv64_rest(gn_abs64(a), (uint32_t)b, &left);
        rest = (int64_t)left;
        if (a < 0) {
            quotient = -quotient;
            rest = -rest;
        }
    }
    if (rest < 0) {
        rest += b;
        quotient--;
    }
    *q = gn_sat32(quotient);
    *r = (int32_t)rest;
}

/* The edge from (x0, y0) down to (x1, y1), y0 < y1, at row y. */
GN_HOT static void exact_begin(gn_edge *edge, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t subpixel_bits,
                               int32_t y)
{
    int64_t one = (int64_t)1 << subpixel_bits, half = one >> 1;
    int32_t dx = x1 - x0, dy = y1 - y0; /* < 2^30 */
    int64_t row = y * one + half - y0;
    int64_t m = (x0 - half) * dy + row * dx; /* < 2^61 */
    m = (m + one - 1) >> subpixel_bits;      /* ceil: nested ceilings of integer divisions are one */
    floor_div(m + dy - 1, dy, &edge->q, &edge->r);
    floor_div(dx, dy, &edge->dq, &edge->dr);
    edge->dy = dy;
}

/* To the next row. */
GN_HOT static inline void exact_next(gn_edge *edge)
{
    edge->q += edge->dq;
    edge->r += edge->dr;
    if (edge->r >= edge->dy) {
        edge->r -= edge->dy;
        edge->q++;
    }
}

GN_HOT static inline int16_t exact_step(gn_edge *edge)
{
    int16_t x = (int16_t)gn_max32(gn_min32(edge->q, INT16_MAX), INT16_MIN);
    exact_next(edge);
    return x;
}

/* ---- Fixed point ------------------------------------------------------------------------------------------------- */

/* How many rows fixed point lasts for a triangle with these corners. */
GN_HOT static inline int32_t fixed_for(const int32_t x[3], int32_t height, int32_t subpixel_bits)
{
    uint32_t far = (uint32_t)((x[0] ^ x[0] >> 31) | (x[1] ^ x[1] >> 31) | (x[2] ^ x[2] >> 31)) >> (12 + subpixel_bits);
    int32_t a = x[1] - x[0], b = x[2] - x[0], c = x[2] - x[1];
    return far ? 0 : gn_walk_lasts((uint32_t)height | (uint32_t)((a ^ a >> 31) | (b ^ b >> 31) | (c ^ c >> 31)));
}

/* Where an edge down crosses rows y <= .. < y_end, not empty, into every other int16_t from `at` on. */
GN_HOT static GN_NOINLINE void fixed_rows(const gn_walk *walk, int16_t *at, const gn_walk_corner *from,
                                          const gn_walk_corner *to, int32_t y, int32_t y_end)
{
    gn_walk_line line = gn_walk_line_at(from->x, from->y, to->x, to->y, y, walk->fixed, walk->subpixel_bits);
    uint32_t x = line.x, step = line.step;
    int16_t *end = at + 2 * (y_end - y);
    do {
        *at = (int16_t)((int32_t)x >> GN_FIXED_BITS);
        at += 2;
        x += step;
        GN_KEEP(at);
    } while (at != end);
}

/* One border of rows up to `end`: 0 left, 1 right. */
GN_HOT static inline void fixed_border(gn_walk *walk, int side, int32_t end)
{
    const gn_walk_corner *p = walk->corner;
    int32_t row = walk->row, bend = gn_min32(walk->row_end[1 + side], end);
    int16_t *at = side ? &walk->span[0].x_end : &walk->span[0].x_begin;
    if (row < bend) {
        fixed_rows(walk, at, &p[0], &p[1 + side], row, bend);
        at += 2 * (bend - row);
        row = bend;
    }
    if (row < end) fixed_rows(walk, at, &p[1 + side], &p[2 - side], row, end);
}

/* ---- Walking ----------------------------------------------------------------------------------------------------- */

/* Begins an edge at the current row. Corners: 0 top, 1 left, 2 right. */
GN_HOT static void edge_begin(gn_walk *walk, int side, int from, int to)
{
    const gn_walk_corner *a = &walk->corner[from], *b = &walk->corner[to];
    exact_begin(&walk->edge[side], a->x, a->y, b->x, b->y, walk->subpixel_bits, walk->row);
}

#if GN_SIZE_FIRST
/* Rows up to `end`. */
GN_HOT static GN_NOINLINE void exact_rows(gn_walk *walk, int32_t end)
{
    gn_span *span = walk->span;
    for (; walk->row < end; walk->row++, span++) {
        for (int side = 0; side < 2; side++)
            if (walk->row == walk->row_end[1 + side]) edge_begin(walk, side, 1 + side, 2 - side);
        span->x_begin = exact_step(&walk->edge[0]);
        span->x_end = exact_step(&walk->edge[1]);
    }
}
#else
/* One border of rows up to `end`: 0 left, 1 right. */
GN_HOT static GN_NOINLINE void exact_border(gn_walk *walk, int side, int32_t end)
{
    int16_t *at = side ? &walk->span[0].x_end : &walk->span[0].x_begin;
    int32_t first = walk->row, row = first, bend = walk->row_end[1 + side];
    while (row < end) {
        walk->row = row;
        if (row == bend) edge_begin(walk, side, 1 + side, 2 - side);
        gn_edge edge = walk->edge[side];
        int32_t n = (row < bend ? gn_min32(bend, end) : end) - row;
        row += n;
        if ((uint32_t)edge.q + (1U << 14) < 1U << 15 &&
            (uint32_t)edge.dq + (1U << 9) < 1U << 10) { /* fits 16 bits for 16 rows */
            do {
                *at = (int16_t)edge.q;
                at += 2;
                exact_next(&edge);
                GN_KEEP(at);
            } while (--n);
        } else {
            for (; n > 0; n--, at += 2) *at = exact_step(&edge);
        }
        walk->edge[side] = edge;
    }
    walk->row = first;
}

/* Rows up to `end`. */
GN_HOT static inline void exact_rows(gn_walk *walk, int32_t end)
{
    exact_border(walk, 0, end);
    exact_border(walk, 1, end);
    walk->row = end;
}
#endif

GN_HOT static inline int32_t walk_rows(gn_walk *walk)
{
    int32_t fixed = GN_SIZE_FIRST ? 0 : walk->fixed,
            end = gn_min32(walk->row_end[0], walk->row + (fixed ? fixed : GN_WALK_ROWS)), n = end - walk->row;
    walk->first = walk->row;
    if (fixed) {
        fixed_border(walk, 0, end);
        fixed_border(walk, 1, end);
        walk->row = end;
    } else {
        exact_rows(walk, end);
    }
    walk->n_left = n;
    return n;
}

GN_HOT int32_t gn_walk_next(gn_walk *walk)
{
    return walk_rows(walk);
}

GN_HOT int32_t gn_walk_begin(gn_walk *walk, const int32_t x[3], const int32_t y[3], int32_t subpixel_bits, int32_t y_lo,
                             int32_t y_hi)
{
    int top = y[1] < y[0] ? 1 : 0;
    if (y[2] < y[top]) top = 2;
    int left = top == 2 ? 0 : top + 1, right = 3 - top - left;
    int64_t turn =
        (int64_t)(x[left] - x[top]) * (y[right] - y[top]) - (int64_t)(x[right] - x[top]) * (y[left] - y[top]);
    if (turn > 0) {
        left = right;
        right = 3 - top - left;
    }
    const gn_walk_corner a = {x[top], y[top]}, b = {x[left], y[left]}, c = {x[right], y[right]};
    walk->corner[0] = a, walk->corner[1] = b, walk->corner[2] = c;
    walk->row = gn_max32(gn_first_px(a.y, subpixel_bits), y_lo);
    walk->row_end[1] = gn_first_px(b.y, subpixel_bits);
    walk->row_end[2] = gn_first_px(c.y, subpixel_bits);
    walk->row_end[0] = gn_min32(gn_max32(walk->row_end[1], walk->row_end[2]), y_hi);
    if (walk->row >= walk->row_end[0]) return 0;
    walk->subpixel_bits = subpixel_bits;
    walk->fixed = GN_SIZE_FIRST ? 0 : fixed_for(x, gn_max32(b.y, c.y) - a.y, subpixel_bits);
    for (int side = 0; !walk->fixed && side < 2; side++) {
        if (walk->row < walk->row_end[1 + side]) edge_begin(walk, side, 0, 1 + side);
        else if (walk->row > walk->row_end[1 + side]) edge_begin(walk, side, 1 + side, 2 - side);
    }
    return walk_rows(walk);
}
