/* Views of lights, their tiles in the atlases, and the state of drawing casters. */
#ifndef GN_SHADOW_TYPES_H
#define GN_SHADOW_TYPES_H

#include "light/gn_light_types.h"

#define GN_DEPTH_FRAC_BITS 4 /* of a receiver's depth below one step of its map */

#define GN_OTHER_ATLAS (GN_PUNCTUAL_LIGHTS || GN_MAIN_LIGHT) /* whether there is one */
/* Rows of a view's tile, and the longer of its sides. */
#if GN_TIGHT_FIT
#define GN_TILE_ROWS(view) ((view)->tile_rows)
#define GN_TILE_SIDE(view) ((view)->tile_rows > (view)->tile_texels ? (view)->tile_rows : (view)->tile_texels)
#define GN_UNSEEN(view)    ((view)->unseen)
#define GN_TIGHT(view)     ((view)->tight)
#else
#define GN_TILE_ROWS(view) ((view)->tile_texels)
#define GN_TILE_SIDE(view) ((view)->tile_texels)
#define GN_UNSEEN(view)    ((void)(view), 0)
#define GN_TIGHT(view)     ((void)(view), 0)
#endif

#if GN_TIGHT_FIT
/* What the camera sees that a view is looked up for, and of a directional view only where something may cast. */
typedef struct {
    uint64_t worth_q16;           /* pixels that its tile is worth */
    int32_t lo_q16[3], hi_q16[3]; /* along the view's axes, from the world's origin; lo > hi: nothing. Spot and point
                                     lights: whether anything is seen, and lo[2] its nearest distance into the view */
    int32_t cast_lo_q16[2], cast_hi_q16[2]; /* directional: along u and v, what casters may cover */
    uint16_t side;                          /* of its tile, by worth; 0: none */
} gn_view_seen;

/* A part of the frustum, and one object's box, from the camera. Six coordinates: along the camera's axes, then along
 * the light's. */
typedef struct {
    const struct gn_frame *frame;
    const gn_object_state *object;
    int32_t axis_q30[3][3];        /* of the light */
    int32_t depth_q16[2];          /* of the part */
    int32_t sphere_q16[2];         /* of a directional view: depth of the centre, a quarter of the radius */
    int32_t part[8][6];            /* its corners */
    int32_t part_world[8][3];      /* along the world's axes */
    int32_t from[3];               /* middle of the box, along the world's axes */
    int32_t middle[6], half[6][3]; /* the same; per axis of the world, half of the box */
    int32_t lo[6], hi[6];          /* bounds of the box, then of what is seen of it */
    int32_t box[8][6];
    int directional;
    int32_t along_lo[3], along_hi[3]; /* of what a directional view sees, along the light's axes */
    int32_t cast_lo[2], cast_hi[2];   /* of casters, along u and v */
    int32_t below[3], above[3];       /* along the world's axes, bounds of seen objects */
#if GN_PUNCTUAL_LIGHTS
    int32_t light_q16[3]; /* its position, along its axes */
    gn_bfloat tangent;    /* of half its view */
#endif
} gn_seen_job;
#else
typedef struct gn_seen_job gn_seen_job; /* nobody has one */
#endif

#define GN_VIEWS_MAX (GN_MAX_SHADOW_TILES + (GN_OTHER_ATLAS ? GN_MAX_OTHER_TILES : 0))

/* Texels of a tile at the depth_bits of its atlas: it is accessed only as the type that they name. */
typedef union {
    uint8_t *d8;
    uint16_t *d16;
    uint32_t *d32;
} gn_texels;

/* Bits of depth: a constant where the configuration leaves no choice. */
#if !GN_RUNTIME_KNOBS && (!GN_OTHER_ATLAS || GN_DEPTH_BITS == GN_OTHER_DEPTH_BITS)
#define GN_VIEW_BITS(view) ((void)(view), GN_DEPTH_BITS)
#else
#define GN_VIEW_BITS(view) ((view)->depth_bits)
#endif

/* Slopes of receiver planes are limited to 2^this, Q28 per texel: 16 / T of the depth range. [B5] */
#define GN_SLOPE_LIMIT_LOG2(view) (32 - (view)->tile_log2)

typedef struct {
    uint16_t lo, hi; /* the upper 16 bits of depth, whatever depth_bits */
} gn_depth_block;    /* see gn_texel.h */

/* Squares of shadow maps, a bit each: those of a view's tile, of 2^square_log2 texels each way, are the ones from
 * first_square on, row by row. */
enum { GN_SQUARES = 256 };
typedef struct {
    uint32_t word[GN_SQUARES / 32];
} gn_squares;

/* Orthographic: whole texels of a grid that is fixed in the world. */
typedef struct {
    gn_bfloat inv_texel; /* texels per world unit */
    int32_t origin[3];   /* whole texels */
    gn_ray_plane ray[3];
    int32_t ray_shift; /* fraction bits of a0, ax, ay */
} gn_ortho_fit;

/* Perspective: a camera at the light, whose picture is the tile. */
typedef struct {
    int32_t eye_q16[3];
    int32_t clip_q16;           /* the light's near distance: nothing nearer casts */
    int32_t near_q16;           /* n: depth is 1 - n / z; casters nearer are flattened onto it */
    uint32_t focal2_q16;        /* T / t: twice the focal length in texels */
    gn_bfloat per_near;         /* 1 / n, n in Q16 */
    gn_bfloat texel_per_z;      /* 2t / T: width of a texel at light-plane distance 1 */
    int32_t guard_q16[2];       /* |x|, |y| <= guard * z after clipping to the guard band */
    int32_t side_q16[2];        /* the same for the tile's own border, a little wider: a caster outside it is skipped */
    int64_t ratio_max_q28;      /* x / z beyond this would overflow, times focal2 */
    int32_t lift_q31;           /* receivers, B2: offset along the normal per light-plane distance; INT32_MAX: 1 or
                                   more */
    int32_t constant_share_q30; /* casters: min(1, constant bias * 2t / T) */
} gn_persp_fit;

typedef struct {
    gn_texels depth;      /* T * T, row by row, inside the atlas */
    uint32_t first_texel; /* of the tile in its atlas */
    int32_t offset_q16;   /* receiver offset along the normal, texels; automatic bias: the filter radius plus position
                             error, texels */
#if GN_AUTO_BIAS
    int32_t auto_step;  /* automatic bias: the part for rounded depths. Directional: texels, Q16; spot, point: fraction
                           of the depth range, Q32 */
    int32_t auto_place; /* automatic bias, spot and point: error of a point per view depth, Q40 */
#endif
    int32_t disk_radius_q16; /* texels */
    int32_t bias_constant_q16, bias_slope_q16;
    uint16_t tile_texels; /* per row: T, but of a tight fit */
#if GN_TIGHT_FIT
    uint16_t tile_rows; /* see GN_TILE_ROWS */
#endif
    uint16_t light_idx;
    uint8_t tile_log2;   /* T = 2^tile_log2, or the next power of two */
    int8_t depth_log2;   /* J: an orthographic depth range is 2^(tile_log2 + J) texels */
    uint8_t depth_bits;  /* 8, 16 or 32: that of the atlas; see GN_VIEW_BITS */
    uint8_t filter;      /* gn_filter, with the light's own softness */
    uint8_t filter_idx;  /* k */
    uint8_t cascade_idx; /* or face of the cube */
    uint8_t perspective;
    uint8_t border_lit; /* texels outside the tile count as lit */
    uint8_t in_other;   /* its tile lies in the local-light atlas */
    uint8_t empty;      /* its cascade has no slice: never drawn, never selected */
    uint8_t tile_done;
    uint8_t stale; /* by its schedule it keeps the tile of an earlier frame, and the fit that goes with it */
#if GN_TIGHT_FIT
    uint8_t tight;  /* beyond the tile, and within a filter's reach of its border, nothing casts */
    uint8_t unseen; /* no visible receiver looks into it: an empty tile of 8 x 8 texels that all such views share */
#endif
#if GN_CHANGES
    uint8_t square_log2, first_square; /* see gn_squares */
#endif
#if GN_DISK_FILTER
    gn_depth_block *block; /* (T / 8) * (T / 8), of the disk filter alone: gn_texel.h */
#endif
    int32_t axis_q30[3][3]; /* u, v, w in the world */
    union {
        gn_ortho_fit ortho;
        gn_persp_fit persp;
    } fit;
} gn_light_view;

#if GN_INTERPOLATES
/* Texels of a tile that keep a plane in the dark: gn_filter.h. */
enum { GN_WINDOW_TEXELS = 32, GN_WINDOWS = GN_VIEWS_MAX >= 5 ? 5 : GN_VIEWS_MAX >= 1 ? GN_VIEWS_MAX : 1 };
enum { GN_WINDOW_LIT, GN_WINDOW_DARK, GN_WINDOW_MIXED, GN_WINDOW_MISSED };

/* A point of the plane, at any depth; how far receivers are before it and behind it. */
typedef struct {
    int64_t depth_q30;
    int32_t u_q16, v_q16;
    int32_t apart_q30;
} gn_window_place;

typedef struct {
    const gn_light_view *view;     /* NULL: none */
    int32_t planar;                /* 0: of this view there is no window, -1: of single cells alone */
    int32_t slope_q30[2];          /* change of the plane's depth per texel, a fraction of the range */
    int32_t front_q30, behind_q30; /* depths so far in front of the plane, and behind it, are in doubt */
#if GN_CHANGES
    gn_squares *squares; /* to note what is compared */
#endif
    int32_t until_x, until_y;             /* gn_lattice: where what it was made for ends; rows move it */
    gn_window_place place;                /* a point of the plane */
    int32_t u0, v0, w, h;                 /* texels, w = 0: none yet */
    int32_t plain;                        /* all of them in the tile, of 16 bits */
    int32_t depth_q30;                    /* of the plane, at the centre of the first */
    uint32_t any, all, doubts;            /* of rows: OR of what may be dark, AND of what surely is, OR of doubts */
    uint32_t dark[GN_WINDOW_TEXELS + 3];  /* bit i of row j: texel (u0 + i, v0 + j) may be dark */
    uint32_t doubt[GN_WINDOW_TEXELS + 3]; /* or may not */
} gn_window;
#endif

/* Signatures of a view's kept tile. */
typedef struct {
    uint64_t signature;        /* of everything that its texels depend on; 0: nothing is kept */
    uint64_t static_signature; /* the same for the static layer */
} gn_tile_memory;

#define GN_ATLAS_BYTES (GN_ATLAS_TEXELS * ((GN_RUNTIME_KNOBS ? 32 : GN_DEPTH_BITS) / 8))
typedef union {
    uint8_t d8[GN_ATLAS_BYTES];
    uint16_t d16[GN_ATLAS_BYTES / 2];
    uint32_t d32[GN_ATLAS_BYTES / 4];
} gn_atlas_texels;

#define GN_OTHER_ATLAS_BYTES (GN_OTHER_ATLAS_TEXELS * ((GN_RUNTIME_KNOBS ? 32 : GN_OTHER_DEPTH_BITS) / 8))
typedef union {
    uint8_t d8[GN_OTHER_ATLAS_BYTES];
    uint16_t d16[GN_OTHER_ATLAS_BYTES / 2];
    uint32_t d32[GN_OTHER_ATLAS_BYTES / 4];
} gn_other_texels;

/* A corner of a caster as a view sees it. */
typedef struct {
    gn_vertex_entry vertex; /* within 2^29 */
#if GN_PUNCTUAL_LIGHTS      /* of perspective views: gn_persp_corner */
    int32_t x, y;           /* texels with GN_CASTER_BITS fraction bits, if `out` is 0 */
    uint32_t out;           /* planes that it lies beyond */
#endif
} gn_caster_corner;

/* One caster and one view. */
typedef struct {
    struct gn_frame *frame;
    const gn_light_view *view;
    const gn_object *object;
    uint32_t object_idx;
    uint32_t sides; /* GN_SIDE_... that cast */
    gn_caster_corner *cache;
    uint32_t cache_mask;
    int32_t shrink_q16; /* caster bias, texels */
    gn_xform to_light;
    union {
        gn_xform_fast fast; /* of what is not shrunk */
        gn_normals normals; /* of what is */
    } by;
} gn_caster_job;

#define GN_ORTHO_POLYGON_MAX 8 /* a triangle cut by four sides has 7; rounding may add one */

/* Corners in a view's coordinates: U, V, D in texels, Q16; of perspective views in world units from the light. */
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
    union {
        gn_light_polygon polygon;
        gn_caster_corner spare[3]; /* of those that need no polygon: see gn_vertex_claim_corner */
    } of;
    union {
        gn_light_polygon uncut; /* orthographic */
        gn_clipping clipping;   /* perspective */
    } with;
#if GN_CASTER_ALPHA
    gn_alpha_cut alpha;
#endif
} gn_casting;

#endif
