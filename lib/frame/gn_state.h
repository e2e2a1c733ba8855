/* The layout of a renderer's state. Private: it may change with every version; included by gnomon.h so that it has a
 * size.
 *
 * gn_frame is written by begin, shadow tiles and prepare, and read only while screen tiles are drawn. gn_scratch is
 * what one core needs to draw a screen tile.
 */
#ifndef GN_STATE_H
#define GN_STATE_H

/* A transform composed for one object: out = round((m * p) / 2^shift) + t, t and out with 16 fraction bits. */
typedef struct {
    int32_t m[3][3]; /* |row| <= 2^30 */
    int64_t t_q16[3];
    int32_t shift;
} gn_xform;

/* The same for many vertices: what can be, is added up beforehand, and all is times 2^up so that results are the upper
 * words. Sums stay below 2^63. */
typedef struct {
    struct {
        int64_t sum; /* half of the last bit and, up to 32 bits of shift, the translation */
        int32_t m[3];
        int32_t t_q16; /* the translation above that, 0 below */
    } row[3];
    uint32_t reach;   /* of positions, a power of two; 0: the transform or its translation is out of the ordinary,
                         gn_xform_vertex does it */
    uint8_t up, down; /* 32 bits of shift are the upper word: what they are less, and more */
} gn_xform_fast;

/* A block float: a positive number mant * 2^exp, mant in [2^31, 2^32). See gn_math.h. */
typedef struct {
    uint32_t mant;
    int32_t exp;
} gn_bfloat;

typedef struct {
    int32_t axis_q30[3][3]; /* right, up, forward in the world */
    int32_t eye_q16[3];
    int32_t near_q16;
    uint32_t focal2_px_q16;     /* 2F, twice the focal length in pixels: rays are (2x + 1 - W, H - 1 - 2y, 2F) */
    gn_bfloat near_over_focal2; /* near / 2F */
    gn_bfloat inv_focal2;       /* 1 / 2F, 2F in Q16 */
    int32_t guard_q16[2];       /* |X| <= guard[0] * Z and |Y| <= guard[1] * Z hold after clipping to the guard band */
    int32_t coord_max_q16;      /* of screen coordinates from the picture's centre, pixels */
    int32_t tan_q16[2];         /* the same for the picture's border: (W/2) / F, (H/2) / F, rounded up */
} gn_cam;

/* A point at view depth z on the ray through a pixel, along some axis: z * (a0 + ax * px + ay * py) + d. */
typedef struct {
    int32_t a0, ax, ay;
    int64_t d_q16;
} gn_ray_plane;

#define GN_OBJECT_LIGHTS_MAX 8 /* P9 */

/* Whether anything asks for the boxes of objects. */
#define GN_BOXES (GN_PUNCTUAL_LIGHTS || (GN_SHADOWS && (GN_OBJECT_BOXES || GN_CASTER_CULLING)))

/* What is known of an object before its triangles are looked at. */
typedef struct {
    int32_t centre_q16[3], half_q16[3]; /* its box in the world */
#if GN_PUNCTUAL_LIGHTS
    uint8_t n_lights; /* of light[]; GN_OBJECT_LIGHTS_ALL: every light that is on, no list is kept */
    uint8_t light[GN_OBJECT_LIGHTS_MAX];
#endif
} gn_object_state;
#define GN_OBJECT_LIGHTS_ALL 255U

#if GN_COMPACT
#include "compact/gn_compact_state.h"
#else
#if GN_SHADOWS
#define GN_OTHER_ATLAS (GN_PUNCTUAL_LIGHTS || GN_MAIN_LIGHT) /* whether there is one */
#define GN_VIEWS_MAX   (GN_MAX_SHADOW_TILES + (GN_OTHER_ATLAS ? GN_MAX_OTHER_TILES : 0))

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

typedef struct {
    uint16_t lo, hi; /* the upper 16 bits of depth, whatever depth_bits */
} gn_depth_block;    /* see gn_blocks.h */

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
    int32_t near_q16;      /* n: depth is 1 - n / z */
    uint32_t focal2_q16;   /* T / t: twice the focal length in texels */
    gn_bfloat per_near;    /* 1 / n, n in Q16 */
    gn_bfloat texel_per_z; /* 2t / T: width of a texel at light-plane distance 1 */
    int32_t guard_q16[2];  /* |x|, |y| <= guard * z after clipping to the guard band */
    int32_t side_q16[2]; /* the same for the tile's own border, a little wider: what is outside all of it casts nothing
                            here */
    int64_t ratio_max_q28;      /* x / z beyond this would overflow, times focal2 */
    int32_t constant_share_q30; /* B1: min(1, constant bias * 2t / T) */
} gn_persp_fit;

typedef struct {
    gn_texels depth;      /* T * T, row by row, inside the atlas */
    uint32_t first_texel; /* of the tile in its atlas */
    int32_t offset_q16; /* B2 and b_z of B3: receiver offset along the normal, texels; B6: the reach of a tap, texels */
#if GN_AUTO_BIAS
    int32_t auto_step;  /* B6: what rounding of depths takes, directional: texels, Q16; spot, point: share of the range,
                           Q32 */
    int32_t auto_place; /* B6, directional: offset of curved surfaces, texels, Q16; spot, point: error of a point per
                           view depth, Q40 */
#endif
    int32_t disk_radius_q16; /* F4, texels */
    int32_t bias_constant_q16, bias_slope_q16;
    uint16_t tile_texels; /* T */
    uint16_t light_idx;
    uint8_t tile_log2;   /* T = 2^tile_log2 */
    uint8_t depth_log2;  /* J: an orthographic depth range is T * 2^J texels */
    uint8_t depth_bits;  /* 8, 16 or 32: that of the atlas; see GN_VIEW_BITS */
    uint8_t filter;      /* gn_filter, resolved (F5) */
    uint8_t filter_idx;  /* k */
    uint8_t cascade_idx; /* or face of the cube */
    uint8_t perspective;
    uint8_t border_lit; /* texels outside the tile count as lit (D10) */
    uint8_t in_other;   /* it lies in the other atlas */
    uint8_t empty;      /* its cascade has no slice: never drawn, never selected */
    uint8_t tile_done;
    uint8_t stale; /* A5: by its schedule it keeps the tile of an earlier frame, and the fit that goes with it */
#if GN_DEPTH_BLOCKS
    gn_depth_block *block;  /* (T / 8) * (T / 8) */
#endif
    int32_t axis_q30[3][3]; /* u, v, w in the world */
    union {
        gn_ortho_fit ortho;
        gn_persp_fit persp;
    } fit;
} gn_light_view;

/* What a view's tile holds from one frame to the next (A5). */
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

#if GN_OTHER_ATLAS
#define GN_OTHER_ATLAS_BYTES (GN_OTHER_ATLAS_TEXELS * ((GN_RUNTIME_KNOBS ? 32 : GN_OTHER_DEPTH_BITS) / 8))
typedef union {
    uint8_t d8[GN_OTHER_ATLAS_BYTES];
    uint16_t d16[GN_OTHER_ATLAS_BYTES / 2];
    uint32_t d32[GN_OTHER_ATLAS_BYTES / 4];
} gn_other_texels;
#endif

/* The bounding sphere of a cascade's slice: on the view axis, shared by all lights (D3). */
typedef struct {
    int32_t centre_q16;   /* view depth */
    uint64_t radius2_q32; /* 0: empty */
    uint64_t inner2_q32;  /* within this distance the D6 factor is 1 */
    gn_bfloat fade_scale; /* D6: factor = (radius2 - dist2) * fade_scale */
    int32_t next;         /* the next cascade that is not empty */
} gn_cascade_state;
#endif

typedef struct {
    int32_t to_light_q30[3]; /* unit; directional: surface towards the light, spot: against its axis */
    uint32_t colour_uq16[3];
    uint32_t strength_uq16;
    int8_t mask_channel;
    uint8_t kind;         /* gn_light_kind */
    uint8_t off;          /* baked: contributes nothing at run time */
    uint8_t shadow_state; /* gn_shadow_state */
    uint8_t n_views;      /* cascades, 1, or 6 faces */
    uint8_t auto_bias;    /* B6: GN_AUTO_BIAS_DEPTH or _NORMAL, 0: none */
    int16_t view_idx;     /* of its first gn_light_view, -1: no shadow */
#if GN_PUNCTUAL_LIGHTS
    int32_t position_q16[3];
    int32_t eye_q16[3];         /* its position in view space */
    gn_ray_plane from_light[3]; /* surface point minus light, world axes and units */
    int32_t ray_shift;
    uint64_t range2_q32;   /* all ones: unlimited */
    gn_bfloat inv_range2;  /* of range2 in Q32 */
    int32_t colour_exp;    /* what is left of the colour's exponent, see gn_punctual.c */
    int32_t cos_outer_q30; /* P3; spot lights only */
    gn_bfloat angle_scale; /* 1 / (cos inner - cos outer) */
#endif
} gn_light_state;
/* 16 bits where a guard band of at least 8 pixels is left around every picture: gn_xform.c */
#define GN_COORD_PX_MAX (2 * ((32767 >> GN_SUBPIXEL_BITS) - 10))
#if GN_RUNTIME_KNOBS || GN_SUBPIXEL_BITS > 7 || GN_MAX_WIDTH > GN_COORD_PX_MAX || GN_MAX_HEIGHT > GN_COORD_PX_MAX
typedef int32_t gn_coord;
#else
typedef int16_t gn_coord;
#endif

/* A visible triangle on the screen, ready to be walked. Coordinates are from the picture's centre (y down), with
 * subpixel_bits fraction bits: up to 7 of them fit 16 bits in most pictures, as the guard band sees to. */
typedef struct {
    gn_coord x[3], y[3];  /* top, left and right of it: counter-clockwise in the world, its signed area on the screen (y
                             down) is negative */
    uint32_t iz_ref;      /* near / Z at the centre of the pixel that holds vertex 0, Q0.32, modulo 2^32 */
    int32_t iz_dx, iz_dy; /* per pixel, modulo 2^32 */
    uint16_t iz_min, iz_max; /* bounds of near / Z, Q0.16, rounded outwards; where none are needed, 1 + gn_walk_lasts or
                                GN_NARROW, and 0 */
    uint16_t object_idx;
    uint16_t triangle_idx;
} gn_tri;

typedef struct {
    uint32_t tag; /* object << 16 | vertex, plus one; 0: empty */
    int32_t v_q16[3];
} gn_vcache_entry;

#define GN_TILES_X_MAX ((GN_MAX_WIDTH + GN_TILE_WIDTH - 1) / GN_TILE_WIDTH)
#define GN_TILES_Y_MAX ((GN_MAX_HEIGHT + GN_TILE_HEIGHT - 1) / GN_TILE_HEIGHT)
#if GN_RUNTIME_KNOBS
#define GN_TILES_MAX       16384
#define GN_TILE_PIXELS_MAX 65536
#else
#define GN_TILES_MAX       (GN_TILES_X_MAX * GN_TILES_Y_MAX)
#define GN_TILE_PIXELS_MAX (GN_TILE_WIDTH * GN_TILE_HEIGHT)
#endif
#if GN_MAX_TILE_REFS > 65535
typedef uint32_t gn_ref_offset;
#else
typedef uint16_t gn_ref_offset;
#endif

typedef struct gn_frame {
#if GN_RUNTIME_KNOBS
    gn_knobs knobs;
#endif
    /* what is small goes first: instructions reach it without an address of its own */
    const gn_scene *scene;
    gn_picture picture;
    uint8_t stage;   /* gn_stage in gn_frame.c */
    uint8_t id_bits; /* of a visibility cell: enough for n_triangles + 2 */
    uint16_t n_views;
    uint16_t tiles_x, tiles_y;
    gn_cam cam;
    uint64_t min2_q32;           /* P2: the least distance^2 of spot and point lights, 10^-4 of the model's */
    int32_t receivers_q16[2][3]; /* box of all receiving objects: least, largest corner; D8 */
    uint32_t fade_start_q16;     /* D5: strength = (max_distance - z) * fade_scale */
    gn_bfloat fade_scale;
    gn_stats stats;
    gn_detail detail;
#if GN_SHADOWS
    uint8_t n_cascades;
    uint8_t last_cascade; /* the last that is not empty */
    uint8_t has_cascades; /* some directional light has tiles in the directional atlas: D6 applies */
    uint32_t frame_count; /* A5: for the schedule of cascades */
    gn_cascade_state cascade[4];
#endif
    gn_light_state light[GN_MAX_LIGHTS];
#if GN_SHADOWS
    gn_light_view view[GN_VIEWS_MAX]; /* light by light, cascade by cascade or face by face */
#endif
#if GN_BOXES
    gn_object_state object[GN_MAX_OBJECTS];
#endif
    gn_tri tri[GN_MAX_TRIANGLES];
    gn_ref_offset tile_first[GN_TILES_MAX + 1];
    uint16_t tile_ref[GN_MAX_TILE_REFS];
#if GN_SHADOWS
#if GN_INCREMENTAL
    gn_tile_memory memory[GN_VIEWS_MAX];
    uint64_t layout; /* signature of where the tiles lie: what is kept is forgotten when that changes */
#endif
    gn_atlas_texels atlas;
#if GN_STATIC_LAYER
    gn_atlas_texels static_atlas;
#endif
#if GN_DEPTH_BLOCKS
    gn_depth_block block[GN_ATLAS_TEXELS / 64];
#endif
#if GN_OTHER_ATLAS
    gn_other_texels other_atlas;
#if GN_STATIC_LAYER
    gn_other_texels static_other_atlas;
#endif
#if GN_DEPTH_BLOCKS
    gn_depth_block other_block[GN_OTHER_ATLAS_TEXELS / 64];
#endif
#endif
#endif
} gn_frame;

#define GN_N_CASCADES(frame)   (GN_MANY_CASCADES ? (frame)->n_cascades : 1)
#define GN_LAST_CASCADE(frame) (GN_MANY_CASCADES ? (frame)->last_cascade : 0)

typedef union {
    uint8_t bytes[GN_TILE_PIXELS_MAX * (GN_RAW_VIEWS ? 4 : 3)];
    uint16_t rgb565[GN_TILE_PIXELS_MAX];
    uint32_t raw[GN_TILE_PIXELS_MAX * (GN_RAW_VIEWS ? 4 : 3) / 4];
} gn_tile_pixels;

#include "shade/gn_shading.h"

#define GN_RUN_LISTS 64
#if GN_TILE_PIXELS_MAX > 65535
typedef uint32_t gn_run_idx;
#else
typedef uint16_t gn_run_idx;
#endif

/* The cells of a screen tile. */
#define GN_CELLS(scratch) ((scratch)->cell + 1)

typedef struct gn_scratch {
    uint32_t cell[1 + GN_TILE_PIXELS_MAX]; /* one before the first, then rows of tile_width: nearest surface, near / Z
                                              in the high bits, the triangle in the low id_bits; 0: none */
    gn_tile_pixels pixel;                  /* finished pixels in the picture's format */
    gn_vcache_entry vertex[GN_VERTEX_CACHE];
    gn_run_idx run_list[GN_RUN_LISTS]; /* first runs, by the low bits of their triangles; see gn_runs.h */
    gn_work work;
} gn_scratch;

#endif
#endif
