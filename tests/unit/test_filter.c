/* Shadow filters against exact rationals: tent weights as integrals, attenuation as sums of weights over compares; the
 * disk against its formula in reals and against the area of a disk. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "exact.h"
#include "knobs.h"
#include "base/gn_math.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_filter.h"
#include "gnomon.h"
#include "rng.h"

static rng random_state = {4};

/* ---- Weights ----------------------------------------------------------------------------------------------------- */

/* Twice the integral of max(0, h - |t - c|) from minus infinity to x. */
static int64_t twice_tent_integral(int64_t x, int64_t c, int64_t h)
{
    if (x <= c - h) return 0;
    if (x >= c + h) return 2 * h * h;
    return x <= c ? (x - c + h) * (x - c + h) : 2 * h * h - (c + h - x) * (c + h - x);
}

/* The weight of texel i of 2 (k + 1), over (2k + 1)^2 F^2. In units of 1 / 2F texel, counted from the texel border that
 * floor(centre + 1/2) names, the tent's centre is 2u - F, its half width (2k + 1) F, and texel i begins at 2F (i - k -
 * 1). */
static int64_t exact_weight(int32_t k, int32_t i, int64_t u, int64_t f)
{
    int64_t c = 2 * u - f, h = (2 * k + 1) * f, from = 2 * f * (i - k - 1);
    return (twice_tent_integral(from + 2 * f, c, h) - twice_tent_integral(from, c, h)) / 2;
}

/* Weights of tents against the integral. [F3] */
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
                    HOLDS(&weight, w[i] == exact, "k %d, F 2^%d, u %u, texel %d: %u, not %lld", (int)k, (int)bits,
                          (unsigned)u, (int)i, (unsigned)w[i], (long long)exact);
                    total += w[i];
                }
                HOLDS(&sum, total == (2 * k + 1) * (2 * k + 1) * f * f && w[n] == 0xDEADBEEFU,
                      "k %d, F 2^%d, u %u: %lld", (int)k, (int)bits, (unsigned)u, (long long)total);
            }
    CHECK_TALLY(weight, "tent weights are the integral");
    CHECK_TALLY(sum, "tent weights sum to the whole and end where they should");
}

#if GN_INTERPOLATES && GN_FILTER_MAX >= 2
/* The table of subsets against the integral at 1/32 texel, in Q12: weights nearest to it, but the largest, which takes
 * what the others' roundings leave; sums of each subset; mirror images. */
static void test_tent_sums(void)
{
    enum { F = 32, WHOLE = 9 * F * F };
    tally weight = {0}, sum = {0}, mirrored = {0};
    for (int32_t u = 0; u < F; u++) {
        const uint16_t *sums = gn_tent_sums[u];
        int32_t largest = 0;
        for (int32_t i = 1; i < 4; i++)
            if (sums[1 << i] > sums[1 << largest]) largest = i;
        for (int32_t i = 0; i < 4; i++) {
            int64_t off = (int64_t)sums[1 << i] * WHOLE - exact_weight(1, i, u, F) * 4096;
            HOLDS(&weight, (off < 0 ? -off : off) * 2 <= (i == largest ? 3 : 1) * WHOLE, "u %d, texel %d: %u", (int)u,
                  (int)i, (unsigned)sums[1 << i]);
            if (u) HOLDS(&mirrored, sums[1 << i] == gn_tent_sums[F - u][8 >> i], "u %d, texel %d", (int)u, (int)i);
        }
        for (uint32_t bits = 0; bits < 16; bits++) {
            uint32_t all = 0;
            for (int32_t i = 0; i < 4; i++) all += bits >> i & 1U ? sums[1 << i] : 0;
            HOLDS(&sum, sums[bits] == all && (bits < 15 || all == 4096), "u %d, subset %u: %u", (int)u, (unsigned)bits,
                  (unsigned)sums[bits]);
        }
    }
    CHECK_TALLY(weight, "weights of the table are the integral");
    CHECK_TALLY(sum, "sums of subsets");
    CHECK_TALLY(mirrored, "weights of the table are symmetric");
}
#endif

/* ---- Attenuation, exactly ---------------------------------------------------------------------------------------- */

#if GN_RUNTIME_KNOBS
#define BUILT_DEPTH_BITS                                                                                               \
    {                                                                                                                  \
        8, 16, 32                                                                                                      \
    }
#else
#define BUILT_DEPTH_BITS                                                                                               \
    {                                                                                                                  \
        GN_DEPTH_BITS, GN_OTHER_DEPTH_BITS, GN_DEPTH_BITS                                                              \
    }
#endif

static gn_frame frame;
static gn_scene scene;
static gn_light_view view;
static gn_depth_block blocks[GN_ATLAS_SIZE * GN_ATLAS_SIZE / 64];

/* The tile as the oracle sees it: upper bits of 32. */
static int32_t outside(int64_t i)
{
    return i < 0 || i >= view.tile_texels;
}

static uint32_t stored(int64_t i, int64_t j)
{
    size_t u = (size_t)i128_clamp(i, 0, view.tile_texels - 1), v = (size_t)i128_clamp(j, 0, view.tile_texels - 1);
    size_t at = v * view.tile_texels + u;
    if (view.depth_bits == 8) return (uint32_t)view.depth.d8[at] << 24;
    if (view.depth_bits == 16) return (uint32_t)view.depth.d16[at] << 16;
    return view.depth.d32[at];
}

static void store(size_t at, uint32_t depth)
{
    if (view.depth_bits == 8) view.depth.d8[at] = (uint8_t)(depth >> 24);
    else if (view.depth_bits == 16) view.depth.d16[at] = (uint16_t)(depth >> 16);
    else view.depth.d32[at] = depth;
}

/* Whether the texel (i, j) lets the receiver be lit: its depth at the texel that is read, rounded to nearest in steps
 * of 2^-(bits + frac), limited to the far value. Depth 0 lies before all texels. */
static int exact_lit(const gn_receiver *r, int64_t i, int64_t j)
{
    if (!r->depth_q32 || (view.border_lit && (outside(i) || outside(j)))) return 1;
    int frac = view.depth_bits == 32 ? 0 : GN_DEPTH_FRAC_BITS, bits = view.depth_bits;
    i128 x_q44 = (i128)r->depth_q32 << 12, two = 2 << 28;
    i128 u = i128_clamp(i, 0, view.tile_texels - 1), v = i128_clamp(j, 0, view.tile_texels - 1);
    x_q44 += i128_clamp(r->slope_q28[0], -two, two) * (65536 * u + 32768 - r->u_q16);
    x_q44 += i128_clamp(r->slope_q28[1], -two, two) * (65536 * v + 32768 - r->v_q16);
    i128 far = ((i128)1 << bits) - 1, depth = i128_round_shr(x_q44, 44 - bits - frac);
    if (depth > far << frac) depth = far << frac;
    return depth <= (i128)(stored(i, j) >> (32 - bits)) << frac;
}

/* Taps of one axis: the first texel and the weights, over `whole`. */
static int32_t exact_taps(int64_t *first, int64_t w[GN_TENT_TAPS_MAX], i128 *whole, int32_t c_q16)
{
    int32_t k = view.filter - 1, bits = GN_FILTER_BITS(&frame);
    int64_t f = (int64_t)1 << bits, c = (int64_t)c_q16 + 32768;
    int64_t texel = (int64_t)i128_floor_div(c, 65536), u = (int64_t)i128_round_shr(c - texel * 65536, 16 - bits);
    if (view.filter == GN_FILTER_HARD) {
        *first = (int64_t)i128_floor_div(c_q16, 65536);
        *whole = 1;
        w[0] = 1;
        return 1;
    }
    *first = texel - (k + 1);
    if (view.filter == GN_FILTER_2X2) {
        *whole = f;
        w[0] = f - u;
        w[1] = u;
        return 2;
    }
    *whole = (2 * k + 1) * (2 * k + 1) * f * f;
    for (int32_t i = 0; i < 2 * (k + 1); i++) w[i] = exact_weight(k, i, u, f);
    return 2 * (k + 1);
}

/* Edges finer than texels, from the formula: MODEL 7. [F7] */
static long double outline(const gn_receiver *r, int64_t i, int64_t j, const int side[2], long double f)
{
    const int lit = exact_lit(r, i, j), n = GN_K(&frame, edge);
    int length[2];
    long double end[2] = {0, 0};
    for (int e = 0; e < 2; e++) {
        const int way = e ? 1 : -1;
        length[e] = n;
        for (int k = 1; k <= n; k++) {
            const int64_t a = i + way * k * !side[0], b = j + way * k * !side[1];
            const int own = exact_lit(r, a, b) == lit, other = exact_lit(r, a + side[0], b + side[1]) == lit;
            if (own && !other) continue;
            length[e] = k - 1;
            end[e] = own == other ? (own ? -0.5L : 0.5L) : 0;
            break;
        }
    }
    const long double t = (length[0] + f) / (length[0] + length[1] + 1);
    return t < 0.5L ? end[0] * (1 - 2 * t) : end[1] * (2 * t - 1);
}

static long double exact_edge(const gn_receiver *r)
{
    static const int sides[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const int64_t i = r->u_q16 >> 16, j = r->v_q16 >> 16;
    const long double f[2] = {r->u_q16 / 65536.0L - i, r->v_q16 / 65536.0L - j};
    const int lit = exact_lit(r, i, j);
    long double left = 1;
    if (view.border_lit && (outside(i) || outside(j))) return 1;
    for (int s = 0; s < 4; s++) {
        const int *side = sides[s], axis = !side[0];
        if (exact_lit(r, i + side[0], j + side[1]) == lit) continue;
        const long double y = side[axis] < 0 ? f[axis] : 1 - f[axis], line = outline(r, i, j, side, f[!axis]);
        left = fminl(left, view.filter == GN_FILTER_HARD ? y >= line : fmaxl(0, fminl(0.5L + y - line, 1)));
    }
    return lit ? left : 1 - left;
}

/* 65536 * attenuation as a rational: numerator; the denominator is returned. */
static i128 exact_attenuation(i128 *numerator, const gn_receiver *r)
{
    int64_t u0, v0, wu[GN_TENT_TAPS_MAX], wv[GN_TENT_TAPS_MAX];
    i128 whole_u, whole_v, sum = 0;
    int32_t nu = exact_taps(&u0, wu, &whole_u, r->u_q16), nv = exact_taps(&v0, wv, &whole_v, r->v_q16);
    for (int32_t j = 0; j < nv; j++)
        for (int32_t i = 0; i < nu; i++)
            if (exact_lit(r, u0 + i, v0 + j)) sum += (i128)wu[i] * wv[j];
    *numerator = sum * 65536;
    return whole_u * whole_v;
}

/* ---- The disk, from its formula ---------------------------------------------------------------------------------- */

static long double disk_x[64], disk_y[64];

static void build_disk(void)
{
    for (uint32_t i = 0; i < 64; i++) {
        uint32_t a = 0, b = 0, direction = 0x80000000U;
        for (uint32_t bit = 0; bit < 32; bit++) {
            a |= ((i >> bit) & 1U) << (31 - bit);
            if ((i >> bit) & 1U) b ^= direction;
            direction ^= direction >> 1;
        }
        long double radius = sqrtl((long double)(a ^ 0x9E3779B9U) / 4294967296.0L);
        long double angle = EXACT_TAU * (long double)(b ^ 0x7F4A7C15U) / 4294967296.0L;
        disk_x[i] = radius * cosl(angle);
        disk_y[i] = radius * sinl(angle);
    }
}

/* The fewest and the most lit samples: a sample within 2^-11 texels of a border between texels may fall on either side.
 */
static void disk_lit_range(const gn_receiver *r, uint32_t *fewest, uint32_t *most)
{
    uint32_t v = ((uint32_t)r->pixel_x * 0x8DA6B343U) ^ ((uint32_t)r->pixel_y * 0xD8163841U);
    v = (v ^ (v >> 15)) * 0x2C1B3C6DU;
    v = v ^ (v >> 13);
    long double turn = EXACT_TAU * (long double)(v >> 16) / 65536.0L, c = cosl(turn), s = sinl(turn),
                slack = 1 / 2048.0L;
    long double radius = (long double)i128_clamp(view.disk_radius_q16, 0, 8 * 65536) / 65536.0L;
    *fewest = *most = 0;
    for (uint32_t k = 0; k < scene.shadow.disk_samples; k++) {
        long double x = r->u_q16 / 65536.0L + radius * (disk_x[k] * c - disk_y[k] * s);
        long double y = r->v_q16 / 65536.0L + radius * (disk_x[k] * s + disk_y[k] * c);
        int any = 0, all = 1;
        for (int64_t j = (int64_t)floorl(y - slack); j <= (int64_t)floorl(y + slack); j++)
            for (int64_t i = (int64_t)floorl(x - slack); i <= (int64_t)floorl(x + slack); i++) {
                int is_lit = exact_lit(r, i, j);
                any |= is_lit;
                all &= is_lit;
            }
        *fewest += (uint32_t)all;
        *most += (uint32_t)any;
    }
}

/* ---- Random tiles and receivers ---------------------------------------------------------------------------------- */

/* The bounds that belong to the tile's present texels. */
static void build_blocks(void)
{
    view.block = blocks;
    gn_blocks_build(&view);
}

static gn_texels at_bytes(void *bytes)
{
    gn_texels t;
    if (view.depth_bits == 8) t.d8 = bytes;
    else if (view.depth_bits == 16) t.d16 = bytes;
    else t.d32 = bytes;
    return t;
}

static uint32_t random_depth_value(void)
{
    return rng_below(&random_state, 8) ? rng_u32(&random_state) : rng_below(&random_state, 2) ? 0xFFFFFFFFU : 0;
}

static void random_shape(int32_t most_log2)
{
    static const uint8_t depth_bits[3] = BUILT_DEPTH_BITS;
    view.tile_log2 = (uint8_t)rng_range(&random_state, 3, most_log2);
    view.tile_texels = view.tile_rows = (uint16_t)(1U << view.tile_log2);
    view.depth_bits = depth_bits[rng_below(&random_state, 3)];
}

static void random_view(void *texels)
{
    frame.scene = &scene;
    SET_KNOB(&frame, persp_step, rng_below(&random_state, 2) ? 1 : 8);
    SET_KNOB(&frame, edge, rng_below(&random_state, 2) ? rng_range(&random_state, 1, 8) : 0);
    scene.shadow.disk_samples = 1 + rng_below(&random_state, 64);
    view.filter = (uint8_t)rng_below(&random_state, 6);
    view.disk_radius_q16 =
        rng_below(&random_state, 4) ? rng_range(&random_state, 0, 8 * 65536) : rng_range(&random_state, 0, 8) * 65536;
    view.border_lit = (uint8_t)rng_below(&random_state, 2);
    view.depth = at_bytes(texels);
    uint32_t levels[3] = {20000U << 16, random_depth_value(), 0xFFFFFFFFU};
    /* 0: two flat halves, 1: texels of few levels, 2: of any, 3: a slope */
    uint32_t noise = rng_below(&random_state, 4), size = view.tile_texels;
    uint32_t edge_u = rng_below(&random_state, size), edge_v = rng_below(&random_state, size);
    uint32_t step_u = rng_u32(&random_state) / (2 * size), step_v = rng_u32(&random_state) / (2 * size);
    for (uint32_t t = 0; t < size * size; t++) {
        if (noise == 0) store(t, levels[t % size > edge_u && t / size > edge_v]);
        else if (noise == 3) store(t, t % size * step_u + t / size * step_v);
        else store(t, noise == 1 ? levels[rng_below(&random_state, 3)] : rng_u32(&random_state));
    }
    build_blocks();
}

/* A tile coordinate: inside, in a corner or at a border, on a grid line, far outside. */
static int32_t random_position(void)
{
    int32_t size = view.tile_texels * 65536;
    switch (rng_below(&random_state, 8)) {
    case 0:
        return rng_range(&random_state, -10 * 65536, 10 * 65536);
    case 1:
        return size + rng_range(&random_state, -10 * 65536, 10 * 65536);
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

/* A depth that is rounded to that of a texel, or just not, at that texel on the receiver's plane. */
static uint32_t depth_on_plane(const gn_receiver *r, int64_t i, int64_t j)
{
    int64_t last = view.tile_texels - 1,
            step = view.depth_bits == 32 ? 1 : (int64_t)1 << (32 - view.depth_bits - GN_DEPTH_FRAC_BITS);
    i128 two = 2 << 28, u = i128_clamp(i, 0, last), v = i128_clamp(j, 0, last);
    i128 rise_q44 = i128_clamp(r->slope_q28[0], -two, two) * (65536 * u + 32768 - r->u_q16) +
                    i128_clamp(r->slope_q28[1], -two, two) * (65536 * v + 32768 - r->v_q16);
    i128 depth = stored(i, j) + step / 2 - i128_floor_div(rise_q44, 4096) + rng_range(&random_state, -6, 6);
    return (uint32_t)i128_clamp(depth, 0, UINT32_MAX);
}

/* A depth at, just before and just behind a stored one near the receiver; sometimes anything. */
static gn_receiver random_receiver(void)
{
    gn_receiver r = {random_position(),
                     random_position(),
                     0,
                     {0, 0},
                     rng_range(&random_state, 0, 2047),
                     rng_range(&random_state, 0, 2047)};
    uint32_t kind = rng_below(&random_state, 8);
    int32_t near_u = rng_range(&random_state, -4, 4), near_v = rng_range(&random_state, -4, 4);
    int64_t at = stored((r.u_q16 >> 16) + near_u, (r.v_q16 >> 16) + near_v);
    if (kind == 0) r.depth_q32 = rng_u32(&random_state);
    else r.depth_q32 = (uint32_t)i128_clamp(at + rng_wide_i32(&random_state, 4 * kind), 0, UINT32_MAX);
    if (rng_below(&random_state, 2)) {
        r.slope_q28[0] = rng_below(&random_state, 4) ? rng_wide_i32(&random_state, 29) : 0;
        r.slope_q28[1] = rng_below(&random_state, 4) ? rng_wide_i32(&random_state, 29) : 0;
        if (!rng_below(&random_state, 64)) r.slope_q28[0] = rng_below(&random_state, 2) ? INT32_MIN : INT32_MAX;
        if (!rng_below(&random_state, 64)) r.slope_q28[1] = rng_below(&random_state, 2) ? INT32_MIN : INT32_MAX;
        if (rng_below(&random_state, 2))
            r.depth_q32 = depth_on_plane(&r, (r.u_q16 >> 16) + near_u, (r.v_q16 >> 16) + near_v);
    }
    return r;
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

typedef struct {
    tally error, ends, disk, same, neighbours, finer;
    uint64_t n_disk_samples, n_disk_open, n_finer;
    worst w;
} verdict;

static const char *described(const gn_receiver *r)
{
    static char text[240];
    snprintf(text, sizeof text,
             "filter %d, T %d, %d bits, F 2^%d, border %d, disk %d of %u, at (%d, %d), depth %u, slopes %d %d, "
             "pixel %d %d",
             (int)view.filter, (int)view.tile_texels, (int)view.depth_bits, (int)GN_FILTER_BITS(&frame),
             (int)view.border_lit, (int)view.disk_radius_q16, (unsigned)scene.shadow.disk_samples, (int)r->u_q16,
             (int)r->v_q16, (unsigned)r->depth_q32, (int)r->slope_q28[0], (int)r->slope_q28[1], (int)r->pixel_x,
             (int)r->pixel_y);
    return text;
}

static uint32_t rounded_share(uint32_t n_lit, uint32_t n)
{
    return (uint32_t)i128_floor_div(((i128)n_lit * 131072 + n), 2 * n);
}

static void try_disk(verdict *result, const gn_receiver *r, uint32_t a)
{
    uint32_t fewest, most, n = scene.shadow.disk_samples;
    disk_lit_range(r, &fewest, &most);
    result->n_disk_samples += n;
    result->n_disk_open += most - fewest;
    int found = 0;
    for (uint32_t n_lit = fewest; n_lit <= most; n_lit++) found |= a == rounded_share(n_lit, n);
    HOLDS(&result->disk, found, "%u is not %u .. %u lit samples: %s", (unsigned)a, (unsigned)fewest, (unsigned)most,
          described(r));
}

static void try_point(verdict *result, const gn_receiver *r)
{
    uint32_t a = gn_filter_attenuation(&frame, &view, r);
    if (view.filter == GN_FILTER_DISK) {
        try_disk(result, r, a);
        return;
    }
    if (GN_VIEW_EDGE(&frame, &view)) {
        const long double off = fabsl(a - 65536 * exact_edge(r));
        result->n_finer += a && a < 65536;
        HOLDS(&result->finer, off < (view.filter == GN_FILTER_HARD ? 0 : 1) + 1e-9L, "edge %d errs by %.4Lf: %s",
              (int)GN_K(&frame, edge), off, described(r));
        return;
    }
    i128 numerator, denominator = exact_attenuation(&numerator, r);
    long double error = (long double)i128_abs((i128)a * denominator - numerator) / (long double)denominator;
    HOLDS(&result->error, error <= 0.52L, "errs by %.4Lf: %s", error, described(r));
    WORST(&result->w, error, "%s", described(r));
    if (numerator == 0) HOLDS(&result->ends, a == 0, "shadowed is %u: %s", (unsigned)a, described(r));
    if (numerator == 65536 * denominator) HOLDS(&result->ends, a == 65536, "lit is %u: %s", (unsigned)a, described(r));
}

/* With bounds that never answer. */
static void try_without_blocks(verdict *result, const gn_receiver *r)
{
    static const gn_depth_block unknown = {0, 65535};
    static gn_depth_block none[4096 / 64];
    uint32_t with = gn_filter_attenuation(&frame, &view, r);
    for (size_t i = 0; i < 4096 / 64; i++) none[i] = unknown;
    view.block = none;
    HOLDS(&result->same, gn_filter_attenuation(&frame, &view, r) == with, "%s", described(r));
    view.block = blocks;
}

/* Tiles in memory of exactly their size, so that a sanitizer sees a tap that leaves them. */
static void test_attenuation(void)
{
    static verdict result;
    for (uint32_t i = 0; i < 8000; i++) {
        random_shape(6);
        void *texels = malloc((size_t)(view.depth_bits / 8) << 2 * view.tile_log2);
        if (!texels) {
            CHECK(texels != NULL);
            return;
        }
        random_view(texels);
        for (int k = 0; k < 30; k++) {
            gn_receiver r = random_receiver();
            try_point(&result, &r);
            try_without_blocks(&result, &r);
        }
        free(texels);
    }
    CHECK_TALLY(result.error, "attenuation is the rounded rational");
    CHECK_TALLY(result.disk, "attenuation of the disk is a rounded count of its samples");
    CHECK_TALLY(result.ends, "fully lit is 65536, fully shadowed is 0");
#if GN_EDGE_BUILT
    CHECK_TALLY(result.finer, "edges finer than texels are those of the formula");
    CHECK(result.n_finer > 2000);
#endif
    CHECK_TALLY(result.same, "the same with and without bounds of blocks");
    CHECK(result.n_disk_open * 200 <
          result.n_disk_samples); /* few samples lie so near to a border that they may go either way */
    printf("gn_filter_attenuation, 16 bits: %.4Lf LSB of Q16 with %s\n", result.w.error, result.w.at);
}

/* Whatever its neighbours in the atlas hold, a tile answers the same [P8]; at corners, borders and far outside. */
static void test_neighbours(void)
{
    static verdict result;
    uint8_t *atlas = frame.atlas.d8;
    for (uint32_t i = 0; i < 600; i++) {
        random_shape(5);
        size_t n = (size_t)(view.depth_bits / 8) << 2 * view.tile_log2; /* bytes */
        size_t first = n * rng_below(&random_state, (uint32_t)(sizeof frame.atlas / n)),
               after = sizeof frame.atlas - first - n;
        size_t poisoned_before = first < 4096 ? first : 4096, poisoned_after = after < 4096 ? after : 4096;
        random_view(atlas + first);
        view.filter = (uint8_t)(i % 6);
        for (int k = 0; k < 60; k++) {
            gn_receiver r = random_receiver();
            uint32_t answer[2];
            for (int poison = 0; poison < 2; poison++) {
                memset(atlas + first - poisoned_before, poison ? 0xFF : 0, poisoned_before);
                memset(atlas + first + n, poison ? 0xFF : 0, poisoned_after);
                answer[poison] = gn_filter_attenuation(&frame, &view, &r);
            }
            HOLDS(&result.neighbours, answer[0] == answer[1], "%s", described(&r));
            try_point(&result, &r);
        }
    }
    CHECK_TALLY(result.neighbours, "neighbours in the atlas do not matter");
    CHECK_TALLY(result.error, "attenuation in the atlas");
    CHECK_TALLY(result.disk, "attenuation of the disk in the atlas");
}

/* Empty and full tiles are lit and shadowed exactly, for every filter and depth. */
static void test_lit_and_shadowed(void)
{
    static uint32_t texels[16 * 16];
    static const uint8_t depth_bits[3] = BUILT_DEPTH_BITS;
    tally t = {0};
    frame.scene = &scene;
    scene.shadow.disk_samples = 11;
    view.tile_log2 = 4;
    view.tile_texels = view.tile_rows = 16;
    view.disk_radius_q16 = 3 * 65536;
    view.border_lit = 0;
    for (uint32_t filter = 0; filter < 6; filter++)
        for (int32_t step = 1; step <= 8; step += 7)
            for (uint32_t i = 0; i < 1000; i++) {
                view.filter = (uint8_t)filter;
                view.depth_bits = depth_bits[i % 3];
                view.depth = at_bytes(texels);
                SET_KNOB(&frame, persp_step, step);
                gn_receiver r = {random_position(), random_position(), 0xFFFFFFFFU, {0, 0},
                                 (int32_t)i,        (int32_t)filter};
                memset(texels, 0xFF, sizeof texels);
                build_blocks();
                HOLDS(&t, gn_filter_attenuation(&frame, &view, &r) == 65536, "empty tile: %s", described(&r));
                r.slope_q28[0] = r.slope_q28[1] = 1 << 29;
                HOLDS(&t, gn_filter_attenuation(&frame, &view, &r) == 65536, "empty tile: %s", described(&r));
                r.slope_q28[0] = r.slope_q28[1] = 0;
                memset(texels, 0, sizeof texels);
                build_blocks();
                r.depth_q32 = view.depth_bits == 32 ? 1 : 1U << (31 - view.depth_bits);
                if (r.depth_q32 > 1) r.depth_q32 >>= GN_DEPTH_FRAC_BITS; /* half a step: rounds up */
                HOLDS(&t, gn_filter_attenuation(&frame, &view, &r) == 0, "full tile: %s", described(&r));
                r.depth_q32 -= 1;
                HOLDS(&t, gn_filter_attenuation(&frame, &view, &r) == 65536, "at the light: %s", described(&r));
            }
    CHECK_TALLY(t, "empty and full tiles");
}

/* Bounds are those of the 16x16 texels from the block on, cut at the tile's border, and hold for 9x9 texels from
 * anywhere in it. */
static void test_blocks(void)
{
    static uint32_t texels[64 * 64];
    tally tight = {0}, holds = {0};
    for (uint32_t i = 0; i < 300; i++) {
        random_shape(6);
        random_view(texels);
        int32_t size = view.tile_texels;
        for (int32_t v = 0; v < size; v += 8)
            for (int32_t u = 0; u < size; u += 8) {
                uint32_t lo = 0xFFFFFFFFU, hi = 0;
                for (int32_t k = 0; k < 256; k++) {
                    uint32_t depth = stored(u + k % 16, v + k / 16); /* beyond the tile: its border once more */
                    if (depth < lo) lo = depth;
                    if (depth > hi) hi = depth;
                }
                const gn_depth_block *b =
                    gn_blocks_at(&view, u + rng_range(&random_state, 0, 7), v + rng_range(&random_state, 0, 7));
                HOLDS(&tight, b->lo == lo >> 16 && b->hi == hi >> 16, "%d bits, T %d, block at %d, %d: %u .. %u",
                      (int)view.depth_bits, (int)size, (int)u, (int)v, (unsigned)b->lo, (unsigned)b->hi);
            }
        for (int32_t k = 0; k < 50; k++) {
            int32_t n = rng_range(&random_state, 1, 18);
            int32_t u = rng_range(&random_state, -20, size + 20), v = rng_range(&random_state, -20, size + 20);
            gn_depth_block b =
                n <= GN_BLOCK_REACH && (k & 1) ? *gn_blocks_at(&view, u, v) : gn_blocks_over(&view, u, v, n);
            for (int32_t t = 0; t < n * n; t++) {
                uint32_t depth = stored(u + t % n, v + t / n);
                HOLDS(&holds, (uint32_t)b.lo << 16 <= depth && depth <= gn_block_highest(&b, view.depth_bits),
                      "%d bits, T %d, %d texels from %d, %d", (int)view.depth_bits, (int)size, (int)n, (int)u, (int)v);
            }
        }
    }
    for (uint32_t i = 0; i < 4000; i++) { /* one texel unlike all others, anywhere in the footprint */
        random_shape(6);
        view.depth = at_bytes(texels);
        memset(texels, 0x77, sizeof texels);
        int32_t last = view.tile_texels - 1, n = i & 1 ? 18 : rng_range(&random_state, 1, 18);
        int32_t u = rng_range(&random_state, 0, last), v = rng_range(&random_state, 0, last);
        int32_t at_u = u + (i & 2 ? n - 1 : rng_range(&random_state, 0, n - 1));
        int32_t at_v = v + (i & 4 ? n - 1 : rng_range(&random_state, 0, n - 1));
        uint32_t odd = i & 8 ? 0xFEDCBA98U : 0x01234567U;
        store((size_t)i128_clamp(at_v, 0, last) * view.tile_texels + (size_t)i128_clamp(at_u, 0, last), odd);
        build_blocks();
        gn_depth_block b = gn_blocks_over(&view, u, v, n);
        odd = stored(at_u, at_v);
        HOLDS(&holds, (uint32_t)b.lo << 16 <= odd && odd <= gn_block_highest(&b, view.depth_bits),
              "%d bits, T %d, %d texels from %d, %d, one at %d, %d", (int)view.depth_bits, (int)last + 1, (int)n,
              (int)u, (int)v, (int)at_u, (int)at_v);
    }
    CHECK_TALLY(tight, "bounds of blocks");
    CHECK_TALLY(holds, "bounds hold for every texel they answer for");
}

/* ---- The disk against the area of a disk ------------------------------------------------------------------------- */

/* Share of the disk's area over lit texels. */
static double disk_area_lit(const gn_receiver *r)
{
    enum { N = 192 };
    int32_t n = 0, n_lit = 0;
    for (int32_t j = 0; j < N; j++)
        for (int32_t i = 0; i < N; i++) {
            double x = (2 * i + 1.0) / N - 1, y = (2 * j + 1.0) / N - 1, radius = view.disk_radius_q16 / 65536.0;
            if (x * x + y * y >= 1) continue;
            n++;
            n_lit += stored((int64_t)floor(r->u_q16 / 65536.0 + radius * x),
                            (int64_t)floor(r->v_q16 / 65536.0 + radius * y)) != 0;
        }
    return (double)n_lit / n;
}

/* Half planes at any angle: the more samples, the nearer to the area; every count of samples from two is no worse
 * than random ones. A single one has always the same radius. [F4] */
static void test_disk_accuracy(void)
{
    enum { CASES = 600, N = 64 };
    static uint8_t texels[64 * 64];
    double sum2[65] = {0}, random2 = 0;
    frame.scene = &scene;
    if (!GN_RUNTIME_KNOBS) return; /* its texels are of 8 bits */
    view.filter = GN_FILTER_DISK;
    view.depth_bits = 8;
    view.tile_log2 = 6;
    view.tile_texels = view.tile_rows = 64;
    view.border_lit = 0;
    view.depth.d8 = texels;
    for (int32_t i = 0; i < CASES; i++) {
        double angle = 6.283185307 * rng_below(&random_state, 65536) / 65536, c = cos(angle), s = sin(angle);
        view.disk_radius_q16 = rng_range(&random_state, 3 * 65536 / 2, 8 * 65536);
        double shift = view.disk_radius_q16 / 65536.0 * rng_range(&random_state, -1000, 1000) / 1000;
        gn_receiver r = {rng_range(&random_state, 24 << 16, 40 << 16),
                         rng_range(&random_state, 24 << 16, 40 << 16),
                         1U << 31,
                         {0, 0},
                         rng_range(&random_state, 0, 319),
                         rng_range(&random_state, 0, 239)};
        for (int32_t t = 0; t < 64 * 64; t++)
            texels[t] =
                c * (t % 64 + 0.5 - r.u_q16 / 65536.0) + s * (t / 64 + 0.5 - r.v_q16 / 65536.0) > shift ? 255 : 0;
        build_blocks();
        double area = disk_area_lit(&r);
        random2 += area * (1 - area);
        for (uint32_t n = 1; n <= N; n++) {
            scene.shadow.disk_samples = n;
            double error = gn_filter_attenuation(&frame, &view, &r) / 65536.0 - area;
            sum2[n] += error * error;
        }
    }
    printf("disk against its area, half planes, rms:");
    for (uint32_t n = 1; n <= N; n *= 2) printf(" %.4f (%u)", sqrt(sum2[n] / CASES), (unsigned)n);
    printf("\n");
    tally falls = {0}, fair = {0};
    for (uint32_t n = 2; n <= N; n++)
        HOLDS(&fair, sum2[n] <= 1.15 * random2 / n, "%u samples: %.4f, random ones %.4f", (unsigned)n,
              sqrt(sum2[n] / CASES), sqrt(random2 / CASES / n));
    for (uint32_t n = 1; n < N; n *= 2)
        HOLDS(&falls, sum2[2 * n] <= 0.64 * sum2[n], "from %u samples to %u: %.4f to %.4f", (unsigned)n,
              (unsigned)(2 * n), sqrt(sum2[n] / CASES), sqrt(sum2[2 * n] / CASES));
    CHECK_TALLY(fair, "no number of samples is worse than random ones");
    CHECK_TALLY(falls, "twice the samples: at most 4/5 of the error");
    CHECK(sqrt(sum2[64] / CASES) < 0.02);
}

int main(void)
{
    build_disk();
    test_weights();
#if GN_INTERPOLATES && GN_FILTER_MAX >= 2
    test_tent_sums();
#endif
    test_attenuation();
    test_neighbours();
    test_lit_and_shadowed();
    test_blocks();
    test_disk_accuracy();
    return check_report();
}
