#include "panel_dcs.h"

enum { MADCTL_MY = 0x80, MADCTL_MX = 0x40, MADCTL_MV = 0x20, MADCTL_BGR = 0x08 };
enum { COLMOD_16_BITS = 0x55 };

/* Whatever was sent last may have been SLPIN or SLPOUT, which a reset is not to follow at once. */
panel_status panel_dcs_soft_reset(panel *p)
{
    panel_status status = panel_delay_ms(p, DCS_SLEEP_MS);
    if (!status) status = panel_send_1(p, DCS_SWRESET);
    return status ? status : panel_delay_ms(p, DCS_SLEEP_MS);
}

/* Any reset, by line or by command, has left inversion, partial mode and idle mode. */
panel_status panel_dcs_set_up(panel *p, const uint8_t *script)
{
    unsigned mirrors = panel_mirrors(p->config.turn);
    unsigned madctl = p->config.flags & PANEL_BGR ? MADCTL_BGR : 0;
    if (mirrors & PANEL_MIRROR_X) madctl |= MADCTL_MX;
    if (mirrors & PANEL_MIRROR_Y) madctl |= MADCTL_MY;
    if (mirrors & PANEL_EXCHANGE_XY) madctl |= MADCTL_MV;
    panel_status status = panel_dcs_sleep(p, 0);
    if (!status) status = panel_send_script(p, script);
    if (!status) status = panel_send_2(p, DCS_COLMOD, COLMOD_16_BITS);
    if (!status) status = panel_send_2(p, DCS_MADCTL, (uint8_t)madctl);
    if (!status && (p->config.flags & PANEL_INVERT)) status = panel_send_1(p, DCS_INVON);
    return status;
}

static panel_status send_range(panel *p, uint8_t command, uint32_t first, uint32_t n)
{
    uint32_t last = first + n - 1;
    uint8_t bytes[5];
    bytes[0] = command;
    bytes[1] = (uint8_t)(first >> 8);
    bytes[2] = (uint8_t)first;
    bytes[3] = (uint8_t)(last >> 8);
    bytes[4] = (uint8_t)last;
    return panel_send(p, bytes, sizeof bytes);
}

panel_status panel_dcs_window(panel *p, uint32_t x, uint32_t y, uint32_t w, uint32_t h)
{
    panel_status status = send_range(p, DCS_CASET, x, w);
    if (!status) status = send_range(p, DCS_RASET, y, h);
    return status ? status : panel_send_1(p, DCS_RAMWR);
}

panel_status panel_dcs_show(panel *p, int on)
{
    return panel_send_1(p, on ? DCS_DISPON : DCS_DISPOFF);
}

panel_status panel_dcs_sleep(panel *p, int asleep)
{
    panel_status status = panel_send_1(p, asleep ? DCS_SLPIN : DCS_SLPOUT);
    return status ? status : panel_delay_ms(p, DCS_SLEEP_MS);
}
