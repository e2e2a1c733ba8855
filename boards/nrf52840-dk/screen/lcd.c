/* An ILI9341 shield, 240x320, on the Arduino header: clock D13 (P1.15), data D11 (P1.13), select D10 (P1.12),
 * data/command D9 (P1.11). SPIM2 sends by its own DMA, which reads RAM alone: 8 MHz, its fastest. */
#include "../../common/dma_screen.h"

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

enum {
    PORT1_OUTPUT_HIGH = 0x50000808,
    PORT1_OUTPUT_LOW = 0x5000080C,
    PORT1_MAKE_OUTPUT = 0x50000818,
    PIN_COMMAND = 11,
    PIN_SELECT = 12,
    PIN_DATA = 13,
    PIN_CLOCK = 15,
    PORT1 = 1 << 5, /* of a pin's number */
    SPIM_START = 0x40023010,
    SPIM_STOP = 0x40023014,
    SPIM_STOPPED = 0x40023104,
    SPIM_SENT = 0x40023118,
    SPIM_ENABLE = 0x40023500,
    SPIM_PIN_CLOCK = 0x40023508,
    SPIM_PIN_DATA = 0x4002350C,
    SPIM_RATE = 0x40023524,
    SPIM_RECEIVE_COUNT = 0x40023538,
    SPIM_SEND_FROM = 0x40023544,
    SPIM_SEND_COUNT = 0x40023548,
    SPIM_MODE = 0x40023554,
    SPIM_ON = 7,
    SPIM_MOST = 65535,
    ABORT_POLLS = 10000
};
#define RATE_8_MHZ 0x80000000U

static void set_pin(uint32_t pin, int high)
{
    REGISTER(high ? PORT1_OUTPUT_HIGH : PORT1_OUTPUT_LOW) = 1U << pin;
}

static void set_up_pins(void)
{
    set_pin(PIN_SELECT, 0); /* alone on the bus: selected for good */
    set_pin(PIN_CLOCK, 0);
    set_pin(PIN_DATA, 0);
    REGISTER(PORT1_MAKE_OUTPUT) = 1U << PIN_COMMAND | 1U << PIN_SELECT | 1U << PIN_DATA | 1U << PIN_CLOCK;
    REGISTER(SPIM_PIN_CLOCK) = PORT1 | PIN_CLOCK;
    REGISTER(SPIM_PIN_DATA) = PORT1 | PIN_DATA;
    REGISTER(SPIM_RATE) = RATE_8_MHZ;
    REGISTER(SPIM_MODE) = 0;
    REGISTER(SPIM_RECEIVE_COUNT) = 0;
    REGISTER(SPIM_SENT) = 1; /* nothing is under way */
    REGISTER(SPIM_ENABLE) = SPIM_ON;
}

/* ---- The bus ----------------------------------------------------------------------------------------------------- */

static panel_status write(void *user, const uint8_t *bytes, size_t n, int is_data)
{
    (void)user;
    if (n > SPIM_MOST) return PANEL_ERR_LENGTH;
    set_pin(PIN_COMMAND, is_data);
    REGISTER(SPIM_SENT) = 0;
    REGISTER(SPIM_SEND_FROM) = (uint32_t)(uintptr_t)bytes;
    REGISTER(SPIM_SEND_COUNT) = (uint32_t)n;
    gn_port_before_dma(bytes, n);
    REGISTER(SPIM_START) = 1;
    return PANEL_OK;
}

static panel_status wait(void *user)
{
    (void)user;
    return REGISTER(SPIM_SENT) ? PANEL_OK : PANEL_BUSY;
}

static void abandon(void *user)
{
    (void)user;
    if (REGISTER(SPIM_SENT)) return;
    REGISTER(SPIM_STOPPED) = 0;
    REGISTER(SPIM_STOP) = 1;
    for (int i = 0; i < ABORT_POLLS && !REGISTER(SPIM_STOPPED); i++) continue;
    REGISTER(SPIM_SENT) = REGISTER(SPIM_STOPPED);
}

panel_status screen_open(panel *p, display *d)
{
    static const uint32_t clock_mhz = 64;
    const panel_bus bus = {.user = (void *)(uintptr_t)&clock_mhz,
                           .write = write,
                           .wait = wait,
                           .delay_us = dma_screen_delay_us,
                           .abandon = abandon,
                           .max_polls = DMA_SCREEN_POLLS};
    const panel_config config = {.width = 240, .height = 320, .turn = 1, .flags = PANEL_BGR};
    set_up_pins();
    return dma_screen_open(p, d, &panel_ili9341, &config, &bus);
}
