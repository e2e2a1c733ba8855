/* Receiver bias (B2, B3, DESIGN 1.7). */
#ifndef GN_BIAS_H
#define GN_BIAS_H

#include "gnomon.h"

#if GN_SHADOWS

#define GN_DISK_INDEX_MAX 8 /* largest filter index of the disk */

/* nu of DESIGN 1.4: how far a light's receiver bias can move a point across the light's axis, in texels per (k + 1), Q16. */
int32_t gn_bias_reach_q16(const gn_light *light);

/* The receiver's offset in texels, Q16: along * N + towards * L. */
typedef struct {
    int32_t along_q16, towards_q16;
} gn_bias;

/* N . L of the interpolated normal as it is, Q30; only the four-term bias needs it. */
gn_bias gn_bias_at(const gn_light_view *view, const gn_light *light, int32_t n_dot_l_q30);

#endif
#endif
