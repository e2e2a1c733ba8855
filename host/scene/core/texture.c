/* Pictures -> textures of the scene: of at most 4096 texels a side. */
#include "loader.h"
#include "texture_format.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_TEXTURE_SIDE = 4096 };

static bool fit_sides(loader *l, rgba8_picture *picture, const texture_use *use, scene_texture *texture)
{
    texture->width = picture->w;
    texture->height = picture->h;
    texture->rgba = picture->rgba;
    picture->rgba = NULL;
    if (picture->w <= MAX_TEXTURE_SIDE && picture->h <= MAX_TEXTURE_SIDE) return true;
    if (!texture_shrink(texture, MAX_TEXTURE_SIDE, use->is_data, NULL))
        return budget_fail_memory(l, (size_t)MAX_TEXTURE_SIDE * MAX_TEXTURE_SIDE * 4);
    return loader_note(l, "texture '%s' of %dx%d is resampled to %dx%d: sides are at most %d", texture->name,
                       picture->w, picture->h, texture->width, texture->height, (int)MAX_TEXTURE_SIDE);
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

/* A third more, which is paid for, too. */
static bool add_levels(loader *l, scene_texture *texture)
{
    texture->mipmapped = true;
    const size_t n = 4 * texture_level_texels(texture, texture_level_count(texture)),
                 more = n - 4 * texture_level_texels(texture, 1);
    const char *over = budget_spend(l, BUDGET_TEXTURE_BYTES, more);
    if (over) return loader_fail(l, "%s: levels of texture '%.200s': %s", l->path, texture->name, over);
    return (arena_reserve(&l->memory, more) && texture_set_levels(texture, true)) || budget_fail_memory(l, n);
}

bool texture_add(loader *l, const char *name, rgba8_picture *picture, const texture_use *use, size_t *out)
{
    scene_texture *texture = loader_add_texture(l, name);
    bool ok = texture != NULL;
    if (ok) {
        *out = l->s->n_textures - 1;
        texture->clamp_u = use->clamp_u;
        texture->clamp_v = use->clamp_v;
        memcpy(texture->mirrored, use->mirrored, sizeof texture->mirrored);
        texture->bilinear = use->bilinear;
        ok = fit_sides(l, picture, use, texture) && (!use->mipmapped || l->options->posed || add_levels(l, texture));
    }
    if (ok && picture->depth > 8) ok = loader_note(l, "texture '%s' is rounded from 16 bits to 8", name);
    free(picture->rgba);
    picture->rgba = NULL;
    return ok;
}

static void copy_mirrored(uint8_t *to, const uint8_t *from, int w, int h, int axis)
{
    const int width = axis ? w : 2 * w, height = axis ? 2 * h : h;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const int from_x = x < w ? x : 2 * w - 1 - x, from_y = y < h ? y : 2 * h - 1 - y;
            memcpy(to + 4 * ((size_t)y * (size_t)width + (size_t)x),
                   from + 4 * ((size_t)from_y * (size_t)w + (size_t)from_x), 4);
        }
}

bool texture_add_mirror(loader *l, scene_texture *texture, int axis)
{
    if (!texture_shrink(texture, MAX_TEXTURE_SIDE / 2, false, NULL))
        return budget_fail_memory(l, (size_t)MAX_TEXTURE_SIDE * MAX_TEXTURE_SIDE);
    const int w = texture->width, h = texture->height;
    const size_t n = (size_t)w * (size_t)h * 8;
    const char *over = budget_spend(l, BUDGET_TEXTURE_BYTES, n);
    if (over) return loader_fail(l, "%s: mirrored texture '%.200s': %s", l->path, texture->name, over);
    uint8_t *rgba = loader_own(l, n, 1);
    if (!rgba) return false;
    copy_mirrored(rgba, texture->rgba, w, h, axis);
    free(texture->rgba);
    texture->rgba = rgba;
    texture->width = axis ? w : 2 * w;
    texture->height = axis ? 2 * h : h;
    return !texture->mipmapped || add_levels(l, texture);
}
