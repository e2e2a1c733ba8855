/* Shadow of one light at a sample: lookup, blending of cascades, mixing with baked masks (DESIGN 1.4, 1.7, 1.9). */
#ifndef GN_SHADOW_H
#define GN_SHADOW_H

#include "shade/gn_sample.h"

/* g of DESIGN 1.4: the strength of realtime shadows at this distance, 0..65536; the same for every light. */
uint32_t gn_shadow_distance(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample);

/* Shadow factor of the light in a slot of the surface's list, 0..65536; 65536: it casts none. */
uint32_t gn_shadow_factor(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t slot,
                          uint32_t g_uq16);

#endif
