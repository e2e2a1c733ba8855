/* Triangles that alpha cuts: clip and dither (MODEL 6, 8), as the camera or a light sees them, along the
 * rows that are walked. */
#ifndef GN_ALPHA_H
#define GN_ALPHA_H

#include "geometry/gn_texture.h"
#include "gnomon.h"

/* A triangle of an object. If it has a texture, cut->textured, gn_alpha_plane comes next. */
void gn_alpha_begin(gn_alpha_cut *cut, const gn_object *object, gn_alpha mode, const uint16_t idx[3]);

/* Its corners, as gn_plane_setup takes them, in a picture `width` pixels wide. */
void gn_alpha_plane(gn_alpha_cut *cut, const gn_frame *frame, int32_t (*v)[3], uint32_t focal2_px_q16, int32_t width,
                    int32_t newton_steps);

/* Row y, seen along the ray py, of which the triangle covers x_begin <= x < x_end, inside the screen tile or not. */
GN_HOT static inline void gn_alpha_row(gn_alpha_cut *cut, int32_t y, int32_t py, int32_t x_begin, int32_t x_end)
{
    cut->y = y;
    cut->py = py;
#if GN_TEXTURES
    cut->x_begin = x_begin;
    cut->x_end = x_end;
    cut->steps.end = x_begin; /* none yet */
    cut->steps.bent = INT32_MIN;
    cut->exact.x = x_end; /* nor this: never the first column of a row */
#else
    (void)x_begin, (void)x_end;
#endif
}

/* Of pixels x .. x + 31 of the row those of `asked` that are not cut: the lowest bit is pixel x, and all that are asked
 * are of x_begin .. x_end - 1. (x, y) picks the noise of the dither. */
uint32_t gn_alpha_keeps(gn_alpha_cut *cut, int32_t x, uint32_t asked);

/* ---- Textured ones: gn_alpha_coords.c ---------------------------------------------------------------------------- */

/* Texture coordinates of the triangle's corners. */
void gn_alpha_corners(gn_alpha_cut *cut, const uint16_t idx[3]);

/* Texture coordinates from pixel x >= 0 of the row on. Returns for how many pixels: with persp_step > 1 they are
 * interpolated between exact ones, up to 32 pixels apart; error below 2^-8 texel (NUMERICS 4.9). */
int32_t gn_alpha_coords(gn_alpha_cut *cut, int32_t x, gn_texture_curve *curve);

#endif
