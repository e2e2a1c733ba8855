/* Visible triangles: transform, cull, clip, project, and set up edges and depth (R2, R3). */
#ifndef GN_SETUP_H
#define GN_SETUP_H

#include "gn_q.h"
#include "gn_walk.h"
#include "gnomon.h"

/* Fills frame->tri from the scene, and counts the triangles of each screen tile. The memory is scratch, for a cache of vertices: at least 8 words. */
gn_status gn_setup_triangles(gn_frame *frame, gn_clipping *clipping, uint32_t *memory, uint32_t n_words);

/* View position of an object's vertex through the cache. Returns 0 if it is beyond +-16384 units, or
 * its position beyond +-2^30. */
int gn_setup_vertex(int32_t out_q16[3], gn_vcache_entry *cache, const gn_xform *xform, const gn_mesh *mesh, uint32_t object_idx,
                    uint32_t vertex_idx);

/* Screen coordinates of the corners from the picture's top left corner, subpixel_bits fraction bits. */
void gn_setup_corners(const gn_frame *frame, const gn_tri *tri, int32_t x[3], int32_t y[3]);

/* Pixels whose centres lie between the least and largest coordinates, from the picture's centre, in the subpixel grid: cut to the picture. */
static inline gn_rect gn_setup_bounds_of(const gn_frame *frame, int32_t left, int32_t right, int32_t top, int32_t bottom)
{
    int32_t bits = GN_K(frame, subpixel_bits), width = frame->picture.width, height = frame->picture.height;
    int32_t centre_x = (width << bits) >> 1, centre_y = (height << bits) >> 1;
    gn_rect r;
    r.x0 = gn_max32(gn_first_px(left + centre_x, bits), 0);
    r.x1 = gn_min32(gn_first_px(right + centre_x, bits), width);
    r.y0 = gn_max32(gn_first_px(top + centre_y, bits), 0);
    r.y1 = gn_min32(gn_first_px(bottom + centre_y, bits), height);
    return r;
}

static inline gn_rect gn_setup_bounds(const gn_frame *frame, const gn_tri *tri)
{
    int32_t x0 = tri->x[0], x1 = tri->x[1], x2 = tri->x[2];
    return gn_setup_bounds_of(frame, gn_min32(gn_min32(x0, x1), x2), gn_max32(gn_max32(x0, x1), x2), tri->y[0], gn_max32(tri->y[1], tri->y[2]));
}

/* The screen tiles that pixels of the picture lie in, some at least: `height` rows of `width` tiles, with `skip` others between. */
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

#endif
