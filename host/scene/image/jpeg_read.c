/* Reading JPEG: the markers of a file. The file may be anything: sizes are checked against the bytes that are there
 * before memory is requested. */
#include "jpeg.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "jpeg_internal.h"

/* The second byte of the markers, ITU T.81 table B.1. */
enum {
    SOF0 = 0xC0,
    SOF1 = 0xC1,
    SOF2 = 0xC2,
    DHT = 0xC4,
    JPG = 0xC8,
    DAC = 0xCC,
    SOF15 = 0xCF,
    RST0 = 0xD0,
    RST7 = 0xD7,
    SOI = 0xD8,
    EOI = 0xD9,
    SOS = 0xDA,
    DQT = 0xDB,
    DNL = 0xDC,
    DRI = 0xDD,
    DHP = 0xDE,
    EXP = 0xDF,
    APP0 = 0xE0,
    APP14 = 0xEE,
    APP15 = 0xEF,
    COM = 0xFE
};

bool jpeg_fail(jpeg_reader *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->error, r->error_bytes, format, arguments);
    va_end(arguments);
    return false;
}

/* Any number of tables in one segment. */
static bool read_quantisers(jpeg_reader *r, const uint8_t *b, size_t n)
{
    while (n > 0) {
        size_t idx = b[0] & 15, sample_bytes = 1 + (size_t)(b[0] >> 4), n_table = 1 + JPEG_BLOCK * sample_bytes;
        if (idx >= JPEG_TABLES || sample_bytes > 2) return jpeg_fail(r, "a quantisation table is not one of 0 to 3");
        if (n < n_table) return jpeg_fail(r, "a quantisation table is cut off");
        for (size_t k = 0; k < JPEG_BLOCK; k++) {
            const uint8_t *at = b + 1 + k * sample_bytes;
            r->quantiser[idx][k] = (uint16_t)(sample_bytes == 1 ? at[0] : at[0] << 8 | at[1]);
        }
        r->has_quantiser[idx] = true;
        b += n_table;
        n -= n_table;
    }
    return true;
}

static bool read_codes(jpeg_reader *r, const uint8_t *b, size_t n)
{
    enum { HEAD = 1 + JPEG_MAX_CODE_BITS };
    while (n > 0) {
        size_t n_symbols = 0;
        if (n < HEAD) return jpeg_fail(r, "a Huffman code is cut off");
        for (size_t i = 1; i < HEAD; i++) n_symbols += b[i];
        if ((b[0] & 15) >= JPEG_TABLES || b[0] >> 4 > 1 || n_symbols > 256)
            return jpeg_fail(r, "a Huffman code is malformed");
        if (n < HEAD + n_symbols) return jpeg_fail(r, "a Huffman code is cut off");
        const char *problem =
            jpeg_build_code(b[0] >> 4 ? &r->ac[b[0] & 15] : &r->dc[b[0] & 15], b + 1, b + HEAD, n_symbols);
        if (problem) return jpeg_fail(r, "%s", problem);
        b += HEAD + n_symbols;
        n -= HEAD + n_symbols;
    }
    return true;
}

static bool read_restart_interval(jpeg_reader *r, const uint8_t *b, size_t n)
{
    if (n != 2) return jpeg_fail(r, "the restart interval has the wrong length");
    r->restart_interval = (size_t)b[0] << 8 | b[1];
    return true;
}

/* JFIF and Adobe say what the components are; what else applications put there is ignored. */
static void read_application(jpeg_reader *r, int marker, const uint8_t *b, size_t n)
{
    if (marker == APP0 && n >= 5 && memcmp(b, "JFIF", 5) == 0) r->has_jfif = true;
    if (marker == APP14 && n >= 12 && memcmp(b, "Adobe", 5) == 0) {
        r->has_adobe = true;
        r->adobe_transform = b[11];
    }
}

/* What the marker of a frame says of how it is coded, beyond what is read; NULL: nothing. */
static const char *unread_kind(int marker)
{
    if (marker == DAC || (marker > JPG && marker <= SOF15)) return "arithmetic coding is not read";
    if (marker == SOF2 + 1) return "lossless coding is not read";
    if (marker == DHP || marker == EXP || (marker > DHT && marker < JPG)) return "hierarchical coding is not read";
    return marker == DNL ? "the height comes after the picture (DNL), which is not read" : NULL;
}

static bool read_scan(jpeg_reader *r, const uint8_t *b, size_t n)
{
    jpeg_scan scan;
    return jpeg_read_scan_header(r, b, n, &scan) && jpeg_read_scan(r, &scan);
}

static bool read_segment(jpeg_reader *r, int marker, const uint8_t *b, size_t n)
{
    switch (marker) {
    case SOF0:
    case SOF1:
    case SOF2:
        r->progressive = marker == SOF2;
        return jpeg_read_frame(r, b, n) && (r->only_head || jpeg_allocate(r));
    case DHT:
        return read_codes(r, b, n);
    case DQT:
        return read_quantisers(r, b, n);
    case DRI:
        return read_restart_interval(r, b, n);
    case SOS:
        return read_scan(r, b, n);
    default:
        if (marker != COM && (marker < APP0 || marker > APP15))
            return jpeg_fail(r, "marker FF %02X is unknown", marker);
        read_application(r, marker, b, n);
        return true;
    }
}

/* -1: the file ends. Any number of FF may fill the space before a marker. Behind a scan data that nothing needs is
 * stepped over, and restart markers, which some writers put at its end. */
static int next_marker(jpeg_reader *r, bool behind_scan)
{
    while (r->end - r->at >= 2) {
        uint8_t first = r->at[0], second = r->at[1];
        bool restart = second >= RST0 && second <= RST7;
        bool filling = first == 0xFF && second == 0xFF;
        if (!filling && !(behind_scan && (first != 0xFF || second == 0 || restart))) break;
        r->at++;
    }
    if (r->end - r->at < 2) return -1;
    r->at += 2;
    return r->at[-2] == 0xFF ? r->at[-1] : 0;
}

static bool read_markers(jpeg_reader *r)
{
    bool behind_scan = false;
    for (;;) {
        int marker = next_marker(r, behind_scan);
        if (marker == EOI) return true;
        if (marker < 0) return jpeg_fail(r, "the file ends early");
        if (marker == 0) return jpeg_fail(r, "a marker is missing");
        if (unread_kind(marker)) return jpeg_fail(r, "%s", unread_kind(marker));
        if (marker < SOF0 || (marker >= RST0 && marker <= SOI))
            return jpeg_fail(r, "marker FF %02X is out of place", marker);
        if (r->end - r->at < 2) return jpeg_fail(r, "the file ends early");
        const uint8_t *b = r->at;
        size_t n = (size_t)b[0] << 8 | b[1];
        if (n < 2) return jpeg_fail(r, "the segment of marker FF %02X has the wrong length", marker);
        if (n > (size_t)(r->end - b)) return jpeg_fail(r, "the file ends early");
        r->at += n;
        if (!read_segment(r, marker, b + 2, n - 2)) return false;
        if (r->only_head && r->h) return true;
        behind_scan = marker == SOS;
    }
}

/* Whether at least the mean of every block is there. */
static bool is_complete(jpeg_reader *r)
{
    if (!r->h) return jpeg_fail(r, "there is no frame header");
    for (size_t i = 0; i < r->n_components; i++) {
        const jpeg_component *c = &r->component[i];
        if (!c->started || (r->progressive && c->low_bit[0] < 0))
            return jpeg_fail(r, "component %d is in no scan", c->id);
    }
    return true;
}

static uint8_t *read_picture(jpeg_reader *r)
{
    if (!read_markers(r) || !is_complete(r)) return NULL;
    for (size_t i = 0; i < r->n_components; i++) {
        if (r->progressive && !jpeg_transform_all(r, &r->component[i])) return NULL;
    }
    uint8_t *rgba = malloc((size_t)r->w * r->h * 4);
    if (!rgba) jpeg_fail(r, "out of memory");
    else if (jpeg_to_rgba(r, rgba)) return rgba;
    free(rgba);
    return NULL;
}

bool jpeg_is(const uint8_t *bytes, size_t n_bytes)
{
    return n_bytes >= 3 && bytes[0] == 0xFF && bytes[1] == SOI && bytes[2] == 0xFF;
}

/* To free. NULL: failed. */
static jpeg_reader *new_reader(const uint8_t *bytes, size_t n_bytes, int max_side, char *error, size_t error_bytes)
{
    jpeg_reader *r = jpeg_is(bytes, n_bytes) ? calloc(1, sizeof *r) : NULL;
    if (!r) {
        snprintf(error, error_bytes, jpeg_is(bytes, n_bytes) ? "out of memory" : "not a JPEG file");
        return NULL;
    }
    r->bytes = bytes;
    r->at = bytes + 2; /* behind SOI */
    r->end = bytes + n_bytes;
    r->max_side = (uint32_t)max_side;
    r->error = error;
    r->error_bytes = error_bytes;
    return r;
}

bool jpeg_measure(const uint8_t *bytes, size_t n_bytes, int *w, int *h, size_t *n_work)
{
    char problem[100];
    jpeg_reader *r = new_reader(bytes, n_bytes, UINT16_MAX, problem, sizeof problem);
    if (!r) return false;
    r->only_head = true;
    bool ok = read_markers(r) && r->h;
    *w = (int)r->w;
    *h = (int)r->h;
    *n_work = sizeof *r + jpeg_colour_bytes(r);
    for (size_t i = 0; i < r->n_components && ok; i++)
        *n_work += jpeg_component_bytes(r, &r->component[i]) + JPEG_BLOCK * r->component[i].stride_blocks;
    free(r);
    return ok;
}

bool jpeg_decode_rgba8(const uint8_t *bytes, size_t n_bytes, int max_side, rgba8_picture *out, char *error,
                       size_t error_bytes)
{
    *out = (rgba8_picture){.depth = 8};
    jpeg_reader *r = new_reader(bytes, n_bytes, max_side, error, error_bytes);
    if (!r) return false;
    out->rgba = read_picture(r);
    out->w = (int)r->w;
    out->h = (int)r->h;
    arena_release(&r->memory, NULL);
    free(r);
    return out->rgba != NULL;
}
