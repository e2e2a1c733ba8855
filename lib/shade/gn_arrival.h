/* What arrives at a surface point from spot and point lights, and where their shadow maps see it (P2-P6, B6,
 * DESIGN 1.6, 1.8). */
#ifndef GN_ARRIVAL_H
#define GN_ARRIVAL_H

#include "shade/gn_sample.h"

#define GN_FACE_NONE 6 /* nearer to the light than its near plane: lit */

/* Of all the surface's spot and point lights. */
void gn_arrivals_at(const gn_frame *frame, const gn_surface *surface, gn_sample *sample);

/* From sample a to sample b, n > 1 pixels further on, along a chord that is set: what arrives in between, as parabolas
 * through three points, for every light for which that is close enough (NUMERICS 4.13). The others keep to the chord,
 * which ends before the others. */
void gn_arrivals_between(gn_chord *chord, const gn_frame *frame, const gn_surface *surface, gn_sample *a,
                         const gn_sample *b, int32_t n);

/* One pixel further on; the sample's values already are. */
void gn_arrivals_next(gn_chord *chord, const gn_frame *frame, const gn_surface *surface, gn_sample *sample);

#endif
