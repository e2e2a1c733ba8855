/* The four functions of string.h that the library and the compiler call. Word by word where both ends allow it; never
 * unaligned. */
#include <stdint.h>
#include <string.h>

typedef uint32_t __attribute__((may_alias)) word;

__attribute__((weak)) void *memset(void *to, int value, size_t n)
{
    uint8_t *out = to;
    for (; n && (uintptr_t)out % 4; n--) *out++ = (uint8_t)value;
    uint32_t four = 0x01010101U * (uint8_t)value;
    word *words = (word *)(void *)out;
    for (; n >= 16; n -= 16) {
        words[0] = four, words[1] = four, words[2] = four, words[3] = four;
        words += 4;
    }
    for (; n >= 4; n -= 4) *words++ = four;
    for (out = (uint8_t *)words; n; n--) *out++ = (uint8_t)value;
    return to;
}

/* Ascending: right for ranges that overlap, too, where `to` is not above `from`. */
static void copy_up(uint8_t *out, const uint8_t *in, size_t n)
{
    if (((uintptr_t)out ^ (uintptr_t)in) % 4 == 0) {
        for (; n && (uintptr_t)out % 4; n--) *out++ = *in++;
        word *words = (word *)(void *)out;
        const word *source = (const word *)(const void *)in;
        for (; n >= 4; n -= 4) *words++ = *source++;
        out = (uint8_t *)words;
        in = (const uint8_t *)source;
    }
    for (; n; n--) *out++ = *in++;
}

void *memcpy(void *restrict to, const void *restrict from, size_t n)
{
    copy_up(to, from, n);
    return to;
}

void *memmove(void *to, const void *from, size_t n)
{
    uint8_t *out = to;
    const uint8_t *in = from;
    if ((uintptr_t)out <= (uintptr_t)in) copy_up(out, in, n);
    else
        while (n--) out[n] = in[n];
    return to;
}

int memcmp(const void *a, const void *b, size_t n)
{
    const uint8_t *x = a, *y = b;
    for (; n; n--, x++, y++)
        if (*x != *y) return *x - *y;
    return 0;
}
