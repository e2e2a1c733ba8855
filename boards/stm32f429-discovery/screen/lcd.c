/* The board's own LCD: ILI9341, 240x320, on SPI5: select PC2, clock PF7, data PF9, data/command PD13; the read strobe
 * PD12 stays high. Its reset line is the board's. Stream 4 of DMA2 feeds the transmitter. */
#include "../../common/dma_screen.h"
#include "../../common/stm32f4.h"

enum { FUNCTION_SPI5 = 5 };

static const stm32f4_spi lcd = {
    .spi = STM32F4_SPI5,
    .enable = 1U << 20,
    .divider_log2 = 4, /* 84 MHz / 16 = 5.25 MHz; the controller's data sheet says up to 10 */
    .stream = 4,
    .channel = 2,
    .command_port = STM32F4_PORT_D,
    .command_pin = 13,
};

panel_status screen_open(panel *p, display *d)
{
    const panel_config config = {.width = 240, .height = 320, .turn = 1, .flags = PANEL_BGR};
    stm32f4_make_output(STM32F4_PORT_D, 12, 1);
    stm32f4_make_output(STM32F4_PORT_C, 1, 1); /* the gyroscope on this bus has a select of its own */
    stm32f4_make_output(STM32F4_PORT_C, 2, 0);
    stm32f4_set_function(STM32F4_PORT_F, 7, FUNCTION_SPI5);
    stm32f4_set_function(STM32F4_PORT_F, 9, FUNCTION_SPI5);
    const panel_bus bus = stm32f4_spi_open(&lcd);
    return dma_screen_open(p, d, &panel_ili9341, &config, &bus);
}
