/* Skins: vertices where up to four joints take them. [R12] */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "geometry/gn_xform.h"

#define GN_WEIGHT_ONE 255

gn_vertex_joints gn_skin_joints(const gn_skin *skin, uint32_t vertex_idx)
{
    const uint32_t n = GN_VERTEX_JOINTS > 1 ? skin->per_vertex : 1;
    const gn_vertex_joints of = {skin->joint, skin->joint_idx + (size_t)n * vertex_idx,
                                 skin->weight_u8 + (size_t)n * vertex_idx, n};
    return of;
}

/* Where one joint takes coordinate r: the matrix has 30 - exp fraction bits, positions pos_frac_bits, results 16. */
static inline int64_t joint_coordinate(const gn_affine *joint, int r, const int32_t p[3], int32_t pos_frac_bits)
{
    /* |row| <= sqrt(3) * 2^30, |p| <= sqrt(3) * 2^30: below 3 * 2^60; shifts of 0 .. 44 by validation */
    return gn_shr64(gn_dot64(joint->m_q30[r], p), 30 - joint->exp + pos_frac_bits - 16) + joint->t_q16[r];
}

/* A vertex of an object of thousands of units, or whose mesh is stored beyond 2^30, in 64 bits. */
static GN_NOINLINE void far_position(int32_t out_q16[3], const gn_mesh *mesh, const gn_vertex_joints *of,
                                     const int32_t p[3])
{
    const int64_t limit = (int64_t)1 << 30;
    int64_t sum[3] = {0, 0, 0}; /* 255 * 2^30 */
    for (uint32_t i = 0; i < of->n; i++) {
        const int32_t weight = of->weight_u8[i];
        for (int r = 0; weight && r < 3; r++) {
            const int64_t v = joint_coordinate(&of->joint[of->idx[i]], r, p, mesh->pos_frac_bits);
            sum[r] += v < -limit || v > limit ? (int64_t)1 << 40 : weight * v; /* refused below; four are under 2^43 */
        }
    }
    /* v / 255 = v * (2^24 + 2^16 + 2^8 + 1) / 2^32, too small by the 2^32nd part: a quarter of a unit. */
    for (int r = 0; r < 3; r++)
        out_q16[r] = sum[r] > GN_WEIGHT_ONE * limit ? INT32_MAX : (int32_t)gn_shr64_inline(sum[r] * 0x1010101, 32);
}

/* A sum of weights times coordinates, exact: in one register on cores that multiply to two words. */
typedef struct {
    int64_t all;
    int32_t hi, lo; /* on others: 256 hi + lo */
} weighted_sum;

GN_INLINE void add_weighted(weighted_sum *sum, int32_t weight, int32_t v)
{
    if (GN_CORE_LONG_PRODUCTS) sum->all += (int64_t)weight * v;
    else {
        sum->hi += weight * (v >> 8);
        sum->lo += weight * (v & 255);
    }
}

/* Over 255, rounded down by less than 1 + 2^-7. */
GN_INLINE int32_t mean_of(const weighted_sum *sum)
{
    const int32_t hi = GN_CORE_LONG_PRODUCTS ? (int32_t)(sum->all >> 8) : sum->hi + (sum->lo >> 8),
                  lo = (GN_CORE_LONG_PRODUCTS ? (int32_t)sum->all : sum->lo) & 255, rest = hi + lo;
    return hi + ((rest + (rest >> 8) + (rest >> 16) + (rest >> 24)) >> 8); /* (256 hi + lo) / 255 */
}

/* Row r times (x, y, z), with 15 bits of the matrix, as if each dropped half a unit; 2^shift of them are a unit of t.
 */
#define GN_ROW_(r)                                                                                                     \
    (((half + (joint->m_q30[r][0] >> 15) * x + (joint->m_q30[r][1] >> 15) * y + (joint->m_q30[r][2] >> 15) * z) >>     \
      shift) +                                                                                                         \
     joint->t_q16[r])

void gn_skin_position(int32_t out_q16[3], const gn_object *object, uint32_t vertex_idx)
{
    const gn_mesh *mesh = object->mesh;
    const gn_vertex_joints of = gn_skin_joints(object->skin, vertex_idx);
    const gn_position *at = mesh->pos + 3 * (size_t)vertex_idx;
    const int32_t p[3] = {at[0], at[1], at[2]};
    /* |x| + |y| + |z| < 2^16 - 14 with a matrix up to 2^15: rows are below 2^31 */
    const uint32_t away[3] = {gn_abs32(p[0]), gn_abs32(p[1]), gn_abs32(p[2])}, size = away[0] + away[1] + away[2],
                   far = (away[0] | away[1] | away[2]) >> 30;
    const int32_t down = gn_max32(16 - gn_clz32((size + (size >> 12)) | 1U), 0), round = 1 << down >> 1,
                  x = (p[0] + round) >> down, y = (p[1] + round) >> down, z = (p[2] + round) >> down,
                  half = (x + y + z) >> 1, one = mesh->pos_frac_bits - 1 - down;
    GN_COUNT(posed, 1);
    weighted_sum sum_x = {0, 0, 0}, sum_y = {0, 0, 0}, sum_z = {0, 0, 0};
    for (uint32_t i = 0; i < of.n; i++) {
        const gn_affine *joint = &of.joint[of.idx[i]];
        const int32_t weight = of.weight_u8[i], shift = one - joint->exp;
        if (!weight) continue;
        if (GN_SELDOM(shift < 2 || far)) {
            far_position(out_q16, mesh, &of, p);
            return;
        }
        add_weighted(&sum_x, weight, GN_ROW_(0)); /* 2^29 + 2^30 */
        add_weighted(&sum_y, weight, GN_ROW_(1));
        add_weighted(&sum_z, weight, GN_ROW_(2));
    }
    out_q16[0] = mean_of(&sum_x);
    out_q16[1] = mean_of(&sum_y);
    out_q16[2] = mean_of(&sum_z);
}
#undef GN_ROW_

/* The weighted mean of the joints' matrices, up to a positive factor: largest entry in 2^29 .. 2^30. */
static void mean_matrix(int32_t out[3][3], const gn_vertex_joints *of)
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
    const gn_vertex_joints of = gn_skin_joints(object->skin, vertex_idx);
    int32_t mean[3][3], inverse[3][3], posed[3];
    int64_t n[3]; /* 3 * 2^60 */
    GN_COUNT(posed_normals, 1);
    mean_matrix(mean, &of);
    gn_xform_normal_matrix(inverse, (const int32_t(*)[3])mean);
    gn_xform_normal(posed, (const int32_t(*)[3])inverse, object->mesh->nrm_q15 + 3 * (size_t)vertex_idx);
    for (int r = 0; r < 3; r++) n[r] = gn_dot64(matrix[r], posed);
    if (!gn_normalise_q30(out_q30, n)) out_q30[0] = out_q30[1] = out_q30[2] = 0;
}
