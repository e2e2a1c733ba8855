/* Shading of a screen tile. */
#include "gn_internal.h"

#include <string.h>

#include "gn_stages.h"
#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "light/gn_punctual.h"
#include "shade/gn_arrival.h"
#include "shade/gn_chord.h"
#include "shade/gn_light.h"
#include "shade/gn_piece.h"
#include "shade/gn_pixel.h"
#include "visible/gn_cell.h"
#include "visible/gn_runs.h"
#include "visible/gn_screen_rect.h"

typedef gn_shading shading;

/* Q1.30 to 10 bits, offset 512 */
GN_HOT static uint32_t pack_axis(int64_t v_q30)
{
    return (uint32_t)(512 + gn_clamp64(gn_shr64(v_q30 * 511, 30), -511, 511));
}

GN_HOT static uint32_t raw_normal(const gn_shading *s, int32_t x, int32_t y)
{
    int32_t n[3], unit[3];
    gn_sample_normal(s->frame, &s->surface, x, y, n);
    int64_t wide[3] = {n[0], n[1], n[2]};
    if (!gn_normalise_q30(unit, wide)) return 512U << 20 | 512U << 10 | 512U;
    return pack_axis(unit[0]) << 20 | pack_axis(unit[1]) << 10 | pack_axis(unit[2]);
}

/* A raw view's value of the surface. [A6] */
GN_HOT static uint32_t raw_value(const gn_shading *s, const gn_sample *sample, int32_t x, int32_t y)
{
    const gn_picture *picture = &s->frame->picture;
    switch (picture->view) {
    case GN_VIEW_SHADOW:
        return gn_light_shadow(s->frame, &s->surface, sample, picture->view_light);
    case GN_VIEW_DEPTH:
        return (uint32_t)sample->value[GN_VALUE_Z];
    case GN_VIEW_CASCADE:
        return gn_sample_cascade(s->frame, &s->surface, x, y);
    case GN_VIEW_NORMAL:
        return raw_normal(s, x, y);
    default:
        return (uint32_t)s->tri->object_idx << 16 | s->tri->triangle_idx;
    }
}

GN_HOT static uint32_t pack(gn_shading *s, const uint32_t q20[3])
{
    uint32_t *last = s->last_q20;
    GN_ELEMENT(last);
    if (q20[0] != last[0] || q20[1] != last[1] || q20[2] != last[2]) {
        last[0] = q20[0];
        last[1] = q20[1];
        last[2] = q20[2];
        GN_COUNT(packed, 1);
        s->last_pixel = gn_pixel_pack(s->frame, q20);
    }
    return s->last_pixel;
}

GN_HOT static void shade_pixel(gn_shading *s, gn_sample *sample, int32_t x, int32_t y)
{
    sample->x = x;
    sample->y = y;
    if (GN_RAW_VIEWS && s->frame->picture.format == GN_FORMAT_RAW32) {
        s->scratch->pixel.raw[(y - s->rect.y0) * s->rows.width + x - s->rect.x0] = raw_value(s, sample, x, y);
        return;
    }
    GN_COUNT(shaded, 1);
    gn_light_radiance(s->frame, &s->surface, sample, s->radiance_q20);
    gn_pixel_store(s->frame, &s->rows, x, y, pack(s, s->radiance_q20));
}

/* A sample, with the incident light of spots and points. */
GN_HOT static inline void sample_with_arrivals(shading *s, int32_t x, int32_t y, gn_sample *sample)
{
    gn_sample_at(s->frame, &s->surface, x, y, sample);
    if (GN_PUNCTUAL_LIGHTS) gn_arrivals_at(s->frame, &s->surface, sample);
}

/* The n - 1 pixels between two samples, along a chord that is set. */
GN_HOT static void shade_chord(shading *s, gn_sample *from, const gn_sample *to, int32_t x, int32_t y, int32_t n)
{
    int32_t first = s->surface.first_value;
    gn_chord *chord = &s->by.run.chord;
    if (GN_ARRIVAL_STEPS) gn_arrivals_between(chord, s->frame, &s->surface, from, to, n);
    GN_COUNT(stepped, n * (chord->end - first));
    for (int32_t k = 1; k < n; k++) {
        gn_chord_next(chord, from->value, first);
        if (GN_ARRIVAL_STEPS) gn_arrivals_next(chord, s->frame, &s->surface, from);
        shade_pixel(s, from, x + k, y);
    }
}

/* Pixels x_begin <= x < x_end of one row, all of this triangle: every one exact. */
GN_HOT static inline void shade_run_exact(gn_shading *s, int32_t y, int32_t x_begin, int32_t x_end)
{
    gn_sample *here = &s->by.run.sample[0];
    GN_ELEMENT(here);
    for (int32_t x = x_begin; x < x_end; x++) {
        sample_with_arrivals(s, x, y, here);
        shade_pixel(s, here, x, y);
    }
}

/* The same, with interpolation. Pixels are exact at both ends of the run and at least every persp_step pixels, with
 * parabolas between where these are within tolerance (gn_chord): 1/w is never extrapolated past the triangle. */
GN_HOT static inline void shade_run_stepped(gn_shading *s, int32_t y, int32_t x_begin, int32_t x_end)
{
    int32_t step_px = s->surface.specular ? 1 : GN_K(s->frame, persp_step); /* a highlight is narrower than its n . h */
    gn_chord *chord = &s->by.run.chord;
    gn_sample *here = &s->by.run.sample[0], *next = &s->by.run.sample[1];
    sample_with_arrivals(s, x_begin, y, here);
    shade_pixel(s, here, x_begin, y);
    for (int32_t x = x_begin; x < x_end - 1;) {
        int32_t n = gn_min32(step_px, x_end - 1 - x);
        gn_sample_at(s->frame, &s->surface, x + n, y, next);
        while (n > 1 && !gn_chord_between(chord, s->frame, &s->surface, here, next, n)) {
            n >>= 1;
            gn_sample_at(s->frame, &s->surface, x + n, y, next);
        }
        if (GN_PUNCTUAL_LIGHTS) gn_arrivals_at(s->frame, &s->surface, next);
        if (n > 1) shade_chord(s, here, next, x, y, n);
        gn_sample *swap = here;
        here = next;
        next = swap;
        x += n;
        shade_pixel(s, here, x, y);
    }
}

/* Shades every pixel by division, or steps between exact samples. [R4] */
GN_HOT static void shade_run(gn_shading *s, int32_t y, int32_t x_begin, int32_t x_end)
{
    if (!GN_RUNTIME_KNOBS && GN_PERSP_STEP == 1) shade_run_exact(s, y, x_begin, x_end);
    else shade_run_stepped(s, y, x_begin, x_end);
}

/* The one pixel value of a surface of constant colour. */
GN_HOT static uint32_t constant_pixel(gn_shading *s)
{
    gn_sample *sample = &s->by.run.sample[0];
    GN_ELEMENT(sample);
    uint32_t radiance_q20[3];
    sample->cascade = GN_CASCADE_NONE;
    for (uint32_t i = 0; i < s->surface.n_lights; i++)
        sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i] = s->surface.light[i].cosine_q24[0];
    gn_light_radiance(s->frame, &s->surface, sample, radiance_q20);
    return pack(s, radiance_q20);
}

#if GN_PIECES
/* Takes the triangle's runs and links them one after the other, from the first; s->spanned is the part of the screen
 * that they span. */
GN_HOT static GN_NOINLINE void link_runs(gn_shading *s, gn_run_taker *taker, uint32_t first, int32_t n_px)
{
    uint32_t stride = (uint32_t)GN_K(s->frame, tile_width), at = first, *cell = GN_CELLS(s->scratch);
    int32_t x = (int32_t)(first % stride), x0 = x, x1 = x + n_px, y0 = (int32_t)(first / stride);
    while (gn_runs_take(taker, stride, &first, &n_px)) {
        cell[at] = first << 16 | taker->id;
        at = first;
        x = (int32_t)(first % stride);
        x0 = gn_min32(x0, x);
        x1 = gn_max32(x1, x + n_px);
    }
    cell[at] = at << 16 | taker->id;
    const gn_rect spanned = {x0 + s->rect.x0, y0 + s->rect.y0, x1 + s->rect.x0,
                             (int32_t)(at / stride) + 1 + s->rect.y0};
    s->spanned = spanned;
}

/* Of the runs that are linked from `first` on, shades the pixels in a part of the screen. */
GN_HOT static void shade_part(gn_shading *s, gn_pieces *pieces, uint32_t first, const gn_rect *part)
{
    const uint32_t *cells = GN_CELLS(s->scratch), stride = (uint32_t)GN_K(s->frame, tile_width),
                   id = cells[first] & 0xFFFFU;
    const gn_rect copy = *part, *const r = GN_SIZE_FIRST ? part : &copy; /* a copy is in registers */
    uint32_t i = first, next, row = first - first % stride;
    int32_t y = s->rect.y0 + (int32_t)(first / stride), left = s->rect.x0;
    for (;; i = next) {
        const uint32_t *cell = cells + i;
        for (; i - row >= stride; row += stride) y++;
        if (y >= r->y1) return;
        next = cell[0] >> 16;
        int32_t x = left + (int32_t)(i - row);
        int32_t x_end = x + (i + 1 < row + stride && (cell[1] & 0xFFFFU) == id ? (int32_t)(cell[1] >> 16) : 1);
        x = gn_max32(x, r->x0);
        x_end = gn_min32(x_end, r->x1);
        if (x < x_end && y >= r->y0) {
            GN_COUNT(runs, 1);
            if (pieces) gn_pieces_row(pieces, &s->rows, y, x, x_end);
            else shade_run(s, y, x, x_end);
        }
        if (next == i) return;
    }
}

/* Left to right, patch by patch, each as wide as tolerances allow. If the first patch of a band fails, in bands of half
 * the height. */
GN_HOT static void shade_pieces(gn_shading *s, gn_pieces *pieces, uint32_t first, const gn_rect *all)
{
    gn_rect *part = &s->part;
    int32_t height = GN_PIECE_ROWS;
    for (int32_t y = all->y0; y < all->y1; y = part->y1) {
        const gn_rect rows = {all->x0, y, all->x1, gn_min32(y + height, all->y1)};
        *part = rows;
        for (int32_t width = GN_PIECE_WIDTH; part->x0 < all->x1; part->x0 = part->x1) {
            part->x1 = gn_min32(part->x0 + width, all->x1);
            int is_piece = gn_pieces_select(pieces, part);
            if (is_piece) width = gn_min32(2 * width, GN_PIECE_WIDTH);
            while (!is_piece && (part->x1 - part->x0 > 4 || (part->x0 == all->x0 && part->y1 - y > 8))) {
                if (part->x0 == all->x0 && part->y1 - y > 8) {
                    height = 8;
                    part->y1 = y + 8;
                } else {
                    part->x1 = part->x0 + ((part->x1 - part->x0 + 1) >> 1);
                    width = part->x1 - part->x0;
                }
                is_piece = gn_pieces_select(pieces, part);
            }
            if (is_piece) {
                shade_part(s, pieces, first, part);
                continue;
            }
            shade_part(s, NULL, first, part); /* it overwrites the patches' memory */
            gn_pieces_begin(pieces, s->frame, &s->surface, all);
        }
    }
}

/* Shades a triangle whose first run is taken. Returns 0 if its surface cannot be shaded in patches. */
GN_HOT static int shade_in_pieces(gn_shading *s, gn_run_taker *taker, uint32_t first, int32_t n_px)
{
    gn_pieces *pieces = &s->by.pieces;
    gn_rect *spanned = &s->spanned;
    if (!gn_pieces_fit(s->frame, &s->surface)) return 0;
    link_runs(s, taker, first, n_px);
    if (!gn_pieces_begin(pieces, s->frame, &s->surface, spanned)) shade_part(s, NULL, first, spanned);
    else shade_pieces(s, pieces, first, spanned);
    return 1;
}
#else
GN_HOT static int shade_in_pieces(gn_shading *s, gn_run_taker *taker, uint32_t first, int32_t n_px)
{
    (void)s, (void)taker, (void)first, (void)n_px;
    return 0;
}
#endif

GN_HOT static void shade_triangle(gn_shading *s, uint32_t tri_idx)
{
    const gn_frame *frame = s->frame;
    uint32_t stride = (uint32_t)GN_K(frame, tile_width), first, packed = 0;
    int32_t n_px;
    int constant;
    gn_run_taker taker;
    gn_runs_begin(&taker, s->scratch, gn_cell_id(frame, tri_idx));
    if (!gn_runs_take(&taker, stride, &first, &n_px)) return;
    s->tri = &frame->tri[tri_idx];
    gn_surface_begin(frame, s->scratch, &s->cache, &s->surface, s->tri);
    constant = gn_surface_is_constant(&s->surface) && frame->picture.format != GN_FORMAT_RAW32;
    if (constant) packed = constant_pixel(s);
    else if (shade_in_pieces(s, &taker, first, n_px)) return;
    do {
        int32_t x = s->rect.x0 + (int32_t)(first % stride), y = s->rect.y0 + (int32_t)(first / stride);
        GN_COUNT(runs, 1);
        if (constant) {
            GN_COUNT(filled, n_px);
            gn_pixel_fill(frame, &s->rows, x, y, n_px, packed);
        } else shade_run(s, y, x, x + n_px);
    } while (gn_runs_take(&taker, stride, &first, &n_px));
}

/* ---- Runs -------------------------------------------------------------------------------------------------------- */

enum { NOT_PLAIN, PLAIN, PLAIN_565 };

/* Plain objects: unlit, of one colour. Their pixels are filled in as soon as their runs are found. */
typedef struct {
    uint32_t object_idx;
    int plain;
    uint32_t packed;
} object_look;

#define LOOKS 8 /* a power of two */

GN_HOT static const object_look *look_at(gn_shading *s, object_look looks[LOOKS], uint32_t object_idx)
{
    const gn_object *object = &s->frame->scene->objects[object_idx];
    object_look *look = &looks[object_idx & (LOOKS - 1)];
    uint32_t q20[3];
    if (look->object_idx != object_idx) {
        look->object_idx = object_idx;
        int plain = object->flags & GN_OBJECT_UNLIT && !(GN_VERTEX_COLOURS && object->mesh->rgb_uq16) &&
                    !(GN_TEXTURES && object->texture) && s->frame->picture.format != GN_FORMAT_RAW32;
        look->plain = !plain ? NOT_PLAIN : s->frame->picture.format == GN_FORMAT_RGB565 ? PLAIN_565 : PLAIN;
        for (int c = 0; c < 3; c++) q20[c] = object->albedo_uq16[c] << 4;
        if (plain) look->packed = pack(s, q20);
    }
    return look;
}

/* The state of sorting a tile's runs. */
typedef struct {
    gn_shading *s;
    uint32_t n_linked;
    uint32_t plain_idx, packed; /* the plain object met last, of 16 bits per pixel */
    uint32_t lit_idx;           /* the object met last that is not plain */
    object_look looks[LOOKS];
} run_sorter;

/* Links a run, or fills it in if its object is plain. */
GN_HOT static GN_NOINLINE void sort_run(run_sorter *sorter, uint32_t *first, uint32_t id, uint32_t n_px)
{
    gn_shading *s = sorter->s;
    uint32_t at = (uint32_t)(first - GN_CELLS(s->scratch));
    if (!GN_SIZE_FIRST) {
        const object_look *look = look_at(s, sorter->looks, gn_cell_tri(s->frame, id)->object_idx);
        if (look->plain != NOT_PLAIN) {
            int32_t stride = GN_K(s->frame, tile_width), x = (int32_t)at % stride, y = (int32_t)at / stride;
            GN_COUNT(runs, 1);
            GN_COUNT(filled, n_px);
            gn_runs_drop(first);
            gn_pixel_fill(s->frame, &s->rows, s->rect.x0 + x, s->rect.y0 + y, (int32_t)n_px, look->packed);
            if (look->plain == PLAIN) return;
            sorter->plain_idx = look->object_idx;
            sorter->packed = look->packed;
            return;
        }
        sorter->lit_idx = gn_cell_tri(s->frame, id)->object_idx;
    }
    gn_runs_link(s->scratch, id, at, n_px);
    sorter->n_linked++;
}

/* Fills in a short run of a plain object, and does not link it. */
GN_HOT static inline void fill_short_run(uint16_t *out, uint32_t *first, uint32_t n_px, uint32_t packed)
{
    GN_COUNT(runs, 1);
    GN_COUNT(filled, n_px);
    gn_runs_drop(first);
    do {
        *out++ = (uint16_t)packed;
        GN_KEEP(out);
    } while (--n_px);
}

/* Empty state. */
GN_HOT static void sorter_begin(run_sorter *sorter, gn_shading *s)
{
    sorter->s = s;
    sorter->n_linked = 0;
    sorter->plain_idx = sorter->lit_idx = UINT32_MAX;
    for (uint32_t i = 0; !GN_SIZE_FIRST && i < LOOKS; i++) sorter->looks[i].object_idx = UINT32_MAX;
}

/* Links the tile's runs, except those of plain objects, which it fills in. Returns the number of linked runs. */
GN_HOT static GN_NOINLINE uint32_t sort_runs(gn_shading *s, int32_t n_rows)
{
    const gn_frame *frame = s->frame;
    const gn_tri *end = gn_cell_tri(frame, 0);
    run_sorter sorter;
    uint32_t id_mask = (1U << frame->id_bits) - 1, width = (uint32_t)s->rows.width, plain_idx = UINT32_MAX,
             lit_idx = UINT32_MAX, packed = 0;
    uint32_t *cells = GN_CELLS(s->scratch), *row = cells + n_rows * GN_K(frame, tile_width), n_linked = 0;
    uint16_t *pixel = s->scratch->pixel.rgb565 + (uint32_t)n_rows * width;
    sorter_begin(&sorter, s);
    gn_runs_clear(s->scratch);
    while (row > cells) {
        row -= GN_K(frame, tile_width);
        pixel -= width;
        uint32_t before = row[-1], *last = row + width;
        row[-1] = UINT32_MAX;
        while ((last = gn_runs_last(last)) >= row) {
            uint32_t id = *last & id_mask, *first = gn_runs_first(last, id_mask), n_px = (uint32_t)(last - first) + 1;
            last = first;
            if (!GN_SIZE_FIRST && n_px < 8 && (end - id)->object_idx == plain_idx) {
                fill_short_run(pixel + (first - row), first, n_px, packed);
                continue;
            }
            if (!GN_SIZE_FIRST && (end - id)->object_idx == lit_idx) {
                gn_runs_link(s->scratch, id, (uint32_t)(first - cells), n_px);
                n_linked++;
                continue;
            }
            sort_run(&sorter, first, id, n_px);
            lit_idx = sorter.lit_idx;
            plain_idx = sorter.plain_idx;
            packed = sorter.packed;
        }
        row[-1] = before;
    }
    return sorter.n_linked + n_linked;
}

GN_HOT static void clear_background(gn_shading *s)
{
    const gn_frame *frame = s->frame;
    for (int c = 0; c < 3; c++) s->last_q20[c] = frame->scene->background_uq16[c] << 4;
    s->last_pixel = gn_pixel_pack(frame, s->last_q20);
    if (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32) {
        int32_t n = s->rows.width * (s->rect.y1 - s->rect.y0);
        for (int32_t i = 0; i < n; i++) s->scratch->pixel.raw[i] = UINT32_MAX;
        return;
    }
    /* bits after a row's last pixel are flushed with it and count when tiles are compared */
    if (GN_OTHER_FORMATS && (frame->picture.format == GN_FORMAT_GREY4 || frame->picture.format == GN_FORMAT_MONO1))
        memset(s->scratch->pixel.bytes, 0, gn_pixel_bytes(frame, s->rows.width, s->rect.y1 - s->rect.y0));
    for (int32_t y = s->rect.y0; y < s->rect.y1; y++)
        gn_pixel_fill(frame, &s->rows, s->rect.x0, y, s->rows.width, s->last_pixel);
}

GN_HOT void gn_shade_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx)
{
    shading *s = &scratch->work.shading;
    GN_ELEMENT(s);
    s->frame = frame;
    s->scratch = scratch;
    s->rect = gn_screen_rect(frame, tile_idx);
    s->rows.pixels = &scratch->pixel;
    s->rows.width = s->rect.x1 - s->rect.x0;
    s->rows.x0 = s->rect.x0;
    s->rows.y0 = s->rect.y0;
    clear_background(s);
    if (!sort_runs(s, s->rect.y1 - s->rect.y0)) return;
    s->cache.object = NULL;
    s->cache.lights = GN_PUNCTUAL_LIGHTS && GN_TILE_LIGHTS ? gn_punctual_in_tile(frame, &s->rect) : UINT64_MAX;
    for (uint32_t i = 0; i < GN_VERTEX_CACHE; i++) gn_vertex_drop(&scratch->vertex[i]);
    for (uint32_t i = frame->tile_first[tile_idx]; i < frame->tile_first[tile_idx + 1]; i++)
        shade_triangle(s, frame->tile_ref[i]);
}
