/* Writing PNG: filters, one IDAT chunk. */
#include "png.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "zlib_stream.h"

enum { N_FILTERS = 5, MAX_SIDE = 1 << 16 };

static int paeth(int a, int b, int c)
{
    int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/* previous: the row above, zeros for the first. Returns the sum of absolute differences, by which the best filter is
 * picked. */
static unsigned long filter_row(int filter, const uint8_t *row, const uint8_t *previous, size_t n, size_t pixel_bytes,
                                uint8_t *out)
{
    unsigned long sum = 0;
    for (size_t i = 0; i < n; i++) {
        bool left = i >= pixel_bytes;
        int a = left ? row[i - pixel_bytes] : 0, b = previous[i], c = left ? previous[i - pixel_bytes] : 0;
        const int prediction[N_FILTERS] = {0, a, b, (a + b) / 2, paeth(a, b, c)};
        out[i] = (uint8_t)(row[i] - prediction[filter]);
        sum += out[i] < 128 ? out[i] : 256UL - out[i];
    }
    return sum;
}

/* The picture with a filter byte before each row, to free(). NULL: out of memory. */
static uint8_t *filter_picture(const uint8_t *pixels, size_t row_bytes, size_t pixel_bytes, size_t h)
{
    uint8_t *out = malloc(h * (row_bytes + 1)), *trial = malloc(row_bytes), *zeros = calloc(row_bytes, 1);
    for (size_t y = 0; out && trial && zeros && y < h; y++) {
        const uint8_t *row = pixels + y * row_bytes, *previous = y > 0 ? row - row_bytes : zeros;
        uint8_t *best = out + y * (row_bytes + 1);
        best[0] = 0;
        unsigned long best_sum = filter_row(0, row, previous, row_bytes, pixel_bytes, best + 1);
        for (int filter = 1; filter < N_FILTERS; filter++) {
            unsigned long sum = filter_row(filter, row, previous, row_bytes, pixel_bytes, trial);
            if (sum >= best_sum) continue;
            best_sum = sum;
            best[0] = (uint8_t)filter;
            memcpy(best + 1, trial, row_bytes);
        }
    }
    bool ok = out && trial && zeros;
    free(trial);
    free(zeros);
    if (ok) return out;
    free(out);
    return NULL;
}

static void put_word(uint8_t *out, uint32_t value)
{
    for (int i = 0; i < 4; i++) out[i] = (uint8_t)(value >> (24 - 8 * i));
}

static uint8_t *put_chunk(uint8_t *out, const char *type, const uint8_t *bytes, size_t n_bytes)
{
    put_word(out, (uint32_t)n_bytes);
    memcpy(out + 4, type, 4);
    if (n_bytes > 0) memcpy(out + 8, bytes, n_bytes);
    put_word(out + 8 + n_bytes, zlib_crc32(0, out + 4, n_bytes + 4));
    return out + n_bytes + 12;
}

/* The whole file, to free(). NULL: out of memory. */
static uint8_t *pack(int w, int h, int n_channels, const uint8_t *pixels, size_t *n_out)
{
    enum { FRAME_BYTES = 8 + 3 * 12 }; /* the signature and what is around the data of three chunks */
    uint8_t header[13] = {[8] = 8, [9] = n_channels == 4 ? 6 : 2}; /* bits per channel, RGBA or RGB */
    size_t row_bytes = (size_t)w * (size_t)n_channels, n_packed = 0;
    uint8_t *filtered = filter_picture(pixels, row_bytes, (size_t)n_channels, (size_t)h), *out = NULL;
    uint8_t *packed = filtered ? zlib_compress(filtered, (size_t)h * (row_bytes + 1), &n_packed) : NULL;
    if (packed && n_packed <= INT32_MAX) out = malloc(FRAME_BYTES + sizeof header + n_packed);
    if (out) {
        put_word(header, (uint32_t)w);
        put_word(header + 4, (uint32_t)h);
        memcpy(out, "\x89PNG\r\n\x1A\n", 8);
        uint8_t *end = put_chunk(out + 8, "IHDR", header, sizeof header);
        end = put_chunk(end, "IDAT", packed, n_packed);
        *n_out = (size_t)(put_chunk(end, "IEND", NULL, 0) - out);
    }
    free(filtered);
    free(packed);
    return out;
}

uint8_t *png_pack_rgba8(int w, int h, const uint8_t *rgba, size_t *n_out)
{
    return w > 0 && h > 0 && w <= MAX_SIDE && h <= MAX_SIDE ? pack(w, h, 4, rgba, n_out) : NULL;
}

static bool write_file(const char *path, const uint8_t *bytes, size_t n)
{
    FILE *file = fopen(path, "wb");
    if (!file) return false;
    bool ok = fwrite(bytes, 1, n, file) == n;
    return fclose(file) == 0 && ok;
}

int png_write_rgb8(const char *path, int w, int h, const uint8_t *rgb, char *error, size_t error_bytes)
{
    if (w <= 0 || h <= 0 || w > MAX_SIDE || h > MAX_SIDE) {
        snprintf(error, error_bytes, "%s: %dx%d is not a picture size", path, w, h);
        return -1;
    }
    size_t n = 0;
    uint8_t *bytes = pack(w, h, 3, rgb, &n);
    bool ok = bytes && write_file(path, bytes, n);
    if (!bytes) snprintf(error, error_bytes, "%s: out of memory", path);
    else if (!ok) snprintf(error, error_bytes, "%s: cannot be written: %s", path, strerror(errno));
    free(bytes);
    return ok ? 0 : -1;
}

/* ---- Animations -------------------------------------------------------------------------------------------------- */

/* A chunk; those of an animation begin with their number. */
static void write_chunk(png_animation *a, const char *type, bool numbered, const uint8_t *bytes, size_t n_bytes)
{
    const size_t n_number = numbered ? 4 : 0;
    uint8_t *data = malloc(n_number + n_bytes + 1), *chunk = malloc(n_number + n_bytes + 12);
    if (data && chunk) {
        if (numbered) put_word(data, a->n_chunks++);
        if (n_bytes > 0) memcpy(data + n_number, bytes, n_bytes);
        const size_t n = (size_t)(put_chunk(chunk, type, data, n_number + n_bytes) - chunk);
        a->failed |= fwrite(chunk, 1, n, a->file) != n;
    } else {
        a->failed = true;
    }
    free(data);
    free(chunk);
}

typedef struct {
    int left, top, right, bottom; /* right and bottom: one beyond */
} rectangle;

/* What differs from the frame that is shown; at least a pixel, for a frame has some. */
static rectangle changed(const png_animation *a, const uint8_t *rgb)
{
    rectangle r = {a->w, a->h, 0, 0};
    for (int y = 0; y < a->h; y++) {
        for (int x = 0; x < a->w; x++) {
            const size_t at = 3 * ((size_t)y * (size_t)a->w + (size_t)x);
            if (memcmp(rgb + at, a->shown_rgb + at, 3) == 0) continue;
            if (x < r.left) r.left = x;
            if (x >= r.right) r.right = x + 1;
            if (y < r.top) r.top = y;
            r.bottom = y + 1;
        }
    }
    return r.right > 0 ? r : (rectangle){0, 0, 1, 1};
}

int png_animation_begin(png_animation *a, const char *path, int w, int h, uint32_t n_frames, unsigned delay_us)
{
    uint8_t header[13] = {[8] = 8, [9] = 2}, count[8] = {0}; /* 8 bits per channel, RGB; 0: for ever */
    *a = (png_animation){.w = w, .h = h, .delay_us = delay_us};
    if (w <= 0 || h <= 0 || w > MAX_SIDE || h > MAX_SIDE) return -1;
    a->file = fopen(path, "wb");
    if (!a->file) return -1;
    put_word(header, (uint32_t)w);
    put_word(header + 4, (uint32_t)h);
    put_word(count, n_frames);
    a->failed = fwrite("\x89PNG\r\n\x1A\n", 1, 8, a->file) != 8;
    write_chunk(a, "IHDR", false, header, sizeof header);
    write_chunk(a, "acTL", false, count, sizeof count);
    return a->failed ? -1 : 0;
}

/* The rectangle's pixels, filtered and compressed, to free(). NULL: out of memory. */
static uint8_t *pack_part(const uint8_t *rgb, int w, rectangle r, size_t *n_packed)
{
    const size_t row_bytes = 3 * (size_t)(r.right - r.left), h = (size_t)(r.bottom - r.top), stride = 3 * (size_t)w;
    uint8_t *part = malloc(row_bytes * h);
    for (size_t y = 0; part && y < h; y++)
        memcpy(part + y * row_bytes, rgb + (y + (size_t)r.top) * stride + 3 * (size_t)r.left, row_bytes);
    uint8_t *filtered = part ? filter_picture(part, row_bytes, 3, h) : NULL;
    uint8_t *packed = filtered ? zlib_compress(filtered, h * (row_bytes + 1), n_packed) : NULL;
    free(part);
    free(filtered);
    return packed;
}

int png_animation_add(png_animation *a, const uint8_t *rgb)
{
    const bool first = !a->shown_rgb;
    const rectangle r = first ? (rectangle){0, 0, a->w, a->h} : changed(a, rgb);
    const size_t n_bytes = 3 * (size_t)a->w * (size_t)a->h;
    uint8_t control[22] = {0};
    size_t n_packed = 0;
    put_word(control, (uint32_t)(r.right - r.left));
    put_word(control + 4, (uint32_t)(r.bottom - r.top));
    put_word(control + 8, (uint32_t)r.left);
    put_word(control + 12, (uint32_t)r.top);
    put_word(control + 16, a->delay_us / 1000 << 16 | 1000); /* milliseconds; disposal and blending: none */
    uint8_t *packed = pack_part(rgb, a->w, r, &n_packed);
    if (first) a->shown_rgb = malloc(n_bytes);
    a->failed |= !packed || !a->shown_rgb;
    if (!a->failed) {
        write_chunk(a, "fcTL", true, control, sizeof control);
        write_chunk(a, first ? "IDAT" : "fdAT", !first, packed, n_packed);
        memcpy(a->shown_rgb, rgb, n_bytes);
    }
    free(packed);
    return a->failed ? -1 : 0;
}

int png_animation_end(png_animation *a)
{
    if (a->file && !a->failed) write_chunk(a, "IEND", false, NULL, 0);
    if (a->file && fclose(a->file)) a->failed = true;
    free(a->shown_rgb);
    return a->failed || !a->file ? -1 : 0;
}
