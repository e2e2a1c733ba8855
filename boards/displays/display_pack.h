/* The library's pixel formats as the controllers take them. */
#ifndef DISPLAY_PACK_H
#define DISPLAY_PACK_H

#include "display.h"

/* Bytes of one row of a tile, as the library stores it. */
size_t display_row_bytes(gn_format format, int w);

/* 1: the library's bytes are the panel's already. */
int display_is_native(gn_format format, panel_pixels pixels);

/* `n_rows` whole rows of a tile; pages: the last may have fewer than 8 rows, and gets dark ones. */
void display_pack(uint8_t *out, const uint8_t *in, gn_format format, panel_pixels pixels, int w, int n_rows);

/* A tile of the library's, w x h, that is seen turned clockwise. */
typedef struct {
    const uint8_t *in;
    gn_format format;
    int w, h;
    uint8_t quarter_turns;
} display_tile;

/* Rows y .. y + n_rows of the turned tile. */
void display_pack_turned(uint8_t *out, const display_tile *tile, panel_pixels pixels, int y, int n_rows);

/* The turned tile anywhere in the copy of a panel of `width` columns: 4 bits or 1 bit per pixel. */
void display_put(uint8_t *shadow, int width, const display_tile *tile, int x, int y);

#endif
