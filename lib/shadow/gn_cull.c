/* Which casters are drawn into a tile. */
#include "gn_internal.h"

#include "shadow/gn_atlas.h"

/* Whether the object casts at all, and in this layer. [M1] */
static int in_layer(uint32_t flags, gn_layer layer)
{
    if (!(flags & GN_OBJECT_CASTS)) return 0;
    int moving = (flags & GN_OBJECT_MOVING) != 0;
    return layer == GN_LAYER_ALL || moving == (layer == GN_LAYER_MOVING);
}

/* Culls by layer, by box, and by smaller cascades. [D8] */
GN_COLD int gn_cull_draws(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx, gn_layer layer,
                          int *culled)
{
    *culled = 0;
    if (!in_layer(frame->flags[object_idx], layer)) return 0;
    if (GN_OBJECT_BOXES && !gn_cull_sees(frame, view, object_idx)) return 0;
    *culled = GN_CASTER_CULLING && frame->scene->shadow.caster_culling && !view->perspective && !view->border_lit &&
              view->cascade_idx > 0 && gn_cull_shown_nearer(frame, view, object_idx);
    return !*culled;
}
