#include "framebuffer.h"

#include <string.h>

static panel_status open_window(framebuffer *f, const uint8_t *bytes, size_t n)
{
    if (n != 8) return PANEL_ERR_BUS;
    for (int i = 0; i < 4; i++) f->window[i] = (uint16_t)(bytes[2 * i] | bytes[2 * i + 1] << 8);
    f->at_bytes = 0;
    int inside = f->window[0] + f->window[2] <= f->width && f->window[1] + f->window[3] <= f->height;
    return inside ? PANEL_OK : PANEL_ERR_BUS;
}

static panel_status copy(framebuffer *f, const uint8_t *bytes, size_t n)
{
    uint32_t row_bytes = 2U * f->window[2];
    if (n > row_bytes * f->window[3] - f->at_bytes) return PANEL_ERR_BUS;
    while (n > 0) {
        uint32_t row = f->at_bytes / row_bytes, column = f->at_bytes % row_bytes;
        size_t part = row_bytes - column < n ? row_bytes - column : n;
        memcpy(f->pixels + (f->window[1] + row) * f->pitch_bytes + 2U * f->window[0] + column, bytes, part);
        f->at_bytes += (uint32_t)part;
        bytes += part;
        n -= part;
    }
    return PANEL_OK;
}

static panel_status write(void *user, const uint8_t *bytes, size_t n, int is_data)
{
    framebuffer *f = (framebuffer *)user;
    return is_data ? copy(f, bytes, n) : open_window(f, bytes, n);
}

static panel_status idle(void *user)
{
    (void)user;
    return PANEL_OK;
}

static void no_delay(void *user, uint32_t us)
{
    (void)user;
    (void)us;
}

void framebuffer_bus(framebuffer *f, panel_bus *bus)
{
    panel_bus b = {.user = f, .write = write, .wait = idle, .delay_us = no_delay, .max_polls = 1};
    *bus = b;
}
