/* Groups of triangles: which screen tiles they meet. See gn_tri_group. */
#ifndef GN_GROUP_H
#define GN_GROUP_H

#include "gnomon.h"

/* Columns x0 .. x1 and rows y0 .. y1 of screen tiles, below 128. */
static inline gn_tri_group gn_group_of(uint32_t x0, uint32_t x1, uint32_t y0, uint32_t y1)
{
    return x0 | (127 - x1) << 8 | y0 << 16 | (127 - y1) << 24;
}

/* Bit 7 of every byte of `a` that is at most that of `b`. */
static inline uint32_t gn_group_at_most(gn_tri_group a, gn_tri_group b)
{
    return ((b | 0x80808080U) - a) & 0x80808080U;
}

/* All tiles between those of both: the smaller byte. */
static inline gn_tri_group gn_group_union(gn_tri_group a, gn_tri_group b)
{
    const uint32_t from_a = (gn_group_at_most(a, b) >> 7) * 127;
    return (a & from_a) | (b & ~from_a);
}

/* Whether a group meets a screen tile, given as one group_of of it alone. */
static inline int gn_group_meets(gn_tri_group group, gn_tri_group tile)
{
    return gn_group_at_most(group, tile) == 0x80808080U;
}

#endif
