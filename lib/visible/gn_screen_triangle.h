/* From projected triangles to triangles ready to draw, and the screen tiles that groups of them meet. */
#ifndef GN_SCREEN_TRIANGLE_H
#define GN_SCREEN_TRIANGLE_H

#include "visible/gn_raster.h"
#include "gnomon.h"

/* ---- Groups of triangles: which screen tiles they meet. See gn_tri_group ----------------------------------------- */

/* Columns x0 .. x1 and rows y0 .. y1 of screen tiles, below 128. */
static inline gn_tri_group gn_group_of(uint32_t x0, uint32_t x1, uint32_t y0, uint32_t y1)
{
    return x0 | (127 - x1) << 8 | y0 << 16 | (127 - y1) << 24;
}

/* Bit 7 of every byte of `a` that is at most that of `b`. */
static inline uint32_t gn_group_at_most(gn_tri_group a, gn_tri_group b)
{
    return ((b | 0x80808080U) - a) & 0x80808080U;
}

/* All tiles between those of both: the smaller byte. */
static inline gn_tri_group gn_group_union(gn_tri_group a, gn_tri_group b)
{
    const uint32_t from_a = (gn_group_at_most(a, b) >> 7) * 127;
    return (a & from_a) | (b & ~from_a);
}

/* Whether a group meets a screen tile, given as one group_of of it alone. */
static inline int gn_group_meets(gn_tri_group group, gn_tri_group tile)
{
    return gn_group_at_most(group, tile) == 0x80808080U;
}

/* From projected triangles to triangles ready to draw: snapped, culled, counted in screen tiles, with a depth plane. */

/* A vertex on the screen, in the guard band. */
typedef struct {
    int32_t x_q16, y_q16; /* pixels from the picture's centre, y down: below 2^11 pixels */
    uint32_t iz_q32;      /* near / Z */
} gn_projected;

#if GN_GROUPS
/* A screen tile whose triangles are drawn as they are set up. */
typedef struct {
    const gn_raster_target *target;
    gn_rect rect;
    gn_tri_source *drawn; /* by identity */
    uint32_t n_drawn, n_counted;
} gn_screen_tile_job;
#endif

/* Constants of one object's triangles. */
typedef struct {
    const gn_frame *frame;
    const gn_object *object;
    uint32_t object_idx;
    uint32_t sides;  /* GN_SIDE_... that are drawn */
    gn_stats *stats; /* this and the next are written in a frame's setup only */
    gn_ref_offset *tile_first;
    gn_tri *tri;
#if GN_GROUPS
    gn_tri_group *group;      /* of the next triangle; it grows by it */
    gn_screen_tile_job *tile; /* NULL in a frame's setup: triangles are counted */
#endif
    int32_t add_px[2];  /* see gn_setup_bounds_of */
    int32_t fixed_mask; /* 0 if alpha cuts the object: the fast paths for small triangles in gn_raster.c are not used */
} gn_screen_job;

/* Sets the frame's constants, and one object's, except its position and index, and what is written. */
void gn_screen_begin(gn_screen_job *job, const gn_frame *frame);
void gn_screen_object(gn_screen_job *job);

/* Added to the index of a triangle of which a part is drawn: the near plane or the guard band cut it. */
#define GN_TRI_PART 0x10000U

/* A triangle in the guard band, counter-clockwise in the world if it faces the camera, or clockwise if a mirror turned
 * it: nothing if it faces away or covers no pixel centre. */
void gn_screen_triangle(const gn_screen_job *job, const gn_projected *p0, const gn_projected *p1,
                        const gn_projected *p2, uint32_t triangle_idx);

/* The record of such a triangle, made again. Returns 0 if it faces away. */
int gn_screen_record(const gn_screen_job *job, const gn_projected *p0, const gn_projected *p1, const gn_projected *p2,
                     uint32_t triangle_idx, gn_tri *out);

#endif
