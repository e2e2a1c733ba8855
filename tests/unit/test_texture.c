/* Textures against double precision, in every format: addressing and alpha exactly, colour within the stated bound. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "exact.h"
#include "geometry/gn_xform.h"
#include "geometry/gn_texture.h"
#include "gnomon.h"
#include "rng.h"

static rng random_state = {9};

static double linear(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* ---- The oracle -------------------------------------------------------------------------------------------------- */

static int64_t addressed(int64_t i, int64_t size, int clamped)
{
    if (clamped) return (int64_t)i128_clamp(i, 0, size - 1);
    return i - (int64_t)i128_floor_div(i, size) * size;
}

/* `n` bits of a row, the first ones the highest of a byte. */
static unsigned bits_at(const uint8_t *row, size_t first, size_t n)
{
    unsigned v = 0;
    for (size_t i = first; i < first + n; i++) v = 2 * v + ((uint32_t)row[i / 8] >> (7 - i % 8) & 1U);
    return v;
}

static size_t side(const gn_texture *t, int axis)
{
    if (axis ? t->height : t->width) return axis ? t->height : t->width;
    return (size_t)1 << (axis ? t->height_log2 : t->width_log2);
}

static size_t bits_of(uint8_t format)
{
    static const size_t bits[GN_TEXTURE_FORMAT_COUNT] = {32, 16, 16, 8, 4, 1, 8, 4, 8, 4};
    return bits[format];
}

/* Channel c of a texel, 0..1, as it is stored: from the words of gnomon.h, format by format. */
static double stored_value(const gn_texture *t, size_t x, size_t y, int c)
{
    const size_t n = bits_of(t->format);
    const uint8_t *row = t->rgba + y * ((side(t, 0) * n + 7) / 8);
    const unsigned word = n == 16 ? row[2 * x] + 256U * row[2 * x + 1] : 0;
    switch (t->format) {
    case GN_TEXTURE_RGBA8888:
        return row[4 * x + (size_t)c] / 255.0;
    case GN_TEXTURE_RGB565:
        return c == 0 ? (word / 2048) / 31.0 : c == 1 ? (word / 32 % 64) / 63.0 : c == 2 ? (word % 32) / 31.0 : 1.0;
    case GN_TEXTURE_RGB565A1:
        return c == 3 ? word / 32 % 2 : (c == 0 ? word / 2048 : c == 1 ? word / 64 % 32 : word % 32) / 31.0;
    case GN_TEXTURE_PALETTE8:
    case GN_TEXTURE_PALETTE4:
    case GN_TEXTURE_PALETTE1:
        return t->palette[4 * bits_at(row, x * n, n) + (unsigned)c] / 255.0;
    case GN_TEXTURE_GREY8:
    case GN_TEXTURE_GREY4:
        return c == 3 ? 1.0 : bits_at(row, x * n, n) / (ldexp(1, (int)n) - 1);
    default:
        return c < 3 ? 1.0 : bits_at(row, x * n, n) / (ldexp(1, (int)n) - 1);
    }
}

static double texel_value(const gn_texture *t, int64_t i, int64_t j, int channel)
{
    int64_t u = addressed(i, (int64_t)side(t, 0), t->flags & GN_TEXTURE_CLAMP_U);
    int64_t v = addressed(j, (int64_t)side(t, 1), t->flags & GN_TEXTURE_CLAMP_V);
    double value = stored_value(t, (size_t)u, (size_t)v, channel);
    return channel < 3 ? linear(value) : value;
}

/* The texture's value at a place in texels, half a texel less if bilinear. */
static double value_at(const gn_texture *t, int64_t i, int64_t j, double fu, double fv, int channel)
{
    if (!(t->flags & GN_TEXTURE_BILINEAR)) return texel_value(t, i, j, channel);
    double upper = (1 - fu) * texel_value(t, i, j, channel) + fu * texel_value(t, i + 1, j, channel);
    double lower = (1 - fu) * texel_value(t, i, j + 1, channel) + fu * texel_value(t, i + 1, j + 1, channel);
    return (1 - fv) * upper + fv * lower;
}

/* 65536 times the texture's value at (u, v). */
static double exact_value(const gn_texture *t, int32_t u_q20, int32_t v_q20, int channel)
{
    double half = t->flags & GN_TEXTURE_BILINEAR ? 0.5 : 0; /* exact, and so is what follows */
    double x = ldexp(u_q20, -20) * (double)side(t, 0) - half, y = ldexp(v_q20, -20) * (double)side(t, 1) - half;
    return 65536 * value_at(t, (int64_t)floor(x), (int64_t)floor(y), x - floor(x), y - floor(y), channel);
}

/* ---- Random textures and coordinates ----------------------------------------------------------------------------- */

/* Memory of exactly the texture's size, so that a sanitizer sees a texel outside. */
static uint8_t *random_texels(gn_texture *t)
{
    static uint8_t palette[4 * 256];
    size_t n = side(t, 1) * ((side(t, 0) * bits_of(t->format) + 7) / 8);
    uint8_t *texels = malloc(n);
    uint32_t kind = rng_below(&random_state, 3);
    if (!texels) return NULL;
    for (size_t i = 0; i < n; i++) {
        uint8_t any = (uint8_t)rng_u32(&random_state);
        texels[i] = kind == 0 ? any : kind == 1 ? (any & 1 ? 255 : 0) : (uint8_t)(i * 7);
    }
    for (size_t i = 0; i < sizeof palette; i++) palette[i] = (uint8_t)rng_u32(&random_state);
    t->rgba = texels;
    t->palette = t->format >= GN_TEXTURE_PALETTE8 && t->format <= GN_TEXTURE_PALETTE1 ? palette : NULL;
    return texels;
}

/* Powers of two, said either way, and any other size. */
static void random_size(gn_texture *t)
{
    static const uint16_t odd[][2] = {{1, 1}, {3, 5}, {1, 7}, {9, 1}, {100, 30}, {63, 65}, {31, 17}};
    t->width = t->height = 0;
    t->width_log2 = (uint8_t)rng_below(&random_state, 7);
    t->height_log2 = (uint8_t)rng_below(&random_state, 7);
    switch (rng_below(&random_state, 4)) {
    case 0:
        break;
    case 1:
        t->width = (uint16_t)(1 << t->width_log2);
        t->height = (uint16_t)(1 << t->height_log2);
        t->width_log2 = 200; /* not looked at */
        break;
    case 2: {
        const uint16_t *size = odd[rng_below(&random_state, 7)];
        t->width = size[0];
        t->height = size[1];
        break;
    }
    default:
        t->width = (uint16_t)rng_range(&random_state, 1, 70);
        t->height = (uint16_t)rng_range(&random_state, 1, 70);
    }
}

static int32_t random_coordinate(size_t size)
{
    static const int32_t special[8] = {INT32_MIN, INT32_MAX, 0, 1 << 20, -(1 << 20), (1 << 20) - 1, -1, 1 << 19};
    switch (rng_below(&random_state, 6)) {
    case 0:
        return special[rng_below(&random_state, 8)];
    case 1:
        return rng_wide_i32(&random_state, 31);
    case 2: /* at a border of texels or its middle, and its neighbours */
        return (int32_t)floor(rng_range(&random_state, -2, (int32_t)(4 * size)) * ldexp(1, 19) / (double)size) +
               rng_range(&random_state, -1, 1);
    default:
        return rng_range(&random_state, -3 * (1 << 20), 3 * (1 << 20));
    }
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

typedef struct {
    tally nearest, bilinear, colour_nearest, colour_bilinear;
    worst w, colour;
} verdict;

static void try_lookup(verdict *result, const gn_texture *t)
{
    int32_t u = random_coordinate(side(t, 0)), v = random_coordinate(side(t, 1));
    uint32_t rgb[4] = {0, 0, 0, 0xDEADBEEFU};
    int bilinear = (t->flags & GN_TEXTURE_BILINEAR) != 0;
    double finer = 2 * bilinear; /* coordinates have 20 bits below a texel, weights 16 */
    gn_texture_colour(t, u, v, rgb);
    HOLDS(&result->colour_nearest, rgb[3] == 0xDEADBEEFU, "more than three channels written");
    double exact = exact_value(t, u, v, 3), error = fabs(gn_texture_alpha(t, u, v) - exact);
    HOLDS(bilinear ? &result->bilinear : &result->nearest, error <= (bilinear ? 1.5001 : 0.5) + finer,
          "format %d, %dx%d, flags %d, (%d, %d): alpha is off by %.3f from %.3f", (int)t->format, (int)side(t, 0),
          (int)side(t, 1), (int)t->flags, (int)u, (int)v, error, exact);
    if (bilinear) WORST(&result->w, (long double)error, "flags %d", (int)t->flags);
    for (int c = 0; c < 3; c++) {
        double decoded = exact_value(t, u, v, c), colour_error = fabs(rgb[c] - decoded);
        HOLDS(bilinear ? &result->colour_bilinear : &result->colour_nearest,
              colour_error <= (bilinear ? 2.0001 : 1.0001) + finer,
              "format %d, %dx%d, flags %d, (%d, %d): colour %d is %u, not %.3f", (int)t->format, (int)side(t, 0),
              (int)side(t, 1), (int)t->flags, (int)u, (int)v, c, (unsigned)rgb[c], decoded);
        WORST(&result->colour, (long double)colour_error, "flags %d", (int)t->flags);
    }
}

/* Along a curve every pixel that is asked is kept as the alpha of its coordinates has it. */
static void try_curve(tally *same, const gn_texture *t)
{
    gn_texture_curve curve;
    const uint32_t least = rng_below(&random_state, 4) ? rng_below(&random_state, 65537) : 65535; /* or whole alpha */
    const gn_alpha_test test = {least, rng_below(&random_state, 65537), rng_below(&random_state, 4) == 0,
                                rng_range(&random_state, 0, 1000), rng_range(&random_state, 0, 1000)};
    const uint32_t bits = rng_u32(&random_state) >> rng_below(&random_state, 32) & rng_u32(&random_state);
    for (int i = 0; i < 2; i++) {
        curve.from_q20[i] = random_coordinate(side(t, i));
        curve.at_q28[i] = rng_range(&random_state, -(1 << 24), 1 << 24);
        curve.step_q28[i] = rng_range(&random_state, -(1 << 24), 1 << 24) >> rng_below(&random_state, 8);
        curve.bend_q28[i] = curve.step_q28[i] / rng_range(&random_state, 33, 330);
    }
    const uint32_t passed = gn_texture_keeps(t, &curve, bits, &test);
    HOLDS(same, !(passed & ~bits), "pixels that were not asked");
    for (int32_t k = 0; k < 32; k++) {
        if (!(bits >> k & 1U)) continue;
        uint32_t c[2];
        for (int i = 0; i < 2; i++)
            c[i] = (uint32_t)curve.from_q20[i] +
                   (uint32_t)((curve.at_q28[i] + k * curve.step_q28[i] + k * (k - 1) / 2 * curve.bend_q28[i]) >> 8);
        const uint32_t alpha_uq16 = gn_texture_alpha(t, (int32_t)c[0], (int32_t)c[1]), /* 65536: 1 */
            alpha = alpha_uq16 - (alpha_uq16 > 32768);
        const int want = test.dithers ? gn_mul_uq16(test.whole_uq16, alpha_uq16) >= gn_noise_uq16(test.x + k, test.y)
                                      : alpha >= test.least;
        HOLDS(same, (int)(passed >> k & 1U) == want, "format %d, %dx%d, flags %d, (%d, %d): pixel %d of %x",
              (int)t->format, (int)side(t, 0), (int)side(t, 1), (int)t->flags, (int)c[0], (int)c[1], (int)k,
              (unsigned)bits);
    }
}

#if GN_INTERPOLATES
/* A row of pixels: texels of the oracle, weighted with what 8 bits leave of the place. Rounded down once, and each
 * texel to the nearest: NUMERICS 4.12. */
static void try_row(tally *close, tally *kept, const gn_texture *t)
{
    gn_texture_line line;
    gn_texel_rgb texel[17];
    const uint32_t bits = rng_u32(&random_state) & rng_u32(&random_state) & 0xFFFFU;
    for (int i = 0; i < 2; i++) {
        int64_t one = (int64_t)1 << 17, far = t->flags & (i ? GN_TEXTURE_CLAMP_V : GN_TEXTURE_CLAMP_U) ? 8000 : 4500;
        line.at_q17[i] =
            (int32_t)(rng_range(&random_state, -(int32_t)far, (int32_t)far) * one / (1 + rng_below(&random_state, 90)));
        line.step_q17[i] = rng_range(&random_state, -(3 << 17), 3 << 17) / (int32_t)(1 + rng_below(&random_state, 40));
        line.step_change_q17[i] = rng_range(&random_state, -(1 << 12), 1 << 12);
    }
    memset(texel, 0xA5, sizeof texel);
    gn_texture_row(t, &line, bits, texel);
    for (int i = 0; i < 17; i++) {
        int64_t at[2], cell[2];
        double weight[2];
        for (int k = 0; k < 2; k++) {
            at[k] = line.at_q17[k] + (int64_t)i * line.step_q17[k] + (int64_t)i * (i - 1) / 2 * line.step_change_q17[k];
            cell[k] = (int64_t)i128_floor_div(at[k], 1 << 17);
            weight[k] = (double)i128_floor_div(at[k] - cell[k] * (1 << 17), 1 << 9) / 256.0;
        }
        for (int c = 0; c < 3; c++) {
            uint32_t is = c == 2 ? texel[i].blue : texel[i].red_green >> (16 * c) & 0xFFFFU;
            double want = 65535 * value_at(t, cell[0], cell[1], weight[0], weight[1], c), off = is - want;
            if (!(bits >> i & 1U))
                HOLDS(kept, (is & 0xFFFFU) == 0xA5A5U || t->format >= GN_TEXTURE_ALPHA8, "pixel %d", i);
            else
                HOLDS(close, off <= 0.5001 && off > -1.5001,
                      "format %d, %dx%d, flags %d, pixel %d, (%.3f, %.3f): %d, not %.3f", (int)t->format,
                      (int)side(t, 0), (int)side(t, 1), (int)t->flags, i, ldexp((double)at[0], -17),
                      ldexp((double)at[1], -17), (int)is, want);
        }
    }
}
#endif

/* Every format, of every size and wrap. [M11] */
static void test_lookups(void)
{
    static verdict result;
    tally row = {0}, kept = {0}, curve = {0};
    for (uint32_t i = 0; i < 3003; i++) {
        gn_texture t = {.format = (uint8_t)(i % GN_TEXTURE_FORMAT_COUNT)};
        int large = i >= 3000; /* 4096 texels on one side or both */
        if (!(GN_TEXTURE_FORMATS >> t.format & 1)) continue;
        random_size(&t);
        if (large) {
            t.width = i == 3000 ? 8 : 4096;
            t.height = i == 3001 ? 4 : 4095;
        }
        uint8_t *texels = random_texels(&t);
        if (!texels) {
            CHECK(texels != NULL);
            return;
        }
        for (t.flags = 0; t.flags < 8; t.flags++) {
            for (int k = 0; k < (large ? 20000 : 12); k++) try_lookup(&result, &t);
            for (int k = 0; k < (large ? 2000 : 12); k++) try_curve(&curve, &t);
#if GN_INTERPOLATES
            for (int k = 0; k < (large ? 300 : 2); k++) try_row(&row, &kept, &t);
#endif
        }
        free(texels);
    }
    CHECK_TALLY(result.nearest, "nearest: the rounded value of the right texel");
    CHECK_TALLY(result.bilinear, "bilinear alpha");
    CHECK_TALLY(curve, "alphas along a curve");
    CHECK_TALLY(result.colour_nearest, "nearest colour");
    CHECK_TALLY(result.colour_bilinear, "bilinear colour");
#if GN_INTERPOLATES
    CHECK_TALLY(row, "rows of pixels");
    CHECK_TALLY(kept, "pixels of a row that are not asked for");
#endif
    printf("gn_texture_alpha, bilinear: %.3Lf LSB of Q16; gn_texture_colour: %.3Lf\n", result.w.error,
           result.colour.error);
}

/* Every value of every format: what is stored is what is meant, to the nearest 65536th. [M11] */
static void test_texels(void)
{
    uint8_t texel[2], palette[4 * 256];
    tally t = {0};
    for (int i = 0; i < (int)sizeof palette; i++) palette[i] = (uint8_t)(i * 37 + i / 256);
    for (int format = 1; format < GN_TEXTURE_FORMAT_COUNT; format++) {
        gn_texture one = {.rgba = texel, .format = (uint8_t)format, .palette = palette};
        if (!(GN_TEXTURE_FORMATS >> format & 1)) continue;
        for (int word = 0; word < (bits_of(one.format) == 16 ? 65536 : 256); word++) {
            uint32_t rgb[3];
            texel[0] = (uint8_t)word;
            texel[1] = (uint8_t)(word >> 8);
            gn_texture_colour(&one, 0, 0, rgb);
            for (int c = 0; c < 3; c++)
                HOLDS(&t, fabs(rgb[c] - 65536 * linear(stored_value(&one, 0, 0, c))) <= 1.0001, "format %d, %x", format,
                      (unsigned)word);
            HOLDS(&t, gn_texture_alpha(&one, 0, 0) == (uint32_t)lround(65536 * stored_value(&one, 0, 0, 3)),
                  "format %d, %x", format, (unsigned)word);
        }
    }
    CHECK_TALLY(t, "every texel of every format");
}

/* Every value of a texel: black and white are exact, values ascend, equal texels blend to themselves. [M3] */
static void test_values(void)
{
    uint8_t texels[4 * 4];
    gn_texture t = {.rgba = texels, .width_log2 = 1, .height_log2 = 1};
    uint32_t before[3] = {0, 0, 0};
    tally rises = {0}, flat = {0};
    for (int value = 0; value < 256; value++) {
        uint32_t rgb[3], blended[3];
        memset(texels, value, sizeof texels);
        t.flags = 0;
        gn_texture_colour(&t, 12345, 56789, rgb);
        t.flags = GN_TEXTURE_BILINEAR;
        for (int k = 0; k < 100; k++) {
            int32_t u = rng_wide_i32(&random_state, 31), v = rng_wide_i32(&random_state, 31);
            gn_texture_colour(&t, u, v, blended);
            HOLDS(&flat, blended[0] == rgb[0] && blended[1] == rgb[1] && blended[2] == rgb[2], "%d", value);
            HOLDS(&flat, gn_texture_alpha(&t, u, v) == (uint32_t)lround(value * 65536 / 255.0), "%d", value);
        }
        HOLDS(&rises, value == 0 ? rgb[0] == 0 : rgb[0] > before[0], "%d", value);
        memcpy(before, rgb, sizeof before);
    }
    CHECK_EQ_INT(before[0], 65536);
    CHECK_EQ_INT(before[1], 65536);
    CHECK_EQ_INT(before[2], 65536);
    CHECK_TALLY(rises, "decoded values ascend");
    CHECK_TALLY(flat, "equal texels blend to themselves");
}

/* Coordinates between corners: to the last bit of 2^-20, whole turns aside where they repeat, however large the
 * texture. */
static void test_coordinates(void)
{
    tally close = {0};
    for (int i = 0; i < 20000; i++) {
        int16_t uv[6];
        const uint16_t idx[3] = {0, 1, 2};
        const gn_texture t = {.width_log2 = 9, .height_log2 = 9, .flags = (uint8_t)(rng_u32(&random_state) & 7U)};
        gn_mesh mesh = {.uv = uv, .n_vertices = 3};
        gn_texture_triangle triangle;
        mesh.uv_frac_bits = (uint8_t)rng_range(&random_state, 6, 15); /* within 512 turns */
        for (int k = 0; k < 6; k++) uv[k] = (int16_t)rng_range(&random_state, -32768, 32767);
        const int32_t b1 = rng_range(&random_state, 0, 1 << 30), b2 = rng_range(&random_state, 0, (1 << 30) - b1),
                      b[2] = {b1, b2};
        gn_texture_corners(&triangle, &mesh, &t, idx);
        for (int k = 0; k < 2; k++) {
            double at = uv[k] + ldexp(b1, -30) * (uv[2 + k] - uv[k]) + ldexp(b2, -30) * (uv[4 + k] - uv[k]);
            double off = ldexp(gn_texture_coord(&triangle, &t, b, k), -20) - ldexp(at, -mesh.uv_frac_bits);
            if (!(t.flags & (k ? GN_TEXTURE_CLAMP_V : GN_TEXTURE_CLAMP_U))) off -= floor(off + 0.5);
            HOLDS(&close, fabs(off) <= 1.01 * 0x1p-20, "axis %d, flags %d: off by %g", k, (int)t.flags, off);
        }
    }
    CHECK_TALLY(close, "gn_texture_coord");
}

#if GN_MIPMAPS
/* Every level of every format and size lies behind the one before, and the last is one texel. [M11] */
static void test_level_places(void)
{
    static const uint8_t nowhere[1 << 26];
    tally t = {0};
    for (int i = 0; i < 4000; i++) {
        gn_texture chain = {.rgba = nowhere, .format = (uint8_t)(i % GN_TEXTURE_FORMAT_COUNT)}, level;
        if (!(GN_TEXTURE_FORMATS >> chain.format & 1)) continue;
        random_size(&chain);
        if (i % 100 < 10) chain.width = (uint16_t)rng_range(&random_state, 1, 4096);
        chain.flags = (uint8_t)(rng_u32(&random_state) & 7U) | GN_TEXTURE_MIPMAPPED;
        size_t w = side(&chain, 0), h = side(&chain, 1), at = 0;
        const uint64_t never = UINT64_MAX, always = 0;
        HOLDS(&t, gn_texture_level_at(&chain, never, INT32_MAX) == 0, "%dx%d", (int)w, (int)h);
        for (uint32_t k = 0;; k++) {
            gn_texture_use_level(&level, &chain, k);
            HOLDS(&t, level.rgba == nowhere + at && side(&level, 0) == w && side(&level, 1) == h,
                  "format %d, %dx%d, level %d", (int)chain.format, (int)side(&chain, 0), (int)side(&chain, 1), (int)k);
            HOLDS(&t, level.format == chain.format && level.palette == chain.palette, "level %d", (int)k);
            if (w == 1 && h == 1) {
                HOLDS(&t, gn_texture_level_at(&chain, always, 1) == k, "%dx%d: the last level is %d",
                      (int)side(&chain, 0), (int)side(&chain, 1), (int)k);
                break;
            }
            at += h * ((w * bits_of(chain.format) + 7) / 8);
            w = w > 1 ? w / 2 : 1;
            h = h > 1 ? h / 2 : 1;
        }
    }
    CHECK_TALLY(t, "places of levels");
}

/* The depth squared at which the first smaller level begins, against the formula of MODEL 8 in long double, from the
 * plane as it is stored: NUMERICS 4.9; and every level's depth to a unit of Q16. */
static void test_level_depths(void)
{
    tally close = {0}, begins = {0};
    worst w = {0};
    for (int i = 0; i < 20000; i++) {
        int16_t uv[6];
        int32_t v[3][3];
        const uint16_t idx[3] = {0, 1, 2};
        gn_texture t = {.flags = GN_TEXTURE_MIPMAPPED};
        gn_mesh mesh = {.uv = uv, .n_vertices = 3, .uv_frac_bits = (uint8_t)rng_range(&random_state, 0, 15)};
        gn_texture_triangle triangle;
        gn_plane plane;
        random_size(&t);
        for (int k = 0; k < 6; k++) uv[k] = (int16_t)rng_range(&random_state, -32768, 32767);
        const int bits = rng_range(&random_state, 8, 29);
        for (int k = 0; k < 9; k++) v[k / 3][k % 3] = rng_wide_i32(&random_state, (uint32_t)bits);
        const uint32_t focal2_px_q16 = (uint32_t)rng_range(&random_state, 1 << 18, INT32_MAX);
        gn_texture_corners(&triangle, &mesh, &t, idx);
        gn_plane_setup(&plane, v[0], v[1], v[2]);
        const uint64_t got = gn_texture_level_depth2(&triangle, &t, &plane, &plane, focal2_px_q16);
        long double e[2][2], n = 0;
        for (int k = 0; k < 4; k++) e[k / 2][k % 2] = ldexpl((long double)uv[2 + k] - uv[k % 2], -mesh.uv_frac_bits);
        for (int k = 0; k < 3; k++) n += (long double)plane.n[k] * plane.n[k];
        const long double texels = fabsl(e[0][0] * e[1][1] - e[0][1] * e[1][0]) * side(&t, 0) * side(&t, 1),
                          normal = ldexpl(sqrtl(n), plane.n_exp), focal = ldexpl(focal2_px_q16, -17),
                          distance = (long double)plane.det / sqrtl(n);
        if (!(texels > 0) || plane.det <= 0) {
            HOLDS(&close, got == UINT64_MAX, "no area");
            continue;
        }
        const long double want = sqrtl(2.0L) * focal * distance / sqrtl(texels / normal);
        if (want >= 0x1p63L) {
            HOLDS(&close, got >= 0x7FFFFFFFFFFFFFFFU, "beyond every depth");
            continue;
        }
        const long double off = fabsl(got - want);
        HOLDS(&close, off <= want * (1.25L * 0x1p-27L) + 1, "%.17Lg, not %.17Lg", (long double)got, want);
        if (want > 0x1p40L) WORST(&w, off / want * 0x1p27L, "%.17Lg", want);
        for (uint32_t k = 1; k < 12; k++) {
            const long double z = sqrtl((long double)got * exp2l(k - 1.0L));
            if (z >= 0x1p31L - 2 || (size_t)1 << k > (side(&t, 0) > side(&t, 1) ? side(&t, 0) : side(&t, 1))) break;
            const int32_t from = (int32_t)ceill(z);
            HOLDS(&begins, gn_texture_level_at(&t, got, from + 1) >= k, "level %d", (int)k);
            HOLDS(&begins, from < 2 || gn_texture_level_at(&t, got, from - 2) < k, "level %d", (int)k);
        }
    }
    CHECK_TALLY(close, "where the first smaller level begins");
    CHECK_TALLY(begins, "where each level begins");
    printf("gn_texture_level_depth2: %.3Lf of 2^-27\n", w.error);
}
#endif

#if GN_INTERPOLATES && GN_MASKS
/* A mask is even over a rectangle of points where the texels about all of them are equal, and at most 64. */
static void test_even_masks(void)
{
    enum { SIDE = 16 };
    static uint8_t texels[SIDE * SIDE];
    tally even = {0};
    const gn_texture mask = {.rgba = texels, .width = SIDE, .height = SIDE, .flags = GN_TEXTURE_MASK_1};
    for (uint32_t n = 0; n < 20000; n++) {
        int32_t least[2], most[2], first[2], last[2], equal = 1;
        memset(texels, 7, sizeof texels);
        if (n & 1) texels[rng_below(&random_state, sizeof texels)] = 8;
        for (int k = 0; k < 2; k++) {
            least[k] = rng_range(&random_state, -10000, 65536);
            most[k] = least[k] + (int32_t)rng_below(&random_state, 65536);
            first[k] = (int32_t)fmax(floor(fmin(fmax(least[k], 0), 65536) * SIDE / 65536 - 0.5), 0);
            last[k] = (int32_t)fmin(floor(fmin(fmax(most[k], 0), 65536) * SIDE / 65536 - 0.5) + 1, SIDE - 1);
        }
        if ((last[0] - first[0] + 1) * (last[1] - first[1] + 1) > 64) equal = 0;
        for (int32_t y = first[1]; y <= last[1]; y++)
            for (int32_t x = first[0]; x <= last[0]; x++)
                equal = equal && texels[y * SIDE + x] == texels[first[1] * SIDE + first[0]];
        HOLDS(&even, gn_texture_mask_is_even(&mask, least, most) == equal, "%d..%d, %d..%d", first[0], last[0],
              first[1], last[1]);
    }
    CHECK_TALLY(even, "even parts of masks");
}
#endif

/* Barycentrics of any exponent: far below one unit, and far above 1. A divisor of a power of two loses one unit of Q30
 * to its reciprocal, and truncation another. */
static void test_barycentrics(void)
{
    tally t = {0};
    gn_ray_recip recip;
    const gn_plane plane = {.n = {0, 0, 1 << 20}, .det = 1};
    if (!CHECK(gn_plane_recip(&recip, &plane, 0, 0, 65536, 2))) return;
    for (int32_t exp = -80; exp <= 40; exp++)
        for (int32_t f = -1000; f <= 1000; f += 7) {
            const gn_bary bary = {.form = {{0, 0, f * (1 << 20)}, {0}}, .exp = {exp, 0}};
            int32_t b[2];
            gn_bary_at(b, &bary, &recip, 0, 0, 65536);
            double exact = fmin(fmax(ldexp(f, exp), 0), 1);
            HOLDS(&t, fabs(b[0] - ldexp(exact, 30)) <= 2 && b[1] == 0, "%d * 2^%d: %d", f, exp, b[0]);
        }
    CHECK_TALLY(t, "gn_bary_at");
}

int main(void)
{
#if GN_MIPMAPS
    test_level_places();
    test_level_depths();
#endif
    test_coordinates();
    test_lookups();
    test_texels();
    test_values();
#if GN_INTERPOLATES && GN_MASKS
    test_even_masks();
#endif
    test_barycentrics();
    return check_report();
}
