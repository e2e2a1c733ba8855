/* The bus of panel_linear: memory that a display controller reads by itself, 16 bits per pixel. */
#ifndef FRAMEBUFFER_H
#define FRAMEBUFFER_H

#include "panel.h"

typedef struct {
    uint8_t *pixels;      /* RGB565, low byte first */
    uint32_t pitch_bytes; /* from row to row */
    uint16_t width, height;
    uint16_t window[4]; /* x, y, w, h */
    uint32_t at_bytes;  /* into the window */
} framebuffer;

/* Fills in the callbacks; `f` has its first four fields set and outlives the panel. */
void framebuffer_bus(framebuffer *f, panel_bus *bus);

#endif
