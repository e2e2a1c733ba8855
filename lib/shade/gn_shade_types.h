/* Surfaces, exact samples of them, and cells, between whose corners light is interpolated. */
#ifndef GN_SHADE_TYPES_H
#define GN_SHADE_TYPES_H

#include "shade/gn_facet_types.h"
#include "visible/gn_visible_types.h"

/* n . L of a directional light at the vertices, for Gouraud shading; otherwise at the first. */
#define GN_VERTEX_COSINES (GN_RUNTIME_KNOBS || GN_VERTEX_LIGHT ? 3 : 1)

/* A light of the surface's list. */
typedef struct {
    const gn_light_state *state;
    uint32_t idx;
    uint32_t radiance_uq16[3];             /* albedo times colour */
    int32_t cosine_q24[GN_VERTEX_COSINES]; /* directional: n . L at vertex 0, then differences of vertices 1 and 2 to
                                              it; smooth surfaces: only for Gouraud shading */
    int32_t flat_offset_q16[3]; /* directional, if the normal is constant: the receiver's offset in texels; automatic
                                   bias: the result of gn_bias_auto_face */
} gn_surface_light;

/* Attributes that a surface interpolates between its vertices, Q16: colour, shadow masks or coordinates of the mask
 * image, baked irradiance. Attributes that are not built take no memory. */
enum {
    GN_ATTRIBUTE_RGB = 0,
    GN_ATTRIBUTE_MASK = GN_ATTRIBUTE_RGB + 3,
    GN_ATTRIBUTE_BAKED = GN_ATTRIBUTE_MASK + (GN_MASKS ? 4 : 0),
    GN_ATTRIBUTE_COUNT = GN_ATTRIBUTE_BAKED + (GN_BAKED_LIGHT ? 3 : 0)
};

typedef struct {
    const gn_object *object;
    uint8_t has_bary, coloured, textured, masked, baked, specular;
#if GN_GLOW_APART
    uint8_t glows; /* its own light is not part of base_q20: colours of vertices or a texture, which would dim it, come
                      between */
#endif
    uint8_t smooth;   /* its vertices' normals differ, */
    uint8_t curved;   /* by 2^-10 or more: automatic bias uses the interpolated normal */
    uint8_t bent;     /* a corner's normal points away from the face's: automatic bias uses only lift_q30 */
    uint8_t shadowed; /* some light's shadow may fall on it */
    uint16_t n_lights, n_punctual; /* not bytes: the compiler would reload those after every store */
    int16_t first_value, n_values;
    uint32_t albedo_uq16[3]; /* times the vertices' colours, where all three are equal; at most 2^16 */
    uint32_t base_q20[3]; /* albedo times ambient, its own light: with the lights' radiance_uq16, weighted, it sums up
                             to radiance */
    gn_plane plane;
#if GN_ORTHOGRAPHIC
    gn_plane screen;      /* orthographic: the triangle at the camera's flat depth */
    int32_t depth_q16[3]; /* and its view depth: vertex 0, then differences of vertices 1 and 2 to it */
#endif
    gn_bfloat depth_scale; /* det * 2F: Z = depth_scale / (n . ray) */
    int32_t z_min_q16, z_max_q16;
    gn_bary bary;
#if GN_INTERPOLATES
    int32_t v_q16[3][3]; /* vertices in view space */
#endif
    /* vertex 0, then differences of vertices 1 and 2 to it */
    int32_t normal_q30[3][3]; /* flat: the face normal and zeros */
    int32_t attribute_q16[3][GN_ATTRIBUTE_COUNT];
#if GN_TEXTURES
    gn_texture_triangle uv;
#endif
#if GN_MIPMAPS
    uint64_t level_depth2_q32; /* gn_texture_level_depth2(), of textures that have levels */
    gn_texture level;          /* the one that was used last */
    uint32_t level_idx;
#endif
#if GN_GLOW_TEXTURES
    const gn_texture *glow; /* of light that it emits, or NULL */
#if GN_MIPMAPS
    uint64_t glow_depth2_q32; /* the same of it */
#endif
#endif
#if GN_PLANES || GN_AUTO_BIAS
    int32_t face_q30[3]; /* normal of the face in the world; only if some light of the list needs it */
#define GN_FACE_Q30(surface) ((surface)->face_q30)
#else
#define GN_FACE_Q30(surface) ((surface)->normal_q30[0])
#endif
#if GN_AUTO_BIAS
    int32_t lift_q30[3]; /* curved: correction of the normal for automatic bias; likewise */
#endif
    gn_surface_light light[GN_SURFACE_LIGHTS]; /* lights that can affect it */
} gn_surface;

/* Properties of a surface: 0 in builds that cannot have them. */
#define GN_SMOOTH(s)   (GN_VERTEX_NORMALS && (s)->smooth)
#define GN_CURVED(s)   (GN_VERTEX_NORMALS && (s)->curved)
#define GN_BENT(s)     (GN_VERTEX_NORMALS && (s)->bent)
#define GN_COLOURED(s) (GN_VERTEX_COLOURS && (s)->coloured)
#if GN_GLOW_APART
#define GN_GLOWS(s) ((s)->glows)
#else
#define GN_GLOWS(s) ((void)(s), 0)
#endif
/* The texture that tells where the light is emitted; that whose coordinates the surface has, which both share. */
#if GN_GLOW_TEXTURES
#define GN_GLOW_TEXTURE(s)    ((s)->glow)
#define GN_SURFACE_TEXTURE(s) ((s)->object->texture ? (s)->object->texture : (s)->glow)
#else
#define GN_GLOW_TEXTURE(s)    ((void)(s), (const gn_texture *)NULL)
#define GN_SURFACE_TEXTURE(s) ((s)->object->texture)
#endif
#if GN_MIPMAPS
#define GN_LEVEL_DEPTH2(s) ((s)->level_depth2_q32)
#define GN_GLOW_DEPTH2(s)  ((s)->glow_depth2_q32)
#else
#define GN_LEVEL_DEPTH2(s) UINT64_MAX
#define GN_GLOW_DEPTH2(s)  UINT64_MAX
#endif
#define GN_HAS_BARY(s)                                                                                                 \
    ((GN_VERTEX_NORMALS || GN_VERTEX_COLOURS || GN_TEXTURES || GN_MASKS || GN_BAKED_LIGHT) && (s)->has_bary)

/* Cache of values that neighbouring triangles of a screen tile have in common. */
typedef struct {
    const gn_object *object;
    union {
        gn_xform to_view; /* with GN_SIZE_FIRST, and of skinned objects */
        gn_xform_fast fast;
    } by; /* of the current object */
    int32_t normal_matrix[3][3];
    uint64_t lights; /* a bit per light that can affect the screen tile */
} gn_surface_cache;

/* Values sampled at a pixel. The first groups only where a surface has them. */
enum {
    GN_VALUE_UV = 0,                                     /* 2: texture coordinates, Q20 */
    GN_VALUE_MASK = GN_VALUE_UV + (GN_TEXTURES ? 2 : 0), /* 4: shadow masks, Q16; or 2: coordinates of the mask image */
    GN_VALUE_BAKED = GN_VALUE_MASK + (GN_MASKS ? 4 : 0), /* 3: irradiance, Q16 */
    GN_VALUE_Z = GN_VALUE_BAKED + (GN_BAKED_LIGHT ? 3 : 0), /* view depth, Q16 */
    GN_VALUE_FADE,                                          /* fade factor of the last cascade, Q16 */
    GN_VALUE_RGB,                                           /* 3: interpolated vertex colour, Q16 */
    GN_VALUE_LIGHT = GN_VALUE_RGB + 3,                      /* the lights of the surface's list */
    GN_VALUES_PER_LIGHT = (GN_SHADOWS && GN_BLENDED_CASCADES) || GN_PUNCTUAL_LIGHTS ? 7
                          : GN_SHADOWS                                              ? 4
                                                                                    : 1,
    GN_VALUE_COUNT = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * GN_SURFACE_LIGHTS
};

/* Values of a light. Directional: n . L in Q24, tile coordinates U, V, D in Q16 texels, and those of the next cascade.
 * Spot and point: n . (light - point), the point from the light, and the receiver's offset, all in world axes and Q16
 * units. */
enum { GN_LIGHT_FACING, GN_LIGHT_POINT_AT, GN_LIGHT_OFFSET = 4 };

/* How a light arrives at a point: not at all; through the rim of a cone; fully. */
enum { GN_ARRIVES_NOT, GN_ARRIVES_RIM, GN_ARRIVES_FULLY };

/* Incident light of a spot or point light at a sample: gn_arrival.h. */
typedef struct {
    uint32_t irradiance_q24; /* of a light whose colour is 1 */
#if GN_SHADOWS
    int32_t u_q16, v_q16;
    uint32_t depth_q32;
#endif
    uint8_t reaches; /* 0: no light arrives, the other fields are undefined */
#if GN_SHADOWS
    uint8_t face; /* of the light's views */
#endif
} gn_arrival;

/* How a view sees a point: automatic bias along the normal leaves the tile there. */
#define GN_SEEN_OUTSIDE 2

#define GN_CASCADE_NONE 4

typedef struct {
    int32_t cascade;             /* of the surface point, GN_CASCADE_NONE: none */
    int32_t in_reach;            /* near enough to the camera for shadows */
    int32_t x, y;                /* the pixel */
    int32_t interpolated_q30[3]; /* normal, not renormalised; lit smooth surfaces only */
    int32_t value[GN_VALUE_COUNT];
#if GN_PUNCTUAL_LIGHTS
    gn_arrival arrival[GN_SURFACE_LIGHTS]; /* of spot and point lights */
#endif
#if GN_SPECULAR
    int32_t normal_q30[3], to_eye_q30[3]; /* unit; surfaces with highlights only */
#endif
} gn_sample;

#if GN_INTERPOLATES
/* ---- Cells: gn_lattice.h --------------------------------------------------------------------------------------------
 */

/* A light at a corner of cells. */
typedef struct {
    int32_t irradiance_q24; /* of a light whose colour is 1, before shadows; at most 2^27 */
#if GN_MASKS
    uint32_t mask_uq16;
#endif
#if GN_SHADOWS
    int32_t u_q16, v_q16, depth_q30;
#endif
#if GN_SPECULAR
    int32_t highlight_q24;
    int16_t lobe_q12[3]; /* of the highlight: the half vector minus the normal, unit vectors */
#endif
    int8_t arrives; /* how it does: GN_CORNER_DARK, GN_CORNER_FULLY, or in 32nds how far the corner is from the edge of
                     * a cone to where its rim ends: 32 or more fully, 0 or less not at all */
#if GN_SHADOWS
    uint8_t view;   /* of the light's views: where the point itself is looked up, GN_VIEW_NONE: nowhere */
    uint8_t placed; /* the view that u, v and depth are of; GN_VIEW_NONE: none yet */
    uint8_t seen;   /* what gn_arrival_place() returns: 0 nearer to the light than the view's near plane */
#endif
} gn_corner_light;

#define GN_VIEW_NONE 7

enum { GN_CORNER_DARK = -128, GN_CORNER_FULLY = 127 };

enum { GN_CORNER_NEW, GN_CORNER_KNOWN, GN_CORNER_UNSEEN };

/* A surface's plane at the centre of a pixel, which may lie outside of the triangle. */
typedef struct {
    uint8_t state;
    uint8_t cascade;
    int16_t x, y;
    int32_t z_q16;
    uint32_t g_uq16, fade_uq16; /* shadow strength; share of the cascade in the blend with the next */
    int32_t base_q24[3];        /* ambient and baked light */
#if GN_VERTEX_COLOURS
    int32_t tint_q16[3];
#endif
#if GN_TEXTURES
    int32_t uv_q20[2];
#endif
#if GN_MASKS
    int32_t mask_uv_uq16[2];
#endif
#if GN_VERTEX_NORMALS
    int32_t normal_q30[3]; /* interpolated, not renormalised */
#endif
#if GN_PUNCTUAL_LIGHTS
    int32_t ray_q16[3]; /* from the eye, world axes; surfaces with spots or points */
#endif
    gn_corner_light light[GN_SURFACE_LIGHTS];
} gn_corner;

/* Bilinear over a cell, (x, y) from its first pixel: at + x dx + y dy + x y dxy. */
typedef struct {
    int32_t at, dx, dy, dxy;
} gn_patch;

/* A light whose shadow has an edge in the cell. */
typedef struct {
    const gn_light_view *view;
    gn_window *window; /* NULL: none */
    uint8_t slot, view_idx;
    uint8_t bent;    /* rows are placed each for itself */
    uint8_t follows; /* the window is made anew for rows that it does not cover */
    gn_patch u_q16, v_q16, depth_q30;
    gn_patch more_q24[3]; /* what it adds where it is not in shadow; of the second of two faces, which adds the same,
                             the first one tells the border between them */
    int32_t slope_q28[2];
} gn_lattice_edge;

#define GN_LATTICE_EDGES 4

/* What a cell looks like. */
typedef struct {
    int32_t colour_q24[4][3];    /* at its corners, without the light of edges; without texture */
    int32_t highlight_q24[4][3]; /* in it */
    gn_lattice_edge edge[GN_LATTICE_EDGES];
    int32_t n_edges;
    int32_t texture_bends; /* where texture coordinates are quadratics: 1 along rows, 2 down columns */
#if GN_MIPMAPS
    uint8_t level, level_ends; /* of the texture where the cell is nearest; 1: the next one begins in the cell */
    uint8_t glow_level;        /* of the texture of emitted light */
#endif
    int32_t spacing_log2; /* of lookups in pixels */
} gn_lattice_look;

/* A window that is to be made before the cell can be looked at. */
typedef struct {
    int32_t slot;             /* -1: none */
    uint32_t view_idx, asked; /* a bit for each view that was */
} gn_wanted_window;

/* The cell at hand. */
typedef struct {
    struct gn_lattice *lattice;
    const struct gn_frame *frame;
    const gn_surface *s;
    gn_corner *const *corner;
    int32_t size_log2;
    uint32_t bend_q16[2]; /* by how much view depths differ along and across rows, as a share of the least */
    int near;             /* 1: no shadow fades at any corner; -1: one begins or ends to */
    uint64_t sides_q30;   /* of its sides, 0: not known yet */
    uint64_t error_q24;   /* of interpolated light, at most */
    uint64_t kink_q24;    /* the part of it that comes from where a light ends */
    gn_lattice_look *out;
    gn_wanted_window *ask;
} gn_lattice_cell;

/* A light at the corners: without its shadow, and what is left of that in shadow and without one. */
typedef struct {
    int32_t irradiance_q24[4], highlight_q24[4];
    uint32_t dark_uq16[4], more_uq16[4]; /* in shadow, and what is added to that without one */
    uint32_t shine_uq16[3];              /* colour of its highlight */
} gn_contribution;

/* Pixels of 1 / 64 steps between two colours, from dark to lit. */
typedef struct {
    int32_t two_q24[2][3];
    uint32_t known[3];
    uint32_t pixel[65];
} gn_levels;

/* A light of the surface's list, once per surface. */
typedef struct {
    uint8_t realtime; /* its shadow map counts, */
    uint8_t masked;   /* and its mask where shadows do not fade, too */
    uint8_t lifts;    /* the receiver's offset is along the normal, in proportion to the light-plane distance */
    uint32_t lit_uq16, dark_uq16; /* what is left of it without a mask, where shadows do not fade */
} gn_lattice_light;

/* A surface's plane on the screen, 32 bits: n . ray and the barycentrics times it, at one scale; orthographic: the
 * barycentrics themselves, Q28. */
typedef struct {
    int32_t x, y;       /* the pixel of w, b: the middle of */
    int32_t w_px, h_px; /* so many on each side of it, with what cells go beyond */
    gn_slope w, b[2];
    int32_t w_least; /* below it w is off by more than 2^-17: half a unit per pixel; 2^28 at most */
    int32_t z_shift; /* view depth = depth_scale.mant * (2^63 / w normalised) / 2^32 >> z_shift - clz(w) */
} gn_screen_plane;

#if GN_PUNCTUAL_LIGHTS && GN_SHADOWS
/* Where a perspective view sees a flat surface, on the screen: u / z and v / z are shares of 2^tile_log2 texels,
 * near / z is the share of its near distance in a point's. */
typedef struct {
    const gn_light_view *view; /* NULL: none */
    int32_t near_up;           /* near is 2^near_up times too large; INT32_MAX: there are none */
    int32_t z_least;           /* below it roundings matter */
    int32_t less_q30;          /* automatic bias: what is taken off depths, */
    int32_t in_tile;           /* and whether forms hold within the tile alone */
    gn_slope u, v, z, near;
} gn_view_forms;

enum { GN_VIEW_FORMS = 8 };
#endif

/* Pixels of a row. */
typedef struct {
    int16_t x, y, n_px;
} gn_run_span;

enum { GN_SPANS = 32, GN_PART_WIDTH = 64, GN_PART_ROWS = 16, GN_SMALLEST_CELL_LOG2 = 2 };

/* A directional view's coordinates of points in view space: texels, ray_shift fraction bits more than Q16. */
typedef struct {
    const gn_light_view *view; /* NULL: none */
    int32_t m[3][3];
} gn_view_matrix;

/* A cell that is being split into four. */
typedef struct {
    int16_t x, y;
    uint8_t size_log2, next; /* the quarter to be shaded next */
} gn_split_cell;

/* Corners that are kept: 9 of a cell that is split, and some that its neighbour asks for. */
enum { GN_CORNERS = 12 };

/* Shadows may fade with distance, or end. */
#define GN_VIEWS_FADE 32

#define GN_LATTICE_NODES 17 /* in a row of the largest cell */

/* A surface by cells. */
typedef struct gn_lattice {
    gn_run_span span[GN_SPANS]; /* pixels of the surface, top down and left to right */
    int32_t n_spans;
    gn_screen_plane plane;
#if GN_SHADOWS
    gn_view_matrix matrix; /* of the view that was used last */
#endif
    gn_lattice_light light[GN_SURFACE_LIGHTS];
#if GN_PUNCTUAL_LIGHTS && GN_SHADOWS
    gn_view_forms forms[GN_VIEW_FORMS]; /* of the surface */
#endif
    int32_t has_face, face_q30[3];    /* the face's normal, once something has asked for it */
    const gn_light_view *offset_view; /* flat surfaces: a directional view, NULL: none, */
    int32_t offset_q16[3];            /* and the receiver's offset in it */
#if GN_PLANES && GN_SHADOWS
    const gn_light_view *slope_view; /* a view, NULL: none, */
    int32_t slope_q28[2];            /* and the slopes of the surface in it, */
    int32_t slope_h_q14;             /* spots and points: found at this distance of the light from the plane */
#endif
    int32_t uniform;            /* nothing but shadows varies over the surface */
    int16_t cascade;            /* of all of the part, none of which fades; -1: of each point for itself */
    uint16_t views;             /* views of cascades that the part, or the small triangle, may look into, a bit
                                   each, and GN_VIEWS_FADE */
    int16_t surface_cascade;    /* the same of the surface */
    int32_t size_log2;          /* of the largest cells, in pixels */
    int32_t x, y, x_end, y_end; /* of the part, and where the surface ends */
    int32_t n_rows;             /* of the part */
    int32_t part_end;           /* columns before it */
    uint32_t bits[GN_PART_WIDTH / 32][GN_PART_ROWS]; /* its pixels */
    union {
        gn_corner corners[GN_CORNERS]; /* those of the part that were asked for last */
        gn_facet facet;                /* a surface that is shaded at once has no corners */
    } from;
    uint32_t corner_key[GN_CORNERS];       /* y * 2^16 + x; all ones: none */
    uint32_t corner_used[GN_CORNERS], now; /* when they were, counted */
    uint32_t next_corner;                  /* to be replaced */
    uint8_t corner_at[8][8];               /* which of them is that of a pixel, by bits of y and x */
    gn_split_cell split[2];                /* of 16 and 8 pixels, one in the other */
#if GN_SHADOWS
    gn_window window[GN_WINDOWS];
#endif
    gn_corner corner; /* of a window */
    gn_lattice_look look;
    union {
        int32_t node[3][GN_LATTICE_NODES][3]; /* colours of a row of a cell and the next, Q24; steps between */
        struct {
            gn_lattice_cell cell;
            gn_contribution light;
            gn_levels levels; /* from one drawing to the next */
        } look;               /* before it is drawn, or where it has two colours */
    } by;
    union {
        uint32_t attenuation[2][GN_LATTICE_NODES]; /* of two rows of nodes, until their colours are known */
#if GN_TEXTURES
        gn_texel_rgb texel[16]; /* of a row of pixels, then */
#endif
    } row;
#if GN_GLOW_TEXTURES
    gn_texel_rgb glow[16]; /* the same of the texture of emitted light */
#endif
} gn_lattice;
#endif

/* Two pixels as stored, how much of the first, and their mixture: neighbours are often equal. */
typedef struct {
    uint32_t front, behind, alpha_uq16, packed;
} gn_mixture;

/* The tile, and the triangle at hand. */
typedef struct gn_shading {
    const struct gn_frame *frame;
    struct gn_scratch *scratch;
    gn_rect rect;
    gn_pixel_rows rows;
    gn_surface_cache cache;
    gn_surface surface;
    const gn_tri_source *tri;
    uint32_t last_q20[3]; /* the last radiance and its pixel: neighbours are often equal */
    uint32_t last_pixel;
    uint32_t radiance_q20[3];
    gn_sample sample; /* at the pixel or corner at hand */
#if GN_LAYERS_MAX
    gn_mixture mixture;
#endif
#if GN_INTERPOLATES
    gn_lattice lattice;
#endif
} gn_shading;

#endif
