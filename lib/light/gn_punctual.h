/* Spot and point lights: attenuation with distance and angle (MODEL 8). */
#ifndef GN_PUNCTUAL_H
#define GN_PUNCTUAL_H

#include "gnomon.h"

/* Fills the spot and point light fields of frame->light[light_idx]; frame->cam must be set up. */
void gn_punctual_setup(gn_frame *frame, uint32_t light_idx);

/* Largest colour channel times the distance factor of MODEL 8, at distance^2 (Q32, no less than min2_q32): by this an
 * object's lights are ranked. */
gn_bfloat gn_punctual_weight(const gn_light_state *light, uint64_t distance2_q32, uint64_t min2_q32);

/* One Newton step of the reciprocal square root leaves an error of 2^-15 in a cosine: too much for a spot whose edge,
 * cos(inner / 2) - cos(outer / 2), is narrower than 2^-6. Such a spot gets two steps: gn_light_state's angle_scale is
 * the reciprocal of that edge in Q30, and has this exponent or a larger one. */
#define GN_NARROW_EXP (-55)

/* A surface point in a light's range and cone; d2 is the square of its distance to the light, Q32. */
typedef struct {
    uint32_t factor_q30;  /* window^2 * angle^2: the fade towards the range, and from the inner to the outer cone */
    uint32_t inv_root;    /* 1 / distance: 2^47 / sqrt(d2 << shift >> 32), in [2^31, 2^32) */
    int32_t shift;        /* of inv_root; even, so that the root is a shift by half of it */
    uint32_t scale_root;  /* the same of max(d2, 10^-4), whose square attenuates */
    int32_t scale_shift;  /* of scale_root */
    int32_t colour_exp;   /* the light's colour is colour_uq16 * 2^colour_exp */
    int32_t within_inner; /* 1: inside a spot's inner cone, where its angle has no effect */
} gn_punctual_point;

/* Fills `out` for a surface point; `from_light` is the point minus the light's position, world axes, Q16. Returns 0
 * where no light arrives: `out` is then undefined. */
int gn_punctual_at(const gn_frame *frame, const gn_light_state *light, const int32_t from_light_q16[3],
                   gn_punctual_point *out);

/* length / distance to the light, Q30, saturated at +-1: a cosine, if the length is the projection of the ray from the
 * light on a unit vector. */
int32_t gn_punctual_cosine_q30(const gn_punctual_point *point, int32_t length_q16);

/* factor * cosine / max(d^2, min) * 2^colour_exp: irradiance of a light whose colour is 1, Q24, saturated below 128. */
uint32_t gn_punctual_irradiance_q24(const gn_punctual_point *point, int32_t cosine_q30);

#endif
