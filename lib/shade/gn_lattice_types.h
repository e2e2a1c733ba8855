/* Cells, between whose corners light is interpolated, and parts of surfaces. */
#ifndef GN_LATTICE_TYPES_H
#define GN_LATTICE_TYPES_H

#include "shade/gn_surface_types.h"
#include "shadow/gn_shadow_types.h"

/* ---- Cells: gn_lattice.h --------------------------------------------------------------------------------------------
 */

/* A light at a corner of cells. */
typedef struct {
    int32_t irradiance_q24; /* of a light whose colour is 1, before shadows; of cells at most 2^27 */
#if GN_MASKS
    int32_t mask_q16; /* beyond 0 and 1 at corners outside of the triangle */
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
    uint8_t placed; /* the view that u, v and depth are of, GN_VIEW_NONE: none yet; and GN_BY_FORMS */
    uint8_t seen;   /* what gn_corner_place() returns: 0 nearer to the light than the view's near plane */
#endif
} gn_corner_light;

#define GN_VIEW_NONE 7 /* all bits that views have */
#define GN_BY_FORMS  8 /* forms on the screen told the place */

enum { GN_CORNER_DARK = -128, GN_CORNER_FULLY = 127 };

enum { GN_CORNER_KNOWN = 1, GN_CORNER_UNSEEN };

/* A surface's plane at the centre of a pixel, which may lie outside of the triangle. */
typedef struct {
    uint8_t state;
    uint8_t cascade;
    int16_t x, y;
    int32_t z_q16;
    uint32_t g_uq16, fade_uq16; /* shadow strength; share of the cascade in the blend with the next */
    int32_t base_q20[3];        /* ambient and baked light: -2^23 .. 2^30, of cells up to 2^23 */
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
    int32_t fits;    /* it was found */
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

#if GN_INTERPOLATES
/* Bilinear over a cell, (x, y) from its first pixel: at + x dx + y dy + x y dxy. */
typedef struct {
    int32_t at, dx, dy, dxy;
} gn_flat_patch;

/* A light whose shadow has an edge in the cell. */
typedef struct {
    const gn_light_view *view;
    gn_window *window; /* NULL: none */
    uint8_t slot, view_idx;
    uint8_t bent; /* rows are placed each for itself */
    gn_flat_patch u_q16, v_q16, depth_q30;
    gn_flat_patch more_q24[3]; /* what it adds where it is not in shadow; of the second of two faces, which adds the
                             same, the first one tells the border between them */
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
} gn_lattice_look;

#if GN_TEXTURES
/* A value down the rows of a cell, t pixels from the first: from + down t + bent t (t - size). */
typedef struct {
    int32_t from, down, bent;
} gn_texture_column;

/* A coordinate in texels, k pixels from the left column: left + step k + bend k (k - size), as if no value were
 * rounded. Fraction bits: left 17, 21, 25; step 21, 21, 25, and a half of 2^-17; bend 25, and a half of 2^-17. */
typedef struct {
    gn_texture_column left, step, bend;
} gn_texture_axis;

typedef struct {
    gn_texture_axis axis[2]; /* u, v */
} gn_texture_patch;

/* The textures of a cell. */
typedef struct {
    const gn_texture *texture; /* of its colours, or a level of that; NULL: none */
    gn_texture_patch uv;
#if GN_GLOW_TEXTURES
    const gn_texture *glow; /* of light that it emits, or a level of that; NULL: none */
    gn_texture_patch glow_uv;
    gn_texture glow_level;
#endif
#if GN_MIPMAPS
    uint32_t level_ends;        /* 1: two levels of the texture meet in the cell, */
    gn_flat_patch nearness_q30; /* by the least depth over the pixel's: */
    int32_t end_q30;            /* the finer one's pixels are above it, and the others not; */
    uint32_t other;             /* which are drawn now: all ones, or 0 */
#endif
} gn_cell_textures;
#endif

/* A cell that is drawn. */
typedef struct {
    struct gn_shading *s;
    int32_t x, y, size_log2;
    gn_flat_patch base_q24[3]; /* colours without the light of edges */
    int32_t first, n;          /* nodes of a row: from this pixel on */
    gn_pixel_line line;
#if GN_TEXTURES
    gn_cell_textures textures;
#endif
} gn_drawing;

/* A window that is to be made before the cell can be looked at. */
typedef struct {
    int32_t slot; /* -1: none */
    uint32_t view_idx;
    uint32_t used, n_used; /* a bit for each view whose window the look uses, and how many */
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
    uint64_t kink_q24;    /* the part of it that comes from where a light ends, or is near */
    gn_lattice_look *out;
} gn_lattice_cell;

#if GN_SHADOWS
/* Where one view sees the corners of a cell. */
typedef struct {
    const gn_light_view *view;
    gn_window *window;
    uint32_t view_idx;
    int bent;    /* GN_PLACES_... */
    int outside; /* of the tile, so that bias goes along rays: forms on the screen do not say where */
    int32_t u[4], v[4], depth[4];
} gn_cell_places;
#endif

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

#if GN_SHADOWS
/* Tile coordinates of places of a part. */
typedef struct {
    int32_t lo[2], hi[2];
} gn_seen_box;

/* What a window is made of: places in a view of a light of the list. */
typedef struct {
    uint32_t slot, view_idx;
    gn_seen_box all;
} gn_seen_places;
#endif

/* A cell that is being split into four. */
typedef struct {
    int16_t x, y;
    uint8_t size_log2, next; /* the quarter to be shaded next */
} gn_split_cell;

/* ---- Parts: gn_part.c --------------------------------------------------------------------------------------------
 */

/* A view of the light whose shadow has an edge in the part. */
typedef struct {
    const gn_light_view *view;
    gn_window *window;     /* NULL: none */
    int said;              /* of the whole part */
    int32_t offset_q16[3]; /* of receivers */
} gn_part_view;

enum { GN_CHUNK_LOG2 = 4, GN_CHUNK = 1 << GN_CHUNK_LOG2 }; /* pixels of a row between two places */

/* What falls on a part. */
typedef struct {
    uint32_t dark_q20[3], more_q20[3]; /* without and with the light whose shadow has an edge */
    uint32_t lit, dark;                /* their pixels */
    uint8_t mixed;                     /* whether there is such a light, */
    uint8_t slot, cascaded;            /* which one, and whether it has cascades: */
    gn_part_view view[4];              /* of them those that the part looks into */
    uint32_t attenuation[2][GN_CHUNK]; /* of pixels of a row, in a view and in the next cascade, */
    uint32_t missed;                   /* and a bit for each that these do not tell of */
} gn_part;

/* Corners that are kept: 9 of a cell that is split, and some that its neighbour asks for. */
enum { GN_CORNERS = 12 };

#define GN_LATTICE_NODES 16 /* pixels in a row of the largest cell */
#endif

/* Shadows may fade with distance, or end. */
#define GN_VIEWS_FADE 32

/* A surface, block by block or pixel by pixel. */
typedef struct gn_lattice {
    gn_corner corner; /* of a pixel, or a window */
#if GN_PLANES && GN_SHADOWS
    const gn_light_view *slope_view; /* a view, NULL: none, */
    int32_t slope_q28[2];            /* and the slopes of the surface in it */
#endif
#if GN_INTERPOLATES
    gn_run_span span[GN_SPANS]; /* pixels of the surface, top down and left to right */
    int32_t n_spans;
    gn_screen_plane plane; /* of the block */
    gn_lattice_light light[GN_SURFACE_LIGHTS];
#if GN_PUNCTUAL_LIGHTS && GN_SHADOWS
    gn_view_forms forms[GN_VIEW_FORMS]; /* of the surface */
#endif
    struct {
        uint8_t known, found; /* whether it has been looked for, and is there */
        int16_t x, y;
        int32_t z_q16, ray_q16[3];    /* and the way from the eye, along the world's axes */
    } anchor;                         /* of the block: a pixel where the surface's plane is seen */
    const gn_light_view *offset_view; /* flat surfaces: a directional view, NULL: none, */
    int32_t offset_q16[3];            /* and the receiver's offset in it */
    int16_t cascade;                  /* of all of the part, none of which fades; -1: of each point for itself */
    uint16_t views;                   /* views of cascades that the part may look into, a bit
                                         each, and GN_VIEWS_FADE */
    int16_t surface_cascade;          /* the same of the surface */
    gn_rect bounds;                   /* of the surface on the screen, no smaller than it */
    int32_t x, y;                     /* of the block of pixels at hand, 64 x 16 of the picture, */
    gn_rect block, seen;              /* what the surface may have of it, in cells, and what is visible */
    int32_t has_face, face_q30[3];    /* the face's normal, once something has asked for it */
    int32_t uniform;                  /* nothing but shadows varies over the surface */
    int32_t size_log2;                /* of the largest cells, in pixels */
    int32_t few;                      /* pixels: each for itself */
    int32_t part_x, part_end, part_y, part_bottom;   /* what windows hold together */
    uint32_t bits[GN_PART_WIDTH / 32][GN_PART_ROWS]; /* the block's pixels */
    union {
        gn_corner corners[GN_CORNERS]; /* those of the part that were asked for last */
        gn_part part;                  /* a part of one or two colours has none, */
        gn_patch patch;                /* nor a triangle that is no surface */
    } from;
    uint32_t corner_key[GN_CORNERS];       /* y * 2^16 + x; all ones: none */
    uint32_t corner_used[GN_CORNERS], now; /* when they were, counted */
    uint32_t next_corner;                  /* to be replaced */
    uint8_t corner_at[8][8];               /* which of them is that of a pixel, by bits of y and x */
    gn_split_cell split[2];                /* of 16 and 8 pixels, one in the other */
    gn_corner *cell_corner[4];             /* of the cell at hand: upper left, upper right, lower left, lower right */
#if GN_SHADOWS
    gn_window window[GN_WINDOWS];
#endif
    gn_lattice_look look;
    gn_drawing drawing; /* after that */
    union {
        int32_t node[GN_LATTICE_NODES][3]; /* colours of a row of a cell, Q24 */
        struct {
            gn_lattice_cell cell;
            gn_wanted_window ask;
            gn_contribution light;
#if GN_SHADOWS
            gn_cell_places places;
#endif
        } look; /* before it is drawn */
    } by;
#if GN_SHADOWS
    gn_levels levels; /* from one drawing to the next */
#endif
    union {
#if GN_SHADOWS
        gn_seen_places seen; /* while a window is made */
#endif
        uint32_t attenuation[GN_LATTICE_NODES]; /* of a row of pixels, until their colours are known */
#if GN_TEXTURES
        gn_texel_rgb texel[16]; /* of a row of pixels, then */
#endif
    } row;
#if GN_GLOW_TEXTURES
    gn_texel_rgb glow[16]; /* the same of the texture of emitted light */
#endif
#endif
} gn_lattice;

/* ---- What shading works on --------------------------------------------------------------------------------------- */

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
    gn_normals normals; /* of the object at hand */
    gn_surface surface;
    const gn_tri_source *tri;
#if GN_INTERPOLATES
    gn_tri_source root; /* the first triangle of the surface's plane */
#endif
    uint32_t last_q20[3]; /* the last radiance and its pixel: neighbours are often equal */
    uint32_t last_pixel;
#if GN_LAYERS_MAX
    gn_mixture mixture;
#endif
#if GN_INTERPOLATES
    gn_patch_shared patches;
#endif
    gn_lattice lattice;
} gn_shading;

#endif
