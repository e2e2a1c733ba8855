/* Parts of gn_facet: texture coordinates of small triangles (NUMERICS 4.17). */
#ifndef GN_FACET_TEXTURE_H
#define GN_FACET_TEXTURE_H

#include "shade/gn_facet_screen.h"

#if GN_INTERPOLATES && GN_TEXTURES

/* Rows will be up to `width` pixels long. Returns 0 if the triangle is to be textured by cells. */
int gn_facet_texture_begin(gn_facet_texture *out, const gn_frame *frame, gn_surface *surface, gn_facet_screen *screen,
                           int32_t width);

/* Colours of n <= 16 pixels of a row, from a pixel of the box on. */
void gn_facet_texture_row(const gn_facet_texture *t, int32_t right, int32_t down, int32_t n, gn_texel_rgb *out);

#endif

#endif
