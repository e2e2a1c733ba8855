/* UTF-8, as file names and scene files must be to be printed. */
#ifndef GNOMON_HOST_UTF8_H
#define GNOMON_HOST_UTF8_H

#include <stddef.h>

/* Length of the well-formed UTF-8 sequence at s (no overlong forms, no surrogates, at most U+10FFFF), or 0. */
static inline size_t utf8_length(const unsigned char *s, size_t n)
{
    if (s[0] < 0x80) return 1;
    size_t length = s[0] >= 0xC2 && s[0] < 0xE0 ? 2 : (s[0] & 0xF0) == 0xE0 ? 3 : s[0] >= 0xF0 && s[0] <= 0xF4 ? 4 : 0;
    if (length == 0 || length > n) return 0;
    for (size_t i = 1; i < length; i++) {
        if ((s[i] & 0xC0) != 0x80) return 0;
    }
    if (s[0] == 0xE0 && s[1] < 0xA0) return 0;
    if (s[0] == 0xED && s[1] > 0x9F) return 0;
    if (s[0] == 0xF0 && s[1] < 0x90) return 0;
    if (s[0] == 0xF4 && s[1] > 0x8F) return 0;
    return length;
}

/* Makes text fit for one line on a terminal: control characters, and bytes that are no UTF-8, become '?'. */
static inline void utf8_clean(char *text)
{
    while (*text) {
        const unsigned char *s = (const unsigned char *)text;
        const size_t length = utf8_length(s, 4); /* the terminating zero continues no sequence */
        if (length == 0 || s[0] < 0x20 || s[0] == 0x7F || (s[0] == 0xC2 && s[1] < 0xA0)) *text++ = '?';
        else text += length;
    }
}

#endif
