/* A surface by cells: squares of pixels, between whose corners light is interpolated. Cells whose light is too uneven
 * are split; what even the smallest cannot show is shaded pixel by pixel (gn_corner_pixel). */
#ifndef GN_LATTICE_H
#define GN_LATTICE_H

#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "gnomon.h"
#include "shade/gn_corner.h"
#include "shade/gn_lattice_types.h"
#include "shade/gn_pixel.h"
#include "shadow/gn_filter.h"

/* ---- What a cell looks like -------------------------------------------------------------------------------------- */

/* The light at its corners, and which lights' shadows have an edge in it (NUMERICS 4.12). */

#if GN_INTERPOLATES

/* Looks at the cell whose corners, 2^size_log2 pixels apart, are in cell_corner. Fills lattice->look; returns 0 if the
 * cell is too uneven to be interpolated: it is to be split. */
int gn_lattice_look_at(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, int32_t size_log2);

/* Where the pixels of an edge are seen: between the cell's corners, or between the ends of each row. And a flag: pixels
 * that are not in this face or cascade are in that of the next edge. */
enum { GN_PLACES_BILINEAR, GN_PLACES_BY_ROW, GN_PLACES_OF_TWO };

/* Through values at the corners of a cell. */
GN_HOT static inline void gn_flat_patch_make(gn_flat_patch *p, const int32_t at[4], int32_t size_log2)
{
    int32_t across = (at[1] - at[0]) >> size_log2;
    p->at = at[0];
    p->dx = across;
    p->dy = (at[2] - at[0]) >> size_log2;
    p->dxy = (((at[3] - at[2]) >> size_log2) - across) >> size_log2;
}

/* Value of a patch at (x, y) pixels from its first corner. */
GN_HOT static inline int32_t gn_flat_patch_at(const gn_flat_patch *p, int32_t x, int32_t y)
{
    return p->at + y * p->dy + x * (p->dx + y * p->dxy);
}

#endif

#if GN_INTERPOLATES

/* Shades the surface's pixels in the spans of s->lattice: n_spans > 0. */
void gn_lattice_shade(gn_shading *s);

/* Once per screen tile. */
void gn_lattice_begin_tile(gn_shading *s);

/* Draws the pixels of a cell that its look is known of: gn_lattice_draw.c. */
void gn_lattice_draw(gn_shading *s, int32_t x, int32_t y, int32_t size_log2);

/* Pixels of the part in a row of a cell. */
GN_HOT static inline uint32_t gn_lattice_bits(const gn_lattice *l, int32_t x, int32_t y, int32_t size_log2)
{
    uint32_t at = (uint32_t)(x - l->x);
    return l->bits[at >> 5][y - l->y] >> (at & 31) & ((1U << (1 << size_log2)) - 1);
}

/* The columns of a cell that have pixels in rows y .. y + n_rows - 1. */
GN_HOT static inline uint32_t gn_lattice_columns(const gn_lattice *l, int32_t x, int32_t y, int32_t n_rows,
                                                 int32_t size_log2)
{
    uint32_t at = (uint32_t)(x - l->x), any = 0;
    const uint32_t *row = &l->bits[at >> 5][y - l->y];
    for (int32_t i = 0; i < n_rows; i++) any |= row[i];
    return any >> (at & 31) & ((1U << (1 << size_log2)) - 1);
}

#endif

/* ---- Texture coordinates of a cell ------------------------------------------------------------------------------- */

/* Bilinear between its corners, or quadratics that bend as perspective does. */

#if GN_INTERPOLATES && GN_TEXTURES

/* Of the cell at hand, 2^size_log2 pixels from (x, y) on, with these corners; `texture`: the surface's, or a level. */
void gn_lattice_texture_begin(const gn_lattice *lattice, const gn_texture *texture, int32_t x, int32_t y,
                              int32_t size_log2, gn_corner *const corner[4], gn_texture_patch *out);

/* A row of it, `below` pixels under the first, from pixel `first` on. */
void gn_lattice_texture_line(const gn_texture_patch *patch, const gn_texture *texture, int32_t size_log2, int32_t below,
                             int32_t first, gn_texture_line *line);

/* The same of all textures, pass by pass from 0 on: one per level that the cell shows. Returns 0 beyond the last. */
int gn_lattice_textures_begin(gn_shading *shading, int32_t x, int32_t y, int32_t size_log2, int32_t pass,
                              gn_cell_textures *out);

/* Where the line finds colours of the textures. */
void gn_lattice_textures_line(gn_lattice *lattice, const gn_cell_textures *textures, gn_pixel_line *line);

/* Colours of the textures in a row, `below` pixels under the cell's first row: of the pixels `bits` of the cell, from
 * its pixel `first` on. Returns those that are of the pass. */
uint32_t gn_lattice_textures_row(gn_lattice *lattice, const gn_cell_textures *textures, int32_t size_log2,
                                 int32_t below, int32_t first, uint32_t bits);

#endif

/* ---- Texel windows of a surface ---------------------------------------------------------------------------------- */

/* One per view of a light, for as many columns of cells as fit. */

#if GN_INTERPOLATES

/* The window of a view of the light in a slot, made for what is visible of the block from column x on, out to whole
 * `cells`; it may cover nothing. NULL: the surface is not seen as a plane. */
gn_window *gn_lattice_window(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, uint32_t slot,
                             uint32_t view_idx, int32_t x, int cells);

#if GN_SHADOWS
/* Attenuations of n pixels that are alike; none if they are not. */
GN_HOT static inline void gn_attenuations_set(uint32_t *out, int32_t n, int said)
{
    for (const uint32_t *end = out + n; said != GN_WINDOW_MIXED && out < end;)
        *out++ = said == GN_WINDOW_DARK ? 0 : 65536;
}

/* What gn_window_row() says of a row of n <= 16 receivers, or GN_WINDOW_MIXED and in *missed a bit for each that no
 * window tells of. Where the window does not cover them one of a plane is made anew for them, or for a half, a
 * quarter... of them at a time; `at` is moved on by n then. Places are below 2^27: so are those in between. */
int gn_lattice_row(const gn_frame *frame, gn_window *window, gn_receiver_step *at, const gn_receiver_step *step,
                   int32_t n, int32_t behind, uint32_t *out, uint32_t *missed);
#endif

#if GN_SHADOWS
GN_HOT static inline uint32_t gn_lattice_view_bit(const gn_frame *frame, const gn_light_view *view)
{
    return 1U << ((uint32_t)(view - frame->view) & 31U);
}

/* The view's window among the lattice's, or one that is of no use from column x on, or any that the look at hand does
 * not use. */
GN_HOT static inline gn_window *gn_lattice_window_of(gn_lattice *l, const gn_frame *frame, const gn_light_view *view,
                                                     int32_t x)
{
    gn_window *other = NULL;
    for (uint32_t i = 0; i < GN_WINDOWS; i++)
        if (l->window[i].view == view) return &l->window[i];
    for (uint32_t i = 0, at = (uint32_t)(view - frame->view) % GN_WINDOWS; i < GN_WINDOWS; i++) {
        gn_window *window = &l->window[at];
        at = at + 1 < GN_WINDOWS ? at + 1 : 0;
        if (!window->view) return window;
        if (l->by.look.ask.used & gn_lattice_view_bit(frame, window->view)) continue;
        if (x >= window->until_x) return window;
        if (!other) other = window;
    }
    return other;
}

/* Whether it is already made. */
GN_HOT static inline int gn_lattice_window_is_made(const gn_window *window, const gn_light_view *view, int32_t x)
{
    return window->view == view && (window->planar <= 0 || x < window->until_x);
}
#endif

#endif

/* ---- Colours along a row of a cell's nodes ----------------------------------------------------------------------- */

/* Parts of gn_lattice_draw. */

#if GN_INTERPOLATES

/* Of the first node, and steps between them. */
typedef struct {
    int32_t from[3], step[3];
} gn_node_row;

/* Adds what is bilinear over the cell, `below` pixels under its first row. */
GN_INLINE void gn_row_add(const gn_drawing *d, const gn_flat_patch colour_q24[3], int32_t below, gn_node_row *row)
{
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        const gn_flat_patch *p = &colour_q24[c];
        row->from[c] += gn_flat_patch_at(p, d->first, below);
        row->step[c] += p->dx + below * p->dxy;
    }
}

/* Sets the nodes before `end`. */
GN_INLINE void gn_row_put(const gn_node_row *row, int32_t (*node)[3], int32_t (*const end)[3])
{
    int32_t r = row->from[0], g = row->from[1], b = row->from[2];
    for (; node < end; node++, r += row->step[0], g += row->step[1], b += row->step[2]) {
        (*node)[0] = r;
        (*node)[1] = g;
        (*node)[2] = b;
    }
}

#if GN_SHADOWS
/* Adds an edge's light, twice of which is r, g, b, to a node. */
GN_INLINE void gn_node_add(int32_t node[3], uint32_t share_uq16, int32_t r, int32_t g, int32_t b)
{
    if (share_uq16 == 65536) {
        node[0] += r >> 1;
        node[1] += g >> 1;
        node[2] += b >> 1;
    } else if (share_uq16) {
        node[0] += gn_mul_half_share(r, share_uq16);
        node[1] += gn_mul_half_share(g, share_uq16);
        node[2] += gn_mul_half_share(b, share_uq16);
    }
}

/* Twice the light of an edge along a row of nodes: light and highlight, 2^27 each where gn_corner_times() limits them:
 * -2^27 .. 2^28 at the corners; doubled, one node beyond the cell, below 2^30.4. */
GN_INLINE gn_node_row gn_row_of_edge(const gn_drawing *d, const gn_lattice_edge *edge, int32_t below)
{
    gn_node_row twice = {{0, 0, 0}, {0, 0, 0}};
    gn_row_add(d, edge->more_q24, below, &twice);
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        twice.from[c] *= 2;
        twice.step[c] *= 2;
    }
    return twice;
}
#endif

#endif

/* ---- Parts of a surface of which nothing but shadows varies ------------------------------------------------------ */

/* Filled where a window says that a light falls on all of it, or on none; rows of two colours where it has an edge.
 */

/* Once per surface: whether it is of that kind. */
void gn_part_begin(gn_shading *s);

/* Shades the pixels of the spans in the block, if the surface is. */
void gn_part_shade(gn_shading *s);

/* ---- The cell at hand -------------------------------------------------------------------------------------------- */

/* Its tolerances, how uneven it is, its shadows. Parts of gn_lattice_look. */

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

/* Of strengths of shadows at n corners: 1: they do not fade; -1: they begin or end to, and change by more than the
 * tolerance: nothing linear is near; 0: on a ramp. */
GN_HOT static inline int gn_cell_fading(const gn_frame *frame, const uint32_t *strength_uq16, int n)
{
    uint32_t least = 65536, most = 0;
    GN_UNROLL
    for (int i = 0; i < n; i++) {
        least = strength_uq16[i] < least ? strength_uq16[i] : least;
        most = strength_uq16[i] > most ? strength_uq16[i] : most;
    }
    if (least == 65536) return 1;
    return (!least || most == 65536) && most - least > 65536U >> gn_cell_fade_log2(frame) ? -1 : 0;
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

/* Whether texture coordinates may be interpolated. */
int gn_cell_textures_hold(const gn_lattice_cell *cell);
/* Whether a mask image changes by at most a quarter of a texel along each axis, or is the same all over the cell. */
int gn_cell_masks_hold(const gn_lattice_cell *cell);
/* Whether normals turn by so little that light may be interpolated. */
int gn_cell_normals_hold(const gn_lattice_cell *cell);

/* By how much the square of a distance is off between the corners: a quarter of the squares of the cell's sides. */
uint64_t gn_cell_bend2_q32(const gn_lattice_cell *cell);

/* Whether shadows that fade, or cascades that blend, by the square of a distance are off by more than 1/16 between the
 * corners: NUMERICS 4.12. */
int gn_cell_ramp_bends(const gn_lattice_cell *cell);

/* Whether nothing of a light arrives anywhere in the cell if nothing arrives at its corners. The squares of a point's
 * distance, and of its distance along the axis, are those of the corners in the mean, less what they scatter by. */
int gn_cell_stays_dark(gn_lattice_cell *cell, uint32_t slot);

/* How far interpolation between the corners is off, of a light's irradiance: NUMERICS 4.12. *kink: because it ends in
 * the cell, or its cone does, or it is near. */
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
