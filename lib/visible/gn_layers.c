/* Transparent surfaces of a screen tile. */
#include "gn_internal.h"

#include <string.h>

#include "visible/gn_layers.h"

#if GN_LAYERS_MAX

GN_HOT void gn_layers_clear(gn_scratch *scratch)
{
    scratch->layers.n = 0;
}

GN_HOT void gn_layers_use(const gn_frame *frame, gn_scratch *scratch)
{
    gn_layers *layers = &scratch->layers;
    if (layers->n) return;
    layers->n = GN_LAYERS(frame);
    for (int32_t k = 0; k < layers->n; k++)
        memset(layers->layer[k].cell, 0,
               sizeof(uint32_t) * (uint32_t)(GN_K(frame, tile_width) * GN_K(frame, tile_height)));
}

GN_HOT void gn_layers_put(gn_scratch *scratch, int32_t n_layers, const uint32_t *cell, uint32_t nearer)
{
    const int32_t i = (int32_t)(cell - GN_CELLS(scratch));
    for (int32_t k = 0; k < n_layers; k++) { /* each takes the place of the next */
        uint32_t *at = &scratch->layers.layer[k].cell[i], last = *at;
        if (nearer < last) continue;
        *at = nearer;
        nearer = last;
    }
}

GN_HOT void gn_layers_drop_hidden(const gn_frame *frame, gn_scratch *scratch, int32_t n_rows)
{
    gn_layers *layers = &scratch->layers;
    const uint32_t *opaque = GN_CELLS(scratch);
    const int32_t n = layers->n, n_cells = n_rows * GN_K(frame, tile_width);
    layers->n = 0;
    for (int32_t k = 0; k < n; k++) {
        uint32_t *cell = layers->layer[k].cell, any = 0;
        for (int32_t i = 0; i < n_cells; i++) {
            if (cell[i] < opaque[i]) cell[i] = 0;
            any |= cell[i];
        }
        if (any) layers->n = k + 1;
    }
}

GN_HOT int32_t gn_layers_count(const gn_scratch *scratch)
{
    return scratch->layers.n;
}

GN_HOT gn_tile_pixels *gn_layers_take(const gn_frame *frame, gn_scratch *scratch, int32_t layer, int32_t n_rows)
{
    memcpy(GN_CELLS(scratch), scratch->layers.layer[layer].cell,
           sizeof(uint32_t) * (uint32_t)(n_rows * GN_K(frame, tile_width)));
    return &scratch->layers.layer[layer].pixels;
}

GN_HOT uint32_t gn_layers_nearest(const gn_scratch *scratch, int32_t at)
{
    return scratch->layers.n ? scratch->layers.layer[0].cell[at] : 0;
}

#endif
