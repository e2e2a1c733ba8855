/* Colours along a row of a cell's nodes: parts of gn_lattice_draw. */
#ifndef GN_LATTICE_ROW_H
#define GN_LATTICE_ROW_H

#include "base/gn_q.h"
#include "shade/gn_lattice_look.h"
#include "shade/gn_shade_types.h"

#if GN_INTERPOLATES

/* Of the first node, and steps between them. */
typedef struct {
    int32_t from[3], step[3];
} gn_node_row;

/* Adds what is bilinear over the cell, `below` pixels under its first row. */
GN_INLINE void gn_row_add(const gn_drawing *d, const gn_flat_patch colour_q24[3], int32_t below, gn_node_row *row)
{
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        const gn_flat_patch *p = &colour_q24[c];
        row->from[c] += gn_flat_patch_at(p, d->first, below);
        row->step[c] += p->dx + below * p->dxy;
    }
}

/* Sets the nodes before `end`. */
GN_INLINE void gn_row_put(const gn_node_row *row, int32_t (*node)[3], int32_t (*const end)[3])
{
    int32_t r = row->from[0], g = row->from[1], b = row->from[2];
    for (; node < end; node++, r += row->step[0], g += row->step[1], b += row->step[2]) {
        (*node)[0] = r;
        (*node)[1] = g;
        (*node)[2] = b;
    }
}

#if GN_SHADOWS
/* Adds an edge's light, twice of which is r, g, b, to a node. */
GN_INLINE void gn_node_add(int32_t node[3], uint32_t share_uq16, int32_t r, int32_t g, int32_t b)
{
    if (share_uq16 == 65536) {
        node[0] += r >> 1;
        node[1] += g >> 1;
        node[2] += b >> 1;
    } else if (share_uq16) {
        node[0] += gn_mul_half_share(r, share_uq16);
        node[1] += gn_mul_half_share(g, share_uq16);
        node[2] += gn_mul_half_share(b, share_uq16);
    }
}

/* Twice the light of an edge along a row of nodes: light and highlight, 2^27 each where gn_corner_times() limits them:
 * -2^27 .. 2^28 at the corners; doubled, one node beyond the cell, below 2^30.4. */
GN_INLINE gn_node_row gn_row_of_edge(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below)
{
    gn_node_row twice = {{0, 0, 0}, {0, 0, 0}};
    gn_row_add(d, edge->more_q24, below, &twice);
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        twice.from[c] *= 2;
        twice.step[c] *= 2;
    }
    return twice;
}
#endif

#endif

#endif
