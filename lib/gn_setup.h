/* Visible triangles: transform, cull, clip, project, and set up edges and depth (R2, R3). */
#ifndef GN_SETUP_H
#define GN_SETUP_H

#include "gnomon.h"

/* Fills frame->tri from the scene. The vertex cache is scratch. */
gn_status gn_setup_triangles(gn_frame *frame, gn_vcache_entry *cache);

/* View position of an object's vertex through the cache. Returns 0 if it is beyond +-16384 units, or
 * its position beyond +-2^30. */
int gn_setup_vertex(int32_t out_q16[3], gn_vcache_entry *cache, const gn_xform *xform, const gn_mesh *mesh, uint32_t object_idx,
                    uint32_t vertex_idx);

/* Pixels whose centres lie in the triangle's bounding box, cut to the picture: x0 <= x < x1, y0 <= y < y1. */
typedef struct {
    int32_t x0, y0, x1, y1;
} gn_rect;
/* Screen coordinates of the corners from the picture's top left corner, subpixel_bits fraction bits. */
void gn_setup_corners(const gn_frame *frame, const gn_tri *tri, int32_t x[3], int32_t y[3]);

gn_rect gn_setup_bounds(const gn_frame *frame, const gn_tri *tri);

#endif
