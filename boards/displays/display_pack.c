#include "display_pack.h"

#include <string.h>

size_t display_row_bytes(gn_format format, int w)
{
    size_t n = (size_t)w;
    return format == GN_FORMAT_MONO1 ? (n + 7) / 8 : format == GN_FORMAT_GREY4 ? (n + 1) / 2 : 2 * n;
}

static int little_endian(void)
{
    const uint16_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return first;
}

int display_is_native(gn_format format, panel_pixels pixels)
{
    switch (pixels) {
    case PANEL_PIXELS_GREY4:
        return format == GN_FORMAT_GREY4;
    case PANEL_PIXELS_RGB565_MSB:
        return format == (little_endian() ? GN_FORMAT_RGB565_SWAPPED : GN_FORMAT_RGB565);
    case PANEL_PIXELS_RGB565_LSB:
        return format == (little_endian() ? GN_FORMAT_RGB565 : GN_FORMAT_RGB565_SWAPPED);
    default:
        return 0;
    }
}

static void exchange_bytes(uint8_t *out, const uint8_t *in, size_t n)
{
    for (size_t i = 0; i < n; i += 2) {
        out[i] = in[i + 1];
        out[i + 1] = in[i];
    }
}

/* Eight rows become one byte per column: bit k is row k. */
static void pack_page(uint8_t *out, const uint8_t *in, int w, int n_rows)
{
    size_t stride = display_row_bytes(GN_FORMAT_MONO1, w);
    for (int x = 0; x < w; x++) {
        unsigned byte = 0, bit = 7U - (unsigned)x % 8;
        for (int k = 0; k < n_rows; k++) byte |= ((unsigned)in[(size_t)k * stride + (size_t)x / 8] >> bit & 1U) << k;
        out[x] = (uint8_t)byte;
    }
}

void display_pack(uint8_t *out, const uint8_t *in, gn_format format, panel_pixels pixels, int w, int n_rows)
{
    size_t row_bytes = display_row_bytes(format, w);
    if (pixels == PANEL_PIXELS_PAGE1) {
        for (int y = 0; y < n_rows; y += 8) {
            pack_page(out, in, w, n_rows - y < 8 ? n_rows - y : 8);
            out += w;
            in += 8 * row_bytes;
        }
    } else if (display_is_native(format, pixels)) memcpy(out, in, row_bytes * (size_t)n_rows);
    else exchange_bytes(out, in, row_bytes * (size_t)n_rows);
}

/* A pixel of the turned tile: its two bytes, the first one low; grey; light or dark. */
static unsigned tile_at(const display_tile *t, int x, int y)
{
    const int turns = DISPLAY_TURNS ? t->quarter_turns : 0;
    const int column = turns == 0 ? x : turns == 1 ? y : turns == 2 ? t->w - 1 - x : t->w - 1 - y;
    const int row = turns == 0 ? y : turns == 1 ? t->h - 1 - x : turns == 2 ? t->h - 1 - y : x;
    const uint8_t *in = t->in + (size_t)row * display_row_bytes(t->format, t->w);
    if (t->format == GN_FORMAT_GREY4) return (unsigned)in[column / 2] >> (column % 2 ? 0 : 4) & 15U;
    if (t->format == GN_FORMAT_MONO1) return (unsigned)in[column / 8] >> (7 - column % 8) & 1U;
    return (unsigned)in[2 * column] | (unsigned)in[2 * column + 1] << 8;
}

static void put_pixel(uint8_t *out, panel_pixels pixels, int stride, int x, int y, unsigned v)
{
    if (pixels == PANEL_PIXELS_GREY4) {
        uint8_t *at = out + (size_t)y * display_row_bytes(GN_FORMAT_GREY4, stride) + x / 2;
        *at = (uint8_t)(x % 2 ? (*at & 0xF0U) | v : (*at & 15U) | v << 4);
    } else {
        uint8_t *at = out + (size_t)(y / 8) * (size_t)stride + x;
        *at = (uint8_t)((*at & ~(1U << y % 8)) | v << y % 8);
    }
}

void display_pack_turned(uint8_t *out, const display_tile *tile, panel_pixels pixels, int y, int n_rows)
{
    const int w = tile->quarter_turns & 1 ? tile->h : tile->w, native = display_is_native(tile->format, pixels);
    const int several = tile->format == GN_FORMAT_GREY4 || tile->format == GN_FORMAT_MONO1;
    for (int row = 0; row < n_rows; row++) {
        if (pixels == PANEL_PIXELS_PAGE1 && row % 8 == 0) memset(out + (size_t)(row / 8) * (size_t)w, 0, (size_t)w);
        for (int x = 0; x < w; x++) {
            const unsigned v = tile_at(tile, x, y + row);
            uint8_t *at = out + 2 * ((size_t)row * (size_t)w + (size_t)x);
            if (several) put_pixel(out, pixels, w, x, row, v);
            else at[!native] = (uint8_t)v, at[native] = (uint8_t)(v >> 8);
        }
    }
}

void display_put(uint8_t *shadow, int width, const display_tile *tile, int x, int y)
{
    const int turned = tile->quarter_turns & 1, w = turned ? tile->h : tile->w, h = turned ? tile->w : tile->h;
    const panel_pixels pixels = tile->format == GN_FORMAT_GREY4 ? PANEL_PIXELS_GREY4 : PANEL_PIXELS_PAGE1;
    for (int j = 0; j < h; j++)
        for (int i = 0; i < w; i++) put_pixel(shadow, pixels, width, x + i, y + j, tile_at(tile, i, j));
}
