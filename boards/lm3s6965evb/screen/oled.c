/* OSRAM Pictiva 128x64 with an SSD0323 on SSI0: clock PA2, select PA3, data PA5; data/command PC7, 15 V supply PC6. PD0
 * is the SD card's select on the same bus, and stays high. No reset line.
 *
 * No DMA: wait() refills the transmitter's FIFO, eight bytes at a time, and the core draws in between. */
#include "../../common/systick.h"
#include "../../displays/screen.h"

#define REGISTER(address) (*(volatile uint32_t *)(address))

enum {
    RCGC1 = 0x400FE104,
    RCGC2 = 0x400FE108,
    GPIO_A = 0x40004000,
    GPIO_C = 0x40006000,
    GPIO_D = 0x40007000,
    GPIO_DIR = 0x400,
    GPIO_AFSEL = 0x420,
    GPIO_DEN = 0x51C,
    SSI0_CR0 = 0x40008000,
    SSI0_CR1 = 0x40008004,
    SSI0_DR = 0x40008008,
    SSI0_SR = 0x4000800C,
    SSI0_CPSR = 0x40008010,
    SR_NOT_FULL = 2,
    SR_NOT_EMPTY = 4, /* of the receiver */
    SR_BUSY = 16,
    PIN_COMMAND = 1 << 7,
    PIN_SUPPLY = 1 << 6,
    PIN_CARD = 1 << 0,
    CLOCK_MHZ = 12, /* the internal oscillator: after reset */
    POLLS = 100000,
    TILE_BYTES = GN_TILE_WIDTH * GN_TILE_HEIGHT / 2
};

/* The bits of the address mask the pins. */
static void set_pin(uint32_t port, uint32_t pin, int high)
{
    REGISTER(port + (pin << 2)) = high ? pin : 0;
}

static void make_output(uint32_t port, uint32_t pins)
{
    REGISTER(port + GPIO_DIR) |= pins;
    REGISTER(port + GPIO_DEN) |= pins;
}

static void set_up_pins(void)
{
    REGISTER(RCGC1) |= 1U << 4; /* SSI0 */
    REGISTER(RCGC2) |= 0xDU;    /* ports A, C, D */
    (void)REGISTER(RCGC2);      /* three clocks until they may be used */
    make_output(GPIO_C, PIN_COMMAND | PIN_SUPPLY);
    make_output(GPIO_D, PIN_CARD);
    set_pin(GPIO_D, PIN_CARD, 1);
    set_pin(GPIO_C, PIN_SUPPLY, 1);
    REGISTER(GPIO_A + GPIO_AFSEL) |= 0x2CU;
    REGISTER(GPIO_A + GPIO_DEN) |= 0x2CU;
    REGISTER(SSI0_CR1) = 0;
    REGISTER(SSI0_CPSR) = 4; /* 3 MHz; the controller takes 4 */
    REGISTER(SSI0_CR0) =
        0x47U; /* 8 bits; the clock rests high, data changes on its rising edge: as the board's maker has it */
    REGISTER(SSI0_CR1) = 2;
}

/* ---- The bus ----------------------------------------------------------------------------------------------------- */

typedef struct {
    const uint8_t *next;
    size_t left;
} transfer;

static panel_status write(void *user, const uint8_t *bytes, size_t n, int is_data)
{
    transfer *t = (transfer *)user;
    set_pin(GPIO_C, PIN_COMMAND, is_data);
    t->next = bytes;
    t->left = n;
    return PANEL_OK;
}

static panel_status wait(void *user)
{
    transfer *t = (transfer *)user;
    while (t->left > 0 && (REGISTER(SSI0_SR) & SR_NOT_FULL)) {
        REGISTER(SSI0_DR) = *t->next++;
        t->left--;
        while (REGISTER(SSI0_SR) & SR_NOT_EMPTY) (void)REGISTER(SSI0_DR);
    }
    return t->left > 0 || (REGISTER(SSI0_SR) & SR_BUSY) ? PANEL_BUSY : PANEL_OK;
}

static void abandon(void *user)
{
    ((transfer *)user)->left = 0;
}

static void delay_us(void *user, uint32_t us)
{
    (void)user;
    systick_delay_us(us, CLOCK_MHZ);
}

panel_status screen_open(panel *p, display *d)
{
    static transfer t;
    static uint8_t buffer[2][TILE_BYTES];
    const panel_bus bus = {
        .user = &t, .write = write, .wait = wait, .delay_us = delay_us, .abandon = abandon, .max_polls = POLLS};
    const panel_config config = {.width = 128, .height = 64, .flags = PANEL_EXTERNAL_VCC, .first_com = 0x4C};
    set_up_pins();
    panel_status status = panel_init(p, &panel_ssd0323, &config, &bus);
    if (status) return status;
    *d = (display){
        .panel = p, .format = GN_FORMAT_GREY4, .buffer = {buffer[0], buffer[1]}, .buffer_bytes = sizeof buffer[0]};
    return display_init(d);
}
