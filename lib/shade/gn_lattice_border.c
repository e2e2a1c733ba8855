/* Where a cell passes from one view of a light to another. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_lattice_cell.h"
#include "shade/gn_sample.h"

#if GN_INTERPOLATES && GN_SHADOWS && (GN_PUNCTUAL_LIGHTS || GN_MANY_CASCADES)

/* How far inside the first of two faces the corner lies, if positive: |from| along its axis less that along the
 * other's. [P5] */
GN_HOT static int64_t inside_face(const gn_lattice_cell *cell, uint32_t slot, int32_t one, int32_t other,
                                  const gn_corner *c)
{
    int32_t from[3] = {0, 0, 0};
#if GN_PUNCTUAL_LIGHTS
    gn_corner_from(c, cell->s->light[slot].state, from);
#endif
    int64_t ahead = one & 1 ? -(int64_t)from[one >> 1] : from[one >> 1];
    (void)cell, (void)slot, (void)c;
    return ahead - (other & 1 ? -(int64_t)from[other >> 1] : from[other >> 1]);
}

GN_HOT int gn_cell_border(const gn_lattice_cell *cell, uint32_t slot, int32_t one, int32_t other, gn_flat_patch *out)
{
    int32_t inside[4], nearest = INT32_MAX;
    int64_t exact[4], lo = INT64_MAX, hi = INT64_MIN;
    uint64_t all = 1;
    const int cascaded = cell->s->light[slot].state->kind == GN_LIGHT_DIRECTIONAL;
    for (int i = 0; i < 4; i++) {
        const gn_corner *c = cell->corner[i];
        nearest = gn_min32(nearest, c->z_q16);
        exact[i] = cascaded ? gn_sample_inside_q32(cell->frame, c->x, c->y, c->z_q16, one)
                            : inside_face(cell, slot, one, other, c);
        all |= gn_abs64(exact[i]);
        if (exact[i] < lo) lo = exact[i];
        if (exact[i] > hi) hi = exact[i];
    }
    if (cascaded && cell->size_log2 > gn_cell_finest_log2(cell->frame) &&
        gn_cell_bend2_q32(cell) > (uint64_t)(hi - lo) >> cell->size_log2)
        return 0;
    for (int32_t down = gn_max32(36 - gn_clz64(all), 0), i = 0; i < 4; i++) { /* to less than 2^28 */
        uint32_t share_q30 =
            GN_FLAT_Q16(cell->frame) ? 1U << 30 : gn_quotient_q30((uint32_t)nearest, (uint32_t)cell->corner[i]->z_q16);
        inside[i] = (int32_t)((exact[i] >> down) * (int64_t)share_q30 >> 30);
    }
    gn_flat_patch_make(out, inside, cell->size_log2);
    return 1;
}

#endif
