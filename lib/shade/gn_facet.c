/* Small triangles: light at their vertices. [R4] */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_corner.h"
#include "shade/gn_facet.h"
#include "shade/gn_facet_draw.h"
#include "shade/gn_facet_punctual.h"
#include "shade/gn_facet_specular.h"
#include "shade/gn_lattice_cell.h"

#if GN_INTERPOLATES

/* Returns 0 if normals turn by more than a right angle. NUMERICS 4.17 */
GN_HOT static int find_turns(gn_facet *f)
{
    const int32_t(*n)[3] = (const int32_t(*)[3])f->s->surface.normal_q30;
    const uint32_t least_q28 = gn_cell_light_log2(f->s->frame) ? 1U << 23 : 1U << 24; /* 1/32, 1/16 */
    uint32_t d2[3] = {0, 0, 0};
    f->turns = 0;
    GN_UNROLL
    for (int k = 0; k < 3; k++) f->turn_q28[k] = 0;
    if (!GN_SMOOTH(&f->s->surface) || gn_facet_shows_shadow(f)) return 1;
    if (GN_K(f->s->frame, vertex_light) && !f->s->surface.n_punctual) return 1;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        int32_t a = n[1][i] >> 16, b = n[2][i] >> 16;
        d2[0] += (uint32_t)(a * a);
        d2[1] += (uint32_t)(b * b);
        d2[2] += (uint32_t)((b - a) * (b - a));
    }
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        f->turn_q28[k] = d2[k];
        f->turns |= d2[k] >= least_q28;
        if (d2[k] > 2U << 28) return 0;
    }
    return 1;
}

/* n . L of the normals at the vertices. Returns 0 if none of it is above 0. */
GN_HOT static int find_cosines(const gn_facet *f, const gn_surface_light *light, int32_t out_q24[3])
{
    const gn_surface *s = &f->s->surface;
    int32_t most = 0;
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        int32_t cosine = light->cosine_q24[0];
        if (GN_SMOOTH(s)) {
            int64_t dot = gn_dot64(s->normal_q30[0], light->state->to_light_q30);
            if (k) dot += gn_dot64(s->normal_q30[k], light->state->to_light_q30);
            cosine = (int32_t)(dot >> 36);
            if (GN_K(f->s->frame, vertex_light)) cosine = gn_max32(cosine, 0);
        }
        if (gn_facet_shows_shadow(f)) cosine = cosine > 0 ? 1 << 24 : 0;
        out_q24[k] = cosine;
        most = gn_max32(most, cosine);
    }
    return most > 0;
}

#if GN_PUNCTUAL_LIGHTS
/* The same of a spot or point light. Returns what gn_facet_punctual() does. */
GN_HOT static int find_punctual(gn_facet *f, uint32_t slot, gn_facet_light *out, int32_t e_q24[3])
{
    const int32_t *b = f->base_q24;
    gn_facet_lamp lamp;
    int said =
        gn_facet_punctual(f->s, &f->vertices, slot, gn_max32(b[0], gn_max32(b[1], b[2])), f->screen.size_log2, &lamp);
    if (said != GN_CELL_LIT) return said;
    out->has_rim = lamp.has_rim;
    for (int k = 0; k < 3; k++) {
        e_q24[k] = lamp.irradiance_q24[k];
        if (gn_facet_shows_shadow(f)) e_q24[k] = e_q24[k] > 0 ? 1 << 24 : 0;
    }
    if (!lamp.has_rim) return said;
    if (gn_facet_shows_shadow(f)) return GN_CELL_SPLIT;
    gn_facet_slope(&f->screen, &out->rim_q20, lamp.rim_q20);
    return f->screen.steep ? GN_CELL_SPLIT : said;
}

/* Returns 0 if vertices do not fit. */
GN_HOT static int use_vertices(gn_facet *f)
{
    return !f->s->surface.n_punctual || gn_facet_vertices_find(&f->vertices, f->s->frame, &f->s->surface, f->turn_q28);
}

GN_HOT static inline const gn_facet_vertices *vertices_of(const gn_facet *f)
{
    return &f->vertices;
}
#else
GN_HOT static int find_punctual(gn_facet *f, uint32_t slot, gn_facet_light *out, int32_t e_q24[3])
{
    (void)f, (void)slot, (void)out, (void)e_q24;
    return GN_CELL_SPLIT;
}

GN_HOT static int use_vertices(gn_facet *f)
{
    (void)f;
    return 1;
}

GN_HOT static inline const gn_facet_vertices *vertices_of(const gn_facet *f)
{
    (void)f;
    return NULL;
}
#endif

/* Adds light that all pixels get. Returns 0 if it is too bright: cells know how its limit bends it. */
GN_HOT static int add_whole_light(gn_facet *f, const uint32_t radiance_uq16[3], const int32_t cosine_q24[3],
                                  uint32_t share)
{
    int32_t most = 0;
    for (int k = 0; share && k < 3; k++) {
        int32_t v = gn_cell_share(cosine_q24[k], share);
        GN_UNROLL
        for (int c = 0; c < 3; c++) {
            f->colour_q24[c][k] += gn_corner_times(radiance_uq16[c], v);
            most = gn_max32(most, f->colour_q24[c][k]);
        }
    }
    return most <= 1 << 27;
}

/* What a light adds at the vertices; it may be negative there. */
GN_HOT static void find_light_slopes(gn_facet *f, gn_facet_light *out, const uint32_t radiance_uq16[3],
                                     const int32_t e[3])
{
    for (int c = 0; c < 3; c++) {
        int32_t at[3];
        for (int k = 0; k < 3; k++) {
            int32_t v = gn_corner_times(radiance_uq16[c], (int32_t)gn_abs32(e[k]));
            at[k] = e[k] < 0 ? -v : v;
        }
        gn_facet_slope(&f->screen, &out->colour_q24[c], at);
    }
}

/* Adds a light. Returns 0 if the triangle is to be shaded by cells. */
GN_HOT static inline int add_vertex_light(gn_facet *f, uint32_t slot)
{
    const gn_surface_light *light = &f->s->surface.light[slot];
    const gn_lattice_light *lattice_light = &f->s->lattice.light[slot];
    gn_facet_light *out = &f->light[f->n_lights];
    int32_t e[3];
    int said = GN_CELL_LIT;
    if (f->n_lights == GN_FACET_LIGHTS) return 0;
    out->has_rim = 0;
    if (light->state->kind == GN_LIGHT_DIRECTIONAL) {
        if (!find_cosines(f, light, e)) return 1;
    } else {
        said = find_punctual(f, slot, out, e);
        if (said != GN_CELL_LIT) return said == GN_CELL_DARK;
    }
    const int32_t most = gn_max32(e[0], gn_max32(e[1], e[2]));
    if (gn_cell_is_limited(&f->s->surface, light->radiance_uq16, most)) return 0;
#if GN_SPECULAR
    if (f->s->surface.specular && gn_facet_shines(f->s, slot)) return 0;
#endif
    int ends = (e[0] | e[1] | e[2]) < 0 || out->has_rim;
    if (gn_facet_shows_shadow(f) && (e[0] != e[1] || e[0] != e[2])) return 0;
    if (lattice_light->realtime) said = gn_facet_shadow(f->s, &f->screen, vertices_of(f), f->n_px, slot, &out->edge);
    if (said == GN_CELL_SPLIT || (said == GN_CELL_EDGE && most >= 1 << 27)) return 0;
    uint32_t share = said == GN_CELL_DARK ? lattice_light->dark_uq16 : lattice_light->lit_uq16;
    if (gn_cell_hides(light->radiance_uq16, most, share)) return 0;
    out->turns = f->turns && !(light->state->kind == GN_LIGHT_DIRECTIONAL && GN_K(f->s->frame, vertex_light));
    if (said != GN_CELL_EDGE && (!share || !(ends || out->turns != f->turns)))
        return add_whole_light(f, light->radiance_uq16, e, share);
    if (!gn_facet_use_screen(f) || f->screen.bent) return 0; /* edges and ends would show that */
    find_light_slopes(f, out, light->radiance_uq16, e);
    out->has_edge = said == GN_CELL_EDGE;
    out->lit_uq16 = share;
    out->dark_uq16 = lattice_light->dark_uq16;
    f->n_lights++;
    return 1;
}

/* Before light: ambient, and what the surface emits. */
GN_HOT static void begin_colours(gn_facet *f)
{
    for (int c = 0; c < 3; c++) {
        uint32_t base_q20 = f->s->surface.base_q20[c];
        f->base_q24[c] = (int32_t)(base_q20 > 1U << 23 ? 1U << 23 : base_q20) << 4;
        f->colour_q24[c][0] = f->colour_q24[c][1] = f->colour_q24[c][2] = 0;
    }
}

GN_HOT int gn_facet_shade(gn_shading *s, const gn_rect *box, int32_t n_px)
{
    const gn_surface *surface = &s->surface;
    gn_facet *f = &s->lattice.from.facet;
    const int32_t most = gn_facet_most_px(surface);
    if (box->x1 - box->x0 > most || box->y1 - box->y0 > most) return 0;
    if (surface->masked | surface->baked | surface->joined || GN_GLOWS(surface)) return 0;
    f->s = s;
    f->screen.found = f->screen.steep = 0;
    if (surface->plane.det <= 0 || !find_turns(f)) return 0;
    /* of a large one pixels may be few, but not light: cells are quicker */
    if ((surface->shadowed | surface->n_punctual) && !gn_facet_use_screen(f)) return 0;
    if (!use_vertices(f)) return 0;
#if GN_SHADOWS
    gn_corner_begin_box(&s->lattice, s->frame, surface, box);
#endif
    f->n_px = (int16_t)n_px;
    f->width = (int16_t)(box->x1 - box->x0);
    f->n_lights = 0;
    begin_colours(f);
    for (int c = 0; c < 3; c++) /* limited before it is multiplied: cells know */
        if (surface->base_q20[c] > 1U << 23 && (GN_COLOURED(surface) || surface->textured)) return 0;
    for (uint32_t slot = 0; slot < surface->n_lights; slot++)
        if (!add_vertex_light(f, slot)) return 0;
    GN_COUNT(facets, 1);
    return gn_facet_draw(f);
}

#endif
