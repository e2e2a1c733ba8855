/* A scene seen from elsewhere, or at another hour, than its file says. */
#ifndef GNOMON_HOST_TURN_H
#define GNOMON_HOST_TURN_H

#include "model.h"

/* Turns the camera and the sun as options->turn and options->hour say. */
void scene_turn(scene *s, const scene_options *options);

#endif
