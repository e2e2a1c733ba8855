/* Percentage-closer filtering. Compares come first, weights are exact integers, one division by multiplication ends it. */
#include "gn_filter.h"
#include "gn_blocks.h"
#include "gn_q.h"

#if GN_SHADOWS

typedef struct {
    const gn_light_view *view;
    int32_t depth; /* the receiver's, in depth steps with depth_frac fraction bits */
    int32_t depth_frac;
} receiver;

static uint32_t lit(const receiver *r, const uint16_t *row, int32_t u)
{
    int32_t last = r->view->tile_texels - 1;
    u = u < 0 ? 0 : u > last ? last : u;
    return (int32_t)((uint32_t)row[u] << r->depth_frac) >= r->depth;
}

static const uint16_t *row_at(const receiver *r, int32_t v)
{
    int32_t last = r->view->tile_texels - 1;
    v = v < 0 ? 0 : v > last ? last : v;
    return r->view->depth + ((size_t)(uint32_t)v << r->view->tile_log2);
}

#if GN_FILTER_MAX >= 1
/* round to weight_bits; F itself is allowed: the weights are continuous there */
static uint32_t fraction(int32_t c_q16, int32_t weight_bits)
{
    return (((uint32_t)c_q16 & 0xFFFFU) + (0x8000U >> weight_bits)) >> (16 - weight_bits);
}

static uint32_t bilinear(const receiver *r, int32_t u_q16, int32_t v_q16, int32_t bits)
{
    int32_t cu = u_q16 + 32768, cv = v_q16 + 32768;
    int32_t u = (cu >> 16) - 1, v = (cv >> 16) - 1;
    uint32_t wu = fraction(cu, bits), wv = fraction(cv, bits), one = 1U << bits;
    const uint16_t *top = row_at(r, v), *bottom = row_at(r, v + 1);
    uint32_t l00 = lit(r, top, u), l01 = lit(r, top, u + 1), l10 = lit(r, bottom, u), l11 = lit(r, bottom, u + 1);
    if (l00 + l01 + l10 + l11 == 4) return 65536;
    if (l00 + l01 + l10 + l11 == 0) return 0;
    uint32_t upper = (one - wu) * l00 + wu * l01, lower = (one - wu) * l10 + wu * l11;
    uint32_t sum = (one - wv) * upper + wv * lower; /* <= F^2 <= 2^24 */
    return bits <= 8 ? sum << (16 - 2 * bits) : (sum + ((1U << (2 * bits - 16)) >> 1)) >> (2 * bits - 16);
}
#endif

#if GN_FILTER_MAX >= 2
void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits)
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

/* Whether the bounds of the texels from (u, v) on answer for all of them. */
static int decided(const receiver *r, int32_t u, int32_t v, uint32_t *answer)
{
#if GN_DEPTH_BLOCKS
    const gn_depth_block *bounds = gn_blocks_at(r->view, u, v);
    *answer = 65536;
    if (r->depth <= (int32_t)((uint32_t)bounds->lo << r->depth_frac)) return 1;
    *answer = 0;
    return r->depth > (int32_t)((uint32_t)bounds->hi << r->depth_frac);
#else
    (void)r, (void)u, (void)v, (void)answer;
    return 0;
#endif
}

static uint32_t tent(const receiver *r, int32_t k, int32_t u_q16, int32_t v_q16, int32_t bits)
{
    uint32_t wu[GN_TENT_TAPS_MAX], wv[GN_TENT_TAPS_MAX];
    int32_t cu = u_q16 + 32768, cv = v_q16 + 32768, n = 2 * (k + 1);
    int32_t u0 = (cu >> 16) - (k + 1), v0 = (cv >> 16) - (k + 1);
    uint32_t answer;
    if (decided(r, u0, v0, &answer)) return answer;
    gn_tent_weights(wu, k, fraction(cu, bits), bits);
    gn_tent_weights(wv, k, fraction(cv, bits), bits);
    uint64_t sum = 0; /* <= (2k + 1)^4 F^4 <= 2401 * 2^48 */
    for (int32_t j = 0; j < n; j++) {
        const uint16_t *row = row_at(r, v0 + j);
        uint32_t across = 0; /* <= 49 F^2 < 2^30 */
        for (int32_t i = 0; i < n; i++)
            if (lit(r, row, u0 + i)) across += wu[i];
        sum += (uint64_t)across * wv[j];
    }
    /* sum / ((2k+1)^4 F^4) in Q16: 20 fraction bits are kept, then one multiplication by 2^32 / (2k+1)^4 */
    uint32_t scale = k == 1 ? 53024288U : k == 2 ? 6871948U : 1788824U; /* round(2^32 / 81, 625, 2401) */
    int32_t drop = 4 * bits - 20;
    uint64_t kept = drop >= 0 ? sum >> drop : sum << -drop; /* < 2^32 */
    return (uint32_t)((kept * scale + ((uint64_t)1 << 35)) >> 36);
}
#endif

/* Texels, Q16, to depth steps of T * 2^J / 65536 texels with depth_frac fraction bits, limited to the far end. */
static int32_t receiver_depth(const gn_light_view *view, int32_t d_q16, int32_t depth_frac)
{
    int32_t shift = view->tile_log2 + view->depth_log2 - depth_frac; /* -1 .. 20 */
    if (d_q16 <= 0) return 0;                                        /* nothing is stored nearer than 0 */
    int32_t far = 65535 << depth_frac;
    if (shift <= 0) return d_q16 > far >> -shift ? far : d_q16 << -shift;
    return gn_min32((int32_t)(((uint32_t)d_q16 + ((1U << shift) >> 1)) >> shift), far);
}

uint32_t gn_filter_attenuation(const gn_frame *frame, const gn_light_view *view, int32_t u_q16, int32_t v_q16, int32_t d_q16)
{
    receiver r = {view, 0, GN_K(frame, shadow_depth_frac)};
    /* coordinates may lie far outside after a steep offset: the border's answer holds there */
    u_q16 = gn_max32(-(64 << 16), gn_min32(u_q16, 1088 << 16));
    v_q16 = gn_max32(-(64 << 16), gn_min32(v_q16, 1088 << 16));
    r.depth = receiver_depth(view, d_q16, r.depth_frac);
    uint32_t attenuation;
#if GN_FILTER_MAX >= 1
    int32_t bits = GN_K(frame, weight_bits);
#endif
    switch (view->filter) {
#if GN_FILTER_MAX >= 1
    case GN_FILTER_2X2:
        attenuation = bilinear(&r, u_q16, v_q16, bits);
        break;
#endif
#if GN_FILTER_MAX >= 2
    case GN_FILTER_3X3:
    case GN_FILTER_5X5:
    case GN_FILTER_7X7:
        attenuation = tent(&r, view->filter - GN_FILTER_2X2, u_q16, v_q16, bits);
        break;
#endif
    default:
        attenuation = lit(&r, row_at(&r, v_q16 >> 16), u_q16 >> 16) << 16;
        break;
    }
    return GN_K(frame, atten_bits) == 8 ? (attenuation + 128) & ~255U : attenuation;
}

#endif
