/* Visible triangles. */
#include "gn_setup.h"
#include "gn_clip.h"
#include "gn_count.h"
#include "gn_math.h"
#include "gn_plane.h"
#include "gn_q.h"
#include "gn_scene.h"
#include "gn_walk.h"
#include "gn_xform.h"

int gn_setup_vertex(int32_t out_q16[3], gn_vcache_entry *cache, const gn_xform *xform, const gn_mesh *mesh, uint32_t object_idx,
                    uint32_t vertex_idx)
{
    gn_vcache_entry *entry = &cache[vertex_idx & (GN_VERTEX_CACHE - 1)];
    uint32_t tag = (object_idx << 16 | vertex_idx) + 1U;
    if (entry->tag != tag) {
        int64_t v[3];
        if (!gn_xform_position_ok(mesh, vertex_idx)) return 0;
        gn_xform_vertex(v, xform, mesh, vertex_idx);
        entry->tag = 0;
        for (int i = 0; i < 3; i++) {
            if (v[i] <= -GN_VIEW_LIMIT_Q16 || v[i] >= GN_VIEW_LIMIT_Q16) return 0;
            entry->v_q16[i] = (int32_t)v[i];
        }
        entry->tag = tag;
    }
    for (int i = 0; i < 3; i++) out_q16[i] = entry->v_q16[i];
    return 1;
}

/* Screen position from the picture's centre with subpixel_bits fraction bits, rounded to nearest; v is inside the guard band and not nearer than near. */
static void project(const gn_frame *frame, const int32_t v_q16[3], int32_t *x, int32_t *y)
{
    int32_t bits = GN_K(frame, subpixel_bits);
    int32_t clz = gn_clz32((uint32_t)v_q16[2]); /* Z in [2^8, 2^30): clz 2..23 */
    uint32_t recip = gn_recip_norm((uint32_t)v_q16[2] << clz, 2);
    int64_t screen[2];
    for (int i = 0; i < 2; i++) {
        /* X / Z in Q28: 2^30 * 2^32; inside the guard band X / Z * F < 2^11 pixels, so the product is below 2^57 */
        int64_t ratio_q28 = gn_shr64((int64_t)v_q16[i] * (int64_t)recip, 35 - clz);
        screen[i] = gn_shr64(ratio_q28 * (int64_t)frame->cam.focal2_px_q16, 45 - bits);
    }
    /* a cut vertex may miss the guard band by a rounding of view space, which a long focal length magnifies */
    *x = (int32_t)gn_clamp64(screen[0], -frame->cam.coord_max, frame->cam.coord_max);
    *y = -(int32_t)gn_clamp64(screen[1], -frame->cam.coord_max, frame->cam.coord_max);
}

/* near / Z, Q0.32, saturated below 1 */
static uint32_t inverse_depth_q32(const gn_frame *frame, int32_t z_q16)
{
    gn_bfloat z = gn_bf_recip(gn_bf_from_u64((uint64_t)(uint32_t)z_q16));
    return (uint32_t)gn_clamp64(gn_bf_apply(frame->cam.near_q16, z, 32), 0, UINT32_MAX);
}

typedef struct {
    gn_plane plane;
    gn_bfloat scale; /* near / (2F det): turns c . ray into near / Z */
    int32_t dx, dy;
    uint32_t flat; /* near / Z for triangles without a usable plane */
    uint16_t iz_min, iz_max;
} depth_setup;

static void depth_begin(const gn_frame *frame, depth_setup *depth, const int32_t *const v[3])
{
    int32_t z_min = v[0][2], z_max = v[0][2];
    for (int i = 1; i < 3; i++) {
        z_min = gn_min32(z_min, v[i][2]);
        z_max = gn_max32(z_max, v[i][2]);
    }
    uint32_t iz_max = inverse_depth_q32(frame, gn_max32(z_min, frame->cam.near_q16));
    depth->iz_max = (uint16_t)(iz_max >> 16);
    depth->iz_min = (uint16_t)(inverse_depth_q32(frame, z_max) >> 16);
    gn_plane_setup(&depth->plane, v[0], v[1], v[2]);
    depth->flat = iz_max;
    depth->dx = depth->dy = 0;
    if (depth->plane.det > 0) {
        depth->scale = gn_bf_mul(frame->cam.near_over_focal2, gn_bf_recip(gn_bf_from_u64((uint64_t)depth->plane.det)));
        int64_t dx = gn_bf_apply(depth->plane.n[0], depth->scale, 49);
        int64_t dy = -gn_bf_apply(depth->plane.n[1], depth->scale, 49);
        if (dx == (int32_t)dx && dy == (int32_t)dy) {
            depth->dx = (int32_t)dx;
            depth->dy = (int32_t)dy;
            return;
        }
    }
    depth->plane.det = 0; /* edge on: the depth range of a pixel exceeds half of all depths; its nearest point stands for it */
}

static uint32_t depth_at(const gn_frame *frame, const depth_setup *depth, int32_t x, int32_t y)
{
    if (!depth->plane.det) return depth->flat;
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    int64_t w = gn_plane_at(depth->plane.n, px, py, frame->cam.focal2_px_q16);
    return (uint32_t)gn_bf_apply(w, depth->scale, 32); /* modulo 2^32: the pixel may lie just outside the triangle */
}

void gn_setup_corners(const gn_frame *frame, const gn_tri *tri, int32_t x[3], int32_t y[3])
{
    int32_t bits = GN_K(frame, subpixel_bits);
    int32_t centre_x = (frame->picture.width << bits) >> 1, centre_y = (frame->picture.height << bits) >> 1;
    for (int i = 0; i < 3; i++) {
        x[i] = tri->x[i] + centre_x;
        y[i] = tri->y[i] + centre_y;
    }
}

gn_rect gn_setup_bounds(const gn_frame *frame, const gn_tri *tri)
{
    int32_t bits = GN_K(frame, subpixel_bits), x[3], y[3];
    gn_setup_corners(frame, tri, x, y);
    gn_rect r;
    r.x0 = gn_max32(gn_first_px(gn_min32(x[0], gn_min32(x[1], x[2])), bits), 0);
    r.y0 = gn_max32(gn_first_px(gn_min32(y[0], gn_min32(y[1], y[2])), bits), 0);
    r.x1 = gn_min32(gn_first_px(gn_max32(x[0], gn_max32(x[1], x[2])), bits), frame->picture.width);
    r.y1 = gn_min32(gn_first_px(gn_max32(y[0], gn_max32(y[1], y[2])), bits), frame->picture.height);
    return r;
}

/* One triangle of the clipped polygon. Dropped if it faces away or covers no pixel centre. */
static void emit(gn_frame *frame, const depth_setup *depth, const int32_t x[3], const int32_t y[3], uint32_t object_idx,
                 uint32_t triangle_idx)
{
    int64_t area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    int two_sided = (frame->scene->objects[object_idx].flags & GN_OBJECT_TWO_SIDED) != 0;
    if (area == 0 || (area > 0 && !two_sided)) return;
    gn_tri tri;
    for (int i = 0; i < 3; i++) {
        int from = area > 0 ? (3 - i) % 3 : i;
        tri.x[i] = (gn_coord)x[from];
        tri.y[i] = (gn_coord)y[from];
    }
    gn_rect bounds = gn_setup_bounds(frame, &tri);
    if (bounds.x0 >= bounds.x1 || bounds.y0 >= bounds.y1) return;
    if (frame->stats.n_triangles++ >= GN_MAX_TRIANGLES) return; /* counted on, to say how many would have been enough */
    int32_t bits = GN_K(frame, subpixel_bits), sx[3], sy[3];
    gn_setup_corners(frame, &tri, sx, sy);
    tri.iz_ref = depth_at(frame, depth, sx[0] >> bits, sy[0] >> bits);
    tri.iz_dx = depth->dx;
    tri.iz_dy = depth->dy;
    tri.iz_min = depth->iz_min;
    tri.iz_max = depth->iz_max;
    tri.object_idx = (uint16_t)object_idx;
    tri.triangle_idx = (uint16_t)triangle_idx;
    frame->tri[frame->stats.n_triangles - 1] = tri;
    GN_COUNT(visible, 1);
}

static void setup_triangle(gn_frame *frame, const int32_t *const v[3], uint32_t object_idx, uint32_t triangle_idx)
{
    GN_COUNT(triangles, 1);
    const gn_cam *cam = &frame->cam;
    uint32_t all = ~0U, any = 0, any_guard = 0;
    for (int i = 0; i < 3; i++) {
        uint32_t out = gn_outcode(v[i], cam->near_q16, cam->tan_q16);
        all &= out;
        any |= out;
    }
    if (all) return;
    for (int i = 0; any && i < 3; i++) any_guard |= gn_outcode(v[i], cam->near_q16, cam->guard_q16);
    gn_polygon polygon = {.n = 3};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) polygon.v_q16[i][k] = v[i][k];
    if (any_guard) {
        gn_clip(&polygon, GN_OUT_ALL, cam->near_q16, cam->guard_q16);
        frame->stats.n_clipped++;
    }
    int32_t x[GN_CLIP_VERTICES_MAX], y[GN_CLIP_VERTICES_MAX];
    for (int i = 0; i < polygon.n; i++) project(frame, polygon.v_q16[i], &x[i], &y[i]);
    depth_setup depth;
    if (polygon.n) depth_begin(frame, &depth, v);
    for (int i = 1; i + 1 < polygon.n; i++) {
        int32_t fx[3] = {x[0], x[i], x[i + 1]}, fy[3] = {y[0], y[i], y[i + 1]};
        emit(frame, &depth, fx, fy, object_idx, triangle_idx);
    }
}

static gn_status setup_object(gn_frame *frame, gn_vcache_entry *cache, uint32_t object_idx)
{
    const gn_cam *cam = &frame->cam;
    const gn_object *object = &frame->scene->objects[object_idx];
    const gn_mesh *mesh = object->mesh;
    gn_xform xform;
    if (object->flags & GN_OBJECT_HIDDEN) return GN_OK;
    gn_xform_compose(&xform, cam->axis_q30, cam->eye_q16, object);
    for (uint32_t t = 0; t < mesh->n_triangles; t++) {
        int32_t v[3][3];
        for (uint32_t i = 0; i < 3; i++) {
            uint32_t vertex_idx = mesh->idx[3 * (size_t)t + i];
            if (vertex_idx >= mesh->n_vertices) return gn_fail(frame, GN_ERR_MESH_INDEX, object_idx);
            if (!gn_setup_vertex(v[i], cache, &xform, mesh, object_idx, vertex_idx))
                return gn_fail(frame, GN_ERR_VERTEX_RANGE, object_idx);
        }
        const int32_t *const corners[3] = {v[0], v[1], v[2]};
        setup_triangle(frame, corners, object_idx, t);
    }
    return GN_OK;
}

gn_status gn_setup_triangles(gn_frame *frame, gn_vcache_entry *cache)
{
    frame->stats.n_triangles = 0;
    frame->stats.n_clipped = 0;
    for (uint32_t i = 0; i < GN_VERTEX_CACHE; i++) cache[i].tag = 0;
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        gn_status status = setup_object(frame, cache, i);
        if (status) return status;
    }
    if (frame->stats.n_triangles > GN_MAX_TRIANGLES)
        return gn_fail_capacity(frame, GN_ERR_TRIANGLES_FULL, frame->stats.n_triangles, GN_MAX_TRIANGLES);
    return GN_OK;
}
