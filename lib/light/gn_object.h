/* What is known of an object before its triangles are looked at: its box in the world, and the lights that reach it
 * (P9). */
#ifndef GN_OBJECT_H
#define GN_OBJECT_H

#include "gnomon.h"

/* Fills frame->object's boxes. Needs only the scene. */
gn_status gn_object_boxes(gn_frame *frame);

/* Square of the distance from a point to the nearest point of the object's box, Q32. */
uint64_t gn_object_distance2_q32(const gn_object_state *object, const int32_t p_q16[3]);

/* Whether a light reaches the object: directional lights always do. */
int gn_object_is_reached(const gn_frame *frame, uint32_t object_idx, uint32_t light_idx);

/* Light lists of all objects; frame->light must be set up. GN_ERR_SURFACE_LIGHTS if one is too long. */
gn_status gn_object_lights(gn_frame *frame);

#endif
