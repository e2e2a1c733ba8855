/* Exact edge walkers. */
#include "gn_walk.h"
#include "gn_q.h"

/* Quotient and remainder rounded towards minus infinity; b > 0 */
static void floor_div(int64_t a, int32_t b, int32_t *q, int32_t *r)
{
    int64_t quotient, rest;
    if (a == (int32_t)a) { /* a 32-bit division where it is enough: always at 4 subpixel bits */
        quotient = (int32_t)a / b;
        rest = (int32_t)a % b;
    } else {
        quotient = a / b;
        rest = a % b;
    }
    if (rest < 0) {
        rest += b;
        quotient--;
    }
    *q = gn_sat32(quotient);
    *r = (int32_t)rest;
}

/* The edge from (x0, y0) down to (x1, y1), y0 < y1, at row y. */
static void edge_begin(gn_edge *edge, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t subpixel_bits, int32_t y)
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

int gn_walk_begin(gn_walk *walk, const int32_t x[3], const int32_t y[3], int32_t subpixel_bits, int32_t y_lo, int32_t y_hi)
{
    int top = y[1] < y[0] ? 1 : 0;
    if (y[2] < y[top]) top = 2;
    int bottom = y[(top + 1) % 3] >= y[(top + 2) % 3] ? (top + 1) % 3 : (top + 2) % 3;
    int mid = 3 - top - bottom;
    int32_t y0 = gn_max32(gn_first_px(y[top], subpixel_bits), y_lo);
    walk->y_end = gn_min32(gn_first_px(y[bottom], subpixel_bits), y_hi);
    if (y0 >= walk->y_end) return 0;
    walk->y = y0;
    walk->y_mid = gn_first_px(y[mid], subpixel_bits);
    walk->subpixel_bits = subpixel_bits;
    int64_t turn = (int64_t)(x[mid] - x[top]) * (y[bottom] - y[top]) - (int64_t)(x[bottom] - x[top]) * (y[mid] - y[top]);
    walk->long_edge_left = turn > 0; /* the middle vertex lies right of the long edge */
    edge_begin(&walk->edge[0], x[top], y[top], x[bottom], y[bottom], subpixel_bits, y0);
    int32_t lower[4] = {x[mid], y[mid], x[bottom], y[bottom]};
    for (int i = 0; i < 4; i++) walk->lower[i] = lower[i];
    if (y0 < walk->y_mid) {
        edge_begin(&walk->edge[1], x[top], y[top], x[mid], y[mid], subpixel_bits, y0);
    } else {
        walk->y_mid = y0; /* gn_walk_row begins the lower edge at once */
    }
    return 1;
}

void gn_walk_lower_edge(gn_walk *walk)
{
    const int32_t *e = walk->lower;
    edge_begin(&walk->edge[1], e[0], e[1], e[2], e[3], walk->subpixel_bits, walk->y);
}
