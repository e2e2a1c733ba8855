/* What a board with a display defines in its folder `screen`, for apps that show pictures. SCREEN_WIDTH, SCREEN_HEIGHT
 * and SCREEN_FORMAT come from its board.mk. */
#ifndef SCREEN_H
#define SCREEN_H

#include "display.h"

/* Pins, bus, controller and buffers; the display is dark until panel_show(). Also the way out of an error. */
panel_status screen_open(panel *p, display *d);

#endif
