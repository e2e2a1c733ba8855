/* What the OLED controllers have in common: parameters are sent like commands, one command to light and darken, and no
 * reset by command. */
#ifndef PANEL_SSD_H
#define PANEL_SSD_H

#include "panel_driver.h"

enum {
    SSD_CONTRAST = 0x81,
    SSD_START_LINE = 0xA1,
    SSD_OFFSET = 0xA2,
    SSD_FROM_RAM = 0xA4,
    SSD_MULTIPLEX = 0xA8,
    SSD_OFF = 0xAE,
    SSD_ON = 0xAF,
    SSD_NOP = 0xE3
};

enum { SSD_RESET_MS = 1, SSD_LEAST_ROWS = 16 };

panel_status panel_ssd_soft_reset(panel *p);
panel_status panel_ssd_show(panel *p, int on);
panel_status panel_ssd_sleep(panel *p, int asleep);
panel_status panel_ssd_range(panel *p, uint8_t command, uint32_t first, uint32_t n);

#endif
