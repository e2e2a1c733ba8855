#include "panel_ssd.h"

/* A command may have been cut off before its last parameter. As many NOPs as the longest has parameters end it,
 * whatever it was: the set-up that follows writes every register that they may have spoilt. */
panel_status panel_ssd_soft_reset(panel *p)
{
    for (int i = 0; i < PANEL_COMMAND_MAX; i++) {
        panel_status status = panel_send_1(p, SSD_NOP);
        if (status) return status;
    }
    return PANEL_OK;
}

panel_status panel_ssd_show(panel *p, int on)
{
    return panel_send_1(p, on ? SSD_ON : SSD_OFF);
}

/* "Off" is this controller's sleep: panel_sleep() has switched it off already, and panel_wake() switches it on. */
panel_status panel_ssd_sleep(panel *p, int asleep)
{
    (void)p;
    (void)asleep;
    return PANEL_OK;
}

panel_status panel_ssd_range(panel *p, uint8_t command, uint32_t first, uint32_t n)
{
    uint8_t bytes[3];
    bytes[0] = command;
    bytes[1] = (uint8_t)first;
    bytes[2] = (uint8_t)(first + n - 1);
    return panel_send(p, bytes, sizeof bytes);
}
