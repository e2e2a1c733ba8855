/* How uneven a cell is. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_lattice.h"

#if GN_INTERPOLATES

/* ---- Limits ------------------------------------------------------------------------------------------------------ */

GN_HOT GN_NOINLINE int gn_cell_is_limited(const gn_surface *s, const uint32_t colour_uq16[3], int32_t most_q24)
{
    if (!s->textured && !GN_COLOURED(s)) return 0;
    return most_q24 >= 1 << 27 || (uint64_t)gn_cell_strongest(colour_uq16) * (uint32_t)gn_max32(most_q24, 0) >> 43;
}

GN_HOT GN_NOINLINE int gn_cell_hides(const uint32_t colour_uq16[3], int32_t most_q24, uint32_t share_uq16)
{
    if (most_q24 < 1 << 27 || !share_uq16) return 0;
    for (int c = 0; c < 3; c++)
        if (colour_uq16[c] && (uint64_t)colour_uq16[c] * share_uq16 >> 29 == 0) return 1;
    return 0;
}

/* ---- Geometry ---------------------------------------------------------------------------------------------------- */

/* Returns 0 if the cell is seen so steeply that nothing is close to bilinear. */
GN_HOT int gn_cell_find_bend(gn_lattice_cell *cell)
{
    gn_corner *const *c = cell->corner;
    if ((c[0]->state | c[1]->state | c[2]->state | c[3]->state) != GN_CORNER_KNOWN) return 0;
    const int32_t z[4] = {c[0]->z_q16, c[1]->z_q16, c[2]->z_q16, c[3]->z_q16}, flat = GN_FLAT_Q16(cell->frame);
    uint32_t least = (uint32_t)(flat ? flat : gn_min32(gn_min32(z[0], z[1]), gn_min32(z[2], z[3]))), more[2];
    gn_cell_changes(z, more);
    GN_UNROLL
    for (int i = 0; i < 2; i++) {
        if (more[i] > least >> 2) return 0;
        if (flat) continue; /* parallel rays bend nothing, but light and shadows may be passed over */
        cell->bend_q16[i] = more[i] ? gn_quotient_q30(more[i], least) >> 14 : 0;
    }
    return 1;
}

#if GN_SHADOWS
/* What one side of a cell adds: the square of its length, from a depth on. */
GN_HOT static uint64_t side2_q32(const gn_frame *frame, const gn_corner *a, const gn_corner *b, int32_t size_log2)
{
    int64_t dz = (int64_t)a->z_q16 - b->z_q16, z = gn_max32(a->z_q16, b->z_q16);
    if (GN_FLAT_Q16(frame)) z = GN_FLAT_Q16(frame);
    uint64_t tan2_q24 = ((uint64_t)frame->tan2_per_px2_q44 + 1) << (2 + 2 * size_log2) >> 20; /* 2^8 half pixels */
    return (uint64_t)(dz * dz) + ((uint64_t)(z * z) >> 24) * (tan2_q24 + 1);
}

GN_HOT uint64_t gn_cell_bend2_q32(const gn_lattice_cell *cell)
{
    gn_corner *const *c = cell->corner;
    return (side2_q32(cell->frame, c[0], c[1], cell->size_log2) +
            side2_q32(cell->frame, c[0], c[2], cell->size_log2)) >>
           2;
}

GN_HOT int gn_cell_ramp_bends(const gn_lattice_cell *cell)
{
    const gn_frame *frame = cell->frame;
    gn_corner *const *c = cell->corner;
    if ((c[0]->fade_uq16 & c[1]->fade_uq16 & c[2]->fade_uq16 & c[3]->fade_uq16) == 65536) return 0;
    uint64_t bend_q32 = gn_cell_bend2_q32(cell);
    for (int i = 0; i < 4; i++) {
        if (c[i]->cascade >= GN_CASCADE_NONE) continue;
        const gn_cascade_state *cascade = &frame->cascade[c[i]->cascade];
        if (bend_q32 > (cascade->radius2_q32 - cascade->inner2_q32) >> 4) return 1;
    }
    return 0;
}
#endif

/* ---- How uneven light is ----------------------------------------------------------------------------------------- */

#if GN_VERTEX_NORMALS
/* The longer diagonal of vectors at the corners, along the axes. */
GN_HOT static uint32_t diagonal(const int32_t *a, const int32_t *b, const int32_t *c, const int32_t *d)
{
    uint64_t one = 0, other = 0;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        one += gn_abs64((int64_t)a[i] - d[i]);
        other += gn_abs64((int64_t)b[i] - c[i]);
    }
    if (other > one) one = other;
    return one > UINT32_MAX ? UINT32_MAX : (uint32_t)one;
}
#endif

/* How far normals, which are not renormalised, turn over the cell, summed over the axes, Q12. */
GN_HOT static uint32_t turn_q12(const gn_lattice_cell *cell)
{
#if GN_VERTEX_NORMALS
    gn_corner *const *c = cell->corner;
    if (GN_SMOOTH(cell->s))
        return diagonal(c[0]->normal_q30, c[1]->normal_q30, c[2]->normal_q30, c[3]->normal_q30) >> 18;
#endif
    (void)cell;
    return 0;
}

/* Whether normals turn by so little that light between the corners is near to theirs, whatever size the cell has: by
 * up to 7/8, summed over the axes. A cell can be larger than a triangle, whose normals at corners outside it have
 * turned further. */
GN_HOT int gn_cell_normals_hold(const gn_lattice_cell *cell)
{
    return !cell->s->n_lights || turn_q12(cell) <= 7U << 9; /* without lights corners have no normals */
}

#if GN_PUNCTUAL_LIGHTS
/* Once per cell, the same for all lights: squares of its longest sides along rows and down columns, a quarter of their
 * sum. Rays are below 2^30. */
GN_HOT static uint64_t sides_q30(gn_lattice_cell *cell)
{
    gn_corner *const *c = cell->corner;
    uint64_t longest[2] = {0, 0};
    if (cell->sides_q30) return cell->sides_q30;
    GN_UNROLL
    for (int k = 0; k < 4; k++) { /* upper, left, right, lower */
        const int32_t *a = c[k & 2 ? k - 1 : 0]->ray_q16, *b = c[k & 2 ? 3 : k + 1]->ray_q16;
        const int32_t side[3] = {(b[0] - a[0]) >> 1, (b[1] - a[1]) >> 1, (b[2] - a[2]) >> 1};
        uint64_t *most = &longest[k == 1 || k == 2], square = (uint64_t)gn_dot64(side, side);
        if (square > *most) *most = square;
    }
    cell->sides_q30 = longest[0] + longest[1] + 16;
    return cell->sides_q30;
}

/* a / b, a < b */
GN_HOT static uint32_t ratio_q30(uint64_t a, uint64_t b)
{
    int32_t down = gn_max32(32 - gn_clz64(b), 0);
    return gn_quotient_q30((uint32_t)(a >> down), (uint32_t)(b >> down));
}

GN_HOT static uint64_t share_q30_of(uint64_t v, uint32_t share_q30)
{
    return (v >> 30) * share_q30 + ((v & ((1U << 30) - 1)) * share_q30 >> 30);
}

/* Squares of the corners' distances from a light: the least, and the largest. */
typedef struct {
    uint64_t nearest_q32, farthest_q32;
    int is_far; /* the cell is small beside them */
} light_distance;

GN_HOT static void find_distance(gn_lattice_cell *cell, const gn_light_state *light, light_distance *d)
{
    d->nearest_q32 = UINT64_MAX;
    d->farthest_q32 = 0;
    GN_UNROLL
    for (int i = 0; i < 4; i++) {
        int32_t p[3];
        gn_corner_from(cell->corner[i], light, p);
        uint64_t square = (uint64_t)((int64_t)p[0] * p[0]) + (uint64_t)((int64_t)p[1] * p[1]);
        square += (uint64_t)((int64_t)p[2] * p[2]);
        if (square < d->nearest_q32) d->nearest_q32 = square;
        if (square > d->farthest_q32) d->farthest_q32 = square;
    }
    d->is_far = sides_q30(cell) < d->nearest_q32 >> 4 && !(d->nearest_q32 >> 62);
}

/* Whether a light is so near that it may be much brighter between the corners. */
GN_HOT static int light_is_near(const gn_lattice_cell *cell, const light_distance *d)
{
    return cell->sides_q30 >= d->nearest_q32 >> 2;
}

/* Never misses light_is_near(): one corner is at most the cell's diagonal farther away than the nearest, its square
 * below 24 sides_q30. */
GN_HOT static int light_may_be_near(gn_lattice_cell *cell, const gn_light_state *light)
{
    int32_t p[3];
    gn_corner_from(cell->corner[0], light, p);
    return gn_distance2_q32(p) >> 5 < sides_q30(cell);
}

/* How much a light bends over its distance, K of NUMERICS 4.12, Q8. */
GN_HOT static uint32_t curvature_q8(const gn_lattice_cell *cell, const gn_light_state *light, const light_distance *d)
{
    int32_t p[3];
    if (d->farthest_q32 > light->range2_q32 >> 2)
        return d->farthest_q32 + (d->farthest_q32 >> 1) <= light->range2_q32 ? 20 << 8 : 34 << 8;
    int near = d->farthest_q32 <= light->range2_q32 >> 3;
    uint32_t most = near ? 14 << 8 : 16 << 8, least = near ? 5 << 8 : 6 << 8;
    if (GN_SMOOTH(cell->s)) return most;
    gn_corner_from(cell->corner[0], light, p);
    uint64_t height = gn_abs64(gn_dot_q30(cell->s->normal_q30[0], p)), square = height * height;
    if (square >= d->farthest_q32) return least;
    uint32_t less = ratio_q30(square, d->farthest_q32) >> 18; /* Q12 */
    less = less * 13 >> 4;
    return less > most - least ? least : most - less;
}

/* How far interpolation is off of a spot or point light, as a share of the most at a corner: up to 1, or 4. */
GN_HOT static GN_NOINLINE uint32_t bend_q30(gn_lattice_cell *cell, const gn_light_state *light, const light_distance *d)
{
    if (!d->is_far || d->nearest_q32 >= light->range2_q32) return UINT32_MAX;
    uint64_t of = d->nearest_q32 - (cell->sides_q30 * 11 >> 2);
    uint64_t bend = ((cell->sides_q30 >> 9) + 1) * curvature_q8(cell, light, d);
    if (d->farthest_q32 > light->range2_q32 >> 3)
        of = share_q30_of(of, (uint32_t)gn_punctual_window_q30(light, d->nearest_q32));
    return bend >= of ? UINT32_MAX : ratio_q30(bend, of);
}

/* The same of normals that turn, too. */
GN_HOT static GN_NOINLINE uint32_t bend_of_smooth_q30(uint32_t flat_q30, uint32_t turn_q12)
{
    if (flat_q30 == UINT32_MAX) return flat_q30;
    int32_t up = gn_clz32(flat_q30 | 1U) & ~1;
    uint32_t m = (flat_q30 | 1U) << up, root_q31 = gn_umul_high(m, gn_rsqrt_norm(m, 1));
    uint32_t t_q12 = turn_q12 + (root_q31 >> gn_min32(18 + (up >> 1), 31)) + 1;
    return t_q12 >= 1 << 13 ? UINT32_MAX : t_q12 * t_q12 << 6;
}

/* The least of n . p at the corners, or of -n . p. Nothing between them has less. */
GN_HOT static int64_t least_along(const int32_t n_q30[3], int32_t p[4][3], int sign)
{
    int64_t least = INT64_MAX;
    for (int i = 0; i < 4; i++) {
        int64_t at = sign * gn_dot_q30(n_q30, p[i]);
        if (at < least) least = at;
    }
    return least;
}

/* The square of the cell's size over its distance from a light, Q24, up to 4. */
GN_HOT static uint32_t size2_q24(const gn_lattice_cell *cell, const light_distance *d)
{
    if (!d->is_far) return 4 << 24;
    return (ratio_q30(4 * cell->sides_q30, d->nearest_q32 - (cell->sides_q30 * 17 >> 4)) >> 6) + 1;
}

/* Squares of both diagonals of the corners' positions, a quarter of their sum: the points of a cell scatter about their
 * mean by no more. */
GN_HOT static uint64_t scatter_q32(int32_t p[4][3])
{
    uint64_t sum = 0;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        int64_t one = ((int64_t)p[3][i] - p[0][i]) >> 1, other = ((int64_t)p[2][i] - p[1][i]) >> 1;
        sum += (uint64_t)(one * one) + (uint64_t)(other * other);
    }
    return sum + 16;
}

/* Whether all of the cell faces away from a light: n . p is that of the corners in the mean, less what both scatter by.
 */
GN_HOT static int faces_away(gn_lattice_cell *cell, int32_t p[4][3])
{
    if (!GN_SMOOTH(cell->s)) return least_along(cell->s->normal_q30[0], p, 1) >= 0;
#if GN_VERTEX_NORMALS
    int64_t least = INT64_MAX;
    GN_UNROLL
    for (int i = 0; i < 4; i++) {
        int64_t away = gn_dot_q30(cell->corner[i]->normal_q30, p[i]);
        if (away < least) least = away;
    }
    gn_corner *const *c = cell->corner;
    uint64_t turn = turn_q12(cell), size = diagonal(c[0]->ray_q16, c[1]->ray_q16, c[2]->ray_q16, c[3]->ray_q16);
    return least > (int64_t)(turn * size >> 14) + 16;
#else
    return 0;
#endif
}

/* Whether nothing of a light arrives anywhere in the cell if nothing arrives at its corners. The squares of a point's
 * distance, and of its distance along the axis, are those of the corners in the mean, less what they scatter by. */
GN_HOT GN_NOINLINE int gn_cell_stays_dark(gn_lattice_cell *cell, uint32_t slot)
{
    const gn_light_state *light = cell->s->light[slot].state;
    int32_t p[4][3];
    uint64_t d2[4], nearest = UINT64_MAX;
    for (int i = 0; i < 4; i++) {
        gn_corner_from(cell->corner[i], light, p[i]);
        if ((gn_abs32(p[i][0]) | gn_abs32(p[i][1]) | gn_abs32(p[i][2])) >> 30) return 0;
        d2[i] = (uint64_t)gn_dot64(p[i], p[i]);
        if (d2[i] < nearest) nearest = d2[i];
    }
    if (faces_away(cell, p)) return 1;
    uint64_t scatter = scatter_q32(p);
    if (nearest >= scatter && nearest - scatter >= light->range2_q32) return 1;
    if (light->kind != GN_LIGHT_SPOT) return 0;
    uint32_t cos2_q30 = (uint32_t)((uint64_t)light->cos_outer_q30 * (uint64_t)light->cos_outer_q30 >> 30);
    for (int i = 0; i < 4; i++) {
        int64_t along = gn_dot_q30(p[i], light->to_light_q30);
        if (d2[i] < scatter || share_q30_of(d2[i] - scatter, cos2_q30) < (uint64_t)(along * along) + 65536) return 0;
    }
    return 1;
}

/* The most that a light can give in the cell where its cone is full: by the distance alone, a power of two. Along a
 * normal that does not turn nothing is nearer than the nearest corner. */
GN_HOT static uint32_t full_light_q24(const gn_lattice_cell *cell, const gn_light_state *light, const light_distance *d)
{
    uint64_t nearer = 3 * cell->sides_q30, least = cell->frame->min2_q32;
    if (d->nearest_q32 > nearer && d->nearest_q32 - nearer > least) least = d->nearest_q32 - nearer;
    if (!GN_SMOOTH(cell->s)) {
        int32_t p[4][3];
        for (int i = 0; i < 4; i++) gn_corner_from(cell->corner[i], light, p[i]);
        int64_t above = least_along(cell->s->normal_q30[0], p, -1), below = least_along(cell->s->normal_q30[0], p, 1);
        const uint64_t height = (uint64_t)gn_clamp64(above > below ? above : below, 0, UINT32_MAX);
        if (height * height > least) least = height * height;
    }
    return 1U << gn_max32(gn_min32(gn_clz64(least) - 7 + light->colour_exp, 27), 0);
}

/* How far interpolation is off in the rim of a cone, whose factor is the square of a share. `lo`, `hi`: how the light
 * arrives at the corners, but for GN_CORNER_DARK; `unit_q24`: what arrives at a share of 1/32. */
GN_HOT static GN_NOINLINE uint32_t rim_error_q24(const gn_light_state *light, int32_t lo, int32_t hi, uint32_t unit_q24,
                                                 uint32_t change_q24, uint32_t size2_q24)
{
    enum { WHOLE = 32 };
    uint32_t top = (uint32_t)gn_max32(gn_min32(hi, WHOLE), 1), across = top - (uint32_t)lo + 1, square = top * top;
    uint32_t error_q10 = across * across >> 2, error_q24 = change_q24;
    if (hi >= WHOLE) { /* and where the rim ends */
        uint32_t before = (uint32_t)(WHOLE - lo), beyond = (uint32_t)(hi + 1 - WHOLE);
        error_q10 += 2 * WHOLE * before * beyond / (before + beyond);
    }
    if (error_q10 < square && unit_q24 * error_q10 < change_q24) error_q24 = unit_q24 * error_q10;
    uint64_t bent_q30 = gn_punctual_rim_q30(light, size2_q24 * 32); /* of the cosine, 5/32 of the square */
    uint32_t bent_q10 = bent_q30 >> 30 ? 1U << 10 : (uint32_t)(bent_q30 >> 20);
    bent_q10 = bent_q10 * 2 * top / WHOLE + (bent_q10 * bent_q10 >> 10); /* (q + bent)^2 - q^2 */
    uint64_t more_q24 = (uint64_t)unit_q24 * (bent_q10 >> 10 ? 1U << 10 : bent_q10);
    return error_q24 + (more_q24 >> 28 ? 1U << 28 : (uint32_t)more_q24);
}
#endif

/* How far interpolation is off where a surface turns away from a directional light: the cosine has an edge at 0. */
GN_HOT static uint32_t terminator_error_q24(int32_t lo, uint32_t most_q24)
{
    uint32_t away_q14 = (uint32_t)(1 - lo) << 7, most_q14 = (most_q24 >> 10) + 1;
    return away_q14 * most_q14 / (away_q14 + most_q14) << 10;
}

/* How far interpolation between the corners is off, of a light's irradiance: NUMERICS 4.12. *kink: because it ends in
 * the cell, or its cone does, or it is near. */
GN_HOT uint32_t gn_cell_unevenness_q24(gn_lattice_cell *cell, uint32_t slot, int32_t least_q24, int32_t most_q24,
                                       uint32_t *kink_q24)
{
    const gn_light_state *light = cell->s->light[slot].state;
    uint32_t change = (uint32_t)(most_q24 - least_q24), kink = 0, bend = 0, seen = 0,
             turn = turn_q12(cell) << gn_cell_turn_log2(cell->frame) >> 1;
    int32_t lo = GN_CORNER_FULLY, hi = 0, dark = 0;
    GN_UNROLL
    for (int i = 0; i < 4; i++) {
        int32_t at = cell->corner[i]->light[slot].arrives;
        hi = gn_max32(hi, at);
        if (at == GN_CORNER_DARK) dark = 1;
        else lo = gn_min32(lo, at);
    }
    if (dark) kink = GN_SMOOTH(cell->s) ? 3 * change : change;
    else if (lo <= 0 && light->kind == GN_LIGHT_DIRECTIONAL) kink = 3 * terminator_error_q24(lo, (uint32_t)most_q24);
    int asked = cell->size_log2 > gn_cell_finest_log2(cell->frame);
    if (asked) bend = turn > 1 << 12 ? 1U << 30 : turn * turn << 6;
#if GN_PUNCTUAL_LIGHTS
    int ends = light->kind == GN_LIGHT_SPOT && lo < 32;
    if (light->kind != GN_LIGHT_DIRECTIONAL && (ends || asked || light_may_be_near(cell, light))) {
        light_distance d;
        find_distance(cell, light, &d);
        if (asked) bend = bend_q30(cell, light, &d);
        if (asked && turn) bend = bend_of_smooth_q30(bend, turn);
        seen = (uint32_t)((uint64_t)change * (cell->bend_q16[0] + cell->bend_q16[1]) >> 18);
        if (ends) { /* twice: it comes close to this bound. A share below 2/32 does not tell how bright the cone is */
            uint32_t top = (uint32_t)gn_min32(hi, 32);
            uint32_t unit = top > 1 ? (uint32_t)most_q24 / (top * top) : full_light_q24(cell, light, &d) >> 10;
            kink += 2 * rim_error_q24(light, lo, hi, unit, change, size2_q24(cell, &d));
        }
        if (light_is_near(cell, &d))
            kink += full_light_q24(cell, light, &d); /* corners need not see how bright it is */
    }
#endif
    (void)hi;
    if (!asked && light->kind != GN_LIGHT_DIRECTIONAL && kink < change >> 1) kink = change >> 1;
    *kink_q24 = kink;
    return kink + seen + (uint32_t)((uint64_t)(uint32_t)most_q24 * bend >> 30);
}

#endif
