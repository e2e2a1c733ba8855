/* A visible triangle as a surface: everything that shading interpolates over it (R4). */
#ifndef GN_SURFACE_H
#define GN_SURFACE_H

#include "gn_math.h"
#include "gn_plane.h"
#include "gnomon.h"

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

typedef struct {
    const gn_object *object;
    gn_plane plane;
    gn_bfloat depth_scale; /* det * 2F: Z = depth_scale / (n . ray) */
    int32_t z_min_q16, z_max_q16;
    gn_bary bary;
    int32_t normal_q30[3][3]; /* vertex 0, then differences of vertices 1 and 2 to it; flat: the face normal and zeros */
    int32_t rgb_q16[3][3];    /* likewise for vertex colours */
#if GN_TEXTURES
    int64_t uv_q16[3][2];
#endif
#if GN_MASKS
    int32_t mask_q16[3][4];
#endif
#if GN_BAKED_LIGHT
    int32_t baked_q16[3][3];
#endif
#if GN_RECEIVER_PLANE
    int32_t face_q30[3]; /* normal of the face in the world; only where some light of the list asks for it */
#endif
    uint8_t has_bary, smooth, coloured, textured, masked, baked, specular;
    uint8_t shadowed; /* some light's shadow may fall on it */
    int32_t first_value, n_values;
    /* the lights that can reach it */
    uint32_t n_lights, n_punctual;
    uint8_t light_idx[GN_SURFACE_LIGHTS];
    /* albedo times ambient (Q20) and times each light's colour (Q16): radiance is their sum, weighted */
    uint32_t base_q20[3];
    uint32_t light_uq16[GN_SURFACE_LIGHTS][3];
    /* where the normal is constant: n . L per directional light, and the receiver's offset in texels */
    int32_t flat_cosine_q24[GN_SURFACE_LIGHTS];
    int32_t flat_offset_q16[GN_SURFACE_LIGHTS][3];
} gn_surface;

/* Keeps what neighbouring triangles of a screen tile share. */
typedef struct {
    const gn_object *object;
    gn_xform to_view; /* of the current object */
    int32_t normal_matrix[3][3];
    uint64_t lights; /* R9: a bit per light that can reach the screen tile */
} gn_surface_cache;

void gn_surface_begin(const gn_frame *frame, gn_scratch *scratch, gn_surface_cache *cache, gn_surface *surface, const gn_tri *tri);

/* 1: one radiance all over, no need to sample it. */
static inline int gn_surface_is_constant(const gn_surface *s)
{
    return !(s->smooth | s->coloured | s->shadowed | s->textured | s->masked | s->baked | s->specular) && !s->n_punctual;
}

/* Everything at the centre of pixel (x, y), exactly (R4): the perspective divide happens here. */
void gn_surface_sample(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, gn_sample *sample);

/* The cascade of the surface point at a pixel's centre, GN_CASCADE_NONE: none. */
uint32_t gn_surface_cascade(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y);

/* Interpolated normal, not renormalised, Q1.30, towards the viewer's side; at the pixel's centre. */
void gn_surface_normal(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, int32_t normal_q30[3]);

#endif
