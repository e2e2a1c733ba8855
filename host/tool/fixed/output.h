/* The library's output formats as people see them: what a panel of that format would show, as 8-bit RGB. */
#ifndef GNOMON_OUTPUT_H
#define GNOMON_OUTPUT_H

#include "gnomon.h"

extern const char *const output_names[]; /* by gn_format; ends with NULL */

/* One screen tile as flushed, at (x, y) of an RGB picture `width` pixels wide. */
void output_decode(gn_format format, int x, int y, int w, int h, const void *pixels, uint8_t *rgb8, int width);

/* A picture in any format, as seen: gn_flush_fn with one of these as user. */
typedef struct {
    uint8_t *rgb8;
    int width;
    gn_format format;
} output_panel;
void output_flush(void *user, int x, int y, int w, int h, const void *pixels);

/* Levels above 0 of red, green and blue. Greys: so many that nothing is rounded. */
const double *output_levels(gn_format format);

/* Rounds the reference's colour to a format, as levels of 8 bits: `encoded` is the colour after the encoding curve,
 * 0..1; (x, y) its pixel, which mono1 dithers by. */
void output_quantise(gn_format format, const double encoded[3], int srgb, int x, int y, uint8_t rgb8[3]);

#endif
