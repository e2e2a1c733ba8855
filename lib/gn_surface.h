/* A visible triangle as a surface: everything that shading interpolates over it (R4). */
#ifndef GN_SURFACE_H
#define GN_SURFACE_H

#include "gn_math.h"
#include "gn_plane.h"
#include "gnomon.h"

/* Values sampled at a pixel and stepped linearly between samples. */
enum {
    GN_VALUE_Z,         /* view depth, Q16 */
    GN_VALUE_FADE,      /* D6 factor of the cascade, Q16 */
    GN_VALUE_RGB,       /* 3: interpolated vertex colour, Q16 */
    GN_VALUE_LIGHT = 5, /* per light: n . L in Q24, tile coordinates U, V, D in Q16 texels, and those of the next cascade */
    GN_VALUES_PER_LIGHT = GN_BLENDED_CASCADES ? 7 : 4,
    GN_VALUE_COUNT = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * GN_MAX_LIGHTS
};

#define GN_CASCADE_NONE 4

typedef struct {
    int32_t value[GN_VALUE_COUNT];
    int32_t normal_q15[3]; /* interpolated, not renormalised; lit smooth surfaces only */
    int32_t cascade;       /* of the surface point, GN_CASCADE_NONE: lit by every light */
    int32_t x, y;          /* the pixel */
} gn_sample;

typedef struct {
    const gn_object *object;
    gn_plane plane;
    gn_bfloat depth_scale; /* det * 2F: Z = depth_scale / (n . ray) */
    int32_t z_min_q16, z_max_q16;
    int32_t bary[2][3]; /* b1, b2 = (bary . ray) / (n . ray) * 2^bary_exp */
    int32_t bary_exp[2];
    int32_t normal_q30[3][3]; /* vertex 0, then differences of vertices 1 and 2 to it; flat: the face normal and zeros */
    int32_t rgb_q16[3][3];    /* likewise for vertex colours */
    uint8_t has_bary, smooth, coloured;
    uint8_t shadowed; /* some light's shadow may fall on it */
    int32_t n_values;
    /* albedo times ambient (Q20) and times each light's colour (Q16): radiance is their sum, weighted */
    uint32_t base_q20[3];
    uint32_t light_uq16[GN_MAX_LIGHTS][3];
    /* where the normal is constant: n . L per light, and the receiver's offset in texels */
    int32_t flat_cosine_q24[GN_MAX_LIGHTS];
    int32_t flat_offset_q16[GN_MAX_LIGHTS][3];
} gn_surface;

/* Keeps what neighbouring triangles of a screen tile share: the current object's transforms. */
typedef struct {
    const gn_object *object;
    gn_xform to_view;
    int32_t normal_matrix[3][3];
} gn_surface_cache;

void gn_surface_begin(const gn_frame *frame, gn_scratch *scratch, gn_surface_cache *cache, gn_surface *surface, const gn_tri *tri);

/* 1: one radiance all over, no need to sample it. */
static inline int gn_surface_is_constant(const gn_surface *surface)
{
    return !surface->smooth && !surface->coloured && !surface->shadowed;
}

/* Everything at the centre of pixel (x, y), exactly (R4): the perspective divide happens here. */
void gn_surface_sample(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, gn_sample *sample);

/* The cascade of the surface point at a pixel's centre, GN_CASCADE_NONE: none. */
uint32_t gn_surface_cascade(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y);

/* Interpolated normal, not renormalised, Q1.30, towards the viewer's side; at the pixel's centre. */
void gn_surface_normal(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, int32_t normal_q30[3]);

#endif
