/* Casters as orthographic light views see them. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_walk.h"
#include "geometry/gn_xform.h"
#include "scene/gn_scene.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_views.h"

#define GN_TILE_REACH_Q16                                                                                              \
    ((int64_t)16384 << 16) /* casters are cut at this distance in texels: keeps gn_walk in range */

/* Object space to tile coordinates: as gn_xform_compose, with 1 / texel folded into the matrix. */
void gn_ortho_compose(gn_xform *out, const gn_light_view *view, const gn_object *object)
{
    const int32_t nowhere[3] = {0, 0, 0};
    gn_xform_compose(out, view->axis_q30, nowhere, object);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++)
            out->m[r][c] = (int32_t)gn_shr64((int64_t)out->m[r][c] * (int64_t)view->fit.ortho.inv_texel.mant, 32);
        out->t_q16[r] =
            gn_light_coord_q16(view, r, object->to_world.t_q16) - (int64_t)view->fit.ortho.origin[r] * 65536;
    }
    out->shift -= view->fit.ortho.inv_texel.exp + 32;
}

void gn_ortho_point(int64_t out[3], const gn_xform *xform, const int32_t p[3])
{
    for (int r = 0; r < 3; r++) {
        /* both terms below 2^60 */
        const int64_t limit = (int64_t)1 << 60;
        int64_t v = gn_clamp64(gn_scale64(gn_dot64(xform->m[r], p), xform->shift), -limit, limit) + xform->t_q16[r];
        out[r] = gn_clamp64(v, -((int64_t)1 << 46), (int64_t)1 << 46);
    }
}

/* Cuts at sign * c[axis] <= `reach`, the cut distance. */
GN_COLD static GN_NOINLINE void clip_side(gn_light_polygon *polygon, gn_light_polygon *in, int axis, int64_t sign)
{
    *in = *polygon;
    polygon->n = 0;
    for (int i = 0; i < in->n; i++) {
        const int64_t *a = in->p[i], *b = in->p[(i + 1) % in->n];
        int64_t da = GN_TILE_REACH_Q16 - sign * a[axis], db = GN_TILE_REACH_Q16 - sign * b[axis];
        if (da >= 0 && polygon->n < GN_ORTHO_POLYGON_MAX) memcpy(polygon->p[polygon->n++], a, sizeof in->p[0]);
        if ((da >= 0) == (db >= 0) || polygon->n >= GN_ORTHO_POLYGON_MAX) continue;
        if (da < 0) { /* from the inside end, for the sake of shared edges */
            const int64_t *swap = a;
            a = b;
            b = swap;
            int64_t d = da;
            da = db;
            db = d;
        }
        gn_bfloat t = gn_bf_recip(gn_bf_from_u64((uint64_t)(da - db)));
        int64_t *cut = polygon->p[polygon->n++];
        for (int k = 0; k < 3; k++) {
            int64_t step = gn_bf_apply(gn_bf_apply(da, t, 31), gn_bf_from_u64(gn_abs64(b[k] - a[k]) | 1U), -31);
            cut[k] = a[k] + (b[k] < a[k] ? -step : step);
        }
    }
}

static void clip_to_reach(gn_light_polygon *polygon, gn_light_polygon *uncut)
{
    for (int axis = 0; axis < 2; axis++) {
        int64_t lo = 0, hi = 0;
        for (int i = 0; i < polygon->n; i++) {
            lo = polygon->p[i][axis] < lo ? polygon->p[i][axis] : lo;
            hi = polygon->p[i][axis] > hi ? polygon->p[i][axis] : hi;
        }
        if (hi > GN_TILE_REACH_Q16) clip_side(polygon, uncut, axis, 1);
        if (lo < -GN_TILE_REACH_Q16) clip_side(polygon, uncut, axis, -1);
    }
}
static int within_reach(int64_t p[3][3])
{
    for (int i = 0; i < 3; i++)
        if (gn_abs64(p[i][0]) > GN_TILE_REACH_Q16 || gn_abs64(p[i][1]) > GN_TILE_REACH_Q16) return 0;
    return 1;
}

/* Texels along w, Q16, as a fraction of the depth range, Q32. |.| < 2^49 */
static inline int64_t depth_q32(const gn_light_view *view, int64_t texels_q16)
{
    int32_t up = 16 - view->tile_log2 - view->depth_log2; /* at most 13 */
    return up >= 0 ? gn_shl64(texels_q16, up) : gn_shr64(texels_q16, -up);
}

/* Plane, bias [B1] and range of a triangle with this normal, whose depths are lo .. hi, texels. Returns 0 if the light
 * cannot see it. [P7] [D9] */
static GN_NOINLINE int ortho_caster(gn_caster *out, const gn_light_view *view, const int32_t nn[3], uint32_t sides,
                                    int64_t lo, int64_t hi)
{
    if (nn[2] == 0 || !(sides & (nn[2] > 0 ? GN_SIDE_CW : GN_SIDE_CCW))) return 0; /* along w: away from the light */
    int32_t to_steps = 16 - view->tile_log2 - view->depth_log2;
    gn_bfloat per_n = gn_bf_recip(gn_bf_from_u64(gn_abs32(nn[2])));
    int32_t nu = nn[2] < 0 ? nn[0] : -nn[0], nv = nn[2] < 0 ? nn[1] : -nn[1];
    int64_t bias = view->bias_constant_q16;
    if (view->bias_slope_q16) {
        const int64_t steepest =
            gn_clamp64(gn_bf_apply((int32_t)gn_max32((int32_t)gn_abs32(nu), (int32_t)gn_abs32(nv)), per_n, 16), 0,
                       (int64_t)1 << 31);                      /* texels per texel, Q16 */
        bias += gn_shr64(steepest * view->bias_slope_q16, 16); /* 2^31 * 2^22 */
    }
    out->bias = depth_q32(view, bias);
    out->dz_du = gn_clamp64(gn_bf_apply(nu, per_n, 16 + to_steps), -GN_CASTER_GRADIENT_MAX, GN_CASTER_GRADIENT_MAX);
    out->dz_dv = gn_clamp64(gn_bf_apply(nv, per_n, 16 + to_steps), -GN_CASTER_GRADIENT_MAX, GN_CASTER_GRADIENT_MAX);
    const int64_t far = (int64_t)1 << 32;
    out->lo = gn_clamp64(depth_q32(view, lo), 0, far); /* pancaking */
    out->hi = gn_clamp64(depth_q32(view, hi), 0, far);
    return out->lo < far;
}

/* Begins a caster with corners anywhere, by 64-bit differences. */
GN_COLD static GN_NOINLINE int wide_caster_begin(gn_caster *out, const gn_light_view *view, int64_t p[3][3],
                                                 uint32_t sides)
{
    int64_t e1[3], e2[3], n[3], lo = p[0][2], hi = lo;
    int32_t e1n[3], e2n[3], nn[3];
    for (int i = 0; i < 3; i++) {
        e1[i] = p[1][i] - p[0][i];
        e2[i] = p[2][i] - p[0][i];
        lo = p[i][2] < lo ? p[i][2] : lo;
        hi = p[i][2] > hi ? p[i][2] : hi;
    }
    gn_norm_vec(e1n, e1);
    gn_norm_vec(e2n, e2);
    gn_cross64(n, e1n, e2n);
    gn_norm_vec(nn, n);
    return ortho_caster(out, view, nn, sides, lo, hi);
}

/* Depth at the centre of texel (0, 0) from the plane through one vertex, which is within the cut distance: below 2^48.
 */
static int64_t depth_at_corner(const gn_light_view *view, const gn_caster *caster, int64_t u_q16, int64_t v_q16,
                               int64_t depth_q16)
{
    int64_t du_q16 = 32768 - u_q16, dv_q16 = 32768 - v_q16; /* <= 2^30 */
    int64_t z = depth_q32(view, depth_q16);
    /* gradient <= 2^33 times 2^31 would not fit: split the offset into whole texels and a fraction */
    z += caster->dz_du * (du_q16 >> 16) + gn_shr64(caster->dz_du * (du_q16 & 65535), 16);
    return z + caster->dz_dv * (dv_q16 >> 16) + gn_shr64(caster->dz_dv * (dv_q16 & 65535), 16);
}

static int misses_tile(const gn_light_view *view, int64_t p[3][3])
{
    for (int axis = 0; axis < 2; axis++) {
        int64_t end = (int64_t)(axis ? GN_TILE_ROWS(view) : view->tile_texels) << 16;
        if (p[0][axis] < 0 && p[1][axis] < 0 && p[2][axis] < 0) return 1;
        if (p[0][axis] > end && p[1][axis] > end && p[2][axis] > end) return 1;
    }
    return 0;
}

/* Parallel projection as a perspective one: all corners at the same depth, so that barycentrics are affine. */
static inline void alpha_plane(const gn_frame *frame, const gn_light_view *view, gn_alpha_cut *alpha, int64_t p[3][3])
{
    int32_t v[3][3], shift = 0;
    const int64_t centre[2] = {(int64_t)view->tile_texels << 15, (int64_t)GN_TILE_ROWS(view) << 15};
    uint64_t any = 0;
    for (int i = 0; i < 3; i++) any |= gn_abs64(p[i][0] - centre[0]) | gn_abs64(p[i][1] - centre[1]);
    while (any >> shift >= (uint64_t)1 << 29) shift++;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) v[i][k] = (int32_t)gn_scale64(p[i][k] - centre[k], shift);
        v[i][2] = (1 << 23) >> shift; /* shift <= 18 */
    }
    /* x / z = px / 2F: 2F = 256 half texels where z is 128 texels */
    gn_alpha_plane(alpha, frame, v, 1U << 24, view->tile_texels, 2);
}

/* ---- Small casters ----------------------------------------------------------------------------------------------- */

/* Sides below it, on the subpixel grid, have edge functions of 32 bits; texels of a box. */
#define GN_BOX_SIDE   (1 << 14)
#define GN_BOX_TEXELS 32

/* A caster in a box of texels u0 .. u1 - 1, v0 .. v1 - 1: its corners in the order of gn_tri on the subpixel grid, the
 * second and third from the first, the box' first centre from there, too. Depth is in shares of the range, Q30, that of
 * the second and third from the first. */
typedef struct {
    int32_t x, y, ax, ay, bx, by;
    int32_t u0, u1, v0, v1;
    int32_t z, az, bz;
} caster_box;

/* A depth, Q30, into a texel of 8 or 16 bits that it is nearer than. */
static inline void store_nearer(gn_texels texels, int32_t bits, int32_t at, int32_t z_q30)
{
    const int32_t drop = 30 - bits, depth = (gn_max32(z_q30, 0) + (1 << drop >> 1)) >> drop; /* 2^bits: in no texel */
    if (bits == 16 && depth < texels.d16[at]) texels.d16[at] = (uint16_t)depth;
    if (bits == 8 && depth < texels.d8[at]) texels.d8[at] = (uint8_t)depth;
}

/* Texels that the caster covers, by the rule of gn_walk.h, get the depth between the corners. Returns how many. */
static GN_NOINLINE int32_t box_texels(const gn_light_view *view, const caster_box *box, int32_t subpixel_bits)
{
    const int32_t ax = box->ax, ay = box->ay, bx = box->bx, by = box->by, one = 1 << subpixel_bits,
                  bits = GN_VIEW_BITS(view), area = bx * ay - ax * by;
    const int32_t rule_a = gn_mask_rule(ax, ay), rule_b = gn_mask_rule(-bx, -by);
    /* shares of the third, second and first corner in the area, less what the rule takes off */
    int32_t a = ay * box->x - ax * box->y, b = bx * box->y - by * box->x,
            c = area - a - b - gn_mask_rule(bx - ax, by - ay), n = 0, clz = 0, row = box->v0 * view->tile_texels;
    uint32_t recip = 0;
    a -= rule_a, b -= rule_b;
    for (int32_t v = box->v0; v < box->v1; v++, row += view->tile_texels) {
        int32_t third = a, second = b, first = c;
        for (int32_t u = box->u0; u < box->u1; u++) {
            if ((third | second | first) >= 0) {
                if (!n++) {
                    clz = gn_clz32((uint32_t)area);
                    recip = gn_recip_norm2((uint32_t)area << clz);
                }
                uint32_t of_a = gn_umul_high((uint32_t)(second + rule_b) << clz, recip), /* Q31, up to 1 */
                    of_b = gn_umul_high((uint32_t)(third + rule_a) << clz, recip);
                of_a -= of_a >> 31, of_b -= of_b >> 31;
                const int64_t more = (int64_t)(int32_t)of_a * box->az + (int64_t)(int32_t)of_b * box->bz;
                store_nearer(view->depth, bits, row + u, box->z + (int32_t)(more >> 31));
            }
            third += ay * one, second -= by * one, first += (by - ay) * one;
        }
        a -= ax * one, b += bx * one, c += (ax - bx) * one;
    }
    return n;
}

/* What box_caster returns for others. */
#define GN_NO_BOX (-3)

/* Depth of corners, texels in Q16. Returns 0 if one is farther before or behind the near end than the range is long. */
static inline int box_depth(caster_box *box, const gn_light_view *view, int32_t p, int32_t q, int32_t r)
{
    const int32_t up = 14 - view->tile_log2 - view->depth_log2; /* at most 11 */
    if (up > 0 && (gn_abs32(p) | gn_abs32(q) | gn_abs32(r)) >> (30 - up)) return 0;
    box->z = up > 0 ? p * (1 << up) : p >> -up;
    box->az = (up > 0 ? q * (1 << up) : q >> -up) - box->z;
    box->bz = (up > 0 ? r * (1 << up) : r >> -up) - box->z;
    return 1;
}

static inline int32_t on_grid_q16(int32_t q16, int32_t bits)
{
    return (q16 + (1 << (16 - bits) >> 1)) >> (16 - bits);
}

/* The texels of a caster whose sides on the grid, from its corner (x, y), are known. Returns 1 if there are any in the
 * tile; if not *n is what box_caster returns. */
static inline int box_bounds(caster_box *box, const gn_light_view *view, int32_t x, int32_t y, int32_t bits, int32_t *n)
{
    const int32_t ax = box->ax, ay = box->ay, bx = box->bx, by = box->by;
    const int32_t u0 = gn_first_px(x + gn_min32(gn_min32(ax, bx), 0), bits),
                  u1 = gn_first_px(x + gn_max32(gn_max32(ax, bx), 0), bits);
    *n = u0 < u1 ? -1 : 0; /* beside the tile, or between centres */
    box->u0 = gn_max32(u0, 0), box->u1 = gn_min32(u1, view->tile_texels);
    if (box->u0 >= box->u1) return 0;
    const int32_t v0 = gn_first_px(y + gn_min32(gn_min32(ay, by), 0), bits),
                  v1 = gn_first_px(y + gn_max32(gn_max32(ay, by), 0), bits);
    *n = v0 < v1 ? -1 : 0;
    box->v0 = gn_max32(v0, 0), box->v1 = gn_min32(v1, GN_TILE_ROWS(view));
    return box->v0 < box->v1;
}

/* Draws a caster whose box has few texels of 8 or 16 bits: its corners U, V, D in texels, Q16, below 2^29. Returns what
 * gn_ortho_triangle does, or GN_NO_BOX: nothing is drawn. */
static inline int32_t box_caster(const gn_frame *frame, const gn_light_view *view, uint32_t sides, const int32_t *p,
                                 const int32_t *q, const int32_t *r)
{
    const int32_t bits = GN_CASTER_BITS(frame), x = on_grid_q16(p[0], bits), y = on_grid_q16(p[1], bits);
    const uint32_t side = GN_BOX_SIDE;
    const int32_t *swap;
    int32_t n;
    caster_box box;
    box.ax = on_grid_q16(q[0], bits) - x, box.ay = on_grid_q16(q[1], bits) - y;
    box.bx = on_grid_q16(r[0], bits) - x, box.by = on_grid_q16(r[1], bits) - y;
    if ((((uint32_t)box.ax + side) | ((uint32_t)box.ay + side) | ((uint32_t)box.bx + side) |
         ((uint32_t)box.by + side)) >= 2 * side)
        return GN_NO_BOX;
    const int32_t area = box.ax * box.by - box.bx * box.ay;
    if (area == 0 || !(sides & (area > 0 ? GN_SIDE_CW : GN_SIDE_CCW))) return -1;
    if (!box_bounds(&box, view, x, y, bits, &n)) return n;
    if (GN_VIEW_BITS(view) > 16 || view->bias_constant_q16 || view->bias_slope_q16 ||
        (box.u1 - box.u0) * (box.v1 - box.v0) > GN_BOX_TEXELS)
        return GN_NO_BOX;
    if (area > 0) {
        swap = q, q = r, r = swap;
        n = box.ax, box.ax = box.bx, box.bx = n;
        n = box.ay, box.ay = box.by, box.by = n;
    }
    if (!box_depth(&box, view, p[2], q[2], r[2])) return GN_NO_BOX;
    box.x = box.u0 * (1 << bits) + (1 << bits >> 1) - x;
    box.y = box.v0 * (1 << bits) + (1 << bits >> 1) - y;
    n = box_texels(view, &box, bits);
#if GN_DISK_FILTER
    for (int32_t v = box.v0; GN_HAS_BLOCKS(view) && n && v < ((box.v1 + 7) & ~7); v += 8)
        gn_blocks_touch(view, box.u0, v, box.u1 - box.u0);
#endif
    return n;
}

/* The same of any caster. */
static GN_NOINLINE int32_t general_box(const gn_frame *frame, const gn_light_view *view, gn_casting *casting)
{
    int32_t p[3][3];
    for (int i = 0; i < 9; i++) {
        const int64_t at = casting->of.polygon.p[i / 3][i % 3];
        if (gn_abs64(at) >> 29) return GN_NO_BOX;
        p[i / 3][i % 3] = (int32_t)at;
    }
    return box_caster(frame, view, casting->job.sides, p[0], p[1], p[2]);
}

GN_COLD int32_t gn_ortho_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting,
                                  gn_alpha_cut *alpha)
{
    gn_caster caster;
    gn_light_polygon *polygon = &casting->of.polygon;
    polygon->n = 3;
    if (!alpha) {
        const int32_t n_texels = general_box(frame, view, casting);
        if (n_texels != GN_NO_BOX) return n_texels;
    }
    if (misses_tile(view, polygon->p) || !wide_caster_begin(&caster, view, polygon->p, casting->job.sides)) return -1;
    if (GN_CASTER_ALPHA && GN_TEXTURES > 0 && alpha && alpha->textured) alpha_plane(frame, view, alpha, polygon->p);
    if (GN_CASTER_CLIPPING) clip_to_reach(polygon, &casting->with.uncut);
    else if (!within_reach(polygon->p)) return GN_ORTHO_TOO_FAR;
    if (polygon->n >= 3)
        caster.z_corner = depth_at_corner(view, &caster, polygon->p[0][0], polygon->p[0][1], polygon->p[0][2]);
    int32_t bits = GN_CASTER_BITS(frame), n_texels = 0;
    for (int i = 1; i + 1 < polygon->n; i++) {
        const int64_t *p[3] = {polygon->p[0], polygon->p[i], polygon->p[i + 1]};
        int32_t x[3], y[3];
        for (int k = 0; k < 3; k++) {
            x[k] = (int32_t)gn_shr64(p[k][0], 16 - bits); /* 2^14 texels * 2^12 */
            y[k] = (int32_t)gn_shr64(p[k][1], 16 - bits);
        }
        n_texels += gn_caster_draw(frame, view, &caster, &casting->walk, x, y, alpha);
    }
    return n_texels;
}

int32_t gn_ortho_small_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting,
                                const gn_caster_corner *const c[3])
{
    const uint32_t sides = casting->job.sides;
    const int32_t in_box = box_caster(frame, view, sides, c[0]->vertex.v_q16, c[1]->vertex.v_q16, c[2]->vertex.v_q16);
    if (in_box != GN_NO_BOX) return in_box;
    const int32_t ends[2] = {view->tile_texels << 16, GN_TILE_ROWS(view) << 16};
    int32_t sub = 16 - GN_CASTER_BITS(frame), half = (1 << sub) >> 1, x[3], y[3];
    for (int axis = 0; axis < 2; axis++) { /* misses the tile: a sign of all three */
        int32_t end = ends[axis];
        if (((c[0]->vertex.v_q16[axis] & c[1]->vertex.v_q16[axis] & c[2]->vertex.v_q16[axis]) |
             ((end - c[0]->vertex.v_q16[axis]) & (end - c[1]->vertex.v_q16[axis]) & (end - c[2]->vertex.v_q16[axis]))) <
            0)
            return -1;
    }
    int32_t e1[3], e2[3], nn[3];
    for (int i = 0; i < 3; i++) {
        e1[i] = c[1]->vertex.v_q16[i] - c[0]->vertex.v_q16[i]; /* < 2^30 */
        e2[i] = c[2]->vertex.v_q16[i] - c[0]->vertex.v_q16[i];
    }
    int64_t n[3] = {0, 0, (int64_t)e1[0] * e2[1] - (int64_t)e1[1] * e2[0]};
    if (n[2] == 0 || !(sides & (n[2] > 0 ? GN_SIDE_CW : GN_SIDE_CCW))) return -1;
    for (int k = 0; k < 3; k++) {
        x[k] = (c[k]->vertex.v_q16[0] + half) >> sub;
        y[k] = (c[k]->vertex.v_q16[1] + half) >> sub;
    }
    int32_t n_rows = gn_caster_begin(frame, view, &casting->walk, x, y);
    if (!n_rows) return 0;
    gn_caster caster;
    gn_cross64(n, e1, e2);
    gn_norm_vec(nn, n);
    if (!ortho_caster(&caster, view, nn, sides,
                      gn_min32(c[0]->vertex.v_q16[2], gn_min32(c[1]->vertex.v_q16[2], c[2]->vertex.v_q16[2])),
                      gn_max32(c[0]->vertex.v_q16[2], gn_max32(c[1]->vertex.v_q16[2], c[2]->vertex.v_q16[2]))))
        return -1;
    caster.z_corner =
        depth_at_corner(view, &caster, c[0]->vertex.v_q16[0], c[0]->vertex.v_q16[1], c[0]->vertex.v_q16[2]);
    return gn_caster_rows(view, &caster, &casting->walk, n_rows, NULL);
}
