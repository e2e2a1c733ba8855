/* ILI9341: 240x320, 16 bits per pixel. */
#include "panel_dcs.h"

/* clang-format off */
static const uint8_t registers[] = {
    /* bytes, ms, command, parameters */
    2, 0, 0xC0, 0x23,             /* power 1: grey levels up to 4.60 V */
    2, 0, 0xC1, 0x10,             /* power 2: step-up factors */
    3, 0, 0xC5, 0x3E, 0x28,       /* VCOM high 4.25 V, low -1.50 V */
    2, 0, 0xC7, 0x86,             /* VCOM offset */
    3, 0, 0xB1, 0x00, 0x18,       /* 79 frames per second */
    4, 0, 0xB6, 0x08, 0xA2, 0x27, /* 320 lines; source drivers from right to left, as the glasses are wired */
    2, 0, DCS_GAMSET, 0x01,       /* gamma curve 2.2 */
    0};
/* clang-format on */

static panel_status set_up(panel *p)
{
    return panel_dcs_set_up(p, registers);
}

const panel_driver panel_ili9341 = {.pixels = PANEL_PIXELS_RGB565_MSB,
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
