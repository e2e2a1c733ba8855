/* Textures and mask images. */
#include "quantise_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -1: not a power of two up to 4096 */
static int side_log2(int texels)
{
    for (int i = 0; i <= 12; i++)
        if (texels == 1 << i) return i;
    return -1;
}

int quantise_texture(gn_texture *out, const scene_texture *t, char *error, size_t error_bytes)
{
    int width = side_log2(t->width), height = side_log2(t->height);
    if (width < 0 || height < 0) {
        snprintf(error, error_bytes, "texture '%s': its sides, %d and %d, are not powers of two up to 4096", t->name,
                 t->width, t->height);
        return -1;
    }
    out->rgba = t->rgba;
    out->width_log2 = (uint8_t)width;
    out->height_log2 = (uint8_t)height;
    out->flags = (uint8_t)((t->clamp_u ? GN_TEXTURE_CLAMP_U : 0) | (t->clamp_v ? GN_TEXTURE_CLAMP_V : 0) |
                           (t->bilinear ? GN_TEXTURE_BILINEAR : 0));
    return 0;
}

size_t quantise_texel_bytes(const gn_texture *t)
{
    return t->flags & GN_TEXTURE_MASK_1 ? 1 : t->flags & GN_TEXTURE_MASK_2 ? 2 : 4;
}

/* Whether the texture is a mask image and nothing else. */
static bool is_mask_image(const scene *s, size_t texture)
{
    bool mask = false;
    for (size_t i = 0; i < s->n_objects; i++) {
        if (s->objects[i].texture_idx == texture) return false;
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
    const size_t bytes = n_channels > 1 ? 2 : 1, n = (size_t)1 << (out->width_log2 + out->height_log2);
    uint8_t *packed = malloc(bytes * n);
    if (!packed) return -1;
    for (size_t i = 0; i < bytes * n; i++) packed[i] = out->rgba[4 * (i / bytes) + i % bytes];
    out->rgba = packed;
    out->flags = (uint8_t)(out->flags | (bytes == 1 ? GN_TEXTURE_MASK_1 : GN_TEXTURE_MASK_2));
    return 0;
}
