/* What a core keeps while it works on a tile: in its gn_scratch, for a stack is small. Private, like gn_state.h, which
 * includes it. The functions that use these types say what they mean: gn_plane.h, gn_texture.h, gn_surface.h,
 * gn_sample.h, gn_chord.h, gn_pixel.h, gn_shade.c, gn_alpha.h, gn_caster.h, gn_ortho.c, gn_atlas.c.
 */
#ifndef GN_SHADING_H
#define GN_SHADING_H

#include "base/gn_q.h"
#include "geometry/gn_walk.h"

/* Pixels whose centres lie in the triangle's bounding box, cut to the picture: x0 <= x < x1, y0 <= y < y1. */
typedef struct {
    int32_t x0, y0, x1, y1;
} gn_rect;

typedef struct {
    int32_t n[3]; /* face normal, away from the viewer for a front face, |n| < 2^30, power-of-two scale n_exp */
    int32_t n_exp;
    int64_t det;  /* n . v0, positive after gn_plane_setup; 0: edge on or degenerate */
    int32_t back; /* 1: seen from behind (n has been negated) */
} gn_plane;

/* Perspective-correct barycentrics b1, b2 of a triangle: (form . ray) / (n . ray) * 2^exp, NUMERICS 4.3. */
typedef struct {
    int32_t form[2][3];
    int32_t exp[2];
} gn_bary;

#if GN_TEXTURES
/* Texture coordinates of a triangle: vertex 0, then differences of vertices 1 and 2 to it. */
typedef struct {
    int64_t uv_q16[3][2];
} gn_texture_triangle;
#endif

/* A light of the surface's list. */
typedef struct {
    const gn_light_state *state;
    uint32_t idx;
    uint32_t radiance_uq16[3]; /* albedo times colour */
    /* where the normal is constant, for directional lights: n . L, and the receiver's offset in texels; B6: what
     * gn_bias_auto_face says */
    int32_t flat_cosine_q24;
    int32_t flat_offset_q16[3];
#if GN_RUNTIME_KNOBS || GN_VERTEX_LIGHT
    int32_t vertex_cosine_q24[3]; /* at vertex 0, and differences of the others to it; smooth surfaces and directional
                                     lights only */
#endif
} gn_surface_light;

typedef struct {
    const gn_object *object;
    uint8_t has_bary, smooth, coloured, textured, masked, baked, specular;
    uint8_t shadowed; /* some light's shadow may fall on it */
    int32_t first_value, n_values;
    uint32_t n_lights, n_punctual;
    uint32_t
        base_q20[3]; /* albedo times ambient: with the lights' radiance_uq16, weighted, it sums up to the radiance */
    gn_plane plane;
    gn_bfloat depth_scale; /* det * 2F: Z = depth_scale / (n . ray) */
    int32_t z_min_q16, z_max_q16;
    gn_bary bary;
    int32_t normal_q30[3]
                      [3]; /* vertex 0, then differences of vertices 1 and 2 to it; flat: the face normal and zeros */
    int32_t rgb_q16[3][3]; /* likewise for vertex colours */
#if GN_TEXTURES
    gn_texture_triangle uv;
#endif
#if GN_MASKS
    int32_t mask_q16[3][4];
#endif
#if GN_BAKED_LIGHT
    int32_t baked_q16[3][3];
#endif
#if GN_RECEIVER_PLANE || GN_AUTO_BIAS
    int32_t face_q30[3]; /* normal of the face in the world; only where some light of the list asks for it */
#endif
#if GN_AUTO_BIAS
    int32_t lift_q30[3]; /* curved: what its normal is off by for B6; likewise */
#endif
    gn_surface_light light[GN_SURFACE_LIGHTS]; /* those that can reach it */
} gn_surface;

/* What a build without any cannot have. */
#define GN_SMOOTH(s) (GN_VERTEX_NORMALS && (s)->smooth)
#define GN_CURVED(s)                                                                                                   \
    (GN_VERTEX_NORMALS && (s)->smooth > 1) /* by 2^-10 or more: B6 takes the interpolated normal, with */
#define GN_BENT(s)     ((s)->smooth > 2)   /* corners that turn away from the face: only lift_q30 */
#define GN_COLOURED(s) (GN_VERTEX_COLOURS && (s)->coloured)
#define GN_HAS_BARY(s)                                                                                                 \
    ((GN_VERTEX_NORMALS || GN_VERTEX_COLOURS || GN_TEXTURES || GN_MASKS || GN_BAKED_LIGHT) && (s)->has_bary)

/* Keeps what neighbouring triangles of a screen tile share. */
typedef struct {
    const gn_object *object;
    union {
        gn_xform to_view; /* where size comes first */
        gn_xform_fast fast;
    } by; /* of the current object */
    int32_t normal_matrix[3][3];
    uint64_t lights; /* R9: a bit per light that can reach the screen tile */
} gn_surface_cache;

/* Values sampled at a pixel and stepped linearly between samples. The first groups only where a surface has them. */
enum {
    GN_VALUE_UV = 0,                                     /* 2: texture coordinates, Q20 */
    GN_VALUE_MASK = GN_VALUE_UV + (GN_TEXTURES ? 2 : 0), /* 4: shadow masks, Q16; or 2: coordinates of the mask image */
    GN_VALUE_BAKED = GN_VALUE_MASK + (GN_MASKS ? 4 : 0), /* 3: irradiance, Q16 */
    GN_VALUE_Z = GN_VALUE_BAKED + (GN_BAKED_LIGHT ? 3 : 0), /* view depth, Q16 */
    GN_VALUE_FADE,                                          /* D6 factor of the cascade, Q16 */
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

#if GN_PUNCTUAL_LIGHTS
/* What arrives at a sample from a spot or point light: gn_arrival.h. */
typedef struct {
    uint32_t irradiance_q24; /* of a light whose colour is 1 */
#if GN_SHADOWS
    int32_t u_q16, v_q16;
    uint32_t depth_q32;
#endif
    uint8_t reaches; /* 0: nothing arrives, and the rest means nothing */
#if GN_SHADOWS
    uint8_t face; /* of the light's views */
#endif
#if GN_ARRIVAL_STEPS
    uint8_t side;   /* of what nothing is stepped across */
    uint8_t shadow; /* what bounds of depth say */
#endif
} gn_arrival;

enum { GN_SHADOW_UNDECIDED, GN_SHADOW_NONE, GN_SHADOW_FULL };

/* Within a spot's inner cone; where B6 goes along the ray. */
enum { GN_SIDE_INNER = 1, GN_SIDE_DEPTH = 2 };

/* Between two samples: irradiance, U, V and depth. */
typedef struct {
    int32_t holds; /* 0: found again at every pixel */
    int32_t step[4], bend[4];
    int32_t at[3]; /* U and V, Q20, and 1 - depth, Q32 * 2^(up - 2) */
    int32_t up;
} gn_arrival_steps;
#endif

#define GN_CASCADE_NONE 4

typedef struct {
    int32_t cascade;       /* of the surface point, GN_CASCADE_NONE: none */
    int32_t in_reach;      /* D11: near enough to the camera for shadows */
    int32_t x, y;          /* the pixel */
    int32_t normal_q15[3]; /* interpolated, not renormalised; lit smooth surfaces only */
    int32_t value[GN_VALUE_COUNT];
#if GN_PUNCTUAL_LIGHTS
    gn_arrival arrival[GN_SURFACE_LIGHTS]; /* of spot and point lights */
#endif
#if GN_SPECULAR
    int32_t normal_q30[3], to_eye_q30[3]; /* unit; surfaces with highlights only */
#endif
} gn_sample;

/* Between two samples: gn_chord.h. */
typedef struct {
    int32_t step[GN_VALUE_COUNT]; /* from the first pixel to the next */
    int32_t bend[GN_VALUE_COUNT]; /* what the step grows by per pixel */
    int32_t end;                  /* of the values that are stepped */
    int32_t bend_first, bend_end; /* the others' steps stay */
#if GN_ARRIVAL_STEPS
    gn_arrival_steps arrival[GN_SURFACE_LIGHTS];
#endif
} gn_chord;

/* Where a screen tile's pixels are stored. */
typedef struct {
    gn_tile_pixels *pixels;
    int32_t width;  /* pixels per row of the tile */
    int32_t x0, y0; /* of the tile in the picture: the dither's pattern stands still in the picture */
} gn_pixel_rows;

#if GN_PIECES
/* Linear on the screen: at a place, and its change per pixel to the right and down. */
typedef struct {
    int32_t at, dx, dy;
} gn_slope;

/* Of second order: x, y pixels from the place, v = at + dx x + dy y + dxx x^2 + dxy x y + dyy y^2. */
typedef struct {
    gn_slope slope_q24;
    int32_t dxx_q28, dxy_q28, dyy_q28;
} gn_curve;

#if GN_TURNING
/* N, the normal times n . ray over that of the middle, is linear over a piece, with (x, y) from the middle. */
typedef struct {
    gn_slope facing_q28[GN_SURFACE_LIGHTS]; /* N . L */
    uint32_t size_q28, size_dx, size_dy, size_dxx, size_dxy,
        size_dyy;        /* |N|^2: size + x (dx + x dxx + y dxy) + y (dy + y dyy) */
    uint32_t per_px_q16; /* how far it turns from pixel to pixel, at most; radians */
    uint32_t keep_uq16;  /* of the light that casts a shadow, what this leaves */
} gn_turning;
#endif

typedef struct {
    const struct gn_frame *frame;
    const gn_surface *surface;
    int32_t ref_x, ref_y; /* the place of w, b */
    gn_slope w, b[2];     /* n . ray and the barycentrics times it, at one scale: 0 < w < 2^27 on the triangle */
    int32_t z_shift;      /* view depth = depth_scale.mant * (2^63 / w normalised) / 2^32 >> z_shift - clz(w) */
    int32_t shadow_slot;  /* in the surface's list, of the light whose shadow may fall on it; -1: none */
    /* the piece: around (x, y) */
    int32_t x, y;
    int varies;      /* colours are not one all over */
    int32_t ramp_px; /* how long a row of pixels may be of one ramp */
    int turns;       /* normals do: what arrives is not in the slopes */
#if GN_TURNING
    int32_t tint_px; /* how long the colours of vertices are linear in a row */
    gn_turning turning;
#endif
    int looks_up;             /* 0: dark all over */
    int tinted;               /* times the colours of vertices; otherwise these are in it */
    int steep;                /* curves are of factors times 1 / (1 + t), t the change of w; else of it all */
    gn_curve dark[3], lit[3]; /* without and with the light */
    gn_slope tint_q24[3];
    uint32_t dark_pixel, lit_pixel; /* packed, where nothing varies */
    int32_t w_dx_q30, w_dy_q30;     /* change of w per pixel, relative to w */
#if GN_SHADOWS
    const gn_light_view *view;
    int32_t offset_q16[3];                     /* the receiver's in texels: what is the same all over, */
    int32_t along_q16;                         /* and along the interpolated normal as it is */
    gn_slope place[3];                         /* where the light sees the piece: texels, Q16; U, V and depth D */
    int32_t depth_up, depth_least, depth_most; /* D to a share of the range, Q31, by a shift, and its limits */
    int32_t chunk_px;                          /* how many pixels may be stepped from end to end */
    int32_t x0, y0;                            /* the corner of the piece */
    uint32_t cells;                            /* what is known of its cells, 2 bits each */
    int32_t cell_reach[3];                     /* of U, V, D from the middle of a cell to its corners */
#endif
} gn_pieces;
#endif

/* The tile, and the triangle at hand. */
typedef struct {
    const struct gn_frame *frame;
    struct gn_scratch *scratch;
    gn_rect rect;
    gn_pixel_rows rows;
    gn_surface_cache cache;
    gn_surface surface;
    const gn_tri *tri;
    uint32_t last_q20[3]; /* the last radiance and its pixel: neighbours are often equal */
    uint32_t last_pixel;
    uint32_t radiance_q20[3];
#if GN_PIECES
    gn_rect spanned, part; /* of the screen: by the triangle, what is shaded now */
#endif
    union {
        struct {
            gn_sample sample[2]; /* the run's last exact one and the next */
            gn_chord chord;
        } run;
#if GN_PIECES
        gn_pieces pieces;
#endif
    } by; /* how the surface is shaded */
} gn_shading;

/* ---- Triangles that alpha cuts ----------------------------------------------------------------------------------- */

#if GN_CASTER_ALPHA || GN_VISIBLE_ALPHA
#if GN_ALPHA_STEPS
/* An exact place in a row; n . ray there as gn_ray_recip has it, w_norm 0: nothing is seen. */
typedef struct {
    int32_t x, uv_q20[2];
    uint32_t w_norm;
    int32_t clz;
} gn_alpha_exact;

/* Texture coordinates of first <= x < end, k pixels on: from + k step + k (k - 1) / 2 bend. */
typedef struct {
    int32_t first, end;
    int32_t hold; /* 0: they are found one by one */
    int32_t from_q20[2], step_q24[2], bend_q24[2];
} gn_alpha_steps;
#endif

/* One triangle of an object, as the camera or a light sees it, and a row of it: gn_alpha.h. */
typedef struct {
    const gn_object *object;
    gn_alpha mode;
    int textured; /* 0: the object's own alpha all over */
    int32_t y, py;
#if GN_TEXTURES
    gn_texture_triangle uv;
    gn_plane plane;
    gn_bary bary;
    uint32_t focal2_px_q16;
    int32_t width, newton_steps;
#endif
#if GN_ALPHA_STEPS
    int32_t px_per_step, x_begin, x_end;
    gn_alpha_exact exact; /* the last one found */
    gn_alpha_steps steps;
#endif
} gn_alpha_cut;
#else
typedef void gn_alpha_cut;
#endif

/* ---- Clipping ---------------------------------------------------------------------------------------------------- */

#define GN_CLIP_VERTICES_MAX 8 /* a triangle against five planes */

typedef struct {
    int32_t v_q16[GN_CLIP_VERTICES_MAX][3]; /* X right, Y up, Z forward */
    int n;
} gn_polygon;

/* A triangle of the camera's or of a perspective light's. */
typedef struct {
    gn_polygon polygon, uncut;
    int32_t x[GN_CLIP_VERTICES_MAX], y[GN_CLIP_VERTICES_MAX]; /* projected */
} gn_clipping;

/* ---- Casters ----------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
/* A vertex as a view sees it, if it is within 2^29. */
typedef struct {
    uint32_t tag; /* object << 16 | vertex, plus one; 0: empty */
    int32_t c[3];
} gn_caster_corner;

/* One caster and one view. */
typedef struct {
    struct gn_frame *frame;
    const gn_light_view *view;
    const gn_object *object;
    uint32_t object_idx;
    int two_sided;
    gn_caster_corner *cache;
    uint32_t cache_mask;
    gn_caster_corner spare[3]; /* where a triangle's corners share an entry */
    gn_xform to_light;
    gn_xform_fast fast;
#if GN_CASTER_BIAS
    int32_t shrink_q16; /* B4, texels */
    int32_t normal_matrix[3][3];
#endif
} gn_caster_job;

#define GN_ORTHO_POLYGON_MAX 8 /* a triangle against four sides has 7; rounding may bend it once more */

/* Corners as a view sees them: U, V, D in texels, Q16; of perspective views in world units from the light. */
typedef struct {
    int64_t p[GN_ORTHO_POLYGON_MAX][3];
    int n;
} gn_light_polygon;

/* Whether casters are drawn that gn_ortho_small_triangle does not take. */
#define GN_LARGE_CASTERS (GN_CASTER_CLIPPING || GN_CASTER_ALPHA || GN_CASTER_BIAS || GN_PUNCTUAL_LIGHTS)

/* One triangle into one shadow tile. */
typedef struct {
    gn_caster_job job;
    gn_walk walk;
    gn_light_polygon polygon;
    union {
        gn_light_polygon uncut; /* orthographic */
        gn_clipping clipping;   /* perspective */
    } with;
#if GN_CASTER_ALPHA
    gn_alpha_cut alpha;
#endif
} gn_casting;
#endif

/* What one core does at a time. */
typedef union {
    gn_shading shading;
    gn_clipping clipping;
#if GN_VISIBLE_ALPHA
    gn_alpha_cut cut;
#endif
#if GN_SHADOWS
    gn_casting casting;
#endif
} gn_work;

#endif
