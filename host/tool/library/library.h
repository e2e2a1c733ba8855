/* The library in general or in compact arithmetic, behind one interface: two builds of lib/ in this program, the second
 * with a prefix. */
#ifndef GNOMON_LIBRARY_H
#define GNOMON_LIBRARY_H

#include "../settings/settings.h"

/* A renderer is memory of renderer_bytes, a panel of panel_bytes that are 0 at first. Each but begin is the call of
 * gnomon.h that has this name. */
typedef struct {
    size_t renderer_bytes, panel_bytes;
    gn_status (*begin)(void *renderer, const gn_picture *picture,
                       const settings *set); /* gn_init, the knobs, and the atlases' texels */
    gn_status (*render)(void *renderer, const gn_scene *now, gn_flush_fn flush, void *user);
    gn_status (*prepare)(void *renderer, const gn_scene *now); /* all stages before the screen tiles */
    gn_status (*screen_tiles)(void *renderer, gn_format format, gn_flush_fn flush, void *user);
    gn_status (*render_changes)(void *renderer, const gn_scene *now, void *panel, gn_flush_fn flush, void *user);
    /* what is left to do of that after prepare, one tile after the other; of a scene that is the one before, that
     * would not have prepared either */
    gn_status (*changed_tiles)(void *renderer, void *panel, gn_flush_fn flush, void *user);
    void (*forget_shadows)(void *renderer);
    const gn_stats *(*get_stats)(const void *renderer);
    const gn_detail *(*get_detail)(const void *renderer);
    gn_shadow_state (*get_light_shadow)(const void *renderer, uint32_t light_idx, uint32_t *n_tiles,
                                        uint32_t *tile_texels);
    uint32_t (*get_shadow_tile)(const void *renderer, uint32_t light_idx, uint32_t view_idx, gn_tile_info *info);
    void (*get_demand)(const void *renderer, settings_demand *out); /* what the frame that was drawn last took */
} library;

extern const library library_general, library_compact;

/* The one that draws with these settings. */
const library *library_of(const settings *set);

#endif
