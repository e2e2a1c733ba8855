/* Small triangles. [R4] */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_exact.h"
#include "shade/gn_facet.h"
#include "shade/gn_facet_screen.h"
#include "shade/gn_facet_texture.h"
#include "shade/gn_lattice_cell.h"
#include "shade/gn_levels.h"
#include "shade/gn_pixel.h"
#include "shade/gn_shadow.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_texel.h"

#if GN_INTERPOLATES

/* A light that pixels ask for: its shadow has an edge in the triangle, or its light ends there. */
typedef struct {
    const uint32_t *radiance_uq16;
    gn_slope cosine_q24;
    uint32_t lit_uq16, dark_uq16; /* what is left of it without a shadow, and in one */
    const gn_light_view *view;    /* of the shadow's edge, or NULL: */
    gn_slope u_q16, v_q16, depth_q30;
    int32_t slope_q28[2];
} pixel_light;

enum { PIXEL_LIGHTS = 2, EDGE_PX = 32 /* with more, windows pay */ };

typedef struct {
    gn_shading *s;
    const gn_rect *box;
    gn_facet_screen screen; /* if has_slopes > 0 */
    int32_t n_px;
    int has_slopes;
    int32_t colour_q24[3][3]; /* at the vertices, without light that pixels ask for */
    int32_t n_lights;
    pixel_light light[PIXEL_LIGHTS];
#if GN_TEXTURES
    gn_facet_texture texture; /* where the surface is textured */
#endif
} facet;

/* Once, when something varies. */
GN_HOT static int use_slopes(facet *f)
{
    if (!f->has_slopes) f->has_slopes = gn_facet_screen_find(&f->screen, f->s->frame, &f->s->surface, f->box) ? 1 : -1;
    return f->has_slopes > 0;
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
/* Coordinates of points of view space: a view's rays times twice the focal length. Returns 0 if they do not fit. */
GN_HOT static int use_matrix(gn_view_matrix *matrix, const gn_frame *frame, const gn_light_view *view)
{
    if (matrix->view == view) return 1;
    matrix->view = NULL;
    if ((uint32_t)view->fit.ortho.ray_shift > 62 || frame->cam.focal2_px_q16 >> 31) return 0;
    for (int i = 0; i < 3; i++) {
        const gn_ray_plane *r = &view->fit.ortho.ray[i];
        int64_t x = (int64_t)r->ax * (int32_t)frame->cam.focal2_px_q16 >> 16,
                y = (int64_t)r->ay * (int32_t)frame->cam.focal2_px_q16 >> 16;
        if (x != (int32_t)x || y != (int32_t)y || r->d_q16 != (int32_t)r->d_q16) return 0;
        matrix->m[i][0] = (int32_t)x;
        matrix->m[i][1] = (int32_t)y;
        matrix->m[i][2] = r->a0;
    }
    matrix->view = view;
    return 1;
}

/* Where a view sees the vertices: texels, Q16, and depth as a share of the range, Q30. */
typedef struct {
    int32_t at[3][3];
} vertex_places;

GN_HOT static inline int32_t depth_q30_of(const gn_light_view *view, int32_t depth_q16)
{
    int32_t up = 14 - view->tile_log2 - view->depth_log2;
    if (up < 0) return depth_q16 >> gn_min32(-up, 31);
    return gn_max32(-(1 << 29) >> up, gn_min32(depth_q16, ((1 << 30) - 1) >> up)) * (1 << up);
}

GN_HOT static GN_NOINLINE void place_vertices(const facet *f, uint32_t slot, const gn_light_view *view,
                                              vertex_places *out)
{
    const gn_surface *s = &f->s->surface;
    const gn_view_matrix *matrix = &f->s->lattice.matrix;
    const int smooth = GN_SMOOTH(s), lifts = smooth && f->s->lattice.light[slot].lifts,
              shift = view->fit.ortho.ray_shift;
    int32_t moved[3];
    if (!smooth) gn_sample_offset(f->s->frame, s, slot, view, s->normal_q30[0], moved);
    for (int k = 0; k < 3; k++) {
        const int32_t *v = s->v_q16[k];
        int32_t n[3];
        for (int i = 0; smooth && i < 3; i++) n[i] = s->normal_q30[0][i] + (k ? s->normal_q30[k][i] : 0);
        if (smooth && !lifts) gn_sample_offset(f->s->frame, s, slot, view, n, moved);
        for (int i = 0; i < 3; i++) {
            const int32_t *m = matrix->m[i];
            int64_t sum = (int64_t)m[0] * v[0] + (int64_t)m[1] * v[1] + (int64_t)m[2] * v[2];
            int32_t offset = moved[i];
            if (lifts) offset = 4 * gn_mul_high((int32_t)(gn_dot64(n, view->axis_q30[i]) >> 30), view->offset_q16);
            out->at[k][i] = gn_sat32((sum >> shift) + (int32_t)view->fit.ortho.ray[i].d_q16 + offset);
        }
        out->at[k][2] = depth_q30_of(view, out->at[k][2]);
    }
}

/* The view of a directional light that sees the triangle; NULL: none. */
GN_HOT static const gn_light_view *view_of(const facet *f, const gn_light_state *light)
{
    const gn_light_view *first = &f->s->frame->view[light->view_idx];
    if (first->border_lit) return first;
    return f->s->lattice.cascade == GN_CASCADE_NONE ? NULL : first + f->s->lattice.cascade;
}

/* What depth bounds of the texels say of all pixels between the vertices: GN_CELL_SPLIT if that does not fit. */
GN_HOT static int judge(const facet *f, const gn_light_view *view, const vertex_places *p, const int32_t slope_q28[2])
{
    int32_t lo[3], hi[3];
    for (int i = 0; i < 3; i++) {
        lo[i] = gn_min32(p->at[0][i], gn_min32(p->at[1][i], p->at[2][i]));
        hi[i] = gn_max32(p->at[0][i], gn_max32(p->at[1][i], p->at[2][i]));
    }
    if (gn_beyond_tile(view, lo[0], hi[0], lo[1], hi[1])) return GN_CELL_LIT;
    if (lo[2] <= -(1 << 29) && hi[2] > -(1 << 29)) return GN_CELL_SPLIT; /* a limit, which bends the plane */
    if ((gn_abs32(lo[0]) | gn_abs32(hi[0]) | gn_abs32(lo[1]) | gn_abs32(hi[1])) >> 27) return GN_CELL_SPLIT;
    if (view->filter == GN_FILTER_DISK) return GN_CELL_EDGE;
    int64_t slope = 4 * (int64_t)(view->filter_idx + 2) * ((int64_t)gn_abs32(slope_q28[0]) + gn_abs32(slope_q28[1]));
    const gn_receiver_step a = {lo[0], lo[1], 2 * (int32_t)gn_clamp64(lo[2] - slope, -(1 << 29), (1 << 30) - 16384)},
                           b = {hi[0], hi[1], 2 * (int32_t)gn_clamp64(hi[2] + slope, -(1 << 29), (1 << 30) - 16384)};
    uint32_t attenuation;
    if (!gn_filter_decides(f->s->frame, view, &a, &b, &attenuation)) return GN_CELL_EDGE;
    return attenuation ? GN_CELL_LIT : GN_CELL_DARK;
}

/* Whether perspective bends places by less than the tolerance. */
GN_HOT static int vertex_places_hold(const facet *f, const vertex_places *p)
{
    const gn_surface *s = &f->s->surface;
    const int32_t most_log2 = 16 - gn_cell_place_log2(f->s->frame);
    for (int i = 0; i < 2; i++) {
        uint32_t across = gn_cell_spread(p->at[0][i], p->at[1][i], p->at[2][i], p->at[2][i]);
        if (((uint64_t)across * (uint32_t)(s->z_max_q16 - s->z_min_q16)) >> (2 + most_log2) > (uint32_t)s->z_min_q16)
            return 0;
    }
    return 1;
}

/* GN_CELL_LIT, _DARK or _EDGE, whose places are set in `out`; GN_CELL_SPLIT if it cannot be told. */
GN_HOT static int find_vertex_shadow(facet *f, uint32_t slot, pixel_light *out)
{
    const gn_light_view *view = view_of(f, f->s->surface.light[slot].state);
    vertex_places p;
    if (!view) return GN_CELL_LIT;
    if (!use_matrix(&f->s->lattice.matrix, f->s->frame, view)) return GN_CELL_SPLIT;
    GN_COUNT(places, 3);
    place_vertices(f, slot, view, &p);
    gn_shadow_slopes(f->s->frame, &f->s->surface, view, NULL, out->slope_q28);
    int said = judge(f, view, &p, out->slope_q28);
    if (said != GN_CELL_EDGE) return said;
    if (f->n_px > EDGE_PX || !use_slopes(f) || !vertex_places_hold(f, &p)) return GN_CELL_SPLIT;
    out->view = view;
    gn_facet_slope(&f->screen, &out->u_q16, p.at[0][0], p.at[1][0], p.at[2][0]);
    gn_facet_slope(&f->screen, &out->v_q16, p.at[0][1], p.at[1][1], p.at[2][1]);
    gn_facet_slope(&f->screen, &out->depth_q30, p.at[0][2], p.at[1][2], p.at[2][2]);
    return said;
}

GN_HOT static uint32_t attenuation_at(const facet *f, const pixel_light *light, int32_t right, int32_t down)
{
    int32_t depth_q30 = gn_max32(0, gn_min32(gn_facet_at(&light->depth_q30, right, down), (1 << 30) - 1));
    gn_receiver r = {gn_facet_at(&light->u_q16, right, down),
                     gn_facet_at(&light->v_q16, right, down),
                     (uint32_t)depth_q30 << 2,
                     {light->slope_q28[0], light->slope_q28[1]},
                     f->box->x0 + right,
                     f->box->y0 + down};
    GN_COUNT(edge_lookups, 1);
    return gn_filter_attenuation(f->s->frame, light->view, &r);
}
#else
GN_HOT static int find_vertex_shadow(facet *f, uint32_t slot, pixel_light *out)
{
    (void)f, (void)slot, (void)out;
    return GN_CELL_LIT;
}

GN_HOT static uint32_t attenuation_at(const facet *f, const pixel_light *light, int32_t right, int32_t down)
{
    (void)f, (void)light, (void)right, (void)down;
    return 65536;
}
#endif

/* ---- Light ------------------------------------------------------------------------------------------------------- */

/* n . L at the vertices. Returns 0 if none of it is above 0. */
GN_HOT static int find_cosines(const facet *f, const gn_surface_light *light, int32_t out_q24[3])
{
    const gn_surface *s = &f->s->surface;
    int32_t most = 0;
    for (int k = 0; k < 3; k++) {
        int32_t cosine = light->cosine_q24[0];
        if (GN_SMOOTH(s)) {
            int64_t dot = gn_dot64(s->normal_q30[0], light->state->to_light_q30);
            if (k) dot += gn_dot64(s->normal_q30[k], light->state->to_light_q30);
            cosine = (int32_t)(dot >> 36);
            if (GN_K(f->s->frame, vertex_light)) cosine = gn_max32(cosine, 0);
        }
        if (GN_RAW_VIEWS && f->s->frame->picture.format == GN_FORMAT_RAW32) cosine = cosine > 0 ? 1 << 24 : 0;
        out_q24[k] = cosine;
        most = gn_max32(most, cosine);
    }
    return most > 0;
}

/* Adds a light. Returns 0 if the triangle is to be shaded by cells. */
GN_HOT static int add_vertex_light(facet *f, uint32_t slot)
{
    const gn_surface_light *light = &f->s->surface.light[slot];
    const gn_lattice_light *lattice_light = &f->s->lattice.light[slot];
    pixel_light *out = &f->light[f->n_lights];
    int32_t e[3];
    int said = GN_CELL_LIT;
    if (!find_cosines(f, light, e)) return 1;
    int ends = (e[0] | e[1] | e[2]) < 0;
    if (GN_RAW_VIEWS && f->s->frame->picture.format == GN_FORMAT_RAW32 && (e[0] != e[1] || e[0] != e[2])) return 0;
    if (f->n_lights == PIXEL_LIGHTS) return 0;
    out->view = NULL;
    if (lattice_light->realtime) said = find_vertex_shadow(f, slot, out);
    if (said == GN_CELL_SPLIT) return 0;
    uint32_t share = said == GN_CELL_DARK ? lattice_light->dark_uq16 : lattice_light->lit_uq16;
    if (said != GN_CELL_EDGE && !ends) {
        for (int k = 0; share && k < 3; k++) {
            int32_t v = gn_cell_share(e[k], share);
            for (int c = 0; c < 3; c++) {
                f->colour_q24[k][c] += gn_corner_times(light->radiance_uq16[c], v);
                if (f->colour_q24[k][c] > 1 << 27) return 0; /* cells know how its limit bends it */
            }
        }
        return 1;
    }
    if (!use_slopes(f)) return 0;
    gn_facet_slope(&f->screen, &out->cosine_q24, e[0], e[1], e[2]);
    out->radiance_uq16 = light->radiance_uq16;
    out->lit_uq16 = share;
    out->dark_uq16 = lattice_light->dark_uq16;
    f->n_lights++;
    return 1;
}

/* Whether normals turn by so little that they need not be brought to length 1 in between: NUMERICS 4.17. */
GN_HOT static int turns_little(const gn_frame *frame, const gn_surface *s)
{
    uint32_t sum = 0;
    if (!GN_SMOOTH(s) || GN_K(frame, vertex_light)) return 1;
    for (int k = 1; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            uint32_t d = gn_abs32(s->normal_q30[k][i]) >> 16;
            sum += d * d >> 4; /* Q24: 2^30 */
        }
    return sum <= 1U << 21;
}

/* ---- Pixels ------------------------------------------------------------------------------------------------------ */

/* Adds the lights that a pixel asks for. */
GN_HOT static void add_pixel_lights(const facet *f, int32_t right, int32_t down, int32_t colour_q24[3])
{
    for (int32_t i = 0; i < f->n_lights; i++) {
        const pixel_light *light = &f->light[i];
        int32_t e = gn_facet_at(&light->cosine_q24, right, down);
        if (e <= 0) continue;
        uint32_t share = light->lit_uq16;
        if (light->view) {
            uint32_t attenuation = attenuation_at(f, light, right, down);
            share = light->dark_uq16 + gn_mul_uq16(light->lit_uq16 - light->dark_uq16, attenuation);
        }
        if (!share) continue;
        e = gn_cell_share(e, share);
        for (int c = 0; c < 3; c++) /* 2^27 each, and as much to begin with */
            colour_q24[c] += gn_corner_times(light->radiance_uq16[c], e);
    }
}

/* The colours of a pixel's lights, times the vertices' if they are not in them yet. */
GN_HOT static void light_pixel(const facet *f, const gn_slope *tint_q16, int32_t right, int32_t down,
                               int32_t colour_q24[3])
{
    add_pixel_lights(f, right, down, colour_q24);
    for (int c = 0; tint_q16 && c < 3; c++)
        colour_q24[c] = (int32_t)((int64_t)colour_q24[c] * gn_facet_at(&tint_q16[c], right, down) >> 16);
}

GN_HOT static void draw_span(const facet *f, const gn_slope base_q24[3], const gn_slope *tint_q16,
                             const gn_run_span *span)
{
    static const int32_t none[3] = {0, 0, 0};
    const gn_shading *s = f->s;
    int32_t right = span->x - f->box->x0, down = span->y - f->box->y0, at[3], step[3];
    for (int c = 0; c < 3; c++) {
        at[c] = gn_facet_at(&base_q24[c], right, down);
        step[c] = base_q24[c].dx;
    }
    if (!f->n_lights) {
        gn_pixel_store_run(s->frame, &s->rows, span->x, span->y, span->n_px, at, step);
        return;
    }
    for (int32_t i = 0; i < span->n_px; i++) {
        int32_t colour[3] = {at[0], at[1], at[2]};
        light_pixel(f, tint_q16, right + i, down, colour);
        gn_pixel_store_run(s->frame, &s->rows, span->x + i, span->y, 1, colour, none);
        for (int c = 0; c < 3; c++) at[c] += step[c];
    }
}

#if GN_TEXTURES
/* The same of a textured surface: nodes are two, or all pixels. */
GN_HOT static void draw_textured_span(const facet *f, const gn_slope base_q24[3], const gn_slope *tint_q16,
                                      const gn_run_span *span)
{
    gn_lattice *l = &f->s->lattice;
    int32_t(*node)[3] = l->by.node[0];
    int32_t right = span->x - f->box->x0, down = span->y - f->box->y0, n = f->n_lights ? span->n_px : 2;
    for (int32_t i = 0; i < n; i++) {
        int32_t x = f->n_lights ? i : i * (span->n_px - 1);
        for (int c = 0; c < 3; c++) node[i][c] = gn_facet_at(&base_q24[c], right + x, down);
        if (f->n_lights) light_pixel(f, tint_q16, right + x, down, node[i]);
    }
    gn_pixel_line line = {.node = (const int32_t(*)[3])node, .spacing_log2 = f->n_lights ? 0 : 4, .inside = 1};
    for (int32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) line.inside &= node[i][c] >= 1 << 6 && node[i][c] <= 1 << 24;
    for (int c = 0; !f->n_lights && c < 3; c++) node[1][c] = node[0][c] + base_q24[c].dx * 16;
    gn_facet_texture_row(&f->texture, right, down, span->n_px, l->row.texel);
    line.texel = l->row.texel;
    gn_pixel_store_line(f->s->frame, &f->s->rows, span->x, span->y, (1U << span->n_px) - 1, &line);
}

/* Returns 0 if it is to be textured by cells. */
GN_HOT static int use_texture(facet *f)
{
    return !f->s->surface.textured ||
           (use_slopes(f) && gn_facet_texture_begin(&f->texture, f->s->frame, &f->s->surface, &f->screen));
}
#endif

GN_HOT static void draw_spans(const facet *f, const gn_slope base_q24[3], const gn_slope *tint_q16)
{
    gn_lattice *l = &f->s->lattice;
    GN_COUNT(facet_pixels, f->n_px);
#if GN_TEXTURES
    if (f->s->surface.textured) {
        for (int32_t i = 0; i < l->n_spans; i++) draw_textured_span(f, base_q24, tint_q16, &l->span[i]);
        gn_levels_forget(l); /* nodes took their place */
        return;
    }
#endif
    for (int32_t i = 0; i < l->n_spans; i++) draw_span(f, base_q24, tint_q16, &l->span[i]);
}

/* Times the vertices' colours. */
GN_HOT static void tint_vertices(facet *f)
{
#if GN_VERTEX_COLOURS
    const int32_t(*rgb)[GN_ATTRIBUTE_COUNT] = (const int32_t(*)[GN_ATTRIBUTE_COUNT])f->s->surface.attribute_q16;
    for (int c = 0; c < 3; c++) {
        int32_t first = rgb[0][GN_ATTRIBUTE_RGB + c];
        for (int k = 0; k < 3; k++)
            f->colour_q24[k][c] =
                (int32_t)((int64_t)f->colour_q24[k][c] * (first + (k ? rgb[k][GN_ATTRIBUTE_RGB + c] : 0)) >> 16);
    }
#else
    (void)f;
#endif
}

#if GN_SHADOWS
/* Whether nothing but one shadow varies; sets its two colours. */
GN_HOT static int use_two_colours(facet *f)
{
    const pixel_light *light = &f->light[0];
    const gn_surface *s = &f->s->surface;
    int32_t dark[3], more[3];
    if (f->n_lights != 1 || !light->view || GN_SMOOTH(s) || GN_COLOURED(s) || s->textured) return 0;
    if (GN_RAW_VIEWS && f->s->frame->picture.format == GN_FORMAT_RAW32) return 0;
    for (int c = 0; c < 3; c++) {
        int32_t all = gn_corner_times(light->radiance_uq16[c], light->cosine_q24.at),
                shadowed = gn_cell_share(all, light->dark_uq16);
        dark[c] = f->colour_q24[0][c] + shadowed;
        more[c] = gn_cell_share(all, light->lit_uq16) - shadowed;
    }
    gn_levels_use(&f->s->lattice, dark, more);
    return 1;
}

GN_HOT static void draw_levels(const facet *f, const gn_run_span *span)
{
    gn_shading *s = f->s;
    int32_t right = span->x - f->box->x0, down = span->y - f->box->y0;
    for (int32_t i = 0; i < span->n_px; i++)
        gn_pixel_store(s->frame, &s->rows, span->x + i, span->y,
                       gn_levels_pixel(s, attenuation_at(f, &f->light[0], right + i, down)));
}
#else
GN_HOT static int use_two_colours(facet *f)
{
    (void)f;
    return 0;
}

GN_HOT static void draw_levels(const facet *f, const gn_run_span *span)
{
    (void)f, (void)span;
}
#endif

/* Returns 0 if something is too steep. */
GN_HOT static int draw(facet *f)
{
    gn_shading *s = f->s;
    gn_lattice *l = &s->lattice;
    const int32_t(*colour)[3] = (const int32_t(*)[3])f->colour_q24;
    gn_slope base[3], tints[3];
    const gn_slope *tint_q16 = NULL;
    uint32_t differs = 0;
    if (GN_COLOURED(&s->surface) && !f->n_lights) tint_vertices(f);
    for (int c = 0; c < 3; c++)
        differs |= (uint32_t)(colour[0][c] ^ colour[1][c]) | (uint32_t)(colour[0][c] ^ colour[2][c]);
    if (!differs && !f->n_lights && !s->surface.textured && s->frame->picture.format != GN_FORMAT_RAW32) {
        uint32_t q20[3];
        for (int c = 0; c < 3; c++) q20[c] = (uint32_t)gn_max32(colour[0][c], 0) >> 4;
        uint32_t packed = gn_exact_pack(s, q20);
        for (int32_t i = 0; i < l->n_spans; i++)
            gn_pixel_fill(s->frame, &s->rows, l->span[i].x, l->span[i].y, l->span[i].n_px, packed);
        return 1;
    }
    if (!f->screen.steep && use_two_colours(f)) {
        GN_COUNT(facet_pixels, f->n_px);
        for (int32_t i = 0; i < l->n_spans; i++) draw_levels(f, &l->span[i]);
        return 1;
    }
    if (!use_slopes(f)) return 0;
    for (int c = 0; c < 3; c++) gn_facet_slope(&f->screen, &base[c], colour[0][c], colour[1][c], colour[2][c]);
#if GN_VERTEX_COLOURS
    const int32_t(*rgb)[GN_ATTRIBUTE_COUNT] = (const int32_t(*)[GN_ATTRIBUTE_COUNT])s->surface.attribute_q16;
    for (int c = 0; GN_COLOURED(&s->surface) && f->n_lights && c < 3; c++) {
        int32_t first = rgb[0][GN_ATTRIBUTE_RGB + c];
        gn_facet_slope(&f->screen, &tints[c], first, first + rgb[1][GN_ATTRIBUTE_RGB + c],
                       first + rgb[2][GN_ATTRIBUTE_RGB + c]);
        tint_q16 = tints;
    }
#endif
    (void)tints;
#if GN_TEXTURES
    if (!use_texture(f)) return 0;
#endif
    if (f->screen.steep) return 0;
    draw_spans(f, base, tint_q16);
    return 1;
}

GN_HOT int gn_facet_shade(gn_shading *s, const gn_rect *box, int32_t n_px)
{
    const gn_surface *surface = &s->surface;
    facet f;
    if (box->x1 - box->x0 > GN_FACET_PX || box->y1 - box->y0 > GN_FACET_PX) return 0;
    if (surface->masked | surface->specular | surface->baked || GN_GLOWS(surface)) return 0;
    if (surface->n_punctual || surface->plane.det <= 0 || !turns_little(s->frame, surface)) return 0;
    s->lattice.cascade = -1;
#if GN_SHADOWS
    gn_corner_begin_box(&s->lattice, s->frame, surface, box);
#endif
    if (surface->shadowed && s->lattice.cascade < 0) return 0;
    f.s = s;
    f.box = box;
    f.n_px = n_px;
    f.has_slopes = f.screen.steep = f.n_lights = 0;
    for (int c = 0; c < 3; c++) {
        int32_t base = (int32_t)(surface->base_q20[c] > 1U << 23 ? 1U << 23 : surface->base_q20[c]) << 4;
        f.colour_q24[0][c] = f.colour_q24[1][c] = f.colour_q24[2][c] = base;
    }
    for (uint32_t slot = 0; slot < surface->n_lights; slot++)
        if (!add_vertex_light(&f, slot)) return 0;
    GN_COUNT(facets, 1);
    return draw(&f);
}

#endif
