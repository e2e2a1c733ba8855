/* Parts of gn_facet: the pixels of a small triangle whose light at the vertices is known. */
#ifndef GN_FACET_DRAW_H
#define GN_FACET_DRAW_H

#include "shade/gn_facet_screen.h"
#include "shade/gn_facet_shadow.h"
#include "shade/gn_facet_texture.h"

#if GN_INTERPOLATES

/* A light that pixels ask for: its shadow has an edge in the triangle, or its light ends there. */
typedef struct {
    gn_slope colour_q24[3];       /* without its shadow */
    uint32_t lit_uq16, dark_uq16; /* what is left of it without a shadow, and in one */
    int turns;                    /* it is divided by the length of the normal */
    int has_rim, has_edge;
    gn_slope rim_q20;
    gn_facet_edge edge;
} gn_facet_light;

enum { GN_FACET_LIGHTS = 3 };

typedef struct {
    gn_shading *s;
    gn_facet_screen screen;
    int32_t n_px;
    int turns;                /* light is divided by the length of the interpolated normal, */
    uint32_t turn_q28[3];     /* as they differ by so much, squared: vertices 0 and 1, 0 and 2, 1 and 2 */
    int32_t base_q24[3];      /* ambient, and what it emits */
    int32_t colour_q24[3][3]; /* light that pixels do not ask for: by channel, at the vertices */
    int32_t tint_q16[3][3];   /* colours of the vertices, likewise */
    int32_t n_lights;
    gn_facet_light light[GN_FACET_LIGHTS];
#if GN_PUNCTUAL_LIGHTS
    gn_facet_vertices vertices; /* where spots or points are in the list */
#endif
#if GN_TEXTURES
    gn_facet_texture texture; /* where the surface is textured */
#endif
} gn_facet;

GN_HOT static inline int gn_facet_use_screen(gn_facet *f)
{
    return gn_facet_screen_use(&f->screen, f->s->frame, &f->s->surface);
}

/* A view of one light's shadow, in which the rest counts for nothing. */
GN_HOT static inline int gn_facet_shows_shadow(const gn_facet *f)
{
    return GN_RAW_VIEWS && f->s->frame->picture.format == GN_FORMAT_RAW32;
}

/* Draws its pixels, in the spans of the lattice. Returns 0 if something is too steep: nothing is drawn. */
int gn_facet_draw(gn_facet *f);

#endif

#endif
