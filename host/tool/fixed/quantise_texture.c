/* Textures and mask images. */
#include "quantise_internal.h"

#include "../../scene/core/texture_format.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Static_assert((int)SCENE_TEXTURE_RGB565A1 == GN_TEXTURE_RGB565A1 &&
                   (int)SCENE_TEXTURE_PALETTE1 == GN_TEXTURE_PALETTE1 && (int)SCENE_TEXTURE_GREY4 == GN_TEXTURE_GREY4 &&
                   (int)SCENE_TEXTURE_ALPHA4 == GN_TEXTURE_ALPHA4,
               "formats are in the same order");

/* -1: not a power of two */
static int side_log2(int texels)
{
    for (int i = 0; i <= 12; i++)
        if (texels == 1 << i) return i;
    return -1;
}

size_t quantise_texture_side(const gn_texture *t, int axis)
{
    size_t side = axis ? t->height : t->width;
    return side ? side : (size_t)1 << (axis ? t->height_log2 : t->width_log2);
}

static size_t halved(size_t side)
{
    return side > 1 ? side / 2 : 1;
}

/* Of all levels. */
size_t quantise_texture_bytes(const gn_texture *t)
{
    size_t bits = (size_t)texture_format_bits((scene_texture_format)t->format);
    if (t->flags & GN_TEXTURE_MASK_1) bits = 8;
    if (t->flags & GN_TEXTURE_MASK_2) bits = 16;
    size_t sum = 0, w = quantise_texture_side(t, 0), h = quantise_texture_side(t, 1);
    for (bool more = true; more; w = halved(w), h = halved(h)) {
        sum += h * ((w * bits + 7) / 8);
        more = t->flags & GN_TEXTURE_MIPMAPPED && (w > 1 || h > 1);
    }
    return sum;
}

size_t quantise_palette_bytes(const gn_texture *t)
{
    return t->palette ? (size_t)4 << texture_format_bits((scene_texture_format)t->format) : 0;
}

/* ---- Texels ------------------------------------------------------------------------------------------------------ */

static unsigned level(const scene_texture *t, const uint8_t *p, int c)
{
    return (unsigned)(p[c] * texture_format_levels(t->format, c) * 2 + 255) / 510U;
}

/* A texel of 16 bits. */
static unsigned word_of(const scene_texture *t, const uint8_t *p)
{
    unsigned red = level(t, p, 0) << 11, blue = level(t, p, 2);
    if (t->format == SCENE_TEXTURE_RGB565) return red | level(t, p, 1) << 5 | blue;
    return red | level(t, p, 1) << 6 | level(t, p, 3) << 5 | blue;
}

/* The entry of a palette that is this texel; a new one if there is none. */
static unsigned entry_of(uint8_t *palette, size_t *n, const uint8_t *p)
{
    for (size_t i = 0; i < *n; i++)
        if (memcmp(palette + 4 * i, p, 4) == 0) return (unsigned)i;
    memcpy(palette + 4 * *n, p, 4);
    return (unsigned)(*n)++;
}

static void pack_level(uint8_t *out, uint8_t *palette, size_t *n, const scene_texture *t, const uint8_t *rgba, size_t w,
                       size_t h)
{
    const size_t bits = (size_t)texture_format_bits(t->format), stride = (w * bits + 7) / 8;
    for (size_t y = 0; y < h; y++)
        for (size_t x = 0; x < w; x++) {
            const uint8_t *p = rgba + 4 * (y * w + x);
            uint8_t *row = out + y * stride;
            if (bits == 16) {
                row[2 * x] = (uint8_t)word_of(t, p);
                row[2 * x + 1] = (uint8_t)(word_of(t, p) >> 8);
                continue;
            }
            const bool alpha = t->format >= SCENE_TEXTURE_ALPHA8;
            const unsigned v = palette ? entry_of(palette, n, p) : level(t, p, alpha ? 3 : 0);
            row[x * bits / 8] = (uint8_t)(row[x * bits / 8] | v << (8 - bits - x * bits % 8));
        }
}

static void pack(uint8_t *out, uint8_t *palette, const scene_texture *t)
{
    const size_t bits = (size_t)texture_format_bits(t->format);
    const uint8_t *rgba = t->rgba;
    size_t n = 0, w = (size_t)t->width, h = (size_t)t->height;
    for (int i = 0; i < texture_level_count(t); i++, w = halved(w), h = halved(h)) {
        pack_level(out, palette, &n, t, rgba, w, h);
        out += h * ((w * bits + 7) / 8);
        rgba += 4 * w * h;
    }
}

int quantise_texture(gn_texture *out, const scene_texture *t, char *error, size_t error_bytes)
{
    const int log2[2] = {side_log2(t->width), side_log2(t->height)};
    if (t->width < 1 || t->height < 1 || t->width > 4096 || t->height > 4096) {
        snprintf(error, error_bytes, "texture '%s': its sides, %d and %d, are not 1 to 4096", t->name, t->width,
                 t->height);
        return -1;
    }
    out->rgba = t->rgba;
    if (log2[0] >= 0 && log2[1] >= 0) {
        out->width_log2 = (uint8_t)log2[0];
        out->height_log2 = (uint8_t)log2[1];
    } else {
        out->width = (uint16_t)t->width;
        out->height = (uint16_t)t->height;
    }
    out->flags = (uint8_t)((t->clamp_u ? GN_TEXTURE_CLAMP_U : 0) | (t->clamp_v ? GN_TEXTURE_CLAMP_V : 0) |
                           (t->bilinear ? GN_TEXTURE_BILINEAR : 0) | (t->mipmapped ? GN_TEXTURE_MIPMAPPED : 0));
    out->format = (uint8_t)t->format;
    if (t->format == SCENE_TEXTURE_RGBA8888) return 0;
    const bool indexed = t->format >= SCENE_TEXTURE_PALETTE8 && t->format <= SCENE_TEXTURE_PALETTE1;
    uint8_t *texels = calloc(1, quantise_texture_bytes(out)), *palette = indexed ? calloc(256, 4) : NULL;
    out->rgba = texels;
    out->palette = palette;
    if (!texels || (indexed && !palette)) return quantise_no_memory(error, error_bytes);
    pack(texels, palette, t);
    return 0;
}

bool quantise_owns_texels(const gn_texture *t)
{
    return t->format != GN_TEXTURE_RGBA8888 || t->flags & (GN_TEXTURE_MASK_1 | GN_TEXTURE_MASK_2);
}

/* Whether the texture is a mask image and nothing else. */
static bool is_mask_image(const scene *s, size_t texture)
{
    bool mask = false;
    for (size_t i = 0; i < s->n_objects; i++) {
        if (s->objects[i].texture_idx == texture || s->objects[i].emissive_texture_idx == texture) return false;
        mask = mask || s->objects[i].mask_texture_idx == texture;
    }
    return mask;
}

int quantise_pack_mask_image(gn_texture *out, const scene *s, size_t texture)
{
    int n_channels = 0;
    for (size_t l = 0; l < s->n_lights; l++)
        if (s->lights[l].mode == SCENE_MIXED && s->lights[l].mask_channel >= n_channels)
            n_channels = s->lights[l].mask_channel + 1;
    if (n_channels > 2 || !is_mask_image(s, texture)) return 0;
    const size_t bytes = n_channels > 1 ? 2 : 1, n = quantise_texture_side(out, 0) * quantise_texture_side(out, 1);
    uint8_t *packed = malloc(bytes * n);
    if (!packed) return -1;
    for (size_t i = 0; i < bytes * n; i++) packed[i] = out->rgba[4 * (i / bytes) + i % bytes];
    out->rgba = packed;
    out->flags = (uint8_t)(out->flags | (bytes == 1 ? GN_TEXTURE_MASK_1 : GN_TEXTURE_MASK_2));
    return 0;
}
