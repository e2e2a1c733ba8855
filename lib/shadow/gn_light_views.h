/* Views of lights: each light that casts shadows gets tiles, and each tile a direction, a filter and a bias. */
#ifndef GN_LIGHT_VIEWS_H
#define GN_LIGHT_VIEWS_H

#include "gnomon.h"

/* MODEL 4: u, v, w from the direction of travel. */
void gn_light_view_axes(int32_t axis_q30[3][3], const int32_t w_q30[3]);

/* Fills frame->view, and the shadow fields of frame->light. gn_lights_setup has been called. */
gn_status gn_light_views_setup(gn_frame *frame, gn_seen_job *job);

#endif
