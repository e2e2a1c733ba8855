/* From projected triangles to triangles ready to draw: snapped, culled, counted in screen tiles, with a depth plane. */
#ifndef GN_SCREEN_TRIANGLE_H
#define GN_SCREEN_TRIANGLE_H

#include "gnomon.h"
#include "visible/gn_raster.h"

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
    uint16_t *place; /* see gn_setup.h */
#if GN_GROUPS
    gn_tri_group *group;      /* of the next triangle; it grows by it */
    gn_screen_tile_job *tile; /* NULL in a frame's setup: triangles are counted */
#endif
    int32_t add_px[2];  /* see gn_setup_bounds_of */
    int32_t fixed_mask; /* 0 if alpha cuts the object: the fast path for small triangles in gn_raster.c is not used */
    int32_t narrow;     /* gn_walk_narrow, 0 there too */
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
