/* One scan of JPEG: which blocks follow each other, ITU T.81 A.2 and E.2.4. */
#include "jpeg_internal.h"

#include <string.h>

/* Sequential files have all of a block at once. */
static void take(const jpeg_reader *r, jpeg_bits *b, jpeg_scan *scan, jpeg_component *c, size_t x, size_t y)
{
    size_t stride = 8 * c->stride_blocks;
    if (r->progressive) {
        jpeg_take_part(b, c, scan, c->coefficients + JPEG_BLOCK * (y * c->stride_blocks + x));
        return;
    }
    int16_t block[JPEG_BLOCK] = {0};
    jpeg_take_block(b, c, block);
    jpeg_idct(block, c->quantiser, c->samples + 8 * (y * stride + x), stride);
}

/* Of one component alone a block, of several those that lie over each other. */
static void take_unit(const jpeg_reader *r, jpeg_bits *b, jpeg_scan *scan, size_t x, size_t y)
{
    if (scan->n == 1) {
        take(r, b, scan, scan->component[0], x, y);
        return;
    }
    for (size_t i = 0; i < scan->n; i++) {
        jpeg_component *c = scan->component[i];
        for (unsigned j = 0; j < c->v; j++) {
            for (unsigned k = 0; k < c->h && !b->problem; k++) take(r, b, scan, c, x * c->h + k, y * c->v + j);
        }
    }
}

static void start_interval(jpeg_scan *scan)
{
    scan->end_run = 0;
    for (size_t i = 0; i < scan->n; i++) scan->component[i]->predicted = 0;
}

/* Over the marker RSTm that must be next; bits left over fill the byte before it. */
static void pass_restart(jpeg_bits *b, unsigned m)
{
    b->n_bits = 0;
    while (b->end - b->at >= 2 && b->at[0] == 0xFF && b->at[1] == 0xFF) b->at++;
    if (b->end - b->at < 2) jpeg_bits_fail(b, "the file ends early");
    else if (b->at[0] != 0xFF || b->at[1] != 0xD0 + m) jpeg_bits_fail(b, "a restart marker is missing");
    else b->at += 2;
}

bool jpeg_read_scan(jpeg_reader *r, jpeg_scan *scan)
{
    bool alone = scan->n == 1;
    size_t units_x = alone ? scan->component[0]->blocks_x : r->units_x;
    size_t units_y = alone ? scan->component[0]->blocks_y : r->units_y;
    jpeg_bits b = {.at = r->at, .end = r->end};
    start_interval(scan);
    for (size_t i = 0; i < units_x * units_y && !b.problem; i++) {
        if (r->restart_interval && i > 0 && i % r->restart_interval == 0) {
            pass_restart(&b, (unsigned)((i / r->restart_interval - 1) % 8));
            start_interval(scan);
        }
        take_unit(r, &b, scan, i % units_x, i / units_x);
    }
    r->at = b.at;
    return !b.problem || jpeg_fail(r, "%s", b.problem);
}

bool jpeg_transform_all(jpeg_reader *r, jpeg_component *c)
{
    size_t stride = 8 * c->stride_blocks, n_row = 8 * stride;
    uint8_t *row = arena_alloc(&r->memory, n_row, 1);
    if (!row) return jpeg_fail(r, "out of memory");
    c->samples = (uint8_t *)c->coefficients;
    for (size_t y = 0; y < c->blocks_y; y++) {
        const int16_t *blocks = c->coefficients + JPEG_BLOCK * c->stride_blocks * y;
        for (size_t x = 0; x < c->blocks_x; x++) jpeg_idct(blocks + JPEG_BLOCK * x, c->quantiser, row + 8 * x, stride);
        memcpy(c->samples + n_row * y, row, n_row); /* half as long as coefficients: those of this row at most */
    }
    return true;
}
