/* Visible surfaces of a screen tile. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "geometry/gn_walk.h"
#include "geometry/gn_xform.h"
#include "visible/gn_cell.h"
#include "visible/gn_runs.h"
#include "visible/gn_setup.h"

typedef gn_raster_depth raster_depth;

/* Identities ascend in the order of drawing, so a candidate wins where its depth is at least the cell's. Compared is
 * its depth with all identity bits set. */
#define GN_CELL_(cell)                                                                                                 \
    do {                                                                                                               \
        uint32_t candidate = iz | id_mask;                                                                             \
        if (candidate >= (cell)) {                                                                                     \
            GN_KEEP(candidate);                                                                                        \
            (cell) = candidate - below;                                                                                \
        }                                                                                                              \
        iz += minus_dx;                                                                                                \
        GN_KEEP(iz);                                                                                                   \
    } while (0)

/* n > 0 cells, from the last, whose depth is iz, to the first: the remainder of n / 8, then groups of eight. */
GN_INLINE void raster_span(uint32_t *cell, int32_t n, uint32_t iz, const raster_depth *depth)
{
    GN_COUNT(covered, n);
    uint32_t minus_dx = depth->minus_dx, id_mask = depth->id_mask, below = depth->below, *at = cell + (n & ~7);
    GN_KEEP(at);     /* one pointer */
    switch (n & 7) { /* each goes on with those after it */
    case 7:
        GN_CELL_(at[6]);
        GN_GOES_ON;
    case 6:
        GN_CELL_(at[5]);
        GN_GOES_ON;
    case 5:
        GN_CELL_(at[4]);
        GN_GOES_ON;
    case 4:
        GN_CELL_(at[3]);
        GN_GOES_ON;
    case 3:
        GN_CELL_(at[2]);
        GN_GOES_ON;
    case 2:
        GN_CELL_(at[1]);
        GN_GOES_ON;
    case 1:
        GN_CELL_(at[0]);
        GN_GOES_ON;
    default:
        break;
    }
    while (at != cell) {
        at -= 8;
        GN_KEEP(at);
        GN_CELL_(at[7]);
        GN_CELL_(at[6]);
        GN_CELL_(at[5]);
        GN_CELL_(at[4]);
        GN_CELL_(at[3]);
        GN_CELL_(at[2]);
        GN_CELL_(at[1]);
        GN_CELL_(at[0]);
    }
}
#undef GN_CELL_

/* The state that is stepped from row to row of a triangle. */
typedef struct {
    gn_walk_line left, right;
    uint32_t iz, iz_dy; /* left of the tile's first column */
    uint32_t *row;
} stepped_rows;

/* The rows before `end`, at least one, cut to the tile's width. */
GN_INLINE void raster_rows(stepped_rows *rows, const uint32_t *end, int32_t stride, int32_t width,
                           const raster_depth *depth)
{
    uint32_t left = rows->left.x, right = rows->right.x, iz = rows->iz;
    uint32_t *row = rows->row;
    do {
        int32_t xa = gn_max32((int32_t)left >> GN_FIXED_BITS, 0), xb = gn_min32((int32_t)right >> GN_FIXED_BITS, width);
        GN_COUNT(rows, xb > xa);
        if (xb > xa) raster_span(row + xa, xb - xa, iz - (uint32_t)xb * depth->minus_dx, depth);
        left += rows->left.step;
        right += rows->right.step;
        iz += rows->iz_dy;
        row += stride;
        GN_KEEP(left); /* stepped, not computed again after the loop */
        GN_KEEP(right);
        GN_KEEP(iz);
        GN_KEEP(row);
    } while (row != end);
    rows->left.x = left, rows->right.x = right;
    rows->iz = iz;
    rows->row = row;
}

GN_HOT static inline void cut_plane(const gn_frame *frame, gn_scratch *scratch, gn_alpha_cut *cut,
                                    const gn_object *object, uint32_t object_idx, const uint16_t idx[3])
{
    gn_xform to_view;
    int32_t v[3][3];
    gn_xform_compose(&to_view, frame->cam.axis_q30, frame->cam.eye_q16, object);
    for (int i = 0; i < 3; i++) gn_setup_vertex(v[i], scratch->vertex, &to_view, object, object_idx, idx[i]);
    for (int i = 0; GN_FLAT_Q16(frame) && i < 3; i++) v[i][2] = GN_FLAT_Q16(frame);
    gn_alpha_plane(cut, frame, v, frame->cam.focal2_px_q16, frame->picture.width, GN_RECIP_STEPS(frame));
}

/* Pixels that alpha cuts have no surface. [M8] */
GN_HOT static inline void cut_begin(const gn_frame *frame, gn_scratch *scratch, gn_alpha_cut *cut, const gn_tri *tri)
{
    const gn_object *object = &frame->objects[tri->source.object_idx];
    const uint16_t *idx = object->mesh->idx + 3 * (size_t)tri->source.triangle_idx;
    const int dithers = GN_LAYERS_MAX && object->visible_alpha == GN_ALPHA_BLEND && !GN_LAYERS(frame);
    gn_alpha_begin(cut, object, dithers ? GN_ALPHA_DITHER : object->visible_alpha, idx);
    if (GN_TEXTURES && cut->textured) cut_plane(frame, scratch, cut, object, tri->source.object_idx, idx);
}

/* A screen tile. */
typedef struct gn_raster_target {
    const gn_frame *frame;
    gn_scratch *scratch;
    gn_rect rect;
    int32_t width, height; /* pixels */
    int32_t x, y;          /* of the picture's centre from the tile's corner, as corners of triangles */
    uint32_t id_mask;
} raster_tile;

/* Pixels of a row whose depth may leave the triangle's range. */
GN_HOT static GN_NOINLINE void raster_span_slow(const raster_depth *depth, uint32_t *cell, int32_t n, uint32_t iz)
{
    GN_COUNT(covered, n);
    for (const uint32_t *end = cell + n; cell != end; cell++, iz -= depth->minus_dx) {
        uint32_t candidate = gn_raster_clamp(iz, depth) | depth->id_mask;
        if (candidate >= *cell) *cell = candidate - depth->below;
    }
}

#if GN_VISIBLE_ALPHA
/* A candidate with all identity bits; its depth is bounded where it may leave the triangle's range. */
GN_INLINE uint32_t candidate_at(uint32_t iz, const raster_depth *depth, int bounded)
{
    return (bounded ? gn_raster_clamp(iz, depth) : iz) | depth->id_mask;
}

/* At most 32 pixels of a row that alpha may cut: it is looked up only where the surface would be the nearest.
 * Transparent surfaces go into layers. */
GN_INLINE void raster_cut(const raster_tile *tile, const raster_depth *depth, uint32_t *cell, int32_t n, uint32_t iz,
                          gn_alpha_cut *cut, int32_t x, int bounded)
{
    uint32_t bits = 0, at = iz - (uint32_t)n * depth->minus_dx;
    for (const uint32_t *last = cell + n; last != cell;) {
        at += depth->minus_dx;
        bits = 2 * bits + (candidate_at(at, depth, bounded) >= *--last);
    }
    if (!bits) return;
    for (bits = gn_alpha_keeps(cut, x, bits); bits; bits >>= 1, cell++, iz -= depth->minus_dx) {
        if (!(bits & 1U)) continue;
        uint32_t nearest = candidate_at(iz, depth, bounded) - depth->below;
        if (GN_LAYERS_MAX && cut->mode == GN_ALPHA_BLEND)
            gn_layers_put(tile->scratch, GN_LAYERS(tile->frame), cell, nearest);
        else *cell = nearest;
    }
}

GN_HOT static GN_NOINLINE void raster_span_cut(const raster_tile *tile, const raster_depth *depth, uint32_t *cell,
                                               int32_t n, uint32_t iz, gn_alpha_cut *cut, int32_t x)
{
    const uint32_t above = iz - depth->lo, end = above - (uint32_t)(n - 1) * depth->minus_dx;
    const int bounded = above >= depth->range || end >= depth->range;
    GN_COUNT(covered_cut, n);
    for (; n > 0; n -= 32, cell += 32, x += 32, iz -= 32 * depth->minus_dx) {
        if (bounded) raster_cut(tile, depth, cell, gn_min32(n, 32), iz, cut, x, 1);
        else raster_cut(tile, depth, cell, gn_min32(n, 32), iz, cut, x, 0);
    }
}
#else
GN_HOT static void raster_span_cut(const raster_tile *tile, const raster_depth *depth, uint32_t *cell, int32_t n,
                                   uint32_t iz, gn_alpha_cut *cut, int32_t x)
{
    (void)tile, (void)depth, (void)cell, (void)n, (void)iz, (void)cut, (void)x;
}
#endif

/* A small triangle without alpha whose depth needs no bounds (gn_tri): its edges are stepped in fixed point, row by
 * row. */
GN_HOT static GN_NOINLINE void raster_small(const raster_tile *tile, const gn_tri *tri, uint32_t id)
{
    /* top, left and right of it, as a ring: left edges lead down from one to the next, right ones from one to the last
     */
    const gn_walk_corner ring[4] = {{tri->x[0] + tile->x, tri->y[0] + tile->y},
                                    {tri->x[1] + tile->x, tri->y[1] + tile->y},
                                    {tri->x[2] + tile->x, tri->y[2] + tile->y},
                                    {tri->x[0] + tile->x, tri->y[0] + tile->y}};
    const int32_t bits = GN_K(tile->frame, subpixel_bits), stride = GN_K(tile->frame, tile_width),
                  lasts = tri->iz.unbounded.walk;
    int32_t at = gn_max32(gn_first_px(ring[0].y, bits), 0),
            bend[2] = {gn_first_px(ring[1].y, bits), gn_first_px(ring[2].y, bits)};
    int32_t end = gn_min32(gn_max32(bend[0], bend[1]), tile->height), left_end = at, right_end = at;
    uint32_t minus_dx = 0U - (uint32_t)tri->iz_dx;
    GN_KEEP(minus_dx); /* one of the two */
    const raster_depth depth = {minus_dx, 0, 0, tile->id_mask, tile->id_mask - id};
    stepped_rows rows = {{0, 0}, {0, 0}, 0, (uint32_t)tri->iz_dy, GN_CELLS(tile->scratch) + at * stride};
    rows.iz = tri->iz_ref + (uint32_t)(at - (ring[0].y >> bits)) * rows.iz_dy +
              (uint32_t)((ring[0].x >> bits) + 1) * minus_dx;
    while (at < end) {
        if (at == left_end) {
            const gn_walk_corner *from = ring + (at >= bend[0]);
            left_end = gn_min32(at < bend[0] ? gn_min32(bend[0], end) : end, at + lasts);
            rows.left = gn_walk_line_at(from[0].x, from[0].y, from[1].x, from[1].y, at, lasts, bits);
        }
        if (at == right_end) {
            const gn_walk_corner *from = ring + 3 - (at >= bend[1]);
            right_end = gn_min32(at < bend[1] ? gn_min32(bend[1], end) : end, at + lasts);
            rows.right = gn_walk_line_at(from[0].x, from[0].y, from[-1].x, from[-1].y, at, lasts, bits);
        }
        int32_t stop = gn_min32(left_end, right_end);
        raster_rows(&rows, rows.row + (stop - at) * stride, stride, tile->width, &depth);
        at = stop;
    }
}

/* A triangle whose pixels are known. */
GN_HOT static GN_NOINLINE void raster_mask(const raster_tile *tile, const gn_tri *tri, uint32_t id)
{
    const int32_t bits = GN_K(tile->frame, subpixel_bits), stride = GN_K(tile->frame, tile_width),
                  walk = tri->iz.unbounded.walk, left = (walk >> 12 & 7) - 1;
    const int32_t top = tri->y[0] + tile->y, column = (tri->x[0] + tile->x) >> bits, row = top >> bits;
    const uint32_t dx = (uint32_t)tri->iz_dx, dy = (uint32_t)tri->iz_dy, id_mask = tile->id_mask, below = id_mask - id;
    uint32_t mask = (uint32_t)walk & 0xFFFU;
    int32_t x = column - left, y = gn_first_px(top, bits);
    if (x < 0 || y < 0 || x > tile->width - GN_MASK_WIDTH || y > tile->height - GN_MASK_HEIGHT) {
        mask = gn_mask_cut(mask, x, y, tile->width, tile->height);
        mask >>= gn_max32(-x, 0) + GN_MASK_WIDTH * gn_max32(-y, 0); /* nothing is left before */
        x = gn_max32(x, 0), y = gn_max32(y, 0);
        if (!mask) return;
    }
    uint32_t iz = tri->iz_ref + (uint32_t)(x - column) * dx + (uint32_t)(y - row) * dy;
    uint32_t *cell = GN_CELLS(tile->scratch) + y * stride + x;
    for (;;) {
        uint32_t at = iz, *next = cell;
        GN_COUNT(rows, (mask & 15) != 0);
        for (uint32_t pixels = mask & 15; pixels; pixels >>= 1, next++, at += dx) {
            if (!(pixels & 1U)) continue;
            const uint32_t nearest = (at | id_mask) - below;
            GN_COUNT(covered, 1);
            if (nearest > *next) *next = nearest;
        }
        mask >>= GN_MASK_WIDTH;
        if (!mask) return;
        cell += stride, iz += dy;
    }
}

/* Row v of the tile. */
GN_HOT static void cut_row(const raster_tile *tile, gn_alpha_cut *cut, int32_t v, const gn_span *span)
{
    int32_t y = tile->rect.y0 + v;
    gn_alpha_row(cut, y, tile->frame->picture.height - 1 - 2 * y, tile->rect.x0 + span->x_begin,
                 tile->rect.x0 + span->x_end);
}

/* Walks a triangle that `cut` cuts, if it is not NULL. */
GN_HOT static void raster_triangle(const raster_tile *tile, const gn_tri *tri, uint32_t id, gn_alpha_cut *cut)
{
    const int32_t x[3] = {tri->x[0] + tile->x, tri->x[1] + tile->x, tri->x[2] + tile->x};
    const int32_t y[3] = {tri->y[0] + tile->y, tri->y[1] + tile->y, tri->y[2] + tile->y};
    int32_t bits = GN_K(tile->frame, subpixel_bits);
    gn_walk walk;
    int32_t n_rows = gn_walk_begin(&walk, x, y, bits, 0, tile->height);
    int32_t stride = GN_K(tile->frame, tile_width), width = tile->width;
    if (!n_rows) return;
    raster_depth depth;
    const uint32_t iz_dx = (uint32_t)tri->iz_dx;
    depth.minus_dx = 0U - iz_dx;
    int bounded = gn_tri_is_bounded(tri);
    depth.lo = bounded ? (uint32_t)tri->iz.bounds.least << 16 : 0;
    depth.range = bounded ? ((uint32_t)tri->iz.bounds.largest << 16 | 0xFFFFU) - depth.lo : UINT32_MAX;
    depth.id_mask = tile->id_mask;
    depth.below = tile->id_mask - id;
    uint32_t iz_dy = (uint32_t)tri->iz_dy;
    /* at the tile's left border, above the smallest; inside the triangle below its range, except the largest value */
    uint32_t iz_row =
        tri->iz_ref - depth.lo - (uint32_t)(x[0] >> bits) * iz_dx + (uint32_t)(walk.first - (y[0] >> bits)) * iz_dy;
    uint32_t *row = GN_CELLS(tile->scratch) + walk.first * stride;
    for (; n_rows > 0; n_rows = gn_walk_on(&walk)) {
        for (const gn_span *span = walk.span; n_rows > 0; n_rows--, span++, row += stride, iz_row += iz_dy) {
            int32_t xa = gn_max32(span->x_begin, 0), n = gn_min32(span->x_end, width) - xa;
            if (n <= 0) continue;
            uint32_t above = iz_row + (uint32_t)xa * iz_dx;
            GN_COUNT(rows, 1);
            uint32_t end = cut ? 0 : depth.range;
            if (above < end && above + (uint32_t)(n - 1) * iz_dx < end) {
                raster_span(row + xa, n, above + depth.lo + (uint32_t)(n - 1) * iz_dx, &depth);
                continue;
            }
            if (GN_VISIBLE_ALPHA && cut) {
                cut_row(tile, cut, (int32_t)(row - GN_CELLS(tile->scratch)) / stride, span);
                raster_span_cut(tile, &depth, row + xa, n, above + depth.lo, cut, tile->rect.x0 + xa);
            } else raster_span_slow(&depth, row + xa, n, above + depth.lo); /* with the same results */
        }
    }
}

GN_HOT static GN_NOINLINE void raster_cut_triangle(const raster_tile *tile, const gn_tri *tri, uint32_t id)
{
#if GN_VISIBLE_ALPHA
    gn_alpha_cut *cut = &tile->scratch->work.cut;
    cut_begin(tile->frame, tile->scratch, cut, tri);
    if (GN_LAYERS_MAX && cut->mode == GN_ALPHA_BLEND) gn_layers_use(tile->frame, tile->scratch);
    raster_triangle(tile, tri, id, cut);
#else
    (void)tile, (void)tri, (void)id;
#endif
}

/* Draws a triangle whose bounds intersect the screen tile. */
GN_HOT static inline void raster_one(const raster_tile *tile, const gn_tri *tri, uint32_t id)
{
    if (!gn_tri_is_bounded(tri) && tri->iz.unbounded.walk != GN_TRI_EXACT) {
        if (tri->iz.unbounded.walk & GN_TRI_MASK) raster_mask(tile, tri, id);
        else raster_small(tile, tri, id);
        return;
    }
    if (GN_VISIBLE_ALPHA && tile->frame->objects[tri->source.object_idx].visible_alpha != GN_ALPHA_OPAQUE) {
        raster_cut_triangle(tile, tri, id);
        return;
    }
    raster_triangle(tile, tri, id, NULL);
}

#if GN_GROUPS
GN_HOT void gn_raster_triangle(const gn_raster_target *target, const gn_tri *tri, uint32_t id)
{
    raster_one(target, tri, id);
}
#endif

GN_HOT static inline void raster_records(const raster_tile *tile, uint32_t tile_idx)
{
    const gn_frame *frame = tile->frame;
    const uint16_t *none = &frame->tile_ref[frame->tile_first[tile_idx]],
                   *ref = &frame->tile_ref[frame->tile_first[tile_idx + 1]];
    const gn_tri *first = frame->records.tri;
    uint32_t n_triangles = frame->stats.n_triangles;
    GN_KEEP(first);       /* computed once */
    while (ref != none) { /* backwards: identities ascend */
        uint32_t tri_idx = *--ref;
        raster_one(tile, first + tri_idx, n_triangles - tri_idx); /* gn_cell_id */
    }
}

/* The nearest surface of every pixel, before anything is shaded. [R2] */
GN_HOT void gn_raster_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx)
{
    int32_t bits = GN_K(frame, subpixel_bits);
    raster_tile tile;
    tile.frame = frame;
    tile.scratch = scratch;
    tile.rect = gn_screen_rect(frame, tile_idx);
    tile.width = tile.rect.x1 - tile.rect.x0;
    tile.height = tile.rect.y1 - tile.rect.y0;
    tile.x = ((frame->picture.width << bits) >> 1) - tile.rect.x0 * (1 << bits);
    tile.y = ((frame->picture.height << bits) >> 1) - tile.rect.y0 * (1 << bits);
    tile.id_mask = (1U << frame->id_bits) - 1;
    GN_COUNT(screen_tiles, 1);
    GN_COUNT(pixels, tile.width * tile.height);
    memset(GN_CELLS(scratch), 0, sizeof *scratch->cell * (uint32_t)(GN_K(frame, tile_width) * tile.height));
    for (uint32_t i = 0; GN_VISIBLE_ALPHA && i < GN_VERTEX_CACHE; i++) gn_vertex_drop(&scratch->vertex[i]);
    if (GN_LAYERS_MAX) gn_layers_clear(scratch);
#if GN_GROUPS
    if (GN_K(frame, triangle_groups)) gn_setup_tile(frame, scratch, tile_idx, &tile);
    else
#endif
        raster_records(&tile, tile_idx);
    if (GN_LAYERS(frame)) gn_layers_drop_hidden(frame, scratch, tile.height);
}
