/* From the library's screen tiles to a panel: display_flush is a gn_flush_fn, its `user` a display.
 *
 * Two buffers take turns: a tile, or as many of its rows as fit, is converted into one while the other is under way,
 * and the library draws its next tile meanwhile. The bytes that DMA reads are in these buffers alone, so that they are
 * what has to lie in memory that it reaches. Without buffers a tile is sent from where the library drew it, and waited
 * for.
 *
 * The panels of 4 bits and of 1 bit per pixel keep several pixels in a byte. Tiles whose borders cut such bytes need
 * the `shadow`, a copy of the panel's memory: the byte's other pixels come from there. With tiles that respect the
 * borders (x and w even; for pages y and h multiples of 8, that is GN_TILE_HEIGHT 8 or 16) there is no need of one.
 *
 * The picture may fill a rectangle of the panel. Colour controllers turn by quarters themselves (panel_config.turn);
 * where the controller cannot, tiles are turned on their way: pixel by pixel, which takes the time of a conversion.
 * Borders then are those of the turned tile. */
#ifndef DISPLAY_H
#define DISPLAY_H

#include "gnomon.h"
#include "panel.h"

#ifndef DISPLAY_TURNS
#define DISPLAY_TURNS 1 /* 0: quarter_turns is 0, and turning takes no flash */
#endif

typedef struct {
    panel *panel;
    gn_format format;   /* of the picture: RGB565 or RGB565_SWAPPED; GREY4; MONO1 */
    uint8_t *buffer[2]; /* `buffer_bytes` each, at least a row of a tile (pages: eight rows); or NULL, both */
    size_t buffer_bytes;
    uint8_t *shadow;        /* display_shadow_bytes(), cleared, or NULL */
    panel_status status;    /* the first error since display_finish() */
    uint8_t turn;           /* the buffer that is filled next */
    uint8_t quarter_turns;  /* of the picture, clockwise, 0 .. 3; needs the buffers */
    uint16_t x, y;          /* of the rectangle on the panel */
    uint16_t width, height; /* of the picture, before it is turned; 0: the rectangle ends with the panel */
} display;

/* Checks that panel and format fit; the panel has been initialised. */
panel_status display_init(display *d);
size_t display_shadow_bytes(const panel *p);

/* After an error it does nothing: the frame goes on, and display_finish() tells. */
void display_flush(void *d, int x, int y, int w, int h, const void *pixels);

/* Waits for the last tile; the frame's first error, which it forgets. After an error of the bus: panel_init(), and draw
 * anew. */
panel_status display_finish(display *d);

#endif
