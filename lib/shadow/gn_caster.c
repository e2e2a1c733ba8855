/* Spans of shadow texels. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_walk.h"
#include "light/gn_lights.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_views.h"

/* What is stored for a depth in Q32: rounded to the texel's bits. [A4] */
GN_HOT static inline uint32_t stored_depth(int64_t z, int32_t bits)
{
    const int32_t drop = 32 - bits;
    return (uint32_t)gn_clamp64((z + (1U << drop >> 1)) >> drop, 0, UINT32_MAX >> drop);
}

/* Depth of a texel, limited to that of the caster, as it is stored. */
GN_HOT static inline uint32_t texel_depth(const gn_caster *caster, int64_t z, int32_t bits)
{
    return stored_depth(gn_clamp64(z, caster->lo, caster->hi) + caster->bias, bits);
}

GN_HOT static inline void store_depth(gn_texels row, int32_t bits, int32_t u, uint32_t depth)
{
    if (bits == 16) row.d16[u] = (uint16_t)depth;
    else if (bits == 8) row.d8[u] = (uint8_t)depth;
    else row.d32[u] = depth;
}

/* Texels of any row, one at a time: the smaller depth is kept. */
GN_HOT static void all_texels(const gn_caster *caster, gn_texels row, int32_t bits, int32_t u, int32_t u_end, int64_t z)
{
    for (; u < u_end; u++, z += caster->dz_du) {
        const uint32_t depth = texel_depth(caster, z, bits);
        if (depth << (32 - bits) < gn_texel_load(row, bits, (size_t)(uint32_t)u)) store_depth(row, bits, u, depth);
    }
}

/* At most 32 of them, unless alpha cuts the texel. */
GN_HOT static void cut_texels(const gn_caster *caster, gn_texels row, int32_t bits, int32_t u, int32_t n, int64_t z,
                              gn_alpha_cut *alpha)
{
    uint32_t nearer = 0;
    int64_t at = z;
    for (int32_t i = 0; i < n; i++, at += caster->dz_du)
        if (texel_depth(caster, at, bits) << (32 - bits) < gn_texel_load(row, bits, (size_t)(uint32_t)(u + i)))
            nearer |= 1U << i;
    if (GN_CASTER_ALPHA && alpha) nearer = gn_alpha_keeps(alpha, u, nearer);
    for (; nearer; nearer &= nearer - 1) {
        const int32_t i = 31 - gn_clz32(nearer & (0U - nearer));
        store_depth(row, bits, u + i, texel_depth(caster, z + i * caster->dz_du, bits));
    }
}

GN_HOT static GN_NOINLINE void span(const gn_light_view *view, const gn_caster *caster, gn_alpha_cut *alpha, int32_t v,
                                    int32_t u, int32_t u_end)
{
    int32_t bits = GN_VIEW_BITS(view);
    int64_t z = caster->z_corner + u * caster->dz_du + v * caster->dz_dv;
    gn_texels row = gn_texels_at(view->depth, bits, (size_t)(uint32_t)(v * view->tile_texels));
    GN_COUNT(texels_cut, alpha ? u_end - u : 0);
    GN_COUNT(texels_wide, alpha ? 0 : u_end - u);
    if (!alpha) {
        all_texels(caster, row, bits, u, u_end, z);
        return;
    }
    for (; u < u_end; u += 32, z += 32 * caster->dz_du)
        cut_texels(caster, row, bits, u, gn_min32(u_end - u, 32), z, alpha);
}

GN_HOT int32_t gn_caster_begin(const gn_frame *frame, const gn_light_view *view, gn_walk *walk, const int32_t x[3],
                               const int32_t y[3])
{
    int32_t bits = GN_CASTER_BITS(frame), size = view->tile_texels;
    GN_COUNT(caster_walks, 1);
    int32_t n_rows = gn_walk_begin(walk, x, y, bits, 0, GN_TILE_ROWS(view));
    if (walk->row < walk->row_end[0]) return n_rows; /* more than one batch of rows: some texel is covered */
    for (int32_t i = 0; i < n_rows; i++)
        if (gn_max32(walk->span[i].x_begin, 0) < gn_min32(walk->span[i].x_end, size)) return n_rows;
    return 0;
}

GN_HOT int32_t gn_caster_rows(const gn_light_view *view, const gn_caster *caster, gn_walk *walk, int32_t n_rows,
                              gn_alpha_cut *alpha)
{
    int32_t size = view->tile_texels, n_texels = 0, v = walk->first;
    for (; n_rows > 0; n_rows = gn_walk_on(walk)) {
        for (const gn_span *at = walk->span; n_rows > 0; n_rows--, at++, v++) {
            int32_t u = gn_max32(at->x_begin, 0), n = gn_min32(at->x_end, size) - u;
            if (n <= 0) continue;
            n_texels += n;
#if GN_DISK_FILTER
            if (GN_HAS_BLOCKS(view)) gn_blocks_touch(view, u, v, n);
#endif
            GN_COUNT(caster_rows, 1);
            if (GN_CASTER_ALPHA && alpha)
                gn_alpha_row(alpha, v, 2 * v + 1 - GN_TILE_ROWS(view), at->x_begin, at->x_end);
            span(view, caster, alpha, v, u, u + n);
        }
    }
    return n_texels;
}

GN_HOT int32_t gn_caster_draw(const gn_frame *frame, const gn_light_view *view, const gn_caster *caster, gn_walk *walk,
                              const int32_t x[3], const int32_t y[3], gn_alpha_cut *alpha)
{
    int32_t n_rows = gn_caster_begin(frame, view, walk, x, y);
    return n_rows ? gn_caster_rows(view, caster, walk, n_rows, alpha) : 0;
}

/* ---- Which casters are drawn into a tile ------------------------------------------------------------------------- */

/* Whether the object casts at all, and in this layer. [M1] */
GN_COLD static int in_layer(uint32_t flags, gn_layer layer)
{
    if (!(flags & GN_OBJECT_CASTS)) return 0;
    int moving = (flags & GN_OBJECT_MOVING) != 0;
    return layer == GN_LAYER_ALL || moving == (layer == GN_LAYER_MOVING);
}

/* Culls by layer, by box, and by smaller cascades. [D8] */
GN_COLD int gn_cull_draws(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx, gn_layer layer,
                          int *culled)
{
    *culled = 0;
    if (!in_layer(frame->flags[object_idx], layer)) return 0;
    if (GN_OBJECT_BOXES && !gn_cull_sees(frame, view, object_idx)) return 0;
    *culled = GN_CASTER_CULLING && frame->scene->shadow.caster_culling && !view->perspective && !view->border_lit &&
              view->cascade_idx > 0 && gn_cull_shown_nearer(frame, view, object_idx);
    return !*culled;
}

/* ---- Casters that lie outside of a view, by their boxes ---------------------------------------------------------- */

#if GN_OBJECT_BOXES
/* Half extent of a box along an axis, Q16, rounded up. */
GN_COLD static int64_t extent_q16(const int32_t axis_q30[3], const int32_t half_q16[3])
{
    uint64_t sum = 0; /* sqrt(3) * 2^61 */
    for (int k = 0; k < 3; k++) sum += (uint64_t)gn_abs32(axis_q30[k]) * (uint32_t)half_q16[k];
    return (int64_t)(sum >> 30) + 1;
}

/* Casters before the near plane count, those beyond the range do not. [D9] */
GN_COLD static int ortho_sees(const gn_frame *frame, const gn_light_view *view, const gn_object_state *object)
{
    const gn_ortho_fit *fit = &view->fit.ortho;
    int64_t margin = 65536 + frame->scene->lights[view->light_idx].bias_caster_q16;
    for (int i = 0; i < 3; i++) {
        int64_t centre = gn_light_coord_q16(view, i, object->centre_q16) - (int64_t)fit->origin[i] * 65536;
        int64_t half = gn_bf_apply(extent_q16(view->axis_q30[i], object->half_q16), fit->inv_texel, 0) + margin;
        int64_t end = i == 2 ? (int64_t)1 << (16 + view->tile_log2 + view->depth_log2)
                             : (int64_t)(i ? GN_TILE_ROWS(view) : view->tile_texels) << 16;
        if (centre - half > end || (i < 2 && centre + half < 0)) return 0; /* casters before the near plane count */
    }
    return 1;
}

GN_COLD static int persp_sees(const gn_frame *frame, const gn_light_view *view, const gn_object_state *object)
{
    const gn_persp_fit *fit = &view->fit.persp;
    int32_t from[3];
    int64_t c[3], e[3];
    for (int i = 0; i < 3; i++) from[i] = gn_sat32((int64_t)object->centre_q16[i] - fit->eye_q16[i]);
    for (int i = 0; i < 3; i++) {
        int64_t sum = 0; /* halves, so that three products fit */
        for (int k = 0; k < 3; k++) sum += (int64_t)(from[k] >> 1) * view->axis_q30[i][k];
        c[i] = gn_shr64(sum, 29);
        e[i] = extent_q16(view->axis_q30[i], object->half_q16) + 4;
    }
    int64_t deepest = c[2] + e[2], bias = frame->scene->lights[view->light_idx].bias_caster_q16;
    /* their bias may move casters away from the light too, into the view: 2^19 * 2^33 */
    if (bias)
        deepest += gn_bf_apply(bias * (deepest > fit->clip_q16 ? deepest : fit->clip_q16), fit->texel_per_z, -16) + 1;
    if (deepest < fit->clip_q16) return 0;
    /* half-width of the tile at that depth, plus a texel and the casters' bias */
    int64_t width = gn_bf_apply(deepest, fit->texel_per_z, view->tile_log2 - 1); /* deepest * t */
    width += (width >> view->tile_log2) * (4 + (2 * bias >> 16)) + 4;
    return (int64_t)gn_abs64(c[0]) - e[0] <= width && (int64_t)gn_abs64(c[1]) - e[1] <= width;
}

GN_COLD int gn_cull_sees(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx)
{
    const gn_object_state *object = &frame->object[object_idx];
    if (GN_PUNCTUAL_LIGHTS && view->perspective) return persp_sees(frame, view, object);
    return ortho_sees(frame, view, object);
}
#endif

/* ---- Casters whose shadows lie wholly in a smaller cascade ------------------------------------------------------- */

#if GN_CASTER_CULLING
GN_COLD void gn_cull_begin(gn_frame *frame)
{
    int32_t(*box)[3] = frame->receivers_q16;
    for (int k = 0; k < 3; k++) {
        box[0][k] = INT32_MAX;
        box[1][k] = INT32_MIN;
    }
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        const gn_object_state *object = &frame->object[i];
        if (!(frame->flags[i] & GN_OBJECT_RECEIVES)) continue;
        for (int k = 0; k < 3; k++) {
            box[0][k] = gn_min32(box[0][k], gn_sat32((int64_t)object->centre_q16[k] - object->half_q16[k]));
            box[1][k] = gn_max32(box[1][k], gn_sat32((int64_t)object->centre_q16[k] + object->half_q16[k]));
        }
    }
}

/* |a - b| + 1, Q16; at most 2^32 */
GN_COLD static uint64_t distance_q16(const int64_t a[3], const int64_t b[3])
{
    uint64_t sum = 0;
    for (int k = 0; k < 3; k++) {
        int64_t d = gn_clamp64(a[k] - b[k], -((int64_t)1 << 31), (int64_t)1 << 31);
        sum += (uint64_t)(d * d); /* 3 * 2^62 */
    }
    return (uint64_t)gn_isqrt64(sum) + 1;
}

/* How far the object's shadow, `radius` wide, travels along w until it is past every receiver, Q16. -1: no bound. */
GN_COLD static int64_t shadow_length_q16(const gn_frame *frame, const gn_light_view *view, const int64_t centre[3],
                                         int64_t radius)
{
    int64_t length = -1;
    for (int k = 0; k < 3; k++) {
        int32_t w = view->axis_q30[2][k];
        if (gn_abs32(w) < 1U << 16) continue;
        int64_t way =
            w > 0 ? frame->receivers_q16[1][k] + radius - centre[k] : centre[k] - frame->receivers_q16[0][k] + radius;
        if (way < 0) way = 0;
        gn_bfloat per_w = gn_bf_recip(gn_bf_from_u64(gn_abs32(w)));
        int64_t steps = gn_bf_apply(way, per_w, 30) + 2;
        if (length < 0 || steps < length) length = steps;
    }
    return length;
}

/* Whether a caster may be skipped in a larger cascade. [D8] */
GN_COLD int gn_cull_shown_nearer(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx)
{
    const gn_object_state *object = &frame->object[object_idx];
    const gn_light *light = &frame->scene->lights[view->light_idx];
    int64_t share_uq16 = 52429 - (int64_t)frame->scene->shadow.cascade_fade_uq16; /* 0.8 - c */
    if (share_uq16 <= 0 || light->receiver_plane || GN_VIEW_EDGE(frame, view))
        return 0;                                       /* a tap may compare with a depth far from the receiver's */
    for (uint32_t i = 0; i < GN_N_CASCADES(frame); i++) /* a kept tile may lack the object */
        if (frame->scene->shadow.refresh[i] > 1) return 0;
    const int64_t zero[3] = {0, 0, 0};
    int64_t c[3], end[3], half[3];
    for (int k = 0; k < 3; k++) {
        c[k] = object->centre_q16[k];
        half[k] = object->half_q16[k];
    }
    /* the sphere around the object, widened by the filter radius and bias of a lookup in this view */
    int64_t reach_texels_q16 = (view->filter_idx + 1) * (int64_t)(65536 + gn_bias_reach_q16(frame, view, light)) +
                               131072 + light->bias_caster_q16;
    int64_t radius = (int64_t)distance_q16(half, zero) +
                     gn_bf_apply(reach_texels_q16, gn_bf_recip(view->fit.ortho.inv_texel), 0) + 2;
    int64_t length = shadow_length_q16(frame, view, c, radius);
    if (length < 0 || length > (int64_t)1 << 31) return 0;
    for (int k = 0; k < 3; k++) end[k] = c[k] + gn_shr64(length * view->axis_q30[2][k], 30);
    for (uint32_t i = 0; i < view->cascade_idx; i++) {
        const gn_cascade_state *cascade = &frame->cascade[i];
        if (cascade->radius2_q32 == 0) continue;
        int64_t centre[3], r = (int64_t)gn_isqrt64(cascade->radius2_q32) * share_uq16 >> 16;
        for (int k = 0; k < 3; k++)
            centre[k] = frame->cam.eye_q16[k] + gn_shr64((int64_t)cascade->centre_q16 * frame->cam.axis_q30[2][k], 30);
        /* both ends of the shadow are inside, so all of it is */
        if ((int64_t)distance_q16(c, centre) + radius <= r && (int64_t)distance_q16(end, centre) + radius <= r)
            return 1;
    }
    return 0;
}
#endif
