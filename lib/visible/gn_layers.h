/* Transparent surfaces of a screen tile, the nearest few of each pixel (transparent_layers). Cells as those of what is
 * opaque: the larger one is nearer. */
#ifndef GN_LAYERS_H
#define GN_LAYERS_H

#include "gnomon.h"
#include "geometry/gn_geometry_types.h"
#include "visible/gn_raster.h"

/* How many there may be; 0: none is built, or asked for. */
#define GN_LAYERS(frame) (GN_LAYERS_MAX ? GN_K(frame, transparent_layers) : 0)

/* Begins a tile: it has none yet. */
void gn_layers_clear(gn_scratch *scratch);

/* Clears the layers before a tile's first transparent triangle. */
void gn_layers_use(const gn_frame *frame, gn_scratch *scratch);

/* Puts a transparent pixel between the others of n_layers: `nearer` would be in the tile's `cell` if it were opaque. */
void gn_layers_put(gn_scratch *scratch, int32_t n_layers, const uint32_t *cell, uint32_t nearer);

/* Drops what lies behind opaque surfaces, once all are known. */
void gn_layers_drop_hidden(const gn_frame *frame, gn_scratch *scratch, int32_t n_rows);

/* How many layers have pixels. */
int32_t gn_layers_count(const gn_scratch *scratch);

/* Puts a layer in place of the cells, and returns its memory, which then is for its pixels. */
gn_tile_pixels *gn_layers_take(const gn_frame *frame, gn_scratch *scratch, int32_t layer, int32_t n_rows);

/* The nearest one's cell, 0: none. */
uint32_t gn_layers_nearest(const gn_scratch *scratch, int32_t at);

#endif
