/* Visible triangles. */
#include "gn_setup.h"
#include "gn_clip.h"
#include "gn_count.h"
#include "gn_hint.h"
#include "gn_math.h"
#include "gn_plane.h"
#include "gn_q.h"
#include "gn_scene.h"
#include "gn_walk.h"
#include "gn_xform.h"

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

int gn_setup_vertex(int32_t out_q16[3], gn_vcache_entry *cache, const gn_xform *xform, const gn_mesh *mesh, uint32_t object_idx,
                    uint32_t vertex_idx)
{
    gn_vcache_entry *entry = &cache[vertex_idx & (GN_VERTEX_CACHE - 1)];
    uint32_t tag = (object_idx << 16 | vertex_idx) + 1U;
    if (entry->tag != tag) {
        entry->tag = 0;
        if (!view_position(entry->v_q16, xform, mesh, vertex_idx)) return 0;
        entry->tag = tag;
    }
    for (int i = 0; i < 3; i++) out_q16[i] = entry->v_q16[i];
    return 1;
}

/* ---- Vertices ------------------------------------------------------------------------------------------------------ */

/* A vertex as triangles need it. */
typedef struct {
    uint32_t tag; /* object << 16 | vertex, plus one; 0: empty */
    int32_t v_q16[3];
    uint32_t out;    /* outside of which planes: of the picture, of the guard band << 8 */
#if !GN_SIZE_FIRST
    int32_t x, y;    /* on the screen as in gn_tri, if in the guard band */
    uint32_t iz_q32; /* near / Z, the same */
#endif
} corner;

/* One object. */
typedef struct {
    gn_frame *frame;
    gn_clipping *clipping;
    corner *cache;
    uint32_t cache_mask;
    uint32_t focal_norm; /* 2F, normalised */
    int32_t focal_shift; /* see project */
    uint32_t near_norm;  /* near, normalised */
    int32_t near_clz;
    uint32_t tan[2]; /* cam->tan_q16 * 2^15; 0: not less than 2, too much for side_bits */
    uint32_t object_idx;
    const gn_object *object;
    gn_xform xform;
    gn_xform_fast fast;
} setup_job;

/* near / Z, Q32, truncated, below 1; recip is that of Z * 2^clz */
static inline uint32_t inverse_depth(const setup_job *job, uint32_t recip, int32_t clz)
{
    uint32_t q = (uint32_t)(((uint64_t)job->near_norm * recip) >> 32); /* near * 2^near_clz * 2^63 / (Z * 2^clz) / 2^32 */
    int32_t s = job->near_clz - clz;                                   /* Z is not nearer than near */
    if (!s && q >> 31) return UINT32_MAX;                              /* Z is near, and the quotient exact */
    return s ? q >> (s - 1) : q << 1 | 1U;
}

static uint32_t inverse_depth_q32(const setup_job *job, int32_t z_q16)
{
    int32_t clz = gn_clz32((uint32_t)z_q16);
    return inverse_depth(job, gn_recip_norm((uint32_t)z_q16 << clz, 2), clz);
}

/* round(v * 2^-s), 1 <= s <= 62; the result fits 32 bits */
static inline int32_t round_shift(int64_t v, int32_t s)
{
    int32_t hi = (int32_t)(v >> 32);
    if (!GN_SIZE_FIRST && s > 32) return (hi + (1 << (s - 33))) >> (s - 32);
    return (int32_t)gn_shr64(v, s);
}

/* Screen position from the picture's centre with subpixel_bits fraction bits, rounded to nearest: X * 2F / Z. Inside the guard band it is
 * below 2^11 pixels. */
static inline void project(const setup_job *job, const int32_t v_q16[3], uint32_t recip, int32_t clz, int32_t *x, int32_t *y)
{
    /* 2F / Z with 31 bits: 2^63 / (Z 2^clz) * (2F 2^focal_clz) / 2^33 */
    int32_t scale = (int32_t)(((uint64_t)recip * job->focal_norm) >> 33), s = job->focal_shift - clz;
    GN_KEEP(scale); /* positive, or as good as signed */
    *x = round_shift((int64_t)v_q16[0] * scale, s);
    *y = -round_shift((int64_t)v_q16[1] * scale, s);
}

/* Whether |v| > tan * Z, for Z > 0 and tan < 2: bit `low` if v is below, the next if it is above. */
static inline uint32_t side_bits(int32_t v, int32_t z, uint32_t tan, uint32_t low)
{
    uint32_t most = (uint32_t)(((uint64_t)((uint32_t)z << 1) * tan) >> 32); /* < 2^31 */
    if ((uint32_t)v + most <= 2 * most) return 0;
    return v < 0 ? low : low << 1;
}

/* Returns 0 if the vertex is out of range. */
static int fill_corner(const setup_job *job, corner *c, uint32_t vertex_idx)
{
    const gn_cam *cam = &job->frame->cam;
    const gn_mesh *mesh = job->object->mesh;
    c->tag = 0;
    if ((GN_SIZE_FIRST || !gn_xform_fast_vertex(c->v_q16, &job->fast, mesh->pos + 3 * (size_t)vertex_idx)) &&
        !view_position(c->v_q16, &job->xform, mesh, vertex_idx))
        return 0;
    int32_t z = c->v_q16[2];
    c->out = GN_OUT_NEAR << 8;
    if (z < cam->near_q16) {
        c->out |= gn_outcode(c->v_q16, cam->near_q16, cam->tan_q16);
        return 1;
    }
    if (!GN_SIZE_FIRST && job->tan[0] && job->tan[1])
        c->out = side_bits(c->v_q16[0], z, job->tan[0], GN_OUT_LEFT) | side_bits(c->v_q16[1], z, job->tan[1], GN_OUT_BOTTOM);
    else c->out = gn_outcode(c->v_q16, cam->near_q16, cam->tan_q16);
    if (c->out) c->out |= gn_outcode(c->v_q16, cam->near_q16, cam->guard_q16) << 8;
#if !GN_SIZE_FIRST
    if (c->out >> 8) return 1;
    int32_t clz = gn_clz32((uint32_t)z); /* Z in [2^8, 2^30): clz 2..23 */
    uint32_t recip = gn_recip_norm((uint32_t)z << clz, 2);
    project(job, c->v_q16, recip, clz, &c->x, &c->y);
    c->iz_q32 = inverse_depth(job, recip, clz);
#endif
    return 1;
}

/* ---- Depth --------------------------------------------------------------------------------------------------------- */

typedef struct {
    gn_plane plane;
    gn_bfloat scale; /* near / (2F det): turns c . ray into near / Z */
    int32_t dx, dy;
    uint32_t flat; /* near / Z for triangles without a usable plane: the largest */
} depth_setup;

/* gn_bf_apply where it is known to fit 32 bits; returns 0 otherwise. */
static inline int apply_small(int32_t *out, int32_t a, gn_bfloat b, int32_t shift)
{
    int32_t s = -(b.exp + shift) - 33;
    if (GN_SIZE_FIRST || s < 0 || s > 30) {
        int64_t v = gn_bf_apply(a, b, shift);
        *out = (int32_t)v;
        return v == *out;
    }
    uint32_t t = (uint32_t)(((uint64_t)gn_abs32(a) * b.mant) >> 32) >> s; /* 2^31 * 2^32 */
    int32_t v = (int32_t)((t >> 1) + (t & 1));
    *out = a < 0 ? -v : v;
    return 1;
}

/* Plane of the unsnapped triangle. `largest`: of near / Z on it. */
static void depth_begin(const gn_frame *frame, depth_setup *depth, const int32_t *const v[3], uint32_t largest)
{
    depth->flat = largest;
    gn_plane_setup(&depth->plane, v[0], v[1], v[2]);
    if (depth->plane.det > 0) {
#if GN_SIZE_FIRST
        depth->scale = gn_bf_mul(frame->cam.near_over_focal2, gn_bf_recip(gn_bf_from_u64((uint64_t)depth->plane.det)));
#else
        int32_t clz = gn_clz64((uint64_t)depth->plane.det); /* the same, written out */
        uint32_t recip = gn_recip_norm((uint32_t)((uint64_t)depth->plane.det << clz >> 32), 2);
        uint64_t mant = (uint64_t)frame->cam.near_over_focal2.mant * recip;
        depth->scale.exp = frame->cam.near_over_focal2.exp + clz - 95 + 32;
        if (!(mant >> 63)) {
            mant <<= 1;
            depth->scale.exp--;
        }
        depth->scale.mant = (uint32_t)(mant >> 32);
#endif
        if (apply_small(&depth->dx, depth->plane.n[0], depth->scale, 49) &&
            apply_small(&depth->dy, -depth->plane.n[1], depth->scale, 49))
            return;
    }
    depth->dx = depth->dy = 0;
    depth->plane.det = 0; /* edge on: the depth range of a pixel exceeds half of all depths; its nearest point stands for it */
}

static uint32_t depth_at(const gn_frame *frame, const depth_setup *depth, int32_t x, int32_t y)
{
    if (!depth->plane.det) return depth->flat;
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    int64_t w = gn_plane_at(depth->plane.n, px, py, frame->cam.focal2_px_q16);
    uint32_t hi = (uint32_t)(gn_abs64(w) >> 32), lo = (uint32_t)gn_abs64(w), mant = depth->scale.mant;
    int32_t s = -(depth->scale.exp + 64);
    if (!hi || s < 1 || s > 31) return (uint32_t)gn_bf_apply(w, depth->scale, 32);
    /* the same, modulo 2^32: the pixel may lie just outside the triangle */
    uint64_t r = (uint64_t)hi * mant + (((uint64_t)lo * mant + 0x80000000U) >> 32);
    uint32_t v = ((uint32_t)(r >> 32) << (32 - s) | (uint32_t)r >> s) + (((uint32_t)r >> (s - 1)) & 1U);
    return w < 0 ? 0U - v : v;
}

/* ---- Triangles ----------------------------------------------------------------------------------------------------- */

void gn_setup_corners(const gn_frame *frame, const gn_tri *tri, int32_t x[3], int32_t y[3])
{
    int32_t bits = GN_K(frame, subpixel_bits);
    int32_t centre_x = (frame->picture.width << bits) >> 1, centre_y = (frame->picture.height << bits) >> 1;
    for (int i = 0; i < 3; i++) {
        x[i] = tri->x[i] + centre_x;
        y[i] = tri->y[i] + centre_y;
    }
}

/* First and last pixel centres between the least and the largest of three coordinates from the centre, cut to 0 .. size. */
static inline void bounds_along(int32_t a, int32_t b, int32_t c, int32_t bits, int32_t size, int32_t *from, int32_t *to)
{
    int32_t lo = gn_min32(a, gn_min32(b, c)), hi = gn_max32(a, gn_max32(b, c)), centre = (size << bits) >> 1;
    *from = gn_max32(gn_first_px(lo + centre, bits), 0);
    *to = gn_min32(gn_first_px(hi + centre, bits), size);
}

static inline gn_rect bounds_of(const gn_frame *frame, const gn_tri *tri)
{
    int32_t bits = GN_K(frame, subpixel_bits);
    gn_rect r;
    bounds_along(tri->x[0], tri->x[1], tri->x[2], bits, frame->picture.width, &r.x0, &r.x1);
    bounds_along(tri->y[0], tri->y[1], tri->y[2], bits, frame->picture.height, &r.y0, &r.y1);
    return r;
}

gn_rect gn_setup_bounds(const gn_frame *frame, const gn_tri *tri)
{
    return bounds_of(frame, tri);
}

static void count_tiles(gn_frame *frame, const gn_rect *px)
{
    gn_rect r = gn_setup_tiles(frame, px);
    gn_ref_offset *row = frame->tile_first + r.y0 * frame->tiles_x;
    for (int32_t n = r.y1 - r.y0; n > 0; n--, row += frame->tiles_x)
        for (int32_t x = r.x0; x < r.x1; x++) row[x]++;
}

/* Begins a triangle of the clipped polygon: its corners, and its screen tiles are counted. Returns NULL if it faces away or covers no
 * pixel centre, or if there is no room. */
static inline gn_tri *emit_begin(const setup_job *job, gn_tri *tri, const int32_t x[3], const int32_t y[3])
{
    gn_frame *frame = job->frame;
    int64_t area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    if (area >= 0 && (area == 0 || !(job->object->flags & GN_OBJECT_TWO_SIDED))) return NULL;
    /* the top first, then the left of it: turned round if seen from behind, rotated */
    int second = area > 0 ? 2 : 1, top = y[second] < y[0] ? second : 0;
    if (y[3 - second] < y[top]) top = 3 - second;
    int left = top == 0 ? second : top == second ? 3 - second : 0, right = 3 - top - left;
    tri->x[0] = (gn_coord)x[top], tri->x[1] = (gn_coord)x[left], tri->x[2] = (gn_coord)x[right];
    tri->y[0] = (gn_coord)y[top], tri->y[1] = (gn_coord)y[left], tri->y[2] = (gn_coord)y[right];
    gn_rect bounds = bounds_of(frame, tri);
    if (bounds.x0 >= bounds.x1 || bounds.y0 >= bounds.y1) return NULL;
    if (frame->stats.n_triangles++ >= GN_MAX_TRIANGLES) return NULL; /* counted on, to say how many would have been enough */
    count_tiles(frame, &bounds);
    GN_COUNT(visible, 1);
    return tri;
}

/* What triangles need to know of their depth. A snapped edge may cover centres outside the unsnapped triangle, by half a unit of the subpixel
 * grid along each axis; where that is little, and no end of all depths is near, depth may leave the triangle's own range. */
static inline void store_range(gn_tri *tri, uint32_t least, uint32_t largest, int32_t bits)
{
    uint32_t reach = (((gn_abs32(tri->iz_dx) >> 1) + (gn_abs32(tri->iz_dy) >> 1)) >> bits) + 4096; /* roundings of 2^13 steps */
    tri->iz_min = (uint16_t)(least >> 16);
    tri->iz_max = (uint16_t)(largest >> 16);
    if (reach >> 18 || least <= reach || largest >= UINT32_MAX - reach) return;
    const int32_t x[3] = {tri->x[0], tri->x[1], tri->x[2]};
    tri->iz_min = (uint16_t)(1 + gn_walk_lasts(x, gn_max32(tri->y[1], tri->y[2]) - tri->y[0], bits));
    tri->iz_max = 0;
}

static inline void emit_end(const setup_job *job, gn_tri *tri, const depth_setup *depth, uint32_t iz_min, uint32_t triangle_idx)
{
    const gn_frame *frame = job->frame;
    int32_t bits = GN_K(frame, subpixel_bits);
    int32_t x = tri->x[0] + ((frame->picture.width << bits) >> 1), y = tri->y[0] + ((frame->picture.height << bits) >> 1);
    tri->iz_ref = depth_at(frame, depth, x >> bits, y >> bits);
    tri->iz_dx = depth->dx;
    tri->iz_dy = depth->dy;
    store_range(tri, iz_min, depth->flat, bits);
    tri->object_idx = (uint16_t)job->object_idx;
    tri->triangle_idx = (uint16_t)triangle_idx;
}

/* Where the next triangle goes; beyond the last it is not kept. */
static inline gn_tri *next_triangle(gn_frame *frame)
{
    return &frame->tri[frame->stats.n_triangles < GN_MAX_TRIANGLES ? frame->stats.n_triangles : GN_MAX_TRIANGLES - 1];
}

/* Any triangle: what leaves the guard band, or comes nearer than near, is clipped. Where size comes first, it does all of them. */
static GN_NOINLINE void general_triangle(const setup_job *job, const int32_t *const v[3], uint32_t outside, uint32_t triangle_idx)
{
    gn_frame *frame = job->frame;
    const gn_cam *cam = &frame->cam;
    gn_polygon *polygon = &job->clipping->polygon;
    polygon->n = 3;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) polygon->v_q16[i][k] = v[i][k];
    if (outside) {
        gn_clip(polygon, &job->clipping->uncut, GN_OUT_ALL, cam->near_q16, cam->guard_q16);
        frame->stats.n_clipped++;
    }
    int32_t *x = job->clipping->x, *y = job->clipping->y;
    for (int i = 0; i < polygon->n; i++) {
        int32_t z = polygon->v_q16[i][2], clz = gn_clz32((uint32_t)z);
        project(job, polygon->v_q16[i], gn_recip_norm((uint32_t)z << clz, 2), clz, &x[i], &y[i]);
        /* a cut vertex may miss the guard band by a rounding of view space, which a long focal length magnifies */
        x[i] = gn_max32(gn_min32(x[i], cam->coord_max), -cam->coord_max);
        y[i] = gn_max32(gn_min32(y[i], cam->coord_max), -cam->coord_max);
    }
    uint32_t largest = 0, least = UINT32_MAX;
    for (int i = 0; i < 3; i++) {
        uint32_t iz_q32 = inverse_depth_q32(job, gn_max32(v[i][2], cam->near_q16));
        if (iz_q32 > largest) largest = iz_q32;
        if (iz_q32 < least) least = iz_q32;
    }
    depth_setup depth;
    if (polygon->n) depth_begin(frame, &depth, v, largest);
    for (int i = 1; i + 1 < polygon->n; i++) {
        int32_t fx[3] = {x[0], x[i], x[i + 1]}, fy[3] = {y[0], y[i], y[i + 1]};
        gn_tri *tri = emit_begin(job, next_triangle(frame), fx, fy);
        if (tri) emit_end(job, tri, &depth, least, triangle_idx);
    }
}

static void setup_triangle(const setup_job *job, const corner *const c[3], uint32_t triangle_idx)
{
    GN_COUNT(triangles, 1);
    if (c[0]->out & c[1]->out & c[2]->out & GN_OUT_ALL) return;
    const int32_t *const v[3] = {c[0]->v_q16, c[1]->v_q16, c[2]->v_q16};
    uint32_t outside = (c[0]->out | c[1]->out | c[2]->out) >> 8;
    if (GN_SIZE_FIRST || outside) {
        general_triangle(job, v, outside, triangle_idx);
        return;
    }
#if !GN_SIZE_FIRST
    const int32_t x[3] = {c[0]->x, c[1]->x, c[2]->x}, y[3] = {c[0]->y, c[1]->y, c[2]->y};
    gn_tri *tri = emit_begin(job, next_triangle(job->frame), x, y);
    if (!tri) return;
    uint32_t a = c[0]->iz_q32, b = c[1]->iz_q32, largest = a > b ? a : b, least = a > b ? b : a;
    depth_setup depth;
    a = c[2]->iz_q32;
    depth_begin(job->frame, &depth, v, a > largest ? a : largest);
    emit_end(job, tri, &depth, a < least ? a : least, triangle_idx);
#endif
}

/* ---- Objects ------------------------------------------------------------------------------------------------------- */

/* The corners of a triangle, through the cache. */
static inline gn_status fetch_corners(const setup_job *job, const uint16_t *idx, corner spare[3], const corner *c[3])
{
    uint32_t n_vertices = job->object->mesh->n_vertices;
    for (int i = 0; i < 3; i++) {
        uint32_t vertex_idx = idx[i], tag = (job->object_idx << 16 | vertex_idx) + 1U;
        if (vertex_idx >= n_vertices) return gn_fail(job->frame, GN_ERR_MESH_INDEX, job->object_idx);
        corner *entry = &job->cache[vertex_idx & job->cache_mask];
        if (entry->tag != tag) {
            if ((i > 0 && entry == c[0]) || (i > 1 && entry == c[1]))
                entry = &spare[i]; /* the triangle itself needs what is there */
            if (!fill_corner(job, entry, vertex_idx)) return gn_fail(job->frame, GN_ERR_VERTEX_RANGE, job->object_idx);
            entry->tag = tag;
        }
        c[i] = entry;
    }
    return GN_OK;
}

static gn_status setup_object(setup_job *job)
{
    const gn_cam *cam = &job->frame->cam;
    const gn_mesh *mesh = job->object->mesh;
    corner spare[3];
    const corner *c[3];
    gn_xform_compose(&job->xform, cam->axis_q30, cam->eye_q16, job->object);
    if (!GN_SIZE_FIRST) gn_xform_fast_begin(&job->fast, &job->xform);
    for (uint32_t t = 0; t < mesh->n_triangles; t++) {
        gn_status status = fetch_corners(job, mesh->idx + 3 * (size_t)t, spare, c);
        if (status) return status;
        setup_triangle(job, c, t);
    }
    return GN_OK;
}

gn_status gn_setup_triangles(gn_frame *frame, gn_clipping *clipping, uint32_t *memory, uint32_t n_words)
{
    setup_job job;
    uint32_t n = 256;
    int32_t clz = gn_clz32(frame->cam.focal2_px_q16);
    while (n > 1 && n * (sizeof(corner) / 4) > n_words) n >>= 1;
    job.frame = frame;
    job.clipping = clipping;
    job.cache = (corner *)(void *)memory;
    job.cache_mask = n - 1;
    job.focal_norm = frame->cam.focal2_px_q16 << clz;
    job.focal_shift = 47 + clz - GN_K(frame, subpixel_bits);
    job.near_clz = gn_clz32((uint32_t)frame->cam.near_q16);
    job.near_norm = (uint32_t)frame->cam.near_q16 << job.near_clz;
    for (int i = 0; i < 2; i++) job.tan[i] = frame->cam.tan_q16[i] >> 17 ? 0 : (uint32_t)frame->cam.tan_q16[i] << 15;
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
