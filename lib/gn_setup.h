/* Visible triangles: transform, cull, clip, project, and set up edges and depth (R2, R3). */
#ifndef GN_SETUP_H
#define GN_SETUP_H

#include "gnomon.h"

/* Fills frame->tri from the scene, and counts the triangles of each screen tile. The memory is scratch, for a cache of vertices: at least 8 words. */
gn_status gn_setup_triangles(gn_frame *frame, gn_clipping *clipping, uint32_t *memory, uint32_t n_words);

/* View position of an object's vertex through the cache. Returns 0 if it is beyond +-16384 units, or
 * its position beyond +-2^30. */
int gn_setup_vertex(int32_t out_q16[3], gn_vcache_entry *cache, const gn_xform *xform, const gn_mesh *mesh, uint32_t object_idx,
                    uint32_t vertex_idx);

/* Screen coordinates of the corners from the picture's top left corner, subpixel_bits fraction bits. */
void gn_setup_corners(const gn_frame *frame, const gn_tri *tri, int32_t x[3], int32_t y[3]);

gn_rect gn_setup_bounds(const gn_frame *frame, const gn_tri *tri);

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
