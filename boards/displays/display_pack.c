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

static void put_grey(uint8_t *shadow, int width, int x, int y, int w, const uint8_t *in)
{
    uint8_t *row = shadow + (size_t)y * display_row_bytes(GN_FORMAT_GREY4, width);
    for (int i = 0; i < w; i++, x++) {
        unsigned grey = (unsigned)in[i / 2] >> (i % 2 ? 0 : 4) & 15U, high = x % 2 ? 0 : 4;
        row[x / 2] = (uint8_t)((row[x / 2] & (0xF0U >> high)) | grey << high);
    }
}

static void put_mono(uint8_t *shadow, int width, int x, int y, int w, const uint8_t *in)
{
    uint8_t *page = shadow + (size_t)(y / 8) * (size_t)width;
    unsigned row = (unsigned)y % 8;
    for (int i = 0; i < w; i++) {
        unsigned light = (unsigned)in[i / 8] >> (7 - i % 8) & 1U;
        page[x + i] = (uint8_t)((page[x + i] & ~(1U << row)) | light << row);
    }
}

void display_put(uint8_t *shadow, int width, panel_pixels pixels, int x, int y, int w, int h, const uint8_t *in)
{
    int grey = pixels == PANEL_PIXELS_GREY4;
    size_t row_bytes = display_row_bytes(grey ? GN_FORMAT_GREY4 : GN_FORMAT_MONO1, w);
    for (int i = 0; i < h; i++, in += row_bytes) {
        if (grey) put_grey(shadow, width, x, y + i, w, in);
        else put_mono(shadow, width, x, y + i, w, in);
    }
}
