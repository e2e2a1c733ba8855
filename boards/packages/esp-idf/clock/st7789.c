/* An ST7789 on the SPI pins of an ESP32-S3: clock GPIO12, data GPIO11, select GPIO10, data/command GPIO9, reset GPIO8.
 */
#include "driver/spi_master.h"
#include "esp_lcd_panel_commands.h"
#include "esp_lcd_panel_io.h"
#include "esp_lcd_panel_ops.h"
#include "esp_lcd_panel_vendor.h"

enum { CLOCK = 12, DATA = 11, SELECT = 10, COMMAND = 9, RESET = 8, HERTZ = 40000000 };

static esp_lcd_panel_io_handle_t io;
static esp_lcd_panel_handle_t panel;

int panel_open(int width, int height);
void panel_write(void *user, int x, int y, int w, int h, const void *pixels);

int panel_open(int width, int height)
{
    const spi_bus_config_t bus = {.sclk_io_num = CLOCK,
                                  .mosi_io_num = DATA,
                                  .miso_io_num = -1,
                                  .quadwp_io_num = -1,
                                  .quadhd_io_num = -1,
                                  .max_transfer_sz = width * height * 2};
    const esp_lcd_panel_io_spi_config_t wires = {.cs_gpio_num = SELECT,
                                                 .dc_gpio_num = COMMAND,
                                                 .pclk_hz = HERTZ,
                                                 .trans_queue_depth = 1,
                                                 .lcd_cmd_bits = 8,
                                                 .lcd_param_bits = 8};
    const esp_lcd_panel_dev_config_t glass = {.reset_gpio_num = RESET, .bits_per_pixel = 16};
    if (spi_bus_initialize(SPI2_HOST, &bus, SPI_DMA_CH_AUTO)) return -1;
    if (esp_lcd_new_panel_io_spi((esp_lcd_spi_bus_handle_t)SPI2_HOST, &wires, &io)) return -1;
    if (esp_lcd_new_panel_st7789(io, &glass, &panel)) return -1;
    if (esp_lcd_panel_reset(panel) || esp_lcd_panel_init(panel)) return -1;
    return esp_lcd_panel_invert_color(panel, true) || esp_lcd_panel_disp_on_off(panel, true) ? -1 : 0;
}

/* The driver sends a tile while the program goes on, and a command waits for that: the next tile is drawn over it. */
void panel_write(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    esp_lcd_panel_draw_bitmap(panel, x, y, x + w, y + h, pixels);
    esp_lcd_panel_io_tx_param(io, LCD_CMD_NOP, NULL, 0);
}
