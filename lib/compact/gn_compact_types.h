/* A compact renderer (GN_COMPACT): its frame and scratch, which replace those of gn_state.h. Private; gn_compact.h
 * describes the arithmetic.
 */
#ifndef GN_COMPACT_TYPES_H
#define GN_COMPACT_TYPES_H

#include "visible/gn_screen_types.h"

/* Texels of the one tile. */
typedef union {
    uint8_t *d8;
    uint16_t *d16;
    uint32_t *d32;
} gn_texels;
#define GN_VIEW_BITS(view) ((void)(view), 16)

/* From an object's space, or the camera's, to a projector's axes: (m * p >> shift) + t. */
typedef struct {
    int32_t m_q28[3][3];
    int32_t t_q16[3];
    int32_t shift;
} gn_compact_xform;

/* A projector of points to a raster: the camera, or the light. Both look along their third axis, with x to the right
 * and y down. */
typedef struct {
    int32_t axis_q30[3][3]; /* in the world */
    int32_t eye_q16[3];     /* where the raster's middle lies, at depth 0 */
    uint32_t scale;         /* camera: 2F in pixels, light: texels per unit; in [2^31, 2^32) */
    int32_t shift;          /* light: shift to Q16 texels; camera: 2F_q16 = scale >> shift */
    uint32_t near_norm;     /* camera: near in [2^31, 2^32); light: 0 */
    int32_t near_q16;
    int32_t near_clz;
    int32_t size[2];      /* of the raster */
    int32_t guard;        /* camera: |x|, |y| <= guard * z after clipping; light: <= guard, Q16 */
    uint32_t flags, mask; /* objects are drawn whose flags & mask are these */
    uint32_t two_sided;   /* flags of those of which both sides are drawn */
} gn_compact_view;

/* 1 / width, for ratios to that width. */
typedef struct {
    int32_t width;
    uint32_t recip; /* 2^63 / (width << clz) */
    int32_t clz;
} gn_compact_share;

/* As of other arithmetic's views, whose tiles need not be squares. */
#define GN_TILE_ROWS(view) ((view)->tile_texels)
#define GN_UNSEEN(view)    ((void)(view), 0)

typedef struct {
    gn_compact_view project;
    gn_texels depth;
    uint16_t tile_texels;
    uint8_t tile_done, empty;
} gn_light_view;

typedef struct {
    int16_t view_idx; /* 0 */
    uint8_t n_views;
    uint8_t shadow_state;
} gn_light_state;

/* A triangle of a raster: corners from its top left corner, Q8; keys grow towards the viewer. */
typedef struct {
    int32_t x[3], y[3];       /* seen from the front: of negative area, y down */
    uint32_t key;             /* at the centre of pixel (x0, y0) */
    int32_t key_dx, key_dy;   /* per pixel, with frac_bits */
    int16_t begin[2], end[2]; /* pixels that it can cover, of x and y */
    int32_t frac_bits;        /* 8, or 0 where steep */
    int16_t normal_q14[3];    /* of the face, in the light's axes, towards the viewer */
    uint16_t object_idx;
#if GN_RAW_VIEWS
    uint16_t triangle_idx; /* in its mesh */
#endif
} gn_tri;

/* Along the projector's axes. */
typedef struct {
    int32_t v_q16[8][3]; /* a triangle against five planes */
} gn_compact_polygon;

/* A projected corner. */
typedef struct {
    int32_t at_q16[2]; /* of the raster */
    int32_t key;
} gn_compact_corner;

typedef struct {
    gn_compact_xform xform;
    gn_compact_polygon polygon, spare;
    gn_compact_corner corner[3];
    gn_tri tri;
    int16_t normal_q14[3];
} gn_compact_job;
typedef gn_compact_job gn_casting;

typedef union {
    gn_compact_job casting, clipping;
} gn_work;

typedef struct gn_frame {
#if GN_RUNTIME_KNOBS
    gn_knobs knobs;
#endif
    const gn_scene *scene;
    gn_picture picture;
    uint8_t stage;   /* gn_stage in gn_internal.h */
    uint8_t id_bits; /* of a visibility cell: enough for n_triangles + 2 */
    uint8_t n_views;
    uint8_t n_lights; /* of the scene, which may be gone when gn_get_light_shadow is called */
    uint16_t tiles_x, tiles_y;
    gn_compact_view cam;
    int32_t per_px_q29;                /* 1 / 2F: rays are (2x + 1 - W, H - 1 - 2y, -2F) */
    gn_compact_xform to_light;         /* from the camera's space */
    gn_compact_share distance, sphere; /* by view depth: Q16; by the sphere: texels^2, Q16 */
    int32_t centre_q16[3];             /* of the sphere: U, V, D */
    uint64_t radius2_q32;              /* texels^2 */
    int32_t offset_q16;                /* B2: along the normal, texels; automatic bias: r */
    int32_t flat_offset_q16;           /* automatic bias: eps_0; else 0 */
    gn_stats stats;
    gn_detail detail;
    gn_light_state light[GN_MAX_LIGHTS];
    gn_light_view view[1];
    uint8_t flags[GN_MAX_OBJECTS]; /* of each object, as drawn: scene/gn_scene.h */
    struct {
        gn_tri tri[GN_MAX_TRIANGLES];
    } records;
    uint16_t atlas[GN_ATLAS_SIZE * GN_ATLAS_SIZE];
} gn_frame;

typedef struct gn_scratch {
    uint32_t cell[GN_TILE_PIXELS_MAX]; /* nearest surface: key above, triangle in the low id_bits; 0: none */
    gn_tile_pixels pixel;              /* finished pixels in the picture's format */
    gn_work work;
} gn_scratch;

#endif
