/* Spot and point lights: attenuation with distance and angle (MODEL 8). */
#ifndef GN_PUNCTUAL_H
#define GN_PUNCTUAL_H

#include "gnomon.h"

/* Fills the spot and point light fields of frame->light[light_idx]; frame->cam must be set up. */
void gn_punctual_setup(gn_frame *frame, uint32_t light_idx);

/* Largest colour channel times the distance factor at distance^2: the rank of a light. */
gn_bfloat gn_punctual_weight(const gn_light_state *light, uint64_t distance2_q32, uint64_t min2_q32);

/* One Newton step leaves 2^-15 of a cosine: that is too much for a cone whose edge is narrower than 2^-6. */
#define GN_NARROW_EXP (-55) /* of its reciprocal in Q30 */

/* A surface point in a light's range and cone. */
typedef struct {
    uint32_t factor_q30; /* window^2 * angle^2 */
    uint32_t inv_root;   /* 2^47 / sqrt(d2 << shift >> 32), normalised: [2^31, 2^32) */
    int32_t shift;       /* even */
    uint32_t scale_root; /* the same for max(d2, min2) */
    int32_t scale_shift;
    int32_t colour_exp;
    int32_t within_inner; /* a spot's inner cone, where its angle has no effect */
} gn_punctual_point;

/* `from_light` is the surface point minus the light's position, world axes, Q16. Returns 0 where no light arrives. */
int gn_punctual_at(const gn_frame *frame, const gn_light_state *light, const int32_t from_light_q16[3],
                   gn_punctual_point *out);

/* Ratio of a length along the light's ray, Q16, to the distance: Q30, saturated at +-1. */
int32_t gn_punctual_cosine_q30(const gn_punctual_point *point, int32_t length_q16);

/* factor * cosine / max(d^2, min) * 2^colour_exp: irradiance of a light whose colour is 1, Q24, saturated below 128. */
uint32_t gn_punctual_irradiance_q24(const gn_punctual_point *point, int32_t cosine_q30);

/* The lights whose spheres intersect the frustum of a rectangle of pixels, a bit each; directional lights: always. */
uint64_t gn_punctual_in_tile(const gn_frame *frame, const gn_rect *rect);

#endif
