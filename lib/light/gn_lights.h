/* Light states, and which object each light affects. */
#ifndef GN_LIGHTS_H
#define GN_LIGHTS_H

#include "gnomon.h"

/* Fills frame->light, except its shadows, and frame->object. GN_ERR_SURFACE_LIGHTS if more than GN_SURFACE_LIGHTS
 * lights affect one object. */
gn_status gn_lights_setup(gn_frame *frame);

/* Whether the object's box is within the light's range; directional lights: always. */
int gn_light_reaches(const gn_frame *frame, uint32_t light_idx, uint32_t object_idx);

#endif
