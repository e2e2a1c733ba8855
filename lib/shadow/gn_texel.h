/* Texels of shadow maps, at 8, 16 or 32 bits. Depth is a fraction of the view's range, Q0.32 here. A stored texel is
 * its upper bits, rounded to nearest. All ones: empty. */
#ifndef GN_TEXEL_H
#define GN_TEXEL_H

#include <stddef.h>
#include <stdint.h>

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "gnomon.h"

#define GN_DEPTH_EMPTY_Q32 0xFFFFFFFFU

/* An atlas as its depth_bits name it. */
#define GN_TEXELS_OF(atlas, depth_bits) gn_texels_of((atlas).d8, (atlas).d16, (atlas).d32, (depth_bits))

GN_HOT static inline gn_texels gn_texels_of(uint8_t *d8, uint16_t *d16, uint32_t *d32, int32_t depth_bits)
{
    gn_texels texels;
    if (depth_bits == 8) texels.d8 = d8;
    else if (depth_bits == 16) texels.d16 = d16;
    else texels.d32 = d32;
    return texels;
}

GN_HOT static inline gn_texels gn_texels_at(gn_texels texels, int32_t depth_bits, size_t i)
{
    if (depth_bits == 8) texels.d8 += i;
    else if (depth_bits == 16) texels.d16 += i;
    else texels.d32 += i;
    return texels;
}

/* A stored texel, in the upper bits of 32. [A4] */
GN_HOT static inline uint32_t gn_texel_load(gn_texels row, int32_t depth_bits, size_t i)
{
    if (depth_bits == 8) return (uint32_t)row.d8[i] << 24;
    if (depth_bits == 16) return (uint32_t)row.d16[i] << 16;
    return row.d32[i];
}

/* The largest value a texel can hold, in the upper bits of 32: what empty texels compare as. */
GN_HOT static inline uint32_t gn_texel_far(int32_t depth_bits)
{
    return (uint32_t)(GN_DEPTH_EMPTY_Q32 << (32 - depth_bits));
}

/* Whether texels outside the tile are lit. [D10] [D12] */
GN_HOT static inline int gn_border_lit(const gn_light_view *view)
{
    return GN_TIGHT(view) || (GN_MAIN_LIGHT && view->border_lit);
}

/* Whether all between two places lie beyond the tile of a tight fit: nothing casts there. */
GN_HOT static inline int gn_beyond_tile(const gn_light_view *view, int32_t u_lo_q16, int32_t u_hi_q16, int32_t v_lo_q16,
                                        int32_t v_hi_q16)
{
    return GN_TIGHT(view) &&
           ((u_hi_q16 | v_hi_q16) < 0 || u_lo_q16 >> 16 >= view->tile_texels || v_lo_q16 >> 16 >= GN_TILE_ROWS(view));
}

#if GN_CHANGES
/* Notes the squares of w x h texels from (u, v) on, which may lie outside the tile: those at its border, then. [R13] */
void gn_note_texels(gn_squares *squares, const gn_light_view *view, int32_t u, int32_t v, int32_t w, int32_t h);
#define GN_NOTE_TEXELS(squares, view, u, v, w, h) gn_note_texels(squares, view, u, v, w, h)
#else
#define GN_NOTE_TEXELS(squares, view, u, v, w, h) ((void)0)
#endif

/* ---- Rows of texels of 16 bits that are compared at once --------------------------------------------------------- */

/* Texels of a row of 16 bits before depths that grow by `step`: bit i for texel i, n > 0. */
GN_INLINE uint32_t gn_texels_before(const uint16_t *texel, int32_t n, int32_t depth_q30, int32_t step_q30)
{
    const uint16_t *at = texel + (n & ~3);
    uint32_t near = 0, step = (uint32_t)step_q30, depth = (uint32_t)depth_q30 + (uint32_t)n * step;
    switch (n & 3) { /* each goes on with those after it */
    case 3:
        near = gn_borrow(near, (uint32_t)at[2] << 14, depth -= step);
        GN_GOES_ON;
    case 2:
        near = gn_borrow(near, (uint32_t)at[1] << 14, depth -= step);
        GN_GOES_ON;
    case 1:
        near = gn_borrow(near, (uint32_t)at[0] << 14, depth -= step);
        GN_GOES_ON;
    default:
        break;
    }
    while (at != texel) {
        at -= 4;
        GN_KEEP(at); /* one pointer */
        near = gn_borrow(near, (uint32_t)at[3] << 14, depth -= step);
        near = gn_borrow(near, (uint32_t)at[2] << 14, depth -= step);
        near = gn_borrow(near, (uint32_t)at[1] << 14, depth -= step);
        near = gn_borrow(near, (uint32_t)at[0] << 14, depth -= step);
    }
    return near;
}

/* ---- Bounds of shadow depth over blocks of texels, for views with the disk filter -------------------------------- */

/* They decide most of its lookups without a single compare of texels. Other filters read so few texels that bounds
 * cost more than they save.  For each block of 8x8 texels: the smallest and largest stored depth over that block and
 * its neighbours to the right, below and diagonally, i.e. over 16x16 texels. For any texel of a block, the block's
 * bounds are valid for the 9x9 texels from that texel on; larger footprints read several blocks. If the receiver is
 * in front of the smallest depth, or behind the largest, the result is exactly 1 or 0: the picture is the same with
 * and without blocks (a test compares). 4 bytes per 64 texels.  Bounds are the upper 16 bits of a depth of 32: lo <<
 * 16 .. hi << 16 | 0xFFFF contain every texel of 32 bits, and those of 8 and 16 bits lie in lo << 16 .. hi << 16,
 * see gn_block_highest(). */

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
