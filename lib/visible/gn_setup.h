/* Visible triangles: transform, cull, clip, project, and set up edges and depth. */
#ifndef GN_SETUP_H
#define GN_SETUP_H

#include "base/gn_base_types.h"
#include "base/gn_q.h"
#include "geometry/gn_walk.h"
#include "gnomon.h"

/* ---- Drawing a screen tile's triangles as they are set up -------------------------------------------------------- */

/* A screen tile that is being drawn. */
typedef struct gn_raster_target gn_raster_target;

/* Constants of a triangle's rows. A candidate cell is depth in the high bits, identity in the low ones. */
typedef struct {
    uint32_t minus_dx;  /* from a cell to the one before it */
    uint32_t lo, range; /* depth inside the triangle: lo .. lo + range */
    uint32_t id_mask;
    uint32_t below; /* id_mask - id: from a cell with all identity bits set to the triangle's cell */
} gn_raster_depth;

/* Depth is linear over a row; inside the triangle it stays within its range. A snapped edge can extend past the
 * unsnapped triangle by a fraction of a pixel, so values outside are clamped to the nearer end (modulo 2^32). */
GN_HOT static inline uint32_t gn_raster_clamp(uint32_t v, const gn_raster_depth *depth)
{
    uint32_t above = v - depth->lo;
    if (above <= depth->range) return v;
    return 0U - above < above - depth->range ? depth->lo : depth->lo + depth->range;
}

/* Draws a triangle whose bounds intersect the tile. Identities must ascend. */
void gn_raster_triangle(const gn_raster_target *target, const gn_tri *tri, uint32_t id);

/* View position of an object's vertex through the cache. Returns 0 if it is beyond +-16384 units, or
 * its position beyond +-2^30. */
int gn_setup_vertex(int32_t out_q16[3], gn_vertex_entry *cache, const gn_xform *xform, const gn_object *object,
                    uint32_t object_idx, uint32_t vertex_idx);

/* Sets up and draws the triangles of a screen tile, the scene's last first. Pixel memory holds a vertex cache. */
void gn_setup_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx, const gn_raster_target *target);

/* The record of a triangle whose tile draws groups, made again: work.clipping is not used. Returns 0 for one that is
 * cut. */
int gn_setup_record(const gn_frame *frame, gn_scratch *scratch, const gn_tri_source *source, gn_tri *out);

/* Screen coordinates of the corners from the picture's top left corner, subpixel_bits fraction bits. */
void gn_setup_corners(const gn_frame *frame, const gn_tri *tri, int32_t x[3], int32_t y[3]);

/* Pixels whose centres lie between the smallest and largest coordinates, from the picture's centre, in the subpixel
 * grid: cut to the picture. Before the shift the picture's centre and the rounding of gn_first_px are added. */
static inline gn_rect gn_setup_bounds_of(const gn_frame *frame, int32_t left, int32_t right, int32_t top,
                                         int32_t bottom, int32_t add_x, int32_t add_y)
{
    int32_t bits = GN_K(frame, subpixel_bits);
    gn_rect r;
    r.x0 = gn_max32((left + add_x) >> bits, 0);
    r.x1 = gn_min32((right + add_x) >> bits, frame->picture.width);
    r.y0 = gn_max32((top + add_y) >> bits, 0);
    r.y1 = gn_min32((bottom + add_y) >> bits, frame->picture.height);
    return r;
}

static inline int32_t gn_setup_add(int32_t size_px, int32_t bits)
{
    return ((size_px << bits) >> 1) + ((1 << bits) >> 1) - 1;
}

static inline gn_rect gn_setup_bounds(const gn_frame *frame, const gn_tri *tri)
{
    int32_t x0 = tri->x[0], x1 = tri->x[1], x2 = tri->x[2], bits = GN_K(frame, subpixel_bits);
    return gn_setup_bounds_of(frame, gn_min32(gn_min32(x0, x1), x2), gn_max32(gn_max32(x0, x1), x2), tri->y[0],
                              gn_max32(tri->y[1], tri->y[2]), gn_setup_add(frame->picture.width, bits),
                              gn_setup_add(frame->picture.height, bits));
}

/* The screen tiles of a rectangle of pixels, at least one: `height` rows of `width` tiles, with `skip` others between
 * rows. */
typedef struct {
    uint32_t first;
    int32_t width, height, skip;
} gn_tile_walk;

static inline gn_tile_walk gn_setup_tiles(const gn_frame *frame, const gn_rect *px)
{
    uint32_t w = (uint32_t)GN_K(frame, tile_width), h = (uint32_t)GN_K(frame, tile_height); /* nothing is negative */
    uint32_t x = (uint32_t)px->x0 / w, y = (uint32_t)px->y0 / h, tiles_x = frame->tiles_x;
    gn_tile_walk tiles;
    tiles.first = y * tiles_x + x;
    tiles.width = (int32_t)((uint32_t)(px->x1 - 1) / w - x) + 1;
    tiles.height = (int32_t)((uint32_t)(px->y1 - 1) / h - y) + 1;
    tiles.skip = (int32_t)tiles_x - tiles.width;
    return tiles;
}

/* ---- From projected triangles to triangles ready to draw, and the screen tiles that groups of them meet ---------- */

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
