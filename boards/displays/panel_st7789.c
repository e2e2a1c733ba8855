/* ST7789: a controller of colour LCDs, 240x320 pixels of RGB565. Voltages and gamma stay at their reset values, which
 * suit the usual modules. panel_dcs.c has its commands; panel_driver.h says what each field is. */
#include "panel_dcs.h"

static const uint8_t nothing[] = {0}; /* a script without commands: see panel_send_script */

static panel_status set_up(panel *p)
{
    return panel_dcs_set_up(p, nothing);
}

const panel_driver panel_st7789 = {.pixels = PANEL_PIXELS_RGB565_MSB,
                                   .ram_width = 240,
                                   .ram_height = 320,
                                   .quarter_turns = 1,
                                   .parameters_are_data = 1,
                                   .reset_ms = DCS_SLEEP_MS,
                                   .soft_reset = panel_dcs_soft_reset,
                                   .set_up = set_up,
                                   .window = panel_dcs_window,
                                   .show = panel_dcs_show,
                                   .sleep = panel_dcs_sleep};
