/* Visible triangles, and the visible spans of a screen tile. */
#ifndef GN_VISIBLE_TYPES_H
#define GN_VISIBLE_TYPES_H

#include "geometry/gn_geometry_types.h"
#include "visible/gn_screen_types.h"

/* 16 bits if that leaves a guard band of at least 8 pixels around every picture: gn_xform.c */
#define GN_COORD_PX_MAX (2 * ((32767 >> GN_SUBPIXEL_BITS) - 10))
#if GN_RUNTIME_KNOBS || GN_SUBPIXEL_BITS > 7 || GN_MAX_WIDTH > GN_COORD_PX_MAX || GN_MAX_HEIGHT > GN_COORD_PX_MAX
typedef int32_t gn_coord;
#else
typedef int16_t gn_coord;
#endif

/* How a triangle is drawn whose depth needs no bounds; other values are the rows that gn_walk_lasts gave. A mask:
 * GN_TRI_MASK + (1 + columns from its box to the top) << 12 + its pixels, see gn_pixel_mask(). */
enum { GN_TRI_EXACT = 1, GN_TRI_MASK = 0x8000 };

/* If near / Z may leave the triangle's range where it is drawn: that range. If not, which is common: how the triangle
 * may be drawn. gn_tri_is_bounded tells the two apart. */
typedef union {
    struct {
        uint16_t least, largest; /* Q0.16, rounded outwards: least <= largest */
    } bounds;
    struct {
        uint16_t walk; /* above 0: GN_TRI_EXACT, a mask or rows */
        uint16_t zero;
    } unbounded;
} gn_tri_depth;

/* What a visible triangle is, or is a part of. */
typedef struct {
    uint16_t object_idx;
    uint16_t triangle_idx;
} gn_tri_source;

/* A visible triangle on the screen, ready to be walked. Coordinates are from the picture's centre (y down), with
 * subpixel_bits fraction bits: up to 7 of them fit 16 bits in most pictures, by the width of the guard band. */
typedef struct {
    gn_coord x[3], y[3];  /* top, left and right of it: counter-clockwise in the world, its signed area on the screen (y
                             down) is negative */
    uint32_t iz_ref;      /* near / Z at the centre of the pixel that contains vertex 0, Q0.32, modulo 2^32; its three
                             lowest bits: gn_tri_order() */
    int32_t iz_dx, iz_dy; /* per pixel, modulo 2^32 */
    gn_tri_depth iz;
    gn_tri_source source;
} gn_tri;

/* The screen tiles that visible triangles of a group may have pixels in, four numbers of 7 bits in bytes: first column,
 * 127 - last column, first row, 127 - last row. */
typedef uint32_t gn_tri_group;
#define GN_GROUP_EMPTY 0x7F7F7F7FU
#define GN_GROUPS_MAX  (GN_RUNTIME_KNOBS ? 4096 : GN_TRIANGLE_GROUPS)

/* Which vertices of the mesh a record's corners are: 1, 2, 3: 012, 120, 201; 4, 5, 6, of triangles that are seen from
 * behind: 021, 210, 102. */
enum { GN_TRI_CUT = 0 /* corners are no vertices */, GN_TRI_BACK = 4, GN_TRI_STEEP = 7 /* no plane of near / Z */ };

static inline uint32_t gn_tri_order(const gn_tri *tri)
{
    return tri->iz_ref & 7U;
}

static inline int gn_tri_is_bounded(const gn_tri *tri)
{
    return tri->iz.bounds.least <= tri->iz.bounds.largest;
}

static inline void gn_tri_set_walk(gn_tri *tri, int32_t walk)
{
    tri->iz.unbounded.walk = (uint16_t)walk;
    tri->iz.unbounded.zero = 0;
}

#if GN_MAX_TILE_REFS > 65535
typedef uint32_t gn_ref_offset;
#else
typedef uint16_t gn_ref_offset;
#endif

#if GN_LAYERS_MAX
/* Cells of a screen tile's transparent surfaces: of each pixel the nearest ones, the nearest first. */
typedef struct {
    int32_t n; /* layers with pixels; 0: the memory is not in use */
    union {
        uint32_t cell[GN_TILE_PIXELS_MAX];
        gn_tile_pixels pixels; /* of the layer, while it is mixed with what is behind */
    } layer[GN_LAYERS_MAX];
} gn_layers;
#endif

#define GN_RUN_LISTS 64
#if GN_TILE_PIXELS_MAX > 65535
typedef uint32_t gn_run_idx;
#else
typedef uint16_t gn_run_idx;
#endif

#endif
