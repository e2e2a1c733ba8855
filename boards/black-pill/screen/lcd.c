/* An ST7789 module, 240x320, on SPI1: clock PA5, data PA7, select PA4, data/command PB0, reset PB1, light PB10.
 * Stream 3 of DMA2 feeds the transmitter. */
#include "../../common/dma_screen.h"
#include "../../common/stm32f4.h"

enum { FUNCTION_SPI1 = 5, PIN_RESET = 1, PIN_LIGHT = 10 };

static const stm32f4_spi lcd = {
    .spi = STM32F4_SPI1,
    .enable = 1U << 12,
    .divider_log2 = 3, /* 100 MHz / 8 = 12.5 MHz; the controller's data sheet says up to 15 */
    .stream = 3,
    .channel = 3,
    .command_port = STM32F4_PORT_B,
    .command_pin = 0,
};

static void reset(void *user, int active)
{
    (void)user;
    stm32f4_set_pin(STM32F4_PORT_B, PIN_RESET, !active);
}

panel_status screen_open(panel *p, display *d)
{
    const panel_config config = {.width = 240, .height = 320, .turn = 1, .flags = PANEL_INVERT};
    stm32f4_make_output(STM32F4_PORT_A, 4, 0); /* alone on the bus: selected for good */
    stm32f4_make_output(STM32F4_PORT_B, PIN_RESET, 1);
    stm32f4_make_output(STM32F4_PORT_B, PIN_LIGHT, 1);
    stm32f4_set_function(STM32F4_PORT_A, 5, FUNCTION_SPI1);
    stm32f4_set_function(STM32F4_PORT_A, 7, FUNCTION_SPI1);
    panel_bus bus = stm32f4_spi_open(&lcd);
    bus.reset = reset;
    return dma_screen_open(p, d, &panel_st7789, &config, &bus);
}
