/* Casters that lie outside of a view, by their boxes. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shadow/gn_atlas.h"
#include "shadow/gn_caster.h"

/* Half extent of a box along an axis, Q16, rounded up. */
static int64_t extent_q16(const int32_t axis_q30[3], const int32_t half_q16[3])
{
    uint64_t sum = 0; /* sqrt(3) * 2^61 */
    for (int k = 0; k < 3; k++) sum += (uint64_t)gn_abs32(axis_q30[k]) * (uint32_t)half_q16[k];
    return (int64_t)(sum >> 30) + 1;
}

/* Casters before the near plane count, those beyond the range do not. [D9] */
static int ortho_sees(const gn_frame *frame, const gn_light_view *view, const gn_object_state *object)
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

static int persp_sees(const gn_frame *frame, const gn_light_view *view, const gn_object_state *object)
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
