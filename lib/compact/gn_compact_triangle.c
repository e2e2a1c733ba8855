/* Compact arithmetic: triangles into screen tiles and into the shadow tile. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "compact/gn_compact.h"
#include "scene/gn_scene.h"
#include "visible/gn_cell.h"

#define ONE_PX    (1 << GN_COMPACT_BITS)
#define STEEP_MAX ((int64_t)1 << 36) /* change of key per pixel, Q8: beyond, a triangle has one key */

/* ---- Setup ------------------------------------------------------------------------------------------------------- */

/* First pixel whose centre is at or after a coordinate. */
static int32_t first_px(int32_t at)
{
    return (at + ONE_PX / 2 - 1) >> GN_COMPACT_BITS;
}

/* Pixels along an axis: 0 x, 1 y. */
static void bound(gn_tri *tri, int axis, const int32_t at[3], int32_t size)
{
    tri->begin[axis] = (int16_t)gn_max32(first_px(gn_min32(gn_min32(at[0], at[1]), at[2])), 0);
    tri->end[axis] = (int16_t)gn_min32(first_px(gn_max32(gn_max32(at[0], at[1]), at[2])), size);
}

/* n * 2^16 / area: per pixel, Q8; |n| < 2^50.5 */
static int64_t compact_gradient(int64_t n, uint64_t area, int32_t clz)
{
    uint32_t recip = gn_recip_norm((uint32_t)(area << clz >> 32), 2); /* 2^(95 - clz) / area */
    n = gn_shl64(n, 12);
    n = (n >> 32) * (int64_t)recip + (int64_t)(((uint64_t)(uint32_t)n * recip) >> 32);
    return n >> (59 - clz);
}

/* The key's plane. */
static void plane(gn_tri *tri, const gn_compact_corner c[3], uint64_t area)
{
    const int32_t *x = tri->x, *y = tri->y;
    int32_t clz = gn_clz64(area), ka = c[0].key, kb = c[1].key - ka, kc = c[2].key - ka;
    int64_t dx = STEEP_MAX, dy = 0;
    if (clz <= 59) { /* less than that is a few subpixels */
        dx = compact_gradient((int64_t)kc * (y[1] - y[0]) - (int64_t)kb * (y[2] - y[0]), area, clz);
        dy = compact_gradient((int64_t)kb * (x[2] - x[0]) - (int64_t)kc * (x[1] - x[0]), area, clz);
    }
    if (dx >= STEEP_MAX || dx <= -STEEP_MAX || dy >= STEEP_MAX || dy <= -STEEP_MAX) {
        dx = dy = 0;
        ka = gn_max32(gn_max32(ka, c[1].key), c[2].key);
    }
    /* to the first pixel's centre: 2^36 * 2^19.5 */
    int64_t step =
        dx * (tri->begin[0] * ONE_PX + ONE_PX / 2 - x[0]) + dy * (tri->begin[1] * ONE_PX + ONE_PX / 2 - y[0]);
    tri->key = (uint32_t)ka + (uint32_t)(step >> (8 + GN_COMPACT_BITS));
    tri->frac_bits = 8;
    if (((uint64_t)(dx + (1 << 30)) | (uint64_t)(dy + (1 << 30))) >> 31) { /* rounding must fit, too */
        tri->frac_bits = 0;
        dx = (dx + 128) >> 8;
        dy = (dy + 128) >> 8;
    }
    tri->key_dx = (int32_t)dx;
    tri->key_dy = (int32_t)dy;
}

/* Returns 0 if the triangle faces away or covers no pixel. */
static int setup(gn_tri *tri, gn_compact_corner c[3], const gn_compact_view *view, uint32_t sides)
{
    for (int i = 0; i < 3; i++) {
        tri->x[i] = (c[i].at_q16[0] + 128) >> (16 - GN_COMPACT_BITS);
        tri->y[i] = (c[i].at_q16[1] + 128) >> (16 - GN_COMPACT_BITS);
    }
    int32_t *x = tri->x, *y = tri->y;
    int64_t area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    if (!area || !(sides & (area > 0 ? GN_SIDE_CW : GN_SIDE_CCW))) return 0;
    if (area > 0) {
        gn_compact_corner swap = c[1];
        int32_t sx = x[1], sy = y[1];
        c[1] = c[2], x[1] = x[2], y[1] = y[2];
        c[2] = swap, x[2] = sx, y[2] = sy;
        area = -area;
    }
    bound(tri, 0, x, view->size[0]);
    bound(tri, 1, y, view->size[1]);
    if (tri->begin[0] >= tri->end[0] || tri->begin[1] >= tri->end[1]) return 0;
    plane(tri, c, (uint64_t)-area);
    return 1;
}

/* ---- Objects ----------------------------------------------------------------------------------------------------- */

/* Towards the viewer, in the light's axes; zero where the corners lie in a line. */
static void compact_face_normal(int16_t out_q14[3], const gn_frame *frame, int32_t (*v)[3])
{
    int32_t a[3], b[3], n[3];
    int64_t normal[3];
    for (int i = 0; i < 3; i++) {
        a[i] = v[1][i] - v[0][i];
        b[i] = v[2][i] - v[0][i];
        out_q14[i] = 0;
    }
    gn_cross64(normal, a, b); /* 2^61 */
    if (!gn_compact_unit(n, normal)) return;
    int64_t seen = gn_dot64(n, v[0]); /* from the eye, which is at 0: 2^60 */
    n[1] = -n[1];                     /* the camera's own axes: up, back */
    n[2] = -n[2];
    for (int i = 0; i < 3; i++) {
        int16_t q14 = (int16_t)(gn_dot64(frame->to_light.m_q28[i], n) >> 44);
        out_q14[i] = seen < 0 ? q14 : (int16_t)-q14;
    }
}

/* Constant and slope bias of casters, in steps of keys. [B1] */
static int32_t caster_bias(const gn_tri *tri, const gn_light *light)
{
    uint32_t dx = gn_abs32(tri->key_dx) >> tri->frac_bits, dy = gn_abs32(tri->key_dy) >> tri->frac_bits;
    uint64_t slope = ((uint64_t)(dx > dy ? dx : dy) * (uint32_t)light->bias_slope_q16) >> 16; /* 2^28 * 2^22 */
    slope += (uint32_t)light->bias_constant_q16 << 2;
    return slope < 1U << 29 ? (int32_t)slope : 1 << 29;
}

/* Corners along the projector's axes. */
static gn_status fetch(gn_compact_job *job, const gn_mesh *mesh, const uint16_t *idx)
{
    for (int i = 0; i < 3; i++) {
        if (idx[i] >= mesh->n_vertices) return GN_ERR_MESH_INDEX;
        const gn_position *at = mesh->pos + 3 * (uint32_t)idx[i];
        const int32_t p[3] = {at[0], at[1], at[2]};
        if (!gn_compact_transform(job->polygon.v_q16[i], &job->xform, p)) return GN_ERR_VERTEX_RANGE;
    }
    return GN_OK;
}

/* Draws job->corner, or without a raster keeps it. */
static void emit(gn_frame *frame, gn_compact_job *job, const gn_compact_view *view, gn_compact_raster *raster,
                 uint32_t object_idx)
{
    gn_tri *tri = &job->tri;
    if (!raster && frame->stats.n_triangles < GN_MAX_TRIANGLES) tri = &frame->records.tri[frame->stats.n_triangles];
    if (!setup(tri, job->corner, view, gn_sides_of(frame->flags[object_idx], view->two_sided))) return;
    if (raster) {
        raster->bias = caster_bias(tri, frame->scene->lights);
        frame->stats.n_caster_triangles++;
        gn_compact_draw(raster, tri);
    } else {
        tri->object_idx = (uint16_t)object_idx;
        for (int i = 0; i < 3; i++) tri->normal_q14[i] = job->normal_q14[i];
#if GN_RAW_VIEWS
        tri->triangle_idx = job->tri.triangle_idx;
#endif
        frame->stats.n_triangles++;
    }
}

static gn_status triangle(gn_frame *frame, gn_compact_job *job, const gn_compact_view *view, gn_compact_raster *raster,
                          uint32_t object_idx, const uint16_t *idx)
{
    gn_status status = fetch(job, frame->scene->objects[object_idx].mesh, idx);
    if (status) return status;
    if (!raster) compact_face_normal(job->normal_q14, frame, job->polygon.v_q16);
#if GN_RAW_VIEWS
    job->tri.triangle_idx = (uint16_t)((idx - frame->scene->objects[object_idx].mesh->idx) / 3);
#endif
    int n = gn_compact_clip(&job->polygon, &job->spare, 3, view);
    for (int i = 0; i < n; i++) { /* a fan */
        if (!gn_compact_project(&job->corner[gn_min32(i, 2)], view, job->polygon.v_q16[i])) return GN_ERR_VERTEX_RANGE;
        if (i < 2) continue;
        gn_compact_corner last = job->corner[2], first = job->corner[0];
        emit(frame, job, view, raster, object_idx);
        job->corner[0] = first; /* which may have been exchanged */
        job->corner[1] = last;
    }
    return GN_OK;
}

/* All objects that a projector sees: drawn, or without a raster kept. */
static gn_status objects(gn_frame *frame, gn_compact_job *job, const gn_compact_view *view, gn_compact_raster *raster)
{
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        const gn_object *object = &frame->scene->objects[i];
        if ((frame->flags[i] ^ view->flags) & view->mask) continue;
        if (!gn_compact_affine_ok(&object->to_world) ||
            !gn_compact_compose(&job->xform, view, &object->to_world, object->mesh->pos_frac_bits))
            return GN_FAIL_AT(frame, GN_ERR_OBJECT_TRANSFORM, i, GN_FIELD_OBJECT_TO_WORLD);
        for (uint32_t t = 0; t < object->mesh->n_triangles; t++) {
            gn_status status = triangle(frame, job, view, raster, i, object->mesh->idx + 3 * t);
            if (status) return GN_FAIL_AT(frame, status, i, GN_MESH_FIELD(status));
        }
    }
    return GN_OK;
}

gn_status gn_setup_triangles(gn_frame *frame, gn_scratch *scratch)
{
    frame->stats.n_triangles = 0;
    gn_status status = objects(frame, &scratch->work.clipping, &frame->cam, NULL);
    if (!status && frame->stats.n_triangles > GN_MAX_TRIANGLES)
        return gn_fail_capacity(frame, GN_ERR_TRIANGLES_FULL, frame->stats.n_triangles, GN_MAX_TRIANGLES);
    return status;
}

gn_status gn_atlas_render_tile(gn_frame *frame, gn_casting *casting, uint32_t view_idx, uint32_t *memory,
                               uint32_t n_words)
{
    (void)memory, (void)n_words;
    const gn_light_view *view = &frame->view[view_idx];
    gn_compact_raster raster = {
        frame, {0, 0, GN_K(frame, atlas_size), GN_K(frame, atlas_size)}, NULL, frame->atlas, 0, 0, 0};
    memset(frame->atlas, 0xFF, sizeof frame->atlas);
    return objects(frame, casting, &view->project, &raster);
}

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

/* Where an edge's pixels begin to lie inside: f >= 0, by the top-left rule; its steps are those of a pixel. */
typedef struct {
    int32_t f, dx, dy;
} edge;

static void compact_edge_begin(edge *e, const gn_tri *tri, int i, int32_t px, int32_t py)
{
    int j = i == 2 ? 0 : i + 1;
    int32_t dx = tri->x[j] - tri->x[i], dy = tri->y[j] - tri->y[i], left_or_top = dy > 0 || (dy == 0 && dx < 0);
    /* corners and pixels are in a box of 2880 pixels: below 2^39. A pixel's step is a multiple of 2^8, so that nothing
     * is lost */
    int64_t f =
        (int64_t)(px * ONE_PX + ONE_PX / 2 - tri->x[i]) * dy - (int64_t)(py * ONE_PX + ONE_PX / 2 - tri->y[i]) * dx;
    e->f = (int32_t)((f - !left_or_top) >> GN_COMPACT_BITS);
    e->dx = dy;
    e->dy = -dx;
}

void gn_compact_draw(const gn_compact_raster *raster, const gn_tri *tri)
{
    const gn_rect *rect = &raster->rect;
    int32_t x0 = gn_max32(tri->begin[0], rect->x0), x1 = gn_min32(tri->end[0], rect->x1);
    int32_t y0 = gn_max32(tri->begin[1], rect->y0), y1 = gn_min32(tri->end[1], rect->y1);
    if (x0 >= x1) return;
    /* whole steps, so that the key does not depend on where the rectangle begins */
    int32_t half = (1 << tri->frac_bits) >> 1, key_dx = (tri->key_dx + half) >> tri->frac_bits,
            key_dy = (tri->key_dy + half) >> tri->frac_bits;
    uint32_t row = tri->key + (uint32_t)(x0 - tri->begin[0]) * (uint32_t)key_dx +
                   (uint32_t)(y0 - tri->begin[1]) * (uint32_t)key_dy;
    edge e[3];
    for (int i = 0; i < 3; i++) compact_edge_begin(&e[i], tri, i, x0, y0);
    for (; y0 < y1; y0++) {
        int32_t f0 = e[0].f, f1 = e[1].f, f2 = e[2].f;
        uint32_t key = row;
        int32_t at = (y0 - rect->y0) * (rect->x1 - rect->x0) + x0 - rect->x0;
        for (int32_t n = x1 - x0; n > 0; n--, at++) {
            if ((f0 | f1 | f2) >= 0) {
                if (raster->cell) {
                    uint32_t cell =
                        ((uint32_t)gn_max32((int32_t)key, 0) << 1 >> raster->id_bits << raster->id_bits) + raster->id;
                    if (cell > raster->cell[at]) raster->cell[at] = cell;
                } else { /* pancaking [D9]; what lies beyond the range stays out */
                    uint32_t depth =
                        (uint32_t)(gn_max32(-(int32_t)key, 0) + raster->bias) >> GN_COMPACT_STEP_SHIFT(raster->frame);
                    if (depth < raster->texel[at]) raster->texel[at] = (uint16_t)depth;
                }
            }
            f0 += e[0].dx, f1 += e[1].dx, f2 += e[2].dx;
            key += (uint32_t)key_dx;
        }
        for (int i = 0; i < 3; i++) e[i].f += e[i].dy;
        row += (uint32_t)key_dy;
    }
}

void gn_raster_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx)
{
    gn_compact_raster raster = {frame, gn_screen_rect(frame, tile_idx), scratch->cell, NULL, 0, frame->id_bits, 0};
    memset(scratch->cell, 0, sizeof scratch->cell);
    for (uint32_t i = 0; i < frame->stats.n_triangles; i++) {
        raster.id = gn_cell_id(frame, i);
        gn_compact_draw(&raster, &frame->records.tri[i]);
    }
}

gn_status gn_bin_triangles(gn_frame *frame) /* each screen tile looks at all of them */
{
    (void)frame;
    return GN_OK;
}

/* ---- Compact arithmetic ------------------------------------------------------------------------------------------ */

/* Polygons cut to what can be projected. */

/* Distance of a point to the inside of a side of the guard band, 0 .. 3, or beyond the near plane: below 2^42. */
static int64_t inside(const gn_compact_view *view, const int32_t v_q16[3], int plane)
{
    if (plane >= 4) return (int64_t)v_q16[2] - view->near_q16;
    int64_t side = v_q16[plane >> 1], reach = view->near_norm ? (int64_t)v_q16[2] * view->guard : view->guard;
    return plane & 1 ? reach - side : reach + side;
}

/* Where an edge from a point inside to one outside is cut: t = a / (a - b), Q31. */
static void compact_cut(int32_t out[3], const int32_t from[3], const int32_t to[3], int64_t a, int64_t b)
{
    uint64_t whole = (uint64_t)(a - b);
    int32_t clz = gn_clz64(whole);
    int64_t t =
        gn_compact_mul((uint32_t)((uint64_t)a << clz >> 32), gn_recip_norm((uint32_t)(whole << clz >> 32), 2), 0);
    for (int i = 0; i < 3; i++) out[i] = from[i] + (int32_t)(((to[i] - from[i]) * t) >> 31); /* 2^30 * 2^31 */
}

static int compact_clip_plane(int32_t (*out)[3], int32_t (*in)[3], int n, const gn_compact_view *view, int plane)
{
    int n_out = 0;
    for (int i = 0; i < n; i++) {
        const int32_t *p = in[i], *q = in[i + 1 == n ? 0 : i + 1];
        int64_t a = inside(view, p, plane), b = inside(view, q, plane);
        if (a >= 0) {
            for (int k = 0; k < 3; k++) out[n_out][k] = p[k];
            n_out++;
        }
        if (a >= 0 && b < 0) compact_cut(out[n_out++], p, q, a, b);
        if (a < 0 && b >= 0) compact_cut(out[n_out++], q, p, b, a); /* the same point as cut from the other side */
    }
    return n_out;
}

int gn_compact_clip(gn_compact_polygon *polygon, gn_compact_polygon *spare, int n, const gn_compact_view *view)
{
    /* to and fro an even number of times: the near plane counts twice */
    for (int plane = view->near_norm ? 5 : 3; plane >= 0; plane -= 2) {
        n = compact_clip_plane(spare->v_q16, polygon->v_q16, n, view, plane);
        n = compact_clip_plane(polygon->v_q16, spare->v_q16, n, view, plane - 1);
    }
    return n;
}

/* ---- Compact arithmetic ------------------------------------------------------------------------------------------ */

/* Points, from an object's space to a raster. */

int gn_compact_unit(int32_t out_q30[3], const int64_t a[3])
{
    uint64_t any = 0, sum = 0;
    for (int i = 0; i < 3; i++) any |= (uint64_t)(a[i] ^ a[i] >> 63);
    int32_t s = gn_clz64(any | 1) - 2; /* all ones shorter than the magnitude, at most */
    for (int i = 0; i < 3; i++) {
        out_q30[i] = (int32_t)(gn_shl64(a[i], s) >> 32); /* |.| <= 2^30 */
        sum += (uint64_t)((int64_t)out_q30[i] * out_q30[i]);
    }
    uint32_t length = gn_isqrt64(sum); /* 2^29 .. 2^30.8 */
    if (!length) return 0;
    s = gn_clz32(length);
    int64_t recip = gn_recip_norm(length << s, 2); /* 2^63 / (length 2^s) */
    for (int i = 0; i < 3; i++) out_q30[i] = (int32_t)((out_q30[i] * recip) >> (33 - s));
    return 1;
}

uint32_t gn_compact_mul(uint32_t a, uint32_t b, int32_t shift)
{
    return (uint32_t)(((uint64_t)a * b) >> 32) >> shift;
}

/* |v| <= limit */
static int within(const int32_t *v, int n, uint32_t limit)
{
    for (int i = 0; i < n; i++)
        if (gn_abs32(v[i]) > limit) return 0;
    return 1;
}

int gn_compact_affine_ok(const gn_affine *a)
{
    return within(a->m_q30[0], 9, 1U << 30) && within(a->t_q16, 3, GN_COMPACT_LENGTH_Q16 / 2);
}

int gn_compact_compose(gn_compact_xform *out, const gn_compact_view *view, const gn_affine *affine, int32_t frac_bits)
{
    int fits = 1;
    /* matrix and axis entries are at most 2^30: sums below 2^62; differences of positions at most 2^30.4 */
    for (int r = 0; r < 3; r++) {
        const int32_t *axis = view->axis_q30[r];
        int64_t t = 0;
        for (int c = 0; c < 3; c++) {
            int64_t m = 0;
            for (int k = 0; k < 3; k++) m += (int64_t)axis[k] * affine->m_q30[k][c];
            out->m_q28[r][c] = (int32_t)(m >> 32); /* 3 * 2^28 */
            t += (int64_t)axis[c] * (affine->t_q16[c] - view->eye_q16[c]);
        }
        out->t_q16[r] = (int32_t)(t >> 30);
        fits &= out->t_q16[r] == t >> 30;
    }
    out->shift = (int32_t)(12U - (uint32_t)affine->exp + (uint32_t)frac_bits);
    return fits && (uint32_t)out->shift <= 42;
}

int gn_compact_transform(int32_t out_q16[3], const gn_compact_xform *xform, const int32_t p[3])
{
    uint32_t beyond = 0;
    for (int r = 0; r < 3; r++) {
        const int32_t *m = xform->m_q28[r];
        /* three times 2^31 * 3 * 2^28: below 2^63 */
        int64_t v =
            (((int64_t)m[0] * p[0] + (int64_t)m[1] * p[1] + (int64_t)m[2] * p[2]) >> xform->shift) + xform->t_q16[r];
        beyond |= (uint32_t)((uint64_t)(v + GN_COMPACT_LENGTH_Q16) >> 30);
        beyond |= (uint32_t)((uint64_t)v >> 32) ^ (uint32_t)((int32_t)v >> 31);
        out_q16[r] = (int32_t)v;
    }
    return !beyond;
}

/* v * scale >> shift, at most GN_COMPACT_REACH_Q16 in magnitude. */
static int32_t compact_scaled(int32_t v, uint32_t scale, int32_t shift)
{
    int64_t r = ((int64_t)v * (int64_t)scale) >> shift; /* 2^30 * 2^32 */
    return r > GN_COMPACT_REACH_Q16    ? GN_COMPACT_REACH_Q16
           : r < -GN_COMPACT_REACH_Q16 ? -GN_COMPACT_REACH_Q16
                                       : (int32_t)r;
}

int gn_compact_project(gn_compact_corner *corner, const gn_compact_view *view, const int32_t v_q16[3])
{
    uint32_t scale = view->scale;
    int32_t shift = view->shift, depth_q16 = 0;
    if (view->near_norm) {
        uint32_t z = (uint32_t)gn_max32(v_q16[2], view->near_q16); /* a cut may be a rounding nearer */
        int32_t clz = gn_clz32(z);
        uint32_t recip = gn_recip_norm(z << clz, 2);
        /* near / Z = near_norm * recip * 2^(clz - near_clz - 63) */
        corner->key = (int32_t)gn_compact_mul(view->near_norm, recip, view->near_clz - clz + 1);
        scale = gn_compact_mul(scale, recip, 0); /* F / Z = scale * 2^(clz - shift - 32 - 16) */
        shift += 32 - clz;
    } else {
        depth_q16 = compact_scaled(v_q16[2], scale, shift);
        corner->key = -depth_q16 * 4;
    }
    for (int k = 0; k < 2; k++) corner->at_q16[k] = compact_scaled(v_q16[k], scale, shift) + (view->size[k] << 15);
    return gn_abs32(depth_q16) < GN_COMPACT_REACH_Q16;
}
