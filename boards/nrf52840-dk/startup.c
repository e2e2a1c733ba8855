/* nRF52840: 64 MHz without being asked; from the crystal, which is exact enough for the serial line, with the cache of
 * the flash. What is printed goes to the debugger's serial port: P0.06, 115200 baud. */
#include "cortex_m.h"

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

enum {
    CLOCK_START_CRYSTAL = 0x40000000,
    CLOCK_CRYSTAL_STARTED = 0x40000100,
    FLASH_CACHE = 0x4001E540,
    PORT0_OUTPUT_HIGH = 0x50000508,
    PORT0_MAKE_OUTPUT = 0x50000518,
    UART_START_TRANSMIT = 0x40002008,
    UART_SENT = 0x4000211C,
    UART_ENABLE = 0x40002500,
    UART_PIN = 0x4000250C,
    UART_DATA = 0x4000251C,
    UART_RATE = 0x40002524,
    UART_ON = 4,
    RATE_115200 = 0x01D7E000,
    PIN_SERIAL = 6
};

static void reset(void)
{
    REGISTER(FLASH_CACHE) = 1;
    REGISTER(CLOCK_START_CRYSTAL) = 1;
    while (!REGISTER(CLOCK_CRYSTAL_STARTED)) continue;
    board_start();
}

extern const cortex_m_vectors vectors;
__attribute__((section(".vectors"), used)) const cortex_m_vectors vectors = CORTEX_M_VECTORS(reset);

static void open_serial(void)
{
    REGISTER(PORT0_OUTPUT_HIGH) = 1U << PIN_SERIAL;
    REGISTER(PORT0_MAKE_OUTPUT) = 1U << PIN_SERIAL;
    REGISTER(UART_PIN) = PIN_SERIAL;
    REGISTER(UART_RATE) = RATE_115200;
    REGISTER(UART_ENABLE) = UART_ON;
    REGISTER(UART_START_TRANSMIT) = 1;
}

void board_serial(const char *text)
{
    if (REGISTER(UART_ENABLE) != UART_ON) open_serial();
    for (; *text; text++) {
        REGISTER(UART_SENT) = 0;
        REGISTER(UART_DATA) = (uint8_t)*text;
        while (!REGISTER(UART_SENT)) continue;
    }
}
