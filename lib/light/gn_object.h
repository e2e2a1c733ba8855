/* What is known of an object before its triangles are looked at: its box in the world, and the lights that reach it. */
#ifndef GN_OBJECT_H
#define GN_OBJECT_H

#include "gnomon.h"

/* Fills frame->object's boxes. Needs only the scene. */
gn_status gn_object_boxes(gn_frame *frame);

/* Square of the distance from a point to the nearest point of the object's box, Q32. */
uint64_t gn_object_distance2_q32(const gn_object_state *object, const int32_t p_q16[3]);

/* Lists the spot and point lights that reach the object; boxes and frame->light must be set up. Returns how many its
 * surfaces have to reckon with. gn_light_list.c. */
uint32_t gn_object_list_lights(gn_frame *frame, uint32_t object_idx);

#endif
