/* The library in general arithmetic. */
#include "library_calls.h"
#include "../../record/uses.h"
#include "shadow/gn_views.h"

/* Texels up to the end of each atlas's last tile. Views that nothing is seen in have an empty one; unused cascades
 * none, but with tiles by worth the library reserves it. */
static void demand_texels(const gn_frame *frame, settings_demand *out)
{
    size_t reserved[2] = {0, 0};
    int empty[2] = {0, 0};
    for (uint32_t i = 0; GN_BY_WORTH(frame) && i < frame->n_views; i++) {
        const size_t side = frame->seen[i].side;
        reserved[frame->view[i].in_other] += side * side;
        empty[frame->view[i].in_other] |= !side;
    }
    out->atlas_texels = reserved[0] + (empty[0] ? 64 : 0);
    out->other_atlas_texels = reserved[1] + (empty[1] ? 64 : 0);
    for (uint32_t i = 0; i < frame->n_views; i++) {
        const gn_light_view *view = &frame->view[i];
        const bool unused = !view->in_other && frame->n_cascades > 1 &&
                            (frame->scene->shadow.cascades_unused >> view->cascade_idx & 1) != 0;
        const size_t side = view->unseen ? 8 : frame->seen[i].side, end = view->first_texel + side * side;
        size_t *texels = view->in_other ? &out->other_atlas_texels : &out->atlas_texels;
        if (!unused && end > *texels) *texels = end;
    }
}

static void get_demand(const void *renderer, settings_demand *out)
{
    const gn_frame *frame = &((const gn_renderer *)renderer)->frame;
    *out = (settings_demand){.width = frame->picture.width, .height = frame->picture.height};
    out->objects = frame->scene->n_objects;
    out->lights = frame->scene->n_lights;
    out->surface_lights = uses_surface_lights(frame);
    const bool groups = frame->knobs.triangle_groups > 0;
    out->triangles = groups ? frame->stats.n_tile_triangles : frame->stats.n_triangles;
    out->tile_refs = groups ? 0 : frame->stats.n_tile_refs;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        uint32_t n = 0;
        if (gn_get_light_shadow(renderer, l, &n, NULL) != GN_SHADOW_REALTIME) continue;
        const bool in_other = frame->view[frame->light[l].view_idx].in_other;
        *(in_other ? &out->other_tiles : &out->shadow_tiles) += n;
    }
    demand_texels(frame, out);
}

const library library_general = LIBRARY_CALLS;

const library *library_of(const settings *set)
{
    return set->build.compact ? &library_compact : &library_general;
}
