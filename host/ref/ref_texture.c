/* Textures, masks and alpha (MODEL 8, 9). */
#include "ref_internal.h"

/* One level of a texture. */
typedef struct {
    int width, height;
    size_t first; /* texel */
} level;

/* The texels that a sample mixes; nearest has one. */
typedef struct {
    size_t texel[4];
    double weight[4];
} footprint;

/* Behind each level lies the one of half its size, rounded down. [M11] */
static level level_of(const scene_texture *t, int idx)
{
    level l = {t->width, t->height, 0};
    for (int i = 0; i < idx; i++) {
        l.first += (size_t)l.width * (size_t)l.height;
        l.width = l.width > 1 ? l.width / 2 : 1;
        l.height = l.height > 1 ? l.height / 2 : 1;
    }
    return l;
}

static int wrap(double i, int size, bool clamped)
{
    if (clamped) return (int)clamp(i, 0.0, size - 1.0);
    return (int)(i - size * floor(i / size));
}

static footprint nearest(const scene_texture *t, level l, double u, double v)
{
    const int i = wrap(floor(u * l.width), l.width, t->clamp_u), j = wrap(floor(v * l.height), l.height, t->clamp_v);
    return (footprint){.texel = {l.first + (size_t)j * (size_t)l.width + (size_t)i}, .weight = {1.0}};
}

static footprint bilinear(level l, double u, double v, bool clamp_u, bool clamp_v)
{
    const double x = u * l.width - 0.5, y = v * l.height - 0.5;
    footprint f;
    for (int k = 0; k < 4; k++) {
        const int right = k & 1, down = k >> 1;
        const int i = wrap(floor(x) + right, l.width, clamp_u), j = wrap(floor(y) + down, l.height, clamp_v);
        f.texel[k] = l.first + (size_t)j * (size_t)l.width + (size_t)i;
        f.weight[k] = (right ? frac(x) : 1.0 - frac(x)) * (down ? frac(y) : 1.0 - frac(y));
    }
    return f;
}

static footprint sample(const scene_texture *t, int level_idx, double u, double v)
{
    const level l = level_of(t, level_idx);
    return t->bilinear ? bilinear(l, u, v, t->clamp_u, t->clamp_v) : nearest(t, l, u, v);
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

static double mix_decoded(const scene_texture *t, const footprint *f, int channel)
{
    double sum = 0.0;
    for (int k = 0; k < 4; k++)
        if (f->weight[k] > 0.0) sum += f->weight[k] * ref_srgb_decode(stored_channel(t, f->texel[k], channel));
    return sum;
}

void ref_sample_texture(double rgba[4], const scene_texture *texture, int level_idx, double u, double v)
{
    const footprint f = sample(texture, level_idx, u, v);
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
    const footprint f = sample(texture, 0, uv.x, uv.y);
    return triangle->object->alpha * mix_channel(texture, &f, 3);
}

/* S of MODEL 8: texels per unit of length, the root of the ratio of areas. */
static double texel_density(const scene_texture *texture, const ref_triangle *t)
{
    const double *uv = t->mesh->uv, *a = uv + 2 * (size_t)t->idx[0], *b = uv + 2 * (size_t)t->idx[1],
                 *c = uv + 2 * (size_t)t->idx[2];
    const vec3 *world = t->instance->world;
    const vec3 area =
        vec3_cross(vec3_sub(world[t->idx[1]], world[t->idx[0]]), vec3_sub(world[t->idx[2]], world[t->idx[0]]));
    const double turns = fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    return sqrt(turns * texture->width * texture->height / sqrt(vec3_dot(area, area)));
}

/* The level whose texels are nearest to a pixel's size on the surface, its longer way. [M11] */
static int level_at(const ref_frame *frame, const ref_triangle *t, const scene_texture *texture, double view_depth)
{
    if (!texture->mipmapped) return 0;
    const ref_camera *camera = &frame->camera;
    const vec3 face = ref_face_normal(t);
    const double density = texel_density(texture, t) / camera->focal_px;
    const double distance = fabs(vec3_dot(face, vec3_sub(t->instance->world[t->idx[0]], camera->position)));
    const double texels_per_px = camera->parallel ? density / fabs(vec3_dot(face, camera->forward))
                                                  : density * view_depth * view_depth / distance;
    const double last = floor(log2(fmax(texture->width, texture->height)));
    return texels_per_px > 0.0 ? (int)clamp(floor(log2(texels_per_px) + 0.5), 0.0, last) : 0;
}

static vec3 colour_of(const ref_frame *frame, const ref_triangle *triangle, size_t texture_idx, const double bary[3],
                      double view_depth)
{
    if (texture_idx >= frame->s->n_textures || !triangle->mesh->uv) return (vec3){1.0, 1.0, 1.0};
    const scene_texture *texture = &frame->s->textures[texture_idx];
    const vec2 uv = mix_uv(triangle->mesh->uv, triangle->idx, bary);
    double rgba[4];
    ref_sample_texture(rgba, texture, level_at(frame, triangle, texture, view_depth), uv.x, uv.y);
    return vec3_load(rgba);
}

/* In linear light. [M3] */
vec3 ref_texture_colour(const ref_frame *frame, const ref_triangle *triangle, const double bary[3], double view_depth)
{
    return colour_of(frame, triangle, triangle->object->texture_idx, bary, view_depth);
}

/* [M10] */
vec3 ref_emitted(const ref_frame *frame, const ref_triangle *triangle, const double bary[3], double view_depth)
{
    const vec3 texture = colour_of(frame, triangle, triangle->object->emissive_texture_idx, bary, view_depth);
    return vec3_mul(vec3_load(triangle->object->emissive), texture);
}

/* Interleaved gradient noise. [D7] */
double ref_dither_noise(int x, int y)
{
    return frac(52.9829189 * frac(0.06711056 * (x + 0.5) + 0.00583715 * (y + 0.5)));
}

/* Clip cuts below the cutoff, dither below the noise. An alpha that equals the cutoff may have been rounded below it,
 * as a mix of equal texels or a product: it is kept. [M1] [M8] */
bool ref_alpha_cuts(scene_alpha mode, double alpha, double cutoff, int x, int y)
{
    switch (mode) {
    case SCENE_ALPHA_CLIP:
        return alpha < cutoff - 1e-12;
    case SCENE_ALPHA_DITHER:
    case SCENE_ALPHA_BLEND: /* without layers */
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
        const footprint f = bilinear(level_of(image, 0), uv.x, uv.y, true, true);
        return mix_channel(image, &f, channel);
    }
    if (!object->mask) return 1.0;
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum += bary[k] * object->mask[4 * (size_t)triangle->idx[k] + (size_t)channel];
    return sum / 255.0;
}
