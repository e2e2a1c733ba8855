/* What the tests of panel drivers stand on: the panels that there are models of, a rig of bus, model and display, and
 * drawing random tiles into it. */
#ifndef GNOMON_TESTS_PANEL_RIG_H
#define GNOMON_TESTS_PANEL_RIG_H

#include <stdlib.h>
#include <string.h>

#include "../boards/displays/display.h"
#include "check.h"
#include "panel_bus.h"
#include "panel_model.h"
#include "rng.h"

enum { MOST_PIXELS = 240 * 320, BUFFER_BYTES = 3000, WARM_STARTS = 24 };

typedef struct {
    const char *name;
    const panel_driver *driver;
    model_chip chip;
    model_glass glass;
    panel_config config;
    gn_format format;
} specimen;

static const specimen specimens[] = {
    {"st7789",
     &panel_st7789,
     MODEL_ST7789,
     {240, 240, 0, 0, 0, 1, 0, 0, 0},
     {240, 240, 0, 0, 0, PANEL_INVERT, 0, 0, 0},
     GN_FORMAT_RGB565_SWAPPED},
    {"st7789 135x240",
     &panel_st7789,
     MODEL_ST7789,
     {135, 240, 52, 40, 0, 1, 0, 0, 0},
     {135, 240, 52, 40, 0, PANEL_INVERT, 0, 0, 0},
     GN_FORMAT_RGB565},
    {"ili9341",
     &panel_ili9341,
     MODEL_ILI9341,
     {240, 320, 0, 0, 1, 0, 0, 0, 0},
     {240, 320, 0, 0, 0, PANEL_BGR, 0, 0, 0},
     GN_FORMAT_RGB565},
    {"ssd1306",
     &panel_ssd1306,
     MODEL_SSD1306,
     {128, 64, 0, 0, 0, 0, 0, 0, 0},
     {128, 64, 0, 0, 0, 0, 0, 0, 0},
     GN_FORMAT_MONO1},
    {"ssd1306 128x32",
     &panel_ssd1306,
     MODEL_SSD1306,
     {128, 32, 0, 0, 0, 0, 1, 0, 1},
     {128, 32, 0, 0, 0, PANEL_EXTERNAL_VCC, 9, 0, 1},
     GN_FORMAT_MONO1},
    {"ssd1306 72x40",
     &panel_ssd1306,
     MODEL_SSD1306,
     {72, 40, 28, 0, 0, 1, 0, 0, 0},
     {72, 40, 28, 0, 0, PANEL_INVERT, 0, 0, 0},
     GN_FORMAT_MONO1},
    {"ssd1306 96x39",
     &panel_ssd1306,
     MODEL_SSD1306,
     {96, 39, 0, 0, 0, 0, 0, 0, 0},
     {96, 39, 0, 0, 0, 0, 0, 0, 0},
     GN_FORMAT_MONO1},
    {"ssd1327",
     &panel_ssd1327,
     MODEL_SSD1327,
     {128, 128, 0, 0, 0, 0, 0, 0, 0},
     {128, 128, 0, 0, 0, 0, 0, 0, 0},
     GN_FORMAT_GREY4},
    {"ssd1327 96x96",
     &panel_ssd1327,
     MODEL_SSD1327,
     {96, 96, 16, 0, 0, 1, 0, 32, 0},
     {96, 96, 16, 0, 0, PANEL_INVERT, 1, 32, 0},
     GN_FORMAT_GREY4},
    {"ssd0323",
     &panel_ssd0323,
     MODEL_SSD0323,
     {128, 64, 0, 0, 0, 0, 1, 0x4C, 0},
     {128, 64, 0, 0, 0, PANEL_EXTERNAL_VCC, 0, 0x4C, 0},
     GN_FORMAT_GREY4},
    {"ssd0323 127x79",
     &panel_ssd0323,
     MODEL_SSD0323,
     {127, 79, 0, 0, 0, 0, 0, 0, 0},
     {127, 79, 0, 0, 0, 0, 0, 0, 0},
     GN_FORMAT_GREY4},
};
enum { N_SPECIMENS = sizeof specimens / sizeof *specimens };

/* ---- A rig: model, bus, panel, display, and the picture that the glass is to show -------------------------------- */

typedef struct {
    const specimen *s;
    panel_model model;
    test_bus bus;
    panel panel;
    display display;
    uint8_t buffer[2][BUFFER_BYTES], shadow[8192];
    uint16_t picture[MOST_PIXELS];
    rng random;
    unsigned n_tiles;
} rig;

static rig the_rig; /* too big for the stack */

static inline rig *rig_make(const specimen *s, int with_reset_line)
{
    rig *r = &the_rig;
    r->s = s;
    r->random.state = 1;
    r->n_tiles = 0;
    memset(&r->display, 0, sizeof r->display);
    memset(r->shadow, 0, sizeof r->shadow);
    memset(r->picture, 0, sizeof r->picture);
    model_init(&r->model, s->chip, &s->glass);
    test_bus_init(&r->bus, &r->model, with_reset_line);
    r->display.panel = &r->panel;
    r->display.format = s->format;
    for (int i = 0; i < 2; i++) r->display.buffer[i] = r->buffer[i];
    r->display.buffer_bytes = BUFFER_BYTES;
    return r;
}

static inline panel_status rig_init(rig *r, uint8_t turn)
{
    panel_config config = r->s->config;
    config.turn = turn;
    panel_status status = panel_init(&r->panel, r->s->driver, &config, &r->bus.bus);
    return status ? status : display_init(&r->display);
}

static inline unsigned most_value(const rig *r)
{
    return r->s->format == GN_FORMAT_MONO1 ? 1 : r->s->format == GN_FORMAT_GREY4 ? 15 : 65535;
}

static inline void store(const rig *r, uint8_t *tile, int w, int x, int y, unsigned v)
{
    size_t i;
    uint16_t p = (uint16_t)(r->s->format == GN_FORMAT_RGB565_SWAPPED ? v >> 8 | v << 8 : v);
    switch (r->s->format) {
    case GN_FORMAT_MONO1:
        i = (size_t)(y * ((w + 7) / 8) + x / 8);
        tile[i] = (uint8_t)((tile[i] & ~(128U >> x % 8)) | (v ? 128U >> x % 8 : 0));
        break;
    case GN_FORMAT_GREY4:
        i = (size_t)(y * ((w + 1) / 2) + x / 2);
        tile[i] = (uint8_t)(x % 2 ? (tile[i] & 0xF0U) | v : (tile[i] & 15U) | v << 4);
        break;
    default:
        memcpy(tile + 2 * (y * w + x), &p, 2);
        break;
    }
}

/* Size of the picture, which the display turns. */
static inline int picture_width(const rig *r)
{
    return r->display.quarter_turns & 1 ? r->panel.height - r->display.y : r->panel.width - r->display.x;
}
static inline int picture_height(const rig *r)
{
    return r->display.quarter_turns & 1 ? r->panel.width - r->display.x : r->panel.height - r->display.y;
}

/* Pixel (x, y) of the picture is to be seen where its turned place is: by turning a quarter at a time. */
static inline void rig_expect(rig *r, int x, int y, unsigned v)
{
    int height = picture_height(r), width = picture_width(r);
    for (int i = 0; i < r->display.quarter_turns; i++) {
        const int left = height - 1 - y, across = height;
        y = x, x = left;
        height = width, width = across;
    }
    x += r->display.x, y += r->display.y;
    if (x < r->panel.width && y < r->panel.height) r->picture[y * r->panel.width + x] = (uint16_t)v;
}

/* Flushes a tile of random pixels, as the library would. */
static inline void flush_random(rig *r, int x, int y, int w, int h)
{
    size_t row = r->s->format == GN_FORMAT_MONO1   ? ((size_t)w + 7) / 8
                 : r->s->format == GN_FORMAT_GREY4 ? ((size_t)w + 1) / 2
                                                   : 2 * (size_t)w,
           n = row * (size_t)h;
    uint8_t *tile = malloc(n); /* not a byte more, so that a sanitizer sees who reads beyond */
    if (!tile) abort();
    memset(tile, 0xFF, n);
    for (int j = 0; j < h; j++) {
        for (int i = 0; i < w; i++) {
            unsigned v = rng_below(&r->random, most_value(r) + 1);
            store(r, tile, w, i, j, v);
            rig_expect(r, x + i, y + j, v);
        }
    }
    display_flush(&r->display, x, y, w, h, tile);
    memset(tile, 0x77, n); /* the library draws its next tile there */
    free(tile);
}

static inline panel_status draw(rig *r, int tile_w, int tile_h)
{
    for (int y = 0; y < picture_height(r); y += tile_h) {
        for (int x = 0; x < picture_width(r); x += tile_w) {
            int w = picture_width(r) - x < tile_w ? picture_width(r) - x : tile_w,
                h = picture_height(r) - y < tile_h ? picture_height(r) - y : tile_h;
            flush_random(r, x, y, w, h);
            r->bus.n_overlaps += (unsigned)r->bus.under_way; /* the caller is back, and the bus at work */
            r->n_tiles++;
        }
    }
    return display_finish(&r->display);
}

/* Pixel (x, y) of the turned picture on the glass. */
static inline int seen(const rig *r, int x, int y)
{
    int w = r->s->glass.width, h = r->s->glass.height;
    switch (r->panel.config.turn) {
    case 1:
        return model_pixel(&r->model, w - 1 - y, x);
    case 2:
        return model_pixel(&r->model, w - 1 - x, h - 1 - y);
    case 3:
        return model_pixel(&r->model, y, h - 1 - x);
    default:
        return model_pixel(&r->model, x, y);
    }
}

static inline int n_wrong(const rig *r)
{
    int n = 0;
    for (int y = 0; y < r->panel.height; y++)
        for (int x = 0; x < r->panel.width; x++) n += seen(r, x, y) != r->picture[y * r->panel.width + x];
    return n;
}

static inline void check_picture(const rig *r, const char *what)
{
    int wrong = n_wrong(r), ok = wrong == 0 && r->model.n_rejected == 0;
    if (!ok)
        printf("%s, turned %d, %s: %d pixels wrong; %u rejected: %s\n", r->s->name, r->panel.config.turn, what, wrong,
               r->model.n_rejected, r->model.rejected);
    CHECK(ok);
}

/* A small glass in a corner of the memory, so that every transfer of a session can be made to fail. */
static inline specimen small_specimen(const specimen *s)
{
    specimen small = *s;
    small.glass.width = small.config.width = 24;
    small.glass.height = small.config.height = 16;
    return small;
}

static inline panel_status session(rig *r)
{
    panel_status status = rig_init(r, 0);
    if (!status) status = draw(r, 16, 8);
    if (!status) status = panel_show(&r->panel, 1);
    if (!status) status = panel_sleep(&r->panel);
    if (!status) status = panel_wake(&r->panel);
    return status ? status : draw(r, 24, 16);
}

#endif
