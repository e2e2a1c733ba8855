/* Assembles JPEG files of flat blocks by hand: any sampling factors, scans and restart intervals, with pixels that
 * follow from the levels of the blocks. */
#ifndef GNOMON_TESTS_JPEG_FIXTURE_H
#define GNOMON_TESTS_JPEG_FIXTURE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static uint8_t jpeg[1 << 16];
static size_t n_jpeg;

typedef struct {
    unsigned n, w, height, h[4], v[4]; /* of n components: their sampling factors */
    bool alone;                        /* a scan for each component */
    unsigned restart;                  /* units between restart markers, 0: none */
    int adobe;                         /* the transform of Adobe's marker, -1: no such marker */
} flat_picture;

/* Of block (x, y) of component i. */
static inline int flat_level(unsigned i, unsigned x, unsigned y)
{
    return (int)((53 * i + 91 * x + 57 * y + 13 * x * y) % 256);
}

static inline void put_segment(int marker, const void *bytes, size_t n)
{
    jpeg[n_jpeg++] = 0xFF;
    jpeg[n_jpeg++] = (uint8_t)marker;
    jpeg[n_jpeg++] = (uint8_t)((n + 2) >> 8);
    jpeg[n_jpeg++] = (uint8_t)(n + 2);
    memcpy(jpeg + n_jpeg, bytes, n);
    n_jpeg += n;
}

/* Bits of a scan, from the high one, with a 0 byte behind FF. */
static uint32_t flat_bits;
static unsigned n_flat_bits;
static inline void put_flat_bits(unsigned value, unsigned n)
{
    flat_bits = flat_bits << n | value;
    n_flat_bits += n;
    while (n_flat_bits >= 8) {
        n_flat_bits -= 8;
        uint8_t byte = (uint8_t)(flat_bits >> n_flat_bits);
        jpeg[n_jpeg++] = byte;
        if (byte == 0xFF) jpeg[n_jpeg++] = 0;
    }
    flat_bits &= (1U << n_flat_bits) - 1;
}

static inline void end_flat_bits(void)
{
    if (n_flat_bits) put_flat_bits((1U << (8 - n_flat_bits)) - 1, 8 - n_flat_bits);
}

/* The code of a DC difference: how many bits it has, in 4, and those; then 1 bit that the block ends. The quantiser is
 * 8: a coefficient is a level. */
static inline void put_flat_block(int level, int *before)
{
    int difference = level - *before, size = difference < 0 ? -difference : difference;
    unsigned n = 0;
    while (size >> n) n++;
    put_flat_bits(n, 4);
    if (n) put_flat_bits((unsigned)(difference < 0 ? difference + (1 << n) - 1 : difference), n);
    put_flat_bits(0, 1);
    *before = level;
}

static inline unsigned divided_up(unsigned a, unsigned b)
{
    return (a + b - 1) / b;
}

static inline unsigned largest(const unsigned *factor, unsigned n)
{
    unsigned max = 1;
    for (unsigned i = 0; i < n; i++) max = factor[i] > max ? factor[i] : max;
    return max;
}

static inline void put_flat_scan(const flat_picture *p, unsigned first, unsigned n)
{
    uint8_t header[16] = {(uint8_t)n};
    unsigned h_max = largest(p->h, p->n), v_max = largest(p->v, p->n);
    unsigned units_x = divided_up(p->w, 8 * h_max), units_y = divided_up(p->height, 8 * v_max);
    int before[4] = {128, 128, 128, 128};
    bool alone = n == 1;
    if (alone) {
        units_x = divided_up(divided_up(p->w * p->h[first], h_max), 8);
        units_y = divided_up(divided_up(p->height * p->v[first], v_max), 8);
    }
    for (unsigned i = 0; i < n; i++) header[1 + 2 * i] = (uint8_t)(first + i + 1);
    header[2 + 2 * n] = 63;
    put_segment(0xDA, header, 4 + 2 * n);
    for (unsigned unit = 0; unit < units_x * units_y; unit++) {
        if (p->restart && unit && unit % p->restart == 0) {
            end_flat_bits();
            jpeg[n_jpeg++] = 0xFF;
            jpeg[n_jpeg++] = (uint8_t)(0xD0 + (unit / p->restart - 1) % 8);
            for (int i = 0; i < 4; i++) before[i] = 128;
        }
        for (unsigned i = first; i < first + n; i++) {
            unsigned h = alone ? 1 : p->h[i], v = alone ? 1 : p->v[i];
            for (unsigned k = 0; k < h * v; k++) {
                unsigned x = unit % units_x * h + k % h, y = unit / units_x * v + k / h;
                put_flat_block(flat_level(i, x, y), &before[i]);
            }
        }
    }
    end_flat_bits();
}

/* Table 0 of everything; the parts of the file in the order that is usual. */
static inline void make_flat(const flat_picture *p)
{
    static const uint8_t dc_code[1 + 16 + 12] = {0x00, 0, 0, 0, 12, 0, 0, 0, 0, 0, 0, 0, 0,  0, 0,
                                                 0,    0, 0, 1, 2,  3, 4, 5, 6, 7, 8, 9, 10, 11};
    static const uint8_t ac_code[1 + 16 + 1] = {0x10, 1};
    uint8_t quantiser[65] = {0}, restart[2] = {(uint8_t)(p->restart >> 8), (uint8_t)p->restart};
    uint8_t adobe[12] = {'A', 'd', 'o', 'b', 'e', 0, 100, 0, 0, 0, 0, (uint8_t)p->adobe};
    uint8_t frame[6 + 12] = {
        8, (uint8_t)(p->height >> 8), (uint8_t)p->height, (uint8_t)(p->w >> 8), (uint8_t)p->w, (uint8_t)p->n};
    memset(quantiser + 1, 8, 64);
    for (unsigned i = 0; i < p->n; i++) {
        frame[6 + 3 * i] = (uint8_t)(i + 1);
        frame[7 + 3 * i] = (uint8_t)(p->h[i] << 4 | p->v[i]);
    }
    memcpy(jpeg, "\xFF\xD8", 2);
    n_jpeg = 2;
    if (p->adobe >= 0) put_segment(0xEE, adobe, sizeof adobe);
    put_segment(0xDB, quantiser, sizeof quantiser);
    put_segment(0xC0, frame, 6 + 3 * p->n);
    put_segment(0xC4, dc_code, sizeof dc_code);
    put_segment(0xC4, ac_code, sizeof ac_code);
    if (p->restart) put_segment(0xDD, restart, sizeof restart);
    if (p->alone) {
        for (unsigned i = 0; i < p->n; i++) put_flat_scan(p, i, 1);
    } else put_flat_scan(p, 0, p->n);
    memcpy(jpeg + n_jpeg, "\xFF\xD9", 2);
    n_jpeg += 2;
}

#endif
