/* Deflate: LZ77 with hash chains, coded with the fixed Huffman code. Rendered pictures are mostly flat after PNG's
 * filters, so matches do the work; a code fitted to each picture would save little. */
#include "zlib_stream.h"

#include <stdlib.h>
#include <string.h>

enum { HASH_BITS = 15, MAX_CHAIN = 64, END_OF_BLOCK = 256 };

typedef struct {
    uint8_t *out;
    size_t n_out;
    uint64_t bits; /* not yet written, low bits first */
    unsigned n_bits;
} bit_writer;

/* n_bits <= 16; the buffer is large enough: see worst_case. */
static void put_bits(bit_writer *w, uint32_t value, unsigned n_bits)
{
    w->bits |= (uint64_t)value << w->n_bits;
    w->n_bits += n_bits;
    while (w->n_bits >= 8) {
        w->out[w->n_out++] = (uint8_t)w->bits;
        w->bits >>= 8;
        w->n_bits -= 8;
    }
}

/* Huffman codes go out from their high bit. */
static void put_code(bit_writer *w, uint32_t code, unsigned n_bits)
{
    uint32_t reversed = 0;
    for (unsigned i = 0; i < n_bits; i++) reversed |= (code >> i & 1) << (n_bits - 1 - i);
    put_bits(w, reversed, n_bits);
}

/* The fixed code of RFC 1951 section 3.2.6. */
static void put_symbol(bit_writer *w, uint32_t symbol)
{
    if (symbol < 144) put_code(w, 0x30 + symbol, 8);
    else if (symbol < 256) put_code(w, 0x190 + symbol - 144, 9);
    else if (symbol < 280) put_code(w, symbol - 256, 7);
    else put_code(w, 0xC0 + symbol - 280, 8);
}

/* The last code whose base is not beyond the value. */
static uint32_t code_of(const uint16_t *base, uint32_t n, size_t value)
{
    uint32_t code = n - 1;
    while (base[code] > value) code--;
    return code;
}

static void put_match(bit_writer *w, size_t length, size_t distance)
{
    uint32_t code = code_of(zlib_length_base, ZLIB_LENGTH_CODES, length);
    put_symbol(w, 257 + code);
    put_bits(w, (uint32_t)(length - zlib_length_base[code]), zlib_length_extra[code]);
    code = code_of(zlib_distance_base, ZLIB_DISTANCE_CODES, distance);
    put_code(w, code, 5);
    put_bits(w, (uint32_t)(distance - zlib_distance_base[code]), zlib_distance_extra[code]);
}

/* Positions with the same hash of three bytes, newest first. Stored plus one: 0 ends a chain. */
typedef struct {
    const uint8_t *bytes;
    size_t n_bytes;
    size_t head[1 << HASH_BITS];
    size_t previous[ZLIB_WINDOW];
} match_finder;

static size_t hash_at(const uint8_t *b)
{
    uint32_t word = (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16;
    return (word * UINT32_C(2654435761)) >> (32 - HASH_BITS);
}

static void insert(match_finder *f, size_t at)
{
    if (f->n_bytes - at < ZLIB_MIN_MATCH) return;
    size_t *head = &f->head[hash_at(f->bytes + at)];
    f->previous[at % ZLIB_WINDOW] = *head;
    *head = at + 1;
}

static size_t match_length(const match_finder *f, size_t from, size_t at)
{
    size_t limit = f->n_bytes - at, n = 0;
    if (limit > ZLIB_MAX_MATCH) limit = ZLIB_MAX_MATCH;
    while (n < limit && f->bytes[from + n] == f->bytes[at + n]) n++;
    return n;
}

/* Longest match for what starts at `at`, or 0. */
static size_t find_match(const match_finder *f, size_t at, size_t *distance)
{
    size_t best = 0;
    if (f->n_bytes - at < ZLIB_MIN_MATCH) return 0;
    size_t candidate = f->head[hash_at(f->bytes + at)];
    for (int i = 0; i < MAX_CHAIN && candidate != 0 && at - (candidate - 1) <= ZLIB_WINDOW; i++) {
        size_t n = match_length(f, candidate - 1, at);
        if (n > best) {
            best = n;
            *distance = at - (candidate - 1);
            if (n == ZLIB_MAX_MATCH) break;
        }
        candidate =
            f->previous[(candidate - 1) % ZLIB_WINDOW]; /* within the window no newer position has overwritten it */
    }
    return best >= ZLIB_MIN_MATCH ? best : 0;
}

static void put_block(bit_writer *w, match_finder *f)
{
    put_bits(w, 1, 1); /* the last block */
    put_bits(w, 1, 2); /* fixed code */
    for (size_t at = 0; at < f->n_bytes;) {
        size_t distance = 0, length = find_match(f, at, &distance), step = length ? length : 1;
        if (length) put_match(w, length, distance);
        else put_symbol(w, f->bytes[at]);
        for (size_t i = 0; i < step; i++) insert(f, at + i);
        at += step;
    }
    put_symbol(w, END_OF_BLOCK);
    put_bits(w, 0, 7); /* to the end of the byte */
}

uint8_t *zlib_compress(const uint8_t *bytes, size_t n_bytes, size_t *n_out)
{
    /* A literal takes at most 9 bits, a match of 3 bytes at most 8 + 5 + 5 + 13 = 31 bits; header, end and checksum 16
     * bytes. */
    if (n_bytes > SIZE_MAX / 2 - 16) return NULL;
    size_t worst_case = n_bytes + n_bytes / 3 + 16;
    bit_writer w = {.out = malloc(worst_case)};
    match_finder *f = calloc(1, sizeof *f);
    if (w.out && f) {
        uint32_t adler = zlib_adler32(bytes, n_bytes);
        f->bytes = bytes;
        f->n_bytes = n_bytes;
        put_bits(&w, 0x0178, 16); /* 32 KiB window; 0x7801 as a big-endian number is a multiple of 31 */
        put_block(&w, f);
        w.n_bits = 0;
        for (int shift = 24; shift >= 0; shift -= 8) w.out[w.n_out++] = (uint8_t)(adler >> shift);
        *n_out = w.n_out;
    } else {
        free(w.out);
        w.out = NULL;
    }
    free(f);
    return w.out;
}
