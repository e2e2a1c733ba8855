/* Lights and their views for this frame: states, light lists, shadow tiles and how each lies in the world. */
#ifndef GN_VIEWS_H
#define GN_VIEWS_H

#include "gnomon.h"

/* Fills frame->light, frame->object and frame->view. The scene has been validated and the camera set up. */
gn_status gn_views_setup(gn_frame *frame);

#endif
