/* Records as small triangles. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "scene/gn_scene.h"
#include "shade/gn_patch.h"

#if GN_INTERPOLATES

/* 2^47 / m of m in 2^31 .. 2^32, 15 to 16 bits: relative error below 2^-14.9, never more than 2^16 - 1. */
GN_HOT static inline uint32_t recip_16(uint32_t m)
{
    uint32_t r;
    if (GN_CORE_DIVIDES) r = 0x7FFFFFFFU / (m >> 16);
    else { /* the same floor, from the table and one step */ const uint32_t m16 = m >> 16;
        r = gn_recip_norm(m16 << 16, 1) >> 16;
        if (r * m16 > 0x7FFFFFFFU) r--;
        else if (0x7FFFFFFFU - r * m16 >= m16) r++;
    }
    return r > 65535U ? 65535U : r;
}

/* v t / 2^bits, modulo 2^32, to a unit: whole ones and parts of v apart. */
GN_HOT static inline uint32_t times_part(int32_t v, int32_t t, int32_t bits)
{
    return (uint32_t)(v >> bits) * (uint32_t)t + (uint32_t)(((v & ((1 << bits) - 1)) * t) >> bits); /* 2^8 * 2^13 */
}

/* v 2^s, rounded down */
GN_HOT static inline int32_t shifted(int32_t v, int32_t s)
{
    return s >= 0 ? (int32_t)((uint32_t)v << gn_min32(s, 31)) : v >> gn_min32(-s, 31);
}

/* ---- What is a patch --------------------------------------------------------------------------------------------- */

static const uint8_t vertex_of[7][3] = {{0, 1, 2}, {0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

/* near / Z at a corner */
GN_HOT static inline uint32_t nearness_at(const gn_patch_record *r, const gn_frame *frame, int k)
{
    const int32_t bits = GN_K(frame, subpixel_bits);
    return r->iz_q32 + times_part(r->tri->iz_dx, r->at[k][0], bits) + times_part(r->tri->iz_dy, r->at[k][1], bits);
}

/* near / Z in the middle of a box of so many pixels, and whether it bends what is linear by more than half a pixel, a
 * quarter, an eighth with finer shading: by a quarter of its change. Returns 0 if it doubles over the box. */
GN_HOT static int find_nearness(gn_patch_record *r, const gn_frame *frame, int32_t w_px, int32_t h_px)
{
    const gn_tri *tri = r->tri;
    const int32_t bits = GN_K(frame, subpixel_bits),
                  limit = GN_K(frame, persp_step) == 16  ? 1
                          : GN_K(frame, persp_step) == 8 ? 2
                                                         : 3,
                  column = (tri->x[0] + ((frame->picture.width << bits) >> 1)) >> bits,
                  row = (tri->y[0] + ((frame->picture.height << bits) >> 1)) >> bits;
    const uint32_t dx = gn_abs32(tri->iz_dx), dy = gn_abs32(tri->iz_dy);
    if ((dx | dy) >> 26) return 0;
    const uint32_t change = dx * (uint32_t)w_px + dy * (uint32_t)h_px, /* 2^32 */
        iz = tri->iz_ref + (uint32_t)tri->iz_dx * (uint32_t)(r->x - column) +
             (uint32_t)tri->iz_dy * (uint32_t)(r->y - row);
    r->iz_q32 = iz;
    /* with fewer units even a plane at 45 degrees changes by less than 16 a pixel: its normal and depth would be noise
     */
    if (iz < 256 || iz < frame->cam.focal2_px_q16 >> 13 || change > iz >> 1) return 0;
    const uint32_t first = nearness_at(r, frame, 0);
    if ((first > iz ? first - iz : iz - first) > change + 8)
        return 0; /* it wrapped: beside the triangle it is below 0, or 2^32 */
    r->deep = (change >> 6) * (uint32_t)r->px > iz >> (4 + limit);
    return 1;
}

/* By what weights of corners 1 and 2 change. Returns 0 if the triangle is thinner than an 8th of a pixel; a deep one,
 * than an 8th of its box: rows end beside it, where steep slopes would not fit 32 bits. */
GN_HOT static int find_parts(gn_patch_record *r, const gn_frame *frame)
{
    const int32_t bits = GN_K(frame, subpixel_bits), *o = r->at[0], *a = r->at[1], *b = r->at[2];
    if (r->area < (uint32_t)(r->deep ? r->px * r->px : r->px) << (2 * bits - 3)) return 0; /* 2^1 at least */
    const int32_t clz = gn_clz32(r->area), recip = (int32_t)recip_16(r->area << clz);      /* 2^(47 - clz) / area */
    int32_t of[4] = {(o[1] - b[1]) * recip, (b[0] - o[0]) * recip, (a[1] - o[1]) * recip,
                     (o[0] - a[0]) * recip}; /* 2^29 */
    uint32_t any = 0;
    for (int i = 0; i < 4; i++) any |= gn_abs32(of[i]);
    const int32_t down = gn_max32(18 - gn_clz32(any | 1U), 0);
    for (int i = 0; i < 4; i++) r->part[i >> 1][i & 1] = of[i] >> down;
    r->part_shift = 47 - clz - bits - down;
    return 1;
}

GN_HOT int gn_record_begin(gn_patch_record *r, const gn_frame *frame, const gn_tri *tri)
{
    const uint32_t order = gn_tri_order(tri);
    const int32_t bits = GN_K(frame, subpixel_bits), one = 1 << bits;
    const gn_coord *x = tri->x, *y = tri->y;
    if (order == GN_TRI_CUT || order == GN_TRI_STEEP || gn_tri_is_bounded(tri)) return 0;
    if (frame->picture.width < 64 || frame->picture.height < 64) return 0; /* rays beyond the picture may not fit */
    const int32_t left = gn_min32(gn_min32(x[0], x[1]), x[2]), right = gn_max32(gn_max32(x[0], x[1]), x[2]),
                  bottom = gn_max32(y[1], y[2]); /* 0 is top */
    const int32_t w_px = (right - left + one - 1) >> bits, h_px = (bottom - y[0] + one - 1) >> bits;
    r->px = gn_max32(w_px, h_px);
    if (r->px > GN_PATCH_PX) return 0;
    r->tri = tri;
    const int mirrored = (frame->flags[tri->source.object_idx] & GN_OBJECT_MIRRORED) != 0;
    r->back = (order >= GN_TRI_BACK) != mirrored;
    const int32_t half_w = (frame->picture.width << bits) >> 1, half_h = (frame->picture.height << bits) >> 1;
    r->x = (((left + right) >> 1) + half_w) >> bits;
    r->y = (((y[0] + bottom) >> 1) + half_h) >> bits;
    r->columns[0] = (left + half_w) >> bits, r->columns[1] = (right + half_w) >> bits;
    for (int k = 0; k < 3; k++) {
        r->at[k][0] = x[k] + half_w - (r->x * one + (one >> 1));
        r->at[k][1] = y[k] + half_h - (r->y * one + (one >> 1));
    }
    r->area = (uint32_t)((x[2] - x[0]) * (y[1] - y[0]) - (x[1] - x[0]) * (y[2] - y[0])); /* 2^26 * 2 */
    if (!find_nearness(r, frame, w_px, h_px) || !find_parts(r, frame)) return 0;
    const gn_mesh *mesh = frame->scene->objects[tri->source.object_idx].mesh;
    const uint16_t *idx = mesh->idx + 3 * (size_t)tri->source.triangle_idx;
    for (int k = 0; k < 3; k++) r->vertex[k] = idx[vertex_of[order][k]];
    if (r->deep) gn_record_find_depth(r, frame);
    return 1;
}

/* ---- Slopes ------------------------------------------------------------------------------------------------------ */

/* 1 over near / Z, which is a part of that in the middle, Q30: Q28, for 1/4 .. 2 */
GN_HOT static inline int32_t over_part(uint32_t part_q30)
{
    const int32_t clz = gn_clz32(part_q30); /* 2^63 / (part 2^clz) * 2^(clz - 5) */
    return (int32_t)(gn_recip_norm(part_q30 << clz, 1) >> gn_max32(5 - clz, 2));
}

/* near / Z at corner k over that in the middle, Q30: 1/2 .. 3/2 */
GN_HOT static int32_t ratio_at_corner(const gn_patch_record *r, const gn_frame *frame, int k)
{
    const int32_t bits = GN_K(frame, subpixel_bits);
    return (int32_t)((1U << 30) + times_part(r->lean_q30[0], r->at[k][0], bits) +
                     times_part(r->lean_q30[1], r->at[k][1], bits));
}

GN_HOT void gn_record_slope(const gn_patch_record *r, const gn_frame *frame, int32_t v0, int32_t v1, int32_t v2,
                            gn_slope *out)
{
    const int32_t bits = GN_K(frame, subpixel_bits), d1 = v1 - v0, d2 = v2 - v0;
    const int32_t down = gn_max32(17 - gn_clz32(gn_abs32(d1) | gn_abs32(d2) | 1U), 0);
    int32_t e1 = d1 >> down, e2 = d2 >> down;
    if (r->deep) { /* differences times near / Z are linear: below 3 * 2^14 */
        e1 = e1 * (ratio_at_corner(r, frame, 1) >> 15) >> 15;
        e2 = e2 * (ratio_at_corner(r, frame, 2) >> 15) >> 15;
    }
    /* 2^14 times that, twice; at most 8 times the values' range */
    out->dx = shifted(e1 * r->part[0][0] + e2 * r->part[1][0], down - r->part_shift);
    out->dy = shifted(e1 * r->part[0][1] + e2 * r->part[1][1], down - r->part_shift);
    const int32_t there =
        (int32_t)(0U - times_part(out->dx, r->at[0][0], bits) - times_part(out->dy, r->at[0][1], bits));
    out->at = (int32_t)((uint32_t)v0 + (uint32_t)there);
    if (!r->deep) return;
    out->dx -= gn_mul_high(there, r->lean_q30[0]) * 4;
    out->dy -= gn_mul_high(there, r->lean_q30[1]) * 4;
}

GN_HOT int32_t gn_record_at_corner(const gn_patch_record *r, const gn_frame *frame, const gn_slope *v, int k)
{
    const int32_t bits = GN_K(frame, subpixel_bits);
    int32_t more = (int32_t)(times_part(v->dx, r->at[k][0], bits) + times_part(v->dy, r->at[k][1], bits));
    if (r->deep) more = gn_mul_high(more, over_part((uint32_t)ratio_at_corner(r, frame, k))) * 16;
    return (int32_t)((uint32_t)v->at + (uint32_t)more);
}

/* ---- Rows of deep records ---------------------------------------------------------------------------------------- */

GN_HOT int32_t gn_record_begin_row(gn_patch_record *r, int32_t x, int32_t y)
{
    gn_record_row *row = &r->row;
    row->first = x - ((x - r->columns[0]) & (GN_PATCH_ROW_PX - 1));
    row->last = gn_min32(row->first + GN_PATCH_ROW_PX, r->columns[1]);
    row->y = y;
    for (int i = 0; i < 2; i++)
        row->ratio_q28[i] =
            over_part((1U << 30) + (uint32_t)r->lean_q30[0] * (uint32_t)((i ? row->last : row->first) - r->x) +
                      (uint32_t)r->lean_q30[1] * (uint32_t)(y - r->y));
    row->per_q31 = 0x7FFFFFFF / gn_max32(row->last - row->first, 1);
    return row->first + GN_PATCH_ROW_PX - x;
}

GN_HOT gn_row_value gn_record_deep(const gn_patch_record *r, const gn_slope *v, int32_t x)
{
    const gn_record_row *row = &r->row;
    const uint32_t down = (uint32_t)v->dy * (uint32_t)(row->y - r->y);
    const int32_t from =
                      gn_mul_high((int32_t)(down + (uint32_t)v->dx * (uint32_t)(row->first - r->x)), row->ratio_q28[0]),
                  to = gn_mul_high((int32_t)(down + (uint32_t)v->dx * (uint32_t)(row->last - r->x)), row->ratio_q28[1]);
    const int32_t step = gn_mul_high((to - from) * 16, row->per_q31) * 2;
    return (gn_row_value){
        (int32_t)((uint32_t)v->at + (uint32_t)from * 16U + (uint32_t)step * (uint32_t)(x - row->first)), step};
}

/* ---- Depth and places -------------------------------------------------------------------------------------------- */

GN_HOT void gn_record_find_depth(gn_patch_record *r, const gn_frame *frame)
{
    const int32_t near_clz = gn_clz32((uint32_t)frame->cam.near_q16), clz = gn_clz32(r->iz_q32);
    const uint32_t recip = gn_recip_norm(r->iz_q32 << clz, 1); /* 2^63 / (iz 2^clz) */
    const int32_t half = (int32_t)(recip >> 1);
    r->z = (int32_t)(gn_umul_high((uint32_t)frame->cam.near_q16 << near_clz, recip) >> 2); /* 2^28 .. 2^30 */
    r->z_up = near_clz - clz - 3;
    r->lean_q30[0] = gn_mul_high(r->tri->iz_dx * (1 << clz), half); /* at most a half of near / Z */
    r->lean_q30[1] = gn_mul_high(r->tri->iz_dy * (1 << clz), half);
}

GN_HOT int32_t gn_record_depth(const gn_patch_record *r)
{
    return shifted(r->z, -r->z_up);
}

/* near / Z differs from that in the middle by a part q <= 1/2: Z by up to q (1 + 2 q) of itself. */
GN_HOT void gn_record_depths(const gn_patch_record *r, const gn_frame *frame, int32_t *lo, int32_t *hi)
{
    uint32_t far[2] = {0, 0};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) far[i] = (uint32_t)gn_max32((int32_t)far[i], (int32_t)gn_abs32(r->at[k][i]));
    const uint32_t q_q24 =
        (((gn_abs32(r->lean_q30[0]) >> 6) + 1) * far[0] + ((gn_abs32(r->lean_q30[1]) >> 6) + 1) * far[1]) >>
        GN_K(frame, subpixel_bits); /* 2^23 of 2^8, as that over the box is a half at most */
    const int32_t q_q30 = (int32_t)gn_min32((int32_t)q_q24 + 1, 1 << 23) << 6, less = gn_mul_high(r->z, q_q30) * 4;
    *lo = shifted(r->z - less, -r->z_up) - 1;
    *hi = shifted(r->z + less + gn_mul_high(less, q_q30) * 8, -r->z_up) + 1;
}

/* Z (a . ray), whose changes are Z a - Z (a . ray) lean. */
GN_HOT int gn_record_place(const gn_patch_record *r, const gn_frame *frame, const gn_ray_plane *plane,
                           int32_t ray_shift, gn_slope *out_q16)
{
    const int32_t up = 32 - ray_shift - r->z_up, most = 1 << 29, px = 2 * r->x + 1 - frame->picture.width,
                  py = frame->picture.height - 1 - 2 * r->y;
    const uint32_t ray = (uint32_t)plane->a0 + (uint32_t)plane->ax * (uint32_t)px + (uint32_t)plane->ay * (uint32_t)py;
    const int32_t v = gn_mul_high(r->z, (int32_t)ray), /* 2^29 */
        dx = gn_mul_high(r->z, 2 * plane->ax) - 2 * gn_mul_high(2 * v, r->lean_q30[0]),
                  dy = -gn_mul_high(r->z, 2 * plane->ay) - 2 * gn_mul_high(2 * v, r->lean_q30[1]);
    const uint32_t slopes = gn_abs32(dx) | gn_abs32(dy), any = gn_abs32(v) | slopes << 6;
    if (plane->d_q16 < -most || plane->d_q16 > most || slopes >> 23) return 0;
    out_q16->at = (int32_t)((uint32_t)shifted(v, up) + (uint32_t)(int32_t)plane->d_q16);
    out_q16->dx = shifted(dx, up);
    out_q16->dy = shifted(dy, up);
    return up <= 0 || (up < 29 && !(any >> (29 - up)));
}

/* ---- The face ---------------------------------------------------------------------------------------------------- */

/* near / Z is linear on the screen, and n . ray times a constant, n being the face's normal away from the viewer: n =
 * (F dx, -F dy, what it is in the picture's centre). */
GN_HOT void gn_record_face(const gn_patch_record *r, const gn_frame *frame, int32_t view_q14[3])
{
    int64_t out[3];
    const gn_tri *tri = r->tri;
    const int32_t focal = (int32_t)(frame->cam.focal2_px_q16 >> 1); /* F, Q16 */
    const int32_t x = 2 * r->x + 1 - frame->picture.width, y = 2 * r->y + 1 - frame->picture.height;
    out[0] = -((int64_t)tri->iz_dx * focal); /* 2^62 */
    out[1] = (int64_t)tri->iz_dy * focal;
    out[2] = ((int64_t)tri->iz_dx * x + (int64_t)tri->iz_dy * y - (int64_t)r->iz_q32 * 2) * 32768;
    const uint32_t any = (uint32_t)(out[0] >> 32 ^ out[0] >> 63) | (uint32_t)(out[1] >> 32 ^ out[1] >> 63) |
                         (uint32_t)(out[2] >> 32 ^ out[2] >> 63) | 1U;
    for (int i = 0; i < 3; i++) view_q14[i] = (int32_t)(out[i] >> (34 - gn_clz32(any))); /* 30 bits */
    gn_normalise_15(view_q14);
    for (int i = 0; i < 3; i++) view_q14[i] >>= 16;
}

/* v > 0 as 16 bits, of which the highest is set, and a power of two: rounded down. */
GN_HOT static inline uint32_t upper_16(uint64_t v, int32_t *log2)
{
    const int32_t down = 48 - gn_clz64(v);
    *log2 += down;
    return (uint32_t)(down >= 0 ? v >> down : v << -down);
}

/* Of texels / pixels * Z / d, d being the plane's distance: n . ray = d / Z for a normal of length 1. */
GN_HOT int32_t gn_record_level2(const gn_patch_record *r, const gn_frame *frame, const int32_t view_q14[3],
                                uint64_t texels, int32_t log2)
{
    const int32_t bits = GN_K(frame, subpixel_bits), x = 2 * r->x + 1 - frame->picture.width,
                  y = frame->picture.height - 1 - 2 * r->y, focal2 = (int32_t)(frame->cam.focal2_px_q16 >> 16);
    const int32_t facing = -(view_q14[0] * x + view_q14[1] * y + view_q14[2] * focal2); /* 2 F d / Z, Q14 */
    int32_t up = log2 + 14 + 2 * bits, down = 0;
    if (facing <= 0 || focal2 <= 0) return 0;
    const uint32_t above = upper_16(texels, &up) * upper_16((uint32_t)focal2, &up),
                   below = upper_16(r->area, &down) * upper_16((uint32_t)facing, &down);
    /* quotients of 2^30 .. 2^32 */
    const int32_t log2_above = 31 - gn_clz32(above), log2_below = 31 - gn_clz32(below);
    const int less = above << (31 - log2_above) < below << (31 - log2_below);
    return up - down + log2_above - log2_below - less;
}

#endif
