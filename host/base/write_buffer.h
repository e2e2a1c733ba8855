/* Bytes that grow. What goes wrong is remembered, so that writers need not ask each time. */
#ifndef GNOMON_HOST_WRITE_BUFFER_H
#define GNOMON_HOST_WRITE_BUFFER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint8_t *at; /* n bytes, and a 0 behind them */
    size_t n, capacity;
    bool failed; /* memory ran out: what was written since is missing */
} write_buffer;  /* begins as {0} */

void write_bytes(write_buffer *b, const void *bytes, size_t n);
void write_text(write_buffer *b, const char *text);
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void write_format(write_buffer *b, const char *format, ...); /* up to 511 bytes */
void write_free(write_buffer *b);

#endif
