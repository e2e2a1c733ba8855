/* Patches: small triangles, shaded from their records. Values are known at the three corners and linear between them.
 */
#ifndef GN_PATCH_TYPES_H
#define GN_PATCH_TYPES_H

#include "shadow/gn_shadow_types.h"
#include "visible/gn_visible_types.h"

enum {
    GN_PATCH_PX = 32 /* the largest box, each way */,
    GN_PATCH_ROW_PX = 16 /* pixels that are drawn at a time */,
    GN_PATCH_COVERS = GN_PATCH_PX + 2 /* pixels of a row at most */
};

/* Pixels are interpolated with weights of the corners 1 and 2, Q15, at least 0 and at most 1 in all. */
typedef struct {
    int32_t of[2];
} gn_patch_weights;

/* A row of a triangle: weights at the first and the last pixel whose centre it covers, n from the one to the other.
 * They do not depend on what is visible. `at`: the first pixel that is drawn. */
typedef struct {
    gn_patch_weights ends[2];
    int32_t n, at;
} gn_patch_span;

/* Linear over the triangle: the value at corner 0, and what it changes by to corners 1 and 2, in units of 2^shift,
 * within +-2^15. */
typedef struct {
    int32_t at;
    int32_t to[2];
    int32_t shift;
} gn_patch_value;

/* Linear along a row of pixels. */
typedef struct {
    int32_t at, step;
} gn_row_value;

/* A record on the screen. */
typedef struct {
    const gn_tri *tri;
    uint16_t vertex[3];   /* of the mesh, by corner */
    uint8_t back;         /* seen from behind */
    uint8_t deep;         /* weights need the corners' depths */
    int32_t x0, y0;       /* the pixel that corner 0 lies in */
    int32_t off[2];       /* from corner 0 to its centre, right and down, subpixel_bits fraction bits */
    int32_t a[2], b[2];   /* from corner 0 to corners 1 and 2, likewise */
    int32_t px;           /* the longer side of its box, pixels, rounded up */
    uint32_t area;        /* twice its area, 2 subpixel_bits fraction bits */
    uint32_t recip;       /* 2^47 over that, normalised: 16 bits */
    int32_t clz;          /* leading zeros of the area */
    uint32_t iz_q32[3];   /* near / Z at the corners */
    uint32_t near_q14[2]; /* deep: near / Z of corners 1 and 2 over that of corner 0, at most 2 */
    int32_t z[3], z_up;   /* view depths at the corners, Q16 times 2^z_up */
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
    gn_patch_value irradiance_q15;          /* of its own scale; below 0 where it faces away */
    gn_patch_value u_q16, v_q16, depth_q30; /* the place in the view: texels, and a share of its range */
    int32_t has_words;
    gn_patch_texels texels;      /* if it has */
    int32_t fades;               /* the shadow is not of full strength: */
    gn_patch_value strength_q16; /* the light's, less what fades with distance */
} gn_patch_light;

enum { GN_PATCH_LIGHTS = 3, GN_PATCH_NORMALS = 32 /* a power of two */ };

/* A vertex's normal in the world, unit length: three axes of 10 bits, the first in the highest. */
typedef struct {
    uint32_t tag; /* gn_vertex_tag(), 0: none */
    uint32_t packed;
} gn_patch_normal;

/* From a mesh's normals to the world, by a joint of the object's skin, Q14. */
typedef struct {
    uint16_t tag; /* the joint's index + 1, 0: none */
    int32_t m_q14[9];
} gn_patch_joint;
enum { GN_PATCH_JOINTS = 16 /* a power of two */ };

/* What an object's triangles have in common. */
typedef struct {
    const gn_object *object; /* NULL: none yet */
    uint8_t patched;         /* its small triangles are patches */
    uint8_t receives, lit;
    int32_t to_world_q30[3][3]; /* of normals */
    int32_t base_q24[3];        /* albedo times ambient, and light of its own that nothing dims; at most 2^27 */
} gn_patch_object;

/* A cascade's sphere in units of 2^down of Q16, in which it has 15 bits: depth of its centre, squares of its radius and
 * of where it begins to fade, and 2^32 over their difference. */
typedef struct {
    int32_t centre;
    uint32_t radius2, inner2, per_fade;
} gn_patch_sphere;

/* What lasts while a screen tile is shaded. */
typedef struct {
    gn_patch_object of; /* the object at hand */
#if GN_VERTEX_NORMALS
    gn_patch_normal normal[GN_PATCH_NORMALS];
#if GN_VERTEX_JOINTS
    gn_patch_joint joint[GN_PATCH_JOINTS]; /* of that object */
#endif
#endif
#if GN_SHADOWS && GN_AUTO_BIAS
    int32_t sphere_down;
    int32_t coarse; /* some sphere has too few bits */
    gn_patch_sphere sphere[4];
#endif
} gn_patch_shared;

enum { GN_REACH_UNKNOWN, GN_REACH_EVEN, GN_REACH_UNEVEN };

/* The triangle at hand. */
typedef struct {
    gn_patch_shared *shared;
    gn_patch_record record;
#if GN_GROUPS
    gn_tri again; /* of groups: the record, made again */
#endif
    int32_t view_q14[3], face_q30[3]; /* the face's normal towards the viewer: along the camera's axes, in the world */
    uint8_t has_face, smooth, tinted, textured, varies;
    uint8_t graded; /* colours differ between the corners */
    uint8_t n_lights;
    uint8_t reach;             /* GN_REACH_*: of shadows, over the triangle */
    int32_t cascade;           /* of the corners */
    uint32_t strength_uq16[3]; /* of shadows at the corners */
    int32_t from_q16[3][3];    /* from the spot or point light at hand to the corners, world axes */
    int32_t colour_q24[3][3];  /* by channel, at the corners: light that pixels do not ask for */
    gn_patch_value colour[3];
    gn_patch_light light[GN_PATCH_LIGHTS];
    gn_patch_value tint_q16[3]; /* colours of the vertices */
#if GN_TEXTURES
    const gn_texture *texture; /* or the level of it that the triangle shows */
    gn_patch_value texel_q17[2];
#if GN_MIPMAPS
    gn_texture level;
#endif
#endif
    uint32_t attenuation[GN_PATCH_ROW_PX];
    int32_t node_q24[GN_PATCH_ROW_PX][3];
    gn_texel_rgb texel[GN_PATCH_ROW_PX];
} gn_patch;

#endif
