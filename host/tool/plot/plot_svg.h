/* What every plot has in common: the document, its colours for light and dark screens, text. */
#ifndef GNOMON_PLOT_SVG_H
#define GNOMON_PLOT_SVG_H

#include <stdio.h>

/* Layout of all plots, pixels. */
enum { SVG_WIDTH = 960, SVG_TITLE = 34, SVG_LEFT = 70, SVG_RIGHT = 24, SVG_FONT = 11, SVG_LETTER = 6 };

/* The file with the head and the title; NULL with one line in error. svg_end closes it: 0, or -1 with one line in
 * error. */
FILE *svg_begin(const char *path, const char *title, int height, char *error, size_t error_bytes);
int svg_end(FILE *f, int failed, char *error, size_t error_bytes);

/* Text without markup, and a text element of a class (NULL: none) at a place; anchor: start, middle or end. */
void svg_text(FILE *f, const char *text);
void svg_label(FILE *f, const char *class, double x, double y, const char *anchor, const char *text);

#endif
