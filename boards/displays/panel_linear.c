/* A frame buffer in memory behind the same interface: its "commands" are windows, which framebuffer.c understands. */
#include "panel_driver.h"

/* Memory needs no set-up, and is never asleep. */
static panel_status nothing(panel *p)
{
    (void)p;
    return PANEL_OK;
}

static int fits(const panel_config *c)
{
    return c->turn == 0 && c->flags == 0;
}

/* x, y, w, h as two bytes each, the lower first. */
static panel_status window(panel *p, uint32_t x, uint32_t y, uint32_t w, uint32_t h)
{
    uint32_t value[4];
    uint8_t bytes[8];
    value[0] = x, value[1] = y, value[2] = w, value[3] = h;
    for (int i = 0; i < 4; i++) {
        bytes[2 * i] = (uint8_t)value[i];
        bytes[2 * i + 1] = (uint8_t)(value[i] >> 8);
    }
    return panel_send(p, bytes, sizeof bytes);
}

static panel_status always(panel *p, int on)
{
    (void)p;
    (void)on;
    return PANEL_OK;
}

const panel_driver panel_linear = {.pixels = PANEL_PIXELS_RGB565_LSB,
                                   .ram_width = 2048,
                                   .ram_height = 2048,
                                   .fits = fits,
                                   .soft_reset = nothing,
                                   .set_up = nothing,
                                   .window = window,
                                   .show = always,
                                   .sleep = always};
