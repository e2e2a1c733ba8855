/* Huffman codes of JPEG, and the bits that they are read from. */
#include "jpeg_internal.h"

#include <string.h>

static void add_short_code(jpeg_huffman *h, unsigned code, unsigned bits, uint8_t symbol)
{
    unsigned n_free = JPEG_LOOKUP_BITS - bits;
    memset(h->short_bits + ((size_t)code << n_free), (int)bits, (size_t)1 << n_free);
    memset(h->short_symbol + ((size_t)code << n_free), symbol, (size_t)1 << n_free);
}

const char *jpeg_build_code(jpeg_huffman *h, const uint8_t count[JPEG_MAX_CODE_BITS], const uint8_t *symbols,
                            size_t n_symbols)
{
    unsigned code = 0, rank = 0;
    memset(h, 0, sizeof *h);
    memcpy(h->symbol, symbols, n_symbols);
    for (unsigned bits = 1; bits <= JPEG_MAX_CODE_BITS; bits++) {
        unsigned n = count[bits - 1];
        if (code + n > 1U << bits) return "a Huffman code is over-subscribed";
        h->count[bits] = (uint16_t)n;
        h->first[bits] = (uint16_t)code;
        h->rank[bits] = (uint16_t)rank;
        for (unsigned i = 0; i < n && bits <= JPEG_LOOKUP_BITS; i++)
            add_short_code(h, code + i, bits, symbols[rank + i]);
        code = (code + n) << 1;
        rank += n;
    }
    h->defined = true;
    return NULL;
}

void jpeg_bits_fail(jpeg_bits *b, const char *problem)
{
    if (!b->problem) b->problem = problem;
}

/* 16 bits, unless the segment ends. */
static void fill(jpeg_bits *b)
{
    while (b->n_bits < 16 && b->at < b->end) {
        if (*b->at == 0xFF) {
            if (b->end - b->at < 2 || b->at[1] != 0) return; /* a marker; FF 00 is the byte FF */
            b->at++;
            b->bits = b->bits << 8 | 0xFF;
        } else b->bits = b->bits << 8 | *b->at;
        b->at++;
        b->n_bits += 8;
    }
}

/* The next n bits, zeros behind the end. */
static unsigned peek(jpeg_bits *b, unsigned n)
{
    if (b->n_bits < n) fill(b);
    uint32_t all = b->n_bits < n ? b->bits << (n - b->n_bits) : b->bits >> (b->n_bits - n);
    return all & ((1U << n) - 1);
}

static bool drop(jpeg_bits *b, unsigned n)
{
    if (n <= b->n_bits) {
        b->n_bits -= n;
        return true;
    }
    jpeg_bits_fail(b, b->end - b->at < 2 ? "the file ends early" : "the data of a scan ends early");
    b->n_bits = 0;
    return false;
}

unsigned jpeg_take_bits(jpeg_bits *b, unsigned n)
{
    unsigned value = peek(b, n);
    return drop(b, n) ? value : 0;
}

int jpeg_take_signed(jpeg_bits *b, unsigned n)
{
    if (n == 0) return 0;
    int value = (int)jpeg_take_bits(b, n);
    return value >> (n - 1) ? value : value - (1 << n) + 1;
}

unsigned jpeg_take_symbol(jpeg_bits *b, const jpeg_huffman *h)
{
    unsigned next = peek(b, JPEG_MAX_CODE_BITS), idx = next >> (JPEG_MAX_CODE_BITS - JPEG_LOOKUP_BITS);
    if (h->short_bits[idx]) return drop(b, h->short_bits[idx]) ? h->short_symbol[idx] : 0;
    for (unsigned bits = JPEG_LOOKUP_BITS + 1; bits <= JPEG_MAX_CODE_BITS; bits++) {
        unsigned rank = (next >> (JPEG_MAX_CODE_BITS - bits)) - h->first[bits];
        if (rank < h->count[bits]) return drop(b, bits) ? h->symbol[h->rank[bits] + rank] : 0;
    }
    if (drop(b, JPEG_MAX_CODE_BITS)) jpeg_bits_fail(b, "a Huffman code is unknown");
    return 0;
}
