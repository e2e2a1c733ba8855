/* The projective plane of a triangle. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_walk.h"
#include "geometry/gn_xform.h"

/* Brings an edge to 30 bits. Returns the exponent that it lost. */
GN_HOT static int32_t shorten(int32_t e[3])
{
    const int64_t wide[3] = {e[0], e[1], e[2]};
    return gn_norm_vec(e, wide);
}

GN_HOT void gn_plane_setup(gn_plane *plane, const int32_t v0[3], const int32_t v1[3], const int32_t v2[3])
{
    int32_t e1[3], e2[3], exp = 0;
    int64_t n[3];
    uint32_t wide = 0;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        e1[i] = v1[i] - v0[i]; /* < 2^31 */
        e2[i] = v2[i] - v0[i];
        wide |= ((uint32_t)e1[i] ^ (uint32_t)e1[i] << 1) | ((uint32_t)e2[i] ^ (uint32_t)e2[i] << 1);
    }
    if (wide >> 31) exp = shorten(e1) + shorten(e2);        /* 2^30 or more */
    n[0] = (int64_t)e1[1] * e2[2] - (int64_t)e1[2] * e2[1]; /* exact: 2 * 2^30 * 2^30 */
    n[1] = (int64_t)e1[2] * e2[0] - (int64_t)e1[0] * e2[2];
    n[2] = (int64_t)e1[0] * e2[1] - (int64_t)e1[1] * e2[0];
    plane->n_exp = gn_norm_vec(plane->n, n) + exp;
    plane->det = gn_dot64(plane->n, v0); /* 3 * 2^30 * 2^30 */
    plane->back = plane->det < 0;
    if (plane->back) {
        plane->det = -plane->det;
        GN_UNROLL
        for (int i = 0; i < 3; i++) plane->n[i] = -plane->n[i];
    }
}

GN_HOT void gn_bary_setup(gn_bary *bary, const gn_plane *plane, const int32_t v0[3], const int32_t v1[3],
                          const int32_t v2[3])
{
    /* b1 = (e2 x v0) . ray / (n . ray), b2 = (v0 x e1) . ray / (n . ray) */
    GN_UNROLL
    for (int k = 0; k < 2; k++) {
        const int32_t *to = k == 0 ? v2 : v1;
        int64_t c[3];
        int32_t e[3], exp = 0;
        uint32_t wide = 0;
        GN_UNROLL
        for (int i = 0; i < 3; i++) {
            e[i] = to[i] - v0[i]; /* < 2^31 */
            wide |= (uint32_t)e[i] ^ (uint32_t)e[i] << 1;
        }
        if (wide >> 31) exp = shorten(e);
        if (k == 0) gn_cross64(c, e, v0);
        else gn_cross64(c, v0, e);
        bary->exp[k] = gn_norm_vec(bary->form[k], c) + exp - plane->n_exp;
        if (plane->back)
            for (int i = 0; i < 3; i++) bary->form[k][i] = -bary->form[k][i];
    }
}

/* The perspective divide of a pixel. [R4] */
GN_HOT int gn_plane_recip(gn_ray_recip *out, const gn_plane *plane, int32_t px, int32_t py, uint32_t focal2_px_q16,
                          int32_t newton_steps)
{
    int64_t w = plane->det > 0 ? gn_plane_at(plane->n, px, py, focal2_px_q16) : 0;
    if (w <= 0) return 0;
    out->clz = gn_clz64((uint64_t)w);
    out->w_norm = (uint32_t)(((uint64_t)w << out->clz) >> 32);
    out->recip = gn_recip_norm(out->w_norm, newton_steps);
    return 1;
}

/* round(b * 2^-s), clamped to 0 .. most */
GN_HOT static inline uint32_t bary_fraction(int64_t b, int32_t s, uint32_t most)
{
    if (s < 1 || s > 62) return (uint32_t)gn_clamp64(gn_scale64(b, s), 0, most);
    if (b < 0) return 0;
    uint64_t twice = (uint64_t)b >> (s - 1);
    if (twice >> 32) return twice >= (uint64_t)most << 1 ? most : (uint32_t)((twice + 1) >> 1);
    uint32_t t = ((uint32_t)twice >> 1) + ((uint32_t)twice & 1U);
    return t < most ? t : most;
}

GN_HOT void gn_bary_at(int32_t b_q30[2], const gn_bary *bary, const gn_ray_recip *recip, int32_t px, int32_t py,
                       uint32_t focal2_px_q16)
{
    const int32_t one = 1 << 30;
    GN_UNROLL
    for (int k = 0; k < 2; k++) {
        int64_t b = gn_plane_at(bary->form[k], px, py, focal2_px_q16);
        uint32_t t = bary_fraction(b, 32 - recip->clz - bary->exp[k], recip->w_norm);
        GN_KEEP(t);                                               /* 32 bits: one multiplication */
        b_q30[k] = (int32_t)(gn_umul_high(t, recip->recip) >> 1); /* 2^64 / 2^33 */
        b_q30[k] = gn_min32(b_q30[k], one);
    }
    if (b_q30[1] > one - b_q30[0]) b_q30[1] = one - b_q30[0];
}

#if GN_INTERPOLATES || GN_ORTHOGRAPHIC
GN_HOT int gn_bary_beyond(int32_t b_q30[2], const gn_bary *bary, const gn_ray_recip *recip, int32_t px, int32_t py,
                          uint32_t focal2_px_q16)
{
    GN_UNROLL
    for (int k = 0; k < 2; k++) {
        int64_t b = gn_plane_at(bary->form[k], px, py, focal2_px_q16);
        int64_t t = gn_scale64((int64_t)gn_abs64(b), 33 - recip->clz - bary->exp[k]); /* half of it */
        if (t >= (int64_t)recip->w_norm) return 0;                                    /* 2 or more */
        uint64_t b_uq30 = (uint64_t)t * recip->recip >> 32;
        if (b_uq30 > INT32_MAX) return 0;
        b_q30[k] = b < 0 ? -(int32_t)b_uq30 : (int32_t)b_uq30;
    }
    return b_q30[0] >= -(1 << 30) && b_q30[1] >= -(1 << 30);
}
#endif

/* ---- Sutherland-Hodgman in view space ---------------------------------------------------------------------------- */

/* Signed distance to a plane, positive inside, up to a positive factor; Q32. |v| < 2^30, side < 2^31: below 2^62. */
GN_HOT static int64_t distance(const int32_t v[3], uint32_t plane, int32_t near_q16, const int32_t side_q16[2],
                               int32_t flat_q16)
{
    int64_t z = flat_q16 ? flat_q16 : v[2];
    switch (plane) {
    case GN_OUT_NEAR:
        return (int64_t)v[2] - near_q16;
    case GN_OUT_LEFT:
        return z * side_q16[0] + (int64_t)v[0] * 65536;
    case GN_OUT_RIGHT:
        return z * side_q16[0] - (int64_t)v[0] * 65536;
    case GN_OUT_BOTTOM:
        return z * side_q16[1] + (int64_t)v[1] * 65536;
    default:
        return z * side_q16[1] - (int64_t)v[1] * 65536;
    }
}

GN_HOT uint32_t gn_outcode(const int32_t v_q16[3], int32_t near_q16, const int32_t side_q16[2], int32_t flat_q16)
{
    /* as distance() has them */
    uint32_t out = v_q16[2] < near_q16 ? GN_OUT_NEAR : 0;
    int64_t z = flat_q16 ? flat_q16 : v_q16[2], side = z * side_q16[0], along = (int64_t)v_q16[0] * 65536;
    if (side + along < 0) out |= GN_OUT_LEFT;
    if (side - along < 0) out |= GN_OUT_RIGHT;
    side = z * side_q16[1];
    along = (int64_t)v_q16[1] * 65536;
    if (side + along < 0) out |= GN_OUT_BOTTOM;
    if (side - along < 0) out |= GN_OUT_TOP;
    return out;
}

/* The point where the edge leaves: from the inside end, so that both triangles on the edge compute the same. */
GN_HOT static void cut(int32_t out[3], const int32_t in[3], int64_t d_in, const int32_t beyond[3], int64_t d_out)
{
    /* t = d_in / (d_in - d_out) in (0, 1], Q0.31; d_in >= 0 > d_out and the difference is below 2^63 */
    uint64_t whole = (uint64_t)d_in + gn_abs64(d_out);
    int32_t clz = gn_clz64(whole);
    uint64_t d = (uint64_t)d_in << clz;
    uint32_t whole_norm = (uint32_t)((whole << clz) >> 32);
    uint64_t t_q31 = ((d >> 32) * gn_recip_norm(whole_norm, 2)) >> 32; /* (d / 2^32) * 2^63 / whole / 2^32 */
    for (int i = 0; i < 3; i++) {
        int64_t delta = (int64_t)beyond[i] - in[i]; /* < 2^31 */
        out[i] = (int32_t)(in[i] + gn_shr64(delta * (int64_t)t_q31, 31));
    }
}

GN_HOT static void clip_plane(gn_polygon *polygon, gn_polygon *in, uint32_t plane, int32_t near_q16,
                              const int32_t side_q16[2], int32_t flat_q16)
{
    *in = *polygon;
    int n = 0;
    for (int i = 0; i < in->n; i++) {
        const int32_t *a = in->v_q16[i], *b = in->v_q16[(i + 1) % in->n];
        int64_t da = distance(a, plane, near_q16, side_q16, flat_q16),
                db = distance(b, plane, near_q16, side_q16, flat_q16);
        if (da >= 0 && n < GN_CLIP_VERTICES_MAX) {
            for (int k = 0; k < 3; k++) polygon->v_q16[n][k] = a[k];
            n++;
        }
        if ((da >= 0) != (db >= 0) && n < GN_CLIP_VERTICES_MAX) {
            int32_t *v = polygon->v_q16[n++];
            if (da >= 0) cut(v, a, da, b, db);
            else cut(v, b, db, a, da);
            if (plane == GN_OUT_NEAR) v[2] = near_q16; /* exact where the cut rounds */
        }
    }
    polygon->n = n;
}

/* Cuts at the planes that the polygon crosses, one by one. [R3] */
GN_COLD void gn_clip(gn_polygon *polygon, gn_polygon *uncut, uint32_t planes, int32_t near_q16,
                     const int32_t side_q16[2], int32_t flat_q16)
{
    for (uint32_t plane = GN_OUT_NEAR; plane <= GN_OUT_TOP && polygon->n >= 3; plane <<= 1)
        if (planes & plane) clip_plane(polygon, uncut, plane, near_q16, side_q16, flat_q16);
    if (polygon->n < 3) polygon->n = 0;
}

/* ---- Exact edge walkers ------------------------------------------------------------------------------------------ */

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

GN_HOT static inline int32_t walk_rows(gn_walk *walk)
{
    int32_t fixed = walk->fixed, end = gn_min32(walk->row_end[0], walk->row + (fixed ? fixed : GN_WALK_ROWS)),
            n = end - walk->row;
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
    walk->fixed = fixed_for(x, gn_max32(b.y, c.y) - a.y, subpixel_bits);
    for (int side = 0; !walk->fixed && side < 2; side++) {
        if (walk->row < walk->row_end[1 + side]) edge_begin(walk, side, 0, 1 + side);
        else if (walk->row > walk->row_end[1 + side]) edge_begin(walk, side, 1 + side, 2 - side);
    }
    return walk_rows(walk);
}
