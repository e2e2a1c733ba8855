/* Edges finer than texels (F7): the outline of what shadows is found between texels, from their compares with the
 * receiver's plane. Where a texel's neighbour has another answer, the run of such texels along that side says where the
 * outline passes through it: from half a texel inside to half a texel outside, as the run's ends step. */
#ifndef GN_EDGE_H
#define GN_EDGE_H

#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "gnomon.h"

#if GN_EDGE_BUILT

/* Texels around that of a receiver, a bit each, set where they keep it dark: bit n + k of row[1 + r] lies k columns and
 * r rows after it, of column[1 + c] k rows and c columns. n: GN_K(frame, edge). Sides that do not differ are not read.
 */
typedef struct {
    uint32_t row[3], column[3];
} gn_edge_texels;

enum { GN_EDGE_ROWS = 1, GN_EDGE_COLUMNS = 2 };

/* Which of the texels are read, by the one of the receiver and its neighbours: bit 1 of `row` is its own, those before
 * and after it lie beside it; 0: all five are alike. */
GN_HOT static inline int gn_edge_reads(uint32_t above, uint32_t row, uint32_t below)
{
    uint32_t own = row >> 1 & 1U;
    return ((above & 1U) != own || (below & 1U) != own ? GN_EDGE_ROWS : 0) |
           ((row & 1U) != own || (row >> 2 & 1U) != own ? GN_EDGE_COLUMNS : 0);
}

/* Attenuation 0 .. 65536: of the hard filter one of both. u, v: the receiver, whose fractions count. */
uint32_t gn_edge_attenuation(const gn_edge_texels *texels, int reads, int32_t n, int32_t u_q16, int32_t v_q16,
                             int hard);

#endif

#endif
