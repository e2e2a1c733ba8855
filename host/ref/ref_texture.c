/* Textures, masks and alpha (DESIGN 1.8, 1.9). */
#include "ref_internal.h"

/* The texels that a sample mixes; nearest has one. */
typedef struct {
    size_t texel[4];
    double weight[4];
} footprint;

static int wrap(double i, int size, bool clamped)
{
    if (clamped) return (int)clamp(i, 0.0, size - 1.0);
    return (int)(i - size * floor(i / size));
}

static footprint nearest(const scene_texture *t, double u, double v)
{
    const int i = wrap(floor(u * t->width), t->width, t->clamp_u),
              j = wrap(floor(v * t->height), t->height, t->clamp_v);
    return (footprint){.texel = {(size_t)j * (size_t)t->width + (size_t)i}, .weight = {1.0}};
}

static footprint bilinear(const scene_texture *t, double u, double v, bool clamp_u, bool clamp_v)
{
    const double x = u * t->width - 0.5, y = v * t->height - 0.5;
    footprint f;
    for (int k = 0; k < 4; k++) {
        const int right = k & 1, down = k >> 1;
        const int i = wrap(floor(x) + right, t->width, clamp_u), j = wrap(floor(y) + down, t->height, clamp_v);
        f.texel[k] = (size_t)j * (size_t)t->width + (size_t)i;
        f.weight[k] = (right ? frac(x) : 1.0 - frac(x)) * (down ? frac(y) : 1.0 - frac(y));
    }
    return f;
}

static footprint sample(const scene_texture *t, double u, double v)
{
    return t->bilinear ? bilinear(t, u, v, t->clamp_u, t->clamp_v) : nearest(t, u, v);
}

/* The values that a channel has, less one: what its bits can say. Palettes have colours of 8 bits. [M11] */
static double levels_of(scene_texture_format format, int channel)
{
    static const double of[][4] = {
        [SCENE_TEXTURE_RGBA8888] = {255, 255, 255, 255}, [SCENE_TEXTURE_RGB565] = {31, 63, 31, 1},
        [SCENE_TEXTURE_RGB565A1] = {31, 31, 31, 1},      [SCENE_TEXTURE_PALETTE8] = {255, 255, 255, 255},
        [SCENE_TEXTURE_PALETTE4] = {255, 255, 255, 255}, [SCENE_TEXTURE_PALETTE1] = {255, 255, 255, 255},
        [SCENE_TEXTURE_GREY8] = {255, 255, 255, 1},      [SCENE_TEXTURE_GREY4] = {15, 15, 15, 1},
        [SCENE_TEXTURE_ALPHA8] = {1, 1, 1, 255},         [SCENE_TEXTURE_ALPHA4] = {1, 1, 1, 15}};
    return of[format][channel];
}

/* A channel as it is stored, 0..1: the level that 8 bits are nearest to. */
static double stored_channel(const scene_texture *t, size_t texel, int channel)
{
    const double levels = levels_of(t->format, channel);
    return floor(t->rgba[4 * texel + (size_t)channel] / 255.0 * levels + 0.5) / levels;
}

static double mix_channel(const scene_texture *t, const footprint *f, int channel)
{
    double sum = 0.0;
    for (int k = 0; k < 4; k++)
        if (f->weight[k] > 0.0) sum += f->weight[k] * stored_channel(t, f->texel[k], channel);
    return sum;
}

/* IEC 61966-2-1 */
static double srgb_decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

static double mix_decoded(const scene_texture *t, const footprint *f, int channel)
{
    double sum = 0.0;
    for (int k = 0; k < 4; k++)
        if (f->weight[k] > 0.0) sum += f->weight[k] * srgb_decode(stored_channel(t, f->texel[k], channel));
    return sum;
}

void ref_sample_texture(double rgba[4], const scene_texture *texture, double u, double v)
{
    const footprint f = sample(texture, u, v);
    for (int c = 0; c < 3; c++) rgba[c] = mix_decoded(texture, &f, c);
    rgba[3] = mix_channel(texture, &f, 3);
}

static vec2 mix_uv(const double *uv, const uint32_t idx[3], const double bary[3])
{
    vec2 sum = {0.0, 0.0};
    for (int k = 0; k < 3; k++) {
        sum.x += bary[k] * uv[2 * (size_t)idx[k]];
        sum.y += bary[k] * uv[2 * (size_t)idx[k] + 1];
    }
    return sum;
}

/* NULL: none */
static const scene_texture *texture_of(const scene *s, const ref_triangle *t)
{
    return t->object->texture_idx < s->n_textures && t->mesh->uv ? &s->textures[t->object->texture_idx] : NULL;
}

double ref_alpha(const scene *s, const ref_triangle *triangle, const double bary[3])
{
    const scene_texture *texture = texture_of(s, triangle);
    if (!texture) return triangle->object->alpha;
    const vec2 uv = mix_uv(triangle->mesh->uv, triangle->idx, bary);
    const footprint f = sample(texture, uv.x, uv.y);
    return triangle->object->alpha * mix_channel(texture, &f, 3);
}

/* In linear light. [M3] */
vec3 ref_texture_colour(const scene *s, const ref_triangle *triangle, const double bary[3])
{
    const scene_texture *texture = texture_of(s, triangle);
    if (!texture) return (vec3){1.0, 1.0, 1.0};
    const vec2 uv = mix_uv(triangle->mesh->uv, triangle->idx, bary);
    double rgba[4];
    ref_sample_texture(rgba, texture, uv.x, uv.y);
    return vec3_load(rgba);
}

/* Interleaved gradient noise. [D7] */
double ref_dither_noise(int x, int y)
{
    return frac(52.9829189 * frac(0.06711056 * (x + 0.5) + 0.00583715 * (y + 0.5)));
}

/* Clip cuts below the cutoff, dither below the noise. [M1] [M8] */
bool ref_alpha_cuts(scene_alpha mode, double alpha, double cutoff, int x, int y)
{
    switch (mode) {
    case SCENE_ALPHA_CLIP:
        return alpha < cutoff;
    case SCENE_ALPHA_DITHER:
        return alpha < ref_dither_noise(x, y);
    case SCENE_ALPHA_OPAQUE:
        break;
    }
    return false;
}

/* An image goes before a mask per vertex; it is always bilinear and clamped. [M5] */
double ref_mask(const scene *s, const ref_triangle *triangle, const double bary[3], int channel)
{
    const scene_object *object = triangle->object;
    if (s->shadow.mixing == SCENE_MIX_NONE || channel < 0 || channel > 3) return 1.0;
    if (object->mask_texture_idx < s->n_textures && triangle->mesh->mask_uv) {
        const scene_texture *image = &s->textures[object->mask_texture_idx];
        const vec2 uv = mix_uv(triangle->mesh->mask_uv, triangle->idx, bary);
        const footprint f = bilinear(image, uv.x, uv.y, true, true);
        return mix_channel(image, &f, channel);
    }
    if (!object->mask) return 1.0;
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum += bary[k] * object->mask[4 * (size_t)triangle->idx[k] + (size_t)channel];
    return sum / 255.0;
}
