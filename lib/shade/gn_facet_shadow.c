/* Shadows on small triangles. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_corner.h"
#include "shade/gn_facet_shadow.h"
#include "shade/gn_lattice_cell.h"
#include "shade/gn_shadow.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_lookup.h"
#include "shadow/gn_persp.h"
#include "shadow/gn_texel.h"

#if GN_INTERPOLATES

#if GN_SHADOWS
enum { FLAT_EDGE_PX = 32 /* with more, windows of flat surfaces pay */ };

/* Coordinates of points of view space: a view's rays times twice the focal length. Returns 0 if they do not fit. */
GN_HOT static int use_matrix(gn_view_matrix *matrix, const gn_frame *frame, const gn_light_view *view)
{
    if (matrix->view == view) return 1;
    matrix->view = NULL;
    matrix->along_q16 = INT32_MIN; /* none */
    matrix->up = gn_max32(33 - view->fit.ortho.ray_shift, 0);
    matrix->down = view->fit.ortho.ray_shift + matrix->up - 32;
    if (matrix->up > 24 || matrix->down > 30 || frame->cam.focal2_px_q16 >> 31) return 0;
    for (int i = 0; i < 3; i++) {
        const gn_ray_plane *r = &view->fit.ortho.ray[i];
        int64_t x = (int64_t)r->ax * (int32_t)frame->cam.focal2_px_q16 >> 16,
                y = (int64_t)r->ay * (int32_t)frame->cam.focal2_px_q16 >> 16;
        if (x != (int32_t)x || y != (int32_t)y || gn_abs64(r->d_q16) >= 3U << 28) return 0;
        matrix->m[i][0] = (int32_t)x;
        matrix->m[i][1] = (int32_t)y;
        matrix->m[i][2] = r->a0;
    }
    matrix->view = view;
    return 1;
}

/* What normals of length 1 move by along the view's axes, texels, Q18. Returns 0 if they do not fit. */
GN_HOT static inline int use_lift(gn_view_matrix *matrix, const gn_light_view *view, int32_t along_q16)
{
    if (gn_abs32(along_q16) >> 27) return 0;
    if (matrix->along_q16 == along_q16) return 1;
    matrix->along_q16 = along_q16;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            matrix->lift_q18[i][j] = (int32_t)(((int64_t)view->axis_q30[i][j] * along_q16 + (1 << 27)) >> 28);
    return 1;
}

/* Where a view sees the vertices: texels, Q16, and depth as a share of the range, Q30. */
typedef struct {
    int32_t at[3][3]; /* u, v and depth of each */
} vertex_places;

GN_HOT static inline int32_t depth_q30_of(const gn_light_view *view, int32_t depth_q16)
{
    int32_t up = 14 - view->tile_log2 - view->depth_log2;
    if (up < 0) return depth_q16 >> gn_min32(-up, 31);
    return gn_max32(-(1 << 29) >> up, gn_min32(depth_q16, ((1 << 30) - 1) >> up)) * (1 << up);
}

/* Adds offsets of receivers, of the face or of points: texels along u, v and depth. Returns 0 if they do not fit. */
GN_HOT static GN_NOINLINE int add_offsets(const gn_shading *shading, uint32_t slot, const gn_light_view *view,
                                          int alike, vertex_places *p)
{
    const gn_surface *s = &shading->surface;
    int32_t offset[3];
    for (int k = 0; k < 3; k++) {
        int32_t n[3] = {s->normal_q30[0][0], s->normal_q30[0][1], s->normal_q30[0][2]};
        for (int i = 0; k && i < 3; i++) n[i] += s->normal_q30[k][i];
        if (!k || !alike) gn_sample_offset(shading->frame, s, slot, view, n, offset);
        for (int i = 0; i < 3; i++) {
            if (((uint32_t)offset[i] + (1U << 28)) >> 29) return 0;
            p->at[i][k] += offset[i];
        }
    }
    return 1;
}

/* Adds offsets along the vertices' normals. */
GN_HOT static inline void add_lifts(const gn_surface *s, const gn_light_state *light, const gn_view_matrix *matrix,
                                    vertex_places *p)
{
    int32_t lifted[3], n[3][3];
    const int32_t *first = gn_sample_lifted(s, light, s->normal_q30[0], lifted);
    const int same = first == lifted && GN_BENT(s);
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        n[0][i] = first[i];
        n[1][i] = first[i] + (same ? 0 : s->normal_q30[1][i]);
        n[2][i] = first[i] + (same ? 0 : s->normal_q30[2][i]);
    }
    for (int i = 0; i < 3; i++) {
        const int32_t *lift = matrix->lift_q18[i];
        p->at[i][0] += (int32_t)(gn_dot64(lift, n[0]) >> 32);
        p->at[i][1] += (int32_t)(gn_dot64(lift, n[1]) >> 32);
        p->at[i][2] += (int32_t)(gn_dot64(lift, n[2]) >> 32);
    }
}

/* Without offsets. Returns 0 if vertices are too far away: |v 2^up| < 2^30, places below 2^30, and 3 * 2^28. */
GN_HOT static inline int place_points(const gn_surface *s, const gn_light_view *view, const gn_view_matrix *matrix,
                                      vertex_places *p)
{
    const int32_t up = matrix->up, down = matrix->down;
    int32_t v[3][3];
    uint32_t wide = 0;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        wide |= ((uint32_t)s->lo_q16[i] + (1U << 30 >> up)) | ((uint32_t)s->hi_q16[i] + (1U << 30 >> up));
        v[0][i] = s->v_q16[0][i] * (1 << up);
        v[1][i] = s->v_q16[1][i] * (1 << up);
        v[2][i] = s->v_q16[2][i] * (1 << up);
    }
    if (wide >> (31 - up)) return 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *m = matrix->m[i], d = (int32_t)view->fit.ortho.ray[i].d_q16;
        p->at[i][0] = ((int32_t)(gn_dot64(m, v[0]) >> 32) >> down) + d;
        p->at[i][1] = ((int32_t)(gn_dot64(m, v[1]) >> 32) >> down) + d;
        p->at[i][2] = ((int32_t)(gn_dot64(m, v[2]) >> 32) >> down) + d;
    }
    return 1;
}

/* Returns 0 if places do not fit. */
GN_HOT static GN_NOINLINE int place_vertices(gn_shading *shading, uint32_t slot, const gn_light_view *view,
                                             vertex_places *out)
{
    const gn_surface *s = &shading->surface;
    const gn_light_state *light = s->light[slot].state;
    gn_view_matrix *matrix = &shading->lattice.matrix;
    int32_t along = 0;
    if (!use_matrix(matrix, shading->frame, view) || !place_points(s, view, matrix, out)) return 0;
    const int offsets = gn_corner_offsets(&shading->lattice.light[slot], s, light, view, &along);
    if (offsets == GN_OFFSET_ALONG) {
        if (!use_lift(matrix, view, along)) return 0;
        add_lifts(s, light, matrix, out);
    } else if (!add_offsets(shading, slot, view, offsets == GN_OFFSET_OF_FACE, out)) return 0;
    for (int k = 0; k < 3; k++) out->at[2][k] = depth_q30_of(view, out->at[2][k]);
    return 1;
}

/* Views that pixels may look into, from the light's first, a bit each. */
GN_HOT static uint32_t views_asked(const gn_shading *s, const gn_light_state *light)
{
    if (light->kind != GN_LIGHT_DIRECTIONAL || s->frame->view[light->view_idx].border_lit) return 1;
    return s->lattice.views & (GN_VIEWS_FADE - 1U);
}

GN_HOT static int place_in_ortho(gn_shading *s, uint32_t slot, const gn_light_view *view, vertex_places *out)
{
    return place_vertices(s, slot, view, out) ? GN_CELL_EDGE : GN_CELL_SPLIT;
}

#if GN_PUNCTUAL_LIGHTS
/* In the view of a spot light, or the one face of a cube that sees all vertices. */
GN_HOT static GN_NOINLINE int place_in_persp(gn_shading *s, const gn_facet_vertices *vertices, uint32_t slot,
                                             const gn_light_view **view, vertex_places *out, int32_t from_q16[3])
{
    const gn_light_state *light = s->surface.light[slot].state;
    gn_corner *c = &s->lattice.corner;
    uint32_t faces = 0, seen = 0;
    for (int k = 2; k >= 0; k--) {
        for (int i = 0; i < 3; i++) c->ray_q16[i] = vertices->ray_q16[k][i];
        gn_corner_from(c, light, from_q16);
        faces |= 1U << (light->kind == GN_LIGHT_POINT ? gn_persp_face(from_q16) : 0);
    }
    if (faces & (faces - 1)) return GN_CELL_SPLIT;
    *view = &s->frame->view[light->view_idx + 31 - gn_clz32(faces)];
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            c->ray_q16[i] = vertices->ray_q16[k][i];
#if GN_VERTEX_NORMALS
            c->normal_q30[i] = vertices->normal_q30[k][i];
#endif
        }
        c->z_q16 = s->surface.v_q16[k][2];
        seen |= 1U << gn_corner_place_any(&s->lattice, s->frame, &s->surface, c, slot, *view);
        out->at[0][k] = c->light[slot].u_q16;
        out->at[1][k] = c->light[slot].v_q16;
        out->at[2][k] = c->light[slot].depth_q30;
    }
    if (seen & (seen - 1)) return GN_CELL_SPLIT; /* bias goes two ways, or some vertex is too near */
    return seen & 1U ? GN_CELL_LIT : GN_CELL_EDGE;
}
#else
GN_HOT static int place_in_persp(gn_shading *s, const gn_facet_vertices *vertices, uint32_t slot,
                                 const gn_light_view **view, vertex_places *out, int32_t from_q16[3])
{
    (void)s, (void)vertices, (void)slot, (void)view, (void)out, (void)from_q16;
    return GN_CELL_SPLIT;
}
#endif

/* ---- Texels behind the triangle's plane ------------------------------------------------------------------------- */

/* Receivers of a triangle: on the plane through its vertices, within their bounds. */
typedef struct {
    const vertex_places *p;
    int32_t lo[3], hi[3];
    int32_t gradient_q30[2]; /* of depth, per texel */
    int32_t margin_q30;      /* what depth, or what it is compared with, may be more */
    int on_plane;            /* taps are compared with the face's plane: the gradient is its */
} receiver_plane;

enum { PLANE_TEXELS = 16 /* along an axis */, PLANE_EDGE_Q16 = 1 << 13 /* pixels beyond the vertices */ };

/* n / det * 2^16, n / det below 2^11. Returns 0 if it is 2^25 or more. */
GN_HOT static inline int quotient_q30(int64_t n, int32_t clz, int32_t recip, int32_t *out)
{
    int64_t high = n >> (45 - clz);
    if (high != (int32_t)high) return 0;
    *out = gn_mul_high((int32_t)high, recip) >> 1;
    return gn_abs32(*out) < 1U << 25;
}

/* Solves for the gradient: differences of u and v below 2^22, of depth below 2^31. Returns 0 if it is steep. */
GN_HOT static inline int find_gradient(receiver_plane *r)
{
    const int32_t(*at)[3] = (const int32_t(*)[3])r->p->at;
    const int32_t u1 = at[0][1] - at[0][0], u2 = at[0][2] - at[0][0], v1 = at[1][1] - at[1][0],
                  v2 = at[1][2] - at[1][0], d1 = at[2][1] - at[2][0], d2 = at[2][2] - at[2][0];
    const int64_t det = (int64_t)u1 * v2 - (int64_t)u2 * v1;
    const int32_t clz = gn_clz64(gn_abs64(det) | 1U);
    if (clz > 45) return 0; /* 2^-14 texels */
    int32_t recip = (int32_t)(gn_recip_norm2((uint32_t)(gn_abs64(det) << clz >> 32)) >> 1);
    if (det < 0) recip = -recip;
    return quotient_q30((int64_t)d1 * v2 - (int64_t)d2 * v1, clz, recip, &r->gradient_q30[0]) &&
           quotient_q30((int64_t)d2 * u1 - (int64_t)d1 * u2, clz, recip, &r->gradient_q30[1]);
}

/* By how much receivers that read a texel may be deeper than vertex 0, along an axis: below 2^29, as they spread over
 * less than 15 texels of less than 2^25 each. */
GN_HOT static inline int32_t deepest_q30(const receiver_plane *r, int axis, int32_t texel, int32_t reach_q16)
{
    const int32_t g = r->gradient_q30[axis], centre = texel * 65536 + 32768;
    const int32_t at = r->on_plane ? centre
                       : g > 0     ? gn_min32(r->hi[axis], centre + reach_q16)
                                   : gn_max32(r->lo[axis], centre - reach_q16);
    return (int32_t)((int64_t)g * (at - r->p->at[axis][0]) >> 16);
}

/* Whether no texel that receivers read is nearer to the light than any of them: (k + 1) texels around each. Depths are
 * below 2^30 with the margin; on a face's plane, which goes on for 16.6 texels of 2^25 beyond the receivers, below
 * 2^30.6: below 2^31 in all. */
GN_HOT static int texels_behind(const gn_light_view *view, const receiver_plane *r, int32_t k, const int32_t first[2],
                                const int32_t last[2])
{
    const int32_t reach_q16 = (k + 1) << 16, bits = GN_VIEW_BITS(view), n = last[0] - first[0] + 1;
    const int32_t ends = !r->on_plane             ? 0
                         : r->gradient_q30[0] > 0 ? deepest_q30(r, 0, last[0], reach_q16)
                                                  : deepest_q30(r, 0, first[0], reach_q16);
    const int32_t most_q30 = (r->on_plane ? r->p->at[2][0] + ends +
                                                gn_max32(deepest_q30(r, 1, first[1], reach_q16),
                                                         deepest_q30(r, 1, last[1], reach_q16))
                                          : r->hi[2]) +
                             r->margin_q30,
                  from_q30 = r->p->at[2][0] + r->margin_q30;
    if (most_q30 <= 0) return 1;
    const uint32_t most = (uint32_t)gn_min32(most_q30, (1 << 30) - 1) << 2;
    gn_texels row = gn_view_texels(view, first[0], first[1]);
    for (int32_t v = first[1]; v <= last[1]; v++, row = gn_texels_at(row, bits, view->tile_texels)) {
        const int32_t down = from_q30 + deepest_q30(r, 1, v, reach_q16);
        for (int32_t i = n; i-- > 0;) {
            uint32_t texel = gn_texel_load(row, bits, (uint32_t)i);
            if (texel >= most) continue;
            GN_KEEP(texel); /* what follows is seldom asked */
            if ((int32_t)(texel >> 2) < down + deepest_q30(r, 0, first[0] + i, reach_q16) && texel < gn_texel_far(bits))
                return 0;
        }
    }
    return 1;
}

/* Whether the texel at a vertex is nearer to the light than that: the quickest way to tell an edge. */
GN_HOT static inline int hides_vertex(const gn_light_view *view, const vertex_places *p)
{
    const int32_t bits = GN_VIEW_BITS(view);
    for (int k = 0; k < 3; k++) {
        const uint32_t texel = gn_texel_load(gn_view_texels(view, p->at[0][k] >> 16, p->at[1][k] >> 16), bits, 0);
        if ((int32_t)(texel >> 2) < p->at[2][k] && texel < gn_texel_far(bits)) return 1;
    }
    return 0;
}

/* Whether the plane of the receivers says that all of them are lit, where bounds say nothing. Places of pixels are off
 * by less than 2^-10 texels. slope_q28: of the face's plane that taps are compared with, 0 if they are not. */
GN_HOT static GN_NOINLINE int plane_is_lit(const gn_frame *frame, const gn_light_view *view, receiver_plane *r,
                                           const int32_t slope_q28[2])
{
    int64_t bend_q30 = 0;
    const int32_t k = GN_VIEW_REACH(frame, view), end[2] = {view->tile_texels - 1, GN_TILE_ROWS(view) - 1},
                  dropped = gn_dropped_bits(frame, view);
    int32_t first[2], last[2];
    for (int i = 0; i < 2; i++) {
        r->lo[i] -= PLANE_EDGE_Q16;
        r->hi[i] += PLANE_EDGE_Q16;
        first[i] = ((r->lo[i] + 32768) >> 16) - (k + 1);
        last[i] = ((r->hi[i] + 32768) >> 16) + k;
        if (first[i] < 0 || last[i] > end[i] || last[i] - first[i] >= PLANE_TEXELS) return 0;
    }
    if (hides_vertex(view, r->p) || !find_gradient(r)) return 0;
    r->on_plane = GN_PLANES && (slope_q28[0] | slope_q28[1]);
    for (int i = 0; r->on_plane && i < 2; i++) {
        if (gn_abs32(slope_q28[i]) >> 23) return 0;
        const int32_t beyond = r->gradient_q30[i] - slope_q28[i] * 4;
        bend_q30 += ((int64_t)gn_abs32(beyond) * (uint32_t)(r->hi[i] - r->lo[i]) >> 16) + 1;
        r->gradient_q30[i] = slope_q28[i] * 4;
    }
    const uint32_t steep = gn_abs32(r->gradient_q30[0]) + gn_abs32(r->gradient_q30[1]); /* 2^26 */
    const int64_t margin = (int64_t)((dropped ? 1U << (dropped - 1) : 0) >> 2) + (steep >> 10) + bend_q30 + 64;
    r->hi[2] += (int32_t)(steep >> 3);
    if (margin >> 29 || r->lo[2] < -(1 << 28) || r->hi[2] >> 29) return 0;
    r->margin_q30 = (int32_t)margin;
    return texels_behind(view, r, k, first, last);
}

/* What depth bounds of the texels say of all pixels between the vertices: GN_CELL_SPLIT if that does not fit. */
GN_HOT static inline int judge(const gn_frame *frame, const gn_light_view *view, const vertex_places *p,
                               const int32_t slope_q28[2])
{
    receiver_plane r = {.p = p};
    int32_t *lo = r.lo, *hi = r.hi;
    for (int i = 0; i < 3; i++) {
        lo[i] = gn_min32(p->at[i][0], gn_min32(p->at[i][1], p->at[i][2]));
        hi[i] = gn_max32(p->at[i][0], gn_max32(p->at[i][1], p->at[i][2]));
    }
    if (gn_beyond_tile(view, lo[0], hi[0], lo[1], hi[1])) return GN_CELL_LIT;
    const int32_t limit = view->perspective ? 0 : -(1 << 29); /* which bends the plane */
    if (lo[2] <= limit && hi[2] > limit) return GN_CELL_SPLIT;
    if ((gn_abs32(lo[0]) | gn_abs32(hi[0]) | gn_abs32(lo[1]) | gn_abs32(hi[1])) >> 27) return GN_CELL_SPLIT;
    if (view->filter == GN_FILTER_DISK) return GN_CELL_EDGE;
    int64_t slope =
        4 * (int64_t)(GN_VIEW_REACH(frame, view) + 2) * ((int64_t)gn_abs32(slope_q28[0]) + gn_abs32(slope_q28[1]));
    const gn_receiver_step a = {lo[0], lo[1], 2 * (int32_t)gn_clamp64(lo[2] - slope, -(1 << 29), (1 << 30) - 16384)},
                           b = {hi[0], hi[1], 2 * (int32_t)gn_clamp64(hi[2] + slope, -(1 << 29), (1 << 30) - 16384)};
    uint32_t attenuation;
    if (gn_filter_decides(frame, view, &a, &b, &attenuation)) return attenuation ? GN_CELL_LIT : GN_CELL_DARK;
    return plane_is_lit(frame, view, &r, slope_q28) ? GN_CELL_LIT : GN_CELL_EDGE;
}

/* Whether the perspectives of camera and light bend places by less than the tolerance. */
GN_HOT static int vertex_places_hold(const gn_frame *frame, const gn_surface *s, const gn_light_view *view,
                                     const vertex_places *p)
{
    /* in a perspective view places bend on both axes, and by much in tiles of few texels: half of it for each */
    const uint32_t most_q16 = (view->perspective ? 2U : 4U) << (16 - gn_cell_place_log2(frame));
    uint32_t bend_q16 = 0;
    if (!GN_FLAT_Q16(frame))
        bend_q16 = gn_quotient_q30((uint32_t)(s->z_max_q16 - s->z_min_q16), (uint32_t)s->z_min_q16) >> 14;
    if (view->perspective) {
        const int32_t *depth = p->at[2];
        const uint32_t change = gn_cell_spread(depth[0], depth[1], depth[2], depth[2]),
                       rest = (1U << 30) - (uint32_t)gn_max32(depth[0], gn_max32(depth[1], depth[2]));
        if (change > rest >> 1) return 0;
        bend_q16 += gn_quotient_q30(change, rest | 1U) >> 14;
    }
    for (int i = 0; i < 2; i++) {
        const uint32_t across = gn_cell_spread(p->at[i][0], p->at[i][1], p->at[i][2], p->at[i][2]);
        if ((uint64_t)across * bend_q16 >> 16 > most_q16) return 0;
    }
    return 1;
}

/* In between a filter is close to linear: the table of NUMERICS 4.12. Flat surfaces, of two colours, show what that is
 * off by. */
GN_HOT static int32_t find_spacing(const gn_frame *frame, const gn_facet_edge *edge)
{
    uint32_t texels_q16 =
        gn_abs32(edge->u_q16.dx) > gn_abs32(edge->v_q16.dx) ? gn_abs32(edge->u_q16.dx) : gn_abs32(edge->v_q16.dx);
    uint32_t most_q16 = gn_cell_lookup_texels_q16(frame, edge->view);
    if (!most_q16) return 0;
    return 4 * texels_q16 <= most_q16 ? 2 : 2 * texels_q16 <= most_q16;
}

/* In one of the light's views: sets where it sees the vertices, or the face of a cube that does. */
GN_HOT static int judge_in(gn_shading *s, const gn_facet_vertices *vertices, uint32_t slot, const gn_light_view **view,
                           vertex_places *p, int32_t slope_q28[2])
{
    int32_t from[3] = {0, 0, 0};
    int said = s->surface.light[slot].state->kind == GN_LIGHT_DIRECTIONAL
                   ? place_in_ortho(s, slot, *view, p)
                   : place_in_persp(s, vertices, slot, view, p, from);
    if (said != GN_CELL_EDGE) return said;
    GN_COUNT(places, 3);
    gn_shadow_slopes(s->frame, &s->surface, *view, from, slope_q28);
    return judge(s->frame, *view, p, slope_q28);
}

GN_HOT int gn_facet_shadow(gn_shading *s, gn_facet_screen *screen, const gn_facet_vertices *vertices, int32_t n_px,
                           uint32_t slot, gn_facet_edge *edge)
{
    const gn_light_state *light = s->surface.light[slot].state;
    const gn_light_view *first = &s->frame->view[light->view_idx], *view = first;
    const uint32_t views = views_asked(s, light);
    vertex_places p;
    int said = GN_CELL_LIT, before = GN_CELL_SPLIT;
    for (uint32_t left = views; left;) {
        const int32_t next = 31 - gn_clz32(left);
        left &= ~(1U << next);
        view = first + next;
        said = judge_in(s, vertices, slot, &view, &p, edge->slope_q28);
        if (said == GN_CELL_SPLIT || (before != GN_CELL_SPLIT && said != before)) return GN_CELL_SPLIT;
        before = said;
    }
    if (said == GN_CELL_LIT || said == GN_CELL_SPLIT) return said;
    if (s->lattice.views & GN_VIEWS_FADE) return GN_CELL_SPLIT; /* shadows are not what they are near the camera */
    if (said == GN_CELL_DARK) return said;
    if (views & (views - 1) || (n_px > FLAT_EDGE_PX && !GN_SMOOTH(&s->surface)) ||
        !vertex_places_hold(s->frame, &s->surface, view, &p))
        return GN_CELL_SPLIT;
    edge->view = view;
    gn_facet_slope(screen, &edge->u_q16, p.at[0]);
    gn_facet_slope(screen, &edge->v_q16, p.at[1]);
    gn_facet_slope(screen, &edge->depth_q30, p.at[2]);
    edge->spacing_log2 = GN_SMOOTH(&s->surface) ? find_spacing(s->frame, edge) : 0;
    return said;
}

GN_HOT void gn_facet_attenuation(const gn_shading *s, const gn_facet_screen *screen, const gn_facet_edge *edge,
                                 int32_t x, int32_t y, int32_t n, uint32_t *out)
{
    int32_t right = x - screen->x0, down = y - screen->y0, depth_q30 = gn_facet_at(&edge->depth_q30, right, down);
    gn_receiver r = {gn_facet_at(&edge->u_q16, right, down),
                     gn_facet_at(&edge->v_q16, right, down),
                     0,
                     {edge->slope_q28[0], edge->slope_q28[1]},
                     x,
                     y};
    const int32_t log2 = edge->spacing_log2, spacing = 1 << log2;
    for (int32_t i = 0, last = 0;; i += spacing) {
        GN_COUNT(edge_lookups, 1);
        r.depth_q32 = (uint32_t)gn_max32(0, gn_min32(depth_q30, (1 << 30) - 1)) << 2;
        int32_t here = (int32_t)gn_filter_attenuation(s->frame, edge->view, &r);
        for (int32_t k = 1 - spacing; i && k < 0; k++)
            if (i + k < n) out[i + k] = (uint32_t)(here + ((last - here) * -k >> log2));
        if (i < n) out[i] = (uint32_t)here;
        if (i >= n - 1) return;
        last = here;
        r.u_q16 += edge->u_q16.dx * spacing;
        r.v_q16 += edge->v_q16.dx * spacing;
        depth_q30 += edge->depth_q30.dx * spacing;
        r.pixel_x += spacing;
    }
}
#else
GN_HOT int gn_facet_shadow(gn_shading *s, gn_facet_screen *screen, const gn_facet_vertices *vertices, int32_t n_px,
                           uint32_t slot, gn_facet_edge *edge)
{
    (void)s, (void)screen, (void)vertices, (void)n_px, (void)slot, (void)edge;
    return GN_CELL_LIT;
}

GN_HOT void gn_facet_attenuation(const gn_shading *s, const gn_facet_screen *screen, const gn_facet_edge *edge,
                                 int32_t x, int32_t y, int32_t n, uint32_t *out)
{
    (void)s, (void)screen, (void)edge, (void)x, (void)y;
    for (int32_t i = 0; i < n; i++) out[i] = 65536;
}
#endif

#endif
