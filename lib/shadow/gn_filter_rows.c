/* Rows of receivers: the same attenuations as pixel by pixel. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_kernel.h"
#include "base/gn_q.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_lookup.h"
#include "shadow/gn_tent.h"

/* The texels that a row of receivers reads along an axis: first, and the last. */
GN_HOT static void reads(const gn_light_view *view, int32_t a_q16, int32_t b_q16, int32_t *first, int32_t *last)
{
    int32_t k = view->filter_idx;
    *first = ((gn_min32(a_q16, b_q16) + 32768) >> 16) - (k + 1);
    *last = ((gn_max32(a_q16, b_q16) + 32768) >> 16) + k;
}

GN_HOT static uint32_t min_passing_depth(const gn_frame *frame, const gn_light_view *view, int32_t depth_q31)
{
    uint32_t depth_q32 = depth_q31 < 0 ? 0 : (uint32_t)depth_q31 << 1;
    return gn_rounded_depth(depth_q32, gn_dropped_bits(frame, view), gn_texel_far(GN_VIEW_BITS(view)));
}

/* Whether texels first .. last along both axes are all lit or all dark for every depth from `least` to `most`. */
GN_HOT static int texels_agree(const gn_light_view *view, const int32_t first[2], const int32_t last[2], uint32_t least,
                               uint32_t most, uint32_t *attenuation)
{
    int32_t bits = GN_VIEW_BITS(view), end = view->tile_texels - 1;
    uint32_t lit = 0, dark = 0, n = (uint32_t)(last[0] - first[0]) + 1;
    if (first[0] < 0 || first[1] < 0 || last[0] > end || last[1] > end) return 0;
    if (GN_DEPTH_BLOCKS && last[0] - first[0] < GN_BLOCK_REACH && last[1] - first[1] < GN_BLOCK_REACH) {
        /* cheaper than one lookup each */
        const gn_depth_block *bounds = gn_blocks_inside(view, first[0], first[1]);
        *attenuation = most <= (uint32_t)bounds->lo << 16 ? 65536 : 0;
        if (*attenuation || least > gn_block_highest(bounds, bits)) return 1;
    }
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
    reads(view, a->u_q16, b->u_q16, &first[0], &last[0]);
    reads(view, a->v_q16, b->v_q16, &first[1], &last[1]);
    int32_t n = gn_max32(last[0] - first[0], last[1] - first[1]) + 1;
    uint32_t least = min_passing_depth(frame, view, gn_min32(a->depth_q31, b->depth_q31));
    uint32_t most = min_passing_depth(frame, view, gn_max32(a->depth_q31, b->depth_q31));
    if (n <= 12) return texels_agree(view, first, last, least, most, attenuation);
    return GN_DEPTH_BLOCKS && n <= 2 * GN_BLOCK_REACH &&
           gn_blocks_decide(view, first[0], first[1], n, least, most, attenuation);
}

/* 2x2 of 16 bits whose texels all lie in the tile. Coordinates half a texel up and left: the bits shifted out are the
 * fraction. */
GN_HOT static void bilinear_row(const gn_frame *frame, const gn_light_view *view, gn_receiver_step at,
                                const gn_receiver_step *step, int32_t n, uint32_t *attenuation)
{
    const uint16_t *texel = view->depth.d16;
    int32_t bits = GN_K(frame, weight_bits), dropped = gn_dropped_bits(frame, view);
    uint32_t pitch = view->tile_texels, log2 = view->tile_log2, one = 1U << bits;
    at.u_q16 -= 32768;
    at.v_q16 -= 32768;
    at.depth_q31 -=
        1 << (dropped - 2); /* plus half a step, minus one step: a texel above this is not below the rounded depth */
    for (uint32_t *end = attenuation + n; attenuation < end; attenuation++) {
        const uint16_t *p = texel + (((uint32_t)at.v_q16 >> 16) << log2) + ((uint32_t)at.u_q16 >> 16), *q = p + pitch;
        int32_t below = at.depth_q31 >> 15; /* lit: the texel is above */
        uint32_t n_lit = (uint32_t)(below - p[0]) >> 31;
        n_lit += (uint32_t)(below - p[1]) >> 31;
        n_lit += (uint32_t)(below - q[0]) >> 31;
        n_lit += (uint32_t)(below - q[1]) >> 31;
        *attenuation = n_lit << 14;
        if (n_lit - 1 < 3) {
            uint32_t wu = gn_filter_fraction(at.u_q16, bits), wv = gn_filter_fraction(at.v_q16, bits);
            uint32_t upper = (p[0] > below ? one - wu : 0) + (p[1] > below ? wu : 0);
            uint32_t lower = (q[0] > below ? one - wu : 0) + (q[1] > below ? wu : 0);
            uint32_t partly = ((one - wv) * upper + wv * lower) << (16 - 2 * bits);
            *attenuation = GN_K(frame, atten_bits) == 8 ? (partly + 128) & ~255U : partly;
        }
        at.u_q16 += step->u_q16;
        at.v_q16 += step->v_q16;
        at.depth_q31 += step->depth_q31;
    }
}

/* The same of 3x3: as tent(), but without bounds. */
GN_HOT static void tent3_row(const gn_frame *frame, const gn_light_view *view, gn_receiver_step at,
                             const gn_receiver_step *step, int32_t n, uint32_t *attenuation)
{
    int32_t bits = GN_K(frame, weight_bits);
    at.u_q16 -= 98304;
    at.v_q16 -= 98304;
    at.depth_q31 -= 1 << (gn_dropped_bits(frame, view) - 2);
    for (uint32_t *end = attenuation + n; attenuation < end; attenuation++) {
        const uint16_t *texel =
            view->depth.d16 + (((uint32_t)at.v_q16 >> 16) << view->tile_log2) + ((uint32_t)at.u_q16 >> 16);
        uint32_t wu[4], wv[4];
        uint8_t dark[4];
        uint32_t found = gn_kernel_dark_texels16(texel, view->tile_texels,
                                                 (uint32_t)gn_max32((at.depth_q31 >> 15) + 1, 0) << 16, 4, dark);
        GN_COUNT(undecided, 1);
        GN_COUNT(taps_tent, 16);
        *attenuation = (found & 0xFFFFU) ? 0 : 65536;
        if ((found & 0xFFFFU) && found >> 16 != 15) {
            gn_tent_weights_inline(wu, 1, gn_filter_fraction(at.u_q16, bits), bits);
            gn_tent_weights_inline(wv, 1, gn_filter_fraction(at.v_q16, bits), bits);
            uint32_t partly =
                gn_weighted_fraction(((uint64_t)81 << 4 * bits) - gn_weighted(dark, 4, wu, wv, 0), 4 * bits, 53024288U);
            *attenuation = GN_K(frame, atten_bits) == 8 ? (partly + 128) & ~255U : partly;
        }
        at.u_q16 += step->u_q16;
        at.v_q16 += step->v_q16;
        at.depth_q31 += step->depth_q31;
    }
}

/* Whether a row may take the fast path: filter, bits and footprint fit. */
GN_HOT static int is_simple(const gn_frame *frame, const gn_light_view *view, const gn_receiver_step *from,
                            const gn_receiver_step *to)
{
    int32_t u, u_last, v, v_last;
    if (GN_FILTER_MAX < 1 || GN_VIEW_BITS(view) != 16) return 0;
    if (GN_FILTER_MAX >= 2 && !GN_SIZE_FIRST && view->filter == GN_FILTER_3X3) {
        if (GN_LINEAR_KERNELS && frame->scene->shadow.kernel == GN_KERNEL_LINEAR) return 0;
    } else if (view->filter != GN_FILTER_2X2 || GN_K(frame, weight_bits) > 8) return 0;
    reads(view, from->u_q16, to->u_q16, &u, &u_last);
    reads(view, from->v_q16, to->v_q16, &v, &v_last);
    return u >= 0 && v >= 0 && u_last < view->tile_texels && v_last < view->tile_texels;
}

GN_HOT void gn_filter_row(const gn_frame *frame, const gn_light_view *view, const gn_receiver_step *from,
                          const gn_receiver_step *to, const gn_receiver_step *step, int32_t n, uint32_t *attenuation)
{
    gn_receiver_step at = *from;
    int simple = is_simple(frame, view, from, to);
    if (simple && view->filter == GN_FILTER_2X2) {
        bilinear_row(frame, view, at, step, n, attenuation);
        return;
    }
    uint32_t all;
    if (n > 2 && gn_filter_decides(frame, view, from, to, &all)) {
        for (int32_t i = 0; i < n; i++) attenuation[i] = all;
        return;
    }
    if (GN_FILTER_MAX >= 2 && !GN_SIZE_FIRST && simple) {
        tent3_row(frame, view, at, step, n, attenuation);
        return;
    }
    for (int32_t i = 0; i < n; i++) {
        gn_receiver r = {at.u_q16, at.v_q16, at.depth_q31 < 0 ? 0 : (uint32_t)at.depth_q31 << 1, {0, 0}, 0, 0};
        attenuation[i] = gn_filter_attenuation(frame, view, &r);
        if (i + 1 == n) return; /* beyond the last pixel the step may leave the range */
        at.u_q16 += step->u_q16;
        at.v_q16 += step->v_q16;
        at.depth_q31 += step->depth_q31;
    }
}
