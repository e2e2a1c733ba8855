/* A surface at a pixel's centre: everything that shading interpolates (R4). */
#ifndef GN_SAMPLE_H
#define GN_SAMPLE_H

#include "gn_surface.h"

/* Values sampled at a pixel and stepped linearly between samples. The first groups only where a surface has them. */
enum {
    GN_VALUE_UV = 0,                                        /* 2: texture coordinates, Q16 */
    GN_VALUE_MASK = GN_VALUE_UV + (GN_TEXTURES ? 2 : 0),    /* 4: shadow masks, Q16; or 2: coordinates of the mask image */
    GN_VALUE_BAKED = GN_VALUE_MASK + (GN_MASKS ? 4 : 0),    /* 3: irradiance, Q16 */
    GN_VALUE_Z = GN_VALUE_BAKED + (GN_BAKED_LIGHT ? 3 : 0), /* view depth, Q16 */
    GN_VALUE_FADE,                                          /* D6 factor of the cascade, Q16 */
    GN_VALUE_RGB,                                           /* 3: interpolated vertex colour, Q16 */
    GN_VALUE_LIGHT = GN_VALUE_RGB + 3,                      /* the lights of the surface's list */
    GN_VALUES_PER_LIGHT = (GN_SHADOWS && GN_BLENDED_CASCADES) || GN_PUNCTUAL_LIGHTS ? 7
                          : GN_SHADOWS                                              ? 4
                                                                                    : 1,
    GN_VALUE_COUNT = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * GN_SURFACE_LIGHTS
};

/* Values of a light. Directional: n . L in Q24, tile coordinates U, V, D in Q16 texels, and those of the next cascade. Spot and point:
 * n . (light - point), the point from the light, and the receiver's offset, all in world axes and Q16 units. */
enum { GN_LIGHT_FACING, GN_LIGHT_POINT_AT, GN_LIGHT_OFFSET = 4 };

#define GN_CASCADE_NONE 4

typedef struct {
    int32_t value[GN_VALUE_COUNT];
    int32_t normal_q15[3]; /* interpolated, not renormalised; lit smooth surfaces only */
    int32_t cascade;       /* of the surface point, GN_CASCADE_NONE: none */
    int32_t in_reach;      /* D11: near enough to the camera for shadows */
    int32_t x, y;          /* the pixel */
#if GN_SPECULAR
    int32_t normal_q30[3], to_eye_q30[3]; /* unit; surfaces with highlights only */
#endif
} gn_sample;

/* Everything at the centre of pixel (x, y), exactly (R4): the perspective divide happens here. */
void gn_sample_at(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, gn_sample *sample);

/* The cascade of the surface point at a pixel's centre, GN_CASCADE_NONE: none. */
uint32_t gn_sample_cascade(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y);

/* Interpolated normal, not renormalised, Q1.30, towards the viewer's side; at the pixel's centre. */
void gn_sample_normal(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, int32_t normal_q30[3]);

#endif
