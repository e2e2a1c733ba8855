/* Lights as surfaces see them, and which object each of them reaches. */
#ifndef GN_LIGHTS_H
#define GN_LIGHTS_H

#include "gnomon.h"

/* Fills frame->light, but for its shadows, and frame->object. GN_ERR_SURFACE_LIGHTS if more lights reach an object than
 * the configuration has room for. */
gn_status gn_lights_setup(gn_frame *frame);

/* Whether a light reaches the object: directional lights always do. */
int gn_light_reaches(const gn_frame *frame, uint32_t light_idx, uint32_t object_idx);

#endif
