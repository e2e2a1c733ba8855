/* Mixtures of what is in front and behind, in every format: the nearest colour of Q20, as it is stored. [M8] */
#include <string.h>

#include "exact.h"
#include "knobs.h"

#include "base/gn_q.h"
#include "gnomon.h"
#include "rng.h"
#include "shade/gn_surface.h"
#include "shade/gn_pixel.h"

#if GN_LAYERS_MAX

enum { WIDTH = 17, ROWS = 3, X0 = 40, Y0 = 20, CASES = 2500 };

static rng random_state = {808};
static uint16_t width; /* 16, and one more: rows of bits end with a byte, or begin one */
static gn_frame frame;
static gn_scratch scratch;
static gn_shading shading;
static gn_tile_pixels layer, front, behind, wanted;
static gn_object object;

static size_t row_bytes(void)
{
    switch (frame.picture.format) {
    case GN_FORMAT_GREY8:
        return width;
    case GN_FORMAT_GREY4:
        return (width + 1U) / 2;
    case GN_FORMAT_MONO1:
        return (width + 7U) / 8;
    case GN_FORMAT_RGB888:
        return 3U * width;
    default:
        return 2U * width;
    }
}

/* Levels of a stored pixel; returns the number of channels. */
static int levels_at(const gn_tile_pixels *pixels, int row, int x, int level[3], int most[3])
{
    const uint8_t *bytes = pixels->bytes + (size_t)row * row_bytes();
    uint32_t v = bytes[0];
    most[0] = most[1] = most[2] = 255;
    switch (frame.picture.format) {
    case GN_FORMAT_GREY8:
        level[0] = bytes[x];
        return 1;
    case GN_FORMAT_GREY4:
        level[0] = x % 2 ? bytes[x / 2] % 16 : bytes[x / 2] / 16;
        most[0] = 15;
        return 1;
    case GN_FORMAT_MONO1:
        level[0] = bytes[x / 8] >> (7 - x % 8) & 1;
        most[0] = 1;
        return 1;
    case GN_FORMAT_RGB888:
        for (int c = 0; c < 3; c++) level[c] = bytes[3 * x + c];
        return 3;
    default:
        v = pixels->rgb565[row * width + x];
        if (frame.picture.format == GN_FORMAT_RGB565_SWAPPED) v = v / 256 + v % 256 * 256;
        level[0] = (int)(v / 2048), level[1] = (int)(v / 32 % 64), level[2] = (int)(v % 32);
        most[0] = most[2] = 31, most[1] = 63;
        return 3;
    }
}

/* Light of a level, 65535: 1. */
static long double light_of(int level, int most)
{
    const long double x = (long double)level / most;
    if (!GN_K(&frame, srgb)) return roundl(65535 * x);
    return roundl(65535 * (x <= 0.04045L ? x / 12.92L : powl((x + 0.055L) / 1.055L, 2.4L)));
}

/* Whether the pixel is that of the mixture, or of its neighbour where both are as near within 2^-10. */
static int is_mixture(int row, int x, uint32_t alpha_uq16)
{
    int a[3], b[3], is[3], most[3], fits[3] = {0, 0, 0};
    const int n = levels_at(&layer, row, x, a, most);
    levels_at(&behind, row, x, b, most);
    levels_at(&scratch.pixel, row, x, is, most);
    if (frame.picture.format == GN_FORMAT_MONO1)
        return is[0] == (alpha_uq16 >= gn_noise_uq16(X0 + x, Y0 + row) ? a[0] : b[0]);
    for (int side = -1; side <= 1; side += 2) {
        uint32_t q20[3] = {0, 0, 0};
        int level[3];
        for (int c = 0; c < 3; c++) {
            const int k = n == 1 ? 0 : c;
            const long double light =
                light_of(a[k], most[k]) * alpha_uq16 + light_of(b[k], most[k]) * (65536 - alpha_uq16);
            q20[c] = (uint32_t)floorl(light * 16 / 65535 + 0.5L + side * 0x1p-10L);
        }
        const gn_pixel_rows rows = {&wanted, width, X0, Y0};
        gn_pixel_fill(&frame, &rows, X0 + x, Y0 + row, 1, gn_pixel_pack(&frame, q20));
        levels_at(&wanted, row, x, level, most);
        for (int c = 0; c < n; c++) fits[c] |= level[c] == is[c];
    }
    return fits[0] && (n == 1 || (fits[1] && fits[2]));
}

/* A part of a row is mixed; the rest of the tile, and the layer, stay as they are. */
static void test_run(tally *mixed, tally *others)
{
    const int row = (int)rng_below(&random_state, ROWS), x = (int)rng_below(&random_state, width),
              n = 1 + (int)rng_below(&random_state, (uint32_t)(width - x));
    const uint32_t few = rng_below(&random_state, 2) ? 255 : 0x11; /* few colours: neighbours are often equal */
    for (size_t i = 0; i < row_bytes() * ROWS; i++) {
        scratch.pixel.bytes[i] = (uint8_t)(rng_u32(&random_state) & few);
        layer.bytes[i] = (uint8_t)(rng_u32(&random_state) & few);
    }
    memcpy(&behind, &scratch.pixel, row_bytes() * ROWS);
    memcpy(&front, &layer, row_bytes() * ROWS);
    object.alpha_uq16 = rng_below(&random_state, 8) ? rng_below(&random_state, 65537) : 65536;
    gn_mix_run(&shading, X0 + x, Y0 + row, n);
    for (int i = 0; i < width; i++) {
        int was[3] = {0, 0, 0}, is[3] = {0, 0, 0}, most[3];
        levels_at(&behind, row, i, was, most);
        levels_at(&scratch.pixel, row, i, is, most);
        if (i >= x && i < x + n)
            HOLDS(mixed, is_mixture(row, i, object.alpha_uq16), "format %d: pixel %d of %d, alpha %u",
                  (int)frame.picture.format, i, n, (unsigned)object.alpha_uq16);
        else HOLDS(others, memcmp(was, is, sizeof is) == 0, "format %d, pixel %d", (int)frame.picture.format, i);
    }
    for (int j = 0; j < ROWS; j++)
        HOLDS(others,
              j == row || !memcmp(behind.bytes + (size_t)j * row_bytes(), scratch.pixel.bytes + (size_t)j * row_bytes(),
                                  row_bytes()),
              "row %d beside %d", j, row);
    HOLDS(others, memcmp(&front, &layer, row_bytes() * ROWS) == 0, "the layer");
}

int main(void)
{
    static const gn_format formats[] = {GN_FORMAT_RGB565, GN_FORMAT_RGB565_SWAPPED, GN_FORMAT_RGB888,
                                        GN_FORMAT_GREY8,  GN_FORMAT_GREY4,          GN_FORMAT_MONO1};
    tally mixed = {0}, others = {0};
    shading.frame = &frame;
    shading.scratch = &scratch;
    shading.surface.object = &object;
    for (int k = 0; k < (GN_OTHER_FORMATS ? 6 : 2); k++)
        for (int i = 0; i < 4; i++) {
            width = (uint16_t)(WIDTH - i / 2);
            shading.rows = (gn_pixel_rows){&layer, width, X0, Y0};
            frame.picture.format = formats[k];
            frame.picture.width = width, frame.picture.height = ROWS;
            SET_KNOB(&frame, srgb, i % 2);
            gn_mix_begin(&shading);
            for (int n = 0; n < CASES; n++) test_run(&mixed, &others);
        }
    CHECK_TALLY(mixed, "mixtures are the nearest colours");
    CHECK_TALLY(others, "nothing else changes");
    return check_report();
}

#else

int main(void)
{
    return check_report();
}

#endif
