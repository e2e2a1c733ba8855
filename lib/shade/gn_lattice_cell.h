/* The cell at hand: its tolerances, how uneven it is, its shadows. Parts of gn_lattice_look. */
#ifndef GN_LATTICE_CELL_H
#define GN_LATTICE_CELL_H

#include "base/gn_q.h"
#include "shade/gn_lattice_look.h"

#if GN_INTERPOLATES

/* Verdict on a light's shadow over a whole cell: all of it is lit, or dark; it has an edge in it, so that it is looked
 * up at nodes; or the cell has to be split to tell. */
enum { GN_CELL_LIT, GN_CELL_DARK, GN_CELL_EDGE, GN_CELL_SPLIT };

/* A share of a value: v * share, 65536: all of it. */
GN_HOT static inline int32_t gn_cell_share(int32_t v_q24, uint32_t share_uq16)
{
    return share_uq16 == 65536 ? v_q24 : (int32_t)gn_mul_uq16((uint32_t)v_q24, share_uq16);
}

GN_HOT static inline uint32_t gn_cell_strongest(const uint32_t colour_uq16[3])
{
    const uint32_t most = colour_uq16[0] > colour_uq16[1] ? colour_uq16[0] : colour_uq16[1];
    return colour_uq16[2] > most ? colour_uq16[2] : most;
}

/* Whether light of a colour is limited, which hides how bright what texture or vertex colours dim is. */
int gn_cell_is_limited(const gn_surface *s, const uint32_t colour_uq16[3], int32_t most_q24);

/* The same of irradiance, of which colour, shadow and mask leave less than 1. */
int gn_cell_hides(const uint32_t colour_uq16[3], int32_t most_q24, uint32_t share_uq16);

/* ---- Tolerances -------------------------------------------------------------------------------------------------- */

/* Light between corners may be off by 2^-this of what arrives; 0: by as much as arrives. */
GN_HOT static inline int32_t gn_cell_light_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) >= 8 ? 0 : 7;
}

/* The sum of all lights may be off by 2^this times as much with the fastest shading. */
GN_HOT static inline int32_t gn_cell_sum_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 16;
}

/* Smooth bodies are made of small surfaces with corners of their own: what interpolation is off by is not the same on
 * both sides of an edge, and is seen sooner. Normals count as turning 2^this times as much. */
GN_HOT static inline int32_t gn_cell_turn_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 8;
}

/* Where shadows begin or end to fade with depth they may change by 2^-this over a cell: they are off by that at most.
 */
GN_HOT static inline int32_t gn_cell_fade_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 16 ? 3 : GN_K(frame, persp_step) == 8 ? 4 : 5;
}

/* Cells of this size are not split any more, unless they have no corners. */
GN_HOT static inline int32_t gn_cell_finest_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 16 ? 3 : 2;
}

#if GN_SHADOWS
/* Places in shadow maps may be off by 2^-this texels. */
GN_HOT static inline int32_t gn_cell_place_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 16 ? 2 : 3;
}
#endif

#if GN_TEXTURES
/* Texture coordinates may be off by 2^-this texels; where the nearest texel is taken, a whole texel is at stake. */
GN_HOT static inline int32_t gn_cell_texture_log2(const gn_frame *frame, const gn_texture *texture)
{
    const int nearest = texture && !(texture->flags & GN_TEXTURE_BILINEAR);
    (void)frame;
    if (GN_K(frame, persp_step) == 16) return 5 + nearest;
    return GN_K(frame, persp_step) == 8 && !nearest ? 6 : 9;
}
#endif

#if GN_SHADOWS || GN_MASKS || GN_VERTEX_COLOURS
/* Largest less smallest of four values. */
GN_HOT static inline uint32_t gn_cell_spread(int32_t a, int32_t b, int32_t c, int32_t d)
{
    int32_t lo = gn_min32(gn_min32(a, b), gn_min32(c, d)), hi = gn_max32(gn_max32(a, b), gn_max32(c, d));
    return (uint32_t)hi - (uint32_t)lo;
}
#endif

#if GN_VERTEX_COLOURS
/* Whether a light times a vertex colour, up to 2^28 and 2^16, is close to linear: the product of both changes is at
 * most 2^-log2 of the least product and 1/32. */
GN_HOT static inline int gn_cell_product_holds(uint32_t change_q24, int32_t least_q24, uint32_t tints_q16,
                                               int32_t dimmest_q16, int32_t log2)
{
    const uint64_t both = (uint64_t)(uint32_t)gn_max32(least_q24, 0) * (uint32_t)gn_max32(dimmest_q16, 0) >> 16;
    return ((uint64_t)change_q24 * tints_q16 >> 16) << log2 <= both + (1U << 19);
}
#endif

/* |b - a| */
GN_HOT static inline uint32_t gn_cell_change(int32_t a, int32_t b)
{
    return a < b ? (uint32_t)b - (uint32_t)a : (uint32_t)a - (uint32_t)b;
}

/* The largest change between neighbouring corners along rows, and down columns. */
GN_HOT static inline void gn_cell_changes(const int32_t at[4], uint32_t change[2])
{
    uint32_t upper = gn_cell_change(at[0], at[1]), lower = gn_cell_change(at[2], at[3]);
    uint32_t left = gn_cell_change(at[0], at[2]), right = gn_cell_change(at[1], at[3]);
    change[0] = upper > lower ? upper : lower;
    change[1] = left > right ? left : right;
}

#if GN_SHADOWS || GN_TEXTURES
/* Perspective bends what changes by `change` from corner to corner by a quarter of its own share of that, at most:
 * along rows, and down columns. */
GN_HOT static inline int gn_cell_bends_by_less(const uint32_t change[2], const uint32_t bend_q16[2], int32_t least_log2)
{
    return ((uint64_t)change[0] * bend_q16[0] + (uint64_t)change[1] * bend_q16[1]) >> 18 <= 1U << least_log2;
}
#endif

#if GN_SHADOWS
GN_HOT static inline int gn_cell_row_bends_by_less(const uint32_t change[2], const uint32_t bend_q16[2],
                                                   int32_t least_log2)
{
    return (uint64_t)change[0] * bend_q16[0] >> 18 <= 1U << least_log2;
}
#endif

/* ---- Parts of a look ---- */

/* Returns 0 if the cell is seen so steeply that nothing is close to bilinear. */
int gn_cell_find_bend(gn_lattice_cell *cell);

/* Whether texture coordinates may be interpolated; the same of a mask image: a corner per texel. */
int gn_cell_textures_hold(const gn_lattice_cell *cell);
int gn_cell_masks_hold(const gn_lattice_cell *cell);

/* By how much the square of a distance is off between the corners: a quarter of the squares of the cell's sides. */
uint64_t gn_cell_bend2_q32(const gn_lattice_cell *cell);

/* Whether shadows that fade, or cascades that blend, by the square of a distance are off by more than 1/16 between the
 * corners: NUMERICS 4.12. */
int gn_cell_ramp_bends(const gn_lattice_cell *cell);

/* Whether nothing of a light arrives anywhere in the cell if nothing arrives at its corners. The squares of a point's
 * distance, and of its distance along the axis, are those of the corners in the mean, less what they scatter by. */
int gn_cell_stays_dark(gn_lattice_cell *cell, uint32_t slot);

/* How far interpolation between the corners is off, of a light's irradiance: NUMERICS 4.12. *kink: because it ends in
 * the cell, or its cone does. */
uint32_t gn_cell_unevenness_q24(gn_lattice_cell *cell, uint32_t slot, int32_t least_q24, int32_t most_q24,
                                uint32_t *kink_q24);

/* Where the border of two views lies between the corners: what is 0 there, positive in the first view. As a share of
 * the depth, what is linear on the surface is so on the screen; spheres of cascades are not. Returns 0 if that moves
 * the border by more than a pixel, and the cell can be split. */
int gn_cell_border(const gn_lattice_cell *cell, uint32_t slot, int32_t one, int32_t other, gn_flat_patch *out);

/* The shadow of a light: GN_CELL_LIT, GN_CELL_DARK, or GN_CELL_EDGE, which is added. */
int gn_cell_shadow(const gn_lattice_cell *cell, uint32_t slot, const gn_contribution *light);

#endif

#endif
