/* Linear colour to pixels: the sRGB curve over its whole range, and rounding to the output's levels. */
#include <stdint.h>
#include <string.h>

#include "exact.h"
#include "knobs.h"
#include <stdlib.h>

#include "shade/gn_pixel.h"
#include "geometry/gn_texture.h"
#include "base/gn_math.h"
#include "gnomon.h"
#include "rng.h"

static rng random_state = {5};
static gn_frame frame;

enum { ONE_Q20 = 1 << 20 };

static long double srgb(long double x)
{
    return x <= 0.0031308L ? 12.92L * x : 1.055L * powl(x, 1.0L / 2.4L) - 0.055L;
}

/* The sRGB curve against the formula. [M7] */
static void test_encode(void)
{
    tally bound = {0}, monotone = {0};
    worst w = {0};
    uint32_t before = 0;
    for (uint32_t i = 0; i <= ONE_Q20; i++) {
        uint32_t v = gn_srgb_encode(i);
        long double e = fabsl((long double)v - 65535.0L * srgb((long double)i / ONE_Q20));
        WORST(&w, e, "%u", (unsigned)i);
        HOLDS(&bound, e < 1.5L, "%u: %u errs by %.3Lf", (unsigned)i, (unsigned)v, e);
        HOLDS(&monotone, v >= before && v <= 65535, "%u: %u after %u", (unsigned)i, (unsigned)v, (unsigned)before);
        before = v;
    }
    CHECK_TALLY(bound, "gn_srgb_encode within 1.5 LSB");
    CHECK_TALLY(monotone, "gn_srgb_encode is monotone");
    CHECK(gn_srgb_encode(0) == 0 && gn_srgb_encode(ONE_Q20) == 65535);
    CHECK(gn_srgb_encode(ONE_Q20 + 1) == 65535 && gn_srgb_encode(UINT32_MAX) == 65535);
    printf("gn_srgb_encode: %.3Lf LSB at %s\n", w.error, w.at);
}

/* round(levels * v / 65535), the nearest level of an encoded value: never a tie, as 65535 is odd */
static uint32_t nearest(uint32_t v, uint32_t levels)
{
    uint64_t best = UINT64_MAX;
    uint32_t level = 0, guess = (uint32_t)((uint64_t)v * levels / 65535U);
    for (uint32_t n = guess ? guess - 1 : 0; n <= guess + 1 && n <= levels; n++) {
        int64_t d = (int64_t)n * 65535 - (int64_t)v * levels;
        uint64_t distance = (uint64_t)(d < 0 ? -d : d);
        if (distance < best) best = distance, level = n;
    }
    return level;
}

static uint32_t encoded(uint32_t linear_q20)
{
    uint64_t clamped = linear_q20 < ONE_Q20 ? linear_q20 : ONE_Q20;
    return GN_K(&frame, srgb) ? gn_srgb_encode(linear_q20)
                              : (uint32_t)((2 * clamped * 65535 + ONE_Q20) / (2 * ONE_Q20));
}

static int packed_ok(const uint32_t q20[3])
{
    uint32_t packed = gn_pixel_pack(&frame, q20);
    if (frame.picture.format == GN_FORMAT_RGB565)
        return packed ==
               nearest(encoded(q20[0]), 31) * 2048 + nearest(encoded(q20[1]), 63) * 32 + nearest(encoded(q20[2]), 31);
    return packed ==
           nearest(encoded(q20[0]), 255) + nearest(encoded(q20[1]), 255) * 256 + nearest(encoded(q20[2]), 255) * 65536;
}

/* Without the curve every 16-bit value occurs; each passes through every channel. [R5] */
static void test_pack(void)
{
    tally t = {0};
    for (int format = 0; format < 2; format++)
        for (int curve = 0; curve < 2; curve++) {
            frame.picture.format = format ? GN_FORMAT_RGB888 : GN_FORMAT_RGB565;
            SET_KNOB(&frame, srgb, curve);
            for (uint32_t i = 0; i <= ONE_Q20 + 64; i += 4) {
                uint32_t q20[3] = {i, (i * 5 + 1) & (ONE_Q20 - 1),
                                   rng_u32(&random_state) >> rng_below(&random_state, 13)};
                HOLDS(&t, packed_ok(q20), "format %d, curve %d: %u %u %u", format, curve, (unsigned)q20[0],
                      (unsigned)q20[1], (unsigned)q20[2]);
            }
        }
    CHECK_TALLY(t, "pixels are the nearest levels");
}

static gn_tile_pixels tile;

/* n pixels from pixel i on; what stands around them must stay. */
static void test_fill(void)
{
    enum { PIXELS = 20 };
    tally t = {0};
    for (uint32_t k = 0; k < 4 * PIXELS * PIXELS; k++) {
        uint8_t *buffer = tile.bytes;
        uint32_t packed = rng_u32(&random_state) & 0xFFFFFFU;
        uint8_t expected[4 * PIXELS];
        int32_t i = (int32_t)(k / 2 % PIXELS), n = rng_range(&random_state, 0, PIXELS - i);
        frame.picture.format = k & 1 ? GN_FORMAT_RGB888 : GN_FORMAT_RGB565;
        memset(buffer, 0xA5, sizeof expected);
        memset(expected, 0xA5, sizeof expected);
        const gn_pixel_rows rows = {&tile, PIXELS, 40, 30};
        gn_pixel_fill(&frame, &rows, 40 + i, 30, n, packed);
        for (int32_t p = i; p < i + n; p++) {
            uint16_t narrow = (uint16_t)packed;
            if (frame.picture.format == GN_FORMAT_RGB565) memcpy(expected + 2 * p, &narrow, sizeof narrow);
            else
                for (int c = 0; c < 3; c++) expected[3 * p + c] = (uint8_t)(packed >> 8 * c);
        }
        HOLDS(&t, !memcmp(buffer, expected, sizeof expected), "%d pixels from %d", (int)n, (int)i);
    }
    CHECK_TALLY(t, "pixels go where they should");
}

static double curve(double x)
{
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

/* Greys are the encoded luminance rounded to the nearest level, and byte-swapped RGB565 is RGB565. */
static void test_greys(void)
{
    tally grey = {0}, swapped = {0};
    SET_KNOB(&frame, srgb, 1);
    for (uint32_t k = 0; k < 300000; k++) {
        uint32_t q20[3];
        double y = 0;
        static const double weight[3] = {0.2126, 0.7152, 0.0722};
        for (int c = 0; c < 3; c++) {
            q20[c] = rng_u32(&random_state) % (ONE_Q20 + ONE_Q20 / 4);
            y += weight[c] * fmin(1, q20[c] / (double)ONE_Q20);
        }
        for (int bits = 4; bits <= 8; bits += 4) {
            double level = curve(y) * (bits == 4 ? 15 : 255);
            frame.picture.format = bits == 4 ? GN_FORMAT_GREY4 : GN_FORMAT_GREY8;
            /* half a level, the weights' 16 bits (2^-17 each, steepened by the curve) and the encoding's 1.5 of 65535
             */
            HOLDS(&grey, fabs(gn_pixel_pack(&frame, q20) - level) <= 0.5 + 255 * (1.5 / 65535 + 12.92 * 3 / 131072.0),
                  "%u bits", (unsigned)bits);
        }
        frame.picture.format = GN_FORMAT_RGB565;
        uint32_t straight = gn_pixel_pack(&frame, q20);
        frame.picture.format = GN_FORMAT_RGB565_SWAPPED;
        HOLDS(&swapped, gn_pixel_pack(&frame, q20) == (straight >> 8 | (straight & 255U) << 8), "%06x",
              (unsigned)straight);
    }
    CHECK_TALLY(grey, "grey levels");
    CHECK_TALLY(swapped, "byte order of RGB565");
}

/* Packed rows: each pixel in its own bits, rows on bytes, nothing else touched; the dither lights the share of pixels
 * that the luminance says, in every 8x8 block, wherever the block lies. */
static void test_packed_rows(void)
{
    uint8_t *bytes = tile.bytes;
    tally t = {0}, share = {0};
    frame.picture.format = GN_FORMAT_GREY4;
    for (int32_t width = 1; width <= 11; width++) {
        for (int32_t i = 0; i < 3 * width; i++) {
            const gn_pixel_rows rows = {&tile, width, 0, 0};
            memset(bytes, 0x5A, 256);
            gn_pixel_fill(&frame, &rows, i % width, i / width, 1, 0xC);
            for (int32_t p = 0; p < 3 * ((width + 1) / 2); p++) {
                int32_t at = i / width * ((width + 1) / 2) + i % width / 2;
                unsigned want = p != at ? 0x5AU : i % width & 1 ? 0x5CU : 0xCAU;
                HOLDS(&t, bytes[p] == want, "width %d pixel %d", (int)width, (int)i);
            }
        }
    }
    CHECK_TALLY(t, "4-bit rows");
    frame.picture.format = GN_FORMAT_MONO1;
    for (uint32_t luminance = 0; luminance <= 65535; luminance += 13) {
        const gn_pixel_rows rows = {&tile, 16, 24, 40};
        int lit = 0;
        for (int32_t y = 0; y < 8; y++) gn_pixel_fill(&frame, &rows, 24, 40 + y, 16, luminance);
        for (int32_t p = 0; p < 16; p++)
            for (int bit = 0; bit < 8; bit++) lit += bytes[p] >> bit & 1;
        HOLDS(&share, abs(lit - (int)lround(luminance * 128 / 65535.0)) <= 1, "%u of 65535: %d of 128",
              (unsigned)luminance, lit);
    }
    CHECK_TALLY(share, "share of lit pixels");
}

/* Every level is reached, and white and black are exact. */
static void test_levels(void)
{
    static int seen[256];
    int n = 0;
    frame.picture.format = GN_FORMAT_RGB888;
    SET_KNOB(&frame, srgb, 1);
    for (uint32_t i = 0; i <= ONE_Q20; i += 16) {
        uint32_t q20[3] = {i, 0, ONE_Q20}, pixel = gn_pixel_pack(&frame, q20);
        n += !seen[pixel & 255U]++;
        if (pixel >> 8 != 0xFF00U) n = -1000; /* green 0, blue 255 */
    }
    CHECK_EQ_INT(n, 256);
}

#if GN_INTERPOLATES
static uint32_t q20_of(int64_t q24)
{
    return q24 < 0 ? 0 : (uint32_t)(q24 >> 4);
}

static int32_t channel_of(gn_texel_rgb texel, int c)
{
    return (int32_t)(c == 2 ? texel.blue : texel.red_green >> (16 * c) & 0xFFFFU);
}

/* Pixel i of a line: between two nodes a step is rounded down to 2^-24. */
static uint32_t pixel_of_line(const gn_pixel_line *line, int32_t i)
{
    const int32_t k = i >> line->spacing_log2, t = i - (k << line->spacing_log2);
    uint32_t q20[3];
    for (int c = 0; c < 3; c++) {
        const int64_t from = line->node[k][c],
                      step =
                          t ? (int64_t)i128_floor_div(line->node[k + 1][c] - from, (i128)1 << line->spacing_log2) : 0;
        const int64_t colour_q24 = from + t * step;
        q20[c] = q20_of(colour_q24);
        if (!line->texel) continue;
        /* 16 bits of both */
        const int64_t light = colour_q24 < 0 ? 0 : colour_q24 >> 8;
        q20[c] = (uint32_t)i128_floor_div((i128)light * channel_of(line->texel[i], c), 1 << 12);
    }
    return gn_pixel_pack(&frame, q20);
}

enum { LINE_X = 40, LINE_Y = 30, LINE_PIXELS = 16 };

/* Stores a line into a row of which every pixel was `before`: those of `bits` must be the line's, the others as they
 * were. */
static void check_line(const gn_pixel_line *line, uint32_t bits, tally *same, tally *kept)
{
    static gn_tile_pixels pixels;
    const gn_pixel_rows rows = {&pixels, LINE_PIXELS + 2, LINE_X - 1, LINE_Y};
    const uint32_t before = gn_pixel_pack(&frame, (const uint32_t[3]){12345, 54321, 999999});
    gn_pixel_fill(&frame, &rows, LINE_X - 1, LINE_Y, LINE_PIXELS + 2, before);
    gn_pixel_store_line(&frame, &rows, LINE_X, LINE_Y, bits, line);
    for (int32_t i = -1; i <= LINE_PIXELS; i++) {
        uint32_t is = 0;
        if (frame.picture.format == GN_FORMAT_RGB888)
            for (int c = 0; c < 3; c++) is |= (uint32_t)pixels.bytes[3 * (i + 1) + c] << 8 * c;
        else if (frame.picture.format == GN_FORMAT_GREY8) is = pixels.bytes[i + 1];
        else is = pixels.rgb565[i + 1];
        const int is_set = i >= 0 && i < LINE_PIXELS && (bits >> i & 1U);
        const uint32_t want = is_set ? pixel_of_line(line, i) : before;
        HOLDS(is_set ? same : kept, is == want, "format %d, pixel %d of %x, 2^%d apart: %x, not %x",
              (int)frame.picture.format, (int)i, (unsigned)bits, (int)line->spacing_log2, (unsigned)is, (unsigned)want);
    }
}

static gn_texel_rgb texels[LINE_PIXELS];

/* Some repeat the one before; channels are black, white or anything. */
static void choose_texture(gn_pixel_line *line)
{
    for (int i = 0; i < LINE_PIXELS; i++) {
        uint32_t v[3];
        if (i && !rng_below(&random_state, 3)) {
            texels[i] = texels[i - 1];
            continue;
        }
        for (int c = 0; c < 3; c++) {
            const uint32_t kind = rng_below(&random_state, 8);
            v[c] = kind < 6 ? rng_u32(&random_state) & 0xFFFFU : kind == 6 ? 65535U : 0;
        }
        texels[i] = (gn_texel_rgb){v[0] | v[1] << 16, v[2]};
    }
    line->texel = texels;
}

/* Lines are what single pixels would be: random nodes, also beyond black and white, and every light from one to the
 * other. */
static void test_lines(void)
{
    static const gn_format formats[] = {GN_FORMAT_RGB565, GN_FORMAT_RGB565_SWAPPED, GN_FORMAT_GREY8, GN_FORMAT_RGB888};
    int32_t node[LINE_PIXELS + 1][3];
    tally same = {0}, kept = {0}, all = {0};
    gn_pixel_line line = {.node = (const int32_t(*)[3])node};
    for (int k = 0; k < 40000; k++) {
        frame.picture.format = formats[k & 3];
        SET_KNOB(&frame, srgb, k % 7 != 0);
        line.inside = k % 3 != 0;
        line.texel = NULL;
        if (GN_TEXTURES && k % 5 == 0) choose_texture(&line);
        line.spacing_log2 = line.texel ? rng_range(&random_state, 0, 4) : 0;
        for (int i = 0; i <= LINE_PIXELS; i++)
            for (int c = 0; c < 3; c++)
                node[i][c] = i && k % 4 == 1 ? node[0][c] /* one light */
                             : line.inside   ? rng_range(&random_state, 64, (1 << 24) - 1)
                                             : rng_range(&random_state, -(1 << 24), (1 << 28));
        check_line(&line, rng_u32(&random_state) & 0xFFFFU & (k & 4 ? UINT32_MAX : rng_u32(&random_state)), &same,
                   &kept);
    }
    SET_KNOB(&frame, srgb, 1);
    frame.picture.format = GN_FORMAT_RGB565;
    line.texel = NULL;
    line.spacing_log2 = 0;
    for (int32_t first = -64; first < ONE_Q20 + 64; first += LINE_PIXELS) {
        line.inside = first >= 16 && first + LINE_PIXELS < ONE_Q20 - 16;
        for (int i = 0; i < LINE_PIXELS; i++) {
            node[i][0] = (first + i) * 16 + 15;
            node[i][1] = (ONE_Q20 - first - i) * 16;
            node[i][2] = (first + i) * 16 + 8;
        }
        check_line(&line, 0xFFFFU, &all, &kept);
    }
    CHECK_TALLY(same, "lines are packed like single pixels");
    CHECK_TALLY(all, "lines of every light are packed like single pixels");
    CHECK_TALLY(kept, "what a line does not store is kept");
}

static void test_bits(void)
{
    static gn_tile_pixels is, want;
    tally t = {0};
    for (uint32_t k = 0; k < 20000; k++) {
        const gn_pixel_rows rows = {&is, 24, 40, 30}, expected = {&want, 24, 40, 30};
        const uint32_t bits = rng_u32(&random_state) & 0xFFFFU, packed = rng_u32(&random_state) & 0xFFFFFFU;
        frame.picture.format = k & 1 ? GN_FORMAT_RGB888 : GN_FORMAT_RGB565;
        memset(is.bytes, 0xA5, 24 * 4);
        memset(want.bytes, 0xA5, 24 * 4);
        gn_pixel_store_bits(&frame, &rows, 43, 30, bits, packed);
        for (int32_t i = 0; i < 16; i++)
            if (bits >> i & 1U) gn_pixel_fill(&frame, &expected, 43 + i, 30, 1, packed);
        HOLDS(&t, memcmp(is.bytes, want.bytes, 24 * 4) == 0, "%x of %x", (unsigned)packed, (unsigned)bits);
    }
    CHECK_TALLY(t, "pixels of a row's bits");
}

/* Between two colours in steps of 1 / 64: every attenuation is the nearest step, and nothing is kept of colours before.
 */
static void test_two_colours(void)
{
    static gn_shading shading;
    static const gn_format formats[] = {GN_FORMAT_RGB565, GN_FORMAT_GREY8, GN_FORMAT_RGB888};
    int32_t dark[3] = {0, 0, 0}, more[3] = {0, 0, 0};
    tally same = {0};
    shading.frame = &frame;
    SET_KNOB(&frame, srgb, 1);
    for (uint32_t k = 0; k < 600; k++) {
        const int every = k < 3;
        const int c = (int)rng_below(&random_state, 3);
        if (k % 200 == 0) { /* as at the beginning of a tile */
            frame.picture.format = formats[k / 200];
            memset(&shading.lattice, k & 1 ? 0xA5 : 0, sizeof shading.lattice);
            gn_levels_forget(&shading.lattice);
            shading.last_pixel = gn_pixel_pack(&frame, shading.last_q20);
        }
        if (k % 7) dark[c] = rng_range(&random_state, k & 2 ? 0 : -(1 << 20), 1 << 27); /* else the same again */
        if (k % 7 && k % 3) more[c] = rng_range(&random_state, 0, 1 << 27);
        if (k % 7 == 0) dark[c] ^= 1 << 18, more[c] ^= 1 << 17; /* a little */
        gn_levels_use(&shading.lattice, dark, more);
        for (uint32_t a = every ? 0 : rng_below(&random_state, 777); a <= 65536; a += every ? 1 : 777) {
            const int64_t level = (int64_t)i128_round_shr(a, 10);
            uint32_t q20[3];
            for (int i = 0; i < 3; i++) q20[i] = q20_of(dark[i] + (int64_t)i128_floor_div((i128)more[i] * level, 64));
            const uint32_t is = gn_levels_pixel(&shading, a), want = gn_pixel_pack(&frame, q20);
            HOLDS(&same, is == want, "colours %u, attenuation %u: %x, not %x", (unsigned)k, (unsigned)a, (unsigned)is,
                  (unsigned)want);
        }
    }
    CHECK_TALLY(same, "pixels between two colours");
}
#endif

int main(void)
{
    test_encode();
    test_pack();
    test_fill();
    test_levels();
#if GN_INTERPOLATES
    test_lines();
    test_bits();
    test_two_colours();
#endif
    test_greys();
    test_packed_rows();
    return check_report();
}
