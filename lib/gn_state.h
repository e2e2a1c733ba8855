/* The layout of a renderer's state. Private: it may change with every version; included by gnomon.h so that it has a size.
 *
 * gn_frame is written by begin, shadow tiles and prepare, and read only while screen tiles are drawn. gn_scratch is what one
 * core needs to draw a screen tile.
 */
#ifndef GN_STATE_H
#define GN_STATE_H

/* A transform composed for one object: out = round((m * p) / 2^shift) + t, t and out with 16 fraction bits. */
typedef struct {
    int32_t m[3][3]; /* |row| <= 2^30 */
    int64_t t_q16[3];
    int32_t shift;
} gn_xform;

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
    int32_t coord_max;          /* of screen coordinates from the picture's centre */
    int32_t tan_q16[2];         /* the same for the picture's border: (W/2) / F, (H/2) / F, rounded up */
} gn_cam;

#if GN_SHADOWS
/* Light coordinates of a surface point at view depth z on the ray through a pixel: z * (a0 + ax * px + ay * py) + d, per axis. */
typedef struct {
    int32_t a0, ax, ay;
    int64_t d_q16;
} gn_ray_plane;

typedef struct {
    uint16_t lo, hi;
} gn_depth_block; /* see gn_blocks.h */

typedef struct {
    int32_t axis_q30[3][3]; /* u, v, w in the world */
    gn_bfloat inv_texel;    /* texels per world unit */
    int32_t origin[3];      /* whole texels */
    gn_ray_plane ray[3];
    int32_t ray_shift;  /* fraction bits of a0, ax, ay */
    int32_t offset_q16; /* B2 receiver offset along the normal, texels */
    int32_t bias_constant_q16, bias_slope_q16;
    uint32_t strength_uq16;
    uint16_t tile_texels; /* T */
    uint8_t tile_log2;    /* T = 2^tile_log2 */
    uint8_t depth_log2;   /* J: the depth range is T * 2^J texels */
    uint8_t filter;
    uint8_t tile_done;
    uint8_t empty; /* its cascade has no slice: never drawn, never selected */
    uint16_t light_idx;
    uint16_t *depth; /* T * T, row by row, inside the atlas */
#if GN_DEPTH_BLOCKS
    gn_depth_block *block; /* (T / 8) * (T / 8) */
#endif
} gn_light_view;
#endif

#if GN_SHADOWS
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
    int32_t to_light_q30[3]; /* unit, surface towards the light */
    uint32_t colour_uq16[3];
    int32_t view_idx; /* of its first gn_light_view, -1: no shadow */
} gn_light_state;

#if GN_RUNTIME_KNOBS || GN_SUBPIXEL_BITS > 6
typedef int32_t gn_coord;
#else
typedef int16_t gn_coord;
#endif

/* A visible triangle on the screen, ready to be walked. Coordinates are from the picture's centre (y down), with subpixel_bits
 * fraction bits: up to 6 of them fit 16 bits, as the guard band sees to. */
typedef struct {
    gn_coord x[3], y[3];     /* counter-clockwise in the world, so that its signed area on the screen (y down) is negative */
    uint32_t iz_ref;         /* near / Z at the centre of the pixel that holds vertex 0, Q0.32, modulo 2^32 */
    int32_t iz_dx, iz_dy;    /* per pixel, modulo 2^32 */
    uint16_t iz_min, iz_max; /* bounds of near / Z, Q0.16, rounded outwards */
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
    gn_picture picture;
    const gn_scene *scene;
    gn_stats stats;
    gn_detail detail;
    uint8_t stage;   /* gn_stage in gn_frame.c */
    uint8_t id_bits; /* of a visibility cell: enough for n_triangles + 1 */
    uint16_t n_views;
    gn_cam cam;
    gn_light_state light[GN_MAX_LIGHTS];
    uint32_t fade_start_q16; /* D5: strength = (max_distance - z) * fade_scale */
    gn_bfloat fade_scale;
    uint16_t tiles_x, tiles_y;
    gn_tri tri[GN_MAX_TRIANGLES];
    gn_ref_offset tile_first[GN_TILES_MAX + 1];
    uint16_t tile_ref[GN_MAX_TILE_REFS];
#if GN_SHADOWS
    gn_cascade_state cascade[4];
    uint8_t n_cascades;
    uint8_t last_cascade;                    /* the last that is not empty */
    gn_light_view view[GN_MAX_SHADOW_TILES]; /* light by light, cascade by cascade */
    uint16_t atlas[GN_ATLAS_SIZE * GN_ATLAS_SIZE];
#if GN_DEPTH_BLOCKS
    gn_depth_block block[GN_ATLAS_SIZE * GN_ATLAS_SIZE / 64];
#endif
#endif
} gn_frame;

typedef union {
    uint8_t bytes[GN_TILE_PIXELS_MAX * (GN_RAW_VIEWS ? 4 : 3)];
    uint16_t rgb565[GN_TILE_PIXELS_MAX];
    uint32_t raw[GN_TILE_PIXELS_MAX * (GN_RAW_VIEWS ? 4 : 3) / 4];
} gn_tile_pixels;

typedef struct gn_scratch {
    uint32_t cell[GN_TILE_PIXELS_MAX]; /* nearest surface: near / Z in the high bits, the triangle in the low id_bits; 0: none */
    gn_tile_pixels pixel;              /* finished pixels in the picture's format */
    gn_vcache_entry vertex[GN_VERTEX_CACHE];
} gn_scratch;

#endif
