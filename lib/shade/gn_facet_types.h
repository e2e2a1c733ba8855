/* Values that are linear on the screen; small triangles: gn_facet.h. */
#ifndef GN_FACET_TYPES_H
#define GN_FACET_TYPES_H

#include "shadow/gn_shadow_types.h"

#if GN_INTERPOLATES

/* Linear on the screen: the value at a pixel, and its change per pixel to the right and down. */
typedef struct {
    int32_t at, dx, dy;
} gn_slope;

/* On the screen. */
typedef struct {
    int8_t found;            /* 0: not asked for yet; -1: it is large, deep or narrow */
    int8_t steep;            /* some value changes too fast */
    int8_t bent;             /* by more than a pixel */
    int8_t size_log2;        /* up to 16, 32 or 64 pixels: 0, 1 or 2 */
    int32_t x0, y0;          /* the pixel of vertex 0, from which others are counted: right and down */
    int32_t along_q24[2][2]; /* the change per pixel, right and down, of what is 1 more at vertex 1, or at vertex 2 */
    int32_t to_first_q13[2]; /* pixels from vertex 0 to the centre of its pixel, right and down */
} gn_facet_screen;

/* The vertices, along the world's axes. */
typedef struct {
    int32_t ray_q16[3][3], normal_q30[3][3]; /* from the eye; normals */
    uint32_t longest2_high, longest2_low;    /* the square of the longest edge, Q32: no alignment of 64 bits */
    uint32_t turn2_q28;                      /* that of the largest difference of normals */
} gn_facet_vertices;

/* A shadow that has an edge in the triangle: places of its pixels. */
typedef struct {
    const gn_light_view *view;
    gn_slope u_q16, v_q16, depth_q30;
    int32_t slope_q28[2];
    int32_t spacing_log2; /* pixels of a row between two that are looked up */
} gn_facet_edge;

#if GN_TEXTURES
/* Coordinates times 1 + e, where nearness is 1 + e times that of the middle depth: both are linear on the screen. */
typedef struct {
    const gn_texture *texture;
    int bent;                          /* 0: e is 0 */
    gn_slope e_q27, from_first_q17[2]; /* texels, from vertex 0 */
    int32_t first_q17[2];              /* of vertex 0, less half a texel if the texture is bilinear */
} gn_facet_texture;
#endif

/* A light that pixels ask for: its shadow has an edge in the triangle, or its light ends there. */
typedef struct {
    gn_slope colour_q24[3];       /* without its shadow */
    uint32_t lit_uq16, dark_uq16; /* what is left of it without a shadow, and in one */
    int turns;                    /* it is divided by the length of the normal */
    int has_rim, has_edge;
    gn_slope rim_q20;
    gn_facet_edge edge;
} gn_facet_light;

/* Quadratic on the screen: at + dx x + dy y + xx x^2 + xy x y + yy y^2, (x, y) to the right and down. */
typedef struct {
    gn_slope line;
    int32_t xx, xy, yy;
} gn_facet_curve;

/* What varies over the triangle. */
typedef struct {
    gn_slope colour_q24[3];
    gn_facet_curve length2_q22; /* of the normal, if it turns */
    gn_slope tint_q16[3];       /* the vertices' colours, if those are to be multiplied */
    int tinted, each;           /* nodes are all pixels */
} gn_facet_look;

enum { GN_FACET_LIGHTS = 3 };

/* A small triangle. */
typedef struct {
    struct gn_shading *s;
    gn_facet_screen screen;
    int16_t n_px, width;      /* visible pixels, and columns that they lie in */
    int turns;                /* light is divided by the length of the interpolated normal, */
    uint32_t turn_q28[3];     /* as they differ by so much, squared: vertices 0 and 1, 0 and 2, 1 and 2 */
    int32_t base_q24[3];      /* ambient, and what it emits */
    int32_t colour_q24[3][3]; /* light that pixels do not ask for: by channel, at the vertices */
    int32_t tint_q16[3][3];   /* colours of the vertices, likewise */
    int32_t n_lights;
    gn_facet_light light[GN_FACET_LIGHTS];
    gn_facet_look look;
#if GN_PUNCTUAL_LIGHTS
    gn_facet_vertices vertices; /* where spots or points are in the list */
#endif
#if GN_TEXTURES
    gn_facet_texture texture; /* where the surface is textured */
#endif
} gn_facet;

#endif

#endif
