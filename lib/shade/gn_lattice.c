/* A surface by cells: parts of the screen, their columns of cells, and cells that are split. [R4] */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_lattice.h"
#include "shade/gn_pixel.h"
#include "shade/gn_surface.h"

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
GN_HOT static GN_NOINLINE int mark(gn_lattice *l)
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

/* A small triangle, a part, or a cell costs as much as these pixels do by themselves; a part, more where its box is
 * long. */
enum { FEW_OF_ONE_COLOUR = 8, FEW = 12, FEW_OF_A_CELL = 5 };

/* Pixels of a cell, counted up to one more than are few. */
GN_HOT static int32_t count_some(const gn_lattice *l, int32_t x, int32_t y, int32_t size_log2)
{
    int32_t n = 0;
    for (int32_t j = y; j < y + (1 << size_log2) && n <= FEW_OF_A_CELL; j++)
        for (uint32_t bits = gn_lattice_bits(l, x, j, size_log2); bits && n <= FEW_OF_A_CELL; bits &= bits - 1) n++;
    return n;
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

/* If they are few. Returns 0 if the cell is worth it. */
GN_HOT static GN_NOINLINE int shade_few(gn_shading *s, int32_t x, int32_t y, int32_t size_log2)
{
    const int32_t n = count_some(&s->lattice, x, y, size_log2);
    if (n > FEW_OF_A_CELL) return 0;
    if (n) shade_cell_by_pixels(s, x, y, size_log2);
    return 1;
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
    gn_corner_find(l, s->frame, &s->surface, x, y, &s->sample, &l->from.corners[i]);
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
        if (shade_few(s, *x, *y, log2)) continue;
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

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

GN_HOT static void forget_corners(gn_lattice *l)
{
    for (int i = 0; i < GN_CORNERS; i++) l->corner_key[i] = UINT32_MAX;
    memset(l->corner_at, 0, sizeof l->corner_at);
    l->next_corner = l->now = 0;
}

/* Column by column, which have corners in common. */
GN_HOT static GN_NOINLINE void shade_part(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    int32_t log2 = l->size_log2, size = 1 << log2, x_end = gn_min32(l->x_end, l->x + GN_PART_WIDTH);
    forget_corners(l);
    for (int32_t x = l->x; x < x_end; x += size)
        for (int32_t y = l->y; y < l->y + l->n_rows; y += size)
            if (!shade_few(s, x, y, log2)) shade_cell(s, x, y, log2);
}

#if GN_SHADOWS
/* Of another surface. */
GN_HOT static void forget_windows(gn_lattice *l)
{
    for (int i = 0; i < GN_WINDOWS; i++) l->window[i].view = NULL;
}

/* Of another part. */
GN_HOT static GN_NOINLINE void begin_part(gn_shading *s)
{
    s->lattice.crowded = 0;
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
    s->lattice.crowded = 0;
}
#endif

/* Cells as large as the knob says, but not much larger than the surface; if its normals turn, than its shorter side. */
GN_HOT static int32_t cell_log2(const gn_frame *frame, const gn_surface *s, const gn_rect *box)
{
    int32_t most = GN_K(frame, persp_step) >= 8 ? 4 : 3, log2 = GN_SMALLEST_CELL_LOG2;
    int32_t w = box->x1 - box->x0, h = box->y1 - box->y0, across = GN_SMOOTH(s) ? gn_min32(w, h) : gn_max32(w, h);
    (void)frame, (void)s;
    while (log2 < most && 1 << log2 < across) log2++;
    return log2;
}

GN_HOT static int32_t count_pixels(const gn_lattice *l)
{
    int32_t n = 0;
    for (int32_t i = 0; i < l->n_spans; i++) n += l->span[i].n_px;
    return n;
}

GN_HOT void gn_lattice_begin_tile(gn_shading *s)
{
#if GN_SHADOWS
    gn_levels_forget(&s->lattice);
    s->lattice.matrix.view = NULL;
#endif
    (void)s;
}

/* Each for itself, as corners or exactly. */
GN_HOT static GN_NOINLINE void shade_pixels(gn_shading *s, int exactly)
{
    const gn_lattice *l = &s->lattice;
    for (int32_t i = 0; i < l->n_spans; i++)
        for (int32_t k = 0; k < l->span[i].n_px; k++) {
            if (exactly) gn_exact_pixel(s, l->span[i].x + k, l->span[i].y);
            else gn_corner_pixel(s, l->span[i].x + k, l->span[i].y);
        }
}

/* Whether pixels are fewer than a part pays for. */
GN_HOT static int are_few(const gn_lattice *l, const gn_rect *box, int32_t n_px)
{
    return n_px <= (l->uniform ? FEW_OF_ONE_COLOUR : FEW + ((box->x1 - box->x0 + box->y1 - box->y0) >> 2));
}

/* Rows of pixels in a part, but for low ones. */
GN_HOT static int32_t part_rows(const gn_lattice *l)
{
    return l->size_log2 > GN_SMALLEST_CELL_LOG2 ? GN_PART_ROWS : GN_LOW_ROWS;
}

/* Shades a surface that takes no parts. Otherwise returns 1, and sets where parts are. */
GN_HOT static GN_NOINLINE int begin_parts(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    gn_rect box = box_of(l);
    int reached = gn_corner_begin_lights(l, s->frame, &s->surface);
    int32_t n_px = count_pixels(l);
    gn_surface_use_bary(s->frame, &s->surface);
    /* of parallel rays each pixel has its own highlight: gn_sample_on_plane() is of rays from the eye */
    const int alone = n_px == 1 || (GN_FLAT_Q16(s->frame) && GN_SPECULAR && s->surface.specular && s->surface.n_lights);
    const int few = are_few(l, &box, n_px);
    l->size_log2 = few ? 0 : cell_log2(s->frame, &s->surface, &box);
    const int32_t beyond = 1 << (l->uniform && !few ? 4 : l->size_log2); /* rows of parts look ahead */
    if (!reached || alone || !gn_corner_begin(l, s->frame, &s->surface, &box, beyond)) {
        shade_pixels(s, 1);
        return 0;
    }
    l->has_face = 0;
    if (few) {
        l->cascade = l->surface_cascade;
        shade_pixels(s, 0);
        return 0;
    }
    l->n_rows = part_rows(l);
    l->x = box.x0;
    l->y = box.y0;
    l->x_end = box.x1;
    l->y_end = box.y1;
    forget_windows(l);
    return 1;
}

/* Part by part. One of which a window holds too few texels is shaded in lower rows, all of them before the next one. */
GN_HOT void gn_lattice_shade(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    if (!begin_parts(s)) return;
    const int32_t x0 = l->x, x_end = l->x_end;
    int32_t y = l->y, low_x = x0;
    while (y < l->y_end) {
        begin_part(s);
        if (!gn_part_shade(s)) {
            if (l->crowded) {
                low_x = l->x;
                l->x_end = l->part_end;
                l->n_rows = GN_LOW_ROWS;
                continue;
            }
            if (mark(l)) shade_part(s);
        }
        l->x = l->part_end;
        if (l->x < l->x_end) continue;
        l->y += l->n_rows;
        l->x = low_x;
        if (l->y < y + part_rows(l) && l->y < l->y_end) continue;
        if (l->x_end < x_end) l->x = l->x_end; /* the tall part after low ones */
        else {
            y += part_rows(l);
            l->x = x0;
        }
        l->y = y;
        l->x_end = x_end;
        l->n_rows = part_rows(l);
    }
}

#endif
