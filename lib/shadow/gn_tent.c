/* Tents and linear kernels. Compares come first, weights are exact integers, one division by multiplication ends it. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_kernel.h"
#include "base/gn_q.h"
#include "shadow/gn_tent.h"

/* Weights of a tent along one axis. [F3] */
GN_HOT void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits)
{
    gn_tent_weights_inline(w, k, u, weight_bits);
}

#if GN_LINEAR_KERNELS
/* Weights of the linear kernel along one axis. [F6] */
GN_HOT void gn_linear_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits)
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

/* Which of n x n texels from (u, v) on keep the receiver dark: bit i of dark[j] for texel i of row j. Returns what
 * any row has, and in the upper half what all have. */
GN_HOT static uint32_t find_dark(const gn_lookup *l, int32_t u, int32_t v, int32_t n, uint8_t *dark)
{
    int32_t depth_bits = GN_VIEW_BITS(l->view);
    int is_plain = gn_lookup_is_plain(l, u, v, n);
    uint32_t any = 0, all = 255;
    if (is_plain && depth_bits == 16)
        return n == 4 && !GN_SIZE_FIRST
                   ? gn_kernel_dark_texels16(gn_view_texels(l->view, u, v).d16, l->view->tile_texels, l->least, 4, dark)
                   : gn_kernel_dark_texels16(gn_view_texels(l->view, u, v).d16, l->view->tile_texels, l->least, n,
                                             dark);
    for (int32_t j = 0; j < n; j++) {
        uint32_t row_dark = 0;
        if (is_plain) {
            gn_texels row = gn_view_texels(l->view, u, v + j);
            for (int32_t i = 0; i < n; i++)
                row_dark |= (uint32_t)(gn_texel_load(row, depth_bits, (uint32_t)i) < l->least) << i;
        } else row_dark = gn_lookup_dark(l, u, v + j, n);
        dark[j] = (uint8_t)row_dark;
        any |= row_dark;
        all &= row_dark;
    }
    return any | all << 16;
}

/* gn_weighted, in few bytes. */
GN_HOT static uint64_t weighted_texel_by_texel(const uint8_t *dark, int32_t n, const uint32_t *wu, const uint32_t *wv)
{
    uint64_t sum = 0;
    for (int32_t j = 0; j < n; j++) {
        uint32_t across = 0;
        for (int32_t i = 0; i < n; i++)
            if (dark[j] >> i & 1U) across += wu[i];
        sum += (uint64_t)across * wv[j];
    }
    return sum;
}

GN_HOT static uint64_t weighted(const uint8_t *dark, int32_t n, const uint32_t *wu, const uint32_t *wv, int narrow)
{
    return GN_SIZE_FIRST ? weighted_texel_by_texel(dark, n, wu, wv) : gn_weighted(dark, n, wu, wv, narrow);
}

GN_HOT static inline uint32_t linear_kernel(const uint8_t *dark, int32_t k, int32_t cu, int32_t cv, int32_t bits)
{
    uint32_t wu[GN_TENT_TAPS_MAX], wv[GN_TENT_TAPS_MAX];
    gn_linear_weights(wu, k, gn_filter_fraction(cu, bits), bits);
    gn_linear_weights(wv, k, gn_filter_fraction(cv, bits), bits);
    /* products <= 52 F * 16 F, their sum <= 52^2 F^2 <= 2704 * 2^24 */
    uint32_t whole = k == 1 ? 16 : k == 2 ? 144 : 2704;
    uint64_t sum = ((uint64_t)whole << 2 * bits) - weighted(dark, 2 * (k + 1), wu, wv, bits <= 11);
    return gn_weighted_fraction(sum, 2 * bits,
                                k == 1   ? 268435456U
                                : k == 2 ? 29826162U
                                         : 1588375U); /* round(2^32 / whole) */
}

/* Apart from gn_tent_attenuation: its arrays are not on the stack while bounds decide. */
GN_HOT static GN_NOINLINE uint32_t undecided(const gn_frame *frame, const gn_lookup *l, int32_t k, int32_t bits)
{
    uint32_t wu[GN_TENT_TAPS_MAX], wv[GN_TENT_TAPS_MAX];
    int32_t cu = l->u_q16 + 32768, cv = l->v_q16 + 32768, n = 2 * (k + 1);
    int32_t u0 = (cu >> 16) - (k + 1), v0 = (cv >> 16) - (k + 1);
    uint8_t dark[GN_TENT_TAPS_MAX];
    GN_COUNT(undecided, 1);
    GN_COUNT(taps_tent, n * n);
    uint32_t found = find_dark(l, u0, v0, n, dark);
    if (!(found & 0xFFFFU)) return 65536;
    if (found >> 16 == (1U << n) - 1) return 0;
    if (GN_LINEAR_KERNELS && frame->scene->shadow.kernel == GN_KERNEL_LINEAR)
        return linear_kernel(dark, k, cu, cv, bits);
    gn_tent_weights(wu, k, gn_filter_fraction(cu, bits), bits);
    gn_tent_weights(wv, k, gn_filter_fraction(cv, bits), bits);
    /* along a row <= 49 F^2 < 2^30, all <= (2k + 1)^4 F^4 <= 2401 * 2^48 */
    uint32_t whole = k == 1 ? 81 : k == 2 ? 625 : 2401;
    uint64_t sum = ((uint64_t)whole << 4 * bits) - weighted(dark, n, wu, wv, 0);
    return gn_weighted_fraction(sum, 4 * bits,
                                k == 1   ? 53024288U
                                : k == 2 ? 6871948U
                                         : 1788824U); /* round(2^32 / whole) */
}

/* Both kernels are done as tents: their reach and their number of texels are the same. */
GN_HOT uint32_t gn_tent_attenuation(const gn_frame *frame, const gn_lookup *l, int32_t k, int32_t bits)
{
    int32_t u0 = ((l->u_q16 + 32768) >> 16) - (k + 1), v0 = ((l->v_q16 + 32768) >> 16) - (k + 1);
    uint32_t answer;
    if (GN_DEPTH_BLOCKS && gn_lookup_decided(l, u0, v0, 2 * (k + 1), &answer)) return answer;
    return undecided(frame, l, k, bits);
}
