/* Pixels of a cell, row by row: of one colour, of colours that are linear, or each with a node of its own, where a
 * shadow has an edge or there is a texture. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_lattice.h"
#include "shade/gn_pixel.h"
#include "shade/gn_surface.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_views.h"

#if GN_INTERPOLATES

/* Index of the lowest bit that is set. */
GN_HOT static inline int32_t lowest_bit(uint32_t bits)
{
    return 31 - gn_clz32(bits & (0U - bits));
}

/* ---- Cells of one colour ----------------------------------------------------------------------------------------- */

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
    if (GN_RAW_VIEWS && s->frame->picture.format == GN_FORMAT_RAW32) return 0;
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

/* ---- Rows of nodes ----------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
/* One exact lookup, at a depth that is limited to the view's range. */
GN_HOT static uint32_t lookup(const gn_drawing *d, const gn_light_view *view, const int32_t slope_q28[2],
                              const gn_receiver_step *at, int32_t x, int32_t y)
{
    int32_t depth_q30 = gn_max32(0, gn_min32(at->depth_q31, (1 << 30) - 1));
    gn_receiver r = {at->u_q16, at->v_q16, (uint32_t)depth_q30 << 2, {slope_q28[0], slope_q28[1]}, x, y};
    GN_NOTE_LOOKUP(&d->s->scratch->squares, d->s->frame, view, &r);
    return gn_filter_attenuation(d->s->frame, view, &r);
}

/* A row's first pixel and its steps, from where its ends are seen. */
GN_HOT static inline void step_row(const gn_drawing *d, const gn_corner_light *at, const gn_receiver_step *end,
                                   gn_receiver_step *from, gn_receiver_step *step)
{
    step->u_q16 = (end->u_q16 - at->u_q16) >> d->size_log2;
    step->v_q16 = (end->v_q16 - at->v_q16) >> d->size_log2;
    step->depth_q31 = (end->depth_q31 - at->depth_q30) >> d->size_log2;
    from->u_q16 = at->u_q16 + d->first * step->u_q16;
    from->v_q16 = at->v_q16 + d->first * step->v_q16;
    from->depth_q31 = at->depth_q30 + d->first * step->depth_q31;
}

/* By forms on the screen. Returns 0 if they do not tell. */
GN_HOT static GN_NOINLINE int place_flat_row(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below,
                                             gn_receiver_step *from, gn_receiver_step *step)
{
#if GN_PUNCTUAL_LIGHTS
    gn_shading *s = d->s;
    gn_corner_light *at = &s->lattice.corner.light[edge->slot];
    gn_receiver_step end = {0, 0, 0};
    if (!edge->view->perspective || GN_SMOOTH(&s->surface)) return 0;
    for (int i = 1; i >= 0; i--) {
        if (!gn_corner_place_flat(&s->lattice, s->frame, &s->surface, edge->slot, edge->view,
                                  d->x + (i << d->size_log2), d->y + below, at) ||
            !at->seen)
            return 0;
        if (i) end = (gn_receiver_step){at->u_q16, at->v_q16, at->depth_q30};
    }
    step_row(d, at, &end, from, step);
    return 1;
#else
    (void)d, (void)edge, (void)below, (void)from, (void)step;
    return 0;
#endif
}

/* The same of any surface. */
GN_HOT static GN_NOINLINE void place_row(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below,
                                         gn_receiver_step *from, gn_receiver_step *step)
{
    gn_lattice *l = &d->s->lattice;
    const gn_corner_light *at = &l->corner.light[edge->slot];
    gn_receiver_step end = {0, 0, 0};
    for (int i = 1; i >= 0; i--) {
        int32_t x = d->x + (i << d->size_log2);
        if (!gn_corner_locate(l, d->s->frame, &d->s->surface, edge->slot, x, d->y + below, &l->corner) ||
            !gn_corner_place(l, d->s->frame, &d->s->surface, &l->corner, edge->slot, edge->view_idx))
            return;
        if (!i) break;
        end.u_q16 = at->u_q16;
        end.v_q16 = at->v_q16;
        end.depth_q31 = at->depth_q30;
    }
    step_row(d, at, &end, from, step);
}

/* A row of pixels in a view, `below` pixels under the cell's first row, and its steps. Depths are in Q30. */
GN_HOT static void find_row(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below, gn_receiver_step *at,
                            gn_receiver_step *step)
{
    step->u_q16 = edge->u_q16.dx + below * edge->u_q16.dxy;
    step->v_q16 = edge->v_q16.dx + below * edge->v_q16.dxy;
    step->depth_q31 = edge->depth_q30.dx + below * edge->depth_q30.dxy;
    at->u_q16 = gn_flat_patch_at(&edge->u_q16, d->first, below);
    at->v_q16 = gn_flat_patch_at(&edge->v_q16, d->first, below);
    at->depth_q31 = gn_flat_patch_at(&edge->depth_q30, d->first, below);
}

/* A lookup for each of the pixels of `bits` in a row. */
GN_HOT static GN_NOINLINE void look_up_each(const gn_drawing *d, const gn_lattice_edge *edge,
                                            const gn_receiver_step *row, const gn_receiver_step *step, int32_t x,
                                            int32_t y, uint32_t bits, uint32_t *out)
{
    gn_receiver_step at = *row;
    for (; bits; bits >>= 1, x++, out++) {
        if (bits & 1U) *out = lookup(d, edge->view, edge->slope_q28, &at, x, y);
        gn_receiver_advance(&at, step, 1);
    }
}

/* Attenuations of n nodes of a row, the first of which is node `first` of the cell's row `below`. Returns GN_WINDOW_LIT
 * or _DARK if all of them are, and sets none; else _MIXED. */
GN_HOT static int look_up_row(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below, int32_t first,
                              gn_receiver_step *at, const gn_receiver_step *step, int32_t n, uint32_t *out)
{
    uint32_t missed = (1U << n) - 1;
    GN_COUNT(edge_lookups, n);
    if (edge->window && edge->window->view == edge->view) {
        const int said = gn_lattice_row(d->s->frame, edge->window, at, step, n, -1, out, &missed);
        if (!missed) return said;
        gn_receiver_advance(at, step, -n);
    }
    look_up_each(d, edge, at, step, d->x + d->first + first, d->y + below, missed, out);
    return GN_WINDOW_MIXED;
}

#if GN_PUNCTUAL_LIGHTS || GN_MANY_CASCADES
/* Attenuations along a row of pixels that two faces or cascades see. */
GN_HOT static GN_NOINLINE void look_up_two(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below,
                                           uint32_t *out)
{
    gn_receiver_step at, step;
    const gn_flat_patch *border = &edge[1].more_q24[0];
    const int32_t first = gn_flat_patch_at(border, d->first, below), across = border->dx + below * border->dxy;
    for (int32_t from = 0, end; from < d->n; from = end) { /* |first + i across| < 2^29: a corner's is below 2^28 */
        int k = first + from * across < 0;
        for (end = from + 1; end < d->n && (first + end * across < 0) == k;) end++;
        find_row(d, edge + k, below, &at, &step);
        if (edge[k].bent & GN_PLACES_BY_ROW) place_flat_row(d, edge + k, below, &at, &step);
        gn_receiver_advance(&at, &step, from);
        int said = look_up_row(d, edge + k, below, from, &at, &step, end - from, out + from);
        gn_attenuations_set(out + from, end - from, said);
    }
}
#endif

/* Attenuations along a row of pixels that one view sees. Returns what look_up_row() does. */
GN_HOT static GN_NOINLINE int look_up_one(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below,
                                          uint32_t *out)
{
    gn_receiver_step at, step;
    find_row(d, edge, below, &at, &step);
    if (edge->bent && !place_flat_row(d, edge, below, &at, &step)) place_row(d, edge, below, &at, &step);
    return look_up_row(d, edge, below, 0, &at, &step, d->n, out);
}

/* The same of any row of pixels, `below` pixels under the cell's first row. */
GN_HOT static int find_attenuations(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below, uint32_t *out)
{
#if GN_PUNCTUAL_LIGHTS || GN_MANY_CASCADES
    if (edge->bent & GN_PLACES_OF_TWO) {
        look_up_two(d, edge, below, out);
        return GN_WINDOW_MIXED;
    }
#endif
    return look_up_one(d, edge, below, out);
}

/* Adds the light of an edge, where that is not in shadow. */
GN_HOT static GN_NOINLINE void add_edge_light(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below,
                                              int32_t (*node)[3])
{
    const uint32_t *share = d->s->lattice.row.attenuation, *end = share + d->n;
    const gn_node_row twice = gn_row_of_edge(d, edge, below);
    int32_t r = twice.from[0], g = twice.from[1], b = twice.from[2];
    for (; share < end; share++, node++, r += twice.step[0], g += twice.step[1], b += twice.step[2])
        gn_node_add(*node, *share, r, g, b);
}
#endif

/* Colours of a row of pixels. Lights before the first with an edge in it are in shadow all along it, or nowhere: those
 * take no loop of their own. */
GN_HOT static void find_nodes(const gn_drawing *d, int32_t below, int32_t (*node)[3])
{
    gn_node_row row = {{0, 0, 0}, {0, 0, 0}};
    int is_put = 0;
    gn_row_add(d, d->base_q24, below, &row);
#if GN_SHADOWS
    const gn_lattice_look *look = &d->s->lattice.look;
    uint32_t *share = d->s->lattice.row.attenuation;
    for (int32_t k = 0; k < look->n_edges; k++) {
        const gn_lattice_edge *edge = &look->edge[k];
        int said = find_attenuations(d, edge, below, share);
        k += edge->bent >> 1; /* which is the next one, too */
        if (said == GN_WINDOW_DARK) continue;
        if (said == GN_WINDOW_LIT && !is_put) {
            gn_row_add(d, edge->more_q24, below, &row);
            continue;
        }
        gn_attenuations_set(share, d->n, said);
        if (!is_put) gn_row_put(&row, node, node + d->n);
        add_edge_light(d, edge, below, node);
        is_put = 1;
    }
#endif
    if (!is_put) gn_row_put(&row, node, node + d->n);
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

#if GN_TEXTURES
/* Whether the first n nodes lie in 2^-18 .. 1. */
GN_HOT static int nodes_inside(const gn_lattice *l, int32_t n)
{
    uint32_t all = 0;
    for (int32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) all |= (uint32_t)l->by.node[i][c] | (uint32_t)(l->by.node[i][c] - 64);
    return all < 1U << 24;
}

/* Texels take the place of attenuations, after the row's nodes have been found. */
GN_HOT static GN_NOINLINE void use_textures(gn_drawing *d, int32_t n_nodes)
{
    gn_pixel_line *line = &d->line;
    gn_shading *s = d->s;
    line->inside = nodes_inside(&s->lattice, n_nodes);
    gn_lattice_textures_line(&s->lattice, &d->textures, line);
#if GN_GLOW_APART
    for (int c = 0; c < 3; c++) {
        uint32_t glow = s->surface.object->emissive_uq16[c];
        line->glow_q24[c] = GN_GLOWS(&s->surface) ? (int32_t)(glow < 1U << 19 ? glow << 8 : 1U << 27) : 0;
    }
#endif
}
#endif

/* Pixels of a row whose colours are linear. */
GN_HOT static void draw_linear(const gn_drawing *d, int32_t below, uint32_t bits)
{
    gn_shading *s = d->s;
    gn_node_row row = {{0, 0, 0}, {0, 0, 0}};
    int32_t x = d->x + d->first;
    gn_row_add(d, d->base_q24, below, &row);
    while (bits) {
        const int32_t skip = lowest_bit(bits), n = lowest_bit(~(bits >> skip));
        for (int c = 0; c < 3; c++) row.from[c] += skip * row.step[c];
        gn_pixel_store_run(s->frame, &s->rows, x + skip, d->y + below, n, row.from, row.step);
        for (int c = 0; c < 3; c++) row.from[c] += n * row.step[c];
        x += skip + n;
        bits = bits >> skip >> n;
    }
}

/* Colours at both ends of the cell's row, between which they are linear. */
GN_HOT static void find_two(const gn_drawing *d, int32_t below, int32_t (*node)[3])
{
    gn_node_row row = {{0, 0, 0}, {0, 0, 0}};
    gn_row_add(d, d->base_q24, below, &row);
    for (int c = 0; c < 3; c++) node[0][c] = row.from[c], node[1][c] = row.from[c] + row.step[c] * (1 << d->size_log2);
}

/* A row of pixels. */
GN_HOT static void draw_row(gn_drawing *d, int32_t below)
{
    gn_shading *s = d->s;
    gn_lattice *l = &s->lattice;
    uint32_t bits = gn_lattice_bits(l, d->x, d->y + below, d->size_log2);
    if (!bits) return;
    if (!l->look.n_edges && !s->surface.textured) {
        draw_linear(d, below, bits >> d->first);
        return;
    }
    if (d->line.spacing_log2) find_two(d, below, l->by.node);
    else find_nodes(d, below, l->by.node);
#if GN_TEXTURES
    if (s->surface.textured) {
        use_textures(d, d->line.spacing_log2 ? 2 : d->n);
        bits = gn_lattice_textures_row(l, &d->textures, d->size_log2, below, d->first, bits);
    }
#endif
    bits >>= d->first;
    if (bits) gn_pixel_store_line(s->frame, &s->rows, d->x + d->first, d->y + below, bits, &d->line);
}

/* Colours without the light of edges. */
GN_HOT static GN_NOINLINE void begin_base(gn_drawing *d, const gn_lattice_look *look)
{
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        int32_t at[4];
        GN_UNROLL
        for (int i = 0; i < 4; i++) at[i] = look->colour_q24[i][c];
        gn_flat_patch_make(&d->base_q24[c], at, d->size_log2);
    }
}

/* Rows of pixels. */
GN_HOT static void draw_rows(gn_drawing *d)
{
    gn_lattice *l = &d->s->lattice;
    d->line =
        (gn_pixel_line){.node = (const int32_t(*)[3])l->by.node, .spacing_log2 = l->look.n_edges ? 0 : d->size_log2};
    for (int32_t below = 0; below < 1 << d->size_log2; below++) draw_row(d, below);
}

GN_HOT void gn_lattice_draw(gn_shading *s, int32_t x, int32_t y, int32_t size_log2)
{
    gn_lattice *l = &s->lattice;
    const gn_lattice_look *look = &l->look;
    gn_drawing *d = &l->drawing;
    uint32_t packed;
    if (!look->n_edges && !s->surface.textured && is_plain(s, (const int32_t(*)[3])look->colour_q24, &packed)) {
        fill_cell(s, x, y, size_log2, packed);
        return;
    }
    GN_COUNT(cells_drawn, 1);
    d->s = s;
    d->x = x;
    d->y = y;
    d->size_log2 = size_log2;
    begin_base(d, look);
    const uint32_t any = gn_lattice_columns(l, x, y, 1 << size_log2, size_log2);
    d->first = s->surface.textured && !look->n_edges ? 0 : lowest_bit(any);
    d->n = 32 - gn_clz32(any) - d->first;
#if GN_TEXTURES
    if (s->surface.textured) {
        for (int32_t next = 0; gn_lattice_textures_begin(s, x, y, size_log2, next, &d->textures); next++) draw_rows(d);
        return;
    }
#endif
    draw_rows(d);
}

#endif
