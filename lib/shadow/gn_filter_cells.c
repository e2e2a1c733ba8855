/* What texels decide for all receivers of a cell. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_lookup.h"

/* The texels that a row of receivers reads along an axis: first, and the last. */
GN_HOT static void reads(const gn_frame *frame, const gn_light_view *view, int32_t a_q16, int32_t b_q16, int32_t *first,
                         int32_t *last)
{
    int32_t k = GN_VIEW_REACH(frame, view);
    *first = ((gn_min32(a_q16, b_q16) + 32768) >> 16) - (k + 1);
    *last = ((gn_max32(a_q16, b_q16) + 32768) >> 16) + k;
}

GN_HOT static uint32_t min_passing_depth(const gn_light_view *view, int32_t depth_q31)
{
    uint32_t depth_q32 = depth_q31 < 0 ? 0 : (uint32_t)depth_q31 << 1;
    return gn_rounded_depth(depth_q32, gn_dropped_bits(view), gn_texel_far(GN_VIEW_BITS(view)));
}

/* Along an axis: more are dearer to compare than lookups. */
enum { MOST_TEXELS = 18 };

/* Whether texels first .. last along both axes are all lit or all dark for every depth from `least` to `most`. */
GN_HOT static int texels_agree(const gn_light_view *view, const int32_t first[2], const int32_t last[2], uint32_t least,
                               uint32_t most, uint32_t *attenuation)
{
    int32_t bits = GN_VIEW_BITS(view);
    uint32_t lit = 0, dark = 0, n = (uint32_t)(last[0] - first[0]) + 1;
    gn_texels row = gn_view_texels(view, first[0], first[1]);
    for (int32_t v = first[1]; v <= last[1]; v++, row = gn_texels_at(row, bits, view->tile_texels)) {
        for (uint32_t i = 0; i < n; i++) {
            uint32_t texel = gn_texel_load(row, bits, i);
            if (texel >= most) lit = 1;
            else if (texel < least) dark = 1;
            else return 0;
        }
        if (lit & dark) return 0;
    }
    *attenuation = lit << 16;
    return 1;
}

GN_HOT int gn_filter_decides(const gn_frame *frame, const gn_light_view *view, const gn_receiver_step *a,
                             const gn_receiver_step *b, uint32_t *attenuation)
{
    int32_t first[2], last[2];
    reads(frame, view, a->u_q16, b->u_q16, &first[0], &last[0]);
    reads(frame, view, a->v_q16, b->v_q16, &first[1], &last[1]);
    int32_t n = gn_max32(last[0] - first[0], last[1] - first[1]) + 1, beyond = 0;
    const int32_t end[2] = {view->tile_texels - 1, GN_TILE_ROWS(view) - 1};
    uint32_t least = min_passing_depth(view, gn_min32(a->depth_q31, b->depth_q31));
    uint32_t most = min_passing_depth(view, gn_max32(a->depth_q31, b->depth_q31));
    if (n > MOST_TEXELS) return 0;
    GN_UNROLL
    for (int i = 0; i < 2; i++) { /* beyond the border texels repeat it, or are lit */
        beyond |= first[i] < 0 || last[i] > end[i];
        first[i] = gn_max32(0, gn_min32(first[i], end[i]));
        last[i] = gn_max32(0, gn_min32(last[i], end[i]));
    }
    return texels_agree(view, first, last, least, most, attenuation) &&
           (*attenuation || !beyond || !gn_border_lit(view));
}
