/* An ST7789 of 240x240 at SPI 0: SCK 18, MOSI 19, DC 16, CS 17, its reset tied high. */
#include "hardware/gpio.h"
#include "hardware/spi.h"
#include "pico/stdlib.h"

enum { SIDE = 240, DC = 16, CS = 17, SCK = 18, MOSI = 19, HZ = 40000000 };
enum { SLEEP_OUT = 0x11, INVERT = 0x21, DISPLAY_ON = 0x29, COLUMNS = 0x2A, ROWS = 0x2B, PIXELS = 0x2C, FORMAT = 0x3A };

static void send(uint8_t command, const void *bytes, size_t n)
{
    gpio_put(CS, 0);
    gpio_put(DC, 0);
    spi_write_blocking(spi0, &command, 1);
    gpio_put(DC, 1);
    if (n) spi_write_blocking(spi0, (const uint8_t *)bytes, n);
    gpio_put(CS, 1);
}

void st7789_begin(void)
{
    static const uint8_t outputs[] = {DC, CS}, side[] = {0, 0, 0, SIDE - 1}, bits_16[] = {0x55};
    spi_init(spi0, HZ);
    gpio_set_function(SCK, GPIO_FUNC_SPI);
    gpio_set_function(MOSI, GPIO_FUNC_SPI);
    for (int i = 0; i < 2; i++) {
        gpio_init(outputs[i]);
        gpio_set_dir(outputs[i], 1);
    }
    send(SLEEP_OUT, 0, 0);
    sleep_ms(120);
    send(FORMAT, bits_16, sizeof bits_16);
    send(COLUMNS, side, sizeof side);
    send(ROWS, side, sizeof side);
    send(INVERT, 0, 0); /* as most of these glasses want it */
    send(DISPLAY_ON, 0, 0);
}

/* RGB565, the high byte first */
void st7789_show(const uint16_t pixels[SIDE * SIDE])
{
    send(PIXELS, pixels, 2 * SIDE * SIDE);
}
