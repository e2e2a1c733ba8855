/* Bounds of shadow depth over blocks of texels. */
#include "gn_blocks.h"
#include "gn_q.h"
#include "gn_texel.h"

#if GN_SHADOWS && GN_DEPTH_BLOCKS

static void widen(gn_depth_block *block, const gn_depth_block *other)
{
    if (other->lo < block->lo) block->lo = other->lo;
    if (other->hi > block->hi) block->hi = other->hi;
}

/* Bounds of the 8 texels from u on. Every caller passes depth_bits as a constant: a loop for each. */
static inline gn_depth_block eight(gn_texels row, int32_t depth_bits, size_t u)
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

/* Widens a row of blocks by a row of texels. */
static inline void take_row(gn_depth_block *block, gn_texels row, int32_t depth_bits, uint32_t n)
{
    for (uint32_t b = 0; b < n; b++) {
        gn_depth_block here = eight(row, depth_bits, 8 * (size_t)b);
        widen(&block[b], &here);
    }
}

static void bound_texels(gn_light_view *view, uint32_t n)
{
    static const gn_depth_block nothing = {65535, 0};
    int32_t bits = GN_VIEW_BITS(view);
    gn_texels row = view->depth;
    for (uint32_t v = 0; v < 8 * n; v++) {
        gn_depth_block *block = view->block + (size_t)(v >> 3) * n;
        if (!(v & 7U))
            for (uint32_t b = 0; b < n; b++) block[b] = nothing;
        if (bits == 16) take_row(block, row, 16, n);
        else if (bits == 8) take_row(block, row, 8, n);
        else take_row(block, row, 32, n);
        row = gn_texels_at(row, bits, view->tile_texels);
    }
}

void gn_blocks_build(gn_light_view *view)
{
    uint32_t n = view->tile_texels >> 3;
    bound_texels(view, n);
    /* widen in place: each block still finds its right and lower neighbours as they were */
    gn_depth_block *block = view->block;
    for (uint32_t v = 0; v < n; v++) {
        for (uint32_t u = 0; u < n; u++, block++) {
            if (u + 1 < n) widen(block, block + 1);
            if (v + 1 < n) widen(block, block + n);
            if (u + 1 < n && v + 1 < n) widen(block, block + n + 1);
        }
    }
}

const gn_depth_block *gn_blocks_at(const gn_light_view *view, int32_t u, int32_t v)
{
    int32_t last = view->tile_texels - 1;
    u = u < 0 ? 0 : u > last ? last : u;
    v = v < 0 ? 0 : v > last ? last : v;
    return &view->block[((v >> 3) << (view->tile_log2 - 3)) + (u >> 3)];
}

gn_depth_block gn_blocks_over(const gn_light_view *view, int32_t u, int32_t v, int32_t n)
{
    gn_depth_block bounds = *gn_blocks_at(view, u, v);
    if (n > GN_BLOCK_REACH) {
        widen(&bounds, gn_blocks_at(view, u + n - GN_BLOCK_REACH, v));
        widen(&bounds, gn_blocks_at(view, u, v + n - GN_BLOCK_REACH));
        widen(&bounds, gn_blocks_at(view, u + n - GN_BLOCK_REACH, v + n - GN_BLOCK_REACH));
    }
    return bounds;
}

#endif
