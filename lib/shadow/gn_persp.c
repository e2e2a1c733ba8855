/* Perspective light views. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_xform.h"
#include "light/gn_lights.h"
#include "scene/gn_scene.h"
#include "shadow/gn_views.h"

#define GN_NEAR_MAX_Q16 (8192 << 16) /* as far as lights may have it */
#define GN_GUARD_TEXELS 8192         /* casters are cut at this distance from the tile's centre */

/* Faces of a point light's cube: +x, -x, +y, -y, +z, -z. [P5] */
GN_HOT void gn_persp_face_axis(int32_t out_q30[3], int32_t face)
{
    for (int i = 0; i < 3; i++) out_q30[i] = face / 2 == i ? (face & 1 ? -(1 << 30) : 1 << 30) : 0;
}

GN_HOT int32_t gn_persp_face(const int32_t from_light_q16[3])
{
    uint32_t x = gn_abs32(from_light_q16[0]), y = gn_abs32(from_light_q16[1]), z = gn_abs32(from_light_q16[2]);
    int32_t axis = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
    return 2 * axis + (from_light_q16[axis] < 0);
}

/* Wide enough that a tap at a face's border, with filter and offset, still lies in its tile. [P6] */
GN_COLD int64_t gn_persp_face_q24(int32_t filter_idx, int32_t nu_q16, int32_t tile_texels, int *clamped)
{
    const int64_t one = 1 << 24, two = 2 << 24;
    int64_t a = (int64_t)gn_udiv64((uint64_t)(2 * (filter_idx + 1)) << 24, (uint64_t)tile_texels); /* <= 2.25 */
    int64_t p = gn_shr64((int64_t)nu_q16 * 46341 * a, 32); /* nu / sqrt(2) * A: 2^21 * 2^16 * 2^26 */
    int64_t b = one - p - a, product = gn_shr64(p * (one - a), 24);
    int64_t under = b * b - 4 * product * one;
    *clamped = 1;
    if (b <= 0 || under < 0) return two;
    /* the smaller root of P (1 - A) t^2 - (1 - P - A) t + 1, in the form that is also valid for P = 0 */
    int64_t sum = b + (int64_t)gn_isqrt64((uint64_t)under);
    int64_t t = (int64_t)gn_udiv64((uint64_t)((two << 24) + sum / 2), (uint64_t)sum);
    if (t > two) return two;
    *clamped = 0;
    return t;
}

/* T / t in Q16 */
GN_COLD static uint32_t focal2_q16(int32_t tile_texels, int64_t t_numerator, int64_t t_denominator)
{
    uint64_t scaled = ((uint64_t)tile_texels << 16) * (uint64_t)t_denominator; /* 2^26 * 2^31 */
    uint64_t focal2 = gn_udiv64(scaled + (uint64_t)t_numerator / 2, (uint64_t)t_numerator);
    return focal2 > UINT32_MAX ? UINT32_MAX : (uint32_t)focal2;
}

/* n of MODEL 5: what is seen of the receivers is not nearer, nor comes nearer by its bias, which reaches that far.
 * Three significant bits, so that it seldom changes. [D12] */
GN_COLD static int32_t depth_near_q16(const gn_frame *frame, const gn_light_view *view, const gn_light *light,
                                      int32_t reach_q16)
{
#if GN_TIGHT_FIT
    if (frame->scene->shadow.fit != GN_FIT_TIGHT) return light->near_q16;
    const gn_view_seen *seen = &frame->seen[view - frame->view];
    if (!gn_seen_any(seen)) return light->near_q16;
    if (GN_RECEIVER_BIAS) reach_q16 += light->bias_receiver_q16[0] + 50 * light->bias_receiver_q16[1]; /* tan <= 50 */
    int32_t texels_q16 = (view->filter_idx + 1) * (65536 + reach_q16);                                 /* 2^28 */
    int32_t ratio_q16 = 65536 - gn_sat32(gn_bf_apply(texels_q16, view->fit.persp.texel_per_z, 0));
    int64_t z_q16 = gn_min32(seen->lo_q16[2], GN_NEAR_MAX_Q16);
    uint32_t near_q16 = (uint32_t)(z_q16 * gn_max32(ratio_q16, 8192) >> 16);
    near_q16 &= 0xE0000000U >> gn_clz32(near_q16 | 1U);
    return gn_max32((int32_t)near_q16, light->near_q16);
#else
    (void)frame, (void)view, (void)reach_q16;
    return light->near_q16;
#endif
}

/* A spot's cone, or a face of a point light's cube. [P4] [P5] */
GN_COLD void gn_persp_fit_view(gn_frame *frame, gn_light_view *view, const gn_light *light)
{
    gn_persp_fit *fit = &view->fit.persp;
    int clamped = 0;
    int32_t reach_q16 = gn_bias_reach_q16(frame, view, light);
    for (int i = 0; i < 3; i++) fit->eye_q16[i] = light->position_q16[i];
    fit->clip_q16 = light->near_q16;
    if (light->kind == GN_LIGHT_SPOT) /* tan(a / 2) = sin a / (1 + cos a) */
        fit->focal2_q16 = focal2_q16(view->tile_texels, gn_sin_q30(light->outer_turn),
                                     ((int64_t)1 << 30) + gn_cos_q30(light->outer_turn));
    else
        fit->focal2_q16 = focal2_q16(
            view->tile_texels, gn_persp_face_q24(view->filter_idx, reach_q16, view->tile_texels, &clamped), 1 << 24);
    frame->stats.n_reach_clamped += (uint32_t)clamped;
    fit->texel_per_z = gn_bf_recip(gn_bf_from_u64(fit->focal2_q16));
    fit->texel_per_z.exp += 17; /* 2 / (T / t), T / t in Q16 */
    fit->near_q16 = depth_near_q16(frame, view, light, reach_q16);
    fit->per_near = gn_bf_recip(gn_bf_from_u64((uint64_t)(uint32_t)fit->near_q16));
    fit->guard_q16[0] = fit->guard_q16[1] =
        gn_sat32((int64_t)gn_udiv64((uint64_t)(2 * GN_GUARD_TEXELS) << 32, fit->focal2_q16));
    fit->side_q16[0] = fit->side_q16[1] =
        gn_sat32((int64_t)gn_udiv64((uint64_t)view->tile_texels << 32, fit->focal2_q16) + 2);
    fit->ratio_max_q28 = (int64_t)gn_udiv64((uint64_t)1 << 62, fit->focal2_q16);
    /* min(1, constant * 2t / T): T / t has 16 fraction bits */
    fit->constant_share_q30 = (int32_t)gn_clamp64(
        (int64_t)gn_udiv64((uint64_t)(uint32_t)light->bias_constant_q16 << 31, fit->focal2_q16), 0, 1 << 30);
}

/* ---- Receivers --------------------------------------------------------------------------------------------------- */

/* T / 2 * (1 + x / (z t)), Q16: the clamps keep what is far outside the tile outside. */
GN_HOT static int32_t persp_coord(const gn_light_view *view, int64_t x_q16, uint32_t recip, int32_t clz)
{
    if (gn_abs64(x_q16) < (uint64_t)UINT32_MAX >> clz && clz >= 2 &&
        !(view->fit.persp.focal2_q16 >> 30)) {         /* |x| < 2 z: the same, of which nothing needs a clamp */
        int32_t x = (int32_t)x_q16 * (1 << (clz - 2)); /* x / z = x * recip / 2^61: below 2^29 * 4 */
        int32_t ratio_q28 = (int32_t)((((int64_t)x * (int64_t)recip >> 32) + 1) >> 1);
        return (int32_t)(((int64_t)ratio_q28 * (int64_t)view->fit.persp.focal2_q16 + (1 << 28)) >> 29) +
               (view->tile_texels << 15);
    }
    /* times focal2 within 2^60, and 2^14 texels or more: beyond every tile */
    const int64_t bound = (int64_t)1 << (28 + gn_clz32(view->fit.persp.focal2_q16)), x_most = INT32_MAX;
    int64_t ratio_q28 = gn_scale64(gn_clamp64(x_q16, -x_most, x_most) * (int64_t)recip, 35 - clz); /* 2^31 * 2^32 */
    int64_t texels = gn_shr64(gn_clamp64(ratio_q28, -bound, bound) * (int64_t)view->fit.persp.focal2_q16, 29);
    return gn_sat32(texels + ((int64_t)view->tile_texels << 15));
}

GN_HOT int gn_persp_find_place(const gn_frame *frame, const gn_light_view *view, const int32_t from_q16[3],
                               int64_t less_q32, gn_persp_place *out)
{
    const int64_t far = gn_dot_q30(from_q16, view->axis_q30[2]); /* sqrt(3) * 2^61 */
    if (far <= view->fit.persp.near_q16) return 0;
    const uint32_t z = far > UINT32_MAX ? UINT32_MAX : (uint32_t)far;
    const int32_t clz = gn_clz32(z);
    const uint32_t recip = gn_recip_norm(z << clz, GN_RECIP_STEPS(frame));
    /* 1 - n / z: n * recip * 2^(clz - 31) */
    const uint64_t inverse = (uint64_t)(uint32_t)view->fit.persp.near_q16 * recip >> (31 - clz);
    out->u_q16 = persp_coord(view, gn_dot_q30(from_q16, view->axis_q30[0]), recip, clz);
    out->v_q16 = persp_coord(view, gn_dot_q30(from_q16, view->axis_q30[1]), recip, clz);
    out->depth_q32 = (uint32_t)gn_clamp64(UINT32_MAX - (int64_t)inverse - less_q32, 0, UINT32_MAX);
    out->far_q16 = gn_sat32(far);
    return 1;
}

/* ---- Casters ----------------------------------------------------------------------------------------------------- */

/* n / z, Q32, at most 1 */
GN_HOT static int64_t inverse_depth_q32(const gn_persp_fit *fit, int32_t z_q16)
{
    gn_bfloat z = gn_bf_recip(gn_bf_from_u64((uint64_t)(uint32_t)gn_max32(z_q16, 1)));
    return gn_clamp64(gn_bf_apply(fit->near_q16, z, 32), 0, (int64_t)1 << 32);
}

/* + constant * tau * (1 - s) + slope * steepest, the first of which keeps the plane a plane. [B1] */
GN_HOT static void add_bias(const gn_light_view *view, gn_caster *caster)
{
    const int64_t one = (int64_t)1 << 32;
    uint64_t u = gn_abs64(caster->dz_du), v = gn_abs64(caster->dz_dv);
    int64_t steepest = (int64_t)(u > v ? u : v); /* <= 2^33 */
    caster->bias = gn_shr64(steepest * view->bias_slope_q16, 16);
    if (!view->bias_constant_q16) return;
    int64_t share = view->fit.persp.constant_share_q30;
    caster->dz_du -= gn_shr64((caster->dz_du >> 2) * share, 28); /* 2^31 * 2^30 */
    caster->dz_dv -= gn_shr64((caster->dz_dv >> 2) * share, 28);
    caster->lo += gn_shr64((one - caster->lo) * share, 30);
    caster->hi += gn_shr64((one - caster->hi) * share, 30);
    /* the corner may be far outside: multiplies in two steps of 15 bits */
    int64_t left = one - caster->z_corner;
    caster->z_corner += gn_scale64(left, 15) * (share >> 15) + gn_shr64((left & 32767) * (share >> 15), 15);
}

/* Plane and range of a triangle. Returns 0 if it faces away or is edge on. [P7] */
GN_HOT static int persp_caster(gn_caster *caster, gn_plane *plane, const gn_light_view *view, int32_t v[3][3],
                               uint32_t sides)
{
    const gn_persp_fit *fit = &view->fit.persp;
    gn_plane_setup(plane, v[0], v[1], v[2]);
    /* u x v = w: the normal of a face towards the light points against the view, so gn_plane_setup has negated it */
    if (plane->det == 0 || !(sides & (plane->back ? GN_SIDE_CCW : GN_SIDE_CW))) return 0;
    gn_bfloat scale = gn_bf_mul(gn_bf_from_u64((uint64_t)(uint32_t)fit->near_q16),
                                fit->texel_per_z); /* n / (T / t), times 2^17, which is divided out below */
    scale = gn_bf_mul(scale, gn_bf_recip(gn_bf_from_u64((uint64_t)plane->det)));
    int32_t px = 1 - view->tile_texels, z_min = v[0][2], z_max = v[0][2];
    const int64_t most = GN_CASTER_GRADIENT_MAX;
    caster->dz_du = gn_clamp64(-gn_bf_apply(plane->n[0], scale, 32), -most, most);
    caster->dz_dv = gn_clamp64(-gn_bf_apply(plane->n[1], scale, 32), -most, most);
    int64_t inverse = gn_bf_apply(gn_plane_at(plane->n, px, px, fit->focal2_q16), scale, 15);
    caster->z_corner = ((int64_t)1 << 32) - gn_clamp64(inverse, -((int64_t)1 << 46), (int64_t)1 << 46);
    for (int i = 1; i < 3; i++) {
        z_min = gn_min32(z_min, v[i][2]);
        z_max = gn_max32(z_max, v[i][2]);
    }
    caster->lo = ((int64_t)1 << 32) - inverse_depth_q32(fit, z_min); /* 0: flattened */
    caster->hi = ((int64_t)1 << 32) - inverse_depth_q32(fit, z_max);
    add_bias(view, caster);
    return 1;
}

/* Texels from the tile's corner; v is inside the guard band and not nearer than near. */
GN_HOT static void project_corner(const gn_frame *frame, const gn_light_view *view, const int32_t v_q16[3], int32_t *x,
                                  int32_t *y)
{
    int32_t bits = GN_CASTER_BITS(frame), clz = gn_clz32((uint32_t)v_q16[2]), centre = (view->tile_texels << bits) >> 1;
    const int64_t most = (int64_t)(2 * GN_GUARD_TEXELS) << bits;
    uint32_t recip = gn_recip_norm((uint32_t)v_q16[2] << clz, 2);
    int64_t texel[2];
    for (int i = 0; i < 2; i++) {
        /* x / z in Q28, 2^30 * 2^32; times T / t it stays within 2^13 texels of the centre: below 2^58 */
        int32_t shift = 35 - clz;
        int64_t ratio_q28 = gn_scale64((int64_t)v_q16[i] * (int64_t)recip, shift);
        const int64_t limit = (int64_t)1 << 46;
        ratio_q28 = gn_clamp64(ratio_q28, -limit, limit);
        int64_t bound = view->fit.persp.ratio_max_q28;
        texel[i] = gn_shr64(gn_clamp64(ratio_q28, -bound, bound) * (int64_t)view->fit.persp.focal2_q16, 45 - bits);
    }
    *x = (int32_t)gn_clamp64(texel[0], -most, most) + centre;
    *y = (int32_t)gn_clamp64(texel[1], -most, most) + centre;
}

GN_HOT void gn_persp_corner(const gn_frame *frame, const gn_light_view *view, gn_caster_corner *c)
{
    c->out = gn_outcode(c->vertex.v_q16, view->fit.persp.clip_q16, view->fit.persp.side_q16, 0);
    if (!c->out) project_corner(frame, view, c->vertex.v_q16, &c->x, &c->y);
}

GN_HOT static inline void copy_corners(int32_t out[3][3], const gn_caster_corner *const c[3])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) out[i][k] = c[i]->vertex.v_q16[k];
}

/* A triangle within the tile's border: most are smaller than a texel, and cover none. */
GN_HOT static int32_t draw_inner(const gn_frame *frame, const gn_light_view *view, gn_casting *casting,
                                 const gn_caster_corner *const c[3])
{
    int32_t(*corner)[3] = casting->with.clipping.polygon.v_q16;
    const int32_t x[3] = {c[0]->x, c[1]->x, c[2]->x}, y[3] = {c[0]->y, c[1]->y, c[2]->y};
    const uint32_t sides = casting->job.sides;
    gn_caster caster;
    gn_plane plane;
    /* as roundings may move corners by 1 each, this much of the area says that the plane itself faces away */
    const int32_t dx1 = x[1] - x[0], dx2 = x[2] - x[0], dy1 = y[1] - y[0], dy2 = y[2] - y[0];
    const int64_t area = (int64_t)dx1 * dy2 - (int64_t)dy1 * dx2;
    const int64_t away = sides == GN_SIDE_CW ? -area : area;
    if (sides != GN_SIDES_BOTH &&
        away > 8 + 2 * ((int64_t)gn_abs32(dx1) + gn_abs32(dx2) + gn_abs32(dy1) + gn_abs32(dy2)))
        return -1;
    const int32_t n_rows = gn_caster_begin(frame, view, &casting->walk, x, y);
    if (!n_rows) return area == 0 || (away > 0 && sides != GN_SIDES_BOTH) ? -1 : 0; /* for the statistics */
    copy_corners(corner, c);
    if (!persp_caster(&caster, &plane, view, corner, sides)) return -1;
    return gn_caster_rows(view, &caster, &casting->walk, n_rows, NULL);
}

GN_HOT int32_t gn_persp_small_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting,
                                       const gn_caster_corner *const c[3])
{
    if (c[0]->out & c[1]->out & c[2]->out & GN_OUT_ALL) return -1;
    if (!(c[0]->out | c[1]->out | c[2]->out)) return draw_inner(frame, view, casting, c);
    copy_corners(casting->with.clipping.polygon.v_q16, c);
    return gn_persp_triangle(frame, view, casting, NULL);
}

GN_HOT int32_t gn_persp_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting,
                                 gn_alpha_cut *alpha)
{
    const gn_persp_fit *fit = &view->fit.persp;
    gn_polygon *polygon = &casting->with.clipping.polygon;
    int32_t(*corner)[3] = polygon->v_q16;
    polygon->n = 3;
    uint32_t all = ~0U, any = 0;
    for (int i = 0; i < 3; i++) {
        all &= gn_outcode(corner[i], fit->clip_q16, fit->side_q16, 0);
        any |= gn_outcode(corner[i], fit->clip_q16, fit->guard_q16, 0);
    }
    if (all) return -1;
    gn_caster caster;
    gn_plane plane;
    if (!persp_caster(&caster, &plane, view, corner, casting->job.sides)) return -1;
    if (GN_CASTER_ALPHA && GN_TEXTURES > 0 && alpha && alpha->textured)
        gn_alpha_plane(alpha, frame, corner, fit->focal2_q16, view->tile_texels, 2);
    if (any) gn_clip(polygon, &casting->with.clipping.uncut, GN_OUT_ALL, fit->clip_q16, fit->guard_q16, 0);
    int32_t *x = casting->with.clipping.x, *y = casting->with.clipping.y;
    for (int i = 0; i < polygon->n; i++) project_corner(frame, view, polygon->v_q16[i], &x[i], &y[i]);
    int32_t n_texels = 0;
    for (int i = 1; i + 1 < polygon->n; i++) {
        int32_t fx[3] = {x[0], x[i], x[i + 1]}, fy[3] = {y[0], y[i], y[i + 1]};
        n_texels += gn_caster_draw(frame, view, &caster, &casting->walk, fx, fy, alpha);
    }
    return n_texels;
}
