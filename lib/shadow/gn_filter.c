/* Percentage-closer filtering. Compares come first, weights are exact integers, one division by multiplication ends it.
 */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_kernel.h"
#include "base/gn_q.h"
#include "base/gn_tables.h"
#include "shadow/gn_blocks.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_texel.h"

#if GN_SHADOWS

/* Whether texels outside the tile are lit (D10). */
#if GN_MAIN_LIGHT
#define BORDER_LIT(view) ((view)->border_lit)
#else
#define BORDER_LIT(view) ((void)(view), 0)
#endif

/* A receiver made ready for its taps. A texel, in the upper bits of 32, is lit if it is not below `least`: the
 * receiver's depth rounded to the bits of the view and depth_frac, at most that of an empty texel. */
typedef struct {
    const gn_light_view *view;
    int32_t u_q16, v_q16;
    uint32_t least;
#if GN_RECEIVER_PLANE
    int32_t sloped;
    int32_t slope_q28[2];
    int64_t least_q32; /* on the plane, at the texel that (u, v) lies in, not limited */
#endif
} lookup;

/* ---- The receiver's depth ---------------------------------------------------------------------------------------- */

/* Bits of depth_q32 that rounding drops: 0, or at least 12. */
static int32_t dropped_bits(const gn_frame *frame, const gn_light_view *view)
{
    (void)frame;
    return GN_VIEW_BITS(view) == 32 ? 0 : 32 - GN_VIEW_BITS(view) - GN_K(frame, shadow_depth_frac);
}

/* The far value is a multiple of 2^dropped: nothing below it rounds beyond it. */
static uint32_t rounded_depth(uint32_t depth_q32, int32_t dropped, uint32_t far)
{
    if (depth_q32 >= far) return far;
    return dropped ? (depth_q32 + (1U << (dropped - 1))) >> dropped << dropped : depth_q32;
}

#if GN_RECEIVER_PLANE
/* With x the depth at a tap in Q44, h half a step of rounding, s a texel, hence a whole number of steps: s >= round(x)
 * if and only if s > x - h, and, s being also a multiple of 2^12, if and only if s >= floor((x - h) / 2^12) + 1. From a
 * texel to the next, x changes by slope * 2^16, so this by slope * 16: whole numbers, every tap is exact. Slopes are
 * below 2^29.1, a receiver is at most 2^31.1 away from the texel nearest to it, both axes together: |x| < 2^62. */
static int64_t plane_rise_q44(int32_t slope_q28, int32_t tap_q16, int32_t c_q16)
{
    /* to the centre of the texel that tap_q16 lies in */
    return slope_q28 * ((int64_t)(tap_q16 >> 16) * 65536 + 0x8000 - c_q16);
}

static GN_NOINLINE void start_plane(lookup *l, const gn_receiver *receiver, int32_t dropped)
{
    int32_t most = 2 << 28;
    l->slope_q28[0] = gn_max32(-most, gn_min32(receiver->slope_q28[0], most));
    l->slope_q28[1] = gn_max32(-most, gn_min32(receiver->slope_q28[1], most));
    l->sloped = (l->slope_q28[0] | l->slope_q28[1]) != 0;
    l->least_q32 = 0;
    if (!l->sloped) return;
    int64_t x_q44 = (int64_t)receiver->depth_q32 * 4096 + plane_rise_q44(l->slope_q28[0], l->u_q16, receiver->u_q16) +
                    plane_rise_q44(l->slope_q28[1], l->v_q16, receiver->v_q16);
    l->least_q32 = ((x_q44 - ((int64_t)1 << (dropped + 11))) >> 12) + 1;
}

/* least_q32 at a texel of the tile, at most 64 + 1023 texels away in each axis: 2^50 and twice 2^44. */
static inline int64_t least_on_plane(const lookup *l, int32_t u, int32_t v)
{
    int32_t du = u - (l->u_q16 >> 16), dv = v - (l->v_q16 >> 16);
    return l->least_q32 + (int64_t)l->slope_q28[0] * (16 * du) + (int64_t)l->slope_q28[1] * (16 * dv);
}

static uint32_t limited(const gn_light_view *view, int64_t least_q32)
{
    uint32_t far = gn_texel_far(GN_VIEW_BITS(view));
    return least_q32 < 0 ? 0 : least_q32 > (int64_t)far ? far : (uint32_t)least_q32;
}

#define SLOPED(l) ((l)->sloped)
#else
#define SLOPED(l) 0
#endif

/* ---- Compares ---------------------------------------------------------------------------------------------------- */

/* Whether n x n texels from (u, v) on lie in the tile and compare with one depth: nothing to look after at each tap.
 * Where size comes first it is looked after all the same. */
static inline int plain(const lookup *l, int32_t u, int32_t v, int32_t n)
{
    uint32_t room = (uint32_t)(l->view->tile_texels - n);
    return !GN_SIZE_FIRST && !SLOPED(l) && (uint32_t)u <= room && (uint32_t)v <= room;
}

static inline gn_texels texels_at(const gn_light_view *view, int32_t u, int32_t v)
{
    return gn_texels_at(view->depth, GN_VIEW_BITS(view), ((size_t)(uint32_t)v << view->tile_log2) + (uint32_t)u);
}

/* Taps are limited to the tile (P8). */
static int is_dark(const gn_light_view *view, gn_texels row, int32_t u, uint32_t least)
{
    int32_t last = view->tile_texels - 1, in_u = u < 0 ? 0 : u > last ? last : u;
    if (BORDER_LIT(view) && in_u != u) return 0;
    return gn_texel_load(row, GN_VIEW_BITS(view), (uint32_t)in_u) < least;
}

/* Texels of row v, n from u on, wherever they lie: bit i is set where texel i keeps the receiver dark. */
static uint32_t dark_anywhere(const lookup *l, int32_t u, int32_t v, int32_t n)
{
    const gn_light_view *view = l->view;
    int32_t last = view->tile_texels - 1, in_v = v < 0 ? 0 : v > last ? last : v;
    uint32_t dark = 0;
    GN_COUNT(taps_edge, 1);
    if (BORDER_LIT(view) && in_v != v) return 0;
    gn_texels row = texels_at(view, 0, in_v);
#if GN_RECEIVER_PLANE
    if (l->sloped) {
        int64_t least_q32 = least_on_plane(l, gn_max32(0, gn_min32(u, last)), in_v); /* of the texel that is read */
        for (int32_t i = 0; i < n; i++, u++) {
            dark |= (uint32_t)is_dark(view, row, u, limited(view, least_q32)) << i;
            if (u >= 0 && u < last) least_q32 += (int64_t)l->slope_q28[0] * 16;
        }
        return dark;
    }
#endif
    for (int32_t i = 0; i < n; i++) dark |= (uint32_t)is_dark(view, row, u + i, l->least) << i;
    return dark;
}

/* A tap of the hard filter, the disk or 2x2 at the border. */
static inline uint32_t lone_tap(const lookup *l, int32_t u, int32_t v)
{
    GN_COUNT(taps_lone, 1);
    if (!plain(l, u, v, 1)) return !dark_anywhere(l, u, v, 1);
    return gn_texel_load(texels_at(l->view, u, v), GN_VIEW_BITS(l->view), 0) >= l->least;
}

#if GN_FILTER_MAX >= 2 || GN_DISK_FILTER
#if GN_DEPTH_BLOCKS
/* The smallest and largest `least` over n x n texels from (u, v) on. */
static void least_over(const lookup *l, int32_t u, int32_t v, int32_t n, uint32_t *smallest, uint32_t *largest)
{
    *smallest = *largest = l->least;
#if GN_RECEIVER_PLANE
    if (!l->sloped) return;
    int32_t last = l->view->tile_texels - 1;
    int32_t u0 = gn_max32(0, gn_min32(u, last)), u1 = gn_max32(0, gn_min32(u + n - 1, last));
    int32_t v0 = gn_max32(0, gn_min32(v, last)), v1 = gn_max32(0, gn_min32(v + n - 1, last));
    int rises_u = l->slope_q28[0] > 0, rises_v = l->slope_q28[1] > 0;
    *smallest = limited(l->view, least_on_plane(l, rises_u ? u0 : u1, rises_v ? v0 : v1));
    *largest = limited(l->view, least_on_plane(l, rises_u ? u1 : u0, rises_v ? v1 : v0));
#else
    (void)u, (void)v, (void)n;
#endif
}
#endif

/* Whether bounds answer for all of the n x n <= 18 x 18 texels from (u, v) on. */
static int decided(const lookup *l, int32_t u, int32_t v, int32_t n, uint32_t *answer)
{
#if GN_DEPTH_BLOCKS
    const gn_light_view *view = l->view;
    gn_depth_block bounds = n <= GN_BLOCK_REACH ? *gn_blocks_at(view, u, v) : gn_blocks_over(view, u, v, n);
    uint32_t smallest, largest;
    least_over(l, u, v, n, &smallest, &largest);
    *answer = 65536;
    if (largest <= (uint32_t)bounds.lo << 16) return 1;
    *answer = 0;
    if (smallest <= gn_block_highest(&bounds, GN_VIEW_BITS(view))) return 0;
    return !BORDER_LIT(view) || (u >= 0 && v >= 0 && u + n <= view->tile_texels && v + n <= view->tile_texels);
#else
    (void)l, (void)u, (void)v, (void)n, (void)answer;
    return 0;
#endif
}
#endif

/* ---- Filters with weights ---------------------------------------------------------------------------------------- */

#if GN_FILTER_MAX >= 1
/* round to weight_bits; F itself is allowed: the weights are continuous there */
static uint32_t fraction(int32_t c_q16, int32_t weight_bits)
{
    return (((uint32_t)c_q16 & 0xFFFFU) + (0x8000U >> weight_bits)) >> (16 - weight_bits);
}

static uint32_t bilinear(const lookup *l, int32_t bits)
{
    int32_t cu = l->u_q16 + 32768, cv = l->v_q16 + 32768;
    int32_t u = (cu >> 16) - 1, v = (cv >> 16) - 1;
    uint32_t l00, l01, l10, l11;
    GN_COUNT(lookups_2x2, 1);
    if (plain(l, u, v, 2)) {
        int32_t depth_bits = GN_VIEW_BITS(l->view);
        gn_texels top = texels_at(l->view, u, v), bottom = gn_texels_at(top, depth_bits, l->view->tile_texels);
        l00 = gn_texel_load(top, depth_bits, 0) >= l->least;
        l01 = gn_texel_load(top, depth_bits, 1) >= l->least;
        l10 = gn_texel_load(bottom, depth_bits, 0) >= l->least;
        l11 = gn_texel_load(bottom, depth_bits, 1) >= l->least;
    } else {
        uint32_t dark = dark_anywhere(l, u, v, 2) | dark_anywhere(l, u, v + 1, 2) << 2;
        l00 = ~dark & 1U;
        l01 = ~dark >> 1 & 1U;
        l10 = ~dark >> 2 & 1U;
        l11 = ~dark >> 3 & 1U;
    }
    if (l00 + l01 + l10 + l11 == 4) return 65536;
    if (l00 + l01 + l10 + l11 == 0) return 0;
    uint32_t wu = fraction(cu, bits), wv = fraction(cv, bits), one = 1U << bits;
    uint32_t upper = (one - wu) * l00 + wu * l01, lower = (one - wu) * l10 + wu * l11;
    uint32_t sum = (one - wv) * upper + wv * lower; /* <= F^2 <= 2^24 */
    return bits <= 8 ? sum << (16 - 2 * bits) : (sum + ((1U << (2 * bits - 16)) >> 1)) >> (2 * bits - 16);
}
#endif

#if GN_FILTER_MAX >= 2
static inline void tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits)
{
    uint32_t f = 1U << weight_bits, ff = f * f, uf4 = 4 * u * f, h = 2 * u;
    uint32_t m = h < f ? f - h : 0, p = h > f ? h - f : 0; /* |2u - F| left and right of the texel's centre */
    int32_t n = 2 * (k + 1);
    w[0] = 2 * (f - u) * (f - u);
    w[n - 1] = 2 * u * u;
    for (int32_t i = 1; i <= k; i++) {
        /* rising towards the peak 4i + 2, falling after it; the peak's corner is cut off the middle ones */
        w[i] = (uint32_t)(4 * i + 2) * ff - uf4 - (i == k ? m * m : 0);
        w[n - 1 - i] = (uint32_t)(4 * i - 2) * ff + uf4 - (i == k ? p * p : 0);
    }
}

void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits)
{
    tent_weights(w, k, u, weight_bits);
}

#if GN_LINEAR_KERNELS
void gn_linear_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits)
{
    /* the left half is a F - b u; the right half is its mirror image at F - u */
    static const uint8_t a[3][4] = {{1, 2, 0, 0}, {1, 3, 4, 0}, {1, 5, 12, 16}};
    static const uint8_t b[3][4] = {{1, 1, 0, 0}, {1, 2, 1, 0}, {1, 4, 7, 4}};
    uint32_t f = 1U << weight_bits;
    for (int32_t i = 0; i <= k; i++) {
        w[i] = a[k - 1][i] * f - b[k - 1][i] * u;
        w[2 * k + 1 - i] = a[k - 1][i] * f - b[k - 1][i] * (f - u);
    }
}
#endif

/* Which of n x n texels from (u, v) on keep the receiver dark: bit i of dark[j] for texel i of row j. Returns what any
 * row has, and in the upper half what all have. */
static uint32_t find_dark(const lookup *l, int32_t u, int32_t v, int32_t n, uint8_t *dark)
{
    int32_t depth_bits = GN_VIEW_BITS(l->view);
    int is_plain = plain(l, u, v, n);
    uint32_t any = 0, all = 255;
    if (is_plain && depth_bits == 16)
        return n == 4 && !GN_SIZE_FIRST
                   ? gn_kernel_dark_texels16(texels_at(l->view, u, v).d16, l->view->tile_texels, l->least, 4, dark)
                   : gn_kernel_dark_texels16(texels_at(l->view, u, v).d16, l->view->tile_texels, l->least, n, dark);
    for (int32_t j = 0; j < n; j++) {
        uint32_t row_dark = 0;
        if (is_plain) {
            gn_texels row = texels_at(l->view, u, v + j);
            for (int32_t i = 0; i < n; i++)
                row_dark |= (uint32_t)(gn_texel_load(row, depth_bits, (uint32_t)i) < l->least) << i;
        } else row_dark = dark_anywhere(l, u, v + j, n);
        dark[j] = (uint8_t)row_dark;
        any |= row_dark;
        all &= row_dark;
    }
    return any | all << 16;
}

#if !GN_SIZE_FIRST
/* Sums of the weights in all subsets of four: bit i for weight i. */
static void subset_sums(uint32_t sums[16], const uint32_t w[4])
{
    uint32_t a = w[0], b = w[1], c = w[2], d = w[3], ab = a + b, cd = c + d;
    sums[0] = 0, sums[1] = a, sums[2] = b, sums[3] = ab;
    sums[4] = c, sums[5] = a + c, sums[6] = b + c, sums[7] = ab + c;
    sums[8] = d, sums[9] = a + d, sums[10] = b + d, sums[11] = ab + d;
    sums[12] = cd, sums[13] = a + cd, sums[14] = b + cd, sums[15] = ab + cd;
}
#endif

/* Sum of the products of weights of the dark texels of n x n. narrow: they stay below 2^32 together. */
static uint64_t weighted(const uint8_t *dark, int32_t n, const uint32_t *wu, const uint32_t *wv, int narrow)
{
    uint64_t sum = 0;
#if GN_SIZE_FIRST
    (void)narrow;
    for (int32_t j = 0; j < n; j++) {
        uint32_t across = 0;
        for (int32_t i = 0; i < n; i++)
            if (dark[j] >> i & 1U) across += wu[i];
        sum += (uint64_t)across * wv[j];
    }
#else
    uint32_t left[16], right[16];
    subset_sums(left, wu);
    if (n > 4) subset_sums(right, wu + 4);
    for (int32_t j = 0; j < n; j++) {
        uint32_t across = left[dark[j] & 15U];
        if (n > 4) across += right[dark[j] >> 4];
        if (narrow) sum += across * wv[j];
        else sum += (uint64_t)across * wv[j];
    }
#endif
    return sum;
}

/* sum / (N * 2^scale_bits) in Q16, scale = round(2^32 / N): 20 fraction bits are kept, kept <= N * 2^20 < 2^32. */
static uint32_t weighted_fraction(uint64_t sum, int32_t scale_bits, uint32_t scale)
{
    int32_t drop = scale_bits - 20;
    uint64_t kept = drop >= 0 ? sum >> drop : sum << -drop;
    return (uint32_t)((kept * scale + ((uint64_t)1 << 35)) >> 36);
}

/* F3, or F6 if the scene asks for it. Both are done as tents: their reach and their number of texels are the same. */
static uint32_t tent(const gn_frame *frame, const lookup *l, int32_t k, int32_t bits)
{
    uint32_t wu[GN_TENT_TAPS_MAX], wv[GN_TENT_TAPS_MAX], answer;
    int32_t cu = l->u_q16 + 32768, cv = l->v_q16 + 32768, n = 2 * (k + 1);
    int32_t u0 = (cu >> 16) - (k + 1), v0 = (cv >> 16) - (k + 1);
    uint8_t dark[GN_TENT_TAPS_MAX];
    if (decided(l, u0, v0, n, &answer)) return answer;
    GN_COUNT(undecided, 1);
    GN_COUNT(taps_tent, n * n);
    uint32_t found = find_dark(l, u0, v0, n, dark);
    if (!(found & 0xFFFFU)) return 65536;
    if (found >> 16 == (1U << n) - 1) return 0;
#if GN_LINEAR_KERNELS
    if (frame->scene->shadow.kernel == GN_KERNEL_LINEAR) {
        gn_linear_weights(wu, k, fraction(cu, bits), bits);
        gn_linear_weights(wv, k, fraction(cv, bits), bits);
        /* products <= 52 F * 16 F, their sum <= 52^2 F^2 <= 2704 * 2^24 */
        uint32_t whole = k == 1 ? 16 : k == 2 ? 144 : 2704;
        uint64_t sum = ((uint64_t)whole << 2 * bits) - weighted(dark, n, wu, wv, bits <= 11);
        return weighted_fraction(sum, 2 * bits,
                                 k == 1   ? 268435456U
                                 : k == 2 ? 29826162U
                                          : 1588375U); /* round(2^32 / whole) */
    }
#endif
    (void)frame;
    gn_tent_weights(wu, k, fraction(cu, bits), bits);
    gn_tent_weights(wv, k, fraction(cv, bits), bits);
    /* along a row <= 49 F^2 < 2^30, all <= (2k + 1)^4 F^4 <= 2401 * 2^48 */
    uint32_t whole = k == 1 ? 81 : k == 2 ? 625 : 2401;
    uint64_t sum = ((uint64_t)whole << 4 * bits) - weighted(dark, n, wu, wv, 0);
    return weighted_fraction(sum, 4 * bits,
                             k == 1   ? 53024288U
                             : k == 2 ? 6871948U
                                      : 1788824U); /* round(2^32 / whole) */
}
#endif

/* ---- Rotated disk ------------------------------------------------------------------------------------------------ */

#if GN_DISK_FILTER
#define DISK_RADIUS_MAX_Q16 (8 << 16)

static uint16_t rotation_turn(int32_t pixel_x, int32_t pixel_y)
{
    uint32_t v = ((uint32_t)pixel_x * 0x8DA6B343U) ^ ((uint32_t)pixel_y * 0xD8163841U);
    v = (v ^ (v >> 15)) * 0x2C1B3C6DU;
    v ^= v >> 13;
    return (uint16_t)(v >> 16);
}

/* Offsets have 27 fraction bits: a radius and a rotation in Q12 (|.| <= 2^15 + 1) times a point in Q15 (|.| <= 2^15 +
 * 1) stay below 2^30.1, plus a fraction of a texel. They err by at most 2^-12.5 texels by the rotation's rounding and
 * radius * 2^-15.5 by the table's: below 2^-11 together, by which the footprint is widened before bounds are asked. */
static uint32_t disk(const gn_frame *frame, const lookup *l, const gn_receiver *receiver)
{
    uint32_t n_samples = frame->scene->shadow.disk_samples, n_lit = 0, answer;
    int32_t radius_q16 = gn_max32(0, gn_min32(l->view->disk_radius_q16, DISK_RADIUS_MAX_Q16)),
            reach_q16 = radius_q16 + 32;
    if (decided(l, (l->u_q16 - reach_q16) >> 16, (l->v_q16 - reach_q16) >> 16, (2 * reach_q16 >> 16) + 2, &answer))
        return answer;
    GN_COUNT(undecided, 1);
    uint16_t turn = rotation_turn(receiver->pixel_x, receiver->pixel_y);
    int32_t c_q12 = gn_mul_shr(radius_q16, gn_cos_q30(turn), 34), s_q12 = gn_mul_shr(radius_q16, gn_sin_q30(turn), 34);
    int32_t u = l->u_q16 >> 16, fu_q27 = (l->u_q16 & 0xFFFF) << 11;
    int32_t v = l->v_q16 >> 16, fv_q27 = (l->v_q16 & 0xFFFF) << 11;
    const int16_t *point_q15 = gn_disk_table_q15;
    for (uint32_t i = 0; i < n_samples; i++, point_q15 += 2) {
        int32_t x = point_q15[0], y = point_q15[1];
        n_lit +=
            lone_tap(l, u + ((fu_q27 + c_q12 * x - s_q12 * y) >> 27), v + ((fv_q27 + s_q12 * x + c_q12 * y) >> 27));
    }
    return ((n_lit << 16) + n_samples / 2) / n_samples;
}
#endif

/* ---- Any filter -------------------------------------------------------------------------------------------------- */

/* A coordinate may lie far outside after a steep offset: the border's answer holds there, but its fraction still
 * weighs. */
static int32_t near_tile(int32_t c_q16)
{
    if ((uint32_t)c_q16 + (64U << 16) < 1152U << 16) return c_q16; /* from -64 to 1088: most are */
    return (c_q16 < 0 ? -64 : 1088) * 65536 + (c_q16 & 0xFFFF);
}

static uint32_t filtered(const gn_frame *frame, const lookup *l, const gn_receiver *receiver)
{
    (void)frame, (void)receiver;
    switch (l->view->filter) {
#if GN_FILTER_MAX >= 1
    case GN_FILTER_2X2:
        return bilinear(l, GN_K(frame, weight_bits));
#endif
#if GN_FILTER_MAX >= 2
    case GN_FILTER_3X3:
    case GN_FILTER_5X5:
    case GN_FILTER_7X7:
        return tent(frame, l, l->view->filter - GN_FILTER_2X2, GN_K(frame, weight_bits));
#endif
#if GN_DISK_FILTER
    case GN_FILTER_DISK:
        return disk(frame, l, receiver);
#endif
    default:
        return lone_tap(l, l->u_q16 >> 16, l->v_q16 >> 16) << 16;
    }
}

uint32_t gn_filter_attenuation(const gn_frame *frame, const gn_light_view *view, const gn_receiver *receiver)
{
    lookup l;
    int32_t dropped = dropped_bits(frame, view);
    l.view = view;
    l.u_q16 = near_tile(receiver->u_q16);
    l.v_q16 = near_tile(receiver->v_q16);
    l.least = rounded_depth(receiver->depth_q32, dropped, gn_texel_far(GN_VIEW_BITS(view)));
#if GN_RECEIVER_PLANE
    start_plane(&l, receiver, dropped);
#endif
    uint32_t attenuation = filtered(frame, &l, receiver);
    return GN_K(frame, atten_bits) == 8 ? (attenuation + 128) & ~255U : attenuation;
}

#if GN_PIECES
/* ---- Rows of receivers ------------------------------------------------------------------------------------------- */

/* The texels that a row of receivers reads along an axis: first, and the last. */
static void reads(const gn_light_view *view, int32_t a_q16, int32_t b_q16, int32_t *first, int32_t *last)
{
    int32_t k = view->filter_idx;
    *first = ((gn_min32(a_q16, b_q16) + 32768) >> 16) - (k + 1);
    *last = ((gn_max32(a_q16, b_q16) + 32768) >> 16) + k;
}

static uint32_t min_passing_depth(const gn_frame *frame, const gn_light_view *view, int32_t depth_q31)
{
    uint32_t depth_q32 = depth_q31 < 0 ? 0 : (uint32_t)depth_q31 << 1;
    return rounded_depth(depth_q32, dropped_bits(frame, view), gn_texel_far(GN_VIEW_BITS(view)));
}

/* Whether texels first .. last along both axes are all lit or all dark to every depth from `least` to `most`. */
static int texels_agree(const gn_light_view *view, const int32_t first[2], const int32_t last[2], uint32_t least,
                        uint32_t most, uint32_t *attenuation)
{
    int32_t bits = GN_VIEW_BITS(view), end = view->tile_texels - 1;
    uint32_t lit = 0, dark = 0, n = (uint32_t)(last[0] - first[0]) + 1;
    if (first[0] < 0 || first[1] < 0 || last[0] > end || last[1] > end) return 0;
#if GN_DEPTH_BLOCKS
    const gn_depth_block *bounds = &view->block[(first[1] >> 3 << (view->tile_log2 - 3)) + (first[0] >> 3)];
    if (last[0] - first[0] < GN_BLOCK_REACH && last[1] - first[1] < GN_BLOCK_REACH) { /* for less than a look at each */
        *attenuation = most <= (uint32_t)bounds->lo << 16 ? 65536 : 0;
        if (*attenuation || least > gn_block_highest(bounds, bits)) return 1;
    }
#endif
    gn_texels row = texels_at(view, first[0], first[1]);
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

int gn_filter_decides(const gn_frame *frame, const gn_light_view *view, const gn_receiver_step *a,
                      const gn_receiver_step *b, uint32_t *attenuation)
{
    int32_t first[2], last[2];
    reads(view, a->u_q16, b->u_q16, &first[0], &last[0]);
    reads(view, a->v_q16, b->v_q16, &first[1], &last[1]);
    int32_t n = gn_max32(last[0] - first[0], last[1] - first[1]) + 1;
    uint32_t least = min_passing_depth(frame, view, gn_min32(a->depth_q31, b->depth_q31));
    uint32_t most = min_passing_depth(frame, view, gn_max32(a->depth_q31, b->depth_q31));
    if (n <= 12) return texels_agree(view, first, last, least, most, attenuation);
#if GN_DEPTH_BLOCKS
    if (n > 2 * GN_BLOCK_REACH) return 0;
    gn_depth_block bounds =
        n <= GN_BLOCK_REACH ? *gn_blocks_at(view, first[0], first[1]) : gn_blocks_over(view, first[0], first[1], n);
    *attenuation = 65536;
    if (most <= (uint32_t)bounds.lo << 16) return 1;
    *attenuation = 0;
    if (least <= gn_block_highest(&bounds, GN_VIEW_BITS(view))) return 0;
    int32_t end = view->tile_texels - 1;
    return !BORDER_LIT(view) || (first[0] >= 0 && first[1] >= 0 && last[0] <= end && last[1] <= end);
#else
    return 0;
#endif
}

#if GN_FILTER_MAX >= 1
/* 2x2 of 16 bits whose texels all lie in the tile. Coordinates half a texel up and left: what is shifted out is the
 * fraction. */
static void bilinear_row(const gn_frame *frame, const gn_light_view *view, gn_receiver_step at,
                         const gn_receiver_step *step, int32_t n, uint32_t *attenuation)
{
    const uint16_t *texel = view->depth.d16;
    int32_t bits = GN_K(frame, weight_bits), dropped = dropped_bits(frame, view);
    uint32_t pitch = view->tile_texels, log2 = view->tile_log2, one = 1U << bits;
    at.u_q16 -= 32768;
    at.v_q16 -= 32768;
    at.depth_q31 -=
        1 << (dropped -
              2); /* half a step is added, and a step taken off: a texel above is not below the depth rounded */
    for (uint32_t *end = attenuation + n; attenuation < end; attenuation++) {
        const uint16_t *p = texel + (((uint32_t)at.v_q16 >> 16) << log2) + ((uint32_t)at.u_q16 >> 16), *q = p + pitch;
        int32_t below = at.depth_q31 >> 15; /* lit: the texel is above */
        uint32_t n_lit = (uint32_t)(below - p[0]) >> 31;
        n_lit += (uint32_t)(below - p[1]) >> 31;
        n_lit += (uint32_t)(below - q[0]) >> 31;
        n_lit += (uint32_t)(below - q[1]) >> 31;
        *attenuation = n_lit << 14;
        if (n_lit - 1 < 3) {
            uint32_t wu = fraction(at.u_q16, bits), wv = fraction(at.v_q16, bits);
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

#if GN_FILTER_MAX >= 2 && !GN_SIZE_FIRST
/* The same of 3x3: what tent() does, but for its looks at bounds. */
static void tent3_row(const gn_frame *frame, const gn_light_view *view, gn_receiver_step at,
                      const gn_receiver_step *step, int32_t n, uint32_t *attenuation)
{
    int32_t bits = GN_K(frame, weight_bits);
    at.u_q16 -= 98304;
    at.v_q16 -= 98304;
    at.depth_q31 -= 1 << (dropped_bits(frame, view) - 2);
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
            tent_weights(wu, 1, fraction(at.u_q16, bits), bits);
            tent_weights(wv, 1, fraction(at.v_q16, bits), bits);
            uint32_t partly =
                weighted_fraction(((uint64_t)81 << 4 * bits) - weighted(dark, 4, wu, wv, 0), 4 * bits, 53024288U);
            *attenuation = GN_K(frame, atten_bits) == 8 ? (partly + 128) & ~255U : partly;
        }
        at.u_q16 += step->u_q16;
        at.v_q16 += step->v_q16;
        at.depth_q31 += step->depth_q31;
    }
}
#endif

/* Whether that is all there is to do. */
static int is_simple(const gn_frame *frame, const gn_light_view *view, const gn_receiver_step *from,
                     const gn_receiver_step *to)
{
    int32_t u, u_last, v, v_last;
    if (GN_VIEW_BITS(view) != 16) return 0;
    if (GN_FILTER_MAX >= 2 && !GN_SIZE_FIRST && view->filter == GN_FILTER_3X3) {
        if (GN_LINEAR_KERNELS && frame->scene->shadow.kernel == GN_KERNEL_LINEAR) return 0;
    } else if (view->filter != GN_FILTER_2X2 || GN_K(frame, weight_bits) > 8) return 0;
    reads(view, from->u_q16, to->u_q16, &u, &u_last);
    reads(view, from->v_q16, to->v_q16, &v, &v_last);
    return u >= 0 && v >= 0 && u_last < view->tile_texels && v_last < view->tile_texels;
}
#endif

void gn_filter_row(const gn_frame *frame, const gn_light_view *view, const gn_receiver_step *from,
                   const gn_receiver_step *to, const gn_receiver_step *step, int32_t n, uint32_t *attenuation)
{
    gn_receiver_step at = *from;
#if GN_FILTER_MAX >= 1
    int simple = is_simple(frame, view, from, to);
    if (simple && view->filter == GN_FILTER_2X2) {
        bilinear_row(frame, view, at, step, n, attenuation);
        return;
    }
#endif
    uint32_t all;
    if (n > 2 && gn_filter_decides(frame, view, from, to, &all)) {
        for (int32_t i = 0; i < n; i++) attenuation[i] = all;
        return;
    }
#if GN_FILTER_MAX >= 2 && !GN_SIZE_FIRST
    if (simple) {
        tent3_row(frame, view, at, step, n, attenuation);
        return;
    }
#endif
    for (int32_t i = 0; i < n; i++) {
        gn_receiver r = {at.u_q16, at.v_q16, at.depth_q31 < 0 ? 0 : (uint32_t)at.depth_q31 << 1, {0, 0}, 0, 0};
        attenuation[i] = gn_filter_attenuation(frame, view, &r);
        if (i + 1 == n) return; /* beyond the last pixel the step may leave the range */
        at.u_q16 += step->u_q16;
        at.v_q16 += step->v_q16;
        at.depth_q31 += step->depth_q31;
    }
}
#endif

#endif
