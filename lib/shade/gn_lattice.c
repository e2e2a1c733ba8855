/* A surface by cells: parts of the screen, their columns of cells, and cells that are split. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_exact.h"
#include "shade/gn_lattice.h"
#include "shade/gn_lattice_window.h"
#include "shade/gn_part.h"

#if GN_INTERPOLATES

/* ---- Pixels of a part -------------------------------------------------------------------------------------------- */

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

/* Marks the part's pixels. Returns the number of rows with pixels in them. */
GN_HOT static int mark(gn_lattice *l)
{
    int any = 0;
    memset(l->bits, 0, sizeof l->bits);
    for (int32_t i = 0; i < l->n_spans; i++) {
        const gn_run_span *span = &l->span[i];
        int32_t row = span->y - l->y, from = gn_max32(span->x - l->x, 0),
                to = gn_min32(span->x + span->n_px - l->x, GN_PART_WIDTH);
        if (row < 0 || row >= l->n_rows || from >= to) continue;
        any++;
        if (from < 32) l->bits[0][row] |= bits_of(from, gn_min32(to, 32));
        if (to > 32) l->bits[1][row] |= bits_of(gn_max32(from - 32, 0), to - 32);
    }
    return any;
}

GN_HOT static int has_pixels(const gn_lattice *l, int32_t x, int32_t y, int32_t size_log2)
{
    uint32_t any = 0;
    for (int32_t i = 0; i < 1 << size_log2; i++) any |= gn_lattice_bits(l, x, y + i, size_log2);
    return any != 0;
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

GN_HOT static void shade_exactly(gn_shading *s, int32_t x, int32_t y, int32_t size_log2)
{
    for (int32_t j = y; j < y + (1 << size_log2); j++) {
        uint32_t bits = gn_lattice_bits(&s->lattice, x, j, size_log2);
        for (int32_t i = x; bits; bits >>= 1, i++)
            if (bits & 1U) gn_exact_pixel(s, i, j);
    }
}

GN_HOT static gn_corner *known(gn_shading *s, gn_corner *corner, int32_t x, int32_t y)
{
    if (corner->state == GN_CORNER_NEW) gn_corner_find(&s->lattice, s->frame, &s->surface, x, y, &s->sample, corner);
    return corner;
}

/* A cell that is being split into four. */
typedef struct {
    int32_t x, y, size_log2, next; /* the quarter to be shaded next */
    gn_corner *corner[9];          /* row by row */
} split_cell;

GN_HOT static void begin_split(gn_shading *s, split_cell *split, int32_t x, int32_t y, int32_t size_log2,
                               gn_corner *const corner[4])
{
    gn_corner *middle = s->lattice.middle[4 - size_log2];
    split->x = x;
    split->y = y;
    split->size_log2 = size_log2;
    split->next = 0;
    for (int i = 0; i < 4; i++) split->corner[(i & 1) * 2 + (i >> 1) * 6] = corner[i];
    for (int i = 0; i < 5; i++) {
        static const uint8_t place[5] = {1, 3, 4, 5, 7};
        middle[i].state = GN_CORNER_NEW;
        split->corner[place[i]] = &middle[i];
    }
    GN_COUNT(cells_split, 1);
}

/* The next quarter that has pixels. Returns 0 if there is none. */
GN_HOT static int next_quarter(gn_shading *s, split_cell *split, int32_t *x, int32_t *y, gn_corner *corner[4])
{
    int32_t log2 = split->size_log2 - 1;
    while (split->next < 4) {
        int32_t i = split->next & 1, j = split->next >> 1;
        split->next++;
        *x = split->x + i * (1 << log2);
        *y = split->y + j * (1 << log2);
        if (!has_pixels(&s->lattice, *x, *y, log2)) continue;
        for (int k = 0; k < 4; k++) {
            int32_t right = i + (k & 1), down = j + (k >> 1);
            corner[k] = known(s, split->corner[3 * down + right], split->x + right * (1 << log2),
                              split->y + down * (1 << log2));
        }
        return 1;
    }
    return 0;
}

/* Shades a cell, or the cells that it is split into: no deeper than its size. */
GN_HOT static void shade_cell(gn_shading *s, int32_t x, int32_t y, int32_t size_log2, gn_corner *corner[4])
{
    split_cell split[4];
    int depth = 0;
    for (;;) {
        GN_COUNT(cells, 1);
        if (gn_lattice_look_at(&s->lattice, s->frame, &s->surface, corner, size_log2))
            gn_lattice_draw(s, x, y, size_log2, corner);
        else if (size_log2 > 1) begin_split(s, &split[depth++], x, y, size_log2, corner);
        else shade_exactly(s, x, y, size_log2);
        while (depth > 0 && !next_quarter(s, &split[depth - 1], &x, &y, corner)) depth--;
        if (!depth) return;
        size_log2 = split[depth - 1].size_log2 - 1;
    }
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

/* The corners of a column of cells at x. */
GN_HOT static gn_corner *ring_at(gn_lattice *l, int32_t x)
{
    int which = (x >> l->size_log2) & 1;
    gn_corner *ring = l->ring[which];
    if (l->ring_x[which] == x) return ring;
    l->ring_x[which] = x;
    for (int i = 0; i < 3; i++) ring[i].state = GN_CORNER_NEW;
    return ring;
}

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

/* Column by column, which have corners in common. */
GN_HOT static void shade_part(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    int32_t log2 = l->size_log2, size = 1 << log2;
    for (int32_t x = l->x; x < gn_min32(l->x_end, l->x + GN_PART_WIDTH); x += size)
        for (int32_t row = 0; row < l->n_rows; row += size) {
            int32_t y = l->y + row;
            gn_corner *corner[4];
            if (!has_pixels(l, x, y, log2)) continue;
            for (int k = 0; k < 4; k++) {
                int32_t right = x + (k & 1) * size, down = (row >> log2) + (k >> 1);
                corner[k] = known(s, &ring_at(l, right)[down], right, l->y + down * size);
            }
            shade_cell(s, x, y, log2, corner);
        }
}

#if GN_SHADOWS
/* Of another surface. */
GN_HOT static void forget_windows(gn_lattice *l)
{
    for (int i = 0; i < GN_WINDOWS; i++) l->window[i].view = NULL;
}

/* Of another part. */
GN_HOT static void begin_part(gn_shading *s)
{
    gn_lattice_forget_part(&s->lattice);
    gn_corner_begin_part(&s->lattice, s->frame, &s->surface);
}
#else
GN_HOT static void forget_windows(gn_lattice *l)
{
    (void)l;
}

GN_HOT static void begin_part(gn_shading *s)
{
    (void)s;
}
#endif

/* Cells as large as the knob says, but not much larger than the surface; if its normals turn, than its shorter side. */
GN_HOT static int32_t cell_log2(const gn_frame *frame, const gn_surface *s, const gn_rect *box)
{
    int32_t most = GN_K(frame, persp_step) >= 8 ? 4 : 3, log2 = 1;
    int32_t w = box->x1 - box->x0, h = box->y1 - box->y0, across = GN_CURVED(s) ? gn_min32(w, h) : gn_max32(w, h);
    (void)frame, (void)s;
    while (log2 < most && 1 << log2 < across) log2++;
    return log2;
}

GN_HOT void gn_lattice_shade(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    gn_rect box = box_of(l);
    if (!gn_corner_begin(l, s->frame, &s->surface, &box)) {
        for (int32_t i = 0; i < l->n_spans; i++)
            for (int32_t k = 0; k < l->span[i].n_px; k++) gn_exact_pixel(s, l->span[i].x + k, l->span[i].y);
        return;
    }
    l->size_log2 = cell_log2(s->frame, &s->surface, &box);
    l->n_rows = gn_min32(2 << l->size_log2, GN_PART_ROWS);
    l->x_end = box.x1;
    l->y_end = box.y1;
    l->has_face = 0;
    gn_part_begin(s);
    forget_windows(l);
    for (l->y = box.y0; l->y < box.y1; l->y += l->n_rows) {
        l->ring_x[0] = l->ring_x[1] = INT32_MIN;
        for (l->x = box.x0; l->x < box.x1; l->x = l->part_end) {
            begin_part(s);
            if (!gn_part_shade(s) && mark(l)) shade_part(s);
        }
    }
}

#endif
