/* SSD1327 and SSD0323: 4 bits per pixel, two pixels per byte of memory. */
#include "panel_ssd.h"

enum { COLUMNS = 0x15, ROWS = 0x75, REMAP = 0xA0, INVERT = 0xA7, DC_DC = 0xAD };
enum { ROWS_1327 = 128, ROWS_0323 = 80, MOST_CONTRAST_0323 = 127 };
enum { REMAP_COLUMNS = 0x01, REMAP_NIBBLES = 0x02, REMAP_ROWS = 0x10, REMAP_SPLIT = 0x40 };

/* The pictures are encoded for the eye: grey level i is to shine as (i / 15)^2.2. */
/* clang-format off */
static const uint8_t registers_1327[] = {
    /* bytes, ms, command, parameters */
    2, 0, 0xFD, 0x12, 1, 0, SSD_OFF, /* unlock */
    2, 0, 0xAB, 0x01, /* internal VDD regulator */
    2, 0, 0xB1, 0x51, 2, 0, 0xB3, 0x00, 2, 0, 0xB6, 0x01, /* phases, clock, second precharge */
    2, 0, 0xBC, 0x08, 2, 0, 0xBE, 0x07, 2, 0, 0xD5, 0x62, /* precharge voltage, VCOMH, enable second precharge */
    16, 0, 0xB8, 0, 1, 2, 3, 6, 8, 12, 16, 20, 26, 32, 39, 46, 54, 63, /* pulse widths of levels 1 .. 15 */
    2, 0, SSD_START_LINE, 0, 0};
/* clang-format on */

/* clang-format off */
static const uint8_t registers_0323[] = {
    /* bytes, ms, command, parameters */
    1, 0, 0x86, /* full current */
    2, 0, 0xB1, 0x22, 2, 0, 0xB2, 0x46, 2, 0, 0xB3, 0xA0, /* phases, row period, clock */
    9, 0, 0xB8, 0x01, 0x11, 0x21, 0x22, 0x33, 0x44, 0x65, 0x77, /* widths added by levels 1 .. 15, low nibble first */
    2, 0, SSD_START_LINE, 0, 0};
/* clang-format on */

static int fits_1327(const panel_config *c)
{
    return c->ram_y == 0 && c->height >= SSD_LEAST_ROWS && c->first_com < ROWS_1327;
}

static int fits_0323(const panel_config *c)
{
    return c->ram_y == 0 && c->height >= SSD_LEAST_ROWS && c->first_com < ROWS_0323 &&
           c->contrast <= MOST_CONTRAST_0323;
}

static panel_status set_up(panel *p, const uint8_t *registers, unsigned remap, uint8_t contrast)
{
    if (p->config.turn) remap ^= REMAP_COLUMNS | REMAP_NIBBLES | REMAP_ROWS;
    panel_status status = panel_send_script(p, registers);
    if (!status) status = panel_send_2(p, REMAP, (uint8_t)(remap | REMAP_SPLIT));
    if (!status) status = panel_send_2(p, SSD_OFFSET, p->config.first_com);
    if (!status) status = panel_send_2(p, SSD_MULTIPLEX, (uint8_t)(p->config.height - 1));
    if (!status) status = panel_send_2(p, SSD_CONTRAST, contrast);
    if (!status) status = panel_send_1(p, p->config.flags & PANEL_INVERT ? INVERT : SSD_FROM_RAM);
    return status;
}

/* The glasses differ in where their first column is wired; the nibbles follow, so that the left pixel is in the high
 * one. */
static panel_status set_up_1327(panel *p)
{
    return set_up(p, registers_1327, REMAP_COLUMNS | REMAP_ROWS, p->config.contrast ? p->config.contrast : 0x80);
}

static panel_status set_up_0323(panel *p)
{
    panel_status status = panel_send_1(p, SSD_OFF);
    if (!status) status = panel_send_2(p, DC_DC, p->config.flags & PANEL_EXTERNAL_VCC ? 0x02 : 0x03);
    return status
               ? status
               : set_up(p, registers_0323, REMAP_NIBBLES | REMAP_ROWS, p->config.contrast ? p->config.contrast : 0x40);
}

static panel_status window(panel *p, uint32_t x, uint32_t y, uint32_t w, uint32_t h)
{
    panel_status status = panel_ssd_range(p, COLUMNS, x / 2, w / 2);
    return status ? status : panel_ssd_range(p, ROWS, y, h);
}

const panel_driver panel_ssd1327 = {.pixels = PANEL_PIXELS_GREY4,
                                    .ram_width = 128,
                                    .ram_height = ROWS_1327,
                                    .reset_ms = SSD_RESET_MS,
                                    .fits = fits_1327,
                                    .soft_reset = panel_ssd_soft_reset,
                                    .set_up = set_up_1327,
                                    .window = window,
                                    .show = panel_ssd_show,
                                    .sleep = panel_ssd_sleep};

const panel_driver panel_ssd0323 = {.pixels = PANEL_PIXELS_GREY4,
                                    .ram_width = 128,
                                    .ram_height = ROWS_0323,
                                    .reset_ms = SSD_RESET_MS,
                                    .fits = fits_0323,
                                    .soft_reset = panel_ssd_soft_reset,
                                    .set_up = set_up_0323,
                                    .window = window,
                                    .show = panel_ssd_show,
                                    .sleep = panel_ssd_sleep};
