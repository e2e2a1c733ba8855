/* Validation of the caller's scene. */
#ifndef GN_SCENE_H
#define GN_SCENE_H

#include "gnomon.h"

/* Whether a position is within +-2^30, as the transforms rely on. */
int gn_scene_position_ok(const gn_mesh *mesh, uint32_t vertex_idx);

/* The automatic bias that a light requests, GN_AUTO_BIAS_DEPTH or _NORMAL; 0: none. Lights that set another receiver
 * bias do not by default. */
gn_auto_bias gn_scene_auto_bias(const gn_light *light);

/* Records a failure and returns its status. */
gn_status gn_fail(gn_frame *frame, gn_status status, uint32_t index);
gn_status gn_fail_capacity(gn_frame *frame, gn_status status, uint32_t needed, uint32_t available);

#endif
