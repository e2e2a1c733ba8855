/* Where views of lights see corners. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_surface.h"
#include "shadow/gn_views.h"

/* ---- Points ------------------------------------------------------------------------------------------------------ */

GN_HOT void gn_surface_use_bary(const gn_frame *frame, gn_surface *s)
{
    if (GN_FLAT_Q16(frame)) return;
    if (s->plane.det > 0)
        s->depth_scale = gn_bf_mul(gn_bf_from_u64((uint64_t)s->plane.det), gn_bf_from_u64(frame->cam.focal2_px_q16));
    if (GN_HAS_BARY(s)) gn_bary_setup(&s->bary, &s->plane, s->v_q16[0], s->v_q16[1], s->v_q16[2]);
}

#if GN_PUNCTUAL_LIGHTS
/* A length along a ray, saturated: times 2^shift / 2^32. */
GN_HOT static int32_t ray_length(int32_t length, int32_t a, int32_t shift)
{
    int32_t v = gn_mul_high(length, a);
    if (shift <= 0) return v >> gn_min32(-shift, 31);
    return (int32_t)gn_clamp64(v * ((int64_t)1 << gn_min32(shift, 31)), -INT32_MAX, INT32_MAX);
}

GN_HOT int gn_corner_find_ray(const gn_frame *frame, const gn_light_state *any, int32_t x, int32_t y, int32_t z_q16,
                              int32_t ray_q16[3])
{
    uint32_t beyond = 0;
    gn_corner_ray ray;
    gn_corner_ray_begin(&ray, frame, any->ray_shift, x, y, z_q16);
    int32_t z_shift = 33 - any->ray_shift - gn_clz32((uint32_t)z_q16);
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        const gn_ray_plane *r = &any->from_light[i];
        uint32_t across = (uint32_t)r->ax * (uint32_t)ray.px + (uint32_t)r->ay * (uint32_t)ray.py;
        int32_t more = 0;
#if GN_ORTHOGRAPHIC
        if (ray.flat) {
            more = ray_length(ray.flat, (int32_t)across, 33 - any->ray_shift - gn_clz32((uint32_t)GN_FLAT_Q16(frame)));
            beyond |= (uint32_t)more + (1U << 30);
            across = 0;
        }
#endif
        int32_t at = ray_length(ray.z, (int32_t)((uint32_t)r->a0 + across), z_shift);
        beyond |= (uint32_t)at + (1U << 30);
        ray_q16[i] = GN_ORTHOGRAPHIC ? gn_sat32((int64_t)at + more) : at;
        beyond |= (uint32_t)ray_q16[i] + (1U << 30);
    }
    return !(beyond >> 31);
}

#endif

#if GN_INTERPOLATES && GN_SHADOWS
/* Whether the surface's plane is seen at a pixel: then it is the anchor. */
GN_HOT static int anchor_at(gn_lattice *l, const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y)
{
    const int32_t z = gn_corner_seen_depth(l, frame, s, x, y);
    if (z <= 0) return 0;
    l->anchor.x = (int16_t)x;
    l->anchor.y = (int16_t)y;
    l->anchor.z_q16 = z;
#if GN_PUNCTUAL_LIGHTS
    if (s->n_punctual) return gn_corner_find_ray(frame, s->light[s->n_lights - 1].state, x, y, z, l->anchor.ray_q16);
#endif
    return 1;
}

/* Its middle, or else one of its corners. */
GN_HOT GN_NOINLINE int gn_corner_find_anchor(gn_lattice *l, const gn_frame *frame, const gn_surface *s)
{
    const gn_rect *r = &l->block;
    if (l->anchor.known) return l->anchor.found;
    l->anchor.known = 1;
    l->anchor.found = (uint8_t)anchor_at(l, frame, s, (r->x0 + r->x1) >> 1, (r->y0 + r->y1) >> 1);
    for (int i = 0; i < 4 && !l->anchor.found; i++)
        l->anchor.found = (uint8_t)anchor_at(l, frame, s, i & 1 ? r->x1 : r->x0, i & 2 ? r->y1 : r->y0);
    return l->anchor.found;
}
#endif

/* ---- The receiver's plane ---------------------------------------------------------------------------------------- */

#if GN_SHADOWS && (GN_PLANES || GN_INTERPOLATES)
/* The slope of depth over one texel, a quotient of two components of the face's normal, clamped to 16 / T of the depth
 * range. [B5] */
GN_HOT static int32_t limit_slope(const gn_light_view *view, int64_t slope_q28)
{
    int64_t most = (int64_t)1 << GN_SLOPE_LIMIT_LOG2(view);
    return (int32_t)gn_clamp64(slope_q28, -most, most);
}

GN_HOT static void ortho_slopes(const gn_light_view *view, const int32_t face_q30[3], int32_t slope_q28[2])
{
    int64_t w = gn_dot_q30(face_q30, view->axis_q30[2]);
    gn_bfloat per_w = gn_bf_recip(gn_bf_from_u64(gn_abs64(w) | 1U));
    for (int i = 0; i < 2; i++) {
        int64_t u = gn_dot_q30(face_q30, view->axis_q30[i]);
        slope_q28[i] = limit_slope(view, gn_bf_apply(w < 0 ? u : -u, per_w, 28 - view->tile_log2 - view->depth_log2));
    }
}

#if GN_PUNCTUAL_LIGHTS
/* With m . P = h on the face: n / z = n (m_u x/z + m_v y/z + m_w) / h is linear over the tile. */
GN_HOT static void persp_slopes(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                                int32_t slope_q28[2])
{
    const gn_persp_fit *fit = &view->fit.persp;
    int64_t h = gn_dot_q30(face_q30, from_q16);
    gn_bfloat per_h = gn_bf_mul(gn_bf_recip(gn_bf_from_u64(gn_abs64(h) | 1U)), fit->texel_per_z);
    for (int i = 0; i < 2; i++) {
        int64_t m = gn_dot_q30(face_q30, view->axis_q30[i]) * fit->near_q16; /* Q46, 2^59 */
        slope_q28[i] = limit_slope(view, gn_bf_apply(h < 0 ? m : -m, per_h, -2));
    }
}
#else
GN_HOT static void persp_slopes(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                                int32_t slope_q28[2])
{
    (void)view, (void)face_q30, (void)from_q16, (void)slope_q28;
}
#endif

GN_HOT void gn_shadow_plane_slopes(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                                   int32_t slope_q28[2])
{
    if (GN_PUNCTUAL_LIGHTS && view->perspective) persp_slopes(view, face_q30, from_q16, slope_q28);
    else ortho_slopes(view, face_q30, slope_q28);
}

#endif

/* ---- Places ------------------------------------------------------------------------------------------------------ */

#if GN_SHADOWS

/* The surface's offset in a view, if it differs between the views of a light: for smooth surfaces; for the disk, whose
 * index and radius depend on the cascade; and for automatic bias, whose depth steps do. */
GN_HOT static const int32_t *own_offset(const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                        const gn_light_view *view, const int32_t n_q30[3], int32_t moved_q16[3])
{
    const int32_t *flat = s->light[slot].flat_offset_q16;
    gn_auto_bias form = (gn_auto_bias)s->light[slot].state->auto_bias;
    if (GN_AUTO_BIAS && form) {
        gn_bias_auto_ortho(view, form, flat, moved_q16);
        return moved_q16;
    }
    if (!GN_SMOOTH(s) && !(GN_DISK_FILTER && view->filter == GN_FILTER_DISK)) return flat;
    gn_bias_directional(frame, view, n_q30, moved_q16);
    return moved_q16;
}

GN_HOT void gn_corner_offset(const gn_frame *frame, const gn_surface *s, uint32_t slot, const gn_light_view *view,
                             const int32_t n_q30[3], int32_t offset_q16[3])
{
    int32_t moved[3];
    const int32_t *offset = own_offset(frame, s, slot, view, n_q30, moved);
    for (int i = 0; i < 3; i++) offset_q16[i] = offset[i];
}

/* Normal of the surface at the corner. */
GN_HOT static const int32_t *normal_of(const gn_surface *s, const gn_corner *c)
{
#if GN_VERTEX_NORMALS
    (void)s;
    return c->normal_q30;
#else
    (void)c;
    return s->normal_q30[0];
#endif
}

#if GN_INTERPOLATES
GN_HOT const int32_t *gn_corner_flat_offset(gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                            const gn_light_view *view)
{
    if (l->offset_view != view) gn_corner_offset(frame, s, slot, view, s->normal_q30[0], l->offset_q16);
    l->offset_view = view;
    return l->offset_q16;
}

GN_HOT int32_t gn_corner_depth(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y)
{
    const gn_screen_plane *p = &l->plane;
#if GN_ORTHOGRAPHIC
    int32_t b_q28[2];
    if (GN_FLAT_Q16(frame)) return gn_max32(1, gn_min32(gn_corner_flat_depth(p, s, x, y, b_q28), s->z_max_q16));
#endif
    int32_t w = gn_max32(gn_slope_at(&p->w, x - p->x, y - p->y), 1 << 10), clz = gn_clz32((uint32_t)w);
    uint32_t z = gn_umul_high(s->depth_scale.mant, gn_recip_norm((uint32_t)w << clz, GN_RECIP_STEPS(frame)));
    int32_t shift = p->z_shift - clz;
    if (shift < 1) return s->z_max_q16;
    z = shift > 31 ? 0 : ((z >> (shift - 1)) + 1) >> 1;
    return gn_max32(1, gn_min32((int32_t)(z & INT32_MAX), s->z_max_q16));
}

GN_HOT int32_t gn_corner_uv(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_light_view *view,
                            int32_t x, int32_t y, const int32_t offset_q16[3], int32_t uv_q16[2])
{
    gn_corner_ray ray;
    const int32_t z_q16 = gn_corner_seen_depth(l, frame, s, x, y);
    if (z_q16 <= 0 || !gn_corner_ray_begin(&ray, frame, view->fit.ortho.ray_shift, x, y, z_q16)) return 0;
    uint32_t beyond = 0; /* its sign: a sum has another than both of its terms */
    GN_UNROLL
    for (int i = 0; i < 2; i++) {
        const uint32_t at = (uint32_t)gn_corner_ortho(&view->fit.ortho.ray[i], &ray), offset = (uint32_t)offset_q16[i],
                       sum = at + offset;
        beyond |= (at ^ sum) & (offset ^ sum);
        uv_q16[i] = (int32_t)sum;
    }
    if (beyond >> 31) return 0;
    return z_q16;
}
#endif

/* In 64 bits: of smooth surfaces, whose offset is the corner's own, and where 32 are not enough. */
GN_HOT static void coords_64(const gn_frame *frame, const gn_light_view *view, const gn_corner *c,
                             const int32_t offset_q16[3], int32_t out_q16[3])
{
    const int32_t px = 2 * c->x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * c->y,
                  flat_q16 = GN_FLAT_Q16(frame), shift = view->fit.ortho.ray_shift;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        const gn_ray_plane *r = &view->fit.ortho.ray[i];
        /* |z| * |a| < 2^31 * 2^31 by the choice of the shift; of parallel rays 2^61 and 2^60 */
        const int32_t across = (int32_t)((uint32_t)r->ax * (uint32_t)px + (uint32_t)r->ay * (uint32_t)py);
        const int64_t at = flat_q16 ? (int64_t)c->z_q16 * r->a0 + (int64_t)across * flat_q16
                                    : (int64_t)c->z_q16 * (int32_t)((uint32_t)r->a0 + (uint32_t)across);
        out_q16[i] = gn_sat32(gn_shr64(at, shift) + r->d_q16 + offset_q16[i]);
    }
}

GN_HOT GN_NOINLINE void gn_corner_coords(gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_corner *c,
                                         uint32_t slot, const gn_light_view *view, int32_t coord[3])
{
    int32_t moved[3];
#if GN_INTERPOLATES
    gn_corner_ray ray;
    const int flat = !GN_SMOOTH(s) || (GN_AUTO_BIAS && s->light[slot].state->auto_bias);
    if (l->plane.fits && flat && gn_corner_ray_begin(&ray, frame, view->fit.ortho.ray_shift, c->x, c->y, c->z_q16)) {
        const int32_t *offset_q16 = gn_corner_flat_offset(l, frame, s, slot, view);
        GN_UNROLL
        for (int i = 0; i < 3; i++) /* automatic bias may say: lit */
            coord[i] = gn_sat32((int64_t)gn_corner_ortho(&view->fit.ortho.ray[i], &ray) + offset_q16[i]);
        return;
    }
#endif
    (void)l;
    coords_64(frame, view, c, own_offset(frame, s, slot, view, normal_of(s, c), moved), coord);
}

GN_HOT static void place_directional(gn_lattice *l, const gn_frame *frame, const gn_surface *s, gn_corner *c,
                                     uint32_t slot, const gn_light_view *view)
{
    gn_corner_light *at = &c->light[slot];
    int32_t coord[3];
    gn_corner_coords(l, frame, s, c, slot, view, coord);
    at->u_q16 = coord[0];
    at->v_q16 = coord[1];
    at->depth_q30 = gn_depth_q30(view, coord[2]);
    at->seen = 1;
}

#if GN_PUNCTUAL_LIGHTS
/* B2 and B3 have moved the point before; B6 does it here, in one of its forms, face by face of a point light. Returns
 * what is to be taken off its depth, Q32. */
GN_HOT static int64_t move_point(const gn_surface *s, int32_t z_q16, const gn_light_view *view, gn_auto_bias *form,
                                 const int32_t from_q16[3], const int32_t offset_q16[3], int32_t out_q16[3])
{
#if GN_AUTO_BIAS
    if (*form) return gn_bias_auto_persp(view, form, s->face_q30, z_q16, from_q16, out_q16);
#endif
    (void)s, (void)z_q16, (void)view, (void)form;
    for (int i = 0; i < 3; i++) out_q16[i] = gn_sat32((int64_t)from_q16[i] + offset_q16[i]);
    return 0;
}

/* Where the view sees the point in that form. Returns 0 if it is nearer than its near plane. */
GN_HOT static int place_in(const gn_frame *frame, const gn_surface *s, int32_t z_q16, const gn_light_view *view,
                           gn_auto_bias form, const int32_t from_q16[3], const int32_t offset_q16[3],
                           gn_persp_place *out)
{
    int32_t moved[3];
    const int64_t less_q32 = move_point(s, z_q16 + GN_FLAT_Q16(frame), view, &form, from_q16, offset_q16, moved);
    return gn_persp_find_place(frame, view, moved, less_q32, out);
}

/* Returns how the point is seen. B6 along the normal would move what is at a spot's rim out of its tile, whose border
 * says nothing of it: there it goes along the ray. */
GN_HOT static GN_NOINLINE int place_persp(const gn_frame *frame, const gn_surface *s, const gn_corner *c,
                                          gn_corner_light *at, const gn_light_view *view)
{
    const gn_light_state *light = &frame->light[view->light_idx];
    const gn_auto_bias form = GN_AUTO_BIAS ? (gn_auto_bias)light->auto_bias : GN_AUTO_BIAS_DEFAULT; /* none */
    const uint32_t end = (uint32_t)view->tile_texels << 16;
    int32_t offset[3] = {0, 0, 0}, from[3];
    gn_persp_place place;
    gn_corner_from(c, light, from);
    if (!(GN_AUTO_BIAS && light->auto_bias)) gn_bias_punctual(frame, light, normal_of(s, c), from, offset);
    at->seen = (uint8_t)place_in(frame, s, c->z_q16, view, form, from, offset, &place);
    if (GN_AUTO_BIAS && at->seen && form == GN_AUTO_BIAS_NORMAL &&
        ((uint32_t)place.u_q16 > end || (uint32_t)place.v_q16 > end))
        at->seen =
            (uint8_t)(GN_SEEN_OUTSIDE * place_in(frame, s, c->z_q16, view, GN_AUTO_BIAS_DEPTH, from, offset, &place));
    if (!at->seen) return 0;
    at->u_q16 = place.u_q16;
    at->v_q16 = place.v_q16;
    at->depth_q30 = (int32_t)(place.depth_q32 >> 2);
    return at->seen;
}

#endif

#if GN_PLANES
/* By the block's anchor, or where it has none by the corner's own point. */
GN_HOT static GN_NOINLINE void find_slopes_in(gn_lattice *l, const gn_frame *frame, const gn_surface *s,
                                              const gn_light_view *view, const gn_corner *c)
{
    int32_t from[3] = {0, 0, 0};
    l->slope_view = view;
#if GN_PUNCTUAL_LIGHTS
    if (view->perspective) {
        const int32_t *ray_q16 = c->ray_q16;
#if GN_INTERPOLATES
        if (gn_corner_find_anchor(l, frame, s)) ray_q16 = l->anchor.ray_q16;
        else
#endif
            l->slope_view = NULL;
        gn_corner_from_ray(ray_q16, &frame->light[view->light_idx], from);
    }
#endif
    (void)frame, (void)c;
    gn_shadow_plane_slopes(view, s->face_q30, from, l->slope_q28);
}
#endif

GN_HOT void gn_corner_slopes(gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_light_view *view,
                             const gn_corner *c, int32_t slope_q28[2])
{
    slope_q28[0] = slope_q28[1] = 0;
#if GN_PLANES
    if (!gn_shadow_has_plane(frame, view)) return;
    if (l->slope_view != view) find_slopes_in(l, frame, s, view, c);
    slope_q28[0] = l->slope_q28[0];
    slope_q28[1] = l->slope_q28[1];
#endif
    (void)l, (void)frame, (void)s, (void)view, (void)c;
}

GN_HOT int gn_corner_place_any(gn_lattice *l, const gn_frame *frame, const gn_surface *s, gn_corner *c, uint32_t slot,
                               const gn_light_view *view)
{
#if GN_PUNCTUAL_LIGHTS
    if (view->perspective) return place_persp(frame, s, c, &c->light[slot], view);
#endif
    place_directional(l, frame, s, c, slot, view);
    return 1;
}

#endif
