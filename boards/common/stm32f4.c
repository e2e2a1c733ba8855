/* From reset to the clock of the crystal; pins; what is printed, on PA9 at 115200 baud: USART1. */
#include "stm32f4.h"

#include "cortex_m.h"

#define REGISTER STM32F4_REGISTER

enum {
    FLASH_ACR = 0x40023C00,
    FLASH_CACHED = 7 << 8, /* both caches and prefetch */
    PWR_CR = 0x40007000,
    PWR_FASTEST = 3 << 14, /* the core's voltage for the highest clock */
    RCC_CR = 0x40023800,
    RCC_PLLCFGR = 0x40023804,
    RCC_CFGR = 0x40023808,
    RCC_AHB1ENR = 0x40023830,
    RCC_APB1ENR = 0x40023840,
    RCC_APB2ENR = 0x40023844,
    HSE_ON = 1 << 16,
    HSE_READY = 1 << 17,
    PLL_ON = 1 << 24,
    PLL_READY = 1 << 25,
    POWER_ON = 1 << 28,
    USART1_ON = 1 << 4,
    USART_STATUS = 0x40011000,
    USART_DATA = 0x40011004,
    USART_DIVISOR = 0x40011008,
    USART_CONTROL = 0x4001100C,
    USART_EMPTY = 1 << 7,
    USART_PIN = 9,
    USART_FUNCTION = 7,
    BAUD = 115200,
    PORT_MODE = 0x00,
    PORT_SPEED = 0x08,
    PORT_SET_RESET = 0x18,
    PORT_FUNCTION = 0x20, /* four bits per pin */
    MODE_OUTPUT = 1,
    MODE_FUNCTION = 2
};

static void reset(void)
{
    REGISTER(RCC_CR) |= HSE_ON;
    while (!(REGISTER(RCC_CR) & HSE_READY)) continue;
    REGISTER(RCC_APB1ENR) |= POWER_ON;
    REGISTER(PWR_CR) |= PWR_FASTEST;
    REGISTER(FLASH_ACR) = FLASH_CACHED | stm32f4_clock.wait_states;
    REGISTER(RCC_PLLCFGR) = stm32f4_clock.pll;
    REGISTER(RCC_CFGR) = stm32f4_clock.prescalers;
    REGISTER(RCC_CR) |= PLL_ON;
    while (!(REGISTER(RCC_CR) & PLL_READY)) continue;
    REGISTER(RCC_CFGR) |= 2U;
    while ((REGISTER(RCC_CFGR) & 12U) != 8U) continue;
    board_start();
}

extern const cortex_m_vectors vectors;
__attribute__((section(".vectors"), used)) const cortex_m_vectors vectors = CORTEX_M_VECTORS(reset);

/* ---- Pins -------------------------------------------------------------------------------------------------------- */

void stm32f4_set_pin(uint32_t port, uint32_t pin, int high)
{
    REGISTER(port + PORT_SET_RESET) = 1U << (high ? pin : pin + 16);
}

/* Ports lie 1 KB apart, and so do their bits of the clock. */
static void set_mode(uint32_t port, uint32_t pin, uint32_t mode)
{
    REGISTER(RCC_AHB1ENR) |= 1U << (port - STM32F4_PORT_A) / 1024;
    (void)REGISTER(RCC_AHB1ENR); /* until the clock runs */
    REGISTER(port + PORT_SPEED) |= 2U << 2 * pin;
    REGISTER(port + PORT_MODE) = (REGISTER(port + PORT_MODE) & ~(3U << 2 * pin)) | mode << 2 * pin;
}

void stm32f4_make_output(uint32_t port, uint32_t pin, int high)
{
    set_mode(port, pin, MODE_OUTPUT);
    stm32f4_set_pin(port, pin, high);
}

void stm32f4_set_function(uint32_t port, uint32_t pin, uint32_t function)
{
    uint32_t address = port + PORT_FUNCTION + pin / 8 * 4, shift = pin % 8 * 4;
    set_mode(port, pin, MODE_FUNCTION);
    REGISTER(address) = (REGISTER(address) & ~(15U << shift)) | function << shift;
}

/* ---- The serial line --------------------------------------------------------------------------------------------- */

static void open_serial(void)
{
    REGISTER(RCC_APB2ENR) |= USART1_ON;
    stm32f4_set_function(STM32F4_PORT_A, USART_PIN, USART_FUNCTION);
    REGISTER(USART_DIVISOR) = (stm32f4_clock.apb2_mhz * 1000000U + BAUD / 2) / BAUD;
    REGISTER(USART_CONTROL) = 1U << 13 | 1U << 3; /* on, transmits */
}

void board_serial(const char *text)
{
    if (!(REGISTER(RCC_APB2ENR) & USART1_ON)) open_serial();
    for (; *text; text++) {
        while (!(REGISTER(USART_STATUS) & USART_EMPTY)) continue;
        REGISTER(USART_DATA) = (uint8_t)*text;
    }
}
