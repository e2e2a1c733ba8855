/* Files and text inside a page that needs no other file. */
#ifndef GNOMON_REPORT_EMBED_H
#define GNOMON_REPORT_EMBED_H

#include <stddef.h>
#include <stdio.h>

/* The bytes of a file and a 0 behind them, to free(); NULL: it cannot be read. */
char *embed_read(const char *path, size_t *n_bytes);

/* Text without markup. */
void embed_text(FILE *page, const char *text);

/* A picture as a data URI, a plot as an svg element, a file as it is; -1: it cannot be read. */
int embed_png(FILE *page, const char *path);
int embed_svg(FILE *page, const char *path);
int embed_file(FILE *page, const char *path);

#endif
