/* Parts of gn_facet: spot and point lights at the vertices of small triangles (NUMERICS 4.17). */
#ifndef GN_FACET_PUNCTUAL_H
#define GN_FACET_PUNCTUAL_H

#include "gnomon.h"

#if GN_INTERPOLATES && GN_PUNCTUAL_LIGHTS

/* Returns 0 if a vertex lies beyond the reach of 32 bits. `turn_q28`: squares of what normals differ by. */
int gn_facet_vertices_find(gn_facet_vertices *out, const gn_frame *frame, const gn_surface *surface,
                           const uint32_t turn_q28[3]);

/* A light at the vertices. */
typedef struct {
    int32_t irradiance_q24[3]; /* if its colour is 1; below 0 where it comes from behind */
    int32_t rim_q20[3];        /* how far a vertex is from the edge of a spot's cone to where its rim ends, */
    int has_rim;               /* which is asked for: that, limited to 0 .. 1 and squared, is to be multiplied */
    uint32_t error_q24;        /* how far what is linear in between is off at most */
} gn_facet_lamp;

/* `base_q24` is the light that there is without this one, of the brightest channel. `size_log2` is the screen's.
 * GN_CELL_DARK: none arrives anywhere; GN_CELL_SPLIT: it is not close to linear. */
int gn_facet_punctual(gn_shading *s, const gn_facet_vertices *vertices, uint32_t slot, int32_t base_q24,
                      int32_t size_log2, gn_facet_lamp *out);

#endif

#endif
