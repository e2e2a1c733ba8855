/* Records as small triangles. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "scene/gn_scene.h"
#include "shade/gn_patch.h"

#if GN_INTERPOLATES

#define PARTS_(n) 0x7FFFFFFF / (n), 0x7FFFFFFF / ((n) + 1), 0x7FFFFFFF / ((n) + 2), 0x7FFFFFFF / ((n) + 3)
const int32_t gn_patch_parts_q31[GN_PATCH_COVERS] = {0,          PARTS_(1),  PARTS_(5),  PARTS_(9),  PARTS_(13),
                                                     PARTS_(17), PARTS_(21), PARTS_(25), PARTS_(29), 0x7FFFFFFF / 33};

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
    return (uint32_t)(v >> bits) * (uint32_t)t + (uint32_t)(((v & ((1 << bits) - 1)) * t) >> bits); /* 2^8 * 2^18 */
}

/* near / Z at a point that lies (x, y) from the centre of the record's pixel, subpixel_bits fraction bits: modulo 2^32.
 */
GN_HOT static inline uint32_t nearness_at(const gn_tri *tri, int32_t x, int32_t y, int32_t bits)
{
    return tri->iz_ref + times_part(tri->iz_dx, x, bits) + times_part(tri->iz_dy, y, bits);
}

static const uint8_t vertex_of[7][3] = {{0, 1, 2}, {0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

/* near / Z at the corners, and whether weights need them. Returns 0 if it doubles over the triangle. */
GN_HOT static int find_nearness(gn_patch_record *r, const gn_frame *frame)
{
    const gn_tri *tri = r->tri;
    const int32_t bits = GN_K(frame, subpixel_bits), *off = r->off;
    uint32_t least = r->iz_q32[0] = nearness_at(tri, -off[0], -off[1], bits), most = least;
    r->iz_q32[1] = nearness_at(tri, r->a[0] - off[0], r->a[1] - off[1], bits);
    r->iz_q32[2] = nearness_at(tri, r->b[0] - off[0], r->b[1] - off[1], bits);
    for (int k = 1; k < 3; k++) {
        least = r->iz_q32[k] < least ? r->iz_q32[k] : least;
        most = r->iz_q32[k] > most ? r->iz_q32[k] : most;
    }
    /* a plane that leans by its distance changes by less than 16 units a pixel: it has no normal, nor depth */
    if (least < 256 || least < frame->cam.focal2_px_q16 >> 13 || most - least > least >> 1) return 0;
    /* linear weights are off by a quarter of the change over the box: up to an eighth of a pixel, or a sixteenth */
    const uint32_t bend = ((most - least) >> 6) * (uint32_t)r->px, fine = GN_K(frame, persp_step) < 16;
    r->deep = bend > least >> (7 + fine);
    r->bent = 0;
    if (!r->deep) return 1;
    /* pieces of rows are straight between their ends: where it changes by q they are off by up to q / 8 of their
     * length, of a pixel by an eighth, or a sixteenth */
    const int32_t w_px = (gn_max32(gn_max32(r->a[0], r->b[0]), 0) - gn_min32(gn_min32(r->a[0], r->b[0]), 0)) >> bits,
                  n = gn_min32(w_px, GN_PATCH_ROW_PX);
    r->bent = (uint64_t)gn_abs32(tri->iz_dx) * (uint32_t)(n * n) > least >> fine;
    const int32_t clz = gn_clz32(r->iz_q32[0]);
    const uint32_t recip = recip_16(r->iz_q32[0] << clz);
    for (int k = 0; k < 2; k++) {
        const uint32_t half = clz ? r->iz_q32[k + 1] << (clz - 1) : r->iz_q32[k + 1] >> 1; /* below 2^32 */
        r->near_q14[k] = (half >> 16) * recip >> 16;
    }
    return 1;
}

GN_HOT int gn_record_begin(gn_patch_record *r, const gn_frame *frame, const gn_tri *tri)
{
    const uint32_t order = gn_tri_order(tri);
    const int32_t bits = GN_K(frame, subpixel_bits), one = 1 << bits;
    const int32_t x0 = tri->x[0], y0 = tri->y[0];
    if (order == GN_TRI_CUT || order == GN_TRI_STEEP || gn_tri_is_bounded(tri)) return 0;
    if (frame->picture.width < 64 || frame->picture.height < 64) return 0; /* rays beyond the picture may not fit */
    const int32_t ax = tri->x[1] - x0, ay = tri->y[1] - y0, bx = tri->x[2] - x0, by = tri->y[2] - y0;
    const int32_t w = gn_max32(gn_max32(ax, bx), 0) - gn_min32(gn_min32(ax, bx), 0),
                  h = gn_max32(ay, by); /* 0 is top */
    r->px = (gn_max32(w, h) + one - 1) >> bits;
    if (r->px > GN_PATCH_PX) return 0;
    r->tri = tri;
    const int mirrored = (frame->flags[tri->source.object_idx] & GN_OBJECT_MIRRORED) != 0;
    r->back = (order >= GN_TRI_BACK) != mirrored;
    r->a[0] = ax, r->a[1] = ay, r->b[0] = bx, r->b[1] = by;
    r->area = (uint32_t)(bx * ay - ax * by); /* 2^26 * 2 */
    r->clz = gn_clz32(r->area);
    r->recip = recip_16(r->area << r->clz);
    const int32_t x = x0 + ((frame->picture.width << bits) >> 1), y = y0 + ((frame->picture.height << bits) >> 1);
    r->x0 = x >> bits, r->y0 = y >> bits;
    r->off[0] = (one >> 1) - (x & (one - 1)), r->off[1] = (one >> 1) - (y & (one - 1));
    if (!find_nearness(r, frame)) return 0;
    const gn_mesh *mesh = frame->scene->objects[tri->source.object_idx].mesh;
    const uint16_t *idx = mesh->idx + 3 * (size_t)tri->source.triangle_idx;
    for (int k = 0; k < 3; k++) r->vertex[k] = idx[vertex_of[order][k]];
    return 1;
}

GN_HOT void gn_record_find_depths(gn_patch_record *r, const gn_frame *frame)
{
    const int32_t near_clz = gn_clz32((uint32_t)frame->cam.near_q16);
    const uint32_t near_norm = (uint32_t)frame->cam.near_q16 << near_clz;
    uint32_t high[3];
    int32_t down[3], least = 31; /* of the farthest corner */
    GN_UNROLL
    for (int k = 0; k < 3; k++) { /* near 2^32 / iz = high 2^-down */
        const int32_t clz = gn_clz32(r->iz_q32[k]);
        high[k] = gn_umul_high(near_norm, gn_recip_norm(r->iz_q32[k] << clz, 1)); /* 2^30 .. 2^32 */
        down[k] = near_clz - clz - 1;
        least = gn_min32(least, down[k]);
    }
    r->z_up = least - 2; /* the farthest becomes 2^28 .. 2^30 */
    GN_UNROLL
    for (int k = 0; k < 3; k++) r->z[k] = (int32_t)(high[k] >> gn_min32(down[k] - r->z_up, 31));
}

/* Of v and of what is 2^s times it. */
GN_HOT static inline int32_t record_scaled(int32_t v, int32_t s)
{
    return s >= 0 ? (int32_t)((uint32_t)v << gn_min32(s, 31)) : v >> gn_min32(-s, 31);
}

GN_HOT int gn_record_places(const gn_patch_record *r, const gn_frame *frame, const gn_ray_plane *plane,
                            int32_t ray_shift, int32_t out_q16[3])
{
    const int32_t bits = GN_K(frame, subpixel_bits), up = 32 - ray_shift - r->z_up, most = 1 << 29;
    const int32_t px = 2 * r->x0 + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * r->y0;
    /* rays are of half pixels, and their sums below 2^31: those of corners from that of the record's pixel, modulo 2^32
     */
    const uint32_t ray = (uint32_t)plane->a0 + (uint32_t)plane->ax * (uint32_t)px + (uint32_t)plane->ay * (uint32_t)py;
    const uint32_t right = (uint32_t)(plane->ax >> (bits - 1)), below = 0U - (uint32_t)(plane->ay >> (bits - 1));
    const uint32_t from = ray - right * (uint32_t)r->off[0] - below * (uint32_t)r->off[1];
    const uint32_t at[3] = {from, from + right * (uint32_t)r->a[0] + below * (uint32_t)r->a[1],
                            from + right * (uint32_t)r->b[0] + below * (uint32_t)r->b[1]};
    uint32_t any = 0;
    if (plane->d_q16 < -most || plane->d_q16 > most) return 0;
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        const int32_t v = gn_mul_high(r->z[k], (int32_t)at[k]); /* 2^29 */
        any |= gn_abs32(v);
        out_q16[k] = (int32_t)((uint32_t)record_scaled(v, up) + (uint32_t)(int32_t)plane->d_q16);
    }
    return up <= 0 || (up < 29 && !(any >> (29 - up)));
}

/* near / Z is linear on the screen, and n . ray times a constant, n being the face's normal away from the viewer: n =
 * (F dx, -F dy, what it is in the picture's centre). */
GN_HOT void gn_record_face(const gn_patch_record *r, const gn_frame *frame, int32_t view_q14[3])
{
    int64_t out[3];
    const gn_tri *tri = r->tri;
    const int32_t focal = (int32_t)(frame->cam.focal2_px_q16 >> 1); /* F, Q16 */
    const int32_t x = 2 * r->x0 + 1 - frame->picture.width, y = 2 * r->y0 + 1 - frame->picture.height;
    out[0] = -((int64_t)tri->iz_dx * focal); /* 2^62 */
    out[1] = (int64_t)tri->iz_dy * focal;
    /* its bits above 32 are those of corner 0 */
    const int64_t iz = (int64_t)r->iz_q32[0] + (int32_t)(tri->iz_ref - r->iz_q32[0]);
    out[2] = ((int64_t)tri->iz_dx * x + (int64_t)tri->iz_dy * y - iz * 2) * 32768;
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
    const int32_t bits = GN_K(frame, subpixel_bits), x = 2 * r->x0 + 1 - frame->picture.width,
                  y = frame->picture.height - 1 - 2 * r->y0, focal2 = (int32_t)(frame->cam.focal2_px_q16 >> 16);
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

GN_HOT gn_patch_weights gn_record_weights(const gn_patch_record *r, const gn_frame *frame, int32_t x, int32_t y)
{
    const int32_t bits = GN_K(frame, subpixel_bits), qx = (x - r->x0) * (1 << bits) + r->off[0],
                  qy = (y - r->y0) * (1 << bits) + r->off[1];
    const uint32_t e1 = (uint32_t)(r->b[0] * qy - r->b[1] * qx), e2 = (uint32_t)(r->a[1] * qx - r->a[0] * qy);
    /* 0 up to the area: 16 bits each */
    gn_patch_weights w = {
        {(int32_t)((e1 << r->clz >> 16) * r->recip >> 16), (int32_t)((e2 << r->clz >> 16) * r->recip >> 16)}};
    if (!r->deep) return w;
    const uint32_t w1 = (uint32_t)w.of[0] * r->near_q14[0] >> 14, w2 = (uint32_t)w.of[1] * r->near_q14[1] >> 14,
                   all = 32768U - (uint32_t)(w.of[0] + w.of[1]) + w1 + w2; /* 2^14 .. 2^16 */
    const int32_t clz = gn_clz32(all);
    const uint32_t recip = recip_16(all << clz);
    w.of[0] = (int32_t)(w1 * recip >> (32 - clz));
    w.of[1] = (int32_t)(w2 * recip >> (32 - clz));
    return w;
}

GN_HOT void gn_record_span(const gn_patch_record *r, const gn_frame *frame, int32_t x, int32_t y, int32_t n,
                           gn_patch_span *out)
{
    const int32_t bits = GN_K(frame, subpixel_bits), one = 1 << bits, qx = (x - r->x0) * one + r->off[0],
                  qy = (y - r->y0) * one + r->off[1];
    /* edge functions, the area in all, and their steps to the right */
    int32_t e1 = r->b[0] * qy - r->b[1] * qx, e2 = r->a[1] * qx - r->a[0] * qy, e0 = (int32_t)r->area - e1 - e2;
    const int32_t d1 = -r->b[1] * one, d2 = r->a[1] * one, d0 = -d1 - d2;
    int32_t k1 = e1 + (n - 1) * d1, k2 = e2 + (n - 1) * d2, k0 = e0 + (n - 1) * d0, first = x, last = x + n - 1;
    while ((e0 -= d0, e1 -= d1, e2 -= d2, e0 | e1 | e2) >= 0) first--;
    while ((k0 += d0, k1 += d1, k2 += d2, k0 | k1 | k2) >= 0) last++;
    if (r->deep) { /* a piece of the row */
        first += (x - first) & -GN_PATCH_ROW_PX;
        last = gn_min32(last, first + GN_PATCH_ROW_PX - 1);
    }
    out->n = last - first + 1;
    out->at = x - first;
    out->ends[0] = gn_record_weights(r, frame, first, y);
    if (out->n > 1) out->ends[1] = gn_record_weights(r, frame, last, y);
}

#endif
