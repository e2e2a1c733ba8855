/* Lighting of one surface point (MODEL 3). */
#ifndef GN_LIGHT_H
#define GN_LIGHT_H

#include "shade/gn_sample.h"

/* Shadow factor of a light at a sample: 0..65536, 65536 where it casts none; 0 where the surface faces away or no light
 * arrives. */
uint32_t gn_light_shadow(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t light_idx);

/* Radiance towards the viewer, Q20 per channel, not clamped to 1. */
void gn_light_radiance(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                       uint32_t radiance_q20[3]);

/* Times the colours of vertices and texture, with what the surface emits: of a sample's values, Q20. */
void gn_light_modulate(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint64_t sum_q20[3]);

/* The highlight of the light in a slot of the surface's list, Q24, if its specular colour is 1; and the half vector
 * minus the normal. */
uint32_t gn_light_highlight(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t slot,
                            int32_t lobe_q30[3]);

#endif
