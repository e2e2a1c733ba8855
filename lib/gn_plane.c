/* The projective plane of a triangle. */
#include "gn_plane.h"
#include "gn_q.h"

void gn_plane_setup(gn_plane *plane, const int32_t v0[3], const int32_t v1[3], const int32_t v2[3])
{
    int64_t e1[3], e2[3], n[3];
    int32_t e1n[3], e2n[3];
    for (int i = 0; i < 3; i++) {
        e1[i] = (int64_t)v1[i] - v0[i];
        e2[i] = (int64_t)v2[i] - v0[i];
    }
    int32_t exp1 = gn_norm_vec(e1n, e1), exp2 = gn_norm_vec(e2n, e2);
    gn_cross64(n, e1n, e2n);
    plane->n_exp = gn_norm_vec(plane->n, n) + exp1 + exp2;
    plane->det = gn_dot64(plane->n, v0); /* 3 * 2^30 * 2^30 */
    plane->back = plane->det < 0;
    if (plane->back) {
        plane->det = -plane->det;
        for (int i = 0; i < 3; i++) plane->n[i] = -plane->n[i];
    }
}
