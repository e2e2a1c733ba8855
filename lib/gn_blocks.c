/* Bounds of shadow depth over blocks of texels. */
#include "gn_blocks.h"
#include "gn_q.h"

#if GN_SHADOWS && GN_DEPTH_BLOCKS

static void widen(gn_depth_block *block, const gn_depth_block *other)
{
    if (other->lo < block->lo) block->lo = other->lo;
    if (other->hi > block->hi) block->hi = other->hi;
}

static gn_depth_block bounds_of(const gn_light_view *view, int32_t bu, int32_t bv)
{
    gn_depth_block block = {65535, 0};
    for (int32_t v = 0; v < 8; v++) {
        const uint16_t *row = view->depth + ((size_t)(uint32_t)(8 * bv + v) << view->tile_log2) + 8 * bu;
        for (int32_t u = 0; u < 8; u++) {
            if (row[u] < block.lo) block.lo = row[u];
            if (row[u] > block.hi) block.hi = row[u];
        }
    }
    return block;
}

void gn_blocks_build(gn_light_view *view)
{
    int32_t n = view->tile_texels >> 3;
    for (int32_t v = 0; v < n; v++)
        for (int32_t u = 0; u < n; u++) view->block[v * n + u] = bounds_of(view, u, v);
    /* widen in place: each block still finds its right and lower neighbours as they were */
    for (int32_t v = 0; v < n; v++) {
        for (int32_t u = 0; u < n; u++) {
            gn_depth_block *block = &view->block[v * n + u];
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

#endif
