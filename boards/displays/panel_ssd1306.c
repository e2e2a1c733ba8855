/* SSD1306: 128x64, 1 bit per pixel, in pages of eight rows. */
#include "panel_ssd.h"

enum {
    COLUMNS = 0x21,
    PAGES = 0x22,
    COLUMNS_NORMAL = 0xA0,
    ROWS_NORMAL = 0xC0,
    INVERT_OFF = 0xA6,
    OFFSET = 0xD3,
    COM_PINS = 0xDA
};
enum { CHARGE_PUMP = 0x8D, PRECHARGE = 0xD9 };

/* clang-format off */
static const uint8_t registers[] = {
    /* bytes, ms, command, parameters */
    1, 0, SSD_OFF,    2, 0, 0xD5, 0x80, /* oscillator, no divider */
    2, 0, OFFSET, 0,  1, 0, 0x40,       /* row 0 of the memory is the glass's first */
    2, 0, 0x20, 0x00,                   /* along the rows, then to the next page */
    2, 0, 0xDB, 0x20,                   /* VCOMH 0.77 VCC */
    1, 0, 0x2E,                         /* no scrolling */
    1, 0, SSD_FROM_RAM, 0};
/* clang-format on */

/* With the charge pump the precharge phases are longer, and the pump is to run before the display is switched on. */
static panel_status set_up_supply(panel *p)
{
    int external = p->config.flags & PANEL_EXTERNAL_VCC;
    panel_status status = panel_send_2(p, CHARGE_PUMP, external ? 0x10 : 0x14);
    if (!status) status = panel_send_2(p, PRECHARGE, external ? 0x22 : 0xF1);
    if (!status) status = panel_send_2(p, SSD_CONTRAST, p->config.contrast ? p->config.contrast : 0x7F);
    return status;
}

/* On a module that stands upright both directions run backwards. */
static panel_status set_up_glass(panel *p)
{
    unsigned upright = p->config.turn == 0;
    panel_status status = panel_send_2(p, SSD_MULTIPLEX, (uint8_t)(p->config.height - 1));
    if (!status) status = panel_send_1(p, (uint8_t)(COLUMNS_NORMAL + upright));
    if (!status) status = panel_send_1(p, (uint8_t)(ROWS_NORMAL + 8 * upright));
    if (!status) status = panel_send_2(p, COM_PINS, p->config.sequential_com ? 0x02 : 0x12);
    if (!status) status = panel_send_1(p, (uint8_t)(INVERT_OFF + (p->config.flags & PANEL_INVERT ? 1 : 0)));
    return status;
}

static int fits(const panel_config *c)
{
    return c->ram_y == 0 && c->height >= SSD_LEAST_ROWS;
}

static panel_status set_up(panel *p)
{
    panel_status status = panel_send_script(p, registers);
    if (!status) status = set_up_supply(p);
    return status ? status : set_up_glass(p);
}

static panel_status window(panel *p, uint32_t x, uint32_t y, uint32_t w, uint32_t h)
{
    panel_status status = panel_ssd_range(p, COLUMNS, x, w);
    return status ? status : panel_ssd_range(p, PAGES, y / 8, h / 8);
}

const panel_driver panel_ssd1306 = {.pixels = PANEL_PIXELS_PAGE1,
                                    .ram_width = 128,
                                    .ram_height = 64,
                                    .reset_ms = SSD_RESET_MS,
                                    .fits = fits,
                                    .soft_reset = panel_ssd_soft_reset,
                                    .set_up = set_up,
                                    .window = window,
                                    .show = panel_ssd_show,
                                    .sleep = panel_ssd_sleep};
