/* Edges finer than texels (F7): the outline of what shadows is found between texels, from their compares with the
 * receiver's plane. Where a texel's neighbour has another answer, the run of such texels along that side says where the
 * outline passes through it: from half a texel inside to half a texel outside, as the run's ends step. */
#ifndef GN_EDGE_H
#define GN_EDGE_H

#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "gnomon.h"

#if GN_EDGE_BUILT

/* Texels of three rows, a bit each that keeps the receiver dark: bits that are set in the result are those whose texel
 * of the middle row has a neighbour with another answer. */
GN_HOT static inline uint32_t gn_edge_texels(uint32_t above, uint32_t row, uint32_t below)
{
    return (row ^ above) | (row ^ below) | (row ^ row << 1) | (row ^ row >> 1);
}

/* Attenuation 0 .. 65536, of the hard filter one of both, of a receiver at (u, v), whose fractions count: bit s of row
 * 0 is its texel. Read are n = GN_K(frame, edge) texels before and after it in rows -1 .. 1, and of n rows before and
 * after those the three in the middle; but for sides whose texels are alike. */
uint32_t gn_edge_attenuation(const uint32_t *row, int32_t s, int32_t n, int32_t u_q16, int32_t v_q16, int hard);

#endif

#endif
