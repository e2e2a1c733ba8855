/* Receiver bias (MODEL 7). */
#ifndef GN_BIAS_H
#define GN_BIAS_H

#include "base/gn_hint.h"
#include "gnomon.h"

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

/* ---- Automatic bias (MODEL 7): gn_auto_bias.c, and of views gn_auto_bias_view.c ---------------------------------- */

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

/* Once per triangle and directional light: the input of gn_bias_auto_ortho. face_q30: the face's normal in the world,
 * towards the viewer. Normal: its parts along the light's axes, Q30; depth: |dD/dU|, |dD/dV|, Q10. */
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
