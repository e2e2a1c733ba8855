/* Compact arithmetic (GN_COMPACT): one directional light with one shadow tile, the hard filter and flat colours, in few
 * bytes of flash.
 *
 * Camera and light are projectors of one kind (gn_compact_view): the same code transforms, projects, sets up and draws
 * triangles into a screen tile and into the shadow tile. Lengths are 32 bits, products 64, and divisors are normalised
 * first. Ranges, and the errors that follow, are in docs/NUMERICS.md 4.15; values outside are refused, whether or not
 * validation is built.
 */
#ifndef GN_COMPACT_H
#define GN_COMPACT_H

#include "gnomon.h"

#define GN_COMPACT_LENGTH_Q16                                                                                          \
    (1 << 29) /* view coordinates and view depths are below: 8192 units; world positions below half of it */
#define GN_COMPACT_BITS      8            /* subpixel bits */
#define GN_COMPACT_REACH_Q16 (1440 << 16) /* pixels or texels from the raster's middle: (2 * 1440 * 2^8)^2 < 2^39 */

/* ---- Points ---- */

/* round(a * 2^30 / |a|), within 4 LSB; any length but zero, |a| < 2^62. Returns 0 if a is zero. */
int gn_compact_unit(int32_t out_q30[3], const int64_t a[3]);

/* a * b * 2^-(32 + shift) without the last bits of a * b; 0 <= shift < 32 */
uint32_t gn_compact_mul(uint32_t a, uint32_t b, int32_t shift);

/* Whether rotation, position and scale of an affine transform are in range. */
int gn_compact_affine_ok(const gn_affine *a);

/* From what `affine` transforms to the projector's axes; both are gn_compact_affine_ok. Returns 0 if a position is out
 * of range. */
int gn_compact_compose(gn_compact_xform *out, const gn_compact_view *view, const gn_affine *affine, int32_t frac_bits);

/* Returns 0 if the result is out of range. */
int gn_compact_transform(int32_t out_q16[3], const gn_compact_xform *xform, const int32_t p[3]);

/* Projects a point. Returns 0 if its depth from the light is out of range. */
int gn_compact_project(gn_compact_corner *corner, const gn_compact_view *view, const int32_t v_q16[3]);

/* ---- Clipping ---- */

/* Cuts the polygon of n points to the guard band, and of the camera to the near plane. Returns how many points are
 * left, 0 or 3 to 8. */
int gn_compact_clip(gn_compact_polygon *polygon, gn_compact_polygon *spare, int n, const gn_compact_view *view);

/* From keys of the light, Q18 texels, to steps of depth: a tile's width is 2^16 of them. */
#define GN_COMPACT_STEP_SHIFT(frame)                                                                                   \
    (GN_K(frame, atlas_size) == 16    ? 6                                                                              \
     : GN_K(frame, atlas_size) == 32  ? 7                                                                              \
     : GN_K(frame, atlas_size) == 64  ? 8                                                                              \
     : GN_K(frame, atlas_size) == 128 ? 9                                                                              \
                                      : 10)

/* U, V, D of a corner that the light has projected: texels, Q16. */
static inline void gn_compact_place(int32_t out_q16[3], const gn_compact_corner *corner)
{
    out_q16[0] = corner->at_q16[0];
    out_q16[1] = corner->at_q16[1];
    out_q16[2] = -(corner->key >> 2);
}

/* ---- gn_compact_triangle.c ---- */

/* The cells or texels that triangles are drawn into: one of them, of `rect` of the raster. */
typedef struct {
    const gn_frame *frame;
    gn_rect rect;
    uint32_t *cell;
    uint16_t *texel;
    uint32_t id, id_bits; /* of the triangle, in a cell */
    int32_t bias;         /* added to depth, in steps of keys */
} gn_compact_raster;

/* Draws a triangle: a larger cell or a smaller depth stays. */
void gn_compact_draw(const gn_compact_raster *raster, const gn_tri *tri);

/* A key at a pixel. */
static inline uint32_t gn_compact_key(const gn_tri *tri, int32_t x, int32_t y)
{
    int64_t step = (int64_t)(x - tri->begin[0]) * tri->key_dx + (int64_t)(y - tri->begin[1]) * tri->key_dy;
    return tri->key + (uint32_t)(step >> tri->frac_bits);
}

#endif
