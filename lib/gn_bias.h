/* Receiver bias (B2, B3, DESIGN 1.7). */
#ifndef GN_BIAS_H
#define GN_BIAS_H

#include "gnomon.h"

#if GN_SHADOWS

#define GN_DISK_INDEX_MAX 8 /* largest filter index of the disk */

/* nu of DESIGN 1.4: how far a light's receiver bias can move a point across the light's axis, in texels per (k + 1), Q16. */
int32_t gn_bias_reach_q16(const gn_light *light);

/* How far a light's receiver is moved, for the interpolated normal as it is: in texels along the view's axes, Q16; the same in every
 * cascade whose filter index is the same. */
void gn_bias_directional(const gn_frame *frame, const gn_light_view *view, const int32_t n_q30[3], int32_t out_q16[3]);

#if GN_PUNCTUAL_LIGHTS
/* For spot and point lights: along the world's axes in its units, Q16. `from_q16` is the surface point minus the light. */
void gn_bias_punctual(const gn_frame *frame, const gn_light_state *light, const int32_t n_q30[3], const int32_t from_q16[3],
                      int32_t out_q16[3]);
#endif

#endif
#endif
