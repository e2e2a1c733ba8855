/* Reading PNG. The file may be anything: sizes are checked against the bytes that are there before memory is requested.
 */
#include "png.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../base/arena.h"
#include "zlib_stream.h"

enum {
    MAX_SIDE = 1 << 16,
    MAX_FILE_BYTES = 1 << 30,
    SIGNATURE_BYTES = 8,
    CHUNK_FRAME_BYTES = 12,
    IHDR_BYTES = 13,
    MAX_CHANNELS = 4
};
static const uint8_t signature[SIGNATURE_BYTES + 1] = "\x89PNG\r\n\x1A\n";
enum { GREY = 0, RGB = 2, PALETTE = 3, GREY_ALPHA = 4, RGB_ALPHA = 6 };

static const uint8_t n_channels[7] = {[GREY] = 1, [RGB] = 3, [PALETTE] = 1, [GREY_ALPHA] = 2, [RGB_ALPHA] = 4};

typedef struct {
    const char *path; /* NULL: the bytes are in memory, and the caller knows where from */
    char *error;
    size_t error_bytes;
    arena memory;
    const uint8_t *bytes;
    size_t n_bytes;
    uint32_t max_side, w, h;
    int colour; /* one of the kinds above */
    unsigned depth;
    bool interlaced;
    const uint8_t *palette, *transparent; /* PLTE and tRNS, NULL without */
    size_t n_palette, n_transparent;
    uint8_t *idat; /* all IDAT chunks in a row */
    size_t n_idat;
} reader;

static bool fail(reader *r, const char *what)
{
    snprintf(r->error, r->error_bytes, "%s%s%s", r->path ? r->path : "", r->path ? ": " : "", what);
    return false;
}

static bool read_stream(reader *r, FILE *file)
{
    for (uint8_t *bytes = NULL;;) {
        bytes = arena_grow(&r->memory, bytes, r->n_bytes, 1);
        if (!bytes) return fail(r, "out of memory");
        r->bytes = bytes;
        /* n_bytes is 0 or a power of two here: the array was just doubled. */
        size_t free_bytes = r->n_bytes ? r->n_bytes : 1, n = fread(bytes + r->n_bytes, 1, free_bytes, file);
        r->n_bytes += n;
        if (ferror(file)) return fail(r, "cannot be read");
        if (n < free_bytes) return true;
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

/* Palettes have at max 8 bits, several channels at least 8. */
static bool depth_is_known(int colour, unsigned depth)
{
    bool is_power = depth == 1 || depth == 2 || depth == 4 || depth == 8 || depth == 16;
    return is_power && (colour == GREY || (colour == PALETTE ? depth <= 8 : depth >= 8));
}

static bool read_header(reader *r, const uint8_t *b, size_t n)
{
    if (n != IHDR_BYTES) return fail(r, "IHDR has the wrong length");
    r->w = word_at(b);
    r->h = word_at(b + 4);
    r->depth = b[8];
    r->colour = b[9];
    if (r->w == 0 || r->h == 0 || r->w > r->max_side || r->h > r->max_side)
        return fail(r, "the picture size is out of range");
    if (b[9] > RGB_ALPHA || n_channels[b[9]] == 0) return fail(r, "the colour type is unknown");
    if (!depth_is_known(r->colour, r->depth)) return fail(r, "the bits per channel do not go with the colour type");
    if (b[10] != 0 || b[11] != 0) return fail(r, "the compression or filter method is unknown");
    if (b[12] > 1) return fail(r, "the interlace method is unknown");
    r->interlaced = b[12] == 1;
    return true;
}

static bool read_palette(reader *r, const uint8_t *b, size_t n)
{
    if (n == 0 || n % 3 != 0 || n > 3 * 256) return fail(r, "PLTE has the wrong length");
    r->palette = b;
    r->n_palette = n / 3;
    return true;
}

/* Of a palette: alpha of its first entries; else the one colour that is transparent. Kinds with alpha have none. */
static bool read_transparency(reader *r, const uint8_t *b, size_t n)
{
    bool fits = r->colour == PALETTE ? n <= 256 : n == 2 * (size_t)n_channels[r->colour];
    if (r->colour == GREY_ALPHA || r->colour == RGB_ALPHA) return true;
    if (!fits) return fail(r, "tRNS has the wrong length");
    r->transparent = b;
    r->n_transparent = n;
    return true;
}

static bool read_chunk(reader *r, const uint8_t *type, const uint8_t *b, size_t n, bool *end)
{
    *end = memcmp(type, "IEND", 4) == 0;
    bool is_header = memcmp(type, "IHDR", 4) == 0;
    if (is_header != (r->w == 0)) return fail(r, is_header ? "a second IHDR" : "the first chunk is not IHDR");
    if (is_header) return read_header(r, b, n);
    if (memcmp(type, "PLTE", 4) == 0) return read_palette(r, b, n);
    if (memcmp(type, "tRNS", 4) == 0) return read_transparency(r, b, n);
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
    if (!png_is(r->bytes, r->n_bytes)) return fail(r, "not a PNG file");
    r->idat = arena_alloc(&r->memory, r->n_bytes, 1);
    if (!r->idat) return fail(r, "out of memory");
    for (bool end = false; !end;) {
        if (r->n_bytes - at < CHUNK_FRAME_BYTES) return fail(r, "a chunk is cut off");
        const uint8_t *chunk = r->bytes + at;
        size_t n = word_at(chunk);
        if (n > r->n_bytes - at - CHUNK_FRAME_BYTES) return fail(r, "a chunk is cut off");
        if (word_at(chunk + 8 + n) != zlib_crc32(0, chunk + 4, n + 4))
            return fail(r, "the checksum of a chunk is wrong");
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

/* The parts of the picture in the order of the file: Adam7's seven, or one that is the whole. */
typedef struct {
    uint32_t x, y, step_x, step_y;
} pass;
static const pass whole[1] = {{0, 0, 1, 1}};
static const pass adam7[7] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                              {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};

static size_t pass_width(const reader *r, const pass *p)
{
    return r->w > p->x ? (r->w - p->x + p->step_x - 1) / p->step_x : 0;
}

static size_t pass_height(const reader *r, const pass *p)
{
    return r->h > p->y && pass_width(r, p) > 0 ? (r->h - p->y + p->step_y - 1) / p->step_y : 0;
}

/* Without the filter byte. */
static size_t row_bytes(const reader *r, const pass *p)
{
    return (pass_width(r, p) * n_channels[r->colour] * r->depth + 7) / 8;
}

static unsigned sample_at(const reader *r, const uint8_t *row, size_t i)
{
    if (r->depth == 8) return row[i];
    if (r->depth == 16) return (unsigned)row[2 * i] << 8 | row[2 * i + 1];
    size_t bit = i * r->depth;
    return (unsigned)row[bit / 8] >> (8 - r->depth - bit % 8) & ((1U << r->depth) - 1);
}

static uint8_t to_8_bits(const reader *r, unsigned sample)
{
    unsigned max = (1U << r->depth) - 1;
    return (uint8_t)((sample * 255 + max / 2) / max);
}

static bool is_transparent(const reader *r, const unsigned *samples)
{
    if (!r->transparent) return false;
    for (size_t i = 0; i < n_channels[r->colour]; i++) {
        if (samples[i] != ((unsigned)r->transparent[2 * i] << 8 | r->transparent[2 * i + 1])) return false;
    }
    return true;
}

static bool put_pixel(reader *r, const uint8_t *row, size_t x, uint8_t *out)
{
    unsigned sample[MAX_CHANNELS] = {0};
    size_t n = n_channels[r->colour];
    for (size_t i = 0; i < n; i++) sample[i] = sample_at(r, row, x * n + i);
    if (r->colour == PALETTE) {
        if (sample[0] >= r->n_palette) return fail(r, "a palette index is out of range");
        memcpy(out, r->palette + 3 * sample[0], 3);
        out[3] = sample[0] < r->n_transparent ? r->transparent[sample[0]] : 255;
        return true;
    }
    for (size_t i = 0; i < 3; i++) out[i] = to_8_bits(r, sample[n >= 3 ? i : 0]);
    if (n % 2 == 0) out[3] = to_8_bits(r, sample[n - 1]);
    else out[3] = is_transparent(r, sample) ? 0 : 255;
    return true;
}

/* *raw moves behind the pass. */
static bool decode_pass(reader *r, const pass *p, uint8_t **raw, uint8_t *out)
{
    size_t n = row_bytes(r, p), w = pass_width(r, p), h = pass_height(r, p),
           pixel_bytes = (n_channels[r->colour] * r->depth + 7U) / 8;
    uint8_t *previous = NULL;
    for (size_t y = 0; y < h; y++) {
        uint8_t *row = *raw + 1;
        if (!unfilter_row(row, previous, n, pixel_bytes, row[-1])) return fail(r, "a row filter is unknown");
        uint8_t *to = out + 4 * ((p->y + y * p->step_y) * r->w + p->x);
        for (size_t x = 0; x < w; x++) {
            if (!put_pixel(r, row, x, to + 4 * x * p->step_x)) return false;
        }
        previous = row;
        *raw += n + 1;
    }
    return true;
}

static bool decode(reader *r, uint8_t *raw, size_t n_raw, uint8_t *out)
{
    const char *problem = zlib_expand(r->idat, r->n_idat, raw, n_raw);
    if (problem) return fail(r, problem);
    if (!r->interlaced) return decode_pass(r, whole, &raw, out);
    for (size_t i = 0; i < 7; i++) {
        if (!decode_pass(r, &adam7[i], &raw, out)) return false;
    }
    return true;
}

static size_t raw_bytes(const reader *r)
{
    size_t n_raw = 0;
    for (size_t i = 0; i < (r->interlaced ? 7 : 1); i++) {
        const pass *p = r->interlaced ? &adam7[i] : whole;
        n_raw += pass_height(r, p) * (row_bytes(r, p) + 1);
    }
    return n_raw;
}

static uint8_t *read_picture(reader *r)
{
    if (!read_chunks(r)) return NULL;
    size_t n_raw = raw_bytes(r);
    /* Deflate shrinks at max 1032 times: a short file cannot ask for much memory. */
    if (n_raw / 1033 > r->n_idat) {
        fail(r, "compressed data is too short");
        return NULL;
    }
    uint8_t *raw = arena_alloc(&r->memory, n_raw, 1), *out = malloc((size_t)r->w * r->h * 4);
    if (!raw || !out) fail(r, "out of memory");
    else if (decode(r, raw, n_raw, out)) return out;
    free(out);
    return NULL;
}

bool png_is(const uint8_t *bytes, size_t n_bytes)
{
    return n_bytes >= SIGNATURE_BYTES && memcmp(bytes, signature, SIGNATURE_BYTES) == 0;
}

bool png_measure(const uint8_t *bytes, size_t n_bytes, int *w, int *h, size_t *n_work)
{
    char problem[100];
    reader r = {.max_side = INT32_MAX, .error = problem, .error_bytes = sizeof problem};
    const size_t at = SIGNATURE_BYTES + 8; /* behind the length and the name of the first chunk */
    if (!png_is(bytes, n_bytes) || n_bytes < at + IHDR_BYTES || !read_header(&r, bytes + at, IHDR_BYTES)) return false;
    *w = (int)r.w;
    *h = (int)r.h;
    *n_work = raw_bytes(&r) + n_bytes;
    return true;
}

bool png_decode_rgba8(const uint8_t *bytes, size_t n_bytes, int max_side, rgba8_picture *out, char *error,
                      size_t error_bytes)
{
    reader r = {
        .bytes = bytes, .n_bytes = n_bytes, .max_side = (uint32_t)max_side, .error = error, .error_bytes = error_bytes};
    uint8_t *rgba = read_picture(&r);
    *out = (rgba8_picture){.w = (int)r.w, .h = (int)r.h, .depth = (int)r.depth, .rgba = rgba};
    arena_release(&r.memory, NULL);
    return rgba != NULL;
}

uint8_t *png_read_rgb8(const char *path, int *w, int *h, char *error, size_t error_bytes)
{
    reader r = {.path = path, .max_side = MAX_SIDE, .error = error, .error_bytes = error_bytes};
    uint8_t *out = read_file(&r) ? read_picture(&r) : NULL;
    *w = (int)r.w;
    *h = (int)r.h;
    arena_release(&r.memory, NULL);
    for (size_t i = 1; out && i < (size_t)*w * (size_t)*h; i++) memmove(out + 3 * i, out + 4 * i, 3);
    return out;
}
