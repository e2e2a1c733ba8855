/* Percentage-closer filtering (F1-F3, DESIGN 1.6). */
#ifndef GN_FILTER_H
#define GN_FILTER_H

#include "gnomon.h"

#if GN_SHADOWS

#define GN_TENT_TAPS_MAX 8

/* Weights of the 2 (k + 1) texels of a tent along one axis, k = 1, 2, 3: exact rationals over (2k + 1)^2 F^2, which they sum to.
 * u = F * frac(centre + 1/2), 0 <= u <= F, F = 2^weight_bits <= 4096: everything stays below 2^30. */
void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits);

/* Attenuation 0 (shadowed) .. 65536 (lit) at tile coordinates in texels, Q16. Texels outside the tile repeat its border. */
uint32_t gn_filter_attenuation(const gn_frame *frame, const gn_light_view *view, int32_t u_q16, int32_t v_q16, int32_t d_q16);

#endif
#endif
