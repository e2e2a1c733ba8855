/* The layout of a renderer's state. Private: it may change with every version; included by gnomon.h so that it has a
 * size.
 *
 * gn_frame is written by begin, shadow tiles and prepare, and read only while screen tiles are drawn. gn_scratch is the
 * memory that one core needs to draw a screen tile.
 */
#ifndef GN_STATE_H
#define GN_STATE_H

#if GN_COMPACT
#include "compact/gn_compact_types.h"
#else
#include "shade/gn_lattice_types.h"

/* Records of visible triangles; until gn_prepare writes them, vertices that skins moved: gn_posed_vertex. */
typedef union {
    gn_tri tri[GN_RECORDS ? GN_MAX_TRIANGLES : 1];
    int32_t word[(GN_RECORDS ? GN_MAX_TRIANGLES : 1) * (sizeof(gn_tri) / sizeof(int32_t))];
} gn_records;

#if GN_CHANGES
/* Signatures of a frame: what the next one need not draw again. gn_changes.c */
typedef struct {
    uint64_t scene;           /* of all that was described; 0: not known */
    uint64_t settings, every; /* of what is neither object nor light; of what all screen tiles depend on */
    uint64_t before, now;     /* of all texels of shadow maps, in the frame before and in this one; 0: not known */
    uint64_t object[GN_MAX_OBJECTS], light[GN_MAX_LIGHTS];
    uint64_t square[GN_SHADOWS ? GN_SQUARES : 1]; /* of the texels of each */
    gn_squares changed;                           /* since the frame before */
    uint64_t places;                              /* of squares in the maps */
    uint32_t moved;                               /* these have: squares of kept tiles are to be signed anew, too */
    uint32_t n_forgotten;                         /* calls of gn_forget_shadows */
} gn_frame_sign;
#endif

typedef struct gn_frame {
#if GN_RUNTIME_KNOBS
    gn_knobs knobs;
    uint32_t texels[2]; /* of each atlas; 0: as built */
#endif
    /* small fields come first: instructions address them by a short offset */
    const gn_scene *scene;
    const gn_object *objects; /* the scene's: gn_pick reads these when the scene may be gone */
    uint32_t n_objects;
    gn_picture picture;
    uint8_t stage;   /* gn_stage in gn_internal.h */
    uint8_t id_bits; /* of a visibility cell: enough for n_triangles + 2 */
    uint16_t n_views;
    uint16_t tiles_x, tiles_y;
    gn_cam cam;
    uint64_t min2_q32;           /* minimum distance^2 of spot and point lights, 10^-4 of the model's */
    int32_t receivers_q16[2][3]; /* box of all receiving objects: min, max corner; for culling */
    int64_t tan2_per_px2_q44;    /* the same per squared distance from the centre, in half pixels */
    int64_t tan2_q24;            /* square of the half-diagonal's tangent */
    uint32_t fade_start_q16;     /* distance fade: strength = (max_distance - z) * fade_scale */
    gn_bfloat fade_scale;
    gn_stats stats;
    gn_detail detail;
#if GN_SHADOWS
    uint8_t n_cascades;
    uint8_t last_cascade; /* the last that is not empty */
    uint8_t has_cascades; /* some directional light has tiles in the directional atlas: the last sphere ends shadows */
    uint8_t n_lights;     /* of the scene, which may be gone when gn_get_light_shadow is called */
    uint32_t frame_count; /* for the schedule of cascades */
    gn_cascade_state cascade[4];
#endif
    gn_light_state light[GN_MAX_LIGHTS];
#if GN_SHADOWS
    gn_light_view view[GN_VIEWS_MAX]; /* light by light, cascade by cascade or face by face */
#if GN_TIGHT_FIT
    gn_view_seen seen[GN_VIEWS_MAX];
#endif
#endif
#if GN_BOXES
    gn_object_state object[GN_MAX_OBJECTS];
#endif
#if GN_CHANGES
    gn_frame_sign sign;
#endif
    uint8_t flags[GN_MAX_OBJECTS]; /* of each object, as drawn: scene/gn_scene.h */
    gn_records records;
    gn_ref_offset tile_first[GN_TILES_MAX + 1]; /* of groups: a tile's number of triangles */
    uint16_t tile_ref[GN_RECORDS ? GN_MAX_TILE_REFS : 1];
#if GN_GROUPS
    gn_tri_group group[GN_GROUPS_MAX];
    uint32_t n_grouped;  /* triangles of all objects that are not hidden, in their order */
    uint8_t group_shift; /* triangle t of them is in group t >> group_shift */
#endif
#if GN_SHADOWS
#if GN_INCREMENTAL
    gn_tile_memory memory[GN_VIEWS_MAX];
    uint64_t layout; /* signature of the tiles' positions: kept tiles are discarded when it changes */
#endif
    gn_atlas_texels atlas;
#if GN_STATIC_LAYER
    gn_atlas_texels static_atlas;
#endif
#if GN_DISK_FILTER
    gn_depth_block block[GN_ATLAS_TEXELS / 64];
#endif
#if GN_OTHER_ATLAS
    gn_other_texels other_atlas;
#if GN_STATIC_LAYER
    gn_other_texels static_other_atlas;
#endif
#if GN_DISK_FILTER
    gn_depth_block other_block[GN_OTHER_ATLAS_TEXELS / 64];
#endif
#endif
#endif
} gn_frame;

#define GN_N_CASCADES(frame)   (GN_MANY_CASCADES ? (frame)->n_cascades : 1)
#define GN_LAST_CASCADE(frame) (GN_MANY_CASCADES ? (frame)->last_cascade : 0)

/* The memory of one core: its jobs run one at a time. */
typedef union {
    gn_shading shading;
    gn_clipping clipping;
#if GN_VISIBLE_ALPHA
    gn_alpha_cut cut;
#endif
#if GN_SHADOWS
    gn_casting casting;
#if GN_TIGHT_FIT
    gn_seen_job seen;
#endif
#endif
} gn_work;

#if GN_GROUPS
/* What of it drawing a triangle takes; the rest is free while screen tiles set up triangles. */
typedef union {
    gn_clipping clipping;
#if GN_VISIBLE_ALPHA
    gn_alpha_cut cut;
#endif
} gn_work_drawn;
#define GN_WORK_DRAWN_BYTES ((sizeof(gn_work_drawn) + 7) / 8 * 8)
#define GN_WORK_FREE_BYTES  (sizeof(gn_work) - GN_WORK_DRAWN_BYTES)
#endif

/* The cells of a screen tile. */
#define GN_CELLS(scratch) ((scratch)->cell + 1)

typedef struct gn_scratch {
    uint32_t cell[1 + GN_TILE_PIXELS_MAX]; /* one before the first, then rows of tile_width: nearest surface, near / Z
                                              in the high bits, the triangle in the low id_bits; 0: none */
    gn_tile_pixels pixel;                  /* finished pixels in the picture's format */
    gn_vertex_entry vertex[GN_VERTEX_CACHE];
    gn_run_idx run_list[GN_RUN_LISTS];         /* first runs, by the low bits of their triangles; see gn_runs.h */
#if GN_GROUPS
    gn_tri_source drawn[1 + GN_MAX_TRIANGLES]; /* the tile's triangles by their identities: none is 0 */
#endif
#if GN_CHANGES
    gn_squares squares;                        /* that the tile's lookups read */
#endif
#if GN_LAYERS_MAX
    gn_layers layers;
#endif
    gn_work work;
} gn_scratch;

#endif
#endif
