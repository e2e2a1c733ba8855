/* Pixels that are corners of their own: cells of one pixel. */
#ifndef GN_CORNER_PIXEL_H
#define GN_CORNER_PIXEL_H

#include "gnomon.h"

#if GN_INTERPOLATES

/* Shades a pixel of the surface at hand, after gn_corner_begin(). */
void gn_corner_pixel(gn_shading *shading, int32_t x, int32_t y);

#endif

#endif
