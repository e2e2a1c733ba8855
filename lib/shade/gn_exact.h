/* Pixels, each for itself: the exact end of shading. */
#ifndef GN_EXACT_H
#define GN_EXACT_H

#include "shade/gn_sample.h"

/* Shades pixel (x, y) of the surface at hand. */
void gn_exact_pixel(gn_shading *s, int32_t x, int32_t y);

/* A colour in the picture's format; the last one is remembered. */
uint32_t gn_exact_pack(gn_shading *s, const uint32_t linear_q20[3]);

#endif
