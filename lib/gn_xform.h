/* Transforms of the frame: camera, object to view, object to light. */
#ifndef GN_XFORM_H
#define GN_XFORM_H

#include "gnomon.h"

/* Fills frame->cam from the scene's camera and the picture; the camera has been validated. */
void gn_cam_setup(gn_frame *frame);

/* Object space to axes (rows, unit, Q1.30) through `origin_q16`: out = axis * (to_world * p - origin). */
void gn_xform_compose(gn_xform *out, const int32_t axis_q30[3][3], const int32_t origin_q16[3], const gn_object *object);

/* out_q16 = xform of a mesh vertex, |out| exact to 1 LSB plus the composition's 3 * |p| * 2^-30. Not range checked. */
void gn_xform_vertex(int64_t out_q16[3], const gn_xform *xform, const gn_mesh *mesh, uint32_t vertex_idx);

/* Adds up what can be beforehand, for many vertices. */
void gn_xform_fast_begin(gn_xform_fast *fast, const gn_xform *xform);

/* What gn_xform_vertex gives. Returns 0 where it does not: where the result may be 2^29 or more, or the position 2^30. */
int gn_xform_fast_vertex(int32_t out_q16[3], const gn_xform_fast *fast, const gn_position position[3]);

/* The inverse transpose of the object's rotation and scale, up to a positive factor: largest entry near 1.0 in Q1.30. */
void gn_xform_normal_matrix(int32_t out[3][3], const gn_object *object);

/* A vertex's unit world normal, Q1.30, within 3 LSB + the matrix's error; zero where the mesh's normal is zero. */
void gn_xform_normal(int32_t out_q30[3], const int32_t matrix[3][3], const gn_normal nrm_q15[3]);

/* Number of bits that view coordinates may use: |v| < 2^30, i.e. +-16384 units. */
#define GN_VIEW_LIMIT_Q16 ((int64_t)1 << 30)

#endif
