/* The sundial's animation as a day: frame 0 is 06:00, twelve frames an hour. */
#ifndef GNOMON_BOARDS_DAY_H
#define GNOMON_BOARDS_DAY_H

#include "scene.h"

enum { DAY_FIRST_HOUR = 6, DAY_FRAMES_PER_HOUR = 12, DAY_MINUTES_PER_FRAME = 60 / DAY_FRAMES_PER_HOUR };

/* "13:05" at *text, and *text to behind it. No such time: -1. */
int32_t day_frame(const char **text);

/* The frame's time, "13:05". */
void day_text(uint32_t frame, char text[6]);

/* The scene at that time, for a display: small ones look closer. */
const gn_scene *day_scene(scene_state *state, uint32_t frame);

#endif
