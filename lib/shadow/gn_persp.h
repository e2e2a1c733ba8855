/* Perspective light views of spot and point lights, and casters as they see them (MODEL 5, 6). */
#ifndef GN_PERSP_H
#define GN_PERSP_H

#include "shadow/gn_caster.h"
#include "gnomon.h"

/* Fits a view, whose axes, tile and filter are known, to its light. */
void gn_persp_fit_view(gn_frame *frame, gn_light_view *view, const gn_light *light);

/* Half-width of a cube's face, t = tan(fov / 2), Q24, between 1 and 2; *clamped: 2 was not enough. nu:
 * gn_bias_reach_q16. */
int64_t gn_persp_face_q24(int32_t filter_idx, int32_t nu_q16, int32_t tile_texels, int *clamped);

/* The cube's face that a point lies in, from the point's position relative to the light. */
int32_t gn_persp_face(const int32_t from_light_q16[3]);

/* Where a view sees a point: texels, Q16, what is 1 - n / z of it, and its light-plane distance, saturated. */
typedef struct {
    int32_t u_q16, v_q16;
    uint32_t depth_q32;
    int32_t far_q16;
} gn_persp_place;

/* Of a point from the light, world axes, and its depth less that much. Returns 0 if it is not beyond the near plane. */
int gn_persp_find_place(const gn_frame *frame, const gn_light_view *view, const int32_t from_q16[3], int64_t less_q32,
                        gn_persp_place *out);

/* Axis of travel of a face, Q1.30. */
void gn_persp_face_axis(int32_t out_q30[3], int32_t face);

/* Draws a triangle, corners in the view's axes from the light, |.| < 2^30. Returns the number of texels it covers,
 * -1 if it is culled. */
int32_t gn_persp_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting, gn_alpha_cut *alpha);

/* Tells where the view sees a corner whose coordinates are known. */
void gn_persp_corner(const gn_frame *frame, const gn_light_view *view, gn_caster_corner *c);

/* The same of such corners, of casters that alpha does not cut. */
int32_t gn_persp_small_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting,
                                const gn_caster_corner *const c[3]);

#endif
