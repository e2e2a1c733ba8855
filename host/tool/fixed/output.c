/* Output formats (R5) as people see them. */
#include "output.h"

#include <math.h>
#include <string.h>

const char *const output_names[] = {"rgb565", "rgb888", "rgb565_swapped", "grey8", "grey4", "mono1", NULL};

static void grey(uint8_t rgb8[3], unsigned v)
{
    rgb8[0] = rgb8[1] = rgb8[2] = (uint8_t)v;
}

static void expand565(uint8_t rgb8[3], unsigned v)
{
    unsigned r = v >> 11, g = v >> 5 & 63U, b = v & 31U;
    rgb8[0] = (uint8_t)(r << 3 | r >> 2);
    rgb8[1] = (uint8_t)(g << 2 | g >> 4);
    rgb8[2] = (uint8_t)(b << 3 | b >> 2);
}

/* Pixel i of a row of packed pixels */
static void decode_pixel(gn_format format, const uint8_t *row, int i, uint8_t rgb8[3])
{
    uint16_t word;
    switch (format) {
    case GN_FORMAT_RGB565:
    case GN_FORMAT_RGB565_SWAPPED:
        memcpy(&word, row + 2 * i, sizeof word);
        expand565(rgb8, format == GN_FORMAT_RGB565 ? word : (unsigned)(word >> 8 | (word & 255) << 8));
        break;
    case GN_FORMAT_GREY8:
        grey(rgb8, row[i]);
        break;
    case GN_FORMAT_GREY4:
        grey(rgb8, (i & 1 ? row[i / 2] & 15U : (unsigned)row[i / 2] >> 4) * 17U);
        break;
    case GN_FORMAT_MONO1:
        grey(rgb8, row[i / 8] >> (7 - i % 8) & 1 ? 255 : 0);
        break;
    default:
        memcpy(rgb8, row + 3 * i, 3);
        break;
    }
}

void output_decode(gn_format format, int x, int y, int w, int h, const void *pixels, uint8_t *rgb8, int width)
{
    for (int row = 0; row < h; row++)
        for (int i = 0; i < w; i++)
            decode_pixel(format, (const uint8_t *)pixels + (size_t)row * gn_format_bytes(format, (uint32_t)w, 1), i,
                         rgb8 + 3 * ((size_t)(y + row) * (size_t)width + (size_t)(x + i)));
}

void output_flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    output_panel *p = user;
    output_decode(p->format, x, y, w, h, pixels, p->rgb8, p->width);
}

static double to_linear(double v, int srgb)
{
    if (!srgb) return v;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double to_encoded(double v, int srgb)
{
    if (!srgb) return v;
    return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
}

/* Bayer's matrix, by its recursion: 4 M and 4 M + 2 over 4 M + 3 and 4 M + 1 */
static int bayer(int x, int y, int size)
{
    static const int corner[2][2] = {{0, 2}, {3, 1}};
    if (size == 1) return 0;
    return 4 * bayer(x, y, size / 2) + corner[y / (size / 2) & 1][x / (size / 2) & 1];
}

static unsigned level(double v, double levels)
{
    return (unsigned)floor(v * levels + 0.5);
}

const double *output_levels(gn_format format)
{
    static const double of_565[3] = {31, 63, 31}, of_888[3] = {255, 255, 255}, of_greys[3] = {0x1p40, 0x1p40, 0x1p40};
    if (format == GN_FORMAT_RGB565 || format == GN_FORMAT_RGB565_SWAPPED) return of_565;
    return format == GN_FORMAT_RGB888 ? of_888 : of_greys;
}

void output_quantise(gn_format format, const double encoded[3], int srgb, int x, int y, uint8_t rgb8[3])
{
    static const double weight[3] = {0.2126, 0.7152, 0.0722};
    double luminance = 0;
    for (int i = 0; i < 3; i++) luminance += weight[i] * to_linear(encoded[i], srgb);
    switch (format) {
    case GN_FORMAT_RGB565:
    case GN_FORMAT_RGB565_SWAPPED:
        expand565(rgb8, level(encoded[0], 31) << 11 | level(encoded[1], 63) << 5 | level(encoded[2], 31));
        break;
    case GN_FORMAT_GREY8:
        grey(rgb8, level(to_encoded(luminance, srgb), 255));
        break;
    case GN_FORMAT_GREY4:
        grey(rgb8, level(to_encoded(luminance, srgb), 15) * 17);
        break;
    case GN_FORMAT_MONO1:
        grey(rgb8, luminance * 128 > 2 * bayer(x & 7, y & 7, 8) + 1 ? 255 : 0);
        break;
    default:
        for (int i = 0; i < 3; i++) rgb8[i] = (uint8_t)level(encoded[i], 255);
        break;
    }
}
