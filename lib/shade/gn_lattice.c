/* A surface by cells: parts of the screen, their columns of cells, and cells that are split. [R4] */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_lattice.h"
#include "shade/gn_pixel.h"
#include "shade/gn_surface.h"

#if GN_INTERPOLATES

/* ---- Pixels of a block ------------------------------------------------------------------------------------------ */

GN_HOT static gn_rect box_of(const gn_lattice *l)
{
    gn_rect box = {INT32_MAX, l->span[0].y, INT32_MIN, l->span[l->n_spans - 1].y + 1};
    for (int32_t i = 0; i < l->n_spans; i++) {
        const gn_run_span *span = &l->span[i];
        box.x0 = gn_min32(box.x0, span->x);
        box.x1 = gn_max32(box.x1, span->x + span->n_px);
    }
    return box;
}

/* Bits from..to - 1 of a word, 0 <= from < to <= 32 */
GN_HOT static inline uint32_t bits_of(int32_t from, int32_t to)
{
    return (UINT32_MAX >> (32 - (to - from))) << from;
}

/* Sets the box of the block's pixels, and for cells which they are. Returns 0 if there are none. */
GN_HOT static GN_NOINLINE int mark(gn_lattice *l)
{
    gn_rect *seen = &l->seen;
    const int cells = !(l->few | l->uniform);
    *seen = (gn_rect){INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
    if (cells) memset(l->bits, 0, sizeof l->bits);
    for (int32_t i = 0; i < l->n_spans; i++) {
        const gn_run_span *span = &l->span[i];
        int32_t row = span->y - l->y, from = gn_max32(span->x - l->x, 0),
                to = gn_min32(span->x + span->n_px - l->x, GN_PART_WIDTH);
        if (row < 0 || row >= GN_PART_ROWS || from >= to) continue;
        seen->x0 = gn_min32(seen->x0, l->x + from);
        seen->x1 = gn_max32(seen->x1, l->x + to);
        seen->y0 = gn_min32(seen->y0, span->y);
        seen->y1 = span->y + 1;
        if (!cells) continue;
        if (from < 32) l->bits[0][row] |= bits_of(from, gn_min32(to, 32));
        if (to > 32) l->bits[1][row] |= bits_of(gn_max32(from - 32, 0), to - 32);
    }
    return seen->x0 < seen->x1;
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

GN_HOT static GN_NOINLINE void shade_cell_by_pixels(gn_shading *s, int32_t x, int32_t y, int32_t size_log2)
{
    for (int32_t j = y; j < y + (1 << size_log2); j++) {
        uint32_t bits = gn_lattice_bits(&s->lattice, x, j, size_log2);
        for (int32_t i = x; bits; bits >>= 1, i++)
            if (bits & 1U) gn_corner_pixel(s, i, j);
    }
}

/* Another corner, in place of one that is none of the last four. One that another has taken the place of in corner_at
 * is found again. */
GN_HOT static GN_NOINLINE uint32_t new_corner(gn_shading *s, int32_t x, int32_t y, uint32_t key)
{
    gn_lattice *l = &s->lattice;
    uint32_t i;
    do {
        i = l->next_corner;
        l->next_corner = i + 1 < GN_CORNERS ? i + 1 : 0;
    } while (l->corner_key[i] != UINT32_MAX && l->now - l->corner_used[i] < 4);
    l->corner_key[i] = key;
    gn_corner_find(l, s->frame, &s->surface, x, y, 0, &l->from.corners[i]);
    return i;
}

/* The corner at a pixel, if need be a new one. */
GN_HOT static inline gn_corner *corner_at(gn_shading *s, int32_t x, int32_t y)
{
    gn_lattice *l = &s->lattice;
    uint32_t key = (uint32_t)y << 16 | (uint32_t)x, i;
    uint8_t *at = &l->corner_at[y >> 2 & 7][x >> 2 & 7];
    l->now++;
    if (l->corner_key[*at] != key) *at = (uint8_t)new_corner(s, x, y, key);
    i = *at;
    l->corner_used[i] = l->now;
    return &l->from.corners[i];
}

GN_HOT static void find_corners(gn_shading *s, int32_t x, int32_t y, int32_t size_log2)
{
    GN_UNROLL
    for (int32_t k = 0; k < 4; k++)
        s->lattice.cell_corner[k] = corner_at(s, x + ((k & 1) << size_log2), y + ((k >> 1) << size_log2));
}

/* The next quarter that has pixels. Returns 0 if there is none. */
GN_HOT static int next_quarter(gn_shading *s, gn_split_cell *split, int32_t *x, int32_t *y)
{
    int32_t log2 = split->size_log2 - 1;
    while (split->next < 4) {
        *x = split->x + ((split->next & 1) << log2);
        *y = split->y + ((split->next >> 1) << log2);
        split->next++;
        if (!gn_lattice_columns(&s->lattice, *x, *y, 1 << log2, log2)) continue;
        find_corners(s, *x, *y, log2);
        return 1;
    }
    return 0;
}

/* Shades a cell, or the cells that it is split into: no deeper than its size. */
GN_HOT static void shade_cell(gn_shading *s, int32_t x, int32_t y, int32_t size_log2)
{
    gn_split_cell *split = s->lattice.split;
    int depth = 0;
    find_corners(s, x, y, size_log2);
    for (;;) {
        GN_COUNT(cells, 1);
        if (gn_lattice_look_at(&s->lattice, s->frame, &s->surface, size_log2)) gn_lattice_draw(s, x, y, size_log2);
        else if (size_log2 > GN_SMALLEST_CELL_LOG2) {
            GN_COUNT(cells_split, 1);
            split[depth++] = (gn_split_cell){(int16_t)x, (int16_t)y, (uint8_t)size_log2, 0};
        } else shade_cell_by_pixels(s, x, y, size_log2);
        while (depth > 0 && !next_quarter(s, &split[depth - 1], &x, &y)) depth--;
        if (!depth) return;
        size_log2 = split[depth - 1].size_log2 - 1;
    }
}

GN_HOT static void forget_corners(gn_lattice *l)
{
    for (int i = 0; i < GN_CORNERS; i++) l->corner_key[i] = UINT32_MAX;
    memset(l->corner_at, 0, sizeof l->corner_at);
    l->next_corner = l->now = 0;
}

/* Column by column, which have corners in common. */
GN_HOT static GN_NOINLINE void shade_cells(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    int32_t log2 = l->size_log2, size = 1 << log2;
    forget_corners(l);
    for (int32_t x = l->seen.x0 - ((l->seen.x0 - l->x) & (size - 1)); x < l->seen.x1; x += size)
        for (int32_t y = l->seen.y0 - ((l->seen.y0 - l->y) & (size - 1)); y < l->seen.y1; y += size)
            if (gn_lattice_columns(l, x, y, size, log2)) shade_cell(s, x, y, log2);
}

GN_HOT void gn_lattice_begin_tile(gn_shading *s)
{
#if GN_SHADOWS
    gn_levels_forget(&s->lattice);
#endif
    (void)s;
}

/* Cells as large as the knob says, half of that under several lamps, which large ones seldom hold for; not much larger
 * than the surface, or than its shorter side if its normals turn. */
GN_HOT static int32_t cell_log2(const gn_frame *frame, const gn_surface *s, const gn_rect *box)
{
    int32_t most = GN_K(frame, persp_step) >= 8 && s->n_punctual < 2 ? 4 : 3, log2 = GN_SMALLEST_CELL_LOG2;
    int32_t w = box->x1 - box->x0, h = box->y1 - box->y0, across = GN_SMOOTH(s) ? gn_min32(w, h) : gn_max32(w, h);
    (void)frame, (void)s;
    while (log2 < most && 1 << log2 < across) log2++;
    return log2;
}

/* ---- Blocks ------------------------------------------------------------------------------------------------------ */

/* Of another block. */
GN_HOT static GN_NOINLINE void begin_block(gn_shading *s)
{
#if GN_SHADOWS
    for (int i = 0; i < GN_WINDOWS; i++) s->lattice.window[i].view = NULL;
    s->lattice.by.look.ask.used = 0;
    gn_corner_begin_part(&s->lattice, s->frame, &s->surface);
#else
    (void)s;
#endif
}

/* Half pixels from the picture's centre to a coordinate, up to 2^14, with 2^63 / (depth 2^clz). */
GN_HOT static inline int32_t halves_to(const gn_frame *frame, int32_t v_q16, uint32_t recip, int32_t clz)
{
    const uint64_t slope_q16 = (uint64_t)gn_abs32(v_q16) * recip >> (47 - clz),
                   halves = (slope_q16 >> 26 ? 1U << 26 : slope_q16) * frame->cam.focal2_px_q16 >> 32;
    const int32_t n = halves >> 14 ? 1 << 14 : (int32_t)halves;
    return v_q16 < 0 ? -n - 1 : n;
}

/* The part of the picture that the surface's box of view space is in, to a pixel. */
GN_HOT static GN_NOINLINE void find_screen_bounds(const gn_frame *frame, const gn_surface *s, gn_rect *out)
{
    int32_t lo[2], hi[2], clz[2];
    uint32_t recip[2];
    for (int i = 0; i < 2; i++) {
        const int32_t z = GN_FLAT_Q16(frame) ? GN_FLAT_Q16(frame) : i ? s->z_max_q16 : s->z_min_q16;
        clz[i] = gn_clz32((uint32_t)z);
        recip[i] = gn_recip_norm((uint32_t)z << clz[i], 1);
    }
    for (int i = 0; i < 2; i++) {
        const int far_lo = s->lo_q16[i] >= 0, far_hi = s->hi_q16[i] < 0;
        lo[i] = halves_to(frame, s->lo_q16[i], recip[far_lo], clz[far_lo]);
        hi[i] = halves_to(frame, s->hi_q16[i], recip[far_hi], clz[far_hi]);
    }
    const int32_t w = frame->picture.width, h = frame->picture.height;
    out->x0 = gn_max32((lo[0] + w) >> 1, 0);
    out->x1 = gn_min32((hi[0] + w + 2) >> 1, w);
    out->y0 = gn_max32((h - 1 - hi[1]) >> 1, 0);
    out->y1 = gn_min32((h + 2 - lo[1]) >> 1, h);
}

/* Pixels of the block, each for itself. */
GN_HOT static GN_NOINLINE void shade_pixels(gn_shading *s)
{
    const gn_lattice *l = &s->lattice;
    for (int32_t i = 0; i < l->n_spans; i++) {
        const gn_run_span *span = &l->span[i];
        const int32_t end = gn_min32(span->x + span->n_px, l->seen.x1);
        if (span->y < l->seen.y0 || span->y >= l->seen.y1) continue;
        for (int32_t x = gn_max32(span->x, l->seen.x0); x < end; x++) gn_corner_pixel(s, x, span->y);
    }
}

/* Part of the block that the surface may have, out to whole cells. */
GN_HOT static void cut_block(gn_lattice *l)
{
    const int32_t rest = (1 << l->size_log2) - 1;
    gn_rect *r = &l->block;
    r->x0 = gn_max32(l->bounds.x0 - ((l->bounds.x0 - l->x) & rest), l->x);
    r->x1 = gn_min32(l->bounds.x1 + ((l->x - l->bounds.x1) & rest), l->x + GN_PART_WIDTH);
    r->y0 = gn_max32(l->bounds.y0 - ((l->bounds.y0 - l->y) & rest), l->y);
    r->y1 = gn_min32(l->bounds.y1 + ((l->y - l->bounds.y1) & rest), l->y + GN_PART_ROWS);
    if (r->x0 < r->x1 && r->y0 < r->y1) return;
    *r = (gn_rect){l->x, l->y, l->x + GN_PART_WIDTH, l->y + GN_PART_ROWS}; /* does not happen */
}

GN_HOT static void shade_block(gn_shading *s, int32_t x, int32_t y)
{
    gn_lattice *l = &s->lattice;
    l->x = x;
    l->y = y;
    if (!mark(l)) return;
    cut_block(l);
    if (!gn_corner_begin(l, s->frame, &s->surface, &l->block)) {
        shade_pixels(s);
        return;
    }
    begin_block(s);
    if (l->few) shade_pixels(s);
    else if (l->uniform) gn_part_shade(s);
    else shade_cells(s);
}

/* Where blocks of `size` pixels begin along an axis: of what is smaller than one, where it begins. */
GN_HOT static int32_t first_block(int32_t from, int32_t end, int32_t seen, int32_t size)
{
    if (end - from > size) return seen & -size;
    return seen - (((seen - from) % size + size) % size);
}

/* A surface whose box has so many pixels is shaded pixel by pixel, one whose normals turn with more: corners beside it
 * are of no use. */
enum { FEW = 64, FEW_SMOOTH = 256 };

GN_HOT void gn_lattice_shade(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    const gn_rect box = box_of(l), *bounds = &l->bounds;
    gn_corner_begin_lights(l, s->frame, &s->surface);
    gn_surface_use_bary(s->frame, &s->surface);
    find_screen_bounds(s->frame, &s->surface, &l->bounds);
    l->size_log2 = cell_log2(s->frame, &s->surface, &l->bounds);
    l->few = (bounds->x1 - bounds->x0) * (bounds->y1 - bounds->y0) <= (GN_SMOOTH(&s->surface) ? FEW_SMOOTH : FEW);
    l->has_face = 0;
#if GN_SHADOWS
    gn_corner_begin_cascade(l, s->frame, &s->surface);
#endif
    const int32_t x0 = first_block(bounds->x0, bounds->x1, box.x0, GN_PART_WIDTH),
                  y0 = first_block(bounds->y0, bounds->y1, box.y0, GN_PART_ROWS);
    for (int32_t y = y0; y < box.y1; y += GN_PART_ROWS)
        for (int32_t x = x0; x < box.x1; x += GN_PART_WIDTH) shade_block(s, x, y);
}

#endif
