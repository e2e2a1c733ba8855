/* What a controller's driver supplies, and what the drivers share. */
#ifndef PANEL_DRIVER_H
#define PANEL_DRIVER_H

#include "panel.h"

struct panel_driver {
    panel_pixels pixels;
    uint16_t ram_width, ram_height;
    uint8_t quarter_turns;       /* 1: it can exchange rows and columns */
    uint8_t parameters_are_data; /* 1: the data/command line is high while a command's parameters are sent */
    uint16_t reset_ms;           /* from the end of a reset to the first command */
    int (*fits)(
        const panel_config *config); /* 0: this controller cannot; NULL: what panel.c checks is all there is to it */
    panel_status (*soft_reset)(panel *p); /* where the board has no reset line */
    panel_status (*set_up)(panel *p);     /* everything between reset and the first window; the display stays off */
    panel_status (*window)(panel *p, uint32_t x, uint32_t y, uint32_t w,
                           uint32_t h); /* in the controller's memory, pixels */
    panel_status (*show)(panel *p, int on);
    panel_status (*sleep)(panel *p, int asleep);
};

/* Mirrored columns, mirrored rows, rows and columns exchanged: what `turn` comes to. */
enum { PANEL_MIRROR_X = 1, PANEL_MIRROR_Y = 2, PANEL_EXCHANGE_XY = 4 };
unsigned panel_mirrors(uint8_t turn);

/* A command byte and its parameters, as the controller wants them; waits for what is under way, and is under way itself
 * afterwards.
 */
panel_status panel_send(panel *p, const uint8_t *bytes, size_t n);
panel_status panel_send_1(panel *p, uint8_t command);
panel_status panel_send_2(panel *p, uint8_t command, uint8_t parameter);
panel_status panel_delay_ms(panel *p, uint32_t ms); /* from the end of the last command on */

/* A list of commands: number of bytes, delay afterwards in ms, command, parameters; ended by a 0. */
panel_status panel_send_script(panel *p, const uint8_t *script);

#endif
