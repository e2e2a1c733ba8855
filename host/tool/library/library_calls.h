/* The calls of the library that the including file is compiled with. */
#ifndef GNOMON_LIBRARY_CALLS_H
#define GNOMON_LIBRARY_CALLS_H

#include "library.h"

static gn_status begin(void *renderer, const gn_picture *picture, const settings *set)
{
    gn_renderer *r = renderer;
    gn_status status = gn_init(r, picture);
    if (status == GN_ERR_CONFIG) return status;
    r->frame.knobs = set->quality;
#if !GN_COMPACT
    r->frame.texels[0] = (uint32_t)set->capacity.atlas_texels;
    r->frame.texels[1] = (uint32_t)set->capacity.other_atlas_texels;
#endif
    return status;
}

static gn_status render(void *renderer, const gn_scene *now, gn_flush_fn flush, void *user)
{
    return gn_render(renderer, now, flush, user);
}

static gn_status prepare(void *renderer, const gn_scene *now)
{
    gn_status status = gn_begin(renderer, now);
    for (uint32_t i = 0; !status && i < gn_shadow_tile_count(renderer); i++) status = gn_shadow_tile(renderer, i);
    return status ? status : gn_prepare(renderer);
}

/* Screen tiles alone read the format. */
static gn_status screen_tiles(void *renderer, gn_format format, gn_flush_fn flush, void *user)
{
    gn_renderer *r = renderer;
    gn_status status = GN_OK;
    r->frame.picture.format = format;
    for (uint32_t i = 0; !status && i < gn_screen_tile_count(r); i++)
        status = gn_screen_tile(&r->frame, &r->scratch, i, flush, user);
    return status;
}

static gn_status render_changes(void *renderer, const gn_scene *now, void *panel, gn_flush_fn flush, void *user)
{
    return gn_render_changes(renderer, now, panel, flush, user, NULL);
}

static gn_status changed_tiles(void *renderer, void *panel, gn_flush_fn flush, void *user)
{
    gn_renderer *r = renderer;
    gn_status status = GN_OK;
    for (uint32_t i = 0; !status && i < gn_screen_tile_count(r); i++)
        status = gn_screen_tile_if_changed(&r->frame, &r->scratch, i, panel, flush, user, NULL);
    return status;
}

static void forget_shadows(void *renderer)
{
    gn_forget_shadows(renderer);
}

static const gn_stats *get_stats(const void *renderer)
{
    return gn_get_stats(renderer);
}

static const gn_detail *get_detail(const void *renderer)
{
    return gn_get_detail(renderer);
}

static gn_shadow_state get_light_shadow(const void *renderer, uint32_t light_idx, uint32_t *n_tiles,
                                        uint32_t *tile_texels)
{
    return gn_get_light_shadow(renderer, light_idx, n_tiles, tile_texels);
}

static uint32_t get_shadow_tile(const void *renderer, uint32_t light_idx, uint32_t view_idx, gn_tile_info *info)
{
    return gn_get_shadow_tile(renderer, light_idx, view_idx, info);
}

/* The initialiser of a library; the including file has a get_demand of its own. */
#define LIBRARY_CALLS                                                                                                  \
    {                                                                                                                  \
        sizeof(gn_renderer), sizeof(gn_panel), begin, render, prepare, screen_tiles, render_changes, changed_tiles,    \
            forget_shadows, get_stats, get_detail, get_light_shadow, get_shadow_tile, get_demand                       \
    }

#endif
