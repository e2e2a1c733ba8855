/* Surfaces, exact samples of them, and the interpolation between samples. */
#ifndef GN_SHADE_TYPES_H
#define GN_SHADE_TYPES_H

#include "shadow/gn_shadow_types.h"
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
    uint8_t smooth;   /* its vertices' normals differ, */
    uint8_t curved;   /* by 2^-10 or more: automatic bias uses the interpolated normal */
    uint8_t bent;     /* a corner's normal points away from the face's: automatic bias uses only lift_q30 */
    uint8_t shadowed; /* some light's shadow may fall on it */
    uint16_t n_lights, n_punctual; /* not bytes: the compiler would reload those after every store */
    int16_t first_value, n_values;
    uint32_t albedo_uq16[3]; /* times the vertices' colours, where all three are equal; at most 2^16 */
    uint32_t base_q20[3]; /* albedo times ambient: with the lights' radiance_uq16, weighted, it sums up to radiance */
    gn_plane plane;
    gn_bfloat depth_scale; /* det * 2F: Z = depth_scale / (n . ray) */
    int32_t z_min_q16, z_max_q16;
    gn_bary bary;
    /* vertex 0, then differences of vertices 1 and 2 to it */
    int32_t normal_q30[3][3]; /* flat: the face normal and zeros */
    int32_t attribute_q16[3][GN_ATTRIBUTE_COUNT];
#if GN_TEXTURES
    gn_texture_triangle uv;
#endif
#if GN_RECEIVER_PLANE || GN_AUTO_BIAS
    int32_t face_q30[3]; /* normal of the face in the world; only if some light of the list needs it */
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
#define GN_HAS_BARY(s)                                                                                                 \
    ((GN_VERTEX_NORMALS || GN_VERTEX_COLOURS || GN_TEXTURES || GN_MASKS || GN_BAKED_LIGHT) && (s)->has_bary)

/* Cache of values that neighbouring triangles of a screen tile have in common. */
typedef struct {
    const gn_object *object;
    union {
        gn_xform to_view; /* with GN_SIZE_FIRST */
        gn_xform_fast fast;
    } by; /* of the current object */
    int32_t normal_matrix[3][3];
    uint64_t lights; /* a bit per light that can affect the screen tile */
} gn_surface_cache;

/* Values sampled at a pixel and stepped linearly between samples. The first groups only where a surface has them. */
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
#if GN_ARRIVAL_STEPS
    uint8_t side;   /* of what nothing is stepped across */
    uint8_t shadow; /* the verdict of depth bounds */
#endif
} gn_arrival;

enum { GN_SHADOW_UNDECIDED, GN_SHADOW_NONE, GN_SHADOW_FULL };

/* Flags: within a spot's inner cone; automatic bias goes along the ray. */
enum { GN_SIDE_INNER = 1, GN_SIDE_DEPTH = 2 };

/* Between two samples: irradiance, U, V and depth. */
typedef struct {
    int32_t holds; /* 0: computed again at every pixel */
    int32_t step[4], bend[4];
    int32_t at[3]; /* U and V, Q20, and 1 - depth, Q32 * 2^(up - 2) */
    int32_t up;
} gn_arrival_steps;

#define GN_CASCADE_NONE 4

typedef struct {
    int32_t cascade;       /* of the surface point, GN_CASCADE_NONE: none */
    int32_t in_reach;      /* near enough to the camera for shadows */
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
    int32_t bend[GN_VALUE_COUNT]; /* growth of the step per pixel */
    int32_t end;                  /* of the values that are stepped */
    int32_t bend_first, bend_end; /* the others' steps stay */
#if GN_ARRIVAL_STEPS
    gn_arrival_steps arrival[GN_SURFACE_LIGHTS];
#endif
} gn_chord;

/* Linear on the screen: the value at a pixel, and its change per pixel to the right and down. */
typedef struct {
    int32_t at, dx, dy;
} gn_slope;

/* Of second order: x, y pixels from that pixel, v = at + dx x + dy y + dxx x^2 + dxy x y + dyy y^2. */
typedef struct {
    gn_slope slope_q24;
    int32_t dxx_q28, dxy_q28, dyy_q28;
} gn_curve;

/* N, the normal times n . ray over that of the middle, is linear over a patch, with (x, y) from the middle. */
typedef struct {
    gn_slope facing_q28[GN_SURFACE_LIGHTS]; /* N . L */
    uint32_t size_q28, size_dx, size_dy, size_dxx, size_dxy,
        size_dyy;        /* |N|^2: size + x (dx + x dxx + y dxy) + y (dy + y dyy) */
    uint32_t per_px_q16; /* maximum angle between the normals of neighbouring pixels, radians */
    uint32_t keep_uq16;  /* of the light that casts a shadow: the remaining light */
} gn_turning;

typedef struct {
    const struct gn_frame *frame;
    const gn_surface *surface;
    int32_t ref_x, ref_y; /* the pixel of w, b */
    gn_slope w, b[2];     /* n . ray and the barycentrics times it, at one scale: 0 < w < 2^27 on the triangle */
    int32_t z_shift;      /* view depth = depth_scale.mant * (2^63 / w normalised) / 2^32 >> z_shift - clz(w) */
    int32_t shadow_slot;  /* in the surface's list, of the light whose shadow may fall on it; -1: none */
    /* the patch: around (x, y) */
    int32_t x, y;
    int varies;      /* colours vary over it */
    int32_t ramp_px; /* maximum pixels of a row in one ramp */
    int turns;       /* normals vary: the incident light is not in the slopes */
#if GN_TURNING
    int32_t tint_px; /* maximum pixels of a row with linear vertex colours */
    gn_turning turning;
#endif
    int looks_up;             /* 0: dark everywhere */
    int tinted;               /* times the colours of vertices; otherwise these are in it */
    int steep;                /* curves are of factors times 1 / (1 + t), t the change of w; else of it all */
    gn_curve dark[3], lit[3]; /* without and with the light */
    gn_slope tint_q24[3];
    uint32_t dark_pixel, lit_pixel; /* packed, where nothing varies */
    int32_t w_dx_q30, w_dy_q30;     /* change of w per pixel, relative to w */
#if GN_SHADOWS
    const gn_light_view *view;
    int32_t offset_q16[3];                     /* the receiver's offset in texels: the constant part, */
    int32_t along_q16;                         /* and the part along the interpolated normal, not normalised */
    gn_slope place[3];                         /* light-space coordinates of the patch: texels, Q16; U, V and depth D */
    int32_t depth_up, depth_least, depth_most; /* shift from D to a fraction of the depth range, Q31, and its limits */
    int32_t chunk_px;                          /* maximum pixels to step from end to end */
    int32_t x0, y0;                            /* the corner of the patch */
    uint32_t cells;                            /* the verdicts on its cells, 2 bits each */
    int32_t cell_reach[3];                     /* of U, V, D from the middle of a cell to its corners */
#endif
} gn_pieces;

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

#endif
