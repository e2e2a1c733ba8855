/* Writing PNG: filters, one IDAT chunk. */
#include "png.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "zlib_stream.h"

enum { N_FILTERS = 5, PIXEL_BYTES = 3, MAX_SIDE = 1 << 16 };

static int paeth(int a, int b, int c)
{
    int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/* previous: the row above, zeros for the first. Returns the sum of absolute differences, by which the best filter is picked. */
static unsigned long filter_row(int filter, const uint8_t *row, const uint8_t *previous, size_t n, uint8_t *out)
{
    unsigned long sum = 0;
    for (size_t i = 0; i < n; i++) {
        int a = i >= PIXEL_BYTES ? row[i - PIXEL_BYTES] : 0, b = previous[i], c = i >= PIXEL_BYTES ? previous[i - PIXEL_BYTES] : 0;
        const int prediction[N_FILTERS] = {0, a, b, (a + b) / 2, paeth(a, b, c)};
        out[i] = (uint8_t)(row[i] - prediction[filter]);
        sum += out[i] < 128 ? out[i] : 256UL - out[i];
    }
    return sum;
}

/* The picture with a filter byte before each row, to free(). NULL: out of memory. */
static uint8_t *filter_picture(const uint8_t *rgb, size_t row_bytes, size_t h)
{
    uint8_t *out = malloc(h * (row_bytes + 1)), *trial = malloc(row_bytes), *zeros = calloc(row_bytes, 1);
    for (size_t y = 0; out && trial && zeros && y < h; y++) {
        const uint8_t *row = rgb + y * row_bytes, *previous = y > 0 ? row - row_bytes : zeros;
        uint8_t *best = out + y * (row_bytes + 1);
        best[0] = 0;
        unsigned long best_sum = filter_row(0, row, previous, row_bytes, best + 1);
        for (int filter = 1; filter < N_FILTERS; filter++) {
            unsigned long sum = filter_row(filter, row, previous, row_bytes, trial);
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

/* A failed write shows in ferror. */
static void write_chunk(FILE *file, const char *type, const uint8_t *bytes, size_t n_bytes)
{
    uint8_t head[8], tail[4];
    put_word(head, (uint32_t)n_bytes);
    memcpy(head + 4, type, 4);
    put_word(tail, zlib_crc32(zlib_crc32(0, head + 4, 4), bytes, n_bytes));
    fwrite(head, 1, sizeof head, file);
    if (n_bytes > 0) fwrite(bytes, 1, n_bytes, file);
    fwrite(tail, 1, sizeof tail, file);
}

static bool write_file(const char *path, int w, int h, const uint8_t *packed, size_t n_packed)
{
    uint8_t header[13] = {[8] = 8, [9] = 2}; /* bits per channel, RGB */
    FILE *file = fopen(path, "wb");
    if (!file) return false;
    put_word(header, (uint32_t)w);
    put_word(header + 4, (uint32_t)h);
    fwrite("\x89PNG\r\n\x1A\n", 1, 8, file);
    write_chunk(file, "IHDR", header, sizeof header);
    write_chunk(file, "IDAT", packed, n_packed);
    write_chunk(file, "IEND", NULL, 0);
    bool ok = !ferror(file);
    return fclose(file) == 0 && ok;
}

int png_write_rgb8(const char *path, int w, int h, const uint8_t *rgb, char *error, size_t error_bytes)
{
    if (w <= 0 || h <= 0 || w > MAX_SIDE || h > MAX_SIDE) {
        snprintf(error, error_bytes, "%s: %dx%d is not a picture size", path, w, h);
        return -1;
    }
    size_t row_bytes = (size_t)w * PIXEL_BYTES, n_packed = 0;
    uint8_t *filtered = filter_picture(rgb, row_bytes, (size_t)h);
    uint8_t *packed = filtered ? zlib_compress(filtered, (size_t)h * (row_bytes + 1), &n_packed) : NULL;
    bool ok = false;
    if (!packed || n_packed > INT32_MAX) snprintf(error, error_bytes, "%s: out of memory", path);
    else {
        ok = write_file(path, w, h, packed, n_packed);
        if (!ok) snprintf(error, error_bytes, "%s: cannot be written", path);
    }
    free(filtered);
    free(packed);
    return ok ? 0 : -1;
}
