/* Shadow filters against exact rationals: tent weights as integrals, attenuation as sums of weights over compares. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "exact.h"
#include "gn_blocks.h"
#include "gn_filter.h"
#include "gnomon.h"
#include "rng.h"

static rng random_state = {4};

/* ---- Weights ------------------------------------------------------------------------------------------------------ */

/* Twice the integral of max(0, h - |t - c|) from minus infinity to x. */
static int64_t twice_tent_integral(int64_t x, int64_t c, int64_t h)
{
    if (x <= c - h) return 0;
    if (x >= c + h) return 2 * h * h;
    return x <= c ? (x - c + h) * (x - c + h) : 2 * h * h - (c + h - x) * (c + h - x);
}

/* The weight of texel i of 2 (k + 1), over (2k + 1)^2 F^2. In units of 1 / 2F texel, counted from the texel border that
 * floor(centre + 1/2) names, the tent's centre is 2u - F, its half width (2k + 1) F, and texel i begins at 2F (i - k - 1). */
static int64_t exact_weight(int32_t k, int32_t i, int64_t u, int64_t f)
{
    int64_t c = 2 * u - f, h = (2 * k + 1) * f, from = 2 * f * (i - k - 1);
    return (twice_tent_integral(from + 2 * f, c, h) - twice_tent_integral(from, c, h)) / 2;
}

static void test_weights(void)
{
    tally weight = {0}, sum = {0};
    for (int32_t bits = 4; bits <= 12; bits++)
        for (int32_t k = 1; k <= 3; k++)
            for (uint32_t u = 0; u <= 1U << bits; u++) {
                uint32_t w[GN_TENT_TAPS_MAX + 1];
                int32_t n = 2 * (k + 1);
                int64_t total = 0, f = (int64_t)1 << bits;
                for (int32_t i = 0; i <= GN_TENT_TAPS_MAX; i++) w[i] = 0xDEADBEEFU;
                gn_tent_weights(w, k, u, bits);
                for (int32_t i = 0; i < n; i++) {
                    int64_t exact = exact_weight(k, i, u, f);
                    HOLDS(&weight, w[i] == exact, "k %d, F 2^%d, u %u, texel %d: %u, not %lld", (int)k, (int)bits, (unsigned)u,
                          (int)i, (unsigned)w[i], (long long)exact);
                    total += w[i];
                }
                HOLDS(&sum, total == (2 * k + 1) * (2 * k + 1) * f * f && w[n] == 0xDEADBEEFU, "k %d, F 2^%d, u %u: %lld", (int)k,
                      (int)bits, (unsigned)u, (long long)total);
            }
    CHECK_TALLY(weight, "tent weights are the integral");
    CHECK_TALLY(sum, "tent weights sum to the whole and end where they should");
}

/* ---- Attenuation -------------------------------------------------------------------------------------------------- */

static gn_frame frame;
static gn_light_view view;

static int32_t clamp_index(int64_t i)
{
    return (int32_t)i128_clamp(i, 0, view.tile_texels - 1);
}

/* Depth in steps of the tile's range / 65536, with depth_frac fraction bits, rounded to nearest. */
static i128 receiver_steps(int32_t d_q16)
{
    int shift = view.tile_log2 + view.depth_log2;
    i128 d = (i128)d_q16 * ((i128)1 << frame.knobs.shadow_depth_frac);
    i128 last = (i128)65535 * ((i128)1 << frame.knobs.shadow_depth_frac);
    d = i128_round_shr(d, shift);
    return d > last ? last : d; /* beyond the far end an empty texel still lets it be lit */
}

static int lit(int64_t i, int64_t j, i128 depth)
{
    uint16_t stored = view.depth[clamp_index(j) * view.tile_texels + clamp_index(i)];
    return depth <= (i128)stored * ((i128)1 << frame.knobs.shadow_depth_frac);
}

/* Taps of one axis: the first texel and the weights, over `whole`. */
static int32_t exact_taps(int64_t *first, int64_t w[GN_TENT_TAPS_MAX], i128 *whole, int32_t c_q16)
{
    int32_t k = view.filter - 1, bits = frame.knobs.weight_bits;
    int64_t f = (int64_t)1 << bits, c = (int64_t)c_q16 + 32768;
    int64_t texel = (int64_t)i128_floor_div(c, 65536), u = (int64_t)i128_round_shr(c - texel * 65536, 16 - bits);
    if (view.filter == GN_FILTER_HARD) {
        *first = (int64_t)i128_floor_div(c_q16, 65536);
        *whole = 1;
        w[0] = 1;
        return 1;
    }
    *first = texel - (k + 1);
    *whole = view.filter == GN_FILTER_2X2 ? f : (2 * k + 1) * (2 * k + 1) * f * f;
    if (view.filter == GN_FILTER_2X2) w[0] = f - u, w[1] = u;
    else
        for (int32_t i = 0; i < 2 * (k + 1); i++) w[i] = exact_weight(k, i, u, f);
    return 2 * (k + 1);
}

/* 65536 * attenuation as a rational: numerator; the denominator is returned. */
static i128 exact_attenuation(i128 *numerator, int32_t u_q16, int32_t v_q16, int32_t d_q16)
{
    int64_t u0, v0, wu[GN_TENT_TAPS_MAX], wv[GN_TENT_TAPS_MAX];
    i128 whole_u, whole_v, sum = 0, depth = receiver_steps(d_q16);
    int32_t nu = exact_taps(&u0, wu, &whole_u, u_q16), nv = exact_taps(&v0, wv, &whole_v, v_q16);
    for (int32_t j = 0; j < nv; j++)
        for (int32_t i = 0; i < nu; i++)
            if (lit(u0 + i, v0 + j, depth)) sum += (i128)wu[i] * wv[j];
    *numerator = sum * 65536;
    return whole_u * whole_v;
}

/* The bounds that belong to the tile's present texels. */
static void build_blocks(void)
{
#if GN_DEPTH_BLOCKS
    static gn_depth_block blocks[GN_ATLAS_SIZE * GN_ATLAS_SIZE / 64];
    view.block = blocks;
    gn_blocks_build(&view);
#endif
}

static void random_view(uint16_t *texels, uint32_t i)
{
    frame.knobs.weight_bits = rng_range(&random_state, 4, 12);
    frame.knobs.shadow_depth_frac = rng_range(&random_state, 0, 4);
    frame.knobs.atten_bits = i & 1 ? 8 : 16;
    view.filter = (uint8_t)rng_below(&random_state, 5);
    view.depth_log2 = (uint8_t)rng_below(&random_state, 6);
    view.depth = texels;
    uint16_t levels[3] = {20000, (uint16_t)rng_u32(&random_state), 65535};
    uint32_t noise = rng_below(&random_state, 3),
             size = view.tile_texels; /* 0: two flat halves, 1: texels of few levels, 2: of any */
    uint32_t edge_u = rng_below(&random_state, size), edge_v = rng_below(&random_state, size);
    for (uint32_t t = 0; t < size * size; t++) {
        if (noise == 0) texels[t] = levels[t % size > edge_u && t / size > edge_v];
        else texels[t] = noise == 1 ? levels[rng_below(&random_state, 3)] : (uint16_t)rng_u32(&random_state);
    }
    build_blocks();
}

/* A tile coordinate: inside, in a corner or at a border, on a grid line, far outside. */
static int32_t random_position(void)
{
    int32_t size = view.tile_texels * 65536;
    switch (rng_below(&random_state, 8)) {
    case 0:
        return rng_range(&random_state, -5 * 65536, 5 * 65536);
    case 1:
        return size + rng_range(&random_state, -5 * 65536, 5 * 65536);
    case 2:
        return rng_range(&random_state, -1, view.tile_texels) * 32768;
    case 3:
        return rng_range(&random_state, -1, view.tile_texels) * 32768 + rng_range(&random_state, -40, 40);
    case 4:
        return rng_below(&random_state, 16) ? rng_range(&random_state, 0, size) : rng_wide_i32(&random_state, 31);
    default:
        return rng_range(&random_state, 0, size);
    }
}

/* A depth at, just before and just behind a stored one; sometimes anything. */
static int32_t random_depth(void)
{
    uint32_t texel = rng_below(&random_state, (uint32_t)view.tile_texels * view.tile_texels);
    int64_t at = (int64_t)view.depth[texel] << (view.tile_log2 + view.depth_log2);
    uint32_t kind = rng_below(&random_state, 8);
    if (kind == 0) return rng_wide_i32(&random_state, 31);
    return (int32_t)i128_clamp(at + rng_wide_i32(&random_state, 2 + 2 * kind), INT32_MIN, INT32_MAX);
}

typedef struct {
    tally error, ends, neighbours;
    worst w;
} verdict;

static void try_point(verdict *result, int32_t u, int32_t v, int32_t d)
{
    i128 numerator, denominator = exact_attenuation(&numerator, u, v, d);
    uint32_t a = gn_filter_attenuation(&frame, &view, u, v, d);
    long double error = (long double)i128_abs((i128)a * denominator - numerator) / (long double)denominator;
    int eight = frame.knobs.atten_bits == 8;
    /* within half an LSB and a little; 8 bits: half a step of 256 more, and a multiple of it */
    HOLDS(&result->error, error <= (eight ? 128.52L : 0.52L) && (!eight || a % 256 == 0),
          "filter %d, T %d, F 2^%d, depth fraction %d: (%d, %d) at %d: errs by %.4Lf", (int)view.filter, (int)view.tile_texels,
          (int)frame.knobs.weight_bits, (int)frame.knobs.shadow_depth_frac, (int)u, (int)v, (int)d, error);
    if (!eight) WORST(&result->w, error, "filter %d, F 2^%d", (int)view.filter, (int)frame.knobs.weight_bits);
    if (numerator == 0) HOLDS(&result->ends, a == 0, "filter %d: shadowed is %u", (int)view.filter, (unsigned)a);
    if (numerator == 65536 * denominator) HOLDS(&result->ends, a == 65536, "filter %d: lit is %u", (int)view.filter, (unsigned)a);
}

/* Tiles in memory of exactly their size, so that a sanitizer sees a tap that leaves them. */
static void test_attenuation(void)
{
    static verdict result;
    for (uint32_t i = 0; i < 4000; i++) {
        view.tile_log2 = (uint8_t)(3 + rng_below(&random_state, 4));
        view.tile_texels = (uint16_t)(1U << view.tile_log2);
        uint16_t *texels = malloc(sizeof *texels << 2 * view.tile_log2);
        if (!texels) {
            CHECK(texels != NULL);
            return;
        }
        random_view(texels, i);
        for (int k = 0; k < 40; k++) {
            int32_t u = random_position(), v = random_position(), d = random_depth();
            try_point(&result, u, v, d);
        }
        free(texels);
    }
    CHECK_TALLY(result.error, "attenuation is the rounded rational");
    CHECK_TALLY(result.ends, "fully lit is 65536, fully shadowed is 0");
    printf("gn_filter_attenuation, 16 bits: %.4Lf LSB of Q16 with %s\n", result.w.error, result.w.at);
}

/* Whatever its neighbours in the atlas hold, a tile answers the same; at corners, borders and far outside. */
static void test_neighbours(void)
{
    static verdict result;
    for (uint32_t i = 0; i < 200; i++) {
        view.tile_log2 = (uint8_t)(3 + rng_below(&random_state, 3));
        view.tile_texels = (uint16_t)(1U << view.tile_log2);
        uint32_t n = 1U << 2 * view.tile_log2, first = n * rng_below(&random_state, GN_ATLAS_SIZE * GN_ATLAS_SIZE / n);
        random_view(frame.atlas + first, i);
        for (int k = 0; k < 100; k++) {
            int32_t u = random_position(), v = random_position(), d = random_depth();
            uint32_t answer[2];
            for (int poison = 0; poison < 2; poison++) {
                uint32_t before = first < 1200 ? first : 1200, after = GN_ATLAS_SIZE * GN_ATLAS_SIZE - first - n;
                memset(frame.atlas + first - before, poison ? 0xFF : 0, before * sizeof *frame.atlas);
                memset(frame.atlas + first + n, poison ? 0xFF : 0, (after < 1200 ? after : 1200) * sizeof *frame.atlas);
                answer[poison] = gn_filter_attenuation(&frame, &view, u, v, d);
            }
            HOLDS(&result.neighbours, answer[0] == answer[1], "filter %d, T %d: (%d, %d) at %d", (int)view.filter,
                  (int)view.tile_texels, (int)u, (int)v, (int)d);
            try_point(&result, u, v, d);
        }
    }
    CHECK_TALLY(result.neighbours, "neighbours in the atlas do not matter");
    CHECK_TALLY(result.error, "attenuation in the atlas");
}

/* An edge of shadow moved across a tile: lit and shadowed are exact away from it, for every filter and weight precision. */
static void test_lit_and_shadowed(void)
{
    static uint16_t texels[16 * 16];
    tally t = {0};
    view.tile_log2 = 4;
    view.tile_texels = 16;
    view.depth_log2 = 0;
    view.depth = texels;
    for (uint32_t filter = 0; filter < 5; filter++)
        for (int32_t bits = 4; bits <= 12; bits++)
            for (uint32_t i = 0; i < 1000; i++) {
                view.filter = (uint8_t)filter;
                frame.knobs.weight_bits = bits;
                frame.knobs.atten_bits = i & 1 ? 8 : 16;
                frame.knobs.shadow_depth_frac = (int32_t)(i % 5);
                int32_t u = random_position(), v = random_position();
                memset(texels, 0xFF, sizeof texels);
                build_blocks();
                HOLDS(&t, gn_filter_attenuation(&frame, &view, u, v, INT32_MAX) == 65536, "empty tile, filter %u",
                      (unsigned)filter);
                memset(texels, 0, sizeof texels);
                build_blocks();
                HOLDS(&t, gn_filter_attenuation(&frame, &view, u, v, 65536) == 0, "full tile, filter %u", (unsigned)filter);
                HOLDS(&t, gn_filter_attenuation(&frame, &view, u, v, INT32_MIN) == 65536, "before the light, filter %u",
                      (unsigned)filter);
            }
    CHECK_TALLY(t, "empty and full tiles");
}

int main(void)
{
    test_weights();
    test_attenuation();
    test_neighbours();
    test_lit_and_shadowed();
    return check_report();
}
