/* A display on a bus that DMA feeds: two buffers of a screen tile each, the panel, and what joins it to the library.
 * For the screens of boards: SCREEN_FORMAT is that of their board.mk. */
#ifndef GNOMON_BOARDS_DMA_SCREEN_H
#define GNOMON_BOARDS_DMA_SCREEN_H

#include "../displays/screen.h"
#include "gn_port.h"
#include "systick.h"

enum { DMA_SCREEN_POLLS = 10000000, DMA_SCREEN_BYTES = GN_TILE_WIDTH * GN_TILE_HEIGHT * 2 };

/* Of a bus whose `user` is the core's clock in MHz. */
static inline void dma_screen_delay_us(void *mhz, uint32_t us)
{
    systick_delay_us(us, *(const uint32_t *)mhz);
}

/* The bus is ready, its pins are set. */
static inline panel_status dma_screen_open(panel *p, display *d, const panel_driver *driver, const panel_config *config,
                                           const panel_bus *bus)
{
    GN_PORT_DMA static uint8_t buffer[2][DMA_SCREEN_BYTES];
    const panel_status status = panel_init(p, driver, config, bus);
    if (status) return status;
    *d = (display){
        .panel = p, .format = GN_FORMAT_SCREEN, .buffer = {buffer[0], buffer[1]}, .buffer_bytes = sizeof buffer[0]};
    return display_init(d);
}

#endif
