/* Bounds of shadow depth over blocks of texels. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "shadow/gn_blocks.h"
#include "shadow/gn_texel.h"

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
