/* Shadow tiles. Depth is counted in steps of T * 2^J / 65536 texels, with 16 more fraction bits while interpolating. */
#include "gn_atlas.h"
#include "gn_blocks.h"
#include "gn_cascade.h"
#include "gn_math.h"
#include "gn_q.h"
#include "gn_scene.h"
#include "gn_walk.h"
#include "gn_xform.h"

#if GN_SHADOWS

#define GN_TILE_REACH_Q16 ((int64_t)16384 << 16) /* casters are cut at this distance in texels: keeps gn_walk in range */
#define GN_GRADIENT_MAX   ((int64_t)1 << 33)     /* twice the whole depth range per texel */

typedef struct {
    int64_t c[3]; /* U, V, D in texels, Q16 */
} light_point;

#define GN_LIGHT_POLYGON_MAX 8 /* a triangle against four sides has 7; rounding may bend it once more */

typedef struct {
    light_point p[GN_LIGHT_POLYGON_MAX];
    int n;
} light_polygon;

/* What is constant over one caster triangle, in depth steps with 16 fraction bits. */
typedef struct {
    int64_t dz_du, dz_dv;
    int64_t bias;
    int64_t lo, hi; /* depth range of the triangle, pancaked */
} caster_depth;

/* Object space to tile coordinates: as gn_xform_compose, with 1 / texel folded into the matrix. */
static void compose(gn_xform *out, const gn_light_view *view, const gn_object *object)
{
    const int32_t nowhere[3] = {0, 0, 0};
    gn_xform_compose(out, view->axis_q30, nowhere, object);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) out->m[r][c] = (int32_t)gn_shr64((int64_t)out->m[r][c] * (int64_t)view->inv_texel.mant, 32);
        out->t_q16[r] = gn_light_coord_q16(view, r, object->to_world.t_q16) - (int64_t)view->origin[r] * 65536;
    }
    out->shift -= view->inv_texel.exp + 32;
}

static void transform(light_point *out, const gn_xform *xform, const gn_mesh *mesh, uint32_t vertex_idx)
{
    const int32_t *p = mesh->pos + 3 * (size_t)vertex_idx;
    for (int r = 0; r < 3; r++) {
        /* both terms below 2^60 */
        const int64_t limit = (int64_t)1 << 60;
        int64_t v = gn_clamp64(gn_scale64(gn_dot64(xform->m[r], p), xform->shift), -limit, limit) + xform->t_q16[r];
        out->c[r] = gn_clamp64(v, -((int64_t)1 << 46), (int64_t)1 << 46);
    }
}

/* Cuts at sign * c[axis] <= reach. */
static void clip_side(light_polygon *polygon, int axis, int64_t sign)
{
    light_polygon in = *polygon;
    polygon->n = 0;
    for (int i = 0; i < in.n; i++) {
        const light_point *a = &in.p[i], *b = &in.p[(i + 1) % in.n];
        int64_t da = GN_TILE_REACH_Q16 - sign * a->c[axis], db = GN_TILE_REACH_Q16 - sign * b->c[axis];
        if (da >= 0 && polygon->n < GN_LIGHT_POLYGON_MAX) polygon->p[polygon->n++] = *a;
        if ((da >= 0) == (db >= 0) || polygon->n >= GN_LIGHT_POLYGON_MAX) continue;
        if (da < 0) { /* from the inside end, for the sake of shared edges */
            const light_point *swap = a;
            a = b;
            b = swap;
            int64_t d = da;
            da = db;
            db = d;
        }
        gn_bfloat t = gn_bf_recip(gn_bf_from_u64((uint64_t)(da - db)));
        light_point *cut = &polygon->p[polygon->n++];
        for (int k = 0; k < 3; k++) {
            int64_t step = gn_bf_apply(gn_bf_apply(da, t, 31), gn_bf_from_u64(gn_abs64(b->c[k] - a->c[k]) | 1U), -31);
            cut->c[k] = a->c[k] + (b->c[k] < a->c[k] ? -step : step);
        }
    }
}

static void clip_to_reach(light_polygon *polygon)
{
    for (int axis = 0; axis < 2; axis++) {
        int64_t lo = 0, hi = 0;
        for (int i = 0; i < polygon->n; i++) {
            lo = polygon->p[i].c[axis] < lo ? polygon->p[i].c[axis] : lo;
            hi = polygon->p[i].c[axis] > hi ? polygon->p[i].c[axis] : hi;
        }
        if (hi > GN_TILE_REACH_Q16) clip_side(polygon, axis, 1);
        if (lo < -GN_TILE_REACH_Q16) clip_side(polygon, axis, -1);
    }
}

/* Plane, bias (B1) and range of a triangle from its unsnapped vertices. Returns 0 if it cannot be seen from the light. */
static int caster_begin(caster_depth *out, const gn_light_view *view, const light_point p[3], int two_sided)
{
    int64_t e1[3], e2[3], n[3];
    int32_t e1n[3], e2n[3], nn[3];
    for (int i = 0; i < 3; i++) {
        e1[i] = p[1].c[i] - p[0].c[i];
        e2[i] = p[2].c[i] - p[0].c[i];
    }
    gn_norm_vec(e1n, e1);
    gn_norm_vec(e2n, e2);
    gn_cross64(n, e1n, e2n);
    gn_norm_vec(nn, n);
    if (nn[2] == 0 || (nn[2] > 0 && !two_sided)) return 0; /* along w: away from the light */
    int32_t to_steps = 16 - view->tile_log2 - view->depth_log2;
    gn_bfloat per_n = gn_bf_recip(gn_bf_from_u64(gn_abs32(nn[2])));
    int64_t flip = nn[2] < 0 ? 1 : -1;
    int64_t du = gn_bf_apply(flip * nn[0], per_n, 16), dv = gn_bf_apply(flip * nn[1], per_n, 16); /* texels per texel, Q16 */
    int64_t steepest = gn_clamp64((int64_t)(gn_abs64(du) > gn_abs64(dv) ? gn_abs64(du) : gn_abs64(dv)), 0, (int64_t)1 << 31);
    int64_t bias = view->bias_constant_q16 + gn_shr64(steepest * view->bias_slope_q16, 16); /* 2^31 * 2^22 */
    out->bias = gn_scale64(bias, -to_steps);
    out->dz_du = gn_clamp64(gn_bf_apply(flip * nn[0], per_n, 16 + to_steps), -GN_GRADIENT_MAX, GN_GRADIENT_MAX);
    out->dz_dv = gn_clamp64(gn_bf_apply(flip * nn[1], per_n, 16 + to_steps), -GN_GRADIENT_MAX, GN_GRADIENT_MAX);
    int64_t lo = p[0].c[2], hi = lo;
    for (int i = 1; i < 3; i++) {
        lo = p[i].c[2] < lo ? p[i].c[2] : lo;
        hi = p[i].c[2] > hi ? p[i].c[2] : hi;
    }
    const int64_t far = (int64_t)1 << 32;
    out->lo = gn_clamp64(gn_scale64(lo, -to_steps), 0, far); /* D9: pancaking */
    out->hi = gn_clamp64(gn_scale64(hi, -to_steps), 0, far);
    return out->lo < far;
}

static void store(uint16_t *texel, int64_t z)
{
    int64_t stored = gn_clamp64((z + 0x8000) >> 16, 0, GN_ATLAS_EMPTY);
    if ((uint16_t)stored < *texel) *texel = (uint16_t)stored;
}

static void span(uint16_t *texel, int32_t n, int64_t z, const caster_depth *depth)
{
    int64_t last = z + (n - 1) * depth->dz_du;
    int64_t least = z < last ? z : last, most = z < last ? last : z;
    if (least >= depth->lo && most <= depth->hi && most + depth->bias + 0x8000 <= (int64_t)UINT32_MAX) {
        uint32_t v = (uint32_t)(z + depth->bias + 0x8000), dv = (uint32_t)depth->dz_du;
        for (int32_t i = 0; i < n; i++) {
            if ((uint16_t)(v >> 16) < texel[i]) texel[i] = (uint16_t)(v >> 16);
            v += dv;
        }
        return;
    }
    for (int32_t i = 0; i < n; i++) {
        store(&texel[i], gn_clamp64(z, depth->lo, depth->hi) + depth->bias);
        z += depth->dz_du;
    }
}

/* Depth at the centre of texel (u, v) from the plane through one vertex; within the vertices' box, so below 2^45. */
static int64_t depth_at(const gn_light_view *view, const caster_depth *depth, const light_point *anchor, int32_t u, int32_t v)
{
    int64_t du_q16 = u * 65536 + 32768 - anchor->c[0], dv_q16 = v * 65536 + 32768 - anchor->c[1]; /* < 2^31 */
    int64_t z = gn_scale64(anchor->c[2], view->tile_log2 + view->depth_log2 - 16);
    /* gradient <= 2^33 times 2^31 would not fit: split the offset into whole texels and a fraction */
    z += depth->dz_du * (du_q16 >> 16) + gn_shr64(depth->dz_du * (du_q16 & 65535), 16);
    return z + depth->dz_dv * (dv_q16 >> 16) + gn_shr64(depth->dz_dv * (dv_q16 & 65535), 16);
}

static void draw_triangle(const gn_frame *frame, const gn_light_view *view, const caster_depth *depth,
                          const light_point *const p[3])
{
    int32_t bits = GN_K(frame, shadow_subpixel_bits), size = view->tile_texels;
    int32_t x[3], y[3];
    for (int i = 0; i < 3; i++) {
        x[i] = (int32_t)gn_shr64(p[i]->c[0], 16 - bits); /* 2^14 texels * 2^12 */
        y[i] = (int32_t)gn_shr64(p[i]->c[1], 16 - bits);
    }
    gn_walk walk;
    if (!gn_walk_begin(&walk, x, y, bits, 0, size)) return;
    int32_t u_begin, u_end, v;
    while (gn_walk_row(&walk, &v, &u_begin, &u_end)) {
        u_begin = gn_max32(u_begin, 0);
        u_end = gn_min32(u_end, size);
        if (u_begin >= u_end) continue;
        span(view->depth + v * size + u_begin, u_end - u_begin, depth_at(view, depth, p[0], u_begin, v), depth);
    }
}

static int misses_tile(const gn_light_view *view, const light_point p[3])
{
    int64_t end = (int64_t)view->tile_texels << 16;
    for (int axis = 0; axis < 2; axis++) {
        if (p[0].c[axis] < 0 && p[1].c[axis] < 0 && p[2].c[axis] < 0) return 1;
        if (p[0].c[axis] > end && p[1].c[axis] > end && p[2].c[axis] > end) return 1;
    }
    return 0;
}

static void caster_triangle(gn_frame *frame, const gn_light_view *view, const light_point p[3], int two_sided)
{
    caster_depth depth;
    if (misses_tile(view, p) || !caster_begin(&depth, view, p, two_sided)) return;
    light_polygon polygon = {{p[0], p[1], p[2]}, 3};
    clip_to_reach(&polygon);
    for (int i = 1; i + 1 < polygon.n; i++) {
        const light_point *corners[3] = {&polygon.p[0], &polygon.p[i], &polygon.p[i + 1]};
        draw_triangle(frame, view, &depth, corners);
    }
    frame->stats.n_caster_triangles++;
}

gn_status gn_atlas_render_tile(gn_frame *frame, gn_light_view *view)
{
    size_t n_texels = (size_t)view->tile_texels * view->tile_texels;
    for (size_t i = 0; i < n_texels; i++) view->depth[i] = GN_ATLAS_EMPTY;
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) {
        const gn_object *object = &frame->scene->objects[o];
        if (!(object->flags & GN_OBJECT_CASTS)) continue;
        gn_xform xform;
        compose(&xform, view, object);
        const gn_mesh *mesh = object->mesh;
        for (uint32_t t = 0; t < mesh->n_triangles; t++) {
            light_point p[3];
            for (uint32_t i = 0; i < 3; i++) {
                uint32_t vertex_idx = mesh->idx[3 * (size_t)t + i];
                if (vertex_idx >= mesh->n_vertices) return gn_fail(frame, GN_ERR_MESH_INDEX, o);
                if (!gn_xform_position_ok(mesh, vertex_idx)) return gn_fail(frame, GN_ERR_VERTEX_RANGE, o);
                transform(&p[i], &xform, mesh, vertex_idx);
            }
            caster_triangle(frame, view, p, (object->flags & GN_OBJECT_TWO_SIDED) != 0);
        }
    }
#if GN_DEPTH_BLOCKS
    gn_blocks_build(view);
#endif
    return GN_OK;
}

#endif
