/* Spot and point lights on small triangles. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_corner.h"
#include "shade/gn_facet_punctual.h"
#include "shade/gn_lattice_cell.h"

#if GN_INTERPOLATES && GN_PUNCTUAL_LIGHTS

/* Along the world's axes: from the eye, and the normal. */
GN_HOT static void turn_to_world(gn_facet_vertices *out, const gn_frame *frame, const gn_surface *s, int k)
{
    const int32_t(*axis)[3] = (const int32_t(*)[3])frame->cam.axis_q30, *v = s->v_q16[k];
    const int more = k && GN_SMOOTH(s);
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        const int64_t at = (int64_t)axis[0][i] * v[0] + (int64_t)axis[1][i] * v[1] + (int64_t)axis[2][i] * v[2];
        out->ray_q16[k][i] = (int32_t)(at >> 30);
        out->normal_q30[k][i] = s->normal_q30[0][i] + (more ? s->normal_q30[k][i] : 0);
    }
}

GN_HOT static uint64_t between2_q32(const int32_t a[3], const int32_t b[3])
{
    const int32_t d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return (uint64_t)gn_dot64(d, d);
}

GN_HOT static inline uint64_t longest2_of(const gn_facet_vertices *v)
{
    return (uint64_t)v->longest2_high << 32 | v->longest2_low;
}

GN_HOT int gn_facet_vertices_find(gn_facet_vertices *out, const gn_frame *frame, const gn_surface *surface,
                                  const uint32_t turn_q28[3])
{
    const int32_t(*v)[3] = (const int32_t(*)[3])surface->v_q16;
    uint32_t all = 0;
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        all |= gn_abs32(v[k][0]) | gn_abs32(v[k][1]) | gn_abs32(v[k][2]);
        turn_to_world(out, frame, surface, k);
    }
    if (all >> 29) return 0;
    const uint64_t a = between2_q32(v[0], v[1]), b = between2_q32(v[1], v[2]), c = between2_q32(v[2], v[0]);
    const uint64_t longer = a > b ? a : b;
    const uint64_t longest = longer > c ? longer : c;
    out->longest2_high = (uint32_t)(longest >> 32);
    out->longest2_low = (uint32_t)longest;
    out->turn2_q28 = turn_q28[0] > turn_q28[1] ? turn_q28[0] : turn_q28[1];
    if (turn_q28[2] > out->turn2_q28) out->turn2_q28 = turn_q28[2];
    return 1;
}

/* A light at the vertices. */
typedef struct {
    const gn_light_state *light;
    uint64_t d2_q32[3], nearest_q32, farthest_q32; /* squares of their distances */
    int32_t from_q16[3][3];
    int has_rim;
} light_at_vertices;

/* Returns 0 if the light is near, beside the triangle's size, or out of reach. */
GN_HOT static int find_distances(light_at_vertices *at, const gn_frame *frame, const gn_facet_vertices *v)
{
    at->nearest_q32 = UINT64_MAX;
    at->farthest_q32 = 0;
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        uint32_t beyond = 0;
        GN_UNROLL
        for (int i = 0; i < 3; i++) {
            at->from_q16[k][i] = v->ray_q16[k][i] + (int32_t)at->light->from_light[i].d_q16; /* 2^30 and 2^30 */
            beyond |= (uint32_t)at->from_q16[k][i] + (1U << 30);
        }
        if (beyond >> 31) return 0;
        at->d2_q32[k] = (uint64_t)gn_dot64(at->from_q16[k], at->from_q16[k]);
        if (at->d2_q32[k] < at->nearest_q32) at->nearest_q32 = at->d2_q32[k];
        if (at->d2_q32[k] > at->farthest_q32) at->farthest_q32 = at->d2_q32[k];
    }
    return longest2_of(v) <= at->nearest_q32 >> 4 && at->nearest_q32 >= 2 * frame->min2_q32 && !(at->nearest_q32 >> 62);
}

/* By how much light is off that is linear between the vertices: NUMERICS 4.17. */
GN_HOT static uint32_t error_q24(const gn_facet_vertices *v, const light_at_vertices *at)
{
    enum { FAR_Q8 = 672, FADES_Q8 = 1210, ENDS_Q8 = 2240 };
    const gn_light_state *light = at->light;
    const uint64_t range2 = light->range2_q32;
    const int32_t clz = gn_clz64(at->nearest_q32), down = 69 - clz - light->colour_exp;
    const uint32_t per_nearest = gn_recip_norm((uint32_t)(at->nearest_q32 << clz >> 32), 1);  /* 2^63 over that */
    const uint32_t size2_q30 = (uint32_t)((longest2_of(v) << clz >> 32) * per_nearest >> 33); /* 2^26 */
    const uint32_t bend_q8 = at->farthest_q32 <= range2 >> 3              ? FAR_Q8
                             : at->farthest_q32 <= range2 - (range2 >> 2) ? FADES_Q8
                                                                          : ENDS_Q8;
    uint64_t share_q30 = ((uint64_t)size2_q30 * bend_q8 >> 8) + v->turn2_q28 / 3 + 1;
    if (at->has_rim) share_q30 += gn_corner_rim_q30(light, size2_q30 >> 1); /* 2/5, and 2^48 */
    if (down < 0 || share_q30 >> 30) return 1U << 27;
    const uint64_t error = down > 63 ? 0 : per_nearest * share_q30 >> down;
    return error >> 27 ? 1U << 27 : (uint32_t)error + 1;
}

/* Whether that is too much beside what arrives at all; on more pixels it is seen sooner. */
GN_HOT static int is_uneven(const gn_frame *frame, const gn_surface_light *light, uint32_t error, int32_t least_q24,
                            int32_t base_q24, int32_t size_log2)
{
    const uint32_t strongest = gn_cell_strongest(light->radiance_uq16);
    const uint64_t seen = (uint64_t)gn_corner_times(strongest, gn_max32(least_q24, 0)) + (uint32_t)base_q24 + (1 << 19);
    const int32_t log2 = gn_max32(gn_cell_light_log2(frame), 1 - gn_cell_sum_log2(frame)) + size_log2 + (size_log2 > 0);
    return (uint64_t)gn_corner_times(strongest, (int32_t)error) << log2 > seen;
}

GN_HOT int gn_facet_punctual(gn_shading *s, const gn_facet_vertices *v, uint32_t slot, int32_t base_q24,
                             int32_t size_log2, gn_facet_lamp *out)
{
    enum { ONE_Q20 = 1 << 20 };
    const gn_surface_light *light = &s->surface.light[slot];
    light_at_vertices at = {.light = light->state};
    int32_t least = INT32_MAX, most = INT32_MIN, inner = 1, outer = 1;
    if (!find_distances(&at, s->frame, v)) return GN_CELL_SPLIT;
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        gn_corner_light *scratch = &s->lattice.corner.light[slot];
        const int32_t away = (int32_t)(gn_dot64(v->normal_q30[k], at.from_q16[k]) >> 30); /* both are below 2^31 */
        out->rim_q20[k] = ONE_Q20;
        const int32_t e = gn_corner_irradiance(s->frame, light->state, at.from_q16[k], at.d2_q32[k],
                                               (int32_t)gn_abs32(away) | 1, scratch, &out->rim_q20[k]);
        out->irradiance_q24[k] = away > 0 ? -e : e;
        least = gn_min32(least, out->irradiance_q24[k]);
        most = gn_max32(most, out->irradiance_q24[k]);
        inner &= out->rim_q20[k] >= ONE_Q20;
        outer &= out->rim_q20[k] <= 0;
    }
    out->has_rim = at.has_rim = !inner;
    out->error_q24 = 0;
    if (at.nearest_q32 - (longest2_of(v) >> 1) >= light->state->range2_q32) return GN_CELL_DARK;
    out->error_q24 = error_q24(v, &at);
    if (most < 0 && (uint32_t)-most >= out->error_q24) return GN_CELL_DARK;
    if (is_uneven(s->frame, light, out->error_q24, least, base_q24, size_log2)) return GN_CELL_SPLIT;
    return most > 0 && !outer ? GN_CELL_LIT : GN_CELL_DARK;
}

#endif
