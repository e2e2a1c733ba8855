/* Pictures -> textures of the scene: sides become powers of two, so that both engines look up the very same texels. */
#include "loader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_TEXTURE_SIDE = 4096 };

static double srgb_decode(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* The 256 levels in linear light, and the borders between them: border[k] is between k and k + 1. */
typedef struct {
    double level[256], border[255];
} level_table;

static void make_levels(level_table *t, bool linear)
{
    for (int i = 0; i < 256; i++) t->level[i] = linear ? i / 255.0 : srgb_decode(i / 255.0);
    for (int i = 0; i < 255; i++) t->border[i] = linear ? (i + 0.5) / 255 : srgb_decode((i + 0.5) / 255);
}

static uint8_t to_level(const level_table *t, double v)
{
    size_t low = 0, high = 255;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (v >= t->border[middle]) low = middle + 1;
        else high = middle;
    }
    return (uint8_t)low;
}

static int power_of_two(int n)
{
    int power = 1;
    while (power < n && power < MAX_TEXTURE_SIDE) power *= 2;
    return power;
}

/* The two texels of n that texel i of n_out lies between, and how far it is on the way from a to b. */
typedef struct {
    size_t a, b;
    double u;
} tap;

/* What a look-up without interpolation finds. */
static tap nearest_tap(int i, int n_out, int n)
{
    size_t at = (size_t)((i + 0.5) * n / n_out);
    return (tap){at, at, 0};
}

static tap find_tap(int i, int n_out, int n, bool clamp, bool bilinear)
{
    if (!bilinear) return nearest_tap(i, n_out, n);
    double at = (i + 0.5) * n / n_out - 0.5, below = floor(at);
    int a = (int)below, b = a + 1;
    if (a < 0) a = clamp ? 0 : n - 1;
    if (b >= n) b = clamp ? n - 1 : 0;
    return (tap){(size_t)a, (size_t)b, at - below};
}

/* How pictures are weighed: with their colours as light, and by alpha; or as plain numbers, each channel for itself. */
typedef struct {
    level_table colour, alpha;
    bool by_alpha;
} weighing;

/* A colour shows as far as its alpha says, so it counts that much: what a transparent texel is coloured must not bleed
 * into its neighbours. Where all are transparent nothing shows; the colours are then weighed alike. */
static void resample_texel(const uint8_t *rgba, size_t w, tap x, tap y, const weighing *weigh, uint8_t *out)
{
    const uint8_t *texel[4] = {rgba + 4 * (y.a * w + x.a), rgba + 4 * (y.a * w + x.b), rgba + 4 * (y.b * w + x.a),
                               rgba + 4 * (y.b * w + x.b)};
    const double weight[4] = {(1 - y.u) * (1 - x.u), (1 - y.u) * x.u, y.u * (1 - x.u), y.u * x.u};
    double alpha = 0;
    for (int i = 0; i < 4; i++) alpha += weight[i] * weigh->alpha.level[texel[i][3]];
    for (int k = 0; k < 3; k++) {
        double plain = 0, shown = 0;
        for (int i = 0; i < 4; i++) {
            double part = weight[i] * weigh->colour.level[texel[i][k]];
            plain += part;
            shown += part * weigh->alpha.level[texel[i][3]];
        }
        out[k] = to_level(&weigh->colour, weigh->by_alpha && alpha > 0 ? shown / alpha : plain);
    }
    out[3] = to_level(&weigh->alpha, alpha);
}

/* As the texture is looked up, nearest or bilinear: bilinear in linear light, and around the corner where the texture
 * repeats. At most halves a side (of a picture up to TEXTURE_MAX_PICTURE): bilinear, no texel is skipped. */
static void resample(const rgba8_picture *from, const texture_use *use, scene_texture *to)
{
    weighing weigh = {.by_alpha = !use->is_data};
    make_levels(&weigh.colour, use->is_data);
    make_levels(&weigh.alpha, true);
    for (int j = 0; j < to->height; j++) {
        tap y = find_tap(j, to->height, from->h, to->clamp_v, use->bilinear);
        for (int i = 0; i < to->width; i++) {
            tap x = find_tap(i, to->width, from->w, to->clamp_u, use->bilinear);
            uint8_t *out = to->rgba + 4 * ((size_t)j * (size_t)to->width + (size_t)i);
            resample_texel(from->rgba, (size_t)from->w, x, y, &weigh, out);
        }
    }
}

static bool fit_sides(loader *l, rgba8_picture *picture, const texture_use *use, scene_texture *texture)
{
    texture->width = power_of_two(picture->w);
    texture->height = power_of_two(picture->h);
    if (texture->width == picture->w && texture->height == picture->h) {
        texture->rgba = picture->rgba;
        picture->rgba = NULL;
        return true;
    }
    texture->rgba = loader_own(l, (size_t)texture->width * (size_t)texture->height, 4);
    if (!texture->rgba) return false;
    resample(picture, use, texture);
    return loader_note(l, "texture '%s' of %dx%d is resampled to %dx%d: sides must be powers of two up to %d",
                       texture->name, picture->w, picture->h, texture->width, texture->height, (int)MAX_TEXTURE_SIDE);
}

/* What is damaged further behind has been paid for, too. */
bool texture_may_decode(loader *l, const char *name, const uint8_t *bytes, size_t n_bytes)
{
    int w, h;
    size_t n_work;
    if (!picture_measure(bytes, n_bytes, &w, &h, &n_work)) return true;
    if (w > TEXTURE_MAX_PICTURE || h > TEXTURE_MAX_PICTURE)
        return loader_fail(l, "%s: texture '%.200s' of %dx%d: sides are at most %d", l->path, name, w, h,
                           (int)TEXTURE_MAX_PICTURE);
    size_t n = (size_t)w * (size_t)h * 4;
    const char *over = budget_spend(l, BUDGET_TEXTURE_BYTES, n);
    if (over) return loader_fail(l, "%s: texture '%.200s' of %dx%d: %s", l->path, name, w, h, over);
    bool fits = arena_has_room(&l->memory, n + n_work) && arena_reserve(&l->memory, n);
    return fits || budget_fail_memory(l, n + n_work);
}

bool texture_add(loader *l, const char *name, rgba8_picture *picture, const texture_use *use, size_t *out)
{
    scene_texture *texture = loader_add_texture(l, name);
    bool ok = texture != NULL;
    if (ok) {
        *out = l->s->n_textures - 1;
        texture->clamp_u = use->clamp_u;
        texture->clamp_v = use->clamp_v;
        texture->bilinear = use->bilinear;
        ok = fit_sides(l, picture, use, texture);
    }
    if (ok && picture->depth > 8) ok = loader_note(l, "texture '%s' is rounded from 16 bits to 8", name);
    free(picture->rgba);
    picture->rgba = NULL;
    return ok;
}
