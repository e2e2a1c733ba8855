/* The part of every panel that does not depend on its controller: order of calls, windows, bounded waiting. */
#include "panel.h"

#include <string.h>

#include "panel_driver.h"

/* 0 is a panel that was never initialised, if it is static. */
enum { STATE_NEW, STATE_AWAKE, STATE_ASLEEP, STATE_LOST };

enum { RESET_PULSE_US = 1000 }; /* the slowest of the controllers wants 10 us */

const char *panel_status_text(panel_status status)
{
#define PANEL_STATUS_TEXT_(name, text) text,
    static const char *const text[PANEL_N_STATUS] = {PANEL_STATUS_LIST(PANEL_STATUS_TEXT_)};
    return (unsigned)status < PANEL_N_STATUS ? text[status] : "unknown status";
}

/* ---- Bounded waiting --------------------------------------------------------------------------------------------- */

static panel_status lose(panel *p, panel_status status)
{
    p->state = STATE_LOST;
    p->left_bytes = 0;
    if (p->bus.abandon) p->bus.abandon(p->bus.user);
    return status;
}

static panel_status settle(panel *p)
{
    for (uint32_t i = 0; i < p->bus.max_polls; i++) {
        panel_status status = p->bus.wait(p->bus.user);
        if (status == PANEL_OK) return PANEL_OK;
        if (status != PANEL_BUSY) return lose(p, status);
    }
    return lose(p, PANEL_ERR_TIMEOUT);
}

static panel_status start(panel *p, const uint8_t *bytes, size_t n, int is_data)
{
    for (uint32_t i = 0; i < p->bus.max_polls; i++) {
        panel_status status = p->bus.write(p->bus.user, bytes, n, is_data);
        if (status == PANEL_OK) return PANEL_OK;
        if (status != PANEL_BUSY) return lose(p, status);
    }
    return lose(p, PANEL_ERR_TIMEOUT);
}

/* ---- For the drivers --------------------------------------------------------------------------------------------- */

panel_status panel_send(panel *p, const uint8_t *bytes, size_t n)
{
    size_t n_low = p->driver->parameters_are_data ? 1 : n; /* with the data/command line low */
    panel_status status = settle(p);                       /* before the bytes of the last command are overwritten */
    if (status) return status;
    memcpy(p->command, bytes, n);
    status = start(p, p->command, n_low, 0);
    if (status || n == n_low) return status;
    status = settle(p);
    return status ? status : start(p, p->command + n_low, n - n_low, 1);
}

panel_status panel_send_1(panel *p, uint8_t command)
{
    return panel_send(p, &command, 1);
}

panel_status panel_send_2(panel *p, uint8_t command, uint8_t parameter)
{
    uint8_t bytes[2];
    bytes[0] = command;
    bytes[1] = parameter;
    return panel_send(p, bytes, 2);
}

panel_status panel_delay_ms(panel *p, uint32_t ms)
{
    panel_status status = settle(p);
    if (!status && ms > 0) p->bus.delay_us(p->bus.user, ms * 1000U);
    return status;
}

panel_status panel_send_script(panel *p, const uint8_t *script)
{
    while (script[0] > 0) {
        panel_status status = panel_send(p, script + 2, script[0]);
        if (!status && script[1] > 0) status = panel_delay_ms(p, script[1]);
        if (status) return status;
        script += 2 + script[0];
    }
    return PANEL_OK;
}

unsigned panel_mirrors(uint8_t turn)
{
    static const uint8_t mirrors[4] = {0, PANEL_MIRROR_X | PANEL_EXCHANGE_XY, PANEL_MIRROR_X | PANEL_MIRROR_Y,
                                       PANEL_MIRROR_Y | PANEL_EXCHANGE_XY};
    return mirrors[turn & 3];
}

/* ---- Set-up ------------------------------------------------------------------------------------------------------ */

static uint32_t align_x(const panel_driver *d)
{
    return d->pixels == PANEL_PIXELS_GREY4 ? 2 : 1;
}

static uint32_t align_y(const panel_driver *d)
{
    return d->pixels == PANEL_PIXELS_PAGE1 ? 8 : 1;
}

/* Where the glass lies in the controller's memory, in the coordinates that the controller counts in when it is turned.
 */
static panel_status place(panel *p)
{
    const panel_config *c = &p->config;
    const panel_driver *d = p->driver;
    if (c->turn > 3 || ((c->turn & 1) && !d->quarter_turns)) return PANEL_ERR_CONFIG;
    if (c->width == 0 || c->height == 0) return PANEL_ERR_CONFIG;
    if ((uint32_t)c->ram_x + c->width > d->ram_width || (uint32_t)c->ram_y + c->height > d->ram_height)
        return PANEL_ERR_CONFIG;
    unsigned mirrors = panel_mirrors(c->turn);
    uint32_t x = mirrors & PANEL_MIRROR_X ? (uint32_t)d->ram_width - c->ram_x - c->width : c->ram_x;
    uint32_t y = c->ram_y;
    if (d->quarter_turns && (mirrors & PANEL_MIRROR_Y)) y = (uint32_t)d->ram_height - c->ram_y - c->height;
    if (x % align_x(d) || y % align_y(d)) return PANEL_ERR_CONFIG;
    int exchange = (mirrors & PANEL_EXCHANGE_XY) != 0;
    p->offset_x = (uint16_t)(exchange ? y : x);
    p->offset_y = (uint16_t)(exchange ? x : y);
    p->width = exchange ? c->height : c->width;
    p->height = exchange ? c->width : c->height;
    return PANEL_OK;
}

static panel_status reset(panel *p)
{
    if (!p->bus.reset) return p->driver->soft_reset(p);
    p->bus.reset(p->bus.user, 1);
    p->bus.delay_us(p->bus.user, RESET_PULSE_US);
    p->bus.reset(p->bus.user, 0);
    p->bus.delay_us(p->bus.user, p->driver->reset_ms * 1000U);
    return PANEL_OK;
}

panel_status panel_init(panel *p, const panel_driver *driver, const panel_config *config, const panel_bus *bus)
{
    if (!p || !driver || !config || !bus) return PANEL_ERR_NULL;
    if (!bus->write || !bus->wait || !bus->delay_us) return PANEL_ERR_NULL;
    if (bus->max_polls == 0) return PANEL_ERR_CONFIG;
    if (bus->abandon) bus->abandon(bus->user); /* first: what is under way may be a command, sent from *p */
    panel fresh = {.driver = driver, .bus = *bus, .config = *config};
    *p = fresh;
    panel_status status = place(p);
    if (!status && driver->fits && !driver->fits(&p->config)) status = PANEL_ERR_CONFIG;
    if (!status) status = reset(p);
    if (!status) status = driver->set_up(p);
    if (!status) status = settle(p);
    if (!status) p->state = STATE_AWAKE;
    return status;
}

/* ---- The interface ----------------------------------------------------------------------------------------------- */

static panel_status usable(const panel *p, int state)
{
    if (!p) return PANEL_ERR_NULL;
    if (p->state == STATE_LOST) return PANEL_ERR_LOST;
    return p->state == state ? PANEL_OK : PANEL_ERR_ORDER;
}

panel_status panel_show(panel *p, int on)
{
    panel_status status = usable(p, STATE_AWAKE);
    if (!status) status = p->driver->show(p, on);
    if (!status) status = settle(p);
    if (status) return status;
    p->left_bytes = 0; /* a command ends the stream of pixels */
    p->shown = (uint8_t)(on != 0);
    return PANEL_OK;
}

panel_status panel_sleep(panel *p)
{
    panel_status status = usable(p, STATE_AWAKE);
    if (!status && p->shown) status = p->driver->show(p, 0);
    if (!status) status = p->driver->sleep(p, 1);
    if (!status) status = settle(p);
    if (status) return status;
    p->left_bytes = 0;
    p->state = STATE_ASLEEP;
    return PANEL_OK;
}

panel_status panel_wake(panel *p)
{
    panel_status status = usable(p, STATE_ASLEEP);
    if (!status) status = p->driver->sleep(p, 0);
    if (!status && p->shown) status = p->driver->show(p, 1);
    if (!status) status = settle(p);
    if (!status) p->state = STATE_AWAKE;
    return status;
}

size_t panel_window_bytes(const panel *p, int w, int h)
{
    size_t columns = (size_t)w, rows = (size_t)h;
    switch (p->driver->pixels) {
    case PANEL_PIXELS_GREY4:
        return (columns + 1) / 2 * rows;
    case PANEL_PIXELS_PAGE1:
        return columns * ((rows + 7) / 8);
    default:
        return 2 * columns * rows;
    }
}

panel_pixels panel_pixel_format(const panel *p)
{
    return p->driver->pixels;
}

/* An edge on a byte's border, or the glass's own. */
static int on_border(int at, uint32_t align, uint16_t end)
{
    return (uint32_t)at % align == 0 || at == end;
}

panel_status panel_window(panel *p, int x, int y, int w, int h)
{
    panel_status status = usable(p, STATE_AWAKE);
    if (status) return status;
    if (x < 0 || y < 0 || w <= 0 || h <= 0 || x > p->width || y > p->height || w > p->width - x || h > p->height - y)
        return PANEL_ERR_WINDOW;
    uint32_t ax = align_x(p->driver), ay = align_y(p->driver);
    if ((uint32_t)x % ax || (uint32_t)y % ay || !on_border(x + w, ax, p->width) || !on_border(y + h, ay, p->height))
        return PANEL_ERR_ALIGN;
    /* Only at the border does this round anything up, to pixels that nobody sees. */
    uint32_t whole_w = ((uint32_t)w + ax - 1) / ax * ax, whole_h = ((uint32_t)h + ay - 1) / ay * ay;
    p->left_bytes = 0;
    status = p->driver->window(p, (uint32_t)x + p->offset_x, (uint32_t)y + p->offset_y, whole_w, whole_h);
    if (!status) p->left_bytes = (uint32_t)panel_window_bytes(p, w, h);
    return status;
}

panel_status panel_stream(panel *p, const uint8_t *bytes, size_t n)
{
    panel_status status = usable(p, STATE_AWAKE);
    if (status) return status;
    if (!bytes) return PANEL_ERR_NULL;
    if (n > p->left_bytes) return p->left_bytes ? PANEL_ERR_LENGTH : PANEL_ERR_ORDER;
    if (n == 0) return PANEL_OK;
    status = settle(p);
    if (!status) status = start(p, bytes, n, 1);
    if (!status) p->left_bytes -= (uint32_t)n;
    return status;
}

panel_status panel_wait(panel *p)
{
    panel_status status = usable(p, STATE_AWAKE);
    return status ? status : settle(p);
}
