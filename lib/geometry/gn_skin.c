/* Skins: vertices where up to four joints take them. [R12] */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "geometry/gn_xform.h"

#define GN_WEIGHT_ONE 255

/* What moves one vertex. */
typedef struct {
    const gn_affine *joint;
    const uint8_t *idx, *weight_u8;
    uint32_t n;
} vertex_joints;

static vertex_joints joints_of(const gn_skin *skin, uint32_t vertex_idx)
{
    const uint32_t n = GN_VERTEX_JOINTS > 1 ? skin->per_vertex : 1;
    const vertex_joints of = {skin->joint, skin->joint_idx + (size_t)n * vertex_idx,
                              skin->weight_u8 + (size_t)n * vertex_idx, n};
    return of;
}

/* Where one joint takes coordinate r: the matrix has 30 - exp fraction bits, positions pos_frac_bits, results 16. */
static inline int64_t joint_coordinate(const gn_affine *joint, int r, const int32_t p[3], int32_t pos_frac_bits)
{
    /* |row| <= sqrt(3) * 2^30, |p| <= sqrt(3) * 2^30: below 3 * 2^60; shifts of 0 .. 44 by validation */
    return gn_shr64(gn_dot64(joint->m_q30[r], p), 30 - joint->exp + pos_frac_bits - 16) + joint->t_q16[r];
}

void gn_skin_position(int32_t out_q16[3], const gn_object *object, uint32_t vertex_idx)
{
    const gn_mesh *mesh = object->mesh;
    const vertex_joints of = joints_of(object->skin, vertex_idx);
    const gn_position *at = mesh->pos + 3 * (size_t)vertex_idx;
    const int32_t p[3] = {at[0], at[1], at[2]};
    const int64_t limit = (int64_t)1 << 30;
    int64_t sum[3] = {0, 0, 0}; /* 255 * 2^30 */
    for (uint32_t i = 0; i < of.n; i++) {
        const int32_t weight = of.weight_u8[i];
        for (int r = 0; weight && r < 3; r++) {
            const int64_t v = joint_coordinate(&of.joint[of.idx[i]], r, p, mesh->pos_frac_bits);
            sum[r] += v < -limit || v > limit ? (int64_t)1 << 40 : weight * v; /* refused below; four are under 2^43 */
        }
    }
    /* v / 255 = v * (2^24 + 2^16 + 2^8 + 1) / 2^32, too small by the 2^32nd part: a quarter of a unit. */
    for (int r = 0; r < 3; r++)
        out_q16[r] = sum[r] > GN_WEIGHT_ONE * limit ? INT32_MAX : (int32_t)gn_shr64_inline(sum[r] * 0x1010101, 32);
}

/* The weighted mean of the joints' matrices, up to a positive factor: largest entry in 2^29 .. 2^30. */
static void mean_matrix(int32_t out[3][3], const vertex_joints *of)
{
    int64_t sum[3][3] = {{0}};
    uint64_t any = 1;
    for (uint32_t i = 0; i < of->n; i++) {
        const gn_affine *joint = &of->joint[of->idx[i]];
        for (int k = 0; k < 9; k++) /* 255 * 2^30 * 2^14 in all */
            sum[k / 3][k % 3] += gn_shl64((int64_t)joint->m_q30[k / 3][k % 3] * of->weight_u8[i], joint->exp);
    }
    for (int k = 0; k < 9; k++) any |= gn_abs64(sum[k / 3][k % 3]);
    for (int k = 0; k < 9; k++)
        out[k / 3][k % 3] = (int32_t)gn_clamp64(gn_scale64(sum[k / 3][k % 3], 34 - gn_clz64(any)), -(1 << 30), 1 << 30);
}

void gn_skin_normal(int32_t out_q30[3], const gn_object *object, const int32_t matrix[3][3], uint32_t vertex_idx)
{
    const vertex_joints of = joints_of(object->skin, vertex_idx);
    int32_t mean[3][3], inverse[3][3], posed[3];
    int64_t n[3]; /* 3 * 2^60 */
    mean_matrix(mean, &of);
    gn_xform_normal_matrix(inverse, (const int32_t(*)[3])mean);
    gn_xform_normal(posed, (const int32_t(*)[3])inverse, object->mesh->nrm_q15 + 3 * (size_t)vertex_idx);
    for (int r = 0; r < 3; r++) n[r] = gn_dot64(matrix[r], posed);
    if (!gn_normalise_q30(out_q30, n)) out_q30[0] = out_q30[1] = out_q30[2] = 0;
}

/* The weighted mean of the joints' matrices, 14 bits, up to a positive factor. */
static void short_mean_matrix(int32_t out[3][3], const vertex_joints *of)
{
    int32_t exp = of->joint[of->idx[0]].exp;
    for (uint32_t i = 1; i < of->n; i++)
        if (of->weight_u8[i]) exp = gn_max32(exp, of->joint[of->idx[i]].exp);
    for (int k = 0; k < 9; k++) out[k / 3][k % 3] = 0;
    for (uint32_t i = 0; i < of->n; i++) {
        const gn_affine *joint = &of->joint[of->idx[i]];
        const int32_t weight = of->weight_u8[i], down = gn_min32(16 + exp - joint->exp, 31);
        for (int k = 0; weight && k < 9; k++) out[k / 3][k % 3] += (joint->m_q30[k / 3][k % 3] >> down) * weight;
    }
    for (int k = 0; k < 9; k++) out[k / 3][k % 3] >>= 8; /* 255 * 2^14 */
}

void gn_skin_direction(int32_t n[3], const gn_skin *skin, uint32_t vertex_idx)
{
    const vertex_joints of = joints_of(skin, vertex_idx);
    const int32_t x = n[0] >> 1, y = n[1] >> 1, z = n[2] >> 1; /* 2^14 */
    int32_t m[3][3], det = 0;
    short_mean_matrix(m, &of);
    for (int r = 0; r < 3; r++) { /* the inverse transpose, times the determinant: below 2^15 */
        const int32_t *a = m[(r + 1) % 3], *b = m[(r + 2) % 3];
        const int32_t cx = (a[1] * b[2] - a[2] * b[1]) >> 15, cy = (a[2] * b[0] - a[0] * b[2]) >> 15,
                      cz = (a[0] * b[1] - a[1] * b[0]) >> 15; /* 2^29 each */
        n[r] = (cx * x + cy * y + cz * z) >> 14; /* 3 * 2^28 */
        if (!r) det = cx * m[0][0] + cy * m[0][1] + cz * m[0][2];
    }
    for (int r = 0; det < 0 && r < 3; r++) n[r] = -n[r];
}
