/* Textures against double precision: addressing and single channels exactly, colour within the stated bound. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "exact.h"
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

static double texel_value(const gn_texture *t, int64_t i, int64_t j, int channel, int decoded)
{
    int64_t u = addressed(i, (int64_t)1 << t->width_log2, t->flags & GN_TEXTURE_CLAMP_U);
    int64_t v = addressed(j, (int64_t)1 << t->height_log2, t->flags & GN_TEXTURE_CLAMP_V);
    double value = t->rgba[4 * (((size_t)v << t->width_log2) + (size_t)u) + (size_t)channel] / 255.0;
    return decoded ? linear(value) : value;
}

/* 65536 times the texture's value at (u, v). */
static double exact_value(const gn_texture *t, int32_t u_q20, int32_t v_q20, int channel, int decoded)
{
    double x = ldexp(u_q20, t->width_log2 - 20), y = ldexp(v_q20, t->height_log2 - 20); /* exact */
    if (!(t->flags & GN_TEXTURE_BILINEAR))
        return 65536 * texel_value(t, (int64_t)floor(x), (int64_t)floor(y), channel, decoded);
    x -= 0.5;
    y -= 0.5;
    int64_t i = (int64_t)floor(x), j = (int64_t)floor(y);
    double fu = x - (double)i, fv = y - (double)j;
    double upper = (1 - fu) * texel_value(t, i, j, channel, decoded) + fu * texel_value(t, i + 1, j, channel, decoded);
    double lower =
        (1 - fu) * texel_value(t, i, j + 1, channel, decoded) + fu * texel_value(t, i + 1, j + 1, channel, decoded);
    return 65536 * ((1 - fv) * upper + fv * lower);
}

/* ---- Random textures and coordinates ----------------------------------------------------------------------------- */

/* Memory of exactly the texture's size, so that a sanitizer sees a texel outside. */
static uint8_t *random_texels(gn_texture *t, int32_t width_log2, int32_t height_log2)
{
    size_t n = (size_t)4 << (width_log2 + height_log2);
    uint8_t *texels = malloc(n);
    uint32_t kind = rng_below(&random_state, 3);
    if (!texels) return NULL;
    for (size_t i = 0; i < n; i++) {
        uint8_t any = (uint8_t)rng_u32(&random_state);
        texels[i] = kind == 0 ? any : kind == 1 ? (any & 1 ? 255 : 0) : (uint8_t)(i * 7);
    }
    t->rgba = texels;
    t->width_log2 = (uint8_t)width_log2;
    t->height_log2 = (uint8_t)height_log2;
    return texels;
}

static int32_t random_coordinate(int32_t size_log2)
{
    static const int32_t special[8] = {INT32_MIN, INT32_MAX, 0, 1 << 20, -(1 << 20), (1 << 20) - 1, -1, 1 << 19};
    switch (rng_below(&random_state, 6)) {
    case 0:
        return special[rng_below(&random_state, 8)];
    case 1:
        return rng_wide_i32(&random_state, 31);
    case 2: { /* at a border of texels or its middle, if it has one, and its neighbours */
        int32_t half = (1 << 19) >> size_log2;
        return rng_range(&random_state, -2, (4 << size_log2)) * half + rng_range(&random_state, -1, 1);
    }
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
    int32_t u = random_coordinate(t->width_log2), v = random_coordinate(t->height_log2);
    uint32_t rgb[4] = {0, 0, 0, 0xDEADBEEFU};
    int bilinear = (t->flags & GN_TEXTURE_BILINEAR) != 0;
    double small = (t->width_log2 < 4) + (t->height_log2 < 4); /* coordinates finer than texels, Q16 */
    gn_texture_colour(t, u, v, rgb);
    HOLDS(&result->colour_nearest, rgb[3] == 0xDEADBEEFU, "more than three channels written");
    for (int c = 0; c < 4; c++) {
        double exact = exact_value(t, u, v, c, 0), decoded = exact_value(t, u, v, c, 1);
        double a = gn_texture_channel(t, u, v, (uint32_t)c), error = fabs(a - exact),
               colour_error = fabs(rgb[c % 3] - decoded);
        if (bilinear) {
            HOLDS(&result->bilinear, error <= 1.5001 + small,
                  "2^%d x 2^%d, flags %d, (%d, %d): channel %d is %.0f, not %.3f", (int)t->width_log2,
                  (int)t->height_log2, (int)t->flags, (int)u, (int)v, c, a, exact);
            WORST(&result->w, (long double)error, "flags %d", (int)t->flags);
        } else {
            HOLDS(&result->nearest, error <= 0.5, "2^%d x 2^%d, flags %d, (%d, %d): channel %d is %.0f, not %.3f",
                  (int)t->width_log2, (int)t->height_log2, (int)t->flags, (int)u, (int)v, c, a, exact);
        }
        if (c == 3) continue;
        HOLDS(bilinear ? &result->colour_bilinear : &result->colour_nearest,
              colour_error <= (bilinear ? 2.0001 + small : 1.0001),
              "2^%d x 2^%d, flags %d, (%d, %d): colour %d is %u, not %.3f", (int)t->width_log2, (int)t->height_log2,
              (int)t->flags, (int)u, (int)v, c, (unsigned)rgb[c], decoded);
        WORST(&result->colour, (long double)colour_error, "flags %d", (int)t->flags);
    }
}

static void test_lookups(void)
{
    static verdict result;
    for (uint32_t i = 0; i < 3003; i++) {
        gn_texture t = {NULL, 0, 0, (uint8_t)(i & 7U)};
        int large = i >= 3000; /* 4096 texels on one side or both */
        uint8_t *texels = large ? random_texels(&t, i == 3000 ? 3 : 12, i == 3001 ? 2 : 12)
                                : random_texels(&t, rng_range(&random_state, 0, 6), rng_range(&random_state, 0, 6));
        if (!texels) {
            CHECK(texels != NULL);
            return;
        }
        for (t.flags = 0; t.flags < 8; t.flags++)
            for (int k = 0; k < (large ? 20000 : 12); k++) try_lookup(&result, &t);
        free(texels);
    }
    CHECK_TALLY(result.nearest, "nearest: the rounded value of the right texel");
    CHECK_TALLY(result.bilinear, "bilinear, one channel");
    CHECK_TALLY(result.colour_nearest, "nearest colour");
    CHECK_TALLY(result.colour_bilinear, "bilinear colour");
    printf("gn_texture_channel, bilinear: %.3Lf LSB of Q16; gn_texture_colour: %.3Lf\n", result.w.error,
           result.colour.error);
}

/* Every value of a texel: black and white are exact, values ascend, equal texels blend to themselves. [M3] */
static void test_values(void)
{
    uint8_t texels[4 * 4];
    gn_texture t = {texels, 1, 1, 0};
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
            HOLDS(&flat, gn_texture_channel(&t, u, v, GN_CHANNEL_ALPHA) == (uint32_t)lround(value * 65536 / 255.0),
                  "%d", value);
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
        const gn_texture t = {NULL, 9, 9, (uint8_t)(rng_u32(&random_state) & 7U)};
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

int main(void)
{
    test_coordinates();
    test_lookups();
    test_values();
    return check_report();
}
