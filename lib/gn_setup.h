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

/* The screen tiles that pixels of the picture lie in, as a rectangle of tiles. */
static inline gn_rect gn_setup_tiles(const gn_frame *frame, const gn_rect *px)
{
    uint32_t w = (uint32_t)GN_K(frame, tile_width), h = (uint32_t)GN_K(frame, tile_height); /* nothing is negative */
    gn_rect r;
    r.x0 = (int32_t)((uint32_t)px->x0 / w);
    r.y0 = (int32_t)((uint32_t)px->y0 / h);
    r.x1 = (int32_t)((uint32_t)(px->x1 - 1) / w) + 1;
    r.y1 = (int32_t)((uint32_t)(px->y1 - 1) / h) + 1;
    return r;
}

#endif
