/* Light states, cascades, and which object each light affects. */
#ifndef GN_LIGHTS_H
#define GN_LIGHTS_H

#include "gnomon.h"

/* ---- Light states, and which object each light affects ----------------------------------------------------------- */

/* Fills frame->light, except its shadows, and frame->object. GN_ERR_SURFACE_LIGHTS if more than GN_SURFACE_LIGHTS
 * lights affect one object. */
gn_status gn_lights_setup(gn_frame *frame);

/* Whether the object's box is within the light's range; directional lights: always. */
int gn_light_reaches(const gn_frame *frame, uint32_t light_idx, uint32_t object_idx);

/* ---- Per-object state: its box in the world, and its light list -------------------------------------------------- */

/* Fills frame->object's boxes. Needs only the scene. */
gn_status gn_object_boxes(gn_frame *frame);

/* Square of the distance from a point to the nearest point of the object's box, Q32. */
uint64_t gn_object_distance2_q32(const gn_object_state *object, const int32_t p_q16[3]);

/* Lists the spot and point lights that affect the object, and returns their number. Boxes and frame->light must be set
 * up. gn_light_list.c. */
uint32_t gn_object_list_lights(gn_frame *frame, uint32_t object_idx);

/* ---- Cascades: slices of the frustum, their bounding spheres, and how shadows end with distance (MODEL 4) -------- */

/* A single cascade is never unused, so that builds with and without many cascades agree. */
#define GN_CASCADE_UNUSED(frame, i)                                                                                    \
    (GN_MANY_CASCADES && (frame)->n_cascades > 1 && ((frame)->scene->shadow.cascades_unused >> (i)&1U) != 0)

/* Fills frame->cascade and the distance fade. */
void gn_cascade_setup(gn_frame *frame);

/* Slice i of the frustum: from the camera's near plane or the previous slice's end. */
void gn_cascade_slice(const gn_frame *frame, uint32_t i, int32_t *near_q16, int32_t *far_q16);

/* Bounding sphere of a slice of the frustum, as fractions of its far end: depth of the centre and radius, Q8.24. */
void gn_cascade_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, int64_t *centre_q24,
                       int64_t *radius_q24);

/* The same in world units: returns the view depth of the centre, Q16. */
int32_t gn_cascade_fit_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, gn_bfloat *radius);

/* Square of the half-diagonal's tangent, Q24, at most 2^14. */
int64_t gn_cascade_tan2_q24(const gn_frame *frame);

#endif
