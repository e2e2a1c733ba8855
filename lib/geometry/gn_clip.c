/* Sutherland-Hodgman in view space. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_clip.h"

/* Signed distance to a plane, positive inside, up to a positive factor; Q32. |v| < 2^30, side < 2^31: below 2^62. */
static int64_t distance(const int32_t v[3], uint32_t plane, int32_t near_q16, const int32_t side_q16[2],
                        int32_t flat_q16)
{
    int64_t z = flat_q16 ? flat_q16 : v[2];
    switch (plane) {
    case GN_OUT_NEAR:
        return (int64_t)v[2] - near_q16;
    case GN_OUT_LEFT:
        return z * side_q16[0] + (int64_t)v[0] * 65536;
    case GN_OUT_RIGHT:
        return z * side_q16[0] - (int64_t)v[0] * 65536;
    case GN_OUT_BOTTOM:
        return z * side_q16[1] + (int64_t)v[1] * 65536;
    default:
        return z * side_q16[1] - (int64_t)v[1] * 65536;
    }
}

uint32_t gn_outcode(const int32_t v_q16[3], int32_t near_q16, const int32_t side_q16[2], int32_t flat_q16)
{
    /* as distance() has them */
    uint32_t out = v_q16[2] < near_q16 ? GN_OUT_NEAR : 0;
    int64_t z = flat_q16 ? flat_q16 : v_q16[2], side = z * side_q16[0], along = (int64_t)v_q16[0] * 65536;
    if (side + along < 0) out |= GN_OUT_LEFT;
    if (side - along < 0) out |= GN_OUT_RIGHT;
    side = z * side_q16[1];
    along = (int64_t)v_q16[1] * 65536;
    if (side + along < 0) out |= GN_OUT_BOTTOM;
    if (side - along < 0) out |= GN_OUT_TOP;
    return out;
}

/* The point where the edge leaves: from the inside end, so that both triangles on the edge compute the same. */
static void cut(int32_t out[3], const int32_t in[3], int64_t d_in, const int32_t beyond[3], int64_t d_out)
{
    /* t = d_in / (d_in - d_out) in (0, 1], Q0.31; d_in >= 0 > d_out and the difference is below 2^63 */
    uint64_t whole = (uint64_t)d_in + gn_abs64(d_out);
    int32_t clz = gn_clz64(whole);
    uint64_t d = (uint64_t)d_in << clz;
    uint32_t whole_norm = (uint32_t)((whole << clz) >> 32);
    uint64_t t_q31 = ((d >> 32) * gn_recip_norm(whole_norm, 2)) >> 32; /* (d / 2^32) * 2^63 / whole / 2^32 */
    for (int i = 0; i < 3; i++) {
        int64_t delta = (int64_t)beyond[i] - in[i]; /* < 2^31 */
        out[i] = (int32_t)(in[i] + gn_shr64(delta * (int64_t)t_q31, 31));
    }
}

static void clip_plane(gn_polygon *polygon, gn_polygon *in, uint32_t plane, int32_t near_q16, const int32_t side_q16[2],
                       int32_t flat_q16)
{
    *in = *polygon;
    int n = 0;
    for (int i = 0; i < in->n; i++) {
        const int32_t *a = in->v_q16[i], *b = in->v_q16[(i + 1) % in->n];
        int64_t da = distance(a, plane, near_q16, side_q16, flat_q16),
                db = distance(b, plane, near_q16, side_q16, flat_q16);
        if (da >= 0 && n < GN_CLIP_VERTICES_MAX) {
            for (int k = 0; k < 3; k++) polygon->v_q16[n][k] = a[k];
            n++;
        }
        if ((da >= 0) != (db >= 0) && n < GN_CLIP_VERTICES_MAX) {
            int32_t *v = polygon->v_q16[n++];
            if (da >= 0) cut(v, a, da, b, db);
            else cut(v, b, db, a, da);
            if (plane == GN_OUT_NEAR) v[2] = near_q16; /* exact where the cut rounds */
        }
    }
    polygon->n = n;
}

/* Cuts at the planes that the polygon crosses, one by one. [R3] */
GN_COLD void gn_clip(gn_polygon *polygon, gn_polygon *uncut, uint32_t planes, int32_t near_q16,
                     const int32_t side_q16[2], int32_t flat_q16)
{
    for (uint32_t plane = GN_OUT_NEAR; plane <= GN_OUT_TOP && polygon->n >= 3; plane <<= 1)
        if (planes & plane) clip_plane(polygon, uncut, plane, near_q16, side_q16, flat_q16);
    if (polygon->n < 3) polygon->n = 0;
}
