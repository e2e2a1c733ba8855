/* Transforms of the frame. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "geometry/gn_xform.h"

/* Largest distance of a clipped vertex from the picture's centre, in pixels. Up to 7 subpixel bits it must fit 16 bits
 * where the picture allows (NUMERICS 4.2); otherwise the guard band is 1000 pixels around the picture. The choice does
 * not depend on the type that stores it, so that every build clips alike. */
static int fits_16_bits(int32_t subpixel_bits, int32_t size_px)
{
    return subpixel_bits <= 7 && size_px <= 2 * ((32767 >> subpixel_bits) - 10);
}

static int32_t guard_px(int32_t subpixel_bits, int32_t size_px)
{
    int32_t wide = size_px / 2 + 1000;
    return fits_16_bits(subpixel_bits, size_px) ? gn_min32((32767 >> subpixel_bits) - 2, wide) : wide;
}

/* Pixels from the centre over the focal length: Q16, rounded down so that a clipped vertex stays within. */
static int32_t slope_q16(uint32_t twice_px, uint32_t focal2_px_q16)
{
    return gn_sat32((int64_t)gn_udiv64((uint64_t)twice_px << 32, focal2_px_q16));
}

void gn_cam_setup(gn_frame *frame)
{
    const gn_camera *camera = &frame->scene->camera;
    gn_cam *cam = &frame->cam;
    for (int i = 0; i < 3; i++) {
        /* columns of the rotation are the axes; the camera looks along -Z */
        cam->axis_q30[0][i] = camera->to_world.m_q30[i][0];
        cam->axis_q30[1][i] = camera->to_world.m_q30[i][1];
        cam->axis_q30[2][i] = -camera->to_world.m_q30[i][2];
        cam->eye_q16[i] = camera->to_world.t_q16[i];
    }
    cam->near_q16 = camera->near_q16;
    uint32_t focal_q24 = camera->focal_q24;
#if GN_ORTHOGRAPHIC /* as a perspective camera sees what is half its picture's height away, with focal length 1 [R10]  \
                     */
    cam->flat_q16 = camera->half_height_q16;
    if (cam->flat_q16) focal_q24 = 1U << 24;
#endif
    /* 2F = focal * H: Q8.24 * up to 2048 < 2^43, Q16 needs it >> 8, saturated by validation of focal * H < 2^15 */
    cam->focal2_px_q16 = (uint32_t)(((uint64_t)focal_q24 * frame->picture.height + 128U) >> 8);
    cam->inv_focal2 = gn_bf_recip(gn_bf_from_u64(cam->focal2_px_q16));
    int32_t size[2] = {frame->picture.width, frame->picture.height}, bits = GN_K(frame, subpixel_bits);
    cam->coord_max_q16 =
        fits_16_bits(bits, gn_max32(size[0], size[1])) ? gn_min32(32767 << (16 - bits), 1 << 27) : 1 << 27;
    for (int i = 0; i < 2; i++) {
        int32_t guard = guard_px(bits, gn_max32(size[0], size[1]));
        cam->guard_q16[i] = slope_q16(2 * (uint32_t)guard, cam->focal2_px_q16);
        cam->tan_q16[i] = gn_sat32((int64_t)slope_q16((uint32_t)size[i], cam->focal2_px_q16) +
                                   1); /* rounded up: only for rejection */
    }
}

/* Transforms of an instance and of the camera in one. [R8] */
void gn_xform_compose(gn_xform *out, const int32_t axis_q30[3][3], const int32_t origin_q16[3], const gn_object *object)
{
    const gn_affine *a = &object->to_world;
    /* up to 2^30 each: times 2^30, three of them with a unit row, below 2^62 */
    const int32_t from_origin[3] = {a->t_q16[0] - origin_q16[0], a->t_q16[1] - origin_q16[1],
                                    a->t_q16[2] - origin_q16[2]};
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            int32_t column[3] = {a->m_q30[0][c], a->m_q30[1][c], a->m_q30[2][c]};
            /* |axis| = 1, |column| <= sqrt(3): the sum is below 2^61, the result below 2^31 */
            out->m[r][c] = gn_sat32(gn_dot_q30(axis_q30[r], column));
        }
        out->t_q16[r] = gn_dot_q30(axis_q30[r], from_origin);
    }
    /* m has 30 - exp fraction bits, positions pos_frac_bits, or 16 behind a skin; the result 16. 0 <= shift <= 44 by
     * validation. */
    out->shift = 30 - a->exp + (GN_SKIN(object) ? 16 : object->mesh->pos_frac_bits) - 16;
}

void gn_xform_point(int64_t out_q16[3], const gn_xform *xform, const int32_t p[3])
{
    for (int r = 0; r < 3; r++) {
        /* |row| <= sqrt(3) * 2^30, |p| <= sqrt(3) * 2^30: below 3 * 2^60 */
        out_q16[r] = gn_shr64(gn_dot64(xform->m[r], p), xform->shift) + xform->t_q16[r];
    }
}

void gn_xform_fast_begin(gn_xform_fast *fast, const gn_xform *xform)
{
    int32_t s = xform->shift, up = gn_max32(32 - s, 0), down = gn_max32(s - 32, 0);
    fast->reach = 0;
    if (s < 3 || s > 62) return;
    for (int r = 0; r < 3; r++) {
        uint64_t t = gn_abs64(xform->t_q16[r]), reach = 2 * t + 1;
        for (int c = 0; c < 3; c++) {
            fast->row[r].m[c] = xform->m[r][c];
            reach += gn_abs32(xform->m[r][c]);
        }
        /* sum + m . p in 63 bits, p in 31: 2^31 + t * 2^32 + the row's entries * 2^31 */
        if (t >> 30 || reach >> 32) return;
        fast->row[r].t_q16 = down ? (int32_t)xform->t_q16[r] : 0;
        fast->row[r].sum = ((int64_t)1 << (31 + down)) + (down ? 0 : gn_shl64(xform->t_q16[r], 32));
    }
    fast->up = (uint8_t)up;
    fast->down = (uint8_t)down;
    fast->reach =
        1U << (31 - gn_max32(up, 1)); /* a position may have 30 bits with any transform: gn_scene_position_ok */
}

void gn_xform_normal_matrix(int32_t out_q30[9], const int32_t m[3][3])
{
    /* The cofactors are the inverse transpose times the determinant: only their direction and the determinant's sign
     * matter. */
    int64_t cofactor[9];
    uint64_t any = 1;
    for (int r = 0; r < 3; r++) {
        const int32_t *a = m[r == 2 ? 0 : r + 1], *b = m[r ? r - 1 : 2];
        for (int c = 0; c < 3; c++) {
            const int c1 = c == 2 ? 0 : c + 1, c2 = c ? c - 1 : 2;
            cofactor[3 * r + c] = (int64_t)a[c1] * b[c2] - (int64_t)a[c2] * b[c1]; /* <= 2^61 */
            any |= gn_abs64(cofactor[3 * r + c]);
        }
    }
    const int32_t turn = gn_det_sign(m) < 0 ? -1 : 1, e = 34 - gn_clz64(any);
    for (int k = 0; k < 9; k++)
        out_q30[k] = turn * (int32_t)gn_clamp64(gn_scale64(cofactor[k], e), -(1 << 30), 1 << 30);
}

/* ---- Skins ------------------------------------------------------------------------------------------------------- */

/* Vertices where up to four joints take them. [R12] */

#if GN_VERTEX_JOINTS
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

#endif

#if GN_POSED_NORMALS
/* Normals of what a joint alone moves, in the world: by the cofactors of its matrix over the root of the sum of their
 * squares, turned where it mirrors. Entries up to 2^14; after the object's, sqrt(3) times that. MODEL 2. */
static void find_joint_normals(gn_joint_normals *out, const gn_affine *joint, const int32_t to_world_q30[9])
{
    int32_t m[9], k[9];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) m[3 * r + c] = joint->m_q30[r][c];
    gn_to_bits(m, 9, 14);
    GN_UNROLL
    for (int r = 0; r < 3; r++) {
        const int32_t *a = m + 3 * (r == 2 ? 0 : r + 1), *b = m + 3 * (r ? r - 1 : 2);
        k[3 * r] = a[1] * b[2] - a[2] * b[1]; /* 2^29 */
        k[3 * r + 1] = a[2] * b[0] - a[0] * b[2];
        k[3 * r + 2] = a[0] * b[1] - a[1] * b[0];
    }
    gn_to_bits(k, 9, 14);
    uint32_t sum = 1; /* 9 * 2^28 */
    for (int i = 0; i < 9; i++) sum += (uint32_t)(k[i] * k[i]);
    /* 12 * 2^14 is rounding: it flattens and has no side */
    const int32_t det = m[0] * k[0] + m[1] * k[1] + m[2] * k[2], up = gn_clz32(sum) & ~1, more = up / 2;
    int32_t root = (int32_t)(gn_rsqrt_norm(sum << up, 1) >> 1); /* 2^(46 - more) / length */
    if (det < -(1 << 18)) root = -root;
    for (int i = 0; i < 9; i++) k[i] = gn_mul_high(k[i] * (1 << (14 + more)), root) >> 14;
    int16_t *to = out->m_q14;
    for (int r = 0; r < 3; r++, to_world_q30 += 3)
        for (int c = 0; c < 3; c++) { /* rows of at most sqrt(3) and columns of 1 */
            int32_t at = 0;
            for (int j = 0; j < 3; j++) at += (to_world_q30[j] >> 16) * k[3 * j + c];
            *to++ = (int16_t)(at >> 14);
        }
}

/* The weighted mean of what the vertex's joints make of its normal, of any length. */
static void skin_normal(int32_t out[3], gn_normals *by, uint32_t vertex_idx)
{
    const gn_vertex_joints of = gn_skin_joints(by->object->skin, vertex_idx);
    const gn_normal *n = by->object->mesh->nrm_q15 + 3 * (size_t)vertex_idx;
    out[0] = out[1] = out[2] = 0;
    GN_COUNT(posed_normals, 1);
    for (uint32_t i = 0; i < of.n; i++) {
        const int32_t weight = of.weight_u8[i];
        gn_joint_normals *joint = &by->joint[of.idx[i] % GN_JOINT_NORMALS];
        if (!weight) continue;
        if (joint->tag != of.idx[i] + 1U) {
            find_joint_normals(joint, &of.joint[of.idx[i]], by->to_world_q30);
            joint->tag = (uint16_t)(of.idx[i] + 1U);
        }
        GN_UNROLL
        for (int r = 0; r < 3; r++) { /* 3 * 2^29, then 255 * 3 * 2^21 in all */
            const int16_t *row = joint->m_q14 + 3 * r;
            out[r] += ((row[0] * n[0] + row[1] * n[1] + row[2] * n[2]) >> 8) * weight;
        }
    }
}
#endif

/* ---- Normals ----------------------------------------------------------------------------------------------------- */

void gn_normals_use(gn_normals *by, const gn_object *object)
{
    if (by->object == object) return;
    by->object = object;
    gn_xform_normal_matrix(by->to_world_q30, object->to_world.m_q30);
#if GN_POSED_NORMALS
    for (int i = 0; i < GN_JOINT_NORMALS; i++) by->joint[i].tag = 0;
#endif
}

void gn_normals_find(int32_t out_q30[3], gn_normals *by, uint32_t vertex_idx)
{
#if GN_POSED_NORMALS
    if (by->object->skin) skin_normal(out_q30, by, vertex_idx);
    else
#endif
    {
        const gn_normal *nrm = by->object->mesh->nrm_q15 + 3 * (size_t)vertex_idx;
        const int32_t n[3] = {nrm[0], nrm[1], nrm[2]};
        int64_t sum[3]; /* thin objects have rows of few bits: sums are exact */
        for (int i = 0; i < 3; i++) sum[i] = gn_dot64(by->to_world_q30 + 3 * i, n); /* 3 * 2^30 * 2^15 */
        gn_norm_vec(out_q30, sum);
    }
    gn_normalise_15(out_q30);
}
