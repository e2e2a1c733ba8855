/* The headers of a frame and of its scans: ITU T.81 B.2.2 and B.2.3. */
#include "jpeg_internal.h"

#include <string.h>

/* MAX_SCANS: encoders take a dozen or two; a large picture of 256 that say nothing, in 16 KB, took a second. */
enum { FRAME_BYTES = 6, SCAN_BYTES = 4, MAX_LOW = 13, MAX_SCANS = 64 };

static bool read_component(jpeg_reader *r, const uint8_t *b)
{
    jpeg_component *c = &r->component[r->n_components];
    *c = (jpeg_component){.id = b[0], .h = b[1] >> 4, .v = b[1] & 15, .quantiser_idx = b[2]};
    memset(c->low_bit, -1, sizeof c->low_bit);
    if (c->h < 1 || c->v < 1 || c->h > JPEG_MAX_SAMPLING || c->v > JPEG_MAX_SAMPLING)
        return jpeg_fail(r, "component %d has sampling factors that are not 1 to 4", c->id);
    if (c->quantiser_idx >= JPEG_TABLES) return jpeg_fail(r, "a quantisation table is not one of 0 to 3");
    for (size_t i = 0; i < r->n_components; i++) {
        if (r->component[i].id == c->id) return jpeg_fail(r, "two components have the number %d", c->id);
    }
    if (c->h > r->h_max) r->h_max = c->h;
    if (c->v > r->v_max) r->v_max = c->v;
    r->n_components++;
    return true;
}

static size_t divided_up(size_t a, size_t b)
{
    return (a + b - 1) / b;
}

size_t jpeg_component_bytes(const jpeg_reader *r, const jpeg_component *c)
{
    size_t sample_bytes = r->progressive ? sizeof *c->coefficients : sizeof *c->samples;
    return c->stride_blocks * r->units_y * c->v * JPEG_BLOCK * sample_bytes;
}

bool jpeg_allocate(jpeg_reader *r)
{
    for (size_t i = 0; i < r->n_components; i++) {
        jpeg_component *c = &r->component[i];
        void *memory = arena_alloc(&r->memory, jpeg_component_bytes(r, c), 1);
        if (!memory) return jpeg_fail(r, "out of memory");
        if (r->progressive) c->coefficients = memory;
        else c->samples = memory;
    }
    return true;
}

/* Every block takes at least one bit of the file: a short file cannot ask for much memory. */
static bool lay_out(jpeg_reader *r)
{
    size_t n_blocks = 0;
    r->units_x = divided_up(r->w, 8 * r->h_max);
    r->units_y = divided_up(r->h, 8 * r->v_max);
    for (size_t i = 0; i < r->n_components; i++) {
        jpeg_component *c = &r->component[i];
        c->w = divided_up(r->w * c->h, r->h_max);
        c->height = divided_up(r->h * c->v, r->v_max);
        c->blocks_x = divided_up(c->w, 8);
        c->blocks_y = divided_up(c->height, 8);
        c->stride_blocks = r->units_x * c->h;
        n_blocks += c->blocks_x * c->blocks_y;
    }
    return n_blocks / 8 <= (size_t)(r->end - r->bytes) || jpeg_fail(r, "the file ends early");
}

bool jpeg_read_frame(jpeg_reader *r, const uint8_t *b, size_t n)
{
    if (r->h) return jpeg_fail(r, "a second frame");
    if (n < FRAME_BYTES || n != FRAME_BYTES + 3 * (size_t)b[5])
        return jpeg_fail(r, "the frame header has the wrong length");
    if (b[0] != 8) return jpeg_fail(r, "%d bits a sample: only 8 are read", b[0]);
    uint32_t h = (uint32_t)b[1] << 8 | b[2], w = (uint32_t)b[3] << 8 | b[4];
    if (h == 0) return jpeg_fail(r, "the height comes after the picture (DNL), which is not read");
    if (w == 0 || w > r->max_side || h > r->max_side) return jpeg_fail(r, "the picture size is out of range");
    if (b[5] != 1 && b[5] != 3 && b[5] != 4)
        return jpeg_fail(r, "%d components: only pictures of 1, 3 or 4 are read", b[5]);
    r->w = w;
    r->h = h;
    for (size_t i = 0; i < b[5]; i++) {
        if (!read_component(r, b + FRAME_BYTES + 3 * i)) return false;
    }
    return lay_out(r);
}

/* The quantiser is that which is in force when the component is met first. */
static bool start_component(jpeg_reader *r, jpeg_component *c)
{
    if (c->started && !r->progressive) return jpeg_fail(r, "component %d is in two scans", c->id);
    if (c->started) return true;
    if (!r->has_quantiser[c->quantiser_idx]) return jpeg_fail(r, "quantisation table %d is missing", c->quantiser_idx);
    memcpy(c->quantiser, r->quantiser[c->quantiser_idx], sizeof c->quantiser);
    c->started = true;
    return true;
}

/* b: the component's number, and which codes it uses. */
static bool add_component(jpeg_reader *r, jpeg_scan *scan, const uint8_t *b)
{
    jpeg_component *c = NULL;
    for (size_t i = 0; i < r->n_components; i++) {
        if (r->component[i].id == b[0]) c = &r->component[i];
    }
    if (!c) return jpeg_fail(r, "a scan has component %d, which the frame has not", b[0]);
    for (size_t i = 0; i < scan->n; i++) {
        if (scan->component[i] == c) return jpeg_fail(r, "a scan has component %d twice", b[0]);
    }
    unsigned dc = b[1] >> 4, ac = b[1] & 15;
    bool uses_dc = !r->progressive || (scan->first == 0 && scan->high == 0);
    bool uses_ac = !r->progressive || scan->first > 0;
    if ((uses_dc && (dc >= JPEG_TABLES || !r->dc[dc].defined)) ||
        (uses_ac && (ac >= JPEG_TABLES || !r->ac[ac].defined)))
        return jpeg_fail(r, "a Huffman code of component %d is missing", b[0]);
    c->dc = &r->dc[dc % JPEG_TABLES];
    c->ac = &r->ac[ac % JPEG_TABLES];
    scan->component[scan->n++] = c;
    return start_component(r, c);
}

/* Of each coefficient the high bits first, then bit by bit, each once. */
static bool follows(jpeg_reader *r, const jpeg_scan *s)
{
    bool band = s->first == 0 ? s->last == 0 : s->first <= s->last && s->last < JPEG_BLOCK && s->n == 1;
    if (!band || s->low > MAX_LOW || (s->high && s->high != s->low + 1))
        return jpeg_fail(r, "a scan has a range of coefficients that is not allowed");
    for (size_t i = 0; i < s->n; i++) {
        int8_t *low_bit = s->component[i]->low_bit;
        for (unsigned k = s->first; k <= s->last; k++) {
            if (low_bit[k] != (s->high ? (int)s->high : -1))
                return jpeg_fail(r, "a scan does not go on from those before it");
            low_bit[k] = (int8_t)s->low;
        }
    }
    return true;
}

bool jpeg_read_scan_header(jpeg_reader *r, const uint8_t *b, size_t n, jpeg_scan *scan)
{
    if (!r->h) return jpeg_fail(r, "a scan before the frame header");
    if (++r->n_scans > MAX_SCANS) return jpeg_fail(r, "more than %d scans", MAX_SCANS);
    if (n < SCAN_BYTES || b[0] < 1 || b[0] > r->n_components || n != SCAN_BYTES + 2 * (size_t)b[0])
        return jpeg_fail(r, "the header of a scan has the wrong length");
    const uint8_t *range = b + n - 3;
    *scan = (jpeg_scan){.first = range[0], .last = range[1], .high = range[2] >> 4, .low = range[2] & 15};
    for (size_t i = 0; i < b[0]; i++) {
        if (!add_component(r, scan, b + 1 + 2 * i)) return false;
    }
    return !r->progressive || follows(r, scan);
}
