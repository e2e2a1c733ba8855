/* Parts of one or two colours. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_exact.h"
#include "shade/gn_lattice_window.h"
#include "shade/gn_levels.h"
#include "shade/gn_part.h"
#include "shade/gn_pixel.h"
#include "shade/gn_shadow.h"

#if GN_INTERPOLATES

enum { CHUNK_LOG2 = 4, CHUNK = 1 << CHUNK_LOG2 };

/* What falls on the part. */
typedef struct {
    uint32_t dark_q20[3], more_q20[3]; /* without and with the light whose shadow has an edge */
    const gn_window *window;           /* of that light; NULL: none */
    uint32_t slot;
    int32_t offset_q16[3]; /* of receivers in its view */
} part_look;

GN_HOT void gn_part_begin(gn_shading *s)
{
    const gn_surface *surface = &s->surface;
    int varies = GN_SMOOTH(surface) | GN_COLOURED(surface) | surface->textured | surface->baked | surface->masked |
                 surface->specular | surface->n_punctual;
    s->lattice.uniform = !varies && s->frame->picture.format != GN_FORMAT_RAW32;
}

/* ---- Lights ------------------------------------------------------------------------------------------------------ */

#if GN_SHADOWS
/* What a light's window says of the whole part. */
GN_HOT static int window_of_part(gn_shading *s, uint32_t slot, const gn_window **window)
{
    gn_lattice *l = &s->lattice;
    const gn_light_state *light = s->surface.light[slot].state;
    int cascaded = !s->frame->view[light->view_idx].border_lit;
    if (cascaded && l->cascade == GN_CASCADE_NONE) return GN_WINDOW_LIT;
    gn_window *w = gn_lattice_window(l, s->frame, &s->surface, slot, cascaded ? (uint32_t)l->cascade : 0, l->x, NULL);
    *window = NULL;
    if (!w || !w->w) return GN_WINDOW_MIXED;
    l->part_end = gn_min32(l->part_end, w->until_x);
    *window = w;
    return !w->any ? GN_WINDOW_LIT : w->all == UINT32_MAX ? GN_WINDOW_DARK : GN_WINDOW_MIXED;
}
#else
GN_HOT static int window_of_part(gn_shading *s, uint32_t slot, const gn_window **window)
{
    (void)s, (void)slot, (void)window;
    return GN_WINDOW_LIT;
}
#endif

/* Returns 0 if the shadows of several lights have edges in the part, or one without a window. */
GN_HOT static int find_lights(gn_shading *s, part_look *look)
{
    const gn_surface *surface = &s->surface;
    look->window = NULL;
    for (int c = 0; c < 3; c++) {
        look->dark_q20[c] = surface->base_q20[c];
        look->more_q20[c] = 0;
    }
    for (uint32_t i = 0; i < surface->n_lights; i++) {
        const gn_surface_light *light = &surface->light[i];
        uint32_t share = 65536;
        int said = GN_WINDOW_LIT;
        const gn_window *window = NULL;
        int32_t e = gn_max32(light->cosine_q24[0], 0);
        if (surface->shadowed && gn_shadow_is_realtime(light->state, 65536)) said = window_of_part(s, i, &window);
        if (said == GN_WINDOW_MIXED && (!window || look->window)) return 0;
        if (said != GN_WINDOW_LIT) share = 65536 - light->state->strength_uq16;
        for (int c = 0; c < 3; c++) {
            uint32_t all = (uint32_t)gn_corner_times(light->radiance_uq16[c], e) >> 4,
                     dark = share == 65536 ? all : gn_mul_uq16(all, share);
            look->dark_q20[c] += dark;
            if (said == GN_WINDOW_MIXED) look->more_q20[c] = all - dark;
        }
        if (said != GN_WINDOW_MIXED) continue;
        look->window = window;
        look->slot = i;
    }
    return 1;
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

/* n pixels in a row, between two places. */
GN_HOT static void mixed_chunk(gn_shading *s, const part_look *look, int32_t x, int32_t y, int32_t n,
                               gn_receiver_step *from, gn_receiver_step *step)
{
    uint32_t attenuation[CHUNK];
    GN_COUNT(edge_lookups, n);
    from->depth_q31 = gn_window_depth(look->window, from->u_q16, from->v_q16);
    step->depth_q31 = gn_window_depth_step(look->window, step->u_q16, step->v_q16);
    if (gn_window_row(s->frame, look->window, from, step, n, attenuation)) store_row(s, x, y, n, attenuation);
    else
        for (int32_t i = 0; i < n; i++) gn_exact_pixel(s, x + i, y);
}

/* What the window says of pixels between two places. */
GN_HOT static int judge(const gn_window *window, const int32_t a_q16[2], const int32_t b_q16[2])
{
    int32_t first[2], n[2];
    for (int i = 0; i < 2; i++)
        gn_window_reads(window->view, gn_min32(a_q16[i], b_q16[i]) - 16, gn_max32(a_q16[i], b_q16[i]) + 1040, &first[i],
                        &n[i]);
    if (!gn_window_covers(window, first[0], first[1], n[0], n[1])) return GN_WINDOW_MIXED;
    return gn_window_says(window, first[0], first[1], n[0], n[1]);
}

/* Pixels of one row, in chunks that are in or out of the shadow, or between places at their ends. */
GN_HOT static void mixed_span(gn_shading *s, const part_look *look, int32_t x, int32_t y, int32_t end, uint32_t lit,
                              uint32_t dark)
{
    const gn_light_view *view = look->window->view;
    int32_t at[2], next[2];
    gn_corner_uv(&s->lattice, s->frame, &s->surface, view, x, y, look->offset_q16, at);
    for (int32_t n; x < end; x += n) {
        n = gn_min32(end - x, CHUNK);
        int32_t ahead = x + n < end ? n : n - 1;
        gn_receiver_step from = {at[0], at[1], 0}, step = {0, 0, 0};
        next[0] = at[0];
        next[1] = at[1];
        if (ahead) gn_corner_uv(&s->lattice, s->frame, &s->surface, view, x + ahead, y, look->offset_q16, next);
        int said = judge(look->window, at, next);
        if (said == GN_WINDOW_MIXED) {
            if (ahead) {
                step.u_q16 = gn_step_of(at[0], next[0], ahead);
                step.v_q16 = gn_step_of(at[1], next[1], ahead);
            }
            mixed_chunk(s, look, x, y, n, &from, &step);
        } else gn_pixel_fill(s->frame, &s->rows, x, y, n, said == GN_WINDOW_LIT ? lit : dark);
        at[0] = next[0];
        at[1] = next[1];
    }
}
#else
GN_HOT static void mixed_span(gn_shading *s, const part_look *look, int32_t x, int32_t y, int32_t end, uint32_t lit,
                              uint32_t dark)
{
    (void)s, (void)look, (void)x, (void)y, (void)end, (void)lit, (void)dark;
}
#endif

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

GN_HOT static uint32_t pack_sum(gn_shading *s, const part_look *look, int with_more)
{
    uint32_t q20[3];
    for (int c = 0; c < 3; c++) q20[c] = look->dark_q20[c] + (with_more ? look->more_q20[c] : 0);
    return gn_exact_pack(s, q20);
}

/* Sets what rows of two colours need. */
GN_HOT static void begin_rows(gn_shading *s, part_look *look)
{
    int32_t dark[3], more[3];
    for (int c = 0; c < 3; c++) {
        dark[c] = (int32_t)(look->dark_q20[c] > 1U << 23 ? 1U << 23 : look->dark_q20[c]) * 16;
        more[c] = (int32_t)look->more_q20[c] * 16;
    }
    gn_levels_use(&s->lattice, dark, more);
#if GN_SHADOWS
    gn_sample_offset(s->frame, &s->surface, look->slot, look->window->view, s->surface.normal_q30[0], look->offset_q16);
#endif
}

GN_HOT int gn_part_shade(gn_shading *s)
{
    gn_lattice *l = &s->lattice;
    part_look look;
    l->part_end = gn_min32(l->x_end, l->x + GN_PART_WIDTH);
    if (!l->uniform || (s->surface.shadowed && l->cascade < 0) || !find_lights(s, &look)) {
        l->part_end = gn_min32(l->x_end, l->x + GN_PART_WIDTH);
        return 0;
    }
    uint32_t dark = pack_sum(s, &look, 0), lit = dark;
    GN_COUNT(parts, 1);
    if (look.window) {
        lit = pack_sum(s, &look, 1);
        begin_rows(s, &look);
    }
    for (int32_t i = 0; i < l->n_spans; i++) {
        const gn_run_span *span = &l->span[i];
        int32_t x = gn_max32(span->x, l->x), end = gn_min32(span->x + span->n_px, l->part_end);
        if (span->y < l->y || span->y >= l->y + l->n_rows || x >= end) continue;
        if (look.window) mixed_span(s, &look, x, span->y, end, lit, dark);
        else gn_pixel_fill(s->frame, &s->rows, x, span->y, end - x, lit);
    }
    return 1;
}

#endif
