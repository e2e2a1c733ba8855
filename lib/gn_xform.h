/* Transforms of the frame: camera, object to view, object to light. */
#ifndef GN_XFORM_H
#define GN_XFORM_H

#include "gn_hint.h"
#include "gn_q.h"
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

/* Row r times p, with what is added up beforehand: 3 * 2^60 + 2^61 + 2^61 */
#define GN_FAST_ROW_(r)                                                                                                            \
    (fast->row[r].sum + (int64_t)fast->row[r].m[0] * p0 + (int64_t)fast->row[r].m[1] * p1 + (int64_t)fast->row[r].m[2] * p2)

/* The same, spelled out where it is called. */
GN_INLINE int gn_xform_fast_inline(int32_t out_q16[3], const gn_xform_fast *fast, const gn_position position[3])
{
    int32_t s = fast->shift, p0 = position[0], p1 = position[1], p2 = position[2];
    uint32_t wide = (uint32_t)p0 ^ (uint32_t)p0 << 1;
    wide |= (uint32_t)p1 ^ (uint32_t)p1 << 1;
    wide |= (uint32_t)p2 ^ (uint32_t)p2 << 1;
    if (wide >> 31 || !s) return 0;
    /* row by row: together they take more registers than there are */
    int64_t x = GN_FAST_ROW_(0);
    uint32_t x_lo = (uint32_t)x, y_lo, z_lo;
    int32_t x_hi = (int32_t)(x >> 32), y_hi, z_hi;
    GN_KEEP(x_lo);
    GN_KEEP(x_hi);
    x = GN_FAST_ROW_(1);
    y_lo = (uint32_t)x, y_hi = (int32_t)(x >> 32);
    GN_KEEP(y_lo);
    GN_KEEP(y_hi);
    x = GN_FAST_ROW_(2);
    z_lo = (uint32_t)x, z_hi = (int32_t)(x >> 32);
    if (s < 32) {
        int32_t up = 32 - s;
        out_q16[0] = (int32_t)((uint32_t)x_hi << up | x_lo >> s);
        out_q16[1] = (int32_t)((uint32_t)y_hi << up | y_lo >> s);
        out_q16[2] = (int32_t)((uint32_t)z_hi << up | z_lo >> s);
        wide = (uint32_t)((x_hi ^ x_hi >> 31) | (y_hi ^ y_hi >> 31) | (z_hi ^ z_hi >> 31));
        return !(wide >> (s - 3)); /* |hi| * 2^32 < 2^29 * 2^s */
    }
    s -= 32; /* 3 * 2^28 + 2^30 */
    x_hi = (x_hi >> s) + fast->row[0].t_q16;
    y_hi = (y_hi >> s) + fast->row[1].t_q16;
    z_hi = (z_hi >> s) + fast->row[2].t_q16;
    out_q16[0] = x_hi, out_q16[1] = y_hi, out_q16[2] = z_hi;
    return !((uint32_t)((x_hi ^ x_hi >> 31) | (y_hi ^ y_hi >> 31) | (z_hi ^ z_hi >> 31)) >> 29);
}
#undef GN_FAST_ROW_

/* The inverse transpose of the object's rotation and scale, up to a positive factor: largest entry near 1.0 in Q1.30. */
void gn_xform_normal_matrix(int32_t out[3][3], const gn_object *object);

/* A vertex's unit world normal, Q1.30, within 3 LSB + the matrix's error; zero where the mesh's normal is zero. */
void gn_xform_normal(int32_t out_q30[3], const int32_t matrix[3][3], const gn_normal nrm_q15[3]);

/* Number of bits that view coordinates may use: |v| < 2^30, i.e. +-16384 units. */
#define GN_VIEW_LIMIT_Q16 ((int64_t)1 << 30)

#endif
