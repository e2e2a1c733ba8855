/* Damage to bytes, for fuzzers: of a seed every file is a copy of one in the corpus, with some of it changed. */
#ifndef GNOMON_TESTS_DAMAGE_H
#define GNOMON_TESTS_DAMAGE_H

#include <ctype.h>
#include <stdint.h>
#include <string.h>

#include "rng.h"

/* A call adds at most this. */
enum { DAMAGE_ADDS = 64 };

static inline size_t damage_cut(rng *r, uint8_t *bytes, size_t n)
{
    size_t from = rng_below(r, (uint32_t)n), length = 1 + rng_below(r, rng_below(r, 4) ? 8 : 200);
    if (length > n - from) length = n - from;
    memmove(bytes + from, bytes + from + length, n - from - length);
    return n - length;
}

/* A part of the other bytes, which may be the same, goes in between. */
static inline size_t damage_splice(rng *r, uint8_t *bytes, size_t n, const uint8_t *other, size_t n_other)
{
    size_t at = rng_below(r, (uint32_t)n), from = rng_below(r, (uint32_t)n_other), length = 1 + rng_below(r, 32);
    uint8_t part[32];
    if (length > n_other - from) length = n_other - from;
    memcpy(part, other + from, length);
    memmove(bytes + at + length, bytes + at, n - at);
    memcpy(bytes + at, part, length);
    return n + length;
}

/* A byte anywhere, more often in the head; a bit; bytes are lost, come twice, or come from another file. */
static inline size_t damage_bytes(rng *r, uint8_t *bytes, size_t n, const uint8_t *other, size_t n_other)
{
    static const uint8_t telling[] = {0, 1, 0x7F, 0x80, 0xFF};
    if (n == 0) return 0;
    switch (rng_below(r, 8)) {
    case 0:
        return damage_cut(r, bytes, n);
    case 1:
        return damage_splice(r, bytes, n, bytes, n);
    case 2:
        return damage_splice(r, bytes, n, other, n_other);
    case 3: /* a neighbour */
        bytes[rng_below(r, (uint32_t)n)] += (uint8_t)(rng_below(r, 2) ? 1 : 255);
        return n;
    case 4:
        if (rng_below(r, 2)) bytes[rng_below(r, (uint32_t)n)] ^= (uint8_t)(1U << rng_below(r, 8));
        else bytes[rng_below(r, (uint32_t)n)] = telling[rng_below(r, sizeof telling)];
        return n;
    default:
        bytes[rng_below(r, (uint32_t)(rng_below(r, 2) || n < 200 ? n : 200))] = (uint8_t)rng_u32(r);
        return n;
    }
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static inline int damage_is_word(uint8_t c)
{
    return isalnum(c) || c == '_' || c == '-' || c == '.' || c == '+';
}

/* The word at a random place, or the next one: its beginning and length; 0: there is none. */
static inline size_t damage_word(rng *r, const uint8_t *bytes, size_t n, size_t *from)
{
    size_t i = rng_below(r, (uint32_t)n), length = 0;
    while (i > 0 && damage_is_word(bytes[i]) && damage_is_word(bytes[i - 1])) i--;
    while (i < n && !damage_is_word(bytes[i])) i++;
    while (i + length < n && length < DAMAGE_ADDS && damage_is_word(bytes[i + length])) length++;
    *from = i;
    return length;
}

static inline size_t damage_replace(uint8_t *bytes, size_t n, size_t from, size_t old, const uint8_t *put, size_t n_put)
{
    memmove(bytes + from + n_put, bytes + from + old, n - from - old);
    memcpy(bytes + from, put, n_put);
    return n - old + n_put;
}

/* The neighbour of a number, or one at the end of a range; a word of this or the other file in the place of one; or
 * damage as to any bytes. */
static inline size_t damage_text(rng *r, uint8_t *bytes, size_t n, const uint8_t *other, size_t n_other)
{
    static const char *const numbers[] = {"0",     "1",      "-1",          "2",          "3",          "255",  "256",
                                          "65535", "65536",  "2147483647",  "4294967295", "4294967296", "1e30", "-1e30",
                                          "1e999", "1e-300", "-2147483648", "0.5",        "16777217",   "5126", "null"};
    size_t from, from_other, length, n_word;
    uint8_t word[DAMAGE_ADDS];
    if (n == 0 || rng_below(r, 3) == 0) return damage_bytes(r, bytes, n, other, n_other);
    length = damage_word(r, bytes, n, &from);
    if (length == 0) return n;
    if (isdigit(bytes[from]) || bytes[from] == '-' ? rng_below(r, 4) : rng_below(r, 16) == 0) {
        const uint8_t last = bytes[from + length - 1];
        if (last > '0' && last < '9' && rng_below(r, 4) == 0) {
            bytes[from + length - 1] = (uint8_t)(rng_below(r, 2) ? last + 1 : last - 1);
            return n;
        }
        const char *number = numbers[rng_below(r, sizeof numbers / sizeof *numbers)];
        return damage_replace(bytes, n, from, length, (const uint8_t *)number, strlen(number));
    }
    n_word = damage_word(r, other, n_other, &from_other);
    memcpy(word, other + from_other, n_word);
    return damage_replace(bytes, n, from, length, word, n_word);
}

#endif
