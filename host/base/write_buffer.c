/* A growing buffer. */
#include "write_buffer.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool make_room(write_buffer *b, size_t n)
{
    if (n < b->capacity - b->n && b->capacity) return true;
    size_t capacity = b->capacity ? b->capacity : 256;
    while (capacity - b->n <= n) {
        if (capacity > SIZE_MAX / 2) return false;
        capacity *= 2;
    }
    uint8_t *grown = realloc(b->at, capacity);
    if (!grown) return false;
    b->at = grown;
    b->capacity = capacity;
    return true;
}

void write_bytes(write_buffer *b, const void *bytes, size_t n)
{
    if (b->failed || !make_room(b, n)) {
        b->failed = true;
        return;
    }
    if (n) memcpy(b->at + b->n, bytes, n);
    b->n += n;
    b->at[b->n] = 0;
}

void write_text(write_buffer *b, const char *text)
{
    write_bytes(b, text, strlen(text));
}

void write_format(write_buffer *b, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    const int n = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (n < 0 || (size_t)n >= sizeof text) b->failed = true;
    else write_bytes(b, text, (size_t)n);
}

void write_free(write_buffer *b)
{
    free(b->at);
    *b = (write_buffer){0};
}
