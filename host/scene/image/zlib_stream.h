/* The zlib format (RFC 1950, 1951) for PNG files, and PNG's checksum. */
#ifndef GNOMON_HOST_ZLIB_STREAM_H
#define GNOMON_HOST_ZLIB_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Compressed copy to free(), or NULL when out of memory. */
uint8_t *zlib_compress(const uint8_t *bytes, size_t n_bytes, size_t *n_out);

/* Fills exactly n_out bytes. NULL, or what is wrong: a stream that is malformed, too short or too long, or fails its
 * checksum. */
const char *zlib_expand(const uint8_t *bytes, size_t n_bytes, uint8_t *out, size_t n_out);

/* CRC-32; start with 0, continue with the last result. */
uint32_t zlib_crc32(uint32_t crc, const uint8_t *bytes, size_t n_bytes);
uint32_t zlib_adler32(const uint8_t *bytes, size_t n_bytes);

/* RFC 1951 section 3.2.5: lengths 3..258 as 29 codes, distances 1..32768 as 30 codes, each with extra bits. */
enum {
    ZLIB_LENGTH_CODES = 29,
    ZLIB_DISTANCE_CODES = 30,
    ZLIB_MIN_MATCH = 3,
    ZLIB_MAX_MATCH = 258,
    ZLIB_WINDOW = 32768
};
extern const uint16_t zlib_length_base[ZLIB_LENGTH_CODES], zlib_distance_base[ZLIB_DISTANCE_CODES];
extern const uint8_t zlib_length_extra[ZLIB_LENGTH_CODES], zlib_distance_extra[ZLIB_DISTANCE_CODES];

#endif
