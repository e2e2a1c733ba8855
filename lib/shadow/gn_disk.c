/* The rotated disk. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_texel.h"

#define DISK_RADIUS_MAX_Q16 (8 << 16)

GN_HOT static uint16_t rotation_turn(int32_t pixel_x, int32_t pixel_y)
{
    uint32_t v = ((uint32_t)pixel_x * 0x8DA6B343U) ^ ((uint32_t)pixel_y * 0xD8163841U);
    v = (v ^ (v >> 15)) * 0x2C1B3C6DU;
    v ^= v >> 13;
    return (uint16_t)(v >> 16);
}

/* Samples of the disk that are lit. Offsets have 27 fraction bits: a radius and a rotation in Q12 (|.| <= 2^15 + 1)
 * times a point in Q15 (|.| <= 2^15 + 1) stay below 2^30.1, plus a fraction of a texel. They err by at most 2^-12.5
 * texels by the rotation's rounding and radius * 2^-15.5 by the table's: below 2^-11 together. */
GN_HOT static GN_NOINLINE uint32_t count_lit(const gn_lookup *l, uint32_t n_samples, int32_t radius_q16,
                                             const gn_receiver *receiver)
{
    const uint16_t turn = rotation_turn(receiver->pixel_x, receiver->pixel_y);
    int32_t c_q12 = gn_mul_shr(radius_q16, gn_cos_q30(turn), 34), s_q12 = gn_mul_shr(radius_q16, gn_sin_q30(turn), 34);
    int32_t u = l->u_q16 >> 16, fu_q27 = (l->u_q16 & 0xFFFF) << 11;
    int32_t v = l->v_q16 >> 16, fv_q27 = (l->v_q16 & 0xFFFF) << 11;
    const int16_t *point_q15 = gn_disk_table_q15;
    uint32_t n_lit = 0;
    for (uint32_t i = 0; i < n_samples; i++, point_q15 += 2) {
        int32_t x = point_q15[0], y = point_q15[1];
        n_lit += gn_lookup_tap(l, u + ((fu_q27 + c_q12 * x - s_q12 * y) >> 27),
                               v + ((fv_q27 + s_q12 * x + c_q12 * y) >> 27));
    }
    return n_lit;
}

/* The smallest and largest `least` over n x n texels from (u, v) on. */
GN_HOT static void least_over(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint32_t *smallest,
                              uint32_t *largest)
{
    *smallest = *largest = l->least;
    if (!GN_PLANES || !l->sloped) return;
    int32_t last = l->view->tile_texels - 1, last_row = GN_TILE_ROWS(l->view) - 1;
    int32_t u0 = gn_max32(0, gn_min32(u, last)), v0 = gn_max32(0, gn_min32(v, last_row));
    int64_t lo, hi;
    gn_plane_range(l, u0, v0, gn_max32(0, gn_min32(u + n - 1, last)) - u0,
                   gn_max32(0, gn_min32(v + n - 1, last_row)) - v0, &lo, &hi);
    *smallest = gn_limited_depth(l->view, lo);
    *largest = gn_limited_depth(l->view, hi);
}

/* Whether bounds decide the attenuation of all n x n <= 18 x 18 texels from (u, v) on, 0 or 65536. */
GN_HOT static int bounds_decide(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint32_t *answer)
{
    uint32_t smallest, largest;
    least_over(l, u, v, n, &smallest, &largest);
    return gn_blocks_decide(l->view, u, v, n, smallest, largest, answer);
}

/* The footprint is widened by what samples err before its bounds are read. [F4] */
GN_HOT uint32_t gn_disk_attenuation(const gn_frame *frame, const gn_lookup *l, const gn_receiver *receiver)
{
    const uint32_t n_samples = frame->scene->shadow.disk_samples;
    uint32_t answer;
    int32_t radius_q16 = gn_max32(0, gn_min32(l->view->disk_radius_q16, DISK_RADIUS_MAX_Q16)),
            reach_q16 = radius_q16 + 32;
    if (bounds_decide(l, (l->u_q16 - reach_q16) >> 16, (l->v_q16 - reach_q16) >> 16, (2 * reach_q16 >> 16) + 2,
                      &answer))
        return answer;
    GN_COUNT(undecided, 1);
    return ((count_lit(l, n_samples, radius_q16, receiver) << 16) + n_samples / 2) / n_samples;
}

/* ---- Bounds of shadow depth over blocks of texels ---------------------------------------------------------------- */

GN_HOT void gn_blocks_find(gn_frame *frame, gn_light_view *view)
{
    uint32_t first = view->first_texel / 64;
#if GN_OTHER_ATLAS
    view->block = view->in_other ? frame->other_block + first : frame->block + first;
#else
    view->block = frame->block + first;
#endif
}

GN_HOT static void widen_block(gn_depth_block *block, const gn_depth_block *other)
{
    if (other->lo < block->lo) block->lo = other->lo;
    if (other->hi > block->hi) block->hi = other->hi;
}

/* Bounds of the 8 texels from u on. Every caller passes depth_bits as a constant: a loop for each. */
GN_HOT static inline gn_depth_block eight(gn_texels row, int32_t depth_bits, size_t u)
{
    uint32_t lo = gn_texel_load(row, depth_bits, u), hi = lo;
    for (size_t i = u + 1; i < u + 8; i++) {
        uint32_t depth = gn_texel_load(row, depth_bits, i);
        if (depth < lo) lo = depth;
        if (depth > hi) hi = depth;
    }
    gn_depth_block block = {(uint16_t)(lo >> 16), (uint16_t)(hi >> 16)};
    return block;
}

GN_HOT static gn_depth_block bounds_of(const gn_light_view *view, size_t first)
{
    gn_depth_block block = {65535, 0};
    int32_t bits = GN_VIEW_BITS(view);
    for (int v = 0; v < 8; v++, first += view->tile_texels) {
        gn_depth_block row;
        if (bits == 16) row = eight(view->depth, 16, first);
        else if (bits == 8) row = eight(view->depth, 8, first);
        else row = eight(view->depth, 32, first);
        widen_block(&block, &row);
    }
    return block;
}

GN_HOT static void set_all(const gn_light_view *view, uint16_t lo, uint16_t hi)
{
    const gn_depth_block block = {lo, hi};
    uint32_t n = (uint32_t)(view->tile_texels >> 3) * (uint32_t)(GN_TILE_ROWS(view) >> 3);
    for (uint32_t i = 0; i < n; i++) view->block[i] = block;
}

GN_HOT void gn_blocks_clear(const gn_light_view *view)
{
    uint16_t empty = (uint16_t)(gn_texel_far(GN_VIEW_BITS(view)) >> 16);
    set_all(view, empty, empty);
}

GN_HOT void gn_blocks_build(gn_light_view *view)
{
    set_all(view, 65535, 0);
    gn_blocks_build_touched(view);
}

GN_HOT void gn_blocks_build_touched(gn_light_view *view)
{
    uint32_t n = view->tile_texels >> 3, n_rows = (uint32_t)GN_TILE_ROWS(view) >> 3;
    gn_depth_block *block = view->block;
    for (uint32_t v = 0; v < n_rows; v++)
        for (uint32_t u = 0; u < n; u++, block++)
            if (!block->hi) *block = bounds_of(view, 8 * ((size_t)v * view->tile_texels + u));
    /* widens in place, along rows and then along columns: each block reads its neighbour before that is widened */
    block = view->block;
    for (uint32_t v = 0; v < n_rows; v++, block++)
        for (uint32_t u = 1; u < n; u++, block++) widen_block(block, block + 1);
    block = view->block;
    for (uint32_t i = n; i < n * n_rows; i++, block++) widen_block(block, block + n);
}

GN_HOT const gn_depth_block *gn_blocks_at(const gn_light_view *view, int32_t u, int32_t v)
{
    int32_t last = view->tile_texels - 1, last_row = GN_TILE_ROWS(view) - 1;
    u = u < 0 ? 0 : u > last ? last : u;
    v = v < 0 ? 0 : v > last_row ? last_row : v;
    return gn_blocks_inside(view, u, v);
}

GN_HOT gn_depth_block gn_blocks_over(const gn_light_view *view, int32_t u, int32_t v, int32_t n)
{
    gn_depth_block bounds = *gn_blocks_at(view, u, v);
    if (n > GN_BLOCK_REACH) {
        widen_block(&bounds, gn_blocks_at(view, u + n - GN_BLOCK_REACH, v));
        widen_block(&bounds, gn_blocks_at(view, u, v + n - GN_BLOCK_REACH));
        widen_block(&bounds, gn_blocks_at(view, u + n - GN_BLOCK_REACH, v + n - GN_BLOCK_REACH));
    }
    return bounds;
}
