/* Parts of one or two colours. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_corner.h"
#include "shade/gn_lattice.h"
#include "shade/gn_pixel.h"
#include "shade/gn_surface.h"

#if GN_INTERPOLATES

/* ---- Rows of a part's pixels ---------------------------------------------------------------------------------------
 */

#if GN_SHADOWS
/* Where a row of pixels is seen: between two of them. */
typedef struct {
    int32_t at[2], last[2]; /* u, v */
    int32_t z_q16, last_z_q16;
} row_ends;

/* Whether perspective bends a row by more than places may be off: NUMERICS 4.12, what is between corners. */
GN_HOT static inline int bends(const gn_frame *frame, const row_ends *row)
{
    const uint32_t u = gn_abs32(row->last[0] - row->at[0]), v = gn_abs32(row->last[1] - row->at[1]),
                   dz = gn_abs32(row->last_z_q16 - row->z_q16);
    const uint64_t least = (uint32_t)gn_min32(row->z_q16, row->last_z_q16);
    if (GN_FLAT_Q16(frame)) return 0;
    return (uint64_t)(u > v ? u : v) * dz > least << (18 - gn_cell_place_log2(frame));
}

/* The first place of a row. */
GN_HOT static inline void begin_row(const gn_shading *s, const gn_part_view *view, int32_t x, int32_t y, row_ends *row)
{
    row->last_z_q16 = gn_corner_uv(&s->lattice, s->frame, &s->surface, view->view, x, y, view->offset_q16, row->last);
}

/* The next pixels of a row, which begin where the last ones ended, up to `end`: so few that places are linear between
 * them and the place behind them. Returns how many; 1, without a place that is known, where the plane is not seen. */
GN_HOT static inline int32_t next_places(const gn_shading *s, const gn_part_view *view, int32_t x, int32_t y,
                                         int32_t end, row_ends *row)
{
    int32_t n = end - x;
    row->at[0] = row->last[0];
    row->at[1] = row->last[1];
    row->z_q16 = row->last_z_q16;
    if (!row->z_q16) n = 1;
    for (;; n = (n + 1) >> 1) {
        row->last_z_q16 =
            gn_corner_uv(&s->lattice, s->frame, &s->surface, view->view, x + n, y, view->offset_q16, row->last);
        if (n == 1) return n;
        if (row->last_z_q16 && !bends(s->frame, row)) return n;
    }
}

/* Attenuations of n pixels in a row where a cascade blends into the next: `here` becomes what is seen. */
GN_HOT static inline void blend_row(const gn_frame *frame, int32_t x, int32_t y, int32_t n, int32_t fade_uq16,
                                    int32_t step, const uint32_t *next, uint32_t *here)
{
    const int dithers = frame->scene->shadow.blend == GN_BLEND_DITHER;
    for (int32_t i = 0; i < n; i++, fade_uq16 += step) {
        if (dithers) here[i] = (uint32_t)fade_uq16 < gn_noise_uq16(x + i, y) ? next[i] : here[i];
        else here[i] += (uint32_t)((int64_t)((int32_t)next[i] - (int32_t)here[i]) * (65536 - fade_uq16) >> 16);
    }
}

/* Whether a ramp begins or ends between two places, which are too far apart to take it for a line. */
GN_HOT static inline int kinks(uint32_t a_uq16, uint32_t b_uq16)
{
    const uint32_t least = a_uq16 < b_uq16 ? a_uq16 : b_uq16, most = a_uq16 ^ b_uq16 ^ least;
    return (!least || most == 65536) && most - least > 65536 >> 4;
}

#endif

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

GN_HOT void gn_part_begin(gn_shading *s)
{
    const gn_surface *surface = &s->surface;
    int varies = GN_SMOOTH(surface) | GN_COLOURED(surface) | surface->textured | surface->baked | surface->masked |
                 surface->specular | surface->n_punctual;
    int32_t n_realtime = 0; /* rows have two colours */
    for (uint32_t i = 0; !varies && surface->shadowed && i < surface->n_lights; i++)
        n_realtime += gn_shadow_is_realtime(surface->light[i].state, 65536);
    s->lattice.uniform = !varies && n_realtime <= 1;
}

/* ---- Lights ------------------------------------------------------------------------------------------------------ */

#if GN_SHADOWS
/* Views that the part may look into, a bit each. */
GN_HOT static uint32_t views_of_part(const gn_lattice *l, int cascaded)
{
    return cascaded ? l->views & (GN_VIEWS_FADE - 1U) : 1;
}

/* What a light's windows say of the whole part, and each of them. */
GN_HOT static GN_NOINLINE int windows_of_part(gn_shading *s, uint32_t slot, gn_part_view *view)
{
    gn_lattice *l = &s->lattice;
    const gn_light_view *first = &s->frame->view[s->surface.light[slot].state->view_idx];
    int all = -1;
    uint32_t views = views_of_part(l, !first->border_lit);
    for (uint32_t i = 0; i < 4; i++) {
        int said = GN_WINDOW_MIXED;
        view[i] = (gn_part_view){first + i, NULL, GN_WINDOW_MIXED, {0, 0, 0}};
        if (!(views >> i & 1U)) continue;
        gn_window *w = gn_lattice_window(l, s->frame, &s->surface, slot, i, l->part_x, 0);
        if (w) l->part_end = gn_min32(l->part_end, w->until_x);
        if (w) l->part_bottom = gn_min32(l->part_bottom, w->until_y);
        if (w && w->w) { said = !w->any ? GN_WINDOW_LIT : w->all == UINT32_MAX ? GN_WINDOW_DARK : GN_WINDOW_MIXED; }
        view[i].window = w;
        view[i].said = said;
        all = all >= 0 && all != said ? GN_WINDOW_MIXED : said;
    }
    if (all < 0) return GN_WINDOW_LIT;
    return all == GN_WINDOW_DARK && l->cascade < 0 ? GN_WINDOW_MIXED : all; /* it may fade */
}

/* Sets what is to be known of the light whose shadow has an edge in the part. */
GN_HOT static void begin_edge(gn_shading *s, uint32_t slot, gn_part *part)
{
    const gn_light_view *first = &s->frame->view[s->surface.light[slot].state->view_idx];
    part->mixed = 1;
    part->slot = (uint8_t)slot;
    part->cascaded = !first->border_lit;
    for (uint32_t i = 0; i < 4; i++)
        if (part->view[i].window)
            gn_corner_offset(s->frame, &s->surface, slot, first + i, s->surface.normal_q30[0],
                             part->view[i].offset_q16);
}
#else
GN_HOT static int windows_of_part(gn_shading *s, uint32_t slot, gn_part_view *view)
{
    (void)s, (void)slot, (void)view;
    return GN_WINDOW_LIT;
}

GN_HOT static void begin_edge(gn_shading *s, uint32_t slot, gn_part *part)
{
    (void)s, (void)slot, (void)part;
}
#endif

GN_HOT static GN_NOINLINE void find_lights(gn_shading *s, gn_part *part)
{
    const gn_surface *surface = &s->surface;
    part->mixed = 0;
    for (int c = 0; c < 3; c++) {
        part->dark_q20[c] = surface->base_q20[c];
        part->more_q20[c] = 0;
    }
    for (uint32_t i = 0; i < surface->n_lights; i++) {
        const gn_surface_light *light = &surface->light[i];
        uint32_t share = 65536;
        int said = GN_WINDOW_LIT;
        int32_t e = gn_max32(light->cosine_q24[0], 0);
        if (surface->shadowed && gn_shadow_is_realtime(light->state, 65536)) said = windows_of_part(s, i, part->view);
        if (said != GN_WINDOW_LIT) share = 65536 - light->state->strength_uq16;
        for (int c = 0; c < 3; c++) {
            uint32_t all = (uint32_t)gn_corner_times(light->radiance_uq16[c], e) >> 4,
                     dark = share == 65536 ? all : gn_mul_uq16(all, share);
            part->dark_q20[c] += dark;
            if (said == GN_WINDOW_MIXED) part->more_q20[c] = all - dark;
        }
        if (said == GN_WINDOW_MIXED) begin_edge(s, i, part);
    }
}

/* ---- Rows of two colours ----------------------------------------------------------------------------------------- */

#if GN_SHADOWS
GN_HOT static void store_row(gn_shading *s, int32_t x, int32_t y, int32_t n, const uint32_t *attenuation)
{
    if (s->frame->picture.format == GN_FORMAT_RGB565) {
        uint16_t *out = s->rows.pixels->rgb565 + (y - s->rows.y0) * s->rows.width + x - s->rows.x0;
        for (const uint32_t *end = attenuation + n; attenuation < end;)
            *out++ = (uint16_t)gn_levels_pixel(s, *attenuation++);
        return;
    }
    for (int32_t i = 0; i < n; i++) gn_pixel_store(s->frame, &s->rows, x + i, y, gn_levels_pixel(s, attenuation[i]));
}

/* Attenuations of n of a row's pixels, `skip` behind its place, which has n_all to the place behind them: sets them
 * where what is known of all of them is GN_WINDOW_MIXED. *missed: a bit for each of which nothing can be told. */
GN_HOT static inline int attenuations(const gn_shading *s, const gn_part_view *view, const row_ends *row, int32_t n_all,
                                      int32_t skip, int32_t n, uint32_t *out, uint32_t *missed)
{
    *missed = 0;
    if (view->said != GN_WINDOW_MIXED) return view->said;
    *missed = (1U << n) - 1;
    if (!view->window || !row->z_q16 ||
        (gn_abs32(row->at[0]) | gn_abs32(row->at[1]) | gn_abs32(row->last[0]) | gn_abs32(row->last[1])) >> 27)
        return GN_WINDOW_MISSED;
    gn_receiver_step from = {row->at[0], row->at[1], 0}, step = {0, 0, 0};
    if (n_all > 1) {
        step.u_q16 = gn_step_of(row->at[0], row->last[0], n_all);
        step.v_q16 = gn_step_of(row->at[1], row->last[1], n_all);
        gn_receiver_advance(&from, &step, skip);
    }
    const int said = gn_lattice_row(s->frame, view->window, &from, &step, n, skip, out, missed);
    if (said == GN_WINDOW_MIXED) GN_COUNT(edge_lookups, n);
    return said;
}

/* Attenuations of a row in one view, n from x on, of those before `end` from `first` on; `row` begins at x. Returns
 * what is known of all of them. part.missed: more bits of those of which nothing can be told, and that are lit so far.
 */
GN_HOT static GN_NOINLINE int attenuations_of_row(gn_shading *s, const gn_part_view *view, int32_t x, int32_t y,
                                                  int32_t n, int32_t first, int32_t end, row_ends *row, uint32_t *out)
{
    const int32_t to = x + n, from = first;
    int all = -1;
    for (; first < end; x += n) {
        n = view->said == GN_WINDOW_MIXED ? next_places(s, view, x, y, to, row) : to - x;
        if (first >= x + n) continue;
        const int32_t n_seen = gn_min32(end, x + n) - first;
        uint32_t missed;
        int said = attenuations(s, view, row, n, first - x, n_seen, out, &missed);
        s->lattice.from.part.missed |= missed << (first - from);
        gn_attenuations_set(out, n_seen, said);
        if (missed) said = GN_WINDOW_MIXED;
        all = all >= 0 && all != said ? GN_WINDOW_MIXED : said;
        first += n_seen;
        out += n_seen;
    }
    return all;
}

/* Shades those of a row from x on of which nothing could be told, each for itself. */
GN_HOT static void shade_missed(gn_shading *s, int32_t x, int32_t y)
{
    for (uint32_t bits = s->lattice.from.part.missed; bits; bits >>= 1, x++)
        if (bits & 1U) gn_corner_pixel(s, x, y);
}

/* Pixels x .. end - 1 of one row in a view, of those of a chunk from `at` on. */
GN_HOT static inline void mixed_chunk(gn_shading *s, const gn_part_view *view, row_ends *row, int32_t at, int32_t x,
                                      int32_t y, int32_t end)
{
    gn_part *part = &s->lattice.from.part;
    part->missed = 0;
    const int said = attenuations_of_row(s, view, at, y, GN_CHUNK, x, end, row, part->attenuation[0]);
    if (said == GN_WINDOW_MIXED) store_row(s, x, y, end - x, part->attenuation[0]);
    else gn_pixel_fill(s->frame, &s->rows, x, y, end - x, said == GN_WINDOW_LIT ? part->lit : part->dark);
    shade_missed(s, x, y);
}

/* Chunk by chunk. */
GN_HOT static GN_NOINLINE void mixed_span(gn_shading *s, const gn_part_view *view, int32_t x, int32_t y, int32_t end)
{
    row_ends row;
    int32_t at = x & -GN_CHUNK;
    begin_row(s, view, at, y, &row);
    for (; x < end; at += GN_CHUNK, x = at) mixed_chunk(s, view, &row, at, x, y, gn_min32(end, at + GN_CHUNK));
}

GN_HOT static GN_NOINLINE gn_cascade_point cascade_at(const gn_shading *s, int32_t x, int32_t y)
{
    gn_cascade_point at;
    gn_cascade_at(s->frame, x, y, gn_corner_depth(&s->lattice, s->frame, &s->surface, x, y), &at);
    return at;
}

/* attenuations_of_row() with a row of its own. */
GN_HOT static inline int attenuations_in(gn_shading *s, const gn_part_view *view, int32_t x, int32_t y, int32_t n,
                                         int32_t first, int32_t end, uint32_t *out)
{
    row_ends row;
    begin_row(s, view, x, y, &row);
    return attenuations_of_row(s, view, x, y, n, first, end, &row, out);
}

/* A row's pixels where shadows fade, or cascades blend, n from x on, of which the visible ones are those from `first`
 * to `end`: shares are linear along them. */
GN_HOT static GN_NOINLINE void fading_pixels(gn_shading *s, int32_t x, int32_t y, int32_t n, int32_t first, int32_t end,
                                             const gn_cascade_point *a, const gn_cascade_point *b)
{
    gn_part *part = &s->lattice.from.part;
    uint32_t *here = part->attenuation[0], *next = part->attenuation[1];
    int blends = part->cascaded && (a->fade_uq16 & b->fade_uq16) != 65536 && GN_BLENDED_CASCADES &&
                 s->frame->scene->shadow.blend != GN_BLEND_HARD && a->cascade != GN_LAST_CASCADE(s->frame);
    if (!a->g_uq16 && (n == 1 || !b->g_uq16)) { /* of no cascade, too */
        gn_pixel_fill(s->frame, &s->rows, first, y, end - first, part->lit);
        return;
    }
    part->missed = 0;
    int said = attenuations_in(s, &part->view[part->cascaded ? a->cascade : 0], x, y, n, first, end, here),
        there = said;
    if (blends) there = attenuations_in(s, &part->view[s->frame->cascade[a->cascade].next], x, y, n, first, end, next);
    if (said == there && said == GN_WINDOW_LIT) {
        gn_pixel_fill(s->frame, &s->rows, first, y, end - first, part->lit);
        return;
    }
    int32_t fade = (int32_t)a->fade_uq16, g = (int32_t)a->g_uq16, fade_step = 0, g_step = 0;
    if (n > 1) {
        fade_step = gn_step_of(fade, (int32_t)b->fade_uq16, n);
        g_step = gn_step_of(g, (int32_t)b->g_uq16, n);
    }
    fade += (first - x) * fade_step;
    g += (first - x) * g_step;
    n = end - first;
    if (blends) blend_row(s->frame, first, y, n, fade, fade_step, next, here);
    for (int32_t i = 0; i < n; i++, g += g_step) here[i] = 65536 - gn_mul_uq16(65536 - here[i], (uint32_t)g);
    store_row(s, first, y, n, here);
    shade_missed(s, first, y);
}

GN_HOT static GN_NOINLINE void fading_span(gn_shading *s, int32_t x, int32_t y, int32_t end)
{
    int32_t at = x & -GN_CHUNK;
    gn_cascade_point a = cascade_at(s, at, y), b;
    for (int32_t n; x < end; at += n, a = b) {
        n = GN_CHUNK - (at & (GN_CHUNK - 1));
        for (;; n >>= 1) { /* up to the border of two cascades, or where a ramp begins or ends */
            b = cascade_at(s, at + n, y);
            if (n == 1 || !((s->lattice.from.part.cascaded && a.cascade != b.cascade) ||
                            kinks(a.fade_uq16, b.fade_uq16) || kinks(a.g_uq16, b.g_uq16)))
                break;
        }
        const int32_t to = gn_min32(end, at + n);
        if (x < to) fading_pixels(s, at, y, n, x, to, &a, &b);
        x = gn_max32(x, to);
    }
}

GN_HOT static void shade_span(gn_shading *s, int32_t x, int32_t y, int32_t end)
{
    const gn_part *part = &s->lattice.from.part;
    if (s->lattice.cascade < 0) fading_span(s, x, y, end);
    else mixed_span(s, &part->view[part->cascaded ? s->lattice.cascade : 0], x, y, end);
}
#else
GN_HOT static void shade_span(gn_shading *s, int32_t x, int32_t y, int32_t end)
{
    (void)s, (void)x, (void)y, (void)end;
}
#endif

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

GN_HOT static GN_NOINLINE uint32_t pack_sum(gn_shading *s, const gn_part *part, int with_more)
{
    uint32_t q20[3];
    for (int c = 0; c < 3; c++) q20[c] = part->dark_q20[c] + (with_more ? part->more_q20[c] : 0);
    return gn_exact_pack(s, q20);
}

#if GN_SHADOWS
/* Sets what rows of two colours need. */
GN_HOT static GN_NOINLINE void begin_rows(gn_shading *s, const gn_part *part)
{
    int32_t dark[3], more[3];
    for (int c = 0; c < 3; c++) {
        dark[c] = (int32_t)(part->dark_q20[c] > 1U << 23 ? 1U << 23 : part->dark_q20[c]) * 16;
        more[c] = (int32_t)part->more_q20[c] * 16;
    }
    gn_levels_use(&s->lattice, dark, more);
}

#else
GN_HOT static void begin_rows(gn_shading *s, const gn_part *part)
{
    (void)s, (void)part;
}

#endif

/* The part's rows. */
GN_HOT static void shade_rows(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    gn_part *part = &l->from.part;
    find_lights(s, part);
    part->dark = part->lit = pack_sum(s, part, 0);
    GN_COUNT(parts, 1);
    if (part->mixed) {
        part->lit = pack_sum(s, part, 1);
        begin_rows(s, part);
    }
    for (int32_t i = 0; i < l->n_spans; i++) {
        const gn_run_span *span = &l->span[i];
        int32_t x = gn_max32(span->x, l->part_x), end = gn_min32(span->x + span->n_px, l->part_end);
        if (span->y < l->part_y || span->y >= l->part_bottom || x >= end) continue;
        if (part->mixed) shade_span(s, x, span->y, end);
        else gn_pixel_fill(s->frame, &s->rows, x, span->y, end - x, part->lit);
    }
}

/* Row by row of parts, as low as the windows of the first one are. */
GN_HOT void gn_part_shade(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    for (l->part_y = l->seen.y0; l->part_y < l->seen.y1; l->part_y = l->part_bottom) {
        l->part_bottom = l->seen.y1;
        for (l->part_x = l->seen.x0; l->part_x < l->seen.x1; l->part_x = l->part_end) {
            l->part_end = l->seen.x1;
            shade_rows(s);
        }
    }
}

#endif
