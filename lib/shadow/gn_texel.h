/* Texels of shadow maps, at 8, 16 or 32 bits. Depth is a fraction of the view's range, Q0.32 here. A stored texel is
 * its upper bits, rounded to nearest. All ones: empty. */
#ifndef GN_TEXEL_H
#define GN_TEXEL_H

#include <stddef.h>

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

#endif
