/* Transforms for callers: built from rotations and scales, multiplied with rounding [R8]. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"

#define GN_ONE_Q30 (1 << 30)

void gn_affine_identity(gn_affine *out)
{
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) out->m_q30[r][c] = r == c ? GN_ONE_Q30 : 0;
        out->t_q16[r] = 0;
    }
    out->exp = 0;
}

void gn_affine_rotation(gn_affine *out, uint16_t yaw_turn, uint16_t pitch_turn, uint16_t roll_turn)
{
    int32_t sy = gn_sin_q30(yaw_turn), cy = gn_cos_q30(yaw_turn);
    int32_t sx = gn_sin_q30(pitch_turn), cx = gn_cos_q30(pitch_turn);
    int32_t sz = gn_sin_q30(roll_turn), cz = gn_cos_q30(roll_turn);
    int32_t sysx = gn_mul_q30(sy, sx), cysx = gn_mul_q30(cy, sx);
    gn_affine_identity(out);
    out->m_q30[0][0] = gn_mul_q30(cy, cz) + gn_mul_q30(sysx, sz);
    out->m_q30[0][1] = gn_mul_q30(sysx, cz) - gn_mul_q30(cy, sz);
    out->m_q30[0][2] = gn_mul_q30(sy, cx);
    out->m_q30[1][0] = gn_mul_q30(cx, sz);
    out->m_q30[1][1] = gn_mul_q30(cx, cz);
    out->m_q30[1][2] = -sx;
    out->m_q30[2][0] = gn_mul_q30(cysx, sz) - gn_mul_q30(sy, cz);
    out->m_q30[2][1] = gn_mul_q30(sy, sz) + gn_mul_q30(cysx, cz);
    out->m_q30[2][2] = gn_mul_q30(cy, cx);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) out->m_q30[r][c] = gn_max32(-GN_ONE_Q30, gn_min32(GN_ONE_Q30, out->m_q30[r][c]));
}

/* Stores m, given in Q30 * 2^exp with |m| < 2^62, under the smallest exponent 0..14 that keeps entries within 1.0. */
static void set_matrix(gn_affine *out, int64_t m[3][3], int32_t exp)
{
    uint64_t any = 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) any = gn_abs64(m[r][c]) > any ? gn_abs64(m[r][c]) : any;
    int32_t shift = -exp; /* to exponent 0, then to the smallest exponent that fits the largest entry */
    while (exp + shift < 14 && gn_abs64(gn_scale64((int64_t)any, shift)) > GN_ONE_Q30) shift++;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            out->m_q30[r][c] = (int32_t)gn_clamp64(gn_scale64(m[r][c], shift), -GN_ONE_Q30, GN_ONE_Q30);
    out->exp = exp + shift;
}

void gn_affine_scale(gn_affine *inout, int32_t scale_q16)
{
    int64_t m[3][3];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) m[r][c] = (int64_t)inout->m_q30[r][c] * scale_q16; /* 2^30 * 2^29 */
    set_matrix(inout, m, inout->exp - 16);
}

void gn_affine_mul(gn_affine *out, const gn_affine *a, const gn_affine *b)
{
    int64_t m[3][3];
    int32_t t[3];
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            int32_t column[3] = {b->m_q30[0][c], b->m_q30[1][c], b->m_q30[2][c]};
            m[r][c] = gn_shr64(gn_dot64(a->m_q30[r], column), 2); /* Q58, below 2^60 */
        }
        int64_t moved = gn_scale64(gn_shr64(gn_dot64(a->m_q30[r], b->t_q16), 15), 15 - a->exp); /* 3 * 2^61 */
        t[r] = gn_sat32(moved + a->t_q16[r]);
    }
    set_matrix(out, m, a->exp + b->exp - 28);
    for (int r = 0; r < 3; r++) out->t_q16[r] = t[r];
}

/* Columns x, z x x, z of unit vectors at right angles. */
static void set_axes(gn_affine *out, const int32_t x_q30[3], const int32_t z_q30[3])
{
    int32_t y[3];
    gn_cross_q30(y, z_q30, x_q30);
    for (int i = 0; i < 3; i++) {
        out->m_q30[i][0] = x_q30[i];
        out->m_q30[i][1] = gn_max32(-GN_ONE_Q30, gn_min32(GN_ONE_Q30, y[i]));
        out->m_q30[i][2] = z_q30[i];
    }
}

void gn_affine_orthonormalise(gn_affine *inout)
{
    int64_t back[3], right[3];
    int32_t z[3], y[3], x[3];
    for (int i = 0; i < 3; i++) {
        back[i] = inout->m_q30[i][2];
        y[i] = inout->m_q30[i][1];
    }
    if (!gn_normalise_q30(z, back)) return;
    gn_cross64(right, y, z);
    if (!gn_normalise_q30(x, right)) return;
    set_axes(inout, x, z);
}

void gn_camera_look_at(gn_affine *out, const int32_t eye_q16[3], const int32_t target_q16[3])
{
    int64_t back[3], right[3];
    int32_t z[3], x[3];
    for (int i = 0; i < 3; i++) back[i] = (int64_t)eye_q16[i] - target_q16[i];
    gn_affine_identity(out);
    for (int i = 0; i < 3; i++) out->t_q16[i] = eye_q16[i];
    if (!gn_normalise_q30(z, back)) { /* eye on target: no rotation, which gn_begin refuses */
        for (int i = 0; i < 3; i++) out->m_q30[i][i] = 0;
        return;
    }
    right[0] = z[2];
    right[1] = 0;
    right[2] = -(int64_t)z[0];
    if (!gn_normalise_q30(x, right)) x[0] = GN_ONE_Q30, x[1] = x[2] = 0; /* straight up or down */
    set_axes(out, x, z);
}
