/* What is printed, on PA9 at 115200 baud: USART1, which the board's debugger shows as a serial port. */
#include "start.h"

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

enum {
    RCC_AHB1ENR = 0x40023830,
    RCC_APB2ENR = 0x40023844,
    PORT_A = 1 << 0,
    USART1_ON = 1 << 4,
    PA_MODE = 0x40020000,
    PA_FUNCTION_HIGH = 0x40020024,
    USART_STATUS = 0x40011000,
    USART_DATA = 0x40011004,
    USART_DIVISOR = 0x40011008,
    USART_CONTROL = 0x4001100C,
    USART_EMPTY = 1 << 7
};

static void set_up(void)
{
    REGISTER(RCC_AHB1ENR) |= PORT_A;
    REGISTER(RCC_APB2ENR) |= USART1_ON;
    REGISTER(PA_FUNCTION_HIGH) = (REGISTER(PA_FUNCTION_HIGH) & ~(15U << 4)) | 7U << 4;
    REGISTER(PA_MODE) = (REGISTER(PA_MODE) & ~(3U << 18)) | 2U << 18;
    REGISTER(USART_DIVISOR) = 729;                /* 84 MHz / 115200 */
    REGISTER(USART_CONTROL) = 1U << 13 | 1U << 3; /* on, transmits */
}

void board_serial(const char *text)
{
    if (!(REGISTER(RCC_APB2ENR) & USART1_ON)) set_up();
    for (; *text; text++) {
        while (!(REGISTER(USART_STATUS) & USART_EMPTY)) continue;
        REGISTER(USART_DATA) = (uint8_t)*text;
    }
}
