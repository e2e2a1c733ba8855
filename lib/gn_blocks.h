/* Bounds of shadow depth over blocks of texels, so that most filter lookups are decided without a single compare of texels.
 *
 * For each block of 8x8 texels: the smallest and largest stored depth over that block and its neighbours to the right, below
 * and diagonally, i.e. over 16x16 texels. A filter reads at most 8 texels per axis: whatever block its first texel lies in, that
 * block's bounds hold for all it reads. If the receiver is in front of the smallest, or behind the largest, the answer is
 * exactly 1 or 0: the picture is the same with and without (a test compares). 4 bytes per 64 texels.
 */
#ifndef GN_BLOCKS_H
#define GN_BLOCKS_H

#include "gnomon.h"

#if GN_SHADOWS && GN_DEPTH_BLOCKS

/* Rebuilds the bounds of a finished tile. */
void gn_blocks_build(gn_light_view *view);

/* Bounds over the texels u .. u + 7, v .. v + 7, where texels outside the tile repeat its border. */
const gn_depth_block *gn_blocks_at(const gn_light_view *view, int32_t u, int32_t v);

#endif
#endif
