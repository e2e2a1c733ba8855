/* A visible triangle as a surface: what is constant or linear over it, and the lights that can reach it. */
#ifndef GN_SURFACE_H
#define GN_SURFACE_H

#include "gn_math.h"
#include "gn_plane.h"
#include "gn_texture.h"
#include "gnomon.h"

/* A light of the surface's list. */
typedef struct {
    const gn_light_state *state;
    uint32_t idx;
    uint32_t radiance_uq16[3]; /* albedo times colour */
    /* where the normal is constant, for directional lights: n . L, and the receiver's offset in texels; B6: what gn_bias_auto_face says */
    int32_t flat_cosine_q24;
    int32_t flat_offset_q16[3];
} gn_surface_light;

typedef struct {
    const gn_object *object;
    gn_plane plane;
    gn_bfloat depth_scale; /* det * 2F: Z = depth_scale / (n . ray) */
    int32_t z_min_q16, z_max_q16;
    gn_bary bary;
    int32_t normal_q30[3][3]; /* vertex 0, then differences of vertices 1 and 2 to it; flat: the face normal and zeros */
    int32_t rgb_q16[3][3];    /* likewise for vertex colours */
#if GN_TEXTURES
    gn_texture_triangle uv;
#endif
#if GN_MASKS
    int32_t mask_q16[3][4];
#endif
#if GN_BAKED_LIGHT
    int32_t baked_q16[3][3];
#endif
#if GN_RECEIVER_PLANE || GN_AUTO_BIAS
    int32_t face_q30[3]; /* normal of the face in the world; only where some light of the list asks for it */
#endif
    uint8_t has_bary, smooth, coloured, textured, masked, baked, specular;
    uint8_t shadowed; /* some light's shadow may fall on it */
    int32_t first_value, n_values;
    uint32_t base_q20[3]; /* albedo times ambient: with the lights' radiance_uq16, weighted, it sums up to the radiance */
    uint32_t n_lights, n_punctual;
    gn_surface_light light[GN_SURFACE_LIGHTS]; /* those that can reach it */
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

#endif
