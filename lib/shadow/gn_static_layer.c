/* The static layer: depths of casters that stand still, kept from frame to frame. A tile with moving casters begins
 * as a copy of it, so that only these are drawn anew. */
#include "gn_internal.h"

#include "shadow/gn_atlas.h"
#include "shadow/gn_texel.h"

/* The view's tile of the static layer. [A5] */
gn_texels gn_static_layer_texels(gn_frame *frame, const gn_light_view *view)
{
    gn_texels texels = GN_TEXELS_OF(frame->static_atlas, view->depth_bits);
#if GN_OTHER_ATLAS
    if (view->in_other) texels = GN_TEXELS_OF(frame->static_other_atlas, view->depth_bits);
#endif
    return gn_texels_at(texels, view->depth_bits, view->first_texel);
}

void gn_static_layer_copy(const gn_light_view *to, gn_texels from)
{
    size_t n = (size_t)to->tile_texels * GN_TILE_ROWS(to);
    int32_t bits = GN_VIEW_BITS(to);
    if (bits == 8)
        for (size_t i = 0; i < n; i++) to->depth.d8[i] = from.d8[i];
    else if (bits == 16)
        for (size_t i = 0; i < n; i++) to->depth.d16[i] = from.d16[i];
    else
        for (size_t i = 0; i < n; i++) to->depth.d32[i] = from.d32[i];
}
