/* Lights, cascades, and per-object state: boxes and light lists. */
#ifndef GN_LIGHT_TYPES_H
#define GN_LIGHT_TYPES_H

#include "geometry/gn_geometry_types.h"

/* Per-object state, computed before its triangles. */
typedef struct {
    int32_t centre_q16[3], half_q16[3]; /* its box in the world */
#if GN_VERTEX_JOINTS
    int32_t posed; /* the word of frame->records where its skin's vertices begin; those below 0 have no room */
#endif
#if GN_PUNCTUAL_LIGHTS
    uint8_t n_lights; /* of light[]; GN_OBJECT_LIGHTS_ALL: every light that is on, no list is kept */
    uint8_t light[GN_OBJECT_LIGHTS_MAX];
#endif
} gn_object_state;
#define GN_OBJECT_LIGHTS_ALL 255U

#define GN_POSED_NOWHERE (-(1 << 30))

/* The bounding sphere of a cascade's slice: on the view axis, shared by all lights. */
typedef struct {
    int32_t centre_q16;   /* view depth */
    uint64_t radius2_q32; /* 0: empty */
    uint64_t inner2_q32;  /* within this distance the fade factor is 1 */
    gn_bfloat fade_scale; /* fade: factor = (radius2 - dist2) * fade_scale */
    int32_t next;         /* the next cascade that is not empty */
} gn_cascade_state;

typedef struct {
    int32_t to_light_q30[3]; /* unit; directional: surface towards the light, spot: against its axis */
    uint32_t colour_uq16[3];
    uint32_t strength_uq16;
    int8_t mask_channel;
    uint8_t kind;         /* gn_light_kind */
    uint8_t off;          /* baked: contributes nothing at run time */
    uint8_t shadow_state; /* gn_shadow_state */
    uint8_t n_views;      /* cascades, 1, or 6 faces */
    uint8_t auto_bias;    /* GN_AUTO_BIAS_DEPTH or _NORMAL, 0: none */
    int16_t view_idx;     /* of its first gn_light_view, -1: no shadow */
#if GN_PUNCTUAL_LIGHTS
    int32_t position_q16[3];
    int32_t eye_q16[3];         /* its position in view space */
    gn_ray_plane from_light[3]; /* surface point minus light, world axes and units */
    int32_t ray_shift;
    uint64_t range2_q32;   /* all ones: unlimited */
    gn_bfloat inv_range2;  /* of range2 in Q32 */
    int32_t colour_exp;    /* the exponent after normalising the colour, see gn_punctual.c */
    int32_t cos_outer_q30; /* spot lights only */
    gn_bfloat angle_scale; /* 1 / (cos inner - cos outer) */
#endif
} gn_light_state;

#endif
