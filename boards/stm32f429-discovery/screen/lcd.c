/* The board's own LCD: ILI9341, 240x320, on SPI5: select PC2, clock PF7, data PF9, data/command PD13; the read strobe
 * PD12 stays high. Its reset line is the board's. Stream 4 of DMA2 feeds the transmitter. */
#include "../../common/systick.h"
#include "../../displays/screen.h"
#include "gn_port.h"

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

enum {
    RCC_AHB1 = 0x40023830,
    RCC_APB2 = 0x40023844,
    AHB1_PORTS = 1 << 2 | 1 << 3 | 1 << 5, /* C, D, F */
    AHB1_DMA2 = 1 << 22,
    APB2_SPI5 = 1 << 20,
    PORT_C = 0x40020800,
    PORT_D = 0x40020C00,
    PORT_F = 0x40021400,
    MODE = 0x00,
    SPEED = 0x08,
    SET_RESET = 0x18,
    FUNCTION = 0x20, /* four bits per pin */
    MODE_OUTPUT = 1,
    MODE_FUNCTION = 2,
    FUNCTION_SPI5 = 5,
    PIN_SELECT = 2,
    PIN_READ = 12,
    PIN_COMMAND = 13,
    PIN_CLOCK = 7,
    PIN_DATA = 9,
    SPI_CR1 = 0x40015000,
    SPI_CR2 = 0x40015004,
    SPI_SR = 0x40015008,
    SPI_DR = 0x4001500C,
    SPI_ON = 1 << 2 | 3 << 3 | 1 << 6 | 3 << 8, /* master, 84 MHz / 16, enabled, selected by software */
    SPI_DMA_TRANSMIT = 2,
    SPI_EMPTY = 2, /* the transmitter */
    SPI_BUSY = 1 << 7,
    DMA_STATUS = 0x40026404,
    DMA_CLEAR = 0x4002640C,
    DMA_CONTROL = 0x40026470, /* stream 4 */
    DMA_COUNT = 0x40026474,
    DMA_PERIPHERAL = 0x40026478,
    DMA_MEMORY = 0x4002647C,
    DMA_FLAGS = 0x3D, /* of stream 4, in DMA_STATUS and DMA_CLEAR */
    DMA_FAILED = 0x0C,
    DMA_ON = 1,
    DMA_MOST = 65535,
    DMA_BYTES = 1 << 6 | 1 << 10 | 2 << 25, /* memory to peripheral, memory steps, channel 2: SPI5's transmitter */
    CLOCK_MHZ = 168,
    POLLS = 10000000,
    ABORT_POLLS = 10000,
    TILE_BYTES = GN_TILE_WIDTH * GN_TILE_HEIGHT * 2
};

static void set_pin(uint32_t port, uint32_t pin, int high)
{
    REGISTER(port + SET_RESET) = 1U << (high ? pin : pin + 16);
}

static void set_mode(uint32_t port, uint32_t pin, uint32_t mode)
{
    REGISTER(port + SPEED) |= 2U << 2 * pin;
    REGISTER(port + MODE) = (REGISTER(port + MODE) & ~(3U << 2 * pin)) | mode << 2 * pin;
}

static void set_function(uint32_t port, uint32_t pin, uint32_t function)
{
    uint32_t address = port + FUNCTION + pin / 8 * 4, shift = pin % 8 * 4;
    REGISTER(address) = (REGISTER(address) & ~(15U << shift)) | function << shift;
    set_mode(port, pin, MODE_FUNCTION);
}

static void set_up_pins(void)
{
    REGISTER(RCC_AHB1) |= AHB1_PORTS | AHB1_DMA2;
    REGISTER(RCC_APB2) |= APB2_SPI5;
    (void)REGISTER(RCC_APB2); /* until the clocks run */
    set_pin(PORT_D, PIN_READ, 1);
    set_pin(PORT_C, PIN_SELECT, 0); /* the gyroscope on this bus has a select of its own, PC1 */
    set_pin(PORT_C, 1, 1);
    set_mode(PORT_C, 1, MODE_OUTPUT);
    set_mode(PORT_C, PIN_SELECT, MODE_OUTPUT);
    set_mode(PORT_D, PIN_READ, MODE_OUTPUT);
    set_mode(PORT_D, PIN_COMMAND, MODE_OUTPUT);
    set_function(PORT_F, PIN_CLOCK, FUNCTION_SPI5);
    set_function(PORT_F, PIN_DATA, FUNCTION_SPI5);
    REGISTER(SPI_CR1) = 0;
    REGISTER(SPI_CR2) = SPI_DMA_TRANSMIT;
    REGISTER(SPI_CR1) = SPI_ON; /* 5.25 MHz; the controller's data sheet says up to 10 */
}

/* ---- The bus ----------------------------------------------------------------------------------------------------- */

static panel_status write(void *user, const uint8_t *bytes, size_t n, int is_data)
{
    (void)user;
    if (n > DMA_MOST) return PANEL_ERR_LENGTH;
    set_pin(PORT_D, PIN_COMMAND, is_data);
    REGISTER(DMA_CLEAR) = DMA_FLAGS;
    REGISTER(DMA_CONTROL) = DMA_BYTES;
    REGISTER(DMA_PERIPHERAL) = SPI_DR;
    REGISTER(DMA_MEMORY) = (uint32_t)(uintptr_t)bytes;
    REGISTER(DMA_COUNT) = (uint32_t)n;
    gn_port_before_dma(bytes, n);
    REGISTER(DMA_CONTROL) = DMA_BYTES | DMA_ON;
    return PANEL_OK;
}

/* The stream switches itself off at its end. */
static panel_status wait(void *user)
{
    (void)user;
    if (REGISTER(DMA_STATUS) & DMA_FAILED) return PANEL_ERR_BUS;
    if (REGISTER(DMA_CONTROL) & DMA_ON) return PANEL_BUSY;
    uint32_t spi = REGISTER(SPI_SR);
    return (spi & SPI_BUSY) || !(spi & SPI_EMPTY) ? PANEL_BUSY : PANEL_OK;
}

/* If its polls are not enough, wait() stays busy and panel_init() says so. */
static void abandon(void *user)
{
    (void)user;
    REGISTER(DMA_CONTROL) = 0;
    for (int i = 0; i < ABORT_POLLS && (REGISTER(DMA_CONTROL) & DMA_ON); i++) continue;
    REGISTER(DMA_CLEAR) = DMA_FLAGS;
}

static void delay_us(void *user, uint32_t us)
{
    (void)user;
    systick_delay_us(us, CLOCK_MHZ);
}

panel_status screen_open(panel *p, display *d)
{
    GN_PORT_DMA static uint8_t buffer[2][TILE_BYTES];
    const panel_bus bus = {.write = write, .wait = wait, .delay_us = delay_us, .abandon = abandon, .max_polls = POLLS};
    const panel_config config = {.width = 240, .height = 320, .turn = 1, .flags = PANEL_BGR};
    set_up_pins();
    panel_status status = panel_init(p, &panel_ili9341, &config, &bus);
    if (status) return status;
    *d = (display){
        .panel = p, .format = GN_FORMAT_SCREEN, .buffer = {buffer[0], buffer[1]}, .buffer_bytes = sizeof buffer[0]};
    return display_init(d);
}
