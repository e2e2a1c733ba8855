/* What boards with an STM32F4 share: clocks, pins, and a serial bus fed by DMA. A board's startup.c says its clocks;
 * its screen says which pins. */
#ifndef GNOMON_BOARDS_STM32F4_H
#define GNOMON_BOARDS_STM32F4_H

#include <stdint.h>

#include "../displays/panel.h"

#define STM32F4_REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

typedef struct {
    uint32_t pll, prescalers, wait_states; /* as the registers have them: RCC_PLLCFGR, RCC_CFGR, FLASH_ACR */
    uint32_t core_mhz, apb2_mhz;
} stm32f4_clocks;

extern const stm32f4_clocks stm32f4_clock; /* the board's */

enum {
    STM32F4_PORT_A = 0x40020000,
    STM32F4_PORT_B = 0x40020400,
    STM32F4_PORT_C = 0x40020800,
    STM32F4_PORT_D = 0x40020C00,
    STM32F4_PORT_F = 0x40021400,
    STM32F4_SPI1 = 0x40013000,
    STM32F4_SPI5 = 0x40015000
};

void stm32f4_set_pin(uint32_t port, uint32_t pin, int high);
void stm32f4_make_output(uint32_t port, uint32_t pin, int high);
void stm32f4_set_function(uint32_t port, uint32_t pin, uint32_t function);

/* An SPI on APB2 whose transmitter a stream of DMA2 feeds. */
typedef struct {
    uint32_t spi, enable, divider_log2; /* its address and its bit in RCC_APB2ENR; APB2's clock by 2 to 256 */
    uint32_t stream, channel;
    uint32_t command_port, command_pin; /* the data/command line */
} stm32f4_spi;

/* Switches it on, mode 0, 8 bits; its own pins are the board's. The bus refers to *spi. */
panel_bus stm32f4_spi_open(const stm32f4_spi *spi);

#endif
