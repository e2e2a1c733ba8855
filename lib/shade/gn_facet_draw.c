/* Pixels of small triangles. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_corner.h"
#include "shade/gn_exact.h"
#include "shade/gn_facet_draw.h"
#include "shade/gn_lattice_cell.h"
#include "shade/gn_levels.h"
#include "shade/gn_pixel.h"

#if GN_INTERPOLATES

/* A vertex colour's channel: 65536 is 1. */
GN_HOT static inline int32_t tint_q16(const gn_surface *s, int channel, int vertex)
{
    const int i = GN_ATTRIBUTE_RGB + channel;
    return s->attribute_q16[0][i] + (vertex ? s->attribute_q16[vertex][i] : 0);
}

/* A value over the length of the interpolated normal. */
GN_HOT static inline int32_t over_length(int32_t v, int32_t per_length_q30)
{
    return 4 * gn_mul_high(v, per_length_q30);
}

/* What is left of a light's channel; per_length_q30: 1 / |n|, or 0. */
GN_HOT static inline int32_t light_of(int32_t v_q24, uint32_t share_uq16, int32_t per_length_q30)
{
    int32_t v = gn_max32(v_q24, 0);
    if (per_length_q30) v = gn_min32(over_length(v, per_length_q30), 1 << 27);
    return share_uq16 == 65536 ? v : (int32_t)((int64_t)v * (int32_t)share_uq16 >> 16);
}

/* What a spot's rim leaves of that. */
GN_HOT static inline uint32_t rim_share(int32_t rim_q20, uint32_t share_uq16)
{
    uint32_t rim_uq15 = (uint32_t)gn_max32(0, gn_min32(rim_q20, 1 << 20)) >> 5;
    return gn_mul_uq16(share_uq16, rim_uq15 * rim_uq15 >> 14);
}

/* Adds a light that pixels ask for to n pixels from (x, y) of the picture on. */
GN_HOT static void add_pixel_light(const gn_facet *f, const gn_facet_light *light, int32_t x, int32_t y, int32_t n)
{
    gn_lattice *l = &f->s->lattice;
    const gn_slope *slope = light->colour_q24;
    const uint32_t *attenuation = l->row.attenuation[0], *per_length = light->turns ? l->row.attenuation[1] : NULL;
    const uint32_t least = light->dark_uq16, less = light->lit_uq16 - light->dark_uq16;
    const int32_t right = x - f->screen.x0, down = y - f->screen.y0, dr = slope[0].dx, dg = slope[1].dx,
                  db = slope[2].dx;
    int32_t r = gn_facet_at(&slope[0], right, down), g = gn_facet_at(&slope[1], right, down),
            b = gn_facet_at(&slope[2], right, down), (*node)[3] = l->by.node[0];
    uint32_t share = light->lit_uq16;
    if (light->has_edge) gn_facet_attenuation(f->s, &f->screen, &light->edge, x, y, n, l->row.attenuation[0]);
    int32_t rim = light->has_rim ? gn_facet_at(&light->rim_q20, right, down) : 0;
    for (int32_t(*end)[3] = node + n; node < end; node++, r += dr, g += dg, b += db) {
        if (light->has_edge) share = least + gn_mul_uq16(less, *attenuation++);
        int32_t per = per_length ? (int32_t)*per_length++ : 0;
        uint32_t left = share;
        if (light->has_rim) {
            left = rim_share(rim, share);
            rim += light->rim_q20.dx;
        }
        if (!left) continue;
        (*node)[0] += light_of(r, left, per);
        (*node)[1] += light_of(g, left, per); /* 2^27 each, and as much to begin with */
        (*node)[2] += light_of(b, left, per);
    }
}

/* Nodes of n pixels without light that they ask for; per_length_q30: their 1 / |n|, or NULL. */
GN_HOT static void begin_nodes(const gn_facet *f, const gn_facet_look *look, int32_t right, int32_t down, int32_t n,
                               const uint32_t *per_length_q30)
{
    const gn_slope *slope = look->colour_q24;
    int32_t r = gn_facet_at(&slope[0], right, down), g = gn_facet_at(&slope[1], right, down),
            b = gn_facet_at(&slope[2], right, down);
    const int32_t dr = slope[0].dx, dg = slope[1].dx, db = slope[2].dx, base_r = f->base_q24[0],
                  base_g = f->base_q24[1], base_b = f->base_q24[2];
    int32_t(*node)[3] = f->s->lattice.by.node[0];
    for (int32_t(*end)[3] = node + n; node < end; node++, r += dr, g += dg, b += db) {
        int32_t per = per_length_q30 ? (int32_t)*per_length_q30++ : 0;
        (*node)[0] = base_r + (per ? over_length(r, per) : r);
        (*node)[1] = base_g + (per ? over_length(g, per) : g);
        (*node)[2] = base_b + (per ? over_length(b, per) : b);
    }
}

/* The colours of n pixels from (x, y) of the picture on, a node each. */
GN_HOT static inline void light_pixels(const gn_facet *f, const gn_facet_look *look, int32_t x, int32_t y, int32_t n)
{
    gn_lattice *l = &f->s->lattice;
    int32_t right = x - f->screen.x0, down = y - f->screen.y0;
    if (f->turns) {
        gn_facet_lengths(&look->length2_q22, right, down, n, l->row.attenuation[1]);
        begin_nodes(f, look, right, down, n, l->row.attenuation[1]);
    } else begin_nodes(f, look, right, down, n, NULL);
    for (int32_t i = 0; i < f->n_lights; i++) add_pixel_light(f, &f->light[i], x, y, n);
    if (look->tinted) gn_facet_tint(l->by.node[0], n, look->tint_q16, right, down);
}

#if GN_TEXTURES
/* Returns 0 if it is to be textured by cells. */
GN_HOT static int use_texture(gn_facet *f)
{
    return !f->s->surface.textured ||
           (gn_facet_use_screen(f) &&
            gn_facet_texture_begin(&f->texture, f->s->frame, &f->s->surface, &f->screen, f->width));
}

/* Texels of a span, and whether its n nodes are all in 2^-18 .. 1. */
GN_HOT static void use_texels(const gn_facet *f, const gn_run_span *span, int32_t n, gn_pixel_line *line)
{
    gn_lattice *l = &f->s->lattice;
    line->inside = 1;
    for (int32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) line->inside &= line->node[i][c] >= 1 << 6 && line->node[i][c] <= 1 << 24;
    gn_facet_texture_row(&f->texture, span->x - f->screen.x0, span->y - f->screen.y0, span->n_px, l->row.texel);
    line->texel = l->row.texel;
}
#else
GN_HOT static int use_texture(gn_facet *f)
{
    (void)f;
    return 1;
}

GN_HOT static void use_texels(const gn_facet *f, const gn_run_span *span, int32_t n, gn_pixel_line *line)
{
    (void)f, (void)span, (void)n, (void)line;
}
#endif

/* Nodes are all pixels, or, of a texture under light that is linear, two. */
GN_HOT static void draw_lit_span(const gn_facet *f, const gn_facet_look *look, const gn_run_span *span)
{
    const int each = look->each;
    int32_t(*node)[3] = f->s->lattice.by.node[0], n = each ? span->n_px : 2;
    gn_pixel_line line = {.node = (const int32_t(*)[3])node, .spacing_log2 = each ? 0 : 4};
    if (each) light_pixels(f, look, span->x, span->y, n);
    for (int c = 0; !each && c < 3; c++) {
        const gn_slope *at = &look->colour_q24[c];
        node[0][c] = f->base_q24[c] + gn_facet_at(at, span->x - f->screen.x0, span->y - f->screen.y0);
        node[1][c] = node[0][c] + at->dx * (span->n_px - 1);
    }
    if (GN_TEXTURES && f->s->surface.textured) use_texels(f, span, n, &line);
    for (int c = 0; !each && c < 3; c++) node[1][c] = node[0][c] + look->colour_q24[c].dx * 16;
    gn_pixel_store_line(f->s->frame, &f->s->rows, span->x, span->y, (1U << span->n_px) - 1, &line);
}

GN_HOT static void draw_runs(const gn_facet *f, const gn_facet_look *look)
{
    gn_shading *s = f->s;
    const gn_slope *slope = look->colour_q24;
    const gn_run_span *span = s->lattice.span;
    const int32_t step[3] = {slope[0].dx, slope[1].dx, slope[2].dx};
    int32_t at[3];
    for (const gn_run_span *end = span + s->lattice.n_spans; span < end; span++) {
        const int32_t x = span->x, y = span->y, right = x - f->screen.x0, down = y - f->screen.y0;
        at[0] = f->base_q24[0] + gn_facet_at(&slope[0], right, down);
        at[1] = f->base_q24[1] + gn_facet_at(&slope[1], right, down);
        at[2] = f->base_q24[2] + gn_facet_at(&slope[2], right, down);
        gn_pixel_store_run(s->frame, &s->rows, x, y, span->n_px, at, step);
    }
}

#if GN_SHADOWS
/* Whether nothing but one shadow varies; sets its two colours. */
GN_HOT static int use_two_colours(gn_facet *f)
{
    const gn_facet_light *light = &f->light[0];
    const gn_surface *s = &f->s->surface;
    int32_t dark[3], more[3];
    if (f->n_lights != 1 || !light->has_edge || GN_SMOOTH(s) || s->n_punctual || GN_COLOURED(s) || s->textured)
        return 0;
    if (gn_facet_shows_shadow(f)) return 0;
    for (int c = 0; c < 3; c++) {
        int32_t all = light->colour_q24[c].at, shadowed = gn_cell_share(all, light->dark_uq16);
        dark[c] = f->base_q24[c] + f->colour_q24[c][0] + shadowed;
        more[c] = gn_cell_share(all, light->lit_uq16) - shadowed;
    }
    gn_levels_use(&f->s->lattice, dark, more);
    return 1;
}

GN_HOT static void draw_levels(const gn_facet *f, const gn_run_span *span)
{
    gn_shading *s = f->s;
    uint32_t *attenuation = s->lattice.row.attenuation[0];
    gn_facet_attenuation(s, &f->screen, &f->light[0].edge, span->x, span->y, span->n_px, attenuation);
    for (int32_t i = 0; i < span->n_px; i++)
        gn_pixel_store(s->frame, &s->rows, span->x + i, span->y, gn_levels_pixel(s, attenuation[i]));
}
#else
GN_HOT static int use_two_colours(gn_facet *f)
{
    (void)f;
    return 0;
}

GN_HOT static void draw_levels(const gn_facet *f, const gn_run_span *span)
{
    (void)f, (void)span;
}
#endif

/* Of a span; `look` NULL: of two colours. */
GN_HOT static void draw_pieces(const gn_facet *f, const gn_facet_look *look, const gn_run_span *span)
{
    gn_run_span piece = *span;
    for (int32_t left = span->n_px; left > 0; left -= GN_FACET_ROW_PX, piece.x += GN_FACET_ROW_PX) {
        piece.n_px = (int16_t)gn_min32(left, GN_FACET_ROW_PX);
        if (look) draw_lit_span(f, look, &piece);
        else draw_levels(f, &piece);
    }
}

GN_HOT static void draw_spans(const gn_facet *f, const gn_facet_look *look)
{
    gn_lattice *l = &f->s->lattice;
    GN_COUNT(facet_pixels, f->n_px);
    if (look->each || f->s->surface.textured) {
        for (int32_t i = 0; i < l->n_spans; i++) draw_pieces(f, look, &l->span[i]);
        gn_levels_forget(l); /* nodes took their place */
    } else draw_runs(f, look);
}

#if GN_VERTEX_COLOURS
/* Whether light times the vertices' colours is close to linear: it is off by a third of both changes at most. */
GN_HOT static int products_are_linear(const gn_facet *f)
{
    const int32_t log2 = gn_max32(gn_cell_light_log2(f->s->frame), 4 - gn_cell_sum_log2(f->s->frame));
    for (int c = 0; c < 3; c++) {
        const int32_t *l = f->colour_q24[c], *t = f->tint_q16[c];
        if (l[0] == l[1] && l[0] == l[2]) continue;
        const int32_t least = gn_min32(l[0], gn_min32(l[1], l[2])), most = gn_max32(l[0], gn_max32(l[1], l[2])),
                      dimmest = gn_min32(t[0], gn_min32(t[1], t[2])), brightest = gn_max32(t[0], gn_max32(t[1], t[2]));
        if (!gn_cell_product_holds((uint32_t)(most - least), f->base_q24[c] + least, (uint32_t)(brightest - dimmest),
                                   dimmest, log2))
            return 0;
    }
    return 1;
}

/* Times the vertices' colours, where that is close to linear. Returns 0 if pixels are to be multiplied. */
GN_HOT static int tint_vertices(gn_facet *f)
{
    const gn_surface *s = &f->s->surface;
    if (!GN_COLOURED(s)) return 1;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) f->tint_q16[c][k] = tint_q16(s, c, k);
    if (f->n_lights || f->turns || !products_are_linear(f)) return 0;
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < 3; k++)
            f->colour_q24[c][k] = gn_facet_tinted(f->base_q24[c] + f->colour_q24[c][k], f->tint_q16[c][k]);
        f->base_q24[c] = 0;
    }
    return 1;
}

GN_HOT static void use_tints(gn_facet *f, gn_facet_look *look)
{
    for (int c = 0; look->tinted && c < 3; c++) gn_facet_slope(&f->screen, &look->tint_q16[c], f->tint_q16[c]);
}
#else
GN_HOT static int tint_vertices(gn_facet *f)
{
    (void)f;
    return 1;
}

GN_HOT static void use_tints(gn_facet *f, gn_facet_look *look)
{
    (void)f, (void)look;
}
#endif

/* Whether some light that pixels do not ask for arrives at a vertex. */
GN_HOT static inline int is_lit(const gn_facet *f)
{
    int32_t any = 0;
    for (int c = 0; c < 3; c++) any |= f->colour_q24[c][0] | f->colour_q24[c][1] | f->colour_q24[c][2];
    return any != 0;
}

/* Whether all pixels look the same; fills them in. */
GN_HOT static int draw_one_colour(gn_facet *f)
{
    gn_shading *s = f->s;
    const gn_lattice *l = &s->lattice;
    uint32_t q20[3], differs = 0;
    if (s->surface.textured || gn_facet_shows_shadow(f)) return 0;
    for (int c = 0; c < 3; c++) {
        const int32_t *colour = f->colour_q24[c];
        differs |= (uint32_t)(colour[0] ^ colour[1]) | (uint32_t)(colour[0] ^ colour[2]);
        q20[c] = (uint32_t)gn_max32(f->base_q24[c] + colour[0], 0) >> 4;
    }
    if (differs) return 0;
    uint32_t packed = gn_exact_pack(s, q20);
    for (int32_t i = 0; i < l->n_spans; i++)
        gn_pixel_fill(s->frame, &s->rows, l->span[i].x, l->span[i].y, l->span[i].n_px, packed);
    return 1;
}

/* Whether three values, up to 2^28 with `more`, are close to each other: perspective bends them by 1/16 of their
 * change, here 1/32 of the least and of `some`. */
GN_HOT static inline int are_close(const int32_t at[3], int32_t more, int32_t some)
{
    const int32_t least = gn_min32(at[0], gn_min32(at[1], at[2])), most = gn_max32(at[0], gn_max32(at[1], at[2]));
    return 2 * (most - least) <= least + more + some;
}

/* Whether colours of a bent triangle, without light that pixels ask for, show it. tinted: pixels are multiplied. */
GN_HOT static int shows_bend(const gn_facet *f, int tinted)
{
    int close = 1;
    for (int c = 0; c < 3; c++) {
        close &= are_close(f->colour_q24[c], f->base_q24[c], 1 << 19);
        if (tinted) close &= are_close(f->tint_q16[c], 0, 1 << 11);
    }
    return !close;
}

/* Sets what varies. Returns 0 if something is too steep, or bent. */
GN_HOT static inline int find_look(gn_facet *f, gn_facet_look *look)
{
    int32_t one[3] = {1 << 22, 1 << 22, 1 << 22}, above[3];
    const int32_t(*colour)[3] = (const int32_t(*)[3])f->colour_q24;
    if (!gn_facet_use_screen(f) || (f->screen.bent && shows_bend(f, look->tinted))) return 0;
    for (int c = 0; c < 3; c++) {
        const int32_t *a = colour[c], *b = colour[c ? c - 1 : 0];
        if (c && a[0] == b[0] && a[1] == b[1] && a[2] == b[2]) look->colour_q24[c] = look->colour_q24[c - 1];
        else gn_facet_slope(&f->screen, &look->colour_q24[c], a);
    }
    /* |n|^2 = 1 - b0 b1 d01^2 - b0 b2 d02^2 - b1 b2 d12^2 */
    for (int k = 0; k < 3; k++) above[k] = -(int32_t)(f->turn_q28[k] >> 6);
    if (f->turns) gn_facet_curve_find(&f->screen, &look->length2_q22, one, above);
    use_tints(f, look);
    return use_texture(f) && !f->screen.steep;
}

GN_HOT GN_NOINLINE int gn_facet_draw(gn_facet *f)
{
    const gn_lattice *l = &f->s->lattice;
    gn_facet_look *look = &f->look;
    if (!f->n_lights && f->turns && !is_lit(f)) f->turns = 0;
    look->tinted = !tint_vertices(f);
    look->each = f->n_lights || f->turns || look->tinted;
    if (!look->each && draw_one_colour(f)) return 1;
    if (!f->screen.steep && use_two_colours(f)) {
        GN_COUNT(facet_pixels, f->n_px);
        for (int32_t i = 0; i < l->n_spans; i++) draw_pieces(f, NULL, &l->span[i]);
        return 1;
    }
    if (!find_look(f, look)) return 0;
    draw_spans(f, look);
    return 1;
}

#endif
