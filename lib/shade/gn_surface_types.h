/* Surfaces, and small triangles that are shaded from their records. */
#ifndef GN_SURFACE_TYPES_H
#define GN_SURFACE_TYPES_H

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
#if GN_GLOW_APART
    uint8_t glows; /* its own light is not part of base_q20: colours of vertices or a texture, which would dim it, come
                      between */
#endif
    uint8_t smooth;                /* its vertices' normals differ */
    uint8_t shadowed;              /* some light's shadow may fall on it */
    uint8_t joined;                /* several triangles */
    uint16_t n_lights, n_punctual; /* not bytes: the compiler would reload those after every store */
    uint32_t albedo_uq16[3];       /* times the vertices' colours, where all three are equal; at most 2^16 */
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
    int32_t v_q16[3][3];          /* vertices in view space, */
    int32_t lo_q16[3], hi_q16[3]; /* and bounds of all of it */
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
#endif
#if GN_CHANGES
    gn_squares *squares; /* of the scratch: what is looked up */
#endif
    gn_surface_light light[GN_SURFACE_LIGHTS]; /* lights that can affect it */
} gn_surface;

/* Properties of a surface: 0 in builds that cannot have them. */
#define GN_JOINED(s)   (GN_INTERPOLATES && (s)->joined)
#define GN_SMOOTH(s)   (GN_VERTEX_NORMALS && (s)->smooth)
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
    gn_xform to_view;
} gn_surface_cache;

/* How a view sees a point: automatic bias along the normal leaves the tile there. */
#define GN_SEEN_OUTSIDE 2

#define GN_CASCADE_NONE 4

/* Shadows at a point. */
typedef struct {
    int32_t cascade;    /* GN_CASCADE_NONE: none */
    uint32_t fade_uq16; /* the fade factor of that cascade, D6 */
    uint32_t g_uq16;    /* g of MODEL 4, what distance leaves of shadows, 65536: all; the same for every light */
} gn_cascade_point;

/* ---- Patches ----------------------------------------------------------------------------------------------------- */

/* Small triangles, shaded from their records. Values are slopes on the screen. */

enum { GN_PATCH_PX = 32 /* the largest box, each way */, GN_PATCH_ROW_PX = 16 /* pixels that are drawn at a time */ };

/* A value at a pixel, and what it changes by there per pixel to the right and down. */
typedef struct {
    int32_t at, dx, dy;
} gn_slope;

/* Linear along a row of pixels. */
typedef struct {
    int32_t at, step;
} gn_row_value;

/* A piece of a row of a deep record, between two of its pixels: what slopes count for at both, and 2^31 over the pixels
 * from the one to the other. */
typedef struct {
    int32_t first, last, y;
    int32_t ratio_q28[2], per_q31;
} gn_record_row;

/* A record on the screen. */
typedef struct {
    const gn_tri *tri;
    uint16_t vertex[3];  /* of the mesh, by corner */
    uint8_t back;        /* seen from behind */
    uint8_t deep;        /* near / Z differs so much that slopes are not linear on the screen */
    int32_t x, y;        /* a pixel in the middle of its box: slopes are from its centre on */
    int32_t at[3][2];    /* from there to the corners, right and down, subpixel_bits fraction bits */
    int32_t px;          /* the longer side of its box, pixels, rounded up */
    uint32_t area;       /* twice its area, 2 subpixel_bits fraction bits */
    int32_t part[2][2];  /* change of the weights of corners 1 and 2 per pixel to the right and down, */
    int32_t part_shift;  /* times 2^this: 14 bits */
    uint32_t iz_q32;     /* near / Z at the pixel, */
    int32_t lean_q30[2]; /* what it changes by per pixel to the right and down, as a part of it; */
    int32_t z, z_up;     /* view depth there, Q16 times 2^z_up: gn_record_find_depth() */
    int32_t columns[2];  /* of pixels that it may cover, the first and the last one */
    gn_record_row row;   /* deep: the one at hand */
} gn_patch_record;

/* Texels of a view that a triangle's pixels may read, and which of them may keep some pixel from the light: bit i of
 * row j is texel (u + i, v + j). */
enum { GN_PATCH_TEXELS = 32 };
typedef struct {
    int32_t u, v, w, h;
    uint32_t word[GN_PATCH_TEXELS];
} gn_patch_texels;

/* A light that pixels ask for: its shadow may fall on the triangle, or it ends there. */
typedef struct {
    const gn_light_view *view; /* NULL: no shadow */
    uint32_t colour[3];        /* of irradiance 1, 16 bits: times irradiance Q15 it is Q24 << down */
    int32_t down;
    gn_slope irradiance_q15;          /* of its own scale; below 0 where it faces away */
    gn_slope u_q16, v_q16, depth_q30; /* the place in the view: texels, and a share of its range */
    int32_t has_words;
    gn_patch_texels texels; /* if it has */
    uint32_t strength_uq16; /* of the shadow */
} gn_patch_light;

enum { GN_PATCH_LIGHTS = 3, GN_PATCH_NORMALS = 32 /* a power of two */ };

/* A normal in the world, unit length, of a vertex of the object at hand. */
typedef struct {
    uint16_t tag; /* the vertex's index + 1; 0: none */
    int16_t n_q14[3];
} gn_patch_normal;

/* What an object's triangles have in common. */
typedef struct {
    const gn_object *object; /* NULL: none yet */
    uint8_t patched;         /* its small triangles are patches */
    uint8_t receives, lit;
    int8_t cascade;      /* of all of it, at full strength; -1: it is not certain */
    int32_t base_q24[3]; /* albedo times ambient, and light of its own that nothing dims; at most 2^27 */
} gn_patch_object;

/* What lasts while a screen tile is shaded. */
typedef struct {
    gn_patch_object of; /* the object at hand */
    gn_pixel_line line; /* of rows with a node per pixel */
#if GN_VERTEX_NORMALS
    gn_patch_normal normal[GN_PATCH_NORMALS];
#endif
} gn_patch_shared;

enum { GN_REACH_UNKNOWN, GN_REACH_EVEN, GN_REACH_UNEVEN, GN_REACH_NONE };

/* The triangle at hand. */
typedef struct {
    gn_patch_shared *shared;
    gn_patch_record record;
#if GN_GROUPS
    gn_tri again; /* of groups: the record, made again */
#endif
    int32_t view_q14[3], face_q30[3]; /* the face's normal towards the viewer: along the camera's axes, in the world */
    uint8_t has_view_face, has_face, smooth, tinted, textured, varies;
    uint8_t graded; /* colours differ between the corners */
    uint8_t n_lights;
    uint8_t reach;            /* GN_REACH_*: of shadows */
    int32_t cascade;          /* of all of it */
    uint32_t g_uq16;          /* what distance leaves of shadows, 65536: all */
    int32_t from_q16[3][3];   /* from the spot or point light at hand to the corners, world axes */
    int32_t colour_q24[3][3]; /* by channel, at the corners: light that pixels do not ask for */
    gn_slope colour[3];
    gn_patch_light light[GN_PATCH_LIGHTS];
    gn_slope tint_q16[3]; /* colours of the vertices */
#if GN_TEXTURES
    const gn_texture *texture; /* or the level of it that the triangle shows */
    gn_slope texel_q17[2];
#if GN_MIPMAPS
    gn_texture level;
#endif
#endif
    uint32_t attenuation[GN_PATCH_ROW_PX];
    int32_t node_q24[GN_PATCH_ROW_PX][3];
    gn_texel_rgb texel[GN_PATCH_ROW_PX];
} gn_patch;

#endif
