/* Pimoroni Pico Display Pack 2.0: ST7789, 320x240, on SPI0: select GP17, clock GP18, data GP19, data/command GP16,
 * backlight GP20. It has no reset line. DMA channel 0 feeds the transmitter. */
#include "../../common/dma_screen.h"

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))
#define ATOMIC_CLEAR      0x3000U /* a write to the alias clears the bits */

enum {
    RESETS = 0x4000C000,
    RESET_DONE = 0x4000C008,
    RESET_DMA = 1 << 2,
    RESET_IO = 1 << 5,
    RESET_PADS = 1 << 8,
    RESET_SPI0 = 1 << 16,
    IO_CONTROL = 0x40014004, /* every 8 bytes */
    FUNCTION_SPI = 1,
    FUNCTION_PROCESSOR = 5,
    SPI_CR0 = 0x4003C000,
    SPI_CR1 = 0x4003C004,
    SPI_DR = 0x4003C008,
    SPI_SR = 0x4003C00C,
    SPI_CPSR = 0x4003C010,
    SPI_DMACR = 0x4003C024,
    SPI_ENABLE = 2,
    SPI_NOT_EMPTY = 4, /* the receiver */
    SPI_BUSY = 16,
    SPI_DMA_TRANSMIT = 2,
    DMA_READ = 0x50000000,
    DMA_WRITE = 0x50000004,
    DMA_COUNT = 0x50000008,
    DMA_CONTROL = 0x5000000C,
    DMA_ABORT = 0x50000444,
    DMA_ON_BYTES =
        1 | 1 << 4 | 16 << 15, /* enabled, reads step, paced by SPI0's transmitter, chained to itself: to none */
    DMA_BUSY = 1 << 24,
    PIN_COMMAND = 16,
    PIN_SELECT = 17,
    PIN_CLOCK = 18,
    PIN_DATA = 19,
    PIN_LIGHT = 20,
    ABORT_POLLS = 10000
};
#define SIO_SET    0xD0000014U
#define SIO_CLEAR  0xD0000018U
#define SIO_OUTPUT 0xD0000024U
#define DMA_FAILED 0x80000000U

static void set_pin(uint32_t pin, int high)
{
    REGISTER(high ? SIO_SET : SIO_CLEAR) = 1U << pin;
}

static void set_function(uint32_t pin, uint32_t function)
{
    REGISTER(IO_CONTROL + 8 * pin) = function;
}

static void make_output(uint32_t pin, int high)
{
    set_pin(pin, high);
    REGISTER(SIO_OUTPUT) = 1U << pin;
    set_function(pin, FUNCTION_PROCESSOR);
}

static void set_up_pins(void)
{
    const uint32_t used = RESET_DMA | RESET_IO | RESET_PADS | RESET_SPI0;
    REGISTER(RESETS + ATOMIC_CLEAR) = used;
    while ((REGISTER(RESET_DONE) & used) != used) continue;
    make_output(PIN_COMMAND, 0);
    make_output(PIN_SELECT, 0); /* alone on the bus: selected for good */
    make_output(PIN_LIGHT, 1);
    set_function(PIN_CLOCK, FUNCTION_SPI);
    set_function(PIN_DATA, FUNCTION_SPI);
    REGISTER(SPI_CR1) = 0;
    REGISTER(SPI_CPSR) = 2; /* 62.5 MHz, as the panel's maker drives it; the controller's data sheet promises 15 */
    REGISTER(SPI_CR0) = 7;  /* 8 bits, mode 0 */
    REGISTER(SPI_DMACR) = SPI_DMA_TRANSMIT;
    REGISTER(SPI_CR1) = SPI_ENABLE;
}

/* ---- The bus ----------------------------------------------------------------------------------------------------- */

static panel_status write(void *user, const uint8_t *bytes, size_t n, int is_data)
{
    (void)user;
    set_pin(PIN_COMMAND, is_data);
    REGISTER(DMA_READ) = (uint32_t)(uintptr_t)bytes;
    REGISTER(DMA_WRITE) = SPI_DR;
    REGISTER(DMA_COUNT) = (uint32_t)n;
    gn_port_before_dma(bytes, n);
    REGISTER(DMA_CONTROL) = DMA_ON_BYTES;
    return PANEL_OK;
}

static panel_status wait(void *user)
{
    (void)user;
    uint32_t control = REGISTER(DMA_CONTROL);
    if (control & DMA_FAILED) return PANEL_ERR_BUS;
    while (REGISTER(SPI_SR) & SPI_NOT_EMPTY) (void)REGISTER(SPI_DR);
    return (control & DMA_BUSY) || (REGISTER(SPI_SR) & SPI_BUSY) ? PANEL_BUSY : PANEL_OK;
}

/* If its polls are not enough, wait() stays busy and panel_init() says so. */
static void abandon(void *user)
{
    (void)user;
    REGISTER(DMA_ABORT) = 1;
    for (int i = 0; i < ABORT_POLLS && (REGISTER(DMA_ABORT) & 1U); i++) continue;
    REGISTER(DMA_CONTROL) = 3U << 29; /* a one clears what failed */
}

panel_status screen_open(panel *p, display *d)
{
    static const uint32_t clock_mhz = 125;
    const panel_bus bus = {.user = (void *)(uintptr_t)&clock_mhz,
                           .write = write,
                           .wait = wait,
                           .delay_us = dma_screen_delay_us,
                           .abandon = abandon,
                           .max_polls = DMA_SCREEN_POLLS};
    const panel_config config = {.width = 240, .height = 320, .turn = 1, .flags = PANEL_INVERT};
    set_up_pins();
    return dma_screen_open(p, d, &panel_st7789, &config, &bus);
}
