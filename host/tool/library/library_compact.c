/* The library in compact arithmetic: all of lib/ once more, as one file, with a prefix. */
#undef GN_SEPARATE_FILES
#undef GN_INCREMENTAL
#undef GN_MANY_CASCADES
#undef GN_MAX_WIDTH
#undef GN_MAX_HEIGHT
#undef GN_MAX_LIGHTS
#undef GN_MAX_SHADOW_TILES
#undef GN_ATLAS_SIZE
#undef GN_PICTURES
#undef GN_COUNTERS
#define GN_PREFIX     compact_
#define GN_COMPACT    1
#define GN_MAX_HEIGHT 256
#define GN_ATLAS_SIZE 256
#define GN_PICTURES   8
#include "gnomon.c"
#include "library_calls.h"

/* Screen tiles have no references to triangles, and the one shadow tile is the whole atlas. */
static void get_demand(const void *renderer, settings_demand *out)
{
    const gn_frame *frame = &((const gn_renderer *)renderer)->frame;
    const size_t side = (size_t)frame->knobs.atlas_size;
    *out = (settings_demand){.width = frame->picture.width,
                             .height = frame->picture.height,
                             .objects = frame->scene->n_objects,
                             .lights = frame->scene->n_lights,
                             .surface_lights = frame->scene->n_lights,
                             .triangles = frame->stats.n_triangles,
                             .shadow_tiles = frame->n_views,
                             .atlas_texels = frame->n_views * side * side};
}

const library library_compact = LIBRARY_CALLS;
