/* Transforms, the camera, planes of triangles, clipping, and triangles that alpha cuts. */
#ifndef GN_GEOMETRY_TYPES_H
#define GN_GEOMETRY_TYPES_H

#include <stddef.h>
#include <stdint.h>

#include "base/gn_base_types.h"
#include "geometry/gn_walk.h"

/* ---- Caches of transformed vertices ------------------------------------------------------------------------------ */

/* A vertex is transformed once for several triangles that use it.  They are direct-mapped: the low bits of a
 * vertex's index choose its slot. If a cache stores more than positions, its entries begin with a gn_vertex_entry.
 */

typedef struct {
    uint32_t tag;     /* key of the cached vertex, 0: none */
    int32_t v_q16[3]; /* its position in the view's axes; while surfaces are shaded, its normal in the world, Q30 */
} gn_vertex_entry;

/* Key of an object's vertex: never 0, and one more for the object's next vertex. Both indices are below 65535. */
static inline uint32_t gn_vertex_tag(uint32_t object_idx, uint32_t vertex_idx)
{
    return (object_idx << 16) + 1U + vertex_idx;
}

/* Index of a vertex's slot in a cache of mask + 1 entries. */
static inline uint32_t gn_vertex_slot(uint32_t vertex_idx, uint32_t mask)
{
    return vertex_idx & mask;
}

/* Mask of a cache in borrowed memory: as many entries as fit, a power of two, up to 256. */
static inline uint32_t gn_vertex_mask(size_t memory_bytes, size_t entry_bytes)
{
    uint32_t n = 256;
    while (n > 1 && n * entry_bytes > memory_bytes) n >>= 1;
    return n - 1;
}

static inline int gn_vertex_hit(const gn_vertex_entry *entry, uint32_t tag)
{
    return entry->tag == tag;
}

/* Claims the entry for the vertex: the caller stores its position, or drops the entry. */
static inline void gn_vertex_claim(gn_vertex_entry *entry, uint32_t tag)
{
    entry->tag = tag;
}

static inline void gn_vertex_drop(gn_vertex_entry *entry)
{
    entry->tag = 0;
}

/* The same for a corner of a triangle, in its slot; or in `spare` if the slot is taken by another corner of that
 * triangle. The entries of the corners before it are a and b. Returns the entry. */
static inline gn_vertex_entry *gn_vertex_claim_corner(gn_vertex_entry *slot, uint32_t tag, const gn_vertex_entry *a,
                                                      const gn_vertex_entry *b, gn_vertex_entry *spare)
{
    gn_vertex_entry *entry = slot == a || slot == b ? spare : slot;
    gn_vertex_claim(entry, tag);
    return entry;
}

/* A transform composed for one object: out = round((m * p) / 2^shift) + t, t and out with 16 fraction bits. */
typedef struct {
    int32_t m[3][3]; /* |row| <= 2^30 */
    int64_t t_q16[3];
    int32_t shift;
} gn_xform;

/* The same for many vertices: constant terms are added up beforehand, and everything is scaled by 2^up, so that results
 * are the upper words. Sums stay below 2^63. */
typedef struct {
    struct {
        int64_t sum; /* half of the last bit and, up to 32 bits of shift, the translation */
        int32_t m[3];
        int32_t t_q16; /* the translation above that, 0 below */
    } row[3];
    uint32_t reach;   /* of positions, a power of two; 0: the transform or its translation is too large, gn_xform_point
                         does it */
    uint8_t up, down; /* 32 bits of shift are the upper word: what they are less, and more */
} gn_xform_fast;

typedef struct {
    int32_t axis_q30[3][3]; /* right, up, forward in the world */
    int32_t eye_q16[3];
    int32_t near_q16;
#if GN_ORTHOGRAPHIC
    int32_t flat_q16; /* orthographic: all points are projected as if they were at this depth; 0: perspective */
#endif
    uint32_t focal2_px_q16; /* 2F, twice the focal length in pixels: rays are (2x + 1 - W, H - 1 - 2y, 2F) */
    gn_bfloat inv_focal2;   /* 1 / 2F, 2F in Q16 */
    int32_t guard_q16[2];   /* |X| <= guard[0] * Z and |Y| <= guard[1] * Z after clipping to the guard band */
    int32_t coord_max_q16;  /* of screen coordinates from the picture's centre, pixels */
    int32_t tan_q16[2];     /* the same for the picture's border: (W/2) / F, (H/2) / F, rounded up */
} gn_cam;

/* The depth that an orthographic camera projects every point at; 0: perspective. */
#if GN_ORTHOGRAPHIC
#define GN_FLAT_Q16(frame) ((frame)->cam.flat_q16)
#else
#define GN_FLAT_Q16(frame) ((void)(frame), 0)
#endif

/* A point at view depth z on the ray through a pixel, along some axis: z * (a0 + ax * px + ay * py) + d; orthographic,
 * with the camera's flat depth: z * a0 + flat * (ax * px + ay * py) + d. */
typedef struct {
    int32_t a0, ax, ay;
    int64_t d_q16;
} gn_ray_plane;

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

/* Texture coordinates of a triangle: vertex 0, then differences of vertices 1 and 2 to it. */
typedef struct {
    int64_t uv_q16[3][2];
} gn_texture_triangle;

/* ---- Normals of vertices ----------------------------------------------------------------------------------------- */

/* Whether joints turn normals. */
#define GN_POSED_NORMALS (GN_VERTEX_JOINTS && GN_VERTEX_NORMALS)

/* How normals of what one joint moves go to the world, up to a factor that all joints have in common. */
typedef struct {
    uint16_t tag; /* the joint's index + 1; 0: none */
    int16_t m_q14[9];
} gn_joint_normals;

enum { GN_JOINT_NORMALS = 8 };

/* How those of an object's vertices do. */
typedef struct {
    const gn_object *object; /* NULL: none yet */
    int32_t to_world_q30[9];
#if GN_POSED_NORMALS
    gn_joint_normals joint[GN_JOINT_NORMALS]; /* the last ones, by index */
#endif
} gn_normals;

/* ---- Triangles that alpha cuts ----------------------------------------------------------------------------------- */

/* What is linear on the screen, of rays in half pixels: at + x px + y py */
typedef struct {
    int64_t at;
    int32_t x, y;
} gn_screen_form;

/* A texture coordinate: from + form / (n . ray) * 2^exp, a quotient of 20 + down fraction bits of a turn; least and
 * most bound it. */
typedef struct {
    gn_screen_form form;
    int32_t exp, least, most, down;
    int32_t from_q16, change_q15[2]; /* of vertex 0; from it to the other two */
} gn_alpha_axis;

/* An exact sample in a row. n . ray = w_norm * 2^(32 - clz); w_norm 0: the plane is edge on or behind. */
typedef struct {
    int32_t x, uv_q20[2];
    uint32_t w_norm;
    int32_t clz;
} gn_alpha_exact;

/* Texture coordinates of first <= x < end, k pixels on: from + k step + k (k - 1) / 2 bend. */
typedef struct {
    int32_t first, end;
    int32_t hold; /* 0: they are computed one by one */
    int32_t bent; /* where a long step begins that does not hold; INT32_MIN: none is known */
    int32_t from_q20[2], step_q28[2], bend_q28[2];
} gn_alpha_steps;

/* One triangle of an object, as the camera or a light sees it, and a row of it: gn_texture.h. */
typedef struct {
    const gn_object *object;
    gn_alpha mode;
    int textured; /* 0: the object's own alpha all over */
    int32_t y, py;
#if GN_TEXTURES
    gn_screen_form n_ray;  /* of the plane; all 0: edge on */
    gn_alpha_axis axis[2]; /* u, v */
    int32_t width, newton_steps;
    int32_t px_per_step, x_begin, x_end;
    gn_alpha_exact exact; /* the last one computed */
    gn_alpha_steps steps;
#endif
} gn_alpha_cut;

/* ---- Clipping ---------------------------------------------------------------------------------------------------- */

#define GN_CLIP_VERTICES_MAX 8 /* a triangle against five planes */

typedef struct {
    int32_t v_q16[GN_CLIP_VERTICES_MAX][3]; /* X right, Y up, Z forward */
    int n;
} gn_polygon;

/* A triangle in the axes of the camera or of a perspective light. */
typedef struct {
    gn_polygon polygon, uncut;
    int32_t x[GN_CLIP_VERTICES_MAX], y[GN_CLIP_VERTICES_MAX]; /* projected */
} gn_clipping;

#endif
