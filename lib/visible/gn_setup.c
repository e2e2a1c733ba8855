/* Visible triangles. */
#include "gn_internal.h"

#include "gn_stages.h"
#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_clip.h"
#include "geometry/gn_walk.h"
#include "geometry/gn_xform.h"
#include "scene/gn_scene.h"
#include "visible/gn_setup.h"

/* View position of a vertex, without a cache. */
static int view_position(int32_t out_q16[3], const gn_xform *xform, const gn_mesh *mesh, uint32_t vertex_idx)
{
    int64_t v[3];
    if (!gn_scene_position_ok(mesh, vertex_idx)) return 0;
    gn_xform_vertex(v, xform, mesh, vertex_idx);
    for (int i = 0; i < 3; i++) {
        if (v[i] <= -GN_VIEW_LIMIT_Q16 || v[i] >= GN_VIEW_LIMIT_Q16) return 0;
        out_q16[i] = (int32_t)v[i];
    }
    return 1;
}

int gn_setup_vertex(int32_t out_q16[3], gn_vcache_entry *cache, const gn_xform *xform, const gn_mesh *mesh,
                    uint32_t object_idx, uint32_t vertex_idx)
{
    gn_vcache_entry *entry = &cache[vertex_idx & (GN_VERTEX_CACHE - 1)];
    GN_ELEMENT(entry);
    uint32_t tag = (object_idx << 16 | vertex_idx) + 1U;
    if (entry->tag != tag) {
        entry->tag = 0;
        if (!view_position(entry->v_q16, xform, mesh, vertex_idx)) return 0;
        entry->tag = tag;
    }
    for (int i = 0; i < 3; i++) out_q16[i] = entry->v_q16[i];
    return 1;
}

/* Half-words on both sides of this are not put together to words: that takes more than it saves. */
#if GN_SIZE_FIRST
#define APART(v) ((void)0)
#else
#define APART(v) GN_KEEP(v)
#endif

/* Of what is seldom called. */
#if GN_SIZE_FIRST
#define SELDOM inline
#else
#define SELDOM GN_NOINLINE
#endif

/* ---- Vertices ---------------------------------------------------------------------------------------------------- */

/* A vertex on the screen, in the guard band. */
typedef struct {
    int32_t x_q16, y_q16; /* pixels from the picture's centre, y down: below 2^11 pixels */
    uint32_t iz_q32;      /* near / Z */
} projected;

/* Whether a vertex is projected once. Where size comes first, every triangle is looked at as one that is clipped. */
#define CACHED_PROJECTION (!GN_SIZE_FIRST || !GN_CLIPPING)

/* A vertex as triangles need it. */
typedef struct {
    uint32_t tag; /* object << 16 | vertex, plus one; 0: empty */
    int32_t v_q16[3];
    uint32_t out; /* outside of which planes: of the picture, of the guard band << 8 */
#if CACHED_PROJECTION
    projected at; /* if in the guard band */
#endif
} corner;

/* One object. */
typedef struct {
    gn_frame *frame;
    gn_clipping *clipping;
    corner *cache;
    uint32_t cache_mask;
    uint16_t *place; /* see gn_setup.h */
    gn_ref_offset *tile_first;
    int32_t add_px[2];   /* see gn_setup_bounds_of */
    uint32_t focal_norm; /* 2F, normalised */
    int32_t focal_up;    /* see project */
    uint32_t near_norm;  /* near, normalised */
    int32_t near_down;   /* its leading zeros, less one */
    int32_t near_q16;
    uint32_t z_range;     /* from near to 2^30 */
    uint32_t half_q16[2]; /* the picture's, pixels */
    int32_t near_guard;   /* inside |x|, |y| <= Z * 2^-near_guard is inside the guard band */
    uint32_t object_idx;
    const gn_object *object;
    int32_t lasts_mask; /* 0 where alpha cuts the object: its triangles are not drawn as gn_raster.c draws small ones */
    int32_t narrow;     /* gn_walk_narrow, 0 there too */
    gn_xform xform;
    gn_xform_fast fast;
} setup_job;

/* near / Z, Q32, truncated, below 1; recip is that of Z * 2^clz */
static inline uint32_t inverse_depth(const setup_job *job, uint32_t recip, int32_t clz)
{
    uint32_t q =
        (uint32_t)(((uint64_t)job->near_norm * recip) >> 32); /* near * 2^near_clz * 2^63 / (Z * 2^clz) / 2^32 */
    int32_t down = job->near_down - clz;                      /* Z is not nearer than near: -1 at the least */
    if (GN_SELDOM(down < 0)) return q >> 31 ? UINT32_MAX : q << 1 | 1U; /* Z is near, and the quotient exact */
    GN_KEEP(q);                                                         /* a branch */
    return q >> down;
}

/* floor(v * scale / 2^32) */
static inline int32_t scaled(int32_t v, int32_t scale)
{
    GN_KEEP(v); /* positive, or as good as signed: one multiplication */
    GN_KEEP(scale);
    return (int32_t)(((int64_t)v * scale) >> 32);
}

/* X * 2F / Z and near / Z; Z in [2^8, 2^30). The first is rounded down. */
GN_INLINE void project(const setup_job *job, const int32_t v_q16[3], projected *at)
{
    int32_t clz = gn_clz32((uint32_t)v_q16[2]), up = job->focal_up + clz; /* clz 2..23 */
    uint32_t recip = gn_recip_norm2((uint32_t)v_q16[2] << clz);
    /* 2F / Z with 31 bits: 2^63 / (Z 2^clz) * (2F 2^focal_clz) / 2^33, in [2^29, 2^31); results are below 2^27, so that
     * |v| * 2^up < 2^30 */
    int32_t scale = (int32_t)(((uint64_t)recip * job->focal_norm) >> 33), x = v_q16[0], y = v_q16[1];
    if (up >= 0) {
        x = (int32_t)((uint32_t)x << up);
        y = (int32_t)((uint32_t)y << up);
    } else { /* the last bits are dropped first */
        x >>= -up;
        y >>= -up;
    }
    at->x_q16 = scaled(x, scale);
    at->y_q16 = -scaled(y, scale);
    at->iz_q32 = inverse_depth(job, recip, clz);
}

/* To the subpixel grid, to nearest. */
static inline int32_t snap(int32_t q16, int32_t bits)
{
    return (q16 + (1 << (15 - bits))) >> (16 - bits);
}

#if GN_SIZE_FIRST
/* Returns 0 if the vertex is out of range. */
static GN_NOINLINE int fill_corner(const setup_job *job, corner *c, uint32_t vertex_idx)
{
    const gn_cam *cam = &job->frame->cam;
    const int32_t *v = c->v_q16;
    if (!view_position(c->v_q16, &job->xform, job->object->mesh, vertex_idx)) return 0;
    c->out = gn_outcode(v, cam->near_q16, cam->tan_q16) | gn_outcode(v, cam->near_q16, cam->guard_q16) << 8;
#if CACHED_PROJECTION
    if (!(c->out >> 8)) project(job, v, &c->at);
#endif
    return 1;
}
#else
/* Beyond +-half */
static inline int is_beyond(int32_t v, uint32_t half)
{
    return (uint32_t)v + half > 2 * half;
}

/* Bit `low` if v is below -half, the next if it is above half. */
static inline uint32_t side_bits(int32_t v, uint32_t half, uint32_t low)
{
    return !is_beyond(v, half) ? 0 : v < 0 ? low : low << 1;
}

/* A corner nearer than near, beyond what is projected or near the border of the guard band, or out of range: returns 0
 * then. */
static GN_NOINLINE int fill_far_corner(const setup_job *job, corner *c)
{
    const gn_cam *cam = &job->frame->cam;
    const int32_t *v = c->v_q16;
    for (int k = 0; k < 3; k++)
        if (v[k] <= -GN_VIEW_LIMIT_Q16 || v[k] >= GN_VIEW_LIMIT_Q16) return 0;
    c->out = gn_outcode(v, cam->near_q16, cam->tan_q16);
    if (v[2] < cam->near_q16) c->out |= GN_OUT_NEAR << 8;
    else if (c->out) c->out |= gn_outcode(v, cam->near_q16, cam->guard_q16) << 8;
    if (!(c->out >> 8)) project(job, v, &c->at);
    return 1;
}

/* Returns 0 if the vertex is out of range. */
GN_INLINE int fill_corner(const setup_job *job, corner *c, uint32_t vertex_idx)
{
    const gn_mesh *mesh = job->object->mesh;
    int32_t v[3];
    if (!gn_xform_fast_wide(v, &job->fast, mesh->pos + 3 * (size_t)vertex_idx)) {
        if (!view_position(c->v_q16, &job->xform, mesh, vertex_idx)) return 0;
        for (int k = 0; k < 3; k++) v[k] = c->v_q16[k];
    }
    for (int k = 0; k < 3; k++) c->v_q16[k] = v[k];
    uint32_t z = (uint32_t)v[2] >> job->near_guard;
    if ((uint32_t)v[2] - (uint32_t)job->near_q16 >= job->z_range || (uint32_t)v[0] + z > 2 * z ||
        (uint32_t)v[1] + z > 2 * z)
        return fill_far_corner(job, c);
    project(job, v, &c->at);
    uint32_t half_x = job->half_q16[0], half_y = job->half_q16[1];
    c->out = 0;
    if (GN_SELDOM(is_beyond(c->at.x_q16, half_x) || is_beyond(c->at.y_q16, half_y)))
        c->out = side_bits(c->at.x_q16, half_x, GN_OUT_LEFT) | side_bits(-c->at.y_q16, half_y, GN_OUT_BOTTOM);
    return 1;
}
#endif

/* ---- Depth ------------------------------------------------------------------------------------------------------- */

/* near / Z over a triangle. */
typedef struct {
    uint32_t ref;   /* at the centre of the pixel that holds the top, modulo 2^32 */
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

/* The plane through three projected corners, all of the screen in Q16 pixels: |x|, |y| < 2^27. Where it is too steep, a
 * pixel spans half of all depths: the nearest stands for it. */
static inline void depth_of_corners(depth_range *depth, const projected *c0, const projected *c1, const projected *c2,
                                    int32_t to_x_q16, int32_t to_y_q16)
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

/* A corner on the subpixel grid. */
typedef struct {
    const projected *at;
    int32_t x, y;
} grid_corner;

/* A snapped edge may cover centres outside the unsnapped triangle, by half a unit of the subpixel grid along each axis:
 * by so much may depth leave the triangle's own range. Where that is little, and neither end of all depths is near, it
 * has no bounds. */
static inline uint32_t depth_reach(int32_t dx, int32_t dy, int32_t bits)
{
    return (((gn_abs32(dx) >> 1) + (gn_abs32(dy) >> 1)) >> bits) + 4096; /* and roundings of 2^13 steps */
}

#define REACH_MAX (1U << 18)

/* Depth of any triangle, from c to the centre of the pixel that holds it. */
static SELDOM void general_depth(gn_tri *tri, const projected *c0, const projected *c1, const projected *c2,
                                 int32_t to_x_q16, int32_t to_y_q16, int32_t lasts, int32_t bits)
{
    depth_range depth;
    depth_of_corners(&depth, c0, c1, c2, to_x_q16, to_y_q16);
    uint32_t reach = depth_reach(depth.dx, depth.dy, bits);
    int unlimited = reach < REACH_MAX && depth.least > reach && depth.largest < UINT32_MAX - reach;
    tri->iz_ref = depth.ref;
    tri->iz_dx = depth.dx;
    tri->iz_dy = depth.dy;
    tri->iz_min = (uint16_t)(unlimited ? (uint32_t)lasts + 1 : depth.least >> 16);
    tri->iz_max = (uint16_t)(unlimited ? 0 : depth.largest >> 16);
}

#if !GN_SIZE_FIRST
/* gradient() of a shift below 32: the lower word as a signed one */
static inline int quick_gradient(int32_t *out, int64_t n, int32_t f, int32_t s)
{
    int32_t lo = (int32_t)((uint32_t)n & ~1U), hi = (int32_t)(n >> 32) + (int32_t)((uint32_t)lo >> 31);
    GN_KEEP(hi);
    int64_t v = (int64_t)hi * f + (int32_t)((int64_t)lo * f >> 32);
    *out = (int32_t)((uint32_t)v >> s | (uint32_t)(v >> 32) << (32 - s));
    return (int32_t)(v >> 32) >> s == *out >> 31;
}

/* The same for a triangle that faces the camera, has more than half a pixel and less than 2^17, and needs no bounds.
 * Returns 0 for others. */
static inline int quick_depth(gn_tri *tri, const projected *c0, const projected *c1, const projected *c2,
                              int32_t to_x_q16, int32_t to_y_q16, int32_t lasts, int32_t bits)
{
    int32_t ax = c1->x_q16 - c0->x_q16, ay = c1->y_q16 - c0->y_q16, minus_bx = c0->x_q16 - c2->x_q16,
            by = c2->y_q16 - c0->y_q16;
    uint64_t size = (uint64_t) - ((int64_t)ax * by + (int64_t)minus_bx * ay) | 1U;
    uint32_t hi = (uint32_t)(size >> 32), i0 = c0->iz_q32, i1 = c1->iz_q32, i2 = c2->iz_q32;
    if (hi - 1 >= (1U << 18) - 1) return 0;
    int32_t clz = gn_clz32(hi), s = 45 - clz, dx, dy;
    int32_t recip = -(int32_t)(gn_recip_norm2(hi << clz | (uint32_t)size >> (32 - clz)) >> 1);
    int32_t a = (int32_t)(i1 >> 1) - (int32_t)(i0 >> 1), b = (int32_t)(i2 >> 1) - (int32_t)(i0 >> 1);
    if (!quick_gradient(&dx, (int64_t)a * by + (int64_t)-b * ay, recip, s) ||
        !quick_gradient(&dy, (int64_t)b * ax + (int64_t)a * minus_bx, recip, s))
        return 0;
    uint32_t reach = depth_reach(dx, dy, bits), more = reach + 1, range = UINT32_MAX - reach - more;
    GN_KEEP(more);
    if (reach >= REACH_MAX || i0 - more >= range || i1 - more >= range || i2 - more >= range) return 0;
    int64_t step = (int64_t)dx * to_x_q16 + (int64_t)dy * to_y_q16; /* less than two pixels */
    tri->iz_ref = i0 + (uint32_t)(step >> 16);
    tri->iz_dx = dx;
    tri->iz_dy = dy;
    tri->iz_min = (uint16_t)(lasts + 1);
    tri->iz_max = 0;
    return 1;
}
#endif

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

void gn_setup_corners(const gn_frame *frame, const gn_tri *tri, int32_t x[3], int32_t y[3])
{
    int32_t bits = GN_K(frame, subpixel_bits);
    int32_t centre_x = (frame->picture.width << bits) >> 1, centre_y = (frame->picture.height << bits) >> 1;
    for (int i = 0; i < 3; i++) {
        x[i] = tri->x[i] + centre_x;
        y[i] = tri->y[i] + centre_y;
    }
}

/* Counts a triangle in the screen tiles that it may have pixels in. Where these are few, they are left for gn_bin.c. */
static inline void count_tiles(const setup_job *job, const gn_rect *px, uint32_t tri_idx)
{
    gn_frame *frame = job->frame;
#if !GN_SIZE_FIRST
    uint32_t w = (uint32_t)GN_K(frame, tile_width), h = (uint32_t)GN_K(frame, tile_height),
             tiles_x = frame->tiles_x; /* nothing is negative */
    uint32_t one = (uint32_t)px->y0 / h * tiles_x + (uint32_t)px->x0 / w;
    uint32_t apart = (uint32_t)(px->y1 - 1) / h * tiles_x + (uint32_t)(px->x1 - 1) / w - one;
    uint32_t way = !apart             ? GN_PLACE_ONE
                   : apart == 1       ? GN_PLACE_NEXT
                   : apart == tiles_x ? GN_PLACE_BELOW
                                      : GN_PLACE_MANY;
    if (tri_idx < GN_PLACES) job->place[tri_idx] = (uint16_t)(one << 2 | way);
    if (way != GN_PLACE_MANY) {
        gn_ref_offset *n_first = &job->tile_first[one];
        ++*n_first;
        if (apart) ++n_first[apart];
        return;
    }
#else
    (void)tri_idx;
#endif
    gn_tile_walk tiles = gn_setup_tiles(frame, px); /* of some tiles */
    gn_ref_offset *at = frame->tile_first + tiles.first;
    GN_ELEMENT(at);
    do {
        int32_t n = tiles.width;
        do ++*at++;
        while (--n);
        at += tiles.skip;
    } while (--tiles.height);
}

static inline grid_corner on_grid(const projected *at, int32_t bits)
{
    const grid_corner snapped = {at, snap(at->x_q16, bits), snap(at->y_q16, bits)};
    return snapped;
}

/* A triangle in the guard band: nothing if it faces away or covers no pixel centre. */
static GN_NOINLINE void emit(const setup_job *job, const projected *p0, const projected *p1, const projected *p2,
                             uint32_t triangle_idx)
{
    gn_frame *frame = job->frame;
    GN_ELEMENT(frame);
    int32_t bits = GN_K(frame, subpixel_bits);
    grid_corner a = on_grid(p0, bits), b = on_grid(p1, bits), c = on_grid(p2, bits), swap;
    int64_t area = (int64_t)(b.x - a.x) * (c.y - a.y) - (int64_t)(c.x - a.x) * (b.y - a.y);
    if (area >= 0) {
        if (area == 0 || !(job->object->flags & GN_OBJECT_TWO_SIDED)) return;
        swap = b, b = c, c = swap;
    }
    if (c.y < a.y && c.y < b.y) swap = a, a = c, c = b, b = swap; /* rotated, to begin with the top */
    else if (b.y < a.y) swap = a, a = b, b = c, c = swap;
    int32_t left = gn_min32(gn_min32(a.x, b.x), c.x), right = gn_max32(gn_max32(a.x, b.x), c.x),
            bottom = gn_max32(b.y, c.y);
    const gn_rect bounds = gn_setup_bounds_of(
        frame, left, right, a.y, bottom, GN_SIZE_FIRST ? gn_setup_add(frame->picture.width, bits) : job->add_px[0],
        GN_SIZE_FIRST ? gn_setup_add(frame->picture.height, bits) : job->add_px[1]);
    if (bounds.x0 >= bounds.x1 || bounds.y0 >= bounds.y1) return;
    uint32_t n = frame->stats.n_triangles++; /* counted on, to say how many would have been enough */
    if (n >= GN_MAX_TRIANGLES) return;
    count_tiles(job, &bounds, n);
    GN_COUNT(visible, 1);
    gn_tri *tri = &frame->tri[n];
    GN_KEEP(tri);
    tri->x[0] = (gn_coord)a.x, tri->x[2] = (gn_coord)c.x, tri->y[1] = (gn_coord)b.y;
    APART(tri);
    tri->x[1] = (gn_coord)b.x, tri->y[0] = (gn_coord)a.y, tri->y[2] = (gn_coord)c.y;
    tri->object_idx = (uint16_t)job->object_idx;
    tri->triangle_idx = (uint16_t)triangle_idx;
    /* from the top to the centre of the pixel that holds it */
    int32_t one = 1 << bits, x = a.x + ((frame->picture.width << bits) >> 1),
            y = a.y + ((frame->picture.height << bits) >> 1);
    int32_t to_x_q16 = ((a.x - (x & (one - 1))) * 2 + one) * (1 << (15 - bits)) - a.at->x_q16;
    int32_t to_y_q16 = ((a.y - (y & (one - 1))) * 2 + one) * (1 << (15 - bits)) - a.at->y_q16;
    int32_t width = right - left, height = bottom - a.y, lasts = GN_NARROW;
    if (GN_SIZE_FIRST || width >= job->narrow || height >= job->narrow)
        lasts = job->lasts_mask & gn_walk_lasts((uint32_t)width | (uint32_t)height);
#if !GN_SIZE_FIRST
    if (quick_depth(tri, a.at, b.at, c.at, to_x_q16, to_y_q16, lasts, bits)) return;
#endif
    general_depth(tri, a.at, b.at, c.at, to_x_q16, to_y_q16, lasts, bits);
}

#if GN_CLIPPING
/* A cut vertex may miss the guard band by a rounding of view space, which a long focal length magnifies. */
static GN_NOINLINE void project_cut(const setup_job *job, const int32_t v_q16[3], projected *at)
{
    int32_t most = job->frame->cam.coord_max_q16;
    project(job, v_q16, at);
    at->x_q16 = gn_max32(gn_min32(at->x_q16, most), -most);
    at->y_q16 = gn_max32(gn_min32(at->y_q16, most), -most);
}

/* Any triangle: what leaves the guard band, or comes nearer than near, is clipped. Where size comes first, it does all
 * of them. */
static GN_NOINLINE void general_triangle(const setup_job *job, const corner *const c[3], uint32_t outside,
                                         uint32_t triangle_idx)
{
    gn_frame *frame = job->frame;
    gn_polygon *polygon = &job->clipping->polygon;
    polygon->n = 3;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) polygon->v_q16[i][k] = c[i]->v_q16[k];
    if (outside) {
        gn_clip(polygon, &job->clipping->uncut, GN_OUT_ALL, frame->cam.near_q16, frame->cam.guard_q16);
        frame->stats.n_clipped++;
    }
    projected at[3];
    for (int i = 0; i < polygon->n; i++) { /* a fan */
        project_cut(job, polygon->v_q16[i], &at[gn_min32(i, 2)]);
        if (i < 2) continue;
        emit(job, &at[0], &at[1], &at[2], triangle_idx);
        at[1] = at[2];
    }
}

#endif

static gn_status setup_triangle(const setup_job *job, const corner *const c[3], uint32_t triangle_idx)
{
    GN_COUNT(triangles, 1);
    if (c[0]->out & c[1]->out & c[2]->out & GN_OUT_ALL) return GN_OK;
    uint32_t outside = (c[0]->out | c[1]->out | c[2]->out) >> 8;
#if GN_CLIPPING
    if (!CACHED_PROJECTION || outside) {
        general_triangle(job, c, outside, triangle_idx);
        return GN_OK;
    }
#else
    if (outside) return gn_fail(job->frame, GN_ERR_VERTEX_RANGE, job->object_idx);
#endif
#if CACHED_PROJECTION
    emit(job, &c[0]->at, &c[1]->at, &c[2]->at, triangle_idx);
#endif
    return GN_OK;
}

/* ---- Objects ----------------------------------------------------------------------------------------------------- */

/* The corners of a triangle, through the cache: c[2 .. 4]. */
static inline gn_status fetch_corners(const setup_job *job, const uint16_t *idx, corner spare[3], const corner *c[5])
{
    uint32_t n_vertices = job->object->mesh->n_vertices, first_tag = (job->object_idx << 16) + 1;
    for (const corner **at = c + 2; at != c + 5; at++) {
        uint32_t vertex_idx = *idx++, tag = first_tag + vertex_idx;
        if (vertex_idx >= n_vertices) return gn_fail(job->frame, GN_ERR_MESH_INDEX, job->object_idx);
        corner *entry = &job->cache[vertex_idx & job->cache_mask];
        if (entry->tag != tag) {
            if (entry == at[-1] || entry == at[-2])
                entry = &spare[at - c - 2]; /* the triangle itself needs what is there */
            if (!fill_corner(job, entry, vertex_idx)) return gn_fail(job->frame, GN_ERR_VERTEX_RANGE, job->object_idx);
            entry->tag = tag;
        }
        *at = entry;
    }
    return GN_OK;
}

static gn_status setup_object(setup_job *job)
{
    const gn_cam *cam = &job->frame->cam;
    const gn_mesh *mesh = job->object->mesh;
    corner spare[3];
    const corner *c[5];
    c[0] = c[1] = NULL; /* before the first there is none */
    gn_xform_compose(&job->xform, cam->axis_q30, cam->eye_q16, job->object);
    if (!GN_SIZE_FIRST) gn_xform_fast_begin(&job->fast, &job->xform);
    job->lasts_mask = GN_VISIBLE_ALPHA && job->object->visible_alpha != GN_ALPHA_OPAQUE ? 0 : -1;
    if (!GN_SIZE_FIRST) job->narrow = job->lasts_mask & gn_walk_narrow(GN_K(job->frame, subpixel_bits));
    for (uint32_t t = 0; t < mesh->n_triangles; t++) {
        gn_status status = fetch_corners(job, mesh->idx + 3 * (size_t)t, spare, c);
        if (!status) status = setup_triangle(job, c + 2, t);
        if (status) return status;
    }
    return GN_OK;
}

gn_status gn_setup_triangles(gn_frame *frame, gn_scratch *scratch)
{
    setup_job job;
    uint32_t n = 256;
    int32_t clz = gn_clz32(frame->cam.focal2_px_q16);
    while (n > 1 && n * (sizeof(corner) / 4) > sizeof scratch->cell / 4) n >>= 1;
    job.frame = frame;
    job.clipping = &scratch->work.clipping;
    job.cache = (corner *)(void *)scratch->cell;
    job.cache_mask = n - 1;
    job.focal_norm = frame->cam.focal2_px_q16 << clz;
    job.focal_up = 1 - clz;
    job.near_down = gn_clz32((uint32_t)frame->cam.near_q16) - 1;
    job.near_norm = (uint32_t)frame->cam.near_q16 << (job.near_down + 1);
    if (!GN_SIZE_FIRST) { /* for fill_corner */
        int32_t guard = gn_min32(frame->cam.guard_q16[0], frame->cam.guard_q16[1]);
        job.place = scratch->pixel.rgb565;
        job.add_px[0] = gn_setup_add(frame->picture.width, GN_K(frame, subpixel_bits));
        job.add_px[1] = gn_setup_add(frame->picture.height, GN_K(frame, subpixel_bits));
        job.tile_first = frame->tile_first;
        job.near_q16 = frame->cam.near_q16;
        job.z_range = (uint32_t)GN_VIEW_LIMIT_Q16 - (uint32_t)job.near_q16;
        job.half_q16[0] = (uint32_t)frame->picture.width << 15;
        job.half_q16[1] = (uint32_t)frame->picture.height << 15;
        for (job.near_guard = 0; guard < 65536 >> job.near_guard;) job.near_guard++;
    }
    frame->stats.n_triangles = 0;
    frame->stats.n_clipped = 0;
    for (uint32_t i = 0; i <= (uint32_t)frame->tiles_x * frame->tiles_y; i++) frame->tile_first[i] = 0;
    for (uint32_t i = 0; i < n; i++) job.cache[i].tag = 0;
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        job.object_idx = i;
        job.object = &frame->scene->objects[i];
        gn_status status = job.object->flags & GN_OBJECT_HIDDEN ? GN_OK : setup_object(&job);
        if (status) return status;
    }
    if (frame->stats.n_triangles > GN_MAX_TRIANGLES)
        return gn_fail_capacity(frame, GN_ERR_TRIANGLES_FULL, frame->stats.n_triangles, GN_MAX_TRIANGLES);
    return GN_OK;
}
