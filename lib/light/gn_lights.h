/* Light states, cascades, and which object each light affects. */
#ifndef GN_LIGHTS_H
#define GN_LIGHTS_H

#include "base/gn_base_types.h"
#include "gnomon.h"

/* ---- Light states, and which object each light affects ----------------------------------------------------------- */

/* Fills frame->light, except its shadows, and frame->object. GN_ERR_SURFACE_LIGHTS if more than GN_SURFACE_LIGHTS
 * lights affect one object. */
gn_status gn_lights_setup(gn_frame *frame);

/* Whether the object's box is within the light's range; directional lights: always. */
int gn_light_reaches(const gn_frame *frame, uint32_t light_idx, uint32_t object_idx);

/* ---- Per-object state: its box in the world, and its light list -------------------------------------------------- */

/* Fills frame->object's boxes. Needs only the scene. */
gn_status gn_object_boxes(gn_frame *frame);

/* Square of the distance from a point to the nearest point of the object's box, Q32. */
uint64_t gn_object_distance2_q32(const gn_object_state *object, const int32_t p_q16[3]);

/* Lists the spot and point lights that affect the object, and returns their number. Boxes and frame->light must be set
 * up. */
uint32_t gn_object_list_lights(gn_frame *frame, uint32_t object_idx);

/* ---- Cascades: slices of the frustum, their bounding spheres, and how shadows end with distance (MODEL 4) -------- */

/* A single cascade is never unused, so that builds with and without many cascades agree. */
#define GN_CASCADE_UNUSED(frame, i)                                                                                    \
    (GN_MANY_CASCADES && (frame)->n_cascades > 1 && ((frame)->scene->shadow.cascades_unused >> (i)&1U) != 0)

/* Fills frame->cascade and the distance fade. */
void gn_cascade_setup(gn_frame *frame);

/* Slice i of the frustum: from the camera's near plane or the previous slice's end. */
void gn_cascade_slice(const gn_frame *frame, uint32_t i, int32_t *near_q16, int32_t *far_q16);

/* Bounding sphere of a slice of the frustum, as fractions of its far end: depth of the centre and radius, Q8.24. */
void gn_cascade_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, int64_t *centre_q24,
                       int64_t *radius_q24);

/* The same in world units: returns the view depth of the centre, Q16. */
int32_t gn_cascade_fit_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, gn_bfloat *radius);

/* Square of the half-diagonal's tangent, Q24, at most 2^14. */
int64_t gn_cascade_tan2_q24(const gn_frame *frame);

/* ---- Spot and point lights --------------------------------------------------------------------------------------- */

/* Attenuation with distance and angle (MODEL 8). */

/* Fills the spot and point light fields of frame->light[light_idx]; frame->cam must be set up. */
void gn_punctual_setup(gn_frame *frame, uint32_t light_idx);

/* Largest colour channel times the distance factor of MODEL 8, at distance^2 (Q32, no less than min2_q32): by this an
 * object's lights are ranked. */
gn_bfloat gn_punctual_weight(const gn_light_state *light, uint64_t distance2_q32, uint64_t min2_q32);

/* One Newton step of the reciprocal square root leaves an error of 2^-15 in a cosine: too much for a spot whose edge,
 * cos(inner / 2) - cos(outer / 2), is narrower than 2^-6. Such a spot gets two steps: gn_light_state's angle_scale is
 * the reciprocal of that edge in Q30, and has this exponent or a larger one. */
#define GN_NARROW_EXP (-55)

/* A surface point in a light's range and cone. */
typedef struct {
    int32_t factor_q30;  /* window^2 * angle^2: the fade towards the range, and from the inner to the outer cone */
    int32_t root_q31;    /* 1 / distance: a length in Q16 times 2^half, times this / 2^31, is its share of it, Q30 */
    int32_t half;        /* -1 .. 30 */
    int32_t inverse_q31; /* 1 / max(distance^2, 10^-4), and */
    int32_t down; /* the bits that irradiance goes down by: with the light's colour, colour_uq16 * 2^colour_exp */
    int32_t within_inner; /* 1: inside a spot's inner cone, where its angle has no effect */
    int32_t beyond_q30;   /* of spots, also where nothing arrives: the cosine less that of the cone's edge, -2^30 behind
                             the light; INT32_MAX out of range */
} gn_punctual_point;

/* The square of the distance, of components below 2^31 in magnitude. */
GN_HOT static inline uint64_t gn_distance2_q32(const int32_t from_q16[3])
{
    return (uint64_t)((int64_t)from_q16[0] * from_q16[0]) + (uint64_t)((int64_t)from_q16[1] * from_q16[1]) +
           (uint64_t)((int64_t)from_q16[2] * from_q16[2]);
}

/* (1 - (d^2 / r^2)^2)^2: the share that the window of a light's range leaves at d < r. */
int32_t gn_punctual_window_q30(const gn_light_state *light, uint64_t d2_q32);

#if GN_PUNCTUAL_LIGHTS
/* A difference of cosines at a spot's rim, as a share of the rim's, Q30: below 2^48. */
GN_HOT static inline uint64_t gn_punctual_rim_q30(const gn_light_state *light, uint32_t cosine_q30)
{
    return (uint64_t)gn_umul_high(cosine_q30, light->angle_scale.mant) << (62 + light->angle_scale.exp);
}
#endif

/* Fills `out` for a surface point; `from_light` is the point minus the light's position, world axes, Q16. Returns 0
 * where no light arrives: of `out` only the last two are then defined. */
int gn_punctual_at(const gn_frame *frame, const gn_light_state *light, const int32_t from_light_q16[3],
                   gn_punctual_point *out);

/* length / distance to the light, Q30, of lengths up to it: a cosine, if the length is the projection of the ray from
 * the light on a unit vector. */
int32_t gn_punctual_cosine_q30(const gn_punctual_point *point, int32_t length_q16);

/* factor * cosine / max(d^2, min) * 2^colour_exp: irradiance of a light whose colour is 1, Q24, saturated below 128. */
int32_t gn_punctual_irradiance_q24(const gn_punctual_point *point, int32_t cosine_q30);

/* ---- Receiver bias (MODEL 7) ------------------------------------------------------------------------------------- */

#define GN_DISK_INDEX_MAX 8 /* largest filter index of the disk */
#define GN_SQRT2_Q16      92682

/* nu of MODEL 4: how far a light's receiver bias can move a point across the light's axis, in texels per (k + 1),
 * Q16. Uses only the view's texels per row and depth bits. */
int32_t gn_bias_reach_q16(const gn_frame *frame, const gn_light_view *view, const gn_light *light);

/* A directional light's receiver offset, for the interpolated normal, not normalised: in texels along the view's axes,
 * Q16; equal in all cascades of equal filter index. */
void gn_bias_directional(const gn_frame *frame, const gn_light_view *view, const int32_t n_q30[3], int32_t out_q16[3]);

/* The same for spot and point lights: along the world's axes, in world units, Q16. `from_q16` is the surface point
 * minus the light. */
void gn_bias_punctual(const gn_frame *frame, const gn_light_state *light, const int32_t n_q30[3],
                      const int32_t from_q16[3], int32_t out_q16[3]);

/* ---- Automatic bias (MODEL 7) ---------------------------------- */

/* Position error: half a step of caster coordinates, half a step of filter weights, two roundings; texels, Q16. */
GN_HOT static inline int32_t gn_bias_auto_delta_q16(const gn_frame *frame)
{
    (void)frame;
    return (1 << (15 - GN_CASTER_BITS(frame))) + (1 << (15 - GN_FILTER_BITS(frame))) + 2;
}

/* Once per view, after its fit and filter. */
void gn_bias_auto_view(const gn_frame *frame, gn_light_view *view);

/* gn_bias_reach_q16 of automatic bias: the depth form moves nothing across. Normal: sqrt2 * (1 + delta) covers
 * sqrt2 * (R + delta) of every filter; T * 2^-bits is the part of depth steps along the normal. */
int32_t gn_bias_auto_reach_q16(const gn_frame *frame, const gn_light_view *view, gn_auto_bias form);

#define GN_AUTO_UNITS 8 /* roundings of a point and of its triangle's corners, Q16 */

/* Position error of a spot or point light's receiver, world units, Q16. */
int64_t gn_bias_auto_place_q16(const gn_light_view *view, int32_t depth_q16);

/* A plane's normal along three axes, of any length, becomes its slopes: n[0], n[1] what the third coordinate changes by
 * over the first and the second, Q12, to 2^-17 of them and 2^-12, within +-2^30. */
void gn_bias_slopes(int32_t n[3]);

/* Once per triangle and directional light: the input of gn_bias_auto_ortho. face_q30: the face's normal in the world,
 * towards the viewer. Normal: its parts along the light's axes, Q30; depth: dD/dU, dD/dV, Q12, to 2^-17 of them and
 * 2^-12, within +-2^30. */
void gn_bias_auto_face(const gn_light_view *view, gn_auto_bias form, const int32_t face_q30[3], int32_t out[3]);

/* The receiver's offset, in texels along the view's axes, Q16. */
void gn_bias_auto_ortho(const gn_light_view *view, gn_auto_bias form, const int32_t face[3], int32_t out_q16[3]);

/* What a plane needs in a spot or point light's view. */
typedef struct {
    gn_auto_bias form;
    int32_t reach_q16, step_q32; /* how far taps are, texels; how far depths are off, as a share of the range */
    int64_t share_q30; /* normal: of its light-plane distance, a point moves along the plane's normal; else -1 */
    int64_t less_q32;  /* what is subtracted from its depth */
} gn_auto_plane;

/* Of a plane through `from_q16`, a point minus the light; form, reach and step are set. Where the normal form would
 * move a point by more than twice its depth, form becomes the depth form. */
void gn_bias_auto_plane(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                        gn_auto_plane *plane);

/* A point of a spot or point light's view, `from_q16` the light and seen at view depth `depth_q16`: moves it, and
 * returns how much to subtract from the moved point's depth in the map, Q32. Where the normal form would move the point
 * by more than twice its depth, *form becomes the depth form. */
int64_t gn_bias_auto_persp(const gn_light_view *view, gn_auto_bias *form, const int32_t face_q30[3], int32_t depth_q16,
                           const int32_t from_q16[3], int32_t moved_q16[3]);

#endif
