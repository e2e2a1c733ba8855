/* Inflate (RFC 1950, 1951), for input that may be anything: every read and write is checked. */
#include "zlib_stream.h"

#include <string.h>

enum { MAX_CODE_BITS = 15, N_LITERALS = 288, N_DISTANCES = 32, N_CODE_LENGTHS = 19 };

typedef struct {
    const uint8_t *bytes;
    size_t n_bytes, at; /* at: the next byte to be read */
    uint32_t bits;      /* that were read and not taken yet, the lowest first */
    unsigned n_bits;
    uint8_t *out;
    size_t n_out, filled; /* n_out: how many bytes there must be in the end */
    const char *problem;  /* the first one; reads give zeros from then on */
} inflater;

/* Canonical Huffman code: how many codes have each length, and the symbols in the order of their codes. */
typedef struct {
    uint16_t count[MAX_CODE_BITS + 1];
    uint16_t symbol[N_LITERALS];
} huffman;

static bool fail(inflater *z, const char *problem)
{
    if (!z->problem) z->problem = problem;
    return false;
}

/* The next n <= 16 bits, the first one lowest; 0 with z->problem set where there are none left. */
static uint32_t take_bits(inflater *z, unsigned n)
{
    while (z->n_bits < n) {
        if (z->at == z->n_bytes) {
            fail(z, "compressed data is cut off");
            return 0;
        }
        z->bits |= (uint32_t)z->bytes[z->at++] << z->n_bits;
        z->n_bits += 8;
    }
    uint32_t value = z->bits & ((UINT32_C(1) << n) - 1);
    z->bits >>= n;
    z->n_bits -= n;
    return value;
}

/* A code from the length in bits of each symbol's code, 0: no code. Lengths with more codes than there can be are
 * refused. Where there are fewer, it only matters if a missing code turns up. */
static bool build_code(inflater *z, huffman *h, const uint8_t *lengths, size_t n)
{
    uint16_t first[MAX_CODE_BITS + 2] = {0};
    int free_codes = 1;
    memset(h, 0, sizeof *h);
    for (size_t i = 0; i < n; i++) h->count[lengths[i]]++;
    h->count[0] = 0;
    for (int bits = 1; bits <= MAX_CODE_BITS; bits++) {
        free_codes = 2 * free_codes - h->count[bits];
        if (free_codes < 0) return fail(z, "a Huffman code is over-subscribed");
        first[bits + 1] = (uint16_t)(first[bits] + h->count[bits]);
    }
    for (size_t i = 0; i < n; i++) {
        if (lengths[i]) h->symbol[first[lengths[i]]++] = (uint16_t)i;
    }
    return true;
}

/* Reads a symbol bit by bit. Codes of one length are consecutive numbers: `first` is the smallest, idx the index of its
 * symbol, so code - first is the rank among them. */
static uint32_t take_symbol(inflater *z, const huffman *h)
{
    uint32_t code = 0, first = 0, idx = 0;
    for (int bits = 1; bits <= MAX_CODE_BITS; bits++) {
        uint32_t count = h->count[bits];
        code |= take_bits(z, 1);
        if (z->problem) return 0;
        if (code - first < count) return h->symbol[idx + (code - first)];
        idx += count;
        first = (first + count) << 1;
        code <<= 1;
    }
    fail(z, "a Huffman code is unknown");
    return 0;
}

/* A block without compression: its length, the complement of that, and the bytes. */
static bool expand_stored(inflater *z)
{
    z->bits = 0; /* to the next byte; less than one is ever held back here */
    z->n_bits = 0;
    uint32_t n = take_bits(z, 16), complement = take_bits(z, 16);
    if (z->problem) return false;
    if (n != (complement ^ 0xFFFF)) return fail(z, "the length of a stored block is damaged");
    if (n > z->n_bytes - z->at) return fail(z, "compressed data is cut off");
    if (n > z->n_out - z->filled) return fail(z, "compressed data is too long");
    memcpy(z->out + z->filled, z->bytes + z->at, n);
    z->filled += n;
    z->at += n;
    return true;
}

/* A match: so many bytes as lie so far back are repeated; the two may overlap. length_code: from 0. */
static bool copy_match(inflater *z, uint32_t length_code, const huffman *distances)
{
    if (length_code >= ZLIB_LENGTH_CODES) return fail(z, "a match length is unknown");
    size_t length = zlib_length_base[length_code] + take_bits(z, zlib_length_extra[length_code]);
    uint32_t code = take_symbol(z, distances);
    if (z->problem) return false;
    if (code >= ZLIB_DISTANCE_CODES) return fail(z, "a match distance is unknown");
    size_t distance = zlib_distance_base[code] + take_bits(z, zlib_distance_extra[code]);
    if (z->problem) return false;
    if (distance > z->filled) return fail(z, "a match reaches before the start");
    if (length > z->n_out - z->filled) return fail(z, "compressed data is too long");
    for (; length > 0; length--, z->filled++) z->out[z->filled] = z->out[z->filled - distance];
    return true;
}

/* A compressed block: symbols below 256 are bytes, 256 ends it, larger ones begin a match. */
static bool expand_coded(inflater *z, const huffman *literals, const huffman *distances)
{
    for (;;) {
        uint32_t symbol = take_symbol(z, literals);
        if (z->problem) return false;
        if (symbol == 256) return true;
        if (symbol > 256) {
            if (!copy_match(z, symbol - 257, distances)) return false;
            continue;
        }
        if (z->filled == z->n_out) return fail(z, "compressed data is too long");
        z->out[z->filled++] = (uint8_t)symbol;
    }
}

/* The codes of blocks of type 1, which the format fixes. */
static bool fixed_codes(inflater *z, huffman *literals, huffman *distances)
{
    uint8_t lengths[N_LITERALS];
    for (int i = 0; i < N_LITERALS; i++) lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    if (!build_code(z, literals, lengths, N_LITERALS)) return false;
    memset(lengths, 5, N_DISTANCES);
    return build_code(z, distances, lengths, N_DISTANCES);
}

/* Lengths of codes: 0 .. 15 are lengths; 16 repeats the last one, 17 and 18 repeat 0. */
static bool take_lengths(inflater *z, const huffman *code, uint8_t *lengths, size_t n)
{
    for (size_t i = 0; i < n;) {
        uint32_t symbol = take_symbol(z, code), repeat = 1;
        uint8_t value = symbol < 16 ? (uint8_t)symbol : 0;
        if (symbol == 16) {
            if (i == 0) return fail(z, "a code length repeats nothing");
            value = lengths[i - 1];
            repeat = 3 + take_bits(z, 2);
        } else if (symbol == 17) repeat = 3 + take_bits(z, 3);
        else if (symbol == 18) repeat = 11 + take_bits(z, 7);
        if (z->problem) return false;
        if (repeat > n - i) return fail(z, "too many code lengths");
        memset(lengths + i, value, repeat);
        i += repeat;
    }
    return true;
}

/* The codes of blocks of type 2: their lengths come first, by a code whose own lengths come in an order of the
 * format's. */
static bool dynamic_codes(inflater *z, huffman *literals, huffman *distances)
{
    static const uint8_t order[N_CODE_LENGTHS] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    uint8_t lengths[N_LITERALS + N_DISTANCES] = {0};
    huffman code;
    size_t n_literals = 257 + take_bits(z, 5), n_distances = 1 + take_bits(z, 5), n_code = 4 + take_bits(z, 4);
    for (size_t i = 0; i < n_code; i++) lengths[order[i]] = (uint8_t)take_bits(z, 3);
    if (z->problem) return false;
    if (n_literals > 286) return fail(z, "too many code lengths");
    if (!build_code(z, &code, lengths, N_CODE_LENGTHS)) return false;
    return take_lengths(z, &code, lengths, n_literals + n_distances) && build_code(z, literals, lengths, n_literals) &&
           build_code(z, distances, lengths + n_literals, n_distances);
}

static bool expand_block(inflater *z, bool *last)
{
    huffman literals, distances;
    *last = take_bits(z, 1) != 0;
    uint32_t kind = take_bits(z, 2);
    if (z->problem) return false;
    if (kind == 0) return expand_stored(z);
    if (kind == 3) return fail(z, "a block type is unknown");
    return (kind == 1 ? fixed_codes(z, &literals, &distances) : dynamic_codes(z, &literals, &distances)) &&
           expand_coded(z, &literals, &distances);
}

const char *zlib_expand(const uint8_t *bytes, size_t n_bytes, uint8_t *out, size_t n_out)
{
    inflater z = {.bytes = bytes, .n_bytes = n_bytes, .at = 2, .out = out, .n_out = n_out};
    if (n_bytes < 6) return "compressed data is cut off";
    if ((bytes[0] & 0x0F) != 8 || (bytes[0] * 256 + bytes[1]) % 31 != 0 || (bytes[1] & 0x20) != 0)
        return "not a zlib stream";
    for (bool last = false; !last;) {
        if (!expand_block(&z, &last)) return z.problem;
    }
    if (z.filled != n_out) return "compressed data is too short";
    if (n_bytes - z.at < 4) return "compressed data is cut off";
    const uint8_t *sum = bytes + z.at;
    uint32_t adler = (uint32_t)sum[0] << 24 | (uint32_t)sum[1] << 16 | (uint32_t)sum[2] << 8 | sum[3];
    return adler == zlib_adler32(out, n_out) ? NULL : "the checksum of the compressed data is wrong";
}
