/* Bounds of shadow depth over blocks of texels, for views with the disk filter: they decide most of its lookups
 * without a single compare of texels. Other filters read so few texels that bounds cost more than they save.
 *
 * For each block of 8x8 texels: the smallest and largest stored depth over that block and its neighbours to the right,
 * below and diagonally, i.e. over 16x16 texels. For any texel of a block, the block's bounds are valid for the 9x9
 * texels from that texel on; larger footprints read several blocks. If the receiver is in front of the smallest depth,
 * or behind the largest, the result is exactly 1 or 0: the picture is the same with and without blocks (a test
 * compares). 4 bytes per 64 texels.
 *
 * Bounds are the upper 16 bits of a depth of 32: lo << 16 .. hi << 16 | 0xFFFF contain every texel of 32 bits, and
 * those of 8 and 16 bits lie in lo << 16 .. hi << 16, see gn_block_highest().
 */
#ifndef GN_BLOCKS_H
#define GN_BLOCKS_H

#include "shadow/gn_texel.h"
#include "gnomon.h"

/* Whether a view has bounds. */
#define GN_HAS_BLOCKS(view) (GN_DISK_FILTER && (view)->filter == GN_FILTER_DISK)

#define GN_BLOCK_REACH 9 /* texels per axis for which one block's bounds are valid */

#if GN_DISK_FILTER
/* Sets the view's pointer to its blocks; its tile in the atlas is known. */
void gn_blocks_find(gn_frame *frame, gn_light_view *view);

void gn_blocks_build(gn_light_view *view);

/* The same for a tile that was cleared and whose spans were marked since: unmarked blocks are empty. */
void gn_blocks_clear(const gn_light_view *view);
void gn_blocks_build_touched(gn_light_view *view);

/* Marks the blocks of n > 0 texels from (u, v) on, by impossible bounds. */
GN_HOT static inline void gn_blocks_touch(const gn_light_view *view, int32_t u, int32_t v, int32_t n)
{
    gn_depth_block *row = view->block + (v >> 3) * (view->tile_texels >> 3);
    for (int32_t b = u >> 3; b <= (u + n - 1) >> 3; b++) row[b].hi = 0;
}

/* Bounds over the texels u .. u + 8, v .. v + 8. */
GN_HOT static inline const gn_depth_block *gn_blocks_inside(const gn_light_view *view, int32_t u, int32_t v)
{
    return &view->block[(v >> 3) * (view->tile_texels >> 3) + (u >> 3)];
}

/* The same where texels outside the tile repeat its border. */
const gn_depth_block *gn_blocks_at(const gn_light_view *view, int32_t u, int32_t v);

/* The same over n x n texels, n <= 18. */
gn_depth_block gn_blocks_over(const gn_light_view *view, int32_t u, int32_t v, int32_t n);

/* No texel is above it: in the upper bits of 32, as gn_texel_load() returns them. */
GN_HOT static inline uint32_t gn_block_highest(const gn_depth_block *block, int32_t depth_bits)
{
    return (uint32_t)block->hi << 16 | (depth_bits > 16 ? 0xFFFFU : 0U);
}

/* Whether the bounds over n x n texels, n <= 18, decide the attenuation of receivers with compare depths min .. max: 0
 * or 65536. */
GN_HOT static inline int gn_blocks_decide(const gn_light_view *view, int32_t u, int32_t v, int32_t n, uint32_t least,
                                          uint32_t most, uint32_t *attenuation)
{
    gn_depth_block bounds = n <= GN_BLOCK_REACH ? *gn_blocks_at(view, u, v) : gn_blocks_over(view, u, v, n);
    *attenuation = 65536;
    if (most <= (uint32_t)bounds.lo << 16) return 1;
    *attenuation = 0;
    if (least <= gn_block_highest(&bounds, GN_VIEW_BITS(view))) return 0;
    return !gn_border_lit(view) || (u >= 0 && v >= 0 && u + n <= view->tile_texels && v + n <= GN_TILE_ROWS(view));
}
#endif

#endif
