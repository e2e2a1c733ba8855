/* Blocks of cells whose levels are linear between their corners: against the exact curve of bilinear light. */
#include <stdint.h>
#include <string.h>

#include "exact.h"
#include "knobs.h"

#include "gnomon.h"
#include "rng.h"
#include "shade/gn_lattice_block.h"
#include "shade/gn_pixel.h"

#if GN_INTERPOLATES
enum { X0 = 40, Y0 = 30, WIDTH = 50, HEIGHT = 20, CELL_X = 48, CELL_Y = 32 }; /* a tile of 64x16 pixels holds it */

static rng random_state = {9};
static gn_frame frame;
static gn_shading shading;
static gn_tile_pixels tile[(WIDTH * HEIGHT * 3) / sizeof(gn_tile_pixels) + 1];

static double curve(double x)
{
    if (!(GN_K(&frame, srgb))) return x;
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

/* A chord from a to a + d is below the curve by at most this. */
static double chord_error(double a, double d)
{
    double most = 0;
    for (int i = 1; i < 64; i++)
        most = fmax(most, curve(a + d * i / 64) - curve(a) - (curve(a + d) - curve(a)) * i / 64);
    return most;
}

/* The largest sum of changes along and across, NUMERICS 4.7. */
static double limit(double least)
{
    return (least * 5 / 8 + 3 / 512.0) / (frame.picture.format == GN_FORMAT_RGB888 ? 2 : 1);
}

/* The bound of NUMERICS 4.7: the error of one direction grows faster than the change, so that it is largest if all of
 * the change is in one. */
static double bound(void)
{
    double most = 0;
    for (int i = 0; i <= 2000; i++) {
        double a = pow(i / 2000.0, 3);
        most = fmax(most, chord_error(a, fmin(limit(a), 1 - a)));
    }
    return most;
}

static double corner(int i, int c)
{
    return ldexp(shading.lattice.look.colour_q24[i][c], -24);
}

static int is_gentle(int halves)
{
    for (int c = 0; c < 3; c++) {
        double v[4], lo = 2, hi = -1;
        for (int i = 0; i < 4; i++) {
            v[i] = corner(i, c);
            lo = fmin(lo, v[i]);
            hi = fmax(hi, v[i]);
        }
        double across = fmax(fabs(v[0] - v[1]), fabs(v[2] - v[3])), down = fmax(fabs(v[0] - v[2]), fabs(v[1] - v[3]));
        if (lo < 0 || hi > 1 || ldexp(across + down, -halves) > limit(lo) + 1e-6) return 0;
    }
    return 1;
}

/* Random corners: of one colour, of little change, or of any, some of them beyond black and white. */
static void choose_corners(int kind)
{
    for (int c = 0; c < 3; c++) {
        int32_t from = (int32_t)(rng_u32(&random_state) >> rng_range(&random_state, 8, 20)),
                change = kind == 0   ? 1 << 10
                         : kind == 1 ? from / 2
                         : kind == 2 ? (from >> rng_range(&random_state, 1, 4)) + (1 << 16)
                                     : 1 << 25;
        for (int i = 0; i < 4; i++)
            shading.lattice.look.colour_q24[i][c] =
                from + (int32_t)rng_below(&random_state, (uint32_t)change + 1) - (kind == 3 && i == 2 ? 1 << 24 : 0);
    }
}

static int level_at(int32_t x, int32_t y, int c, int *levels)
{
    const int32_t i = (y - Y0) * WIDTH + x - X0;
    *levels = frame.picture.format == GN_FORMAT_RGB888 ? 255 : c == 1 ? 63 : 31;
    if (*levels == 255) return tile->bytes[3 * i + c];
    uint32_t v = tile->rgb565[i];
    if (frame.picture.format == GN_FORMAT_RGB565_SWAPPED) v = v >> 8 | (v & 255U) << 8;
    return (int)(v >> (c == 0 ? 11 : c == 1 ? 5 : 0)) & *levels;
}

/* Every pixel of the cell: half a level, the bound if levels may be interpolated, what patches in 32 bits lose (16 + 16
 * + 256 units, and a fraction of Q20 at a corner) where the curve is steepest, and the curve's 1.5 of 65535. */
static void check_cell(int32_t size, double most, tally *near, tally *kept)
{
    const int32_t at = CELL_X - shading.lattice.x;
    const double allowed = is_gentle(0) || (size == 16 && is_gentle(1)) ? most : 0;
    for (int32_t y = Y0; y < Y0 + HEIGHT; y++)
        for (int32_t x = X0; x < X0 + WIDTH; x++) {
            const int32_t right = x - CELL_X, down = y - CELL_Y;
            int stored = right >= 0 && right < size && down >= 0 && down < size, levels;
            if (stored) stored = (int)(shading.lattice.bits[at >> 5][down] >> ((at & 31) + right) & 1U);
            for (int c = 0; c < 3; c++) {
                const int level = level_at(x, y, c, &levels);
                const double u = (double)right / size, v = (double)down / size,
                             light = (corner(0, c) * (1 - u) + corner(1, c) * u) * (1 - v) +
                                     (corner(2, c) * (1 - u) + corner(3, c) * u) * v,
                             exact = levels * curve(fmin(fmax(light, 0), 1)),
                             tolerance = 0.5 + levels * (allowed + 12.92 * ldexp(288 + 16, -24) + 1.5 / 65535);
                if (stored)
                    HOLDS(near, fabs(level - exact) <= tolerance, "format %d, size %d: level %d, not %.3f, +- %.3f",
                          (int)frame.picture.format, (int)size, level, exact, tolerance);
                else HOLDS(kept, level == levels, "%d %d", (int)x, (int)y);
            }
        }
}

static void test_blocks(void)
{
    static const gn_format formats[] = {GN_FORMAT_RGB565, GN_FORMAT_RGB565_SWAPPED, GN_FORMAT_RGB888};
    double most[3][2];
    tally near = {0}, kept = {0};
    shading.frame = &frame;
    shading.rows = (gn_pixel_rows){tile, WIDTH, X0, Y0};
    shading.lattice.y = CELL_Y;
    for (int f = 0; f < 6; f++) {
        frame.picture.format = formats[f >> 1];
        SET_KNOB(&frame, srgb, f & 1);
        most[f >> 1][f & 1] = bound();
        printf("format %d, curve %d: levels off by %.3f of 63, %.3f of 255\n", (int)formats[f >> 1], f & 1,
               63 * most[f >> 1][f & 1], 255 * most[f >> 1][f & 1]);
    }
    for (int k = 0; k < 12000; k++) {
        const int32_t size_log2 = rng_range(&random_state, 1, 4);
        const int f = k % 3, curved = k % 5 > 0;
        frame.picture.format = formats[f];
        SET_KNOB(&frame, srgb, curved);
        for (int32_t y = 0; y < 16; y++)
            shading.lattice.bits[0][y] = shading.lattice.bits[1][y] = k & 8    ? rng_u32(&random_state)
                                                                      : k & 16 ? UINT32_MAX
                                                                               : 0x0FF00FF0U >> y;
        shading.lattice.x = CELL_X - 16 * rng_range(&random_state, 0, 3);
        choose_corners(k / 3 % 4);
        memset(tile, 0xFF, sizeof tile);
        gn_lattice_draw_blocks(&shading, CELL_X, CELL_Y, size_log2);
        check_cell(1 << size_log2, most[f][curved], &near, &kept);
    }
    CHECK_TALLY(near, "levels of blocks");
    CHECK_TALLY(kept, "what a block does not store is kept");
}

/* What a corner is encoded to is the pixel of its colour. */
static void test_corners(void)
{
    static const gn_format formats[] = {GN_FORMAT_RGB565, GN_FORMAT_RGB565_SWAPPED, GN_FORMAT_RGB888};
    tally same = {0};
    for (int k = 0; k < 300000; k++) {
        int32_t colour[3], level[3];
        uint32_t q20[3];
        frame.picture.format = formats[k % 3];
        SET_KNOB(&frame, srgb, k % 5 > 0);
        for (int c = 0; c < 3; c++) {
            colour[c] = (int32_t)(rng_below(&random_state, (1 << 24) + 1) >> rng_below(&random_state, 16));
            q20[c] = (uint32_t)colour[c] >> 4;
        }
        HOLDS(&same, gn_pixel_encode(&frame, colour, level) == gn_pixel_pack(&frame, q20), "%d: %d %d %d", k,
              (int)colour[0], (int)colour[1], (int)colour[2]);
    }
    CHECK_TALLY(same, "corners are packed like single pixels");
}
#endif

int main(void)
{
#if GN_INTERPOLATES
    test_corners();
    test_blocks();
#endif
    return check_report();
}
