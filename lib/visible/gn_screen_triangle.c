/* Triangles on the screen. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_walk.h"
#include "scene/gn_scene.h"
#include "visible/gn_setup.h"

/* ---- Depth ------------------------------------------------------------------------------------------------------- */

/* near / Z over a triangle. */
typedef struct {
    uint32_t ref;   /* at the centre of the pixel that contains the top, modulo 2^32 */
    int32_t dx, dy; /* per pixel */
    uint32_t least, largest;
} depth_range;

/* floor(n * f / 2^(33 + s)), |n| < 2^60, 1 <= s <= 62. Returns 0 if that is more than 32 bits. */
static inline int gradient(int32_t *out, int64_t n, int32_t f, int32_t s)
{
    int32_t hi = (int32_t)(n >> 32), lo = (int32_t)((uint32_t)n >> 1);
    GN_KEEP(hi); /* 32 bits each: products are one instruction */
    GN_KEEP(lo);
    int64_t v = ((int64_t)hi * f + ((int64_t)lo * f >> 31)) >> s;
    *out = (int32_t)v;
    return v == *out;
}

/* The plane through three projected corners, in Q16 pixels: |x|, |y| < 2^27. If a pixel spans half of all depths, the
 * plane is too steep: the nearest depth is used everywhere. */
static inline void depth_of_corners(depth_range *depth, const gn_projected *c0, const gn_projected *c1,
                                    const gn_projected *c2, int32_t to_x_q16, int32_t to_y_q16)
{
    uint32_t i0 = c0->iz_q32, i1 = c1->iz_q32, i2 = c2->iz_q32;
    uint32_t largest = i0 > i1 ? i0 : i1, least = i0 > i1 ? i1 : i0;
    depth->largest = i2 > largest ? i2 : largest;
    depth->least = i2 < least ? i2 : least;
    int32_t ax = c1->x_q16 - c0->x_q16, ay = c1->y_q16 - c0->y_q16, bx = c2->x_q16 - c0->x_q16,
            by = c2->y_q16 - c0->y_q16;
    int32_t a = (int32_t)(i1 >> 1) - (int32_t)(i0 >> 1), b = (int32_t)(i2 >> 1) - (int32_t)(i0 >> 1);
    int64_t area = (int64_t)ax * by - (int64_t)bx * ay; /* 2^57 */
    uint64_t size = gn_abs64(area) | 1U;
    int32_t clz = gn_clz64(size),
            s = 45 - clz; /* gradients are n / area * 2^17 = n * (2^63 / norm) / 2^(78 - clz), in halves */
    int32_t recip = (int32_t)(gn_recip_norm2((uint32_t)(size << clz >> 32)) >> 1);
    if (area < 0) recip = -recip;
    GN_KEEP(recip);
    if (s < 1 || !gradient(&depth->dx, (int64_t)a * by - (int64_t)b * ay, recip, s) ||
        !gradient(&depth->dy, (int64_t)b * ax - (int64_t)a * bx, recip, s)) {
        depth->dx = depth->dy = 0;
        depth->ref = depth->largest;
        return;
    }
    /* to the centre: less than two pixels */
    int64_t step = (int64_t)depth->dx * to_x_q16 + (int64_t)depth->dy * to_y_q16;
    depth->ref = c0->iz_q32 + (uint32_t)(step >> 16);
}

/* To the subpixel grid, to nearest. */
static inline int32_t snap(int32_t q16, int32_t bits)
{
    return (q16 + (1 << (15 - bits))) >> (16 - bits);
}

/* A corner on the subpixel grid. */
typedef struct {
    const gn_projected *at;
    int32_t x, y;
} grid_corner;

/* A snapped edge may cover centres outside the unsnapped triangle, by half a unit of the subpixel grid along each axis.
 * Depth may leave the triangle's own range by this margin. */
static inline uint32_t depth_margin(int32_t dx, int32_t dy, int32_t bits)
{
    return (((gn_abs32(dx) >> 1) + (gn_abs32(dy) >> 1)) >> bits) + 4096; /* plus the rounding of 2^13 steps */
}

/* With a smaller margin, and neither end of the depth format within it, depth needs no bounds. */
#define MARGIN_MAX (1U << 18)

/* Depth of a triangle, moved from c0 to the centre of the pixel that contains it. */
static inline void set_depth(gn_tri *tri, const gn_projected *c0, const gn_projected *c1, const gn_projected *c2,
                             int32_t to_x_q16, int32_t to_y_q16, int32_t walk, int32_t bits)
{
    depth_range depth;
    depth_of_corners(&depth, c0, c1, c2, to_x_q16, to_y_q16);
    tri->iz_ref = depth.ref;
    tri->iz_dx = depth.dx;
    tri->iz_dy = depth.dy;
    uint32_t margin = depth_margin(depth.dx, depth.dy, bits);
    if (margin < MARGIN_MAX && depth.least > margin && depth.largest < UINT32_MAX - margin) {
        gn_tri_set_walk(tri, walk);
        return;
    }
    tri->iz.bounds.least = (uint16_t)(depth.least >> 16);
    tri->iz.bounds.largest = (uint16_t)(depth.largest >> 16);
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

/* Counts a triangle in the screen tiles that it may have pixels in. */
static inline void count_tiles(const gn_screen_job *job, const gn_rect *px)
{
    gn_tile_walk tiles = gn_setup_tiles(job->frame, px); /* of some tiles */
    gn_ref_offset *at = job->tile_first + tiles.first;
    do {
        int32_t n = tiles.width;
        do ++*at++;
        while (--n);
        at += tiles.skip;
    } while (--tiles.height);
}

/* A record of the frame; NULL if there are no more. */
static inline gn_tri *count_record(const gn_screen_job *job, const gn_rect *px)
{
    uint32_t n = job->stats->n_triangles++; /* counting continues, so that gn_detail can tell the needed capacity */
    if (n >= GN_MAX_TRIANGLES) return NULL;
    count_tiles(job, px);
    gn_tri *tri = &job->tri[n];
    GN_KEEP(tri);
    return tri;
}

#if GN_GROUPS
/* Counts a triangle in the screen tiles that it may have pixels in, by which its group grows. */
static void count_group(const gn_screen_job *job, const gn_rect *px)
{
    const gn_frame *frame = job->frame;
    const uint32_t w = (uint32_t)GN_K(frame, tile_width), h = (uint32_t)GN_K(frame, tile_height);
    const uint32_t x0 = (uint32_t)px->x0 / w, x1 = (uint32_t)(px->x1 - 1) / w, y0 = (uint32_t)px->y0 / h,
                   y1 = (uint32_t)(px->y1 - 1) / h; /* nothing is negative */
    job->stats->n_triangles++;
    *job->group = gn_group_union(*job->group, gn_group_of(x0, x1, y0, y1));
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t x = x0; x <= x1; x++) {
            gn_ref_offset *n = &job->tile_first[y * frame->tiles_x + x];
            if (*n != (gn_ref_offset)-1) ++*n; /* more than fit an identity in any case */
        }
}
#endif

static inline grid_corner on_grid(const gn_projected *at, int32_t bits)
{
    const grid_corner snapped = {at, snap(at->x_q16, bits), snap(at->y_q16, bits)};
    return snapped;
}

/* How a triangle is drawn that begins with its top and has these bounds, px after they are cut to the picture: see
 * gn_tri_depth. 0: it covers no pixel, which is known of those whose box is small. */
static inline int32_t walk_of(const gn_screen_job *job, const gn_rect *px, const grid_corner *a, const grid_corner *b,
                              const grid_corner *c, int32_t left, int32_t right, int32_t bottom)
{
    const gn_picture *picture = &job->frame->picture;
    const int32_t bits = GN_K(job->frame, subpixel_bits), first = (1 << bits) - 1;
    const int32_t x = (left + job->add_px[0]) >> bits, y = (a->y + job->add_px[1]) >> bits,
                  columns = ((right + job->add_px[0]) >> bits) - x, rows = ((bottom + job->add_px[1]) >> bits) - y;
    if (columns <= GN_MASK_WIDTH && rows <= GN_MASK_HEIGHT) {
        uint32_t mask = gn_pixel_mask(x * (1 << bits) + first - job->add_px[0] - a->x,
                                      y * (1 << bits) + first - job->add_px[1] - a->y, b->x - a->x, b->y - a->y,
                                      c->x - a->x, c->y - a->y, columns, rows, bits);
        if (x != px->x0 || y != px->y0 || x + columns != px->x1 || y + rows != px->y1)
            mask = gn_mask_cut(mask, x, y, picture->width, picture->height);
        if (!mask) return 0;
        const int32_t top = (a->x + ((picture->width << bits) >> 1)) >> bits;
        if (job->fixed_mask) return GN_TRI_MASK | (1 + top - x) << 12 | (int32_t)mask;
    }
    return gn_max32(job->fixed_mask & gn_walk_lasts((uint32_t)(right - left) | (uint32_t)(bottom - a->y)),
                    GN_TRI_EXACT);
}

/* Everything of a triangle that begins with its top. */
static inline void fill_triangle(const gn_screen_job *job, gn_tri *tri, const grid_corner *a, const grid_corner *b,
                                 const grid_corner *c, int32_t walk, uint32_t triangle_idx)
{
    const gn_frame *frame = job->frame;
    int32_t bits = GN_K(frame, subpixel_bits);
    GN_COUNT(visible, 1);
    tri->x[0] = (gn_coord)a->x, tri->x[2] = (gn_coord)c->x, tri->y[1] = (gn_coord)b->y;
    GN_KEEP(tri); /* copied as half-words: combining them to words takes longer */
    tri->x[1] = (gn_coord)b->x, tri->y[0] = (gn_coord)a->y, tri->y[2] = (gn_coord)c->y;
    tri->source.object_idx = (uint16_t)job->object_idx;
    tri->source.triangle_idx = (uint16_t)triangle_idx;
    /* from the top to the centre of the pixel that contains it */
    int32_t one = 1 << bits, x = a->x + ((frame->picture.width << bits) >> 1),
            y = a->y + ((frame->picture.height << bits) >> 1);
    int32_t to_x_q16 = ((a->x - (x & (one - 1))) * 2 + one) * (1 << (15 - bits)) - a->at->x_q16;
    int32_t to_y_q16 = ((a->y - (y & (one - 1))) * 2 + one) * (1 << (15 - bits)) - a->at->y_q16;
    set_depth(tri, a->at, b->at, c->at, to_x_q16, to_y_q16, walk, bits);
}

/* A triangle's corners in the order of a record. */
typedef struct {
    grid_corner a, b, c;
    uint32_t order; /* gn_tri_order() of them */
    int32_t left, right, bottom;
} grid_triangle;

/* Returns 0 if it faces away, or has no area. */
static inline int order_corners(grid_triangle *t, const gn_screen_job *job, const gn_projected *p0,
                                const gn_projected *p1, const gn_projected *p2)
{
    const int32_t bits = GN_K(job->frame, subpixel_bits);
    grid_corner a = on_grid(p0, bits), b = on_grid(p1, bits), c = on_grid(p2, bits), swap;
    const int64_t area = (int64_t)(b.x - a.x) * (c.y - a.y) - (int64_t)(c.x - a.x) * (b.y - a.y);
    t->order = 1;
    if (area >= 0) {
        if (area == 0 || !(job->sides & GN_SIDE_CW)) return 0;
        swap = b, b = c, c = swap;
        t->order = 4;
    } else if (!(job->sides & GN_SIDE_CCW)) return 0;
    if (c.y < a.y && c.y < b.y) swap = a, a = c, c = b, b = swap, t->order += 2; /* rotated, to begin with the top */
    else if (b.y < a.y) swap = a, a = b, b = c, c = swap, t->order++;
    t->a = a, t->b = b, t->c = c;
    t->left = gn_min32(gn_min32(a.x, b.x), c.x), t->right = gn_max32(gn_max32(a.x, b.x), c.x);
    t->bottom = gn_max32(b.y, c.y);
    return 1;
}

/* Everything of a record but its place among the frame's. triangle_idx: GN_TRI_PART is added for a part of one. */
static inline void fill_record(const gn_screen_job *job, gn_tri *tri, const grid_triangle *t, int32_t walk,
                               uint32_t triangle_idx)
{
    fill_triangle(job, tri, &t->a, &t->b, &t->c, walk, triangle_idx);
    uint32_t order = triangle_idx & GN_TRI_PART ? GN_TRI_CUT : t->order;
    const uint32_t iz = t->a.at->iz_q32;
    if (!(tri->iz_dx | tri->iz_dy) && (t->b.at->iz_q32 != iz || t->c.at->iz_q32 != iz)) order = GN_TRI_STEEP;
    tri->iz_ref = (tri->iz_ref & ~7U) | order;
}

GN_NOINLINE void gn_screen_triangle(const gn_screen_job *job, const gn_projected *p0, const gn_projected *p1,
                                    const gn_projected *p2, uint32_t triangle_idx)
{
    const gn_frame *frame = job->frame;
    grid_triangle t;
    if (!order_corners(&t, job, p0, p1, p2)) return;
    const gn_rect bounds = gn_setup_bounds_of(frame, t.left, t.right, t.a.y, t.bottom, job->add_px[0], job->add_px[1]);
    if (bounds.x0 >= bounds.x1 || bounds.y0 >= bounds.y1) return;
    const int32_t walk = walk_of(job, &bounds, &t.a, &t.b, &t.c, t.left, t.right, t.bottom);
    if (!walk) return;
#if GN_GROUPS
    if (GN_K(frame, triangle_groups)) {
        gn_screen_tile_job *tile = job->tile;
        if (!tile) {
            count_group(job, &bounds);
            return;
        }
        if (bounds.x0 >= tile->rect.x1 || bounds.x1 <= tile->rect.x0 || bounds.y0 >= tile->rect.y1 ||
            bounds.y1 <= tile->rect.y0 || tile->n_drawn == tile->n_counted)
            return;
        gn_tri drawn;
        fill_record(job, &drawn, &t, walk, triangle_idx);
        tile->drawn[++tile->n_drawn] = drawn.source;
        GN_COUNT(tile_refs, 1);
        gn_raster_triangle(tile->target, &drawn, tile->n_drawn);
        return;
    }
#endif
    gn_tri *tri = count_record(job, &bounds);
    if (tri) fill_record(job, tri, &t, walk, triangle_idx);
}

#if GN_GROUPS
int gn_screen_record(const gn_screen_job *job, const gn_projected *p0, const gn_projected *p1, const gn_projected *p2,
                     uint32_t triangle_idx, gn_tri *out)
{
    grid_triangle t;
    if (!order_corners(&t, job, p0, p1, p2)) return 0;
    fill_record(job, out, &t, GN_TRI_EXACT, triangle_idx);
    return 1;
}
#endif

void gn_setup_corners(const gn_frame *frame, const gn_tri *tri, int32_t x[3], int32_t y[3])
{
    int32_t bits = GN_K(frame, subpixel_bits);
    int32_t centre_x = (frame->picture.width << bits) >> 1, centre_y = (frame->picture.height << bits) >> 1;
    for (int i = 0; i < 3; i++) {
        x[i] = tri->x[i] + centre_x;
        y[i] = tri->y[i] + centre_y;
    }
}

/* ---- Jobs -------------------------------------------------------------------------------------------------------- */

void gn_screen_begin(gn_screen_job *job, const gn_frame *frame)
{
    int32_t bits = GN_K(frame, subpixel_bits);
    job->frame = frame;
    job->add_px[0] = gn_setup_add(frame->picture.width, bits);
    job->add_px[1] = gn_setup_add(frame->picture.height, bits);
}

void gn_screen_object(gn_screen_job *job)
{
    job->sides = gn_sides_of(job->frame->flags[job->object_idx], GN_OBJECT_TWO_SIDED);
    job->fixed_mask = GN_VISIBLE_ALPHA && job->object->visible_alpha != GN_ALPHA_OPAQUE ? 0 : -1;
}
