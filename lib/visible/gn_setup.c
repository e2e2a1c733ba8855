/* Visible triangles. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_geometry_types.h"
#include "geometry/gn_skin.h"
#include "geometry/gn_walk.h"
#include "geometry/gn_xform.h"
#include "scene/gn_scene.h"
#include "visible/gn_cell.h"
#include "visible/gn_setup.h"

/* View position of a vertex. */
static int view_position(int32_t out_q16[3], const gn_xform *xform, const int32_t p[3])
{
    int64_t v[3];
    if (!gn_position_ok(p)) return 0;
    gn_xform_point(v, xform, p);
    for (int i = 0; i < 3; i++) {
        if (v[i] <= -GN_VIEW_LIMIT_Q16 || v[i] >= GN_VIEW_LIMIT_Q16) return 0;
        out_q16[i] = (int32_t)v[i];
    }
    return 1;
}

int gn_setup_vertex(int32_t out_q16[3], gn_vertex_entry *cache, const gn_xform *xform, const gn_object *object,
                    uint32_t object_idx, uint32_t vertex_idx)
{
    gn_vertex_entry *entry = &cache[gn_vertex_slot(vertex_idx, GN_VERTEX_CACHE - 1)];
    uint32_t tag = gn_vertex_tag(object_idx, vertex_idx);
    if (!gn_vertex_hit(entry, tag)) {
        gn_vertex_drop(entry);
        int32_t p[3];
        gn_position_of(p, object, vertex_idx);
        if (!view_position(entry->v_q16, xform, p)) return 0;
        GN_COUNT(vertices, 1);
        gn_vertex_claim(entry, tag);
    }
    for (int i = 0; i < 3; i++) out_q16[i] = entry->v_q16[i];
    return 1;
}

/* ---- Vertices ---------------------------------------------------------------------------------------------------- */

/* A transformed and projected vertex. */
typedef struct {
    gn_vertex_entry vertex;
    uint32_t out;    /* planes it is outside of: the picture's, and the guard band's << 8 */
    gn_projected at; /* if in the guard band */
} setup_corner;

/* One object. */
typedef struct {
    gn_screen_job screen;
    gn_clipping *clipping;
    setup_corner *cache;
    uint32_t cache_mask;
    uint32_t focal_norm; /* 2F, normalised */
    int32_t focal_up;    /* see project */
    uint32_t near_norm;  /* near, normalised */
    int32_t near_down;   /* its leading zeros, less one */
    int32_t near_q16;
    uint32_t z_range;   /* from near to 2^30 */
    int32_t low_q16[2]; /* left and top of the picture, or of a screen tile in it, from the picture's centre, pixels */
    uint32_t size_q16[2]; /* its width and height */
    uint32_t near_planes; /* for corners nearer than near: outside of the picture is not outside of a tile there */
    int32_t near_guard;   /* inside |x|, |y| <= Z * 2^-near_guard is inside the guard band */
    gn_xform xform;
    gn_xform_fast fast;
} setup_job;

/* near / Z, Q32, truncated, below 1; recip is that of Z * 2^clz */
static inline uint32_t inverse_depth(const setup_job *job, uint32_t recip, int32_t clz)
{
    uint32_t q =
        (uint32_t)(((uint64_t)job->near_norm * recip) >> 32); /* near * 2^near_clz * 2^63 / (Z * 2^clz) / 2^32 */
    int32_t down = job->near_down - clz;                      /* Z is not nearer than near: at least -1 */
    if (GN_SELDOM(down < 0)) return q >> 31 ? UINT32_MAX : q << 1 | 1U; /* Z is near, and the quotient exact */
    GN_KEEP(q);                                                         /* a branch */
    return q >> down;
}

/* floor(v * scale / 2^32) */
static inline int32_t scaled(int32_t v, int32_t scale)
{
    GN_KEEP(v); /* hides the sign from the compiler: one signed multiplication */
    GN_KEEP(scale);
    return (int32_t)(((int64_t)v * scale) >> 32);
}

/* X * 2F / Z and near / Z; Z in [2^8, 2^30). The first is rounded down. */
GN_INLINE void project(const setup_job *job, const int32_t v_q16[3], gn_projected *at)
{
    int32_t flat = GN_FLAT_Q16(job->screen.frame);
    uint32_t depth = (uint32_t)(flat ? flat : v_q16[2]);
    int32_t clz = gn_clz32(depth), up = job->focal_up + clz; /* clz 2..23 */
    uint32_t recip = gn_recip_norm2(depth << clz);
    /* 2F / Z with 31 bits: 2^63 / (Z 2^clz) * (2F 2^focal_clz) / 2^33, in [2^29, 2^31); results are below 2^27, so that
     * |v| * 2^up < 2^30 */
    int32_t scale = (int32_t)(((uint64_t)recip * job->focal_norm) >> 33), x = v_q16[0], y = v_q16[1];
    if (up >= 0) {
        x = (int32_t)((uint32_t)x << up);
        y = (int32_t)((uint32_t)y << up);
    } else { /* drop the last bits first */
        x >>= -up;
        y >>= -up;
    }
    at->x_q16 = scaled(x, scale);
    at->y_q16 = -scaled(y, scale);
    if (flat)
        at->iz_q32 = ((uint32_t)GN_VIEW_LIMIT_Q16 - (uint32_t)v_q16[2]) << 2; /* linear, too: 1 - Z / 2^14 units */
    else at->iz_q32 = inverse_depth(job, recip, clz);
}

/* A cut vertex may miss the guard band by a rounding of view space, which a long focal length magnifies. */
GN_COLD static GN_NOINLINE void project_cut(const setup_job *job, const int32_t v_q16[3], gn_projected *at)
{
    int32_t most = job->screen.frame->cam.coord_max_q16;
    project(job, v_q16, at);
    at->x_q16 = gn_max32(gn_min32(at->x_q16, most), -most);
    at->y_q16 = gn_max32(gn_min32(at->y_q16, most), -most);
}

/* Bit `before` if a coordinate that is not within the size from `low` is below it, `after` if it is above. */
static inline uint32_t side_bit(int32_t v, int32_t low, uint32_t size, uint32_t before, uint32_t after)
{
    return (uint32_t)(v - low) <= size ? 0 : v < low ? before : after;
}

/* Returns 0 for a corner nearer than near, outside or near the border of the guard band, or out of range. */
static GN_NOINLINE int fill_far_corner(const setup_job *job, setup_corner *c)
{
    const gn_cam *cam = &job->screen.frame->cam;
    const int32_t *v = c->vertex.v_q16, flat = GN_FLAT_Q16(job->screen.frame);
    for (int k = 0; k < 3; k++)
        if (v[k] <= -GN_VIEW_LIMIT_Q16 || v[k] >= GN_VIEW_LIMIT_Q16) return 0;
    c->out = gn_outcode(v, cam->near_q16, cam->tan_q16, flat);
    if (v[2] < cam->near_q16) c->out = (c->out & job->near_planes) | GN_OUT_NEAR << 8;
    else if (c->out) c->out |= gn_outcode(v, cam->near_q16, cam->guard_q16, flat) << 8;
    if (!(c->out >> 8)) project(job, v, &c->at);
    return 1;
}

/* Tests no planes for most vertices. Returns 0 if the vertex is out of range. */
GN_INLINE int fill_setup_corner(const setup_job *job, setup_corner *c, uint32_t vertex_idx)
{
    int32_t v[3], p[3];
    gn_posed_vertex(p, job->screen.frame, job->screen.object, job->screen.object_idx, vertex_idx);
    if (!gn_xform_fast_wide(v, &job->fast, p)) {
        if (!view_position(c->vertex.v_q16, &job->xform, p)) return 0;
        for (int k = 0; k < 3; k++) v[k] = c->vertex.v_q16[k];
    }
    for (int k = 0; k < 3; k++) c->vertex.v_q16[k] = v[k];
    uint32_t z = (uint32_t)v[2] >> job->near_guard;
    if (GN_FLAT_Q16(job->screen.frame)) return fill_far_corner(job, c);
    if ((uint32_t)v[2] - (uint32_t)job->near_q16 >= job->z_range || (uint32_t)v[0] + z > 2 * z ||
        (uint32_t)v[1] + z > 2 * z)
        return fill_far_corner(job, c);
    project(job, v, &c->at);
    c->out = 0;
    if (GN_SELDOM((uint32_t)(c->at.x_q16 - job->low_q16[0]) > job->size_q16[0] ||
                  (uint32_t)(c->at.y_q16 - job->low_q16[1]) > job->size_q16[1]))
        c->out = side_bit(c->at.x_q16, job->low_q16[0], job->size_q16[0], GN_OUT_LEFT, GN_OUT_RIGHT) |
                 side_bit(c->at.y_q16, job->low_q16[1], job->size_q16[1], GN_OUT_TOP, GN_OUT_BOTTOM);
    return 1;
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

/* A triangle that leaves the guard band, or comes nearer than near. [R3] */
GN_COLD static GN_NOINLINE void clip_triangle(const setup_job *job, const setup_corner *const c[3],
                                              uint32_t triangle_idx)
{
    const gn_frame *frame = job->screen.frame;
    gn_polygon *polygon = &job->clipping->polygon;
    gn_projected at[GN_CLIP_VERTICES_MAX];
    polygon->n = 3;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) polygon->v_q16[i][k] = c[i]->vertex.v_q16[k];
    gn_clip(polygon, &job->clipping->uncut, GN_OUT_ALL, frame->cam.near_q16, frame->cam.guard_q16, GN_FLAT_Q16(frame));
    if (job->screen.stats) job->screen.stats->n_clipped++;
    const int n = polygon->n; /* drawing a triangle may take the polygon's memory */
    for (int i = 0; i < n; i++) project_cut(job, polygon->v_q16[i], &at[i]);
    for (int i = 2; i < n; i++) /* a fan */
        gn_screen_triangle(&job->screen, &at[0], &at[i - 1], &at[i], triangle_idx | GN_TRI_PART);
}

static gn_status setup_triangle(const setup_job *job, const setup_corner *const c[3], uint32_t triangle_idx)
{
    GN_COUNT(triangles, 1);
    if (c[0]->out & c[1]->out & c[2]->out & GN_OUT_ALL) return GN_OK;
    int outside = (c[0]->out | c[1]->out | c[2]->out) >> 8 != 0;
    if (outside && !GN_CLIPPING) return GN_ERR_VERTEX_RANGE;
    if (outside) clip_triangle(job, c, triangle_idx);
    else gn_screen_triangle(&job->screen, &c[0]->at, &c[1]->at, &c[2]->at, triangle_idx);
    return GN_OK;
}

/* ---- Objects ----------------------------------------------------------------------------------------------------- */

/* The corners of a triangle, through the cache: c[2 .. 4]. */
static inline gn_status fetch_corners(const setup_job *job, const uint16_t *idx, setup_corner spare[3],
                                      const setup_corner *c[5])
{
    uint32_t n_vertices = job->screen.object->mesh->n_vertices, first_tag = gn_vertex_tag(job->screen.object_idx, 0);
    for (const setup_corner **at = c + 2; at != c + 5; at++) {
        uint32_t vertex_idx = *idx++, tag = first_tag + vertex_idx;
        if (vertex_idx >= n_vertices) return GN_ERR_MESH_INDEX;
        setup_corner *entry = &job->cache[gn_vertex_slot(vertex_idx, job->cache_mask)];
        if (!gn_vertex_hit(&entry->vertex, tag)) {
            GN_COUNT(vertices, 1);
            entry = (setup_corner *)gn_vertex_claim_corner(&entry->vertex, tag, &at[-1]->vertex, &at[-2]->vertex,
                                                           &spare[at - c - 2].vertex);
            if (!fill_setup_corner(job, entry, vertex_idx)) return GN_ERR_VERTEX_RANGE;
        }
        *at = entry;
    }
    return GN_OK;
}

static void setup_begin_object(setup_job *job)
{
    const gn_cam *cam = &job->screen.frame->cam;
    gn_xform_compose(&job->xform, cam->axis_q30, cam->eye_q16, job->screen.object);
    gn_xform_fast_begin(&job->fast, &job->xform);
    gn_screen_object(&job->screen);
}

/* Triangles of an object, from `t` up to `end`, or down from `t - 1` to `end`. */
static gn_status setup_span(setup_job *job, uint32_t t, uint32_t end)
{
    const gn_mesh *mesh = job->screen.object->mesh;
    const int down = end < t;
    setup_corner spare[3];
    const setup_corner *c[5];
    c[0] = c[1] = spare; /* no cache entry: no corner before the first */
    while (t != end) {
        if (down) t--;
        gn_status status = fetch_corners(job, mesh->idx + 3 * (size_t)t, spare, c);
        if (!status) status = setup_triangle(job, c + 2, t);
        if (status) return status;
        if (!down) t++;
    }
    return GN_OK;
}

/* Vertices are sorted into those inside and outside of this rectangle of the picture. */
static void setup_window(setup_job *job, const gn_rect *px)
{
    const gn_picture *picture = &job->screen.frame->picture;
    job->near_planes = job->screen.stats ? GN_OUT_ALL : GN_OUT_NEAR;
    job->low_q16[0] = (2 * px->x0 - picture->width) * (1 << 15);
    job->low_q16[1] = (2 * px->y0 - picture->height) * (1 << 15);
    job->size_q16[0] = (uint32_t)(px->x1 - px->x0) << 16;
    job->size_q16[1] = (uint32_t)(px->y1 - px->y0) << 16;
}

/* Constants of a frame, and an empty cache of vertices in the memory. */
static void setup_begin(setup_job *job, const gn_frame *frame, gn_scratch *scratch, void *memory, size_t bytes)
{
    int32_t clz = gn_clz32(frame->cam.focal2_px_q16);
    gn_screen_begin(&job->screen, frame);
    job->clipping = &scratch->work.clipping;
    job->cache = memory;
    job->cache_mask = gn_vertex_mask(bytes, sizeof(setup_corner));
    job->focal_norm = frame->cam.focal2_px_q16 << clz;
    job->focal_up = 1 - clz;
    job->near_down = gn_clz32((uint32_t)frame->cam.near_q16) - 1;
    job->near_norm = (uint32_t)frame->cam.near_q16 << (job->near_down + 1);
    int32_t guard = gn_min32(frame->cam.guard_q16[0], frame->cam.guard_q16[1]);
    job->near_q16 = frame->cam.near_q16;
    job->z_range = (uint32_t)GN_VIEW_LIMIT_Q16 - (uint32_t)job->near_q16;
    for (job->near_guard = 0; guard < 65536 >> job->near_guard;) job->near_guard++;
    for (uint32_t i = 0; i <= job->cache_mask; i++) gn_vertex_drop(&job->cache[i].vertex);
}

/* ---- Groups ------------------------------------------------------------------------------------------------------ */

#if GN_GROUPS
/* As few triangles to a group as there are groups for. */
static void setup_begin_groups(gn_frame *frame)
{
    const uint32_t n_groups = (uint32_t)GN_K(frame, triangle_groups);
    uint32_t n = 0;
    for (uint32_t i = 0; i < frame->n_objects; i++) {
        const gn_object *object = &frame->objects[i];
        if (!(frame->flags[i] & GN_OBJECT_HIDDEN)) n += object->mesh->n_triangles;
    }
    frame->n_grouped = n;
    frame->group_shift = 0;
    while (n && (n - 1) >> frame->group_shift >= n_groups) frame->group_shift++;
    for (uint32_t i = 0; i < n_groups; i++) frame->group[i] = GN_GROUP_EMPTY;
}

/* Counts an object's triangles, the first of which is `first` of all. */
static gn_status setup_count_groups(setup_job *job, gn_tri_group *groups, uint32_t first)
{
    const uint32_t shift = job->screen.frame->group_shift, n = job->screen.object->mesh->n_triangles;
    setup_begin_object(job);
    for (uint32_t t = 0; t < n;) {
        const uint32_t left = (1U << shift) - ((first + t) & ((1U << shift) - 1)), end = left < n - t ? t + left : n;
        job->screen.group = &groups[(first + t) >> shift];
        gn_status status = setup_span(job, t, end);
        if (status) return status;
        t = end;
    }
    return GN_OK;
}

/* Draws those whose groups meet a screen tile, the last first. The frame's setup has found no error. */
static void setup_draw_groups(setup_job *job, gn_tri_group tile, uint32_t first)
{
    const gn_frame *frame = job->screen.frame;
    const uint32_t shift = frame->group_shift, n = job->screen.object->mesh->n_triangles, lowest = first >> shift;
    int begun = 0;
    for (uint32_t i = ((first + n - 1) >> shift) + 1; i-- > lowest;) {
        if (!gn_group_meets(frame->group[i], tile)) continue;
        const uint32_t begin = i << shift, end = begin + ((1U << shift) - 1); /* the last: below 2^32 */
        if (!begun) setup_begin_object(job);
        begun = 1;
        setup_span(job, end - first < n ? end - first + 1 : n, begin > first ? begin - first : 0);
    }
}

void gn_setup_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx, const gn_raster_target *target)
{
    setup_job job;
    gn_screen_tile_job tile = {target, gn_screen_rect(frame, tile_idx), scratch->drawn, 0, frame->tile_first[tile_idx]};
    uint32_t first = frame->n_grouped;
    const uint32_t column = tile_idx % frame->tiles_x, row = tile_idx / frame->tiles_x;
    if (!tile.n_counted) return;
    if (sizeof scratch->pixel > GN_WORK_FREE_BYTES)
        setup_begin(&job, frame, scratch, &scratch->pixel, sizeof scratch->pixel);
    else setup_begin(&job, frame, scratch, (char *)&scratch->work + GN_WORK_DRAWN_BYTES, GN_WORK_FREE_BYTES);
    job.screen.stats = NULL;
    setup_window(&job, &tile.rect);
    job.screen.tile = &tile;
    for (uint32_t i = frame->n_objects; i-- > 0;) {
        job.screen.object_idx = i;
        job.screen.object = &frame->objects[i];
        if (frame->flags[i] & GN_OBJECT_HIDDEN) continue;
        first -= job.screen.object->mesh->n_triangles;
        setup_draw_groups(&job, gn_group_of(column, column, row, row), first);
    }
}

int gn_setup_record(const gn_frame *frame, gn_scratch *scratch, const gn_tri_source *source, gn_tri *out)
{
    setup_job job;
    setup_corner memory[1], spare[3];
    const setup_corner *c[5];
    const gn_rect all = {0, 0, frame->picture.width, frame->picture.height};
    setup_begin(&job, frame, scratch, memory, sizeof memory);
    job.screen.stats = NULL;
    setup_window(&job, &all);
    job.screen.object_idx = source->object_idx;
    job.screen.object = &frame->scene->objects[source->object_idx];
    setup_begin_object(&job);
    c[0] = c[1] = spare;
    if (fetch_corners(&job, job.screen.object->mesh->idx + 3 * (size_t)source->triangle_idx, spare, c)) return 0;
    if ((c[2]->out | c[3]->out | c[4]->out) >> 8) return 0;
    return gn_screen_record(&job.screen, &c[2]->at, &c[3]->at, &c[4]->at, source->triangle_idx, out);
}
#endif

/* ---- The frame --------------------------------------------------------------------------------------------------- */

static gn_status setup_object(setup_job *job, gn_frame *frame, uint32_t first)
{
#if GN_GROUPS
    if (GN_K(frame, triangle_groups)) return setup_count_groups(job, frame->group, first);
#endif
    (void)frame, (void)first;
    setup_begin_object(job);
    return setup_span(job, 0, job->screen.object->mesh->n_triangles);
}

/* Records lie over vertices that were kept: gn_prepare has failed before. */
static void forget_posed(gn_frame *frame)
{
#if GN_VERTEX_JOINTS && GN_BOXES
    for (uint32_t i = 0; i < frame->n_objects; i++) frame->object[i].posed = GN_POSED_NOWHERE;
#endif
    (void)frame;
}

gn_status gn_setup_triangles(gn_frame *frame, gn_scratch *scratch)
{
    setup_job job;
    const gn_rect picture = {0, 0, frame->picture.width, frame->picture.height};
    setup_begin(&job, frame, scratch, scratch->cell, sizeof scratch->cell);
    uint32_t first = 0;
    job.screen.stats = &frame->stats;
    setup_window(&job, &picture);
    job.screen.tile_first = frame->tile_first;
    job.screen.tri = frame->records.tri;
#if GN_GROUPS
    job.screen.tile = NULL;
    if (GN_K(frame, triangle_groups)) setup_begin_groups(frame);
#endif
    if (frame->stats.n_triangles) forget_posed(frame);
    frame->stats.n_triangles = 0;
    frame->stats.n_clipped = 0;
    for (uint32_t i = 0; i <= (uint32_t)frame->tiles_x * frame->tiles_y; i++) frame->tile_first[i] = 0;
    for (uint32_t i = 0; i < frame->n_objects; i++) {
        job.screen.object_idx = i;
        job.screen.object = &frame->objects[i];
        if (frame->flags[i] & GN_OBJECT_HIDDEN) continue;
        gn_status status = setup_object(&job, frame, first);
        if (status) return GN_FAIL_AT(frame, status, i, GN_MESH_FIELD(status));
        first += job.screen.object->mesh->n_triangles;
    }
    if (!GN_K(frame, triangle_groups) && frame->stats.n_triangles > GN_MAX_TRIANGLES)
        return gn_fail_capacity(frame, GN_ERR_TRIANGLES_FULL, frame->stats.n_triangles, GN_MAX_TRIANGLES);
    return GN_OK;
}
