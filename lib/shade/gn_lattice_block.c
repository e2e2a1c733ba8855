/* Cells without an edge of a shadow: one colour, or few of them. Where colours change little, they are encoded at the
 * corners of blocks, and levels are linear in between (NUMERICS 4.7). */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_exact.h"
#include "shade/gn_lattice.h"
#include "shade/gn_lattice_block.h"
#include "shade/gn_lattice_cell.h"
#include "shade/gn_pixel.h"

#if GN_INTERPOLATES

/* ---- One colour -------------------------------------------------------------------------------------------------- */

GN_HOT static uint32_t pack_corner(gn_shading *s, const int32_t colour_q24[3])
{
    uint32_t q20[3];
    for (int c = 0; c < 3; c++) q20[c] = (uint32_t)gn_max32(colour_q24[c], 0) >> 4;
    return gn_exact_pack(s, q20);
}

/* Whether all corners have the same pixel, as where nothing varies. */
GN_HOT static GN_NOINLINE int is_plain(gn_shading *s, const int32_t (*colour_q24)[3], uint32_t *packed)
{
    for (int c = 0; c < 3; c++)
        for (int i = 1; i < 4; i++)
            if (gn_abs32(colour_q24[i][c] - colour_q24[0][c]) >> 17) return 0; /* 1 / 128 */
    *packed = pack_corner(s, colour_q24[0]);
    for (int i = 1; i < 4; i++)
        if (pack_corner(s, colour_q24[i]) != *packed) return 0;
    return 1;
}

GN_HOT static void fill_cell(gn_shading *s, int32_t x, int32_t y, int32_t size_log2, uint32_t packed)
{
    GN_COUNT(cells_plain, 1);
    for (int32_t end = y + (1 << size_log2); y < end; y++) {
        uint32_t bits = gn_lattice_bits(&s->lattice, x, y, size_log2);
        if (bits) gn_pixel_store_bits(s->frame, &s->rows, x, y, bits, packed);
    }
}

/* ---- Rows of a block --------------------------------------------------------------------------------------------- */

/* A square of pixels whose colours are bilinear, or whose levels are. */
typedef struct {
    int32_t from[3], across[3];      /* of the row at hand, and steps between pixels */
    int32_t down[3], down_across[3]; /* steps of both from row to row */
    int32_t size, shift;             /* pixels each way */
    const uint32_t *bits;            /* which of the row's pixels are stored, from bit `shift` on */
    int encoded;                     /* levels, Q31; otherwise colours, Q24 */
} block_rows;

/* n pixels of a row, whose levels begin with r, g, b and go on by `step`. */
GN_HOT static inline void run_of_levels(uint16_t *out, int32_t n, int32_t r, int32_t g, int32_t b,
                                        const int32_t step[3], int swaps)
{
    const int32_t r_step = step[0], g_step = step[1], b_step = step[2];
    for (const uint16_t *end = out + n; out < end; r += r_step, g += g_step, b += b_step) {
        uint32_t v = gn_pixel_of_levels(r, g, b);
        *out++ = (uint16_t)(swaps ? gn_pixel_swapped(v) : v);
    }
}

GN_HOT static GN_NOINLINE void run_of_levels_888(uint8_t *out, int32_t n, int32_t r, int32_t g, int32_t b,
                                                 const int32_t step[3])
{
    for (; n > 0; n--, r += step[0], g += step[1], b += step[2]) {
        *out++ = (uint8_t)(r >> 23);
        *out++ = (uint8_t)(g >> 23);
        *out++ = (uint8_t)(b >> 23);
    }
}

/* Index of the lowest bit that is set. */
GN_HOT static inline int32_t lowest_bit(uint32_t bits)
{
    return 31 - gn_clz32(bits & (0U - bits));
}

/* Pixels of `bits` of a block's row. */
GN_HOT static inline void store_block_row(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y,
                                          uint32_t bits, const block_rows *block)
{
    int32_t r = block->from[0], g = block->from[1], b = block->from[2], n, at = (y - rows->y0) * rows->width - rows->x0;
    const int32_t *step = block->across;
    for (; bits; bits >>= n, x += n, r += n * step[0], g += n * step[1], b += n * step[2]) {
        int32_t skip = lowest_bit(bits);
        if (skip) r += skip * step[0], g += skip * step[1], b += skip * step[2];
        x += skip;
        bits >>= skip;
        n = lowest_bit(~bits);
        if (!block->encoded) {
            const int32_t from[3] = {r, g, b};
            gn_pixel_store_run(frame, rows, x, y, n, from, step);
        } else if (frame->picture.format == GN_FORMAT_RGB565)
            run_of_levels(rows->pixels->rgb565 + (at + x), n, r, g, b, step, 0);
        else if (GN_OTHER_FORMATS && frame->picture.format == GN_FORMAT_RGB888)
            run_of_levels_888(rows->pixels->bytes + 3 * (at + x), n, r, g, b, step);
        else run_of_levels(rows->pixels->rgb565 + (at + x), n, r, g, b, step, 1);
        if (!(bits >> n)) return;
    }
}

GN_HOT static GN_NOINLINE void store_block(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y,
                                           block_rows *block)
{
    const uint32_t mask = (1U << block->size) - 1;
    for (int32_t end = y + block->size; y < end; y++) {
        uint32_t bits = *block->bits++ >> block->shift & mask;
        if (bits) store_block_row(frame, rows, x, y, bits, block);
        GN_UNROLL
        for (int c = 0; c < 3; c++) {
            block->from[c] += block->down[c];
            block->across[c] += block->down_across[c];
        }
    }
}

/* ---- Blocks ------------------------------------------------------------------------------------------------------ */

/* Whether levels may be taken for linear between the corners of a block, or of its quarters (NUMERICS 4.7): what a
 * channel changes by along and across is at most 5/8 of its least and 3/512, in all; with 8 bits half of that. */
GN_HOT static int is_gentle(const gn_frame *frame, const int32_t (*colour_q24)[3], int quarters)
{
    const int eight = GN_OTHER_FORMATS && frame->picture.format == GN_FORMAT_RGB888;
    for (int c = 0; c < 3; c++) {
        const int32_t at[4] = {colour_q24[0][c], colour_q24[1][c], colour_q24[2][c], colour_q24[3][c]};
        int32_t lo = gn_min32(gn_min32(at[0], at[1]), gn_min32(at[2], at[3])),
                hi = gn_max32(gn_max32(at[0], at[1]), gn_max32(at[2], at[3]));
        uint32_t change[2];
        if (lo < 0 || hi > 1 << 24) return 0;
        gn_cell_changes(at, change);
        if ((change[0] + change[1]) << eight >> quarters > (5 * (uint32_t)lo >> 3) + (3U << 15)) return 0;
    }
    return 1;
}

/* Pixels of a block between its corners' levels, or colours. */
GN_HOT static GN_NOINLINE void draw_block(gn_shading *s, int32_t x, int32_t y, int32_t log2, const int32_t (*corner)[3],
                                          int encoded)
{
    const gn_lattice *l = &s->lattice;
    const uint32_t at = (uint32_t)(x - l->x);
    block_rows b;
    GN_COUNT(cells_drawn, 1);
    for (int c = 0; c < 3; c++) {
        b.from[c] = corner[0][c];
        b.across[c] = (corner[1][c] - corner[0][c]) >> log2;
        b.down[c] = (corner[2][c] - corner[0][c]) >> log2;
        b.down_across[c] = (((corner[3][c] - corner[2][c]) >> log2) - b.across[c]) >> log2;
    }
    b.size = 1 << log2;
    b.shift = at & 31;
    b.bits = &l->bits[at >> 5][y - l->y];
    b.encoded = encoded;
    store_block(s->frame, &s->rows, x, y, &b);
}

/* By levels at the corners. */
GN_HOT static void draw_encoded(gn_shading *s, int32_t x, int32_t y, int32_t log2, const int32_t (*colour_q24)[3])
{
    int32_t level[4][3];
    uint32_t packed[4];
    for (int i = 0; i < 4; i++) packed[i] = gn_pixel_encode(s->frame, colour_q24[i], level[i]);
    if (packed[0] == packed[1] && packed[0] == packed[2] && packed[0] == packed[3]) fill_cell(s, x, y, log2, packed[0]);
    else draw_block(s, x, y, log2, (const int32_t(*)[3])level, 1);
}

/* By levels at the corners of its quarters. */
GN_HOT static GN_NOINLINE void draw_quarters(gn_shading *s, int32_t x, int32_t y, int32_t log2,
                                             const int32_t (*colour_q24)[3])
{
    for (int32_t k = 0; k < 4; k++) {
        int32_t at[4][3], left = x + ((k & 1) << log2), top = y + ((k >> 1) << log2);
        if (!gn_lattice_columns(&s->lattice, left, top, 1 << log2, log2)) continue;
        for (int32_t i = 0; i < 4; i++)
            for (int c = 0; c < 3; c++) {
                int32_t across = (k & 1) + (i & 1), down = (k >> 1) + (i >> 1), /* halves of the cell */
                    upper = (2 - across) * (colour_q24[0][c] >> 2) + across * (colour_q24[1][c] >> 2),
                        lower = (2 - across) * (colour_q24[2][c] >> 2) + across * (colour_q24[3][c] >> 2);
                at[i][c] = (2 - down) * upper + down * lower;
            }
        draw_encoded(s, left, top, log2, (const int32_t(*)[3])at);
    }
}

GN_HOT void gn_lattice_draw_blocks(gn_shading *s, int32_t x, int32_t y, int32_t size_log2)
{
    const int32_t(*colour)[3] = (const int32_t(*)[3])s->lattice.look.colour_q24;
    uint32_t packed;
    if (!gn_pixel_has_levels(s->frame)) {
        if (s->frame->picture.format != GN_FORMAT_RAW32 && is_plain(s, colour, &packed))
            fill_cell(s, x, y, size_log2, packed);
        else draw_block(s, x, y, size_log2, colour, 0);
    } else if (is_gentle(s->frame, colour, 0)) draw_encoded(s, x, y, size_log2, colour);
    else if (size_log2 == 4 && is_gentle(s->frame, colour, 1)) draw_quarters(s, x, y, 3, colour);
    else draw_block(s, x, y, size_log2, colour, 0);
}

#endif
