/* Small textures. */
#include "texture_format.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const texture_format_names[] = {"rgba8888", "rgb565", "rgb565a1", "palette8", "palette4", "palette1",
                                            "grey8",    "grey4",  "alpha8",   "alpha4",   NULL};

int texture_format_levels(scene_texture_format format, int channel)
{
    switch (format) {
    case SCENE_TEXTURE_RGB565:
        return channel == 1 ? 63 : 31;
    case SCENE_TEXTURE_RGB565A1:
        return channel == 3 ? 1 : 31;
    case SCENE_TEXTURE_GREY4:
    case SCENE_TEXTURE_ALPHA4:
        return 15;
    default:
        return 255;
    }
}

int texture_format_bits(scene_texture_format format)
{
    static const int bits[] = {32, 16, 16, 8, 4, 1, 8, 4, 8, 4};
    return bits[format];
}

static int side_of(int texels, int level)
{
    return texels >> level > 0 ? texels >> level : 1;
}

size_t texture_level_texels(const scene_texture *t, int n)
{
    size_t sum = 0;
    for (int i = 0; i < n; i++) sum += (size_t)side_of(t->width, i) * (size_t)side_of(t->height, i);
    return sum;
}

int texture_level_count(const scene_texture *t)
{
    int n = 1;
    while (t->mipmapped && (t->width >> n || t->height >> n)) n++;
    return n;
}

static size_t count(const scene_texture *t)
{
    return texture_level_texels(t, texture_level_count(t));
}

/* The 8 bits nearest to the nearest of so many levels. */
static uint8_t rounded_level(uint8_t v, int levels)
{
    return (uint8_t)floor(floor(v * levels / 255.0 + 0.5) * 255.0 / levels + 0.5);
}

static double decode(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double encode(double v)
{
    return v <= 0.0031308 ? v * 12.92 : 1.055 * pow(v, 1 / 2.4) - 0.055;
}

static uint8_t grey_of(const uint8_t *rgba)
{
    double y = 0.2126 * decode(rgba[0] / 255.0) + 0.7152 * decode(rgba[1] / 255.0) + 0.0722 * decode(rgba[2] / 255.0);
    return (uint8_t)floor(encode(y) * 255 + 0.5);
}

/* ---- Palettes ---------------------------------------------------------------------------------------------------- */

/* Texels from first on, and the channel in which they differ most. */
typedef struct {
    size_t first, n;
    int channel, spread;
} box;

static void measure(box *b, const uint32_t *texel)
{
    b->spread = 0;
    for (int c = 0; c < 4; c++) {
        int lo = 255, hi = 0;
        for (size_t i = b->first; i < b->first + b->n; i++) {
            int v = (int)(texel[i] >> 8 * c & 255U);
            lo = v < lo ? v : lo;
            hi = v > hi ? v : hi;
        }
        if (hi - lo <= b->spread) continue;
        b->spread = hi - lo;
        b->channel = c;
    }
}

/* Texels in order of a channel: counted, 256 values. Those below the middle value go before the others; which is where
 * the box is cut. */
static size_t cut(const box *b, uint32_t *texel, uint32_t *spare)
{
    size_t n[257] = {0}, at = 0;
    for (size_t i = b->first; i < b->first + b->n; i++) n[(texel[i] >> 8 * b->channel & 255U) + 1]++;
    for (int v = 0; v < 256; v++) n[v + 1] += n[v];
    int lo = 0, middle = 1;
    while (n[lo + 1] == 0) lo++;
    for (middle = lo + 1; middle < 255 && n[middle] < b->n / 2 && n[middle + 1] < b->n;) middle++;
    at = n[middle];
    for (size_t i = b->first; i < b->first + b->n; i++) spare[n[texel[i] >> 8 * b->channel & 255U]++] = texel[i];
    memcpy(texel + b->first, spare, b->n * sizeof *spare);
    return at;
}

static uint32_t mean(const box *b, const uint32_t *texel)
{
    uint32_t out = 0;
    for (int c = 0; c < 4; c++) {
        double sum = 0;
        for (size_t i = b->first; i < b->first + b->n; i++) sum += texel[i] >> 8 * c & 255U;
        out |= (uint32_t)floor(sum / (double)b->n + 0.5) << 8 * c;
    }
    return out;
}

static uint32_t word_of(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static int distance2(uint32_t a, uint32_t b)
{
    int sum = 0;
    for (int c = 0; c < 4; c++) {
        int d = (int)(a >> 8 * c & 255U) - (int)(b >> 8 * c & 255U);
        sum += d * d;
    }
    return sum;
}

/* Median cut: of all boxes the one with the largest spread is cut in two, until there are enough. */
static size_t choose_palette(uint32_t *texel, uint32_t *spare, size_t n, size_t n_max, uint32_t palette[256])
{
    box boxes[256] = {{0, n, 0, 0}};
    size_t n_boxes = 1;
    measure(&boxes[0], texel);
    while (n_boxes < n_max) {
        box *widest = boxes;
        for (size_t i = 1; i < n_boxes; i++)
            if (boxes[i].spread > widest->spread) widest = &boxes[i];
        if (!widest->spread) break;
        size_t at = cut(widest, texel, spare);
        boxes[n_boxes] = (box){widest->first + at, widest->n - at, 0, 0};
        widest->n = at;
        measure(widest, texel);
        measure(&boxes[n_boxes++], texel);
    }
    for (size_t i = 0; i < n_boxes; i++) palette[i] = mean(&boxes[i], texel);
    return n_boxes;
}

static bool to_palette(scene_texture *t, size_t n_max)
{
    size_t n = count(t);
    uint32_t palette[256], *texel = malloc(n * sizeof *texel), *spare = malloc(n * sizeof *spare);
    bool ok = texel && spare;
    for (size_t i = 0; ok && i < n; i++) texel[i] = word_of(t->rgba + 4 * i);
    size_t n_palette = ok ? choose_palette(texel, spare, n, n_max, palette) : 0;
    for (size_t i = 0; ok && i < n; i++) {
        uint32_t is = word_of(t->rgba + 4 * i), best = palette[0];
        for (size_t k = 1; k < n_palette; k++)
            if (distance2(is, palette[k]) < distance2(is, best)) best = palette[k];
        for (int c = 0; c < 4; c++) t->rgba[4 * i + (size_t)c] = (uint8_t)(best >> 8 * c);
    }
    free(texel);
    free(spare);
    return ok;
}

/* ---- Formats ----------------------------------------------------------------------------------------------------- */

static void to_levels(scene_texture *t, scene_texture_format format)
{
    bool grey = format == SCENE_TEXTURE_GREY8 || format == SCENE_TEXTURE_GREY4,
         alpha = format == SCENE_TEXTURE_ALPHA8 || format == SCENE_TEXTURE_ALPHA4;
    for (size_t i = 0; i < count(t); i++) {
        uint8_t *p = t->rgba + 4 * i;
        if (grey) p[0] = p[1] = p[2] = grey_of(p);
        if (alpha) p[0] = p[1] = p[2] = 255;
        if (grey || format == SCENE_TEXTURE_RGB565) p[3] = 255;
        for (int c = 0; c < 4; c++)
            if (p[c] != 255) p[c] = rounded_level(p[c], texture_format_levels(format, c));
    }
}

bool texture_convert(scene_texture *t, scene_texture_format format)
{
    size_t n = 4 * count(t);
    uint8_t *before = malloc(n);
    double sum = 0;
    if (!before) return false;
    memcpy(before, t->rgba, n);
    bool ok = true;
    if (format >= SCENE_TEXTURE_PALETTE8 && format <= SCENE_TEXTURE_PALETTE1)
        ok = to_palette(t, (size_t)1 << texture_format_bits(format));
    else to_levels(t, format);
    t->format = format;
    t->error_max = 0;
    for (size_t i = 0; i < n; i++) {
        int off = abs(t->rgba[i] - before[i]);
        if (off > t->error_max) t->error_max = off;
        sum += (double)off * off;
    }
    t->error_rms = sqrt(sum / (double)n);
    free(before);
    return ok;
}

/* ---- Sizes ------------------------------------------------------------------------------------------------------- */

/* How much of texel i lies between. */
static double overlap(int i, const double between[2])
{
    if (i >= between[0] && i + 1 <= between[1]) return 1;
    return fmin(i + 1, between[1]) - fmax(i, between[0]);
}

/* Of what lies between two columns and two rows; linear: what each of 256 values stands for. Where all is transparent
 * nothing shows: colours count alike. */
static void mean_of(const scene_texture *t, const double x[2], const double y[2], const double *linear, bool is_data,
                    uint8_t out[4])
{
    double shown[3] = {0}, plain[3] = {0}, alpha = 0, area = 0;
    for (int j = (int)y[0]; j < y[1]; j++) {
        const double high = overlap(j, y);
        const uint8_t *p = t->rgba + 4 * ((size_t)j * (size_t)t->width + (size_t)x[0]);
        for (int i = (int)x[0]; i < x[1]; i++, p += 4) {
            const double part = overlap(i, x) * high, weight = part * p[3];
            for (int c = 0; c < 3; c++) {
                plain[c] += part * linear[p[c]];
                shown[c] += weight * linear[p[c]];
            }
            alpha += weight;
            area += part;
        }
    }
    for (int c = 0; c < 3; c++) {
        const double v = alpha > 0 && !is_data ? shown[c] / alpha : plain[c] / area;
        out[c] = (uint8_t)floor((is_data ? v : encode(v)) * 255 + 0.5);
    }
    out[3] = (uint8_t)floor(alpha / area + 0.5);
}

/* The first level in w by h texels. */
static void scale(const scene_texture *t, int w, int h, bool is_data, uint8_t *out)
{
    double linear[256];
    for (int v = 0; v < 256; v++) linear[v] = is_data ? v / 255.0 : decode(v / 255.0);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            const double columns[2] = {(double)x * t->width / w, (double)(x + 1) * t->width / w},
                         rows[2] = {(double)y * t->height / h, (double)(y + 1) * t->height / h};
            mean_of(t, columns, rows, linear, is_data, out + 4 * ((size_t)y * (size_t)w + (size_t)x));
        }
}

/* Means are no texels of the format: palettes are chosen anew, of all levels. The error is that of both, at most. */
static bool convert_means(scene_texture *t)
{
    const double max = t->error_max, rms = t->error_rms;
    if (t->format == SCENE_TEXTURE_RGBA8888) return true;
    if (!texture_convert(t, t->format)) return false;
    t->error_max += max;
    t->error_rms = sqrt(t->error_rms * t->error_rms + rms * rms);
    return true;
}

bool texture_set_levels(scene_texture *t, bool mipmapped)
{
    t->mipmapped = mipmapped;
    if (!mipmapped) return convert_means(t);
    uint8_t *all = realloc(t->rgba, 4 * count(t));
    if (!all) return false;
    t->rgba = all;
    for (int i = 1; i < texture_level_count(t); i++)
        scale(t, side_of(t->width, i), side_of(t->height, i), false, all + 4 * texture_level_texels(t, i));
    return convert_means(t);
}

/* Of a picture of w by h texels in place of the texture's first level. */
static texture_error scaling_error(const scene_texture *t, int w, int h, const uint8_t *small)
{
    texture_error out = {0, 0};
    for (int y = 0; y < t->height; y++)
        for (int x = 0; x < t->width; x++) {
            const size_t column = (size_t)((2 * (int64_t)x + 1) * w / (2 * t->width)),
                         row = (size_t)((2 * (int64_t)y + 1) * h / (2 * t->height));
            const uint8_t *a = t->rgba + 4 * ((size_t)y * (size_t)t->width + (size_t)x),
                          *b = small + 4 * (row * (size_t)w + column);
            for (int c = 0; c < 4; c++) {
                const double off = c < 3 ? (a[c] * a[3] - b[c] * b[3]) / 255.0 : a[3] - b[3];
                out.max = fmax(out.max, fabs(off));
                out.rms += off * off;
            }
        }
    out.rms = sqrt(out.rms / (4.0 * t->width * t->height));
    return out;
}

bool texture_shrink(scene_texture *t, int side, bool is_data, texture_error *error)
{
    int longest = t->width > t->height ? t->width : t->height;
    if (longest <= side) return true;
    int w = t->width * side / longest, h = t->height * side / longest;
    w = w < 1 ? 1 : w;
    h = h < 1 ? 1 : h;
    uint8_t *small = malloc((size_t)w * (size_t)h * 4);
    if (!small) return false;
    scale(t, w, h, is_data, small);
    if (error) *error = scaling_error(t, w, h, small);
    memcpy(t->rgba, small, (size_t)w * (size_t)h * 4);
    t->width = w;
    t->height = h;
    free(small);
    return texture_set_levels(t, t->mipmapped);
}
