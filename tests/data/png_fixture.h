/* Assembles PNG files by hand, so that reading is not only tested against our own writing. */
#ifndef GNOMON_TESTS_PNG_FIXTURE_H
#define GNOMON_TESTS_PNG_FIXTURE_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../../host/scene/image/zlib_stream.h"
#include "check.h"

static uint8_t made[1 << 14];
static size_t n_made;

static inline void put_word(uint8_t *out, uint32_t v)
{
    for (int i = 0; i < 4; i++) out[i] = (uint8_t)(v >> (24 - 8 * i));
}

static inline void put_chunk(const char *type, const void *bytes, size_t n)
{
    uint8_t *at = made + n_made;
    put_word(at, (uint32_t)n);
    memcpy(at + 4, type, 4);
    if (n) memcpy(at + 8, bytes, n);
    put_word(at + 8 + n, zlib_crc32(0, at + 4, n + 4));
    n_made += n + 12;
}

static inline void start_file(uint32_t w, uint32_t h, uint8_t depth, uint8_t colour, uint8_t interlace)
{
    uint8_t header[13] = {[8] = depth, [9] = colour, [12] = interlace};
    put_word(header, w);
    put_word(header + 4, h);
    memcpy(made, "\x89PNG\r\n\x1A\n", 8);
    n_made = 8;
    put_chunk("IHDR", header, sizeof header);
}

static inline void put_pixels(const uint8_t *raw, size_t n)
{
    size_t n_packed = 0;
    uint8_t *packed = zlib_compress(raw, n, &n_packed);
    if (CHECK(packed != NULL)) {
        put_chunk("IDAT", packed, n_packed / 2); /* in two chunks */
        put_chunk("IDAT", packed + n_packed / 2, n_packed - n_packed / 2);
    }
    free(packed);
}

#endif
