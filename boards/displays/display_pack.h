/* The library's pixel formats as the controllers take them. */
#ifndef DISPLAY_PACK_H
#define DISPLAY_PACK_H

#include "gnomon.h"
#include "panel.h"

/* Bytes of one row of a tile, as the library stores it. */
size_t display_row_bytes(gn_format format, int w);

/* 1: the library's bytes are the panel's already. */
int display_is_native(gn_format format, panel_pixels pixels);

/* `n_rows` whole rows of a tile; pages: the last may have fewer than 8 rows, and gets dark ones. */
void display_pack(uint8_t *out, const uint8_t *in, gn_format format, panel_pixels pixels, int w, int n_rows);

/* A tile anywhere in the copy of a panel of `width` columns. */
void display_put(uint8_t *shadow, int width, panel_pixels pixels, int x, int y, int w, int h, const uint8_t *in);

#endif
