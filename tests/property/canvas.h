/* A picture in memory that a renderer flushes to, with how often each pixel came. */
#ifndef GNOMON_TESTS_CANVAS_H
#define GNOMON_TESTS_CANVAS_H

#include <stdlib.h>
#include <string.h>

#include "demo_scene.h"

typedef struct {
    uint8_t *pixels, *times; /* bytes of the picture; how often each pixel was flushed */
    int width, height;
    size_t n_bytes;
    int bits; /* per pixel */
    long n_calls, n_outside;
} canvas;

/* Rows are of whole bytes. */
static inline size_t row_bytes(const canvas *c, int width)
{
    return ((size_t)width * (size_t)c->bits + 7) / 8;
}

static inline void canvas_begin(canvas *c, int width, int height, gn_format format)
{
    static const int bits[] = {16, 24, 16, 8, 4, 1, 32};
    memset(c, 0, sizeof *c);
    c->width = width;
    c->height = height;
    c->bits = bits[format];
    c->n_bytes = row_bytes(c, width) * (size_t)height;
    c->pixels = calloc(c->n_bytes, 1);
    c->times = calloc((size_t)width * (size_t)height, 1);
    if (!c->pixels || !c->times) abort();
}

static inline void canvas_end(canvas *c)
{
    free(c->pixels);
    free(c->times);
}

static inline uint32_t canvas_crc(const canvas *c)
{
    return demo_crc32(0, c->pixels, c->n_bytes);
}

static inline void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    canvas *c = user;
    c->n_calls++;
    if (x < 0 || y < 0 || w < 1 || h < 1 || x + w > c->width || y + h > c->height) {
        c->n_outside++;
        return;
    }
    for (int row = 0; row < h; row++) {
        size_t at = (size_t)(y + row) * (size_t)c->width + (size_t)x, n = row_bytes(c, w);
        uint8_t *to = c->pixels + (size_t)(y + row) * row_bytes(c, c->width) + (size_t)x * (size_t)c->bits / 8;
        memcpy(to, (const uint8_t *)pixels + (size_t)row * n, n);
        for (int i = 0; i < w; i++) c->times[at + (size_t)i]++;
    }
}

static inline int each_pixel_once(const canvas *c)
{
    for (size_t i = 0; i < (size_t)c->width * (size_t)c->height; i++)
        if (c->times[i] != 1) return 0;
    return c->n_outside == 0;
}

static inline gn_picture picture_of(int width, int height, gn_format format)
{
    gn_picture p = {.width = (uint16_t)width, .height = (uint16_t)height, .format = format, .view = GN_VIEW_COLOUR};
    return p;
}

/* Renders with one renderer from scratch; 0 if it fails. */
static inline uint32_t crc_of(gn_renderer *r, const gn_scene *s, int width, int height, gn_format format)
{
    gn_picture p = picture_of(width, height, format);
    canvas c;
    canvas_begin(&c, width, height, format);
    int ok = gn_init(r, &p) == GN_OK && gn_render(r, s, flush, &c) == GN_OK && each_pixel_once(&c);
    uint32_t crc = canvas_crc(&c);
    canvas_end(&c);
    return ok ? crc : 0;
}

#endif
