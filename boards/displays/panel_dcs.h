/* The display command set that ST7789 and ILI9341 have in common. */
#ifndef PANEL_DCS_H
#define PANEL_DCS_H

#include "panel_driver.h"

enum {
    DCS_SWRESET = 0x01,
    DCS_SLPIN = 0x10,
    DCS_SLPOUT = 0x11,
    DCS_INVON = 0x21,
    DCS_GAMSET = 0x26,
    DCS_DISPOFF = 0x28,
    DCS_DISPON = 0x29,
    DCS_CASET = 0x2A,
    DCS_RASET = 0x2B,
    DCS_RAMWR = 0x2C,
    DCS_MADCTL = 0x36,
    DCS_COLMOD = 0x3A
};

/* After a reset, and between falling asleep and waking, SLPOUT has to wait 120 ms; after SLPOUT the voltages take as
 * long. */
enum { DCS_SLEEP_MS = 120 };

panel_status panel_dcs_soft_reset(panel *p);
panel_status panel_dcs_set_up(panel *p, const uint8_t *script); /* `script`: the controller's own registers */
panel_status panel_dcs_window(panel *p, uint32_t x, uint32_t y, uint32_t w, uint32_t h);
panel_status panel_dcs_show(panel *p, int on);
panel_status panel_dcs_sleep(panel *p, int asleep);

#endif
