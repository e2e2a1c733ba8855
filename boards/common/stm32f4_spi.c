/* A panel's bus: SPI, fed by DMA2. */
#include "gn_port.h"
#include "stm32f4.h"
#include "systick.h"

#define REGISTER STM32F4_REGISTER

enum {
    RCC_AHB1ENR = 0x40023830,
    RCC_APB2ENR = 0x40023844,
    DMA2_ON = 1 << 22,
    SPI_CR1 = 0x00,
    SPI_CR2 = 0x04,
    SPI_SR = 0x08,
    SPI_DR = 0x0C,
    SPI_MASTER = 1 << 2 | 1 << 6 | 3 << 8, /* enabled, selected by software */
    SPI_DMA_TRANSMIT = 2,
    SPI_EMPTY = 2, /* the transmitter */
    SPI_BUSY = 1 << 7,
    DMA2 = 0x40026400,
    DMA_STATUS = 0x00, /* of streams 0 to 3, then of 4 to 7 */
    DMA_CLEAR = 0x08,
    DMA_STREAM = 0x10, /* 24 bytes each */
    STREAM_CONTROL = 0x00,
    STREAM_COUNT = 0x04,
    STREAM_PERIPHERAL = 0x08,
    STREAM_MEMORY = 0x0C,
    STREAM_FLAGS = 0x3D,
    STREAM_FAILED = 0x0C,
    STREAM_ON = 1,
    STREAM_MOST = 65535,
    STREAM_BYTES = 1 << 6 | 1 << 10, /* memory to peripheral, memory steps */
    POLLS = 10000000,
    ABORT_POLLS = 10000
};

static uint32_t stream(const stm32f4_spi *s)
{
    return DMA2 + DMA_STREAM + 24 * s->stream;
}

static uint32_t flags_address(const stm32f4_spi *s, uint32_t what)
{
    return DMA2 + what + s->stream / 4 * 4;
}

static uint32_t flags_shift(const stm32f4_spi *s)
{
    return s->stream % 4 * 6 + s->stream % 4 / 2 * 4; /* 0, 6, 16, 22 */
}

static panel_status write(void *user, const uint8_t *bytes, size_t n, int is_data)
{
    const stm32f4_spi *s = user;
    const uint32_t at = stream(s), control = STREAM_BYTES | s->channel << 25;
    if (n > STREAM_MOST) return PANEL_ERR_LENGTH;
    stm32f4_set_pin(s->command_port, s->command_pin, is_data);
    REGISTER(flags_address(s, DMA_CLEAR)) = (uint32_t)STREAM_FLAGS << flags_shift(s);
    REGISTER(at + STREAM_CONTROL) = control;
    REGISTER(at + STREAM_PERIPHERAL) = s->spi + SPI_DR;
    REGISTER(at + STREAM_MEMORY) = (uint32_t)(uintptr_t)bytes;
    REGISTER(at + STREAM_COUNT) = (uint32_t)n;
    gn_port_before_dma(bytes, n);
    REGISTER(at + STREAM_CONTROL) = control | STREAM_ON;
    return PANEL_OK;
}

/* The stream switches itself off at its end. */
static panel_status wait(void *user)
{
    const stm32f4_spi *s = user;
    if (REGISTER(flags_address(s, DMA_STATUS)) >> flags_shift(s) & STREAM_FAILED) return PANEL_ERR_BUS;
    if (REGISTER(stream(s) + STREAM_CONTROL) & STREAM_ON) return PANEL_BUSY;
    uint32_t spi = REGISTER(s->spi + SPI_SR);
    return (spi & SPI_BUSY) || !(spi & SPI_EMPTY) ? PANEL_BUSY : PANEL_OK;
}

/* If its polls are not enough, wait() stays busy and panel_init() says so. */
static void abandon(void *user)
{
    const stm32f4_spi *s = user;
    REGISTER(stream(s) + STREAM_CONTROL) = 0;
    for (int i = 0; i < ABORT_POLLS && (REGISTER(stream(s) + STREAM_CONTROL) & STREAM_ON); i++) continue;
    REGISTER(flags_address(s, DMA_CLEAR)) = (uint32_t)STREAM_FLAGS << flags_shift(s);
}

static void delay_us(void *user, uint32_t us)
{
    (void)user;
    systick_delay_us(us, stm32f4_clock.core_mhz);
}

panel_bus stm32f4_spi_open(const stm32f4_spi *spi)
{
    stm32f4_make_output(spi->command_port, spi->command_pin, 0);
    REGISTER(RCC_AHB1ENR) |= DMA2_ON;
    REGISTER(RCC_APB2ENR) |= spi->enable;
    (void)REGISTER(RCC_APB2ENR); /* until the clocks run */
    REGISTER(spi->spi + SPI_CR1) = 0;
    REGISTER(spi->spi + SPI_CR2) = SPI_DMA_TRANSMIT;
    REGISTER(spi->spi + SPI_CR1) = SPI_MASTER | (spi->divider_log2 - 1U) << 3;
    return (panel_bus){.user = (void *)(uintptr_t)spi,
                       .write = write,
                       .wait = wait,
                       .delay_us = delay_us,
                       .abandon = abandon,
                       .max_polls = POLLS};
}
