/* What is printed, on GP0 at 115200 baud: UART0. */
#include "start.h"

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))
#define ATOMIC_CLEAR      0x3000U /* a write to the alias clears the bits */

enum {
    RESETS = 0x4000C000,
    RESET_DONE = 0x4000C008,
    USED = 1 << 5 | 1 << 8 | 1 << 22, /* the pins and UART0 */
    GP0_CONTROL = 0x40014004,
    FUNCTION_UART = 2,
    UART_DATA = 0x40034000,
    UART_FLAGS = 0x40034018,
    UART_FULL = 1 << 5,
    UART_DIVISOR = 0x40034024,
    UART_FRACTION = 0x40034028,
    UART_LINE = 0x4003402C,
    UART_CONTROL = 0x40034030
};

static void set_up(void)
{
    REGISTER(RESETS + ATOMIC_CLEAR) = USED;
    while ((REGISTER(RESET_DONE) & USED) != USED) continue;
    REGISTER(UART_DIVISOR) = 67; /* 125 MHz / 16 / 115200 = 67 + 52/64 */
    REGISTER(UART_FRACTION) = 52;
    REGISTER(UART_LINE) = 3U << 5 | 1U << 4;    /* 8 bits, the queue */
    REGISTER(UART_CONTROL) = 1U << 8 | 1U << 0; /* on, transmits */
    REGISTER(GP0_CONTROL) = FUNCTION_UART;
}

void board_serial(const char *text)
{
    if (!(REGISTER(RESET_DONE) & 1U << 22)) set_up();
    for (; *text; text++) {
        while (REGISTER(UART_FLAGS) & UART_FULL) continue;
        REGISTER(UART_DATA) = (uint8_t)*text;
    }
}
