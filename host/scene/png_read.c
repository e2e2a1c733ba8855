/* Reading PNG. The file may be anything: sizes are checked against the bytes that are there before memory is asked for. */
#include "png.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arena.h"
#include "zlib_stream.h"

enum { MAX_SIDE = 1 << 16, MAX_FILE_BYTES = 1 << 30, SIGNATURE_BYTES = 8, CHUNK_FRAME_BYTES = 12, IHDR_BYTES = 13 };
enum { GREY = 0, RGB = 2, PALETTE = 3, GREY_ALPHA = 4, RGB_ALPHA = 6 };

typedef struct {
    const char *path;
    char *error;
    size_t error_bytes;
    arena memory;
    uint8_t *bytes;
    size_t n_bytes;
    uint32_t w, h;
    int colour;         /* one of the kinds above */
    size_t pixel_bytes; /* in the file */
    const uint8_t *palette;
    size_t n_palette;
    uint8_t *idat; /* all IDAT chunks in a row */
    size_t n_idat;
} reader;

static bool fail(reader *r, const char *what)
{
    snprintf(r->error, r->error_bytes, "%s: %s", r->path, what);
    return false;
}

static bool read_stream(reader *r, FILE *file)
{
    for (;;) {
        uint8_t *larger = arena_grow(&r->memory, r->bytes, r->n_bytes, 1);
        if (!larger) return fail(r, "out of memory");
        r->bytes = larger;
        /* n_bytes is 0 or a power of two here: the array was just doubled. */
        size_t room = r->n_bytes ? r->n_bytes : 1, n = fread(r->bytes + r->n_bytes, 1, room, file);
        r->n_bytes += n;
        if (ferror(file)) return fail(r, "cannot be read");
        if (n < room) return true;
        if (r->n_bytes >= MAX_FILE_BYTES) return fail(r, "larger than 1 GiB");
    }
}

static bool read_file(reader *r)
{
    FILE *file = fopen(r->path, "rb");
    if (!file) return fail(r, "cannot be opened");
    bool ok = read_stream(r, file);
    fclose(file);
    return ok;
}

static uint32_t word_at(const uint8_t *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static bool read_header(reader *r, const uint8_t *b, size_t n)
{
    static const uint8_t pixel_bytes[7] = {[GREY] = 1, [RGB] = 3, [PALETTE] = 1, [GREY_ALPHA] = 2, [RGB_ALPHA] = 4};
    if (n != IHDR_BYTES) return fail(r, "IHDR has the wrong length");
    r->w = word_at(b);
    r->h = word_at(b + 4);
    r->colour = b[9];
    if (r->w == 0 || r->h == 0 || r->w > MAX_SIDE || r->h > MAX_SIDE) return fail(r, "the picture size is out of range");
    if (b[9] > RGB_ALPHA || pixel_bytes[b[9]] == 0) return fail(r, "the colour type is unknown");
    if (b[8] != 8) return fail(r, "only 8 bits per channel are supported");
    if (b[10] != 0 || b[11] != 0) return fail(r, "the compression or filter method is unknown");
    if (b[12] != 0) return fail(r, "interlaced pictures are not supported");
    r->pixel_bytes = pixel_bytes[b[9]];
    return true;
}

static bool read_palette(reader *r, const uint8_t *b, size_t n)
{
    if (n == 0 || n % 3 != 0 || n > 3 * 256) return fail(r, "PLTE has the wrong length");
    r->palette = b;
    r->n_palette = n / 3;
    return true;
}

static bool read_chunk(reader *r, const uint8_t *type, const uint8_t *b, size_t n, bool *end)
{
    *end = memcmp(type, "IEND", 4) == 0;
    bool is_header = memcmp(type, "IHDR", 4) == 0;
    if (is_header != (r->w == 0)) return fail(r, is_header ? "a second IHDR" : "the first chunk is not IHDR");
    if (is_header) return read_header(r, b, n);
    if (memcmp(type, "PLTE", 4) == 0) return read_palette(r, b, n);
    if (memcmp(type, "IDAT", 4) == 0) {
        memcpy(r->idat + r->n_idat, b, n); /* fits: idat is as long as the file */
        r->n_idat += n;
        return true;
    }
    return *end || (type[0] & 0x20) != 0 || fail(r, "a critical chunk is unknown");
}

static bool read_chunks(reader *r)
{
    size_t at = SIGNATURE_BYTES;
    if (r->n_bytes < at || memcmp(r->bytes, "\x89PNG\r\n\x1A\n", SIGNATURE_BYTES) != 0) return fail(r, "not a PNG file");
    r->idat = arena_alloc(&r->memory, r->n_bytes, 1);
    if (!r->idat) return fail(r, "out of memory");
    for (bool end = false; !end;) {
        if (r->n_bytes - at < CHUNK_FRAME_BYTES) return fail(r, "a chunk is cut off");
        const uint8_t *chunk = r->bytes + at;
        size_t n = word_at(chunk);
        if (n > r->n_bytes - at - CHUNK_FRAME_BYTES) return fail(r, "a chunk is cut off");
        if (word_at(chunk + 8 + n) != zlib_crc32(0, chunk + 4, n + 4)) return fail(r, "the checksum of a chunk is wrong");
        if (!read_chunk(r, chunk + 4, chunk + 8, n, &end)) return false;
        at += n + CHUNK_FRAME_BYTES;
    }
    if (r->colour == PALETTE && !r->palette) return fail(r, "PLTE is missing");
    return true;
}

static int paeth(int a, int b, int c)
{
    int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/* In place; previous is the unfiltered row above, NULL for the first. */
static bool unfilter_row(uint8_t *row, const uint8_t *previous, size_t n, size_t pixel_bytes, int filter)
{
    for (size_t i = 0; i < n; i++) {
        int a = i >= pixel_bytes ? row[i - pixel_bytes] : 0, b = previous ? previous[i] : 0;
        int c = previous && i >= pixel_bytes ? previous[i - pixel_bytes] : 0;
        switch (filter) {
        case 0:
            return true;
        case 1:
            row[i] = (uint8_t)(row[i] + a);
            break;
        case 2:
            row[i] = (uint8_t)(row[i] + b);
            break;
        case 3:
            row[i] = (uint8_t)(row[i] + (a + b) / 2);
            break;
        case 4:
            row[i] = (uint8_t)(row[i] + paeth(a, b, c));
            break;
        default:
            return false;
        }
    }
    return true;
}

static bool row_to_rgb(reader *r, const uint8_t *row, uint8_t *out)
{
    for (size_t x = 0; x < r->w; x++, row += r->pixel_bytes, out += 3) {
        const uint8_t *rgb = row;
        const uint8_t grey[3] = {row[0], row[0], row[0]};
        if (r->colour == GREY || r->colour == GREY_ALPHA) rgb = grey;
        if (r->colour == PALETTE) {
            if (row[0] >= r->n_palette) return fail(r, "a palette index is out of range");
            rgb = r->palette + 3 * (size_t)row[0];
        }
        memcpy(out, rgb, 3);
    }
    return true;
}

static bool decode(reader *r, uint8_t *out)
{
    size_t row_bytes = r->w * r->pixel_bytes, n_raw = r->h * (row_bytes + 1);
    uint8_t *raw = arena_alloc(&r->memory, n_raw, 1), *previous = NULL;
    if (!raw) return fail(r, "out of memory");
    const char *problem = zlib_expand(r->idat, r->n_idat, raw, n_raw);
    if (problem) return fail(r, problem);
    for (size_t y = 0; y < r->h; y++) {
        uint8_t *row = raw + y * (row_bytes + 1);
        if (!unfilter_row(row + 1, previous, row_bytes, r->pixel_bytes, row[0])) return fail(r, "a row filter is unknown");
        if (!row_to_rgb(r, row + 1, out + 3 * y * r->w)) return false;
        previous = row + 1;
    }
    return true;
}

static uint8_t *read_picture(reader *r)
{
    if (!read_file(r) || !read_chunks(r)) return NULL;
    /* Deflate shrinks at most 1032 times: a short file cannot ask for much memory. */
    if ((uint64_t)r->w * r->h * r->pixel_bytes / 1032 > r->n_idat) {
        fail(r, "compressed data is too short");
        return NULL;
    }
    uint8_t *out = malloc((size_t)r->w * r->h * 3);
    if (!out) {
        fail(r, "out of memory");
        return NULL;
    }
    if (decode(r, out)) return out;
    free(out);
    return NULL;
}

uint8_t *png_read_rgb8(const char *path, int *w, int *h, char *error, size_t error_bytes)
{
    reader r = {.path = path, .error = error, .error_bytes = error_bytes};
    uint8_t *out = read_picture(&r);
    *w = (int)r.w;
    *h = (int)r.h;
    arena_release(&r.memory, NULL);
    return out;
}
