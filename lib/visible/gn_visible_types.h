/* Visible triangles and what is seen of them in a screen tile. */
#ifndef GN_VISIBLE_TYPES_H
#define GN_VISIBLE_TYPES_H

#include "geometry/gn_geometry_types.h"
#include "visible/gn_screen_types.h"

/* 16 bits where a guard band of at least 8 pixels is left around every picture: gn_xform.c */
#define GN_COORD_PX_MAX (2 * ((32767 >> GN_SUBPIXEL_BITS) - 10))
#if GN_RUNTIME_KNOBS || GN_SUBPIXEL_BITS > 7 || GN_MAX_WIDTH > GN_COORD_PX_MAX || GN_MAX_HEIGHT > GN_COORD_PX_MAX
typedef int32_t gn_coord;
#else
typedef int16_t gn_coord;
#endif

/* A visible triangle on the screen, ready to be walked. Coordinates are from the picture's centre (y down), with
 * subpixel_bits fraction bits: up to 7 of them fit 16 bits in most pictures, as the guard band sees to. */
typedef struct {
    gn_coord x[3], y[3];  /* top, left and right of it: counter-clockwise in the world, its signed area on the screen (y
                             down) is negative */
    uint32_t iz_ref;      /* near / Z at the centre of the pixel that holds vertex 0, Q0.32, modulo 2^32 */
    int32_t iz_dx, iz_dy; /* per pixel, modulo 2^32 */
    uint16_t iz_min, iz_max; /* bounds of near / Z, Q0.16, rounded outwards; where none are needed, 1 + gn_walk_lasts or
                                GN_NARROW, and 0 */
    uint16_t object_idx;
    uint16_t triangle_idx;
} gn_tri;

typedef struct {
    uint32_t tag; /* object << 16 | vertex, plus one; 0: empty */
    int32_t v_q16[3];
} gn_vcache_entry;

#if GN_MAX_TILE_REFS > 65535
typedef uint32_t gn_ref_offset;
#else
typedef uint16_t gn_ref_offset;
#endif

#define GN_RUN_LISTS 64
#if GN_TILE_PIXELS_MAX > 65535
typedef uint32_t gn_run_idx;
#else
typedef uint16_t gn_run_idx;
#endif

#endif
