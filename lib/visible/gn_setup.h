/* Visible triangles: transform, cull, clip, project, and set up edges and depth. */
#ifndef GN_SETUP_H
#define GN_SETUP_H

#include "base/gn_q.h"
#include "geometry/gn_walk.h"
#include "gnomon.h"
#include "visible/gn_raster.h"

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

#endif
