/* What arrives at a surface point from spot and point lights, and where their shadow maps see it (P2-P6, B6,
 * MODEL 6, 8). */
#ifndef GN_ARRIVAL_H
#define GN_ARRIVAL_H

#include "shade/gn_sample.h"

#define GN_FACE_NONE 6 /* nearer to the light than its near plane: lit */

/* Of all the surface's spot and point lights. */
void gn_arrivals_at(const gn_frame *frame, const gn_surface *surface, gn_sample *sample);

/* Irradiance of one, of a light whose colour is 1; `value` is its slot of a sample. *arrives: GN_ARRIVES_... */
uint32_t gn_arrival_irradiance_q24(const gn_frame *frame, const gn_light_state *light, const int32_t *value,
                                   int *arrives);

/* Where a view sees a point: from the light, and the receiver's offset, which B6 on flat surfaces replaces. Returns 0
 * if it is nearer than the near plane, GN_SEEN_OUTSIDE if B6 goes along the ray there instead of along the normal. */
int gn_arrival_place(const gn_frame *frame, const gn_surface *surface, const gn_light_view *view, int32_t z_q16,
                     const int32_t from_q16[3], const int32_t offset_q16[3], gn_arrival *out);

#endif
