/* Shading of a screen tile. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_lattice.h"
#include "shade/gn_patch.h"
#include "shade/gn_pixel.h"
#include "shade/gn_surface.h"
#include "visible/gn_cell.h"
#include "visible/gn_runs.h"

typedef gn_shading shading;

/* The one pixel value of a surface of constant colour. */
GN_HOT static uint32_t constant_pixel(gn_shading *s)
{
    gn_corner *c = &s->lattice.corner;
    uint32_t radiance_q20[3];
    for (int i = 0; i < 3; i++) c->base_q20[i] = (int32_t)s->surface.base_q20[i];
    for (uint32_t i = 0; i < s->surface.n_lights; i++)
        c->light[i].irradiance_q24 = gn_max32(s->surface.light[i].cosine_q24[0], 0);
    gn_corner_radiance(s, c, radiance_q20);
    return gn_exact_pack(s, radiance_q20);
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

/* The shadow view shows what is left of one light whose colour is 1. */
GN_HOT static void show_one_light(gn_surface *surface, uint32_t light_idx)
{
    uint32_t slot = 0;
    while (slot < surface->n_lights && surface->light[slot].idx != light_idx) slot++;
    surface->coloured = surface->textured = surface->baked = surface->specular = 0;
    for (int c = 0; c < 3; c++) surface->base_q20[c] = 0;
    if (slot == surface->n_lights) {
        surface->n_lights = surface->n_punctual = 0;
        return;
    }
    surface->light[0] = surface->light[slot];
    surface->n_punctual = surface->light[0].state->kind != GN_LIGHT_DIRECTIONAL ? 1 : 0;
    surface->n_lights = 1;
    if (!GN_SMOOTH(surface)) surface->light[0].cosine_q24[0] = surface->light[0].cosine_q24[0] > 0 ? 1 << 24 : 0;
    for (int c = 0; c < 3; c++) surface->light[0].radiance_uq16[c] = 65536;
}

/* Raw views have no light but that of the shadow view. */
GN_HOT static GN_NOINLINE void show_raw(gn_shading *s)
{
    gn_surface *surface = &s->surface;
    if (s->frame->picture.view == GN_VIEW_SHADOW) show_one_light(surface, s->frame->picture.view_light);
    else surface->n_lights = surface->n_punctual = surface->shadowed = surface->specular = 0;
}

#if GN_INTERPOLATES
GN_HOT static inline void shade_those(gn_shading *s, int32_t n_spans)
{
    gn_lattice *l = &s->lattice;
    l->n_spans = n_spans;
    gn_lattice_shade(s);
    if (!GN_MIXES(s)) return;
    for (int32_t i = 0; i < l->n_spans; i++) gn_mix_run(s, l->span[i].x, l->span[i].y, l->span[i].n_px);
}

/* Takes the surface's runs as spans, so many at a time, and shades them. */
GN_HOT static void shade_spans(gn_shading *s, gn_run_taker *taker)
{
    gn_lattice *l = &s->lattice;
    const uint32_t stride = (uint32_t)GN_K(s->frame, tile_width);
    gn_part_begin(s); /* the views of shadows are drawn as the picture is */
    if (GN_RAW_VIEWS && s->frame->picture.format == GN_FORMAT_RAW32) show_raw(s);
    gn_run_span *span, *const end = l->span + GN_SPANS;
    int more;
    do {
        span = l->span;
        do {
            GN_COUNT(runs, 1);
            span->x = (int16_t)(s->rect.x0 + (int32_t)(taker->first % stride));
            span->y = (int16_t)(s->rect.y0 + (int32_t)(taker->first / stride));
            span->n_px = (int16_t)taker->n_px;
            more = gn_runs_take(taker, stride);
        } while (++span < end && more);
        shade_those(s, (int32_t)(span - l->span));
    } while (more);
}
#else
GN_HOT static void shade_spans(gn_shading *s, gn_run_taker *taker)
{
    (void)s, (void)taker;
}
#endif

/* The triangle's runs from the one on that is taken, of one colour or pixel by pixel. */
GN_HOT static inline void shade_runs(gn_shading *s, gn_run_taker *taker, int constant)
{
    const uint32_t stride = (uint32_t)GN_K(s->frame, tile_width);
    uint32_t packed = 0;
    if (constant) packed = constant_pixel(s);
    else {
        if (GN_RAW_VIEWS && s->frame->picture.format == GN_FORMAT_RAW32) show_raw(s);
        gn_corner_begin_pixels(&s->lattice, s->frame, &s->surface);
    }
    do {
        const int32_t x = s->rect.x0 + (int32_t)(taker->first % stride), n_px = taker->n_px,
                      y = s->rect.y0 + (int32_t)(taker->first / stride);
        GN_COUNT(runs, 1);
        if (constant) {
            GN_COUNT(filled, n_px);
            gn_pixel_fill(s->frame, &s->rows, x, y, n_px, packed);
        } else
            for (int32_t i = 0; i < n_px; i++) gn_corner_pixel(s, x + i, y);
        if (GN_MIXES(s)) gn_mix_run(s, x, y, n_px);
    } while (gn_runs_take(taker, stride));
}

/* The triangle that is k behind the one at hand in the tile's list, which is at `at`. 0: there is none. */
GN_HOT static inline uint32_t id_behind(const gn_frame *frame, uint32_t at, uint32_t end, uint32_t k)
{
    if (GN_K(frame, triangle_groups)) return at > k ? at - k : 0;
    return at + k < end ? gn_cell_id(frame, frame->tile_ref[at + k]) : 0;
}

#if GN_INTERPOLATES
/* Begins the surface that the triangle is part of, and takes the runs of others of it behind it in the tile's list that
 * are no patches. */
GN_HOT static GN_NOINLINE void join(gn_shading *s, const char *sources, uint32_t at, uint32_t end)
{
    const gn_frame *frame = s->frame;
    const uint32_t object_idx = s->tri->object_idx;
    const gn_join all = gn_join_find(frame, s->tri);
    for (uint32_t k = 1, id; all.end - all.first > 1 && (id = id_behind(frame, at, end, k)) != 0; k++) {
        s->tri = gn_cell_source(frame, sources, id);
        if (s->tri->object_idx != object_idx || s->tri->triangle_idx >= all.end) break;
        if (gn_runs_any(s->scratch, id) && !gn_patch_begin(s, id))
            gn_runs_join(frame, s->scratch, id_behind(frame, at, end, 0), id);
    }
    s->root = (gn_tri_source){(uint16_t)object_idx, (uint16_t)all.first};
    s->tri = &s->root;
    gn_surface_place(frame, s->scratch, &s->cache, &s->surface, s->tri);
    for (uint32_t k = all.first + 1; k < all.end; k++)
        gn_surface_extend(s->scratch, &s->cache, &s->surface, object_idx, k);
}
#else
GN_HOT static void join(gn_shading *s, const char *sources, uint32_t at, uint32_t end)
{
    (void)s, (void)sources, (void)at, (void)end;
}
#endif

/* The triangle at `at` of the tile's list, and those that are one surface with it. */
GN_HOT static void shade_triangle(gn_shading *s, const char *sources, uint32_t at, uint32_t end)
{
    const gn_frame *frame = s->frame;
    const uint32_t id = id_behind(frame, at, end, 0);
    const uint32_t stride = (uint32_t)GN_K(frame, tile_width);
    gn_run_taker taker;
    gn_runs_begin(&taker, s->scratch, id);
    /* others are joined before its first run is taken */
    if (GN_INTERPOLATES ? !gn_runs_any(s->scratch, id) : !gn_runs_take(&taker, stride)) return;
    s->tri = gn_cell_source(frame, sources, id);
#if GN_INTERPOLATES
    if (gn_patch_begin(s, id)) {
        if (gn_runs_take(&taker, stride)) gn_patch_draw(s, &taker);
        return;
    }
#endif
    if (gn_shades_pixels(frame)) gn_surface_place(frame, s->scratch, &s->cache, &s->surface, s->tri);
    else join(s, sources, at, end);
    gn_surface_begin(frame, &s->normals, &s->surface, s->tri);
    if (GN_INTERPOLATES) { /* with those that were joined */
        gn_runs_begin(&taker, s->scratch, id);
        if (!gn_runs_take(&taker, stride)) return; /* does not happen: it has some */
    }
    const int constant = gn_surface_is_constant(&s->surface) && frame->picture.format != GN_FORMAT_RAW32;
    if (constant || gn_shades_pixels(frame)) shade_runs(s, &taker, constant);
    else shade_spans(s, &taker);
}

/* Those of the tile, in the order of the scene. */
GN_HOT static GN_NOINLINE void shade_triangles(gn_shading *s, uint32_t tile_idx)
{
    const gn_frame *frame = s->frame;
    const char *sources = gn_cell_sources(frame, s->scratch);
    uint32_t at = frame->tile_first[tile_idx];
    if (GN_K(frame, triangle_groups)) {
        for (; at > 0; at--) shade_triangle(s, sources, at, 0);
        return;
    }
    for (const uint32_t end = frame->tile_first[tile_idx + 1]; at < end; at++) shade_triangle(s, sources, at, end);
}

/* ---- Runs -------------------------------------------------------------------------------------------------------- */

/* Links the runs of the tile's cells, or of a layer's. Returns whether there are any. */
GN_HOT static GN_NOINLINE int link_runs(gn_shading *s, int32_t n_rows)
{
    uint32_t id_mask = (1U << s->frame->id_bits) - 1, width = (uint32_t)s->rows.width, links = 0;
    uint32_t *cells = GN_CELLS(s->scratch), *row = cells + n_rows * GN_K(s->frame, tile_width);
    gn_runs_clear(s->scratch);
    while (row > cells) {
        row -= GN_K(s->frame, tile_width);
        uint32_t before = row[-1], *last = row + width;
        row[-1] = UINT32_MAX;
        while ((last = gn_runs_last(last, row)) >= row) {
            uint32_t id = *last & id_mask, *first = gn_runs_first(last, id_mask);
            gn_runs_link(s->scratch, id, first, (uint32_t)(last - first) + 1);
            links |= id;
            last = first;
        }
        row[-1] = before;
    }
    return links != 0;
}

/* ---- Layers ------------------------------------------------------------------------------------------------------ */

/* Transparent surfaces over what is opaque, the farthest layer first. Raw views do not show them. [M8] */
GN_HOT static inline void shade_layers(gn_shading *s, uint32_t tile_idx)
{
    const int32_t n_rows = s->rect.y1 - s->rect.y0;
    gn_mix_begin(s);
    for (int32_t i = gn_layers_count(s->scratch) - 1; i >= 0; i--) {
        s->rows.pixels = gn_layers_take(s->frame, s->scratch, i, n_rows);
        if (link_runs(s, n_rows)) shade_triangles(s, tile_idx);
    }
}

/* ---- Background -------------------------------------------------------------------------------------------------- */

#if GN_TILE_DRAWING
/* The colour of row y: top + (bottom - top) (2 y + 1) / 2 H, with one rounding: the difference is split into a whole
 * and a rest by 2 H, so that neither product is above 2^24. [R11] */
GN_HOT static void gradient_row(gn_shading *s, int32_t y)
{
    const gn_scene *scene = s->frame->scene;
    const int32_t halves = 2 * s->frame->picture.height, down = 2 * y + 1;
    for (int c = 0; c < 3; c++) {
        const int32_t top = (int32_t)scene->background_uq20[c],
                      change = (int32_t)scene->background_bottom_uq20[c] - top;
        const int32_t rest = change % halves * down + (change < 0 ? -halves : halves) / 2;
        s->last_q20[c] = (uint32_t)(top + change / halves * down + rest / halves);
    }
    s->last_pixel = gn_pixel_pack(s->frame, s->last_q20);
}

/* What the caller draws behind the scene. [R11] */
GN_HOT static void draw_behind(const gn_shading *s)
{
    const gn_scene *scene = s->frame->scene;
    if (scene->draw_behind)
        scene->draw_behind(scene->draw_user, s->rect.x0, s->rect.y0, s->rows.width, s->rect.y1 - s->rect.y0,
                           s->scratch->pixel.bytes);
}
#endif

/* Colour or gradient, and the caller's drawing. [R11] */
GN_HOT static void clear_background(gn_shading *s)
{
    const gn_frame *frame = s->frame;
    for (int c = 0; c < 3; c++) s->last_q20[c] = frame->scene->background_uq20[c];
    s->last_pixel = gn_pixel_pack(frame, s->last_q20);
    if (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32) {
        int32_t n = s->rows.width * (s->rect.y1 - s->rect.y0);
        for (int32_t i = 0; i < n; i++) s->scratch->pixel.raw[i] = UINT32_MAX;
        return;
    }
    /* bits after a row's last pixel are flushed with it and count when tiles are compared */
    if (GN_OTHER_FORMATS && (frame->picture.format == GN_FORMAT_GREY4 || frame->picture.format == GN_FORMAT_MONO1))
        memset(s->scratch->pixel.bytes, 0, gn_pixel_bytes(frame, s->rows.width, s->rect.y1 - s->rect.y0));
    for (int32_t y = s->rect.y0; y < s->rect.y1; y++) {
#if GN_TILE_DRAWING
        if (frame->scene->background_gradient) gradient_row(s, y);
#endif
        gn_pixel_fill(frame, &s->rows, s->rect.x0, y, s->rows.width, s->last_pixel);
    }
#if GN_TILE_DRAWING
    draw_behind(s);
#endif
}

GN_HOT void gn_shade_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx)
{
    shading *s = &scratch->work.shading;
    s->frame = frame;
    s->scratch = scratch;
#if GN_CHANGES
    memset(&scratch->squares, 0, sizeof scratch->squares);
#endif
    s->rect = gn_screen_rect(frame, tile_idx);
    s->rows.pixels = &scratch->pixel;
    s->rows.width = s->rect.x1 - s->rect.x0;
    s->rows.x0 = s->rect.x0;
    s->rows.y0 = s->rect.y0;
    clear_background(s);
    const int coloured = !(GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32);
    const int links = link_runs(s, s->rect.y1 - s->rect.y0);
    if (!links && !(GN_LAYERS(frame) && coloured && gn_layers_count(scratch))) return;
    s->cache.object = NULL;
    s->normals.object = NULL;
#if GN_INTERPOLATES
    gn_patch_begin_tile(s);
    gn_lattice_begin_tile(s);
#endif
    for (uint32_t i = 0; i < GN_VERTEX_CACHE; i++) gn_vertex_drop(&scratch->vertex[i]);
    if (links) shade_triangles(s, tile_idx);
    if (GN_LAYERS(frame) && coloured) shade_layers(s, tile_idx);
}

/* ---- Colours of pixels ------------------------------------------------------------------------------------------- */

GN_HOT uint32_t gn_exact_pack(gn_shading *s, const uint32_t q20[3])
{
    uint32_t *last = s->last_q20;
    if (q20[0] != last[0] || q20[1] != last[1] || q20[2] != last[2]) {
        last[0] = q20[0];
        last[1] = q20[1];
        last[2] = q20[2];
        GN_COUNT(packed, 1);
        s->last_pixel = gn_pixel_pack(s->frame, q20);
    }
    return s->last_pixel;
}

/* ---- Pixels between two colours ---------------------------------------------------------------------------------- */

#if GN_INTERPOLATES
#if GN_INTERPOLATES && GN_SHADOWS

GN_HOT void gn_levels_use(gn_lattice *lattice, const int32_t dark_q24[3], const int32_t more_q24[3])
{
    gn_levels *l = &lattice->levels;
    uint32_t differs = 0;
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        differs |= (uint32_t)(l->two_q24[0][c] ^ dark_q24[c]) | (uint32_t)(l->two_q24[1][c] ^ more_q24[c]);
        l->two_q24[0][c] = dark_q24[c];
        l->two_q24[1][c] = more_q24[c];
    }
    if (differs) l->known[0] = l->known[1] = l->known[2] = 0;
}

GN_HOT GN_NOINLINE uint32_t gn_levels_find(gn_shading *s, uint32_t level)
{
    gn_levels *l = &s->lattice.levels;
    uint32_t q20[3];
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        int32_t dark = l->two_q24[0][c], more = (int32_t)((int64_t)l->two_q24[1][c] * (int32_t)level >> 6);
        q20[c] = (uint32_t)gn_max32(dark + more, 0) >> 4;
    }
    l->known[level >> 5] |= 1U << (level & 31);
    l->pixel[level] = gn_exact_pack(s, q20);
    return l->pixel[level];
}

#endif
#endif
