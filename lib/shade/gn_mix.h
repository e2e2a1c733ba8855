/* Pixels of transparent surfaces, mixed with what is behind them. */
#ifndef GN_MIX_H
#define GN_MIX_H

#include "gnomon.h"
#include "visible/gn_layers.h"

/* Whether a layer is being shaded: its pixels are not those of the tile yet. */
#define GN_MIXES(s) (GN_LAYERS((s)->frame) && (s)->rows.pixels != &(s)->scratch->pixel)

/* Begins a tile. */
void gn_mix_begin(gn_shading *s);

/* Mixes pixels of the triangle at hand, shaded into the layer, into those of the tile. MODEL 2. */
void gn_mix_run(gn_shading *s, int32_t x, int32_t y, int32_t n);

#endif
