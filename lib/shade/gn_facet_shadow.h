/* Parts of gn_facet: shadows on small triangles, whose vertices are placed in the shadow map (NUMERICS 4.17). */
#ifndef GN_FACET_SHADOW_H
#define GN_FACET_SHADOW_H

#include "shade/gn_facet_punctual.h"
#include "shade/gn_facet_screen.h"

#if GN_INTERPOLATES

/* GN_CELL_LIT, _DARK or _EDGE, which is set then; GN_CELL_SPLIT if it cannot be told. `vertices`: of spot and point
 * lights. */
int gn_facet_shadow(gn_shading *s, gn_facet_screen *screen, const gn_facet_vertices *vertices, int32_t n_px,
                    uint32_t slot, gn_facet_edge *edge);

/* Attenuation of n <= 16 pixels from (x, y) of the picture on. */
void gn_facet_attenuation(const gn_shading *s, const gn_facet_screen *screen, const gn_facet_edge *edge, int32_t x,
                          int32_t y, int32_t n, uint32_t *out);

#endif

#endif
