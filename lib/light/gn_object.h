/* Per-object state: its box in the world, and its light list. */
#ifndef GN_OBJECT_H
#define GN_OBJECT_H

#include "gnomon.h"

/* Fills frame->object's boxes. Needs only the scene. */
gn_status gn_object_boxes(gn_frame *frame);

/* Square of the distance from a point to the nearest point of the object's box, Q32. */
uint64_t gn_object_distance2_q32(const gn_object_state *object, const int32_t p_q16[3]);

/* Lists the spot and point lights that affect the object, and returns their number. Boxes and frame->light must be set
 * up. gn_light_list.c. */
uint32_t gn_object_list_lights(gn_frame *frame, uint32_t object_idx);

#endif
