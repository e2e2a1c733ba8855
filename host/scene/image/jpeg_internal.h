/* What the parts of the JPEG reader share. Private to jpeg_*.c. Names in capitals are those of ITU T.81. */
#ifndef GNOMON_HOST_JPEG_INTERNAL_H
#define GNOMON_HOST_JPEG_INTERNAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../../base/arena.h"

enum {
    JPEG_MAX_COMPONENTS = 4,
    JPEG_MAX_SAMPLING = 4,
    JPEG_TABLES = 4,
    JPEG_BLOCK = 64,
    JPEG_LOOKUP_BITS = 9,
    JPEG_MAX_CODE_BITS = 16
};

/* Coefficients after dequantisation are clamped to this: 32 times what a picture can have. */
enum { JPEG_MAX_COEFFICIENT = 1 << 16 };

/* A canonical Huffman code. Codes up to JPEG_LOOKUP_BITS long are found by what follows in the stream, longer ones by
 * their length: code - first is the rank among the codes of that length. */
typedef struct {
    bool defined;
    uint8_t symbol[256];
    uint8_t short_bits[1 << JPEG_LOOKUP_BITS], short_symbol[1 << JPEG_LOOKUP_BITS]; /* bits 0: a longer code */
    uint16_t count[JPEG_MAX_CODE_BITS + 1], first[JPEG_MAX_CODE_BITS + 1], rank[JPEG_MAX_CODE_BITS + 1];
} jpeg_huffman;

/* Bits of one entropy-coded segment. It ends at a marker or with the file; bytes never holds any of the marker. */
typedef struct {
    const uint8_t *at, *end; /* of the file */
    uint32_t bits;           /* the last n_bits of it are next */
    unsigned n_bits;
    const char *problem; /* the first one; reads give zeros from then on */
} jpeg_bits;

typedef struct {
    uint8_t id;
    unsigned h, v;             /* sampling factors */
    uint8_t quantiser_idx;     /* of the frame header */
    size_t w, height;          /* samples that the picture has */
    size_t blocks_x, blocks_y; /* blocks that they take */
    size_t stride_blocks;      /* blocks of a row in memory: whole units of an interleaved scan */
    uint16_t quantiser[JPEG_BLOCK];
    bool started;                /* a scan had it: quantiser is set */
    int8_t low_bit[JPEG_BLOCK];  /* of each coefficient the lowest bit that is known; -1: none is */
    int16_t *coefficients;       /* of progressive files, all blocks; in the end the samples are in their place */
    uint8_t *samples;            /* 8 * stride_blocks a row */
    const jpeg_huffman *dc, *ac; /* of this scan */
    int predicted;               /* DC of the block before */
} jpeg_component;

typedef struct {
    size_t n;
    jpeg_component *component[JPEG_MAX_COMPONENTS];
    unsigned first, last; /* Ss, Se: a band of coefficients in zigzag order */
    unsigned high, low;   /* Ah, Al: bits known before, the lowest bit after it */
    uint32_t end_run;     /* EOBRUN: further blocks that have nothing in this band */
} jpeg_scan;

typedef struct {
    const uint8_t *bytes, *at, *end;
    uint32_t max_side, w, h; /* h 0: no frame header yet */
    bool only_head;          /* the frame header is enough */
    bool progressive, has_jfif, has_adobe;
    uint8_t adobe_transform;
    unsigned h_max, v_max;
    size_t units_x, units_y; /* of interleaved scans */
    size_t n_components;
    jpeg_component component[JPEG_MAX_COMPONENTS];
    uint16_t quantiser[JPEG_TABLES][JPEG_BLOCK];
    bool has_quantiser[JPEG_TABLES];
    jpeg_huffman dc[JPEG_TABLES], ac[JPEG_TABLES];
    size_t restart_interval;
    unsigned n_scans;
    arena memory;
    char *error;
    size_t error_bytes;
} jpeg_reader;

/* Writes the error; false. */
bool jpeg_fail(jpeg_reader *r, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;

extern const uint8_t jpeg_zigzag[JPEG_BLOCK];

/* jpeg_frame.c: what is behind the length of the headers of a frame and of a scan. */
bool jpeg_read_frame(jpeg_reader *r, const uint8_t *b, size_t n);
/* Memory for the components of the frame. */
bool jpeg_allocate(jpeg_reader *r);
size_t jpeg_component_bytes(const jpeg_reader *r, const jpeg_component *c);
bool jpeg_read_scan_header(jpeg_reader *r, const uint8_t *b, size_t n, jpeg_scan *scan);

/* jpeg_huffman.c */

/* From how many codes have each length, and their symbols: n_symbols of them. NULL, or what is wrong. */
const char *jpeg_build_code(jpeg_huffman *h, const uint8_t count[JPEG_MAX_CODE_BITS], const uint8_t *symbols,
                            size_t n_symbols);
unsigned jpeg_take_symbol(jpeg_bits *b, const jpeg_huffman *h);
unsigned jpeg_take_bits(jpeg_bits *b, unsigned n); /* n <= 16 */
/* A number of that many bits, as the format codes signed ones. */
int jpeg_take_signed(jpeg_bits *b, unsigned n);
void jpeg_bits_fail(jpeg_bits *b, const char *problem);

/* jpeg_block.c: the coefficients of one block. The quantiser is not applied. */
void jpeg_take_block(jpeg_bits *b, jpeg_component *c, int16_t *block);
void jpeg_take_part(jpeg_bits *b, jpeg_component *c, jpeg_scan *scan, int16_t *block);

/* jpeg_scan.c: all that follows the header of a scan, up to the next marker. */
bool jpeg_read_scan(jpeg_reader *r, jpeg_scan *scan);
/* The samples of what is in coefficients, which they take the place of. */
bool jpeg_transform_all(jpeg_reader *r, jpeg_component *c);

/* jpeg_idct.c: 8 x 8 samples from coefficients in zigzag order. */
void jpeg_idct(const int16_t *block, const uint16_t *quantiser, uint8_t *out, size_t stride);

/* jpeg_colour.c: 4 * w * h bytes. */
bool jpeg_to_rgba(jpeg_reader *r, uint8_t *rgba);
/* The memory that it takes beside. */
size_t jpeg_colour_bytes(const jpeg_reader *r);

#endif
