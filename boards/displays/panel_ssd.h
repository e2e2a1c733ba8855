/* What the OLED controllers SSD1306, SSD1327 and SSD0323 have in common. Parameters are sent like commands, with the
 * data/command line low. One command switches the display on and off, and off is also its sleep. There is no reset by
 * command. Values are from the controllers' data sheets. */
#ifndef PANEL_SSD_H
#define PANEL_SSD_H

#include "panel_driver.h"

enum {
    SSD_CONTRAST = 0x81,
    SSD_START_LINE = 0xA1, /* SSD1327, SSD0323: row of the memory that the first line shows */
    SSD_OFFSET = 0xA2,     /* SSD1327, SSD0323: which of the glass's lines is the first */
    SSD_FROM_RAM = 0xA4,   /* show what the memory holds, rather than all pixels lit */
    SSD_MULTIPLEX = 0xA8,  /* lines in use, less 1 */
    SSD_OFF = 0xAE,
    SSD_ON = 0xAF,
    SSD_NOP = 0xE3
};

/* From a reset to the first command; the fewest lines that SSD_MULTIPLEX takes. */
enum { SSD_RESET_MS = 1, SSD_LEAST_ROWS = 16 };

/* For panel_driver's fields of these names. */
panel_status panel_ssd_soft_reset(panel *p); /* ends a command that was cut off */
panel_status panel_ssd_show(panel *p, int on);
panel_status panel_ssd_sleep(panel *p, int asleep); /* nothing: see panel_ssd.c */

/* Sends a command whose parameters are the first and the last of n columns, rows or pages. */
panel_status panel_ssd_range(panel *p, uint8_t command, uint32_t first, uint32_t n);

#endif
