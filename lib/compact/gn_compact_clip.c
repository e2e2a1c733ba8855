/* Compact arithmetic: polygons cut to what can be projected. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "compact/gn_compact.h"

/* Distance of a point to the inside of a side of the guard band, 0 .. 3, or beyond the near plane: below 2^42. */
static int64_t inside(const gn_compact_view *view, const int32_t v_q16[3], int plane)
{
    if (plane >= 4) return (int64_t)v_q16[2] - view->near_q16;
    int64_t side = v_q16[plane >> 1], reach = view->near_norm ? (int64_t)v_q16[2] * view->guard : view->guard;
    return plane & 1 ? reach - side : reach + side;
}

/* Where an edge from a point inside to one outside is cut: t = a / (a - b), Q31. */
static void compact_cut(int32_t out[3], const int32_t from[3], const int32_t to[3], int64_t a, int64_t b)
{
    uint64_t whole = (uint64_t)(a - b);
    int32_t clz = gn_clz64(whole);
    int64_t t =
        gn_compact_mul((uint32_t)((uint64_t)a << clz >> 32), gn_recip_norm((uint32_t)(whole << clz >> 32), 2), 0);
    for (int i = 0; i < 3; i++) out[i] = from[i] + (int32_t)(((to[i] - from[i]) * t) >> 31); /* 2^30 * 2^31 */
}

static int compact_clip_plane(int32_t (*out)[3], int32_t (*in)[3], int n, const gn_compact_view *view, int plane)
{
    int n_out = 0;
    for (int i = 0; i < n; i++) {
        const int32_t *p = in[i], *q = in[i + 1 == n ? 0 : i + 1];
        int64_t a = inside(view, p, plane), b = inside(view, q, plane);
        if (a >= 0) {
            for (int k = 0; k < 3; k++) out[n_out][k] = p[k];
            n_out++;
        }
        if (a >= 0 && b < 0) compact_cut(out[n_out++], p, q, a, b);
        if (a < 0 && b >= 0) compact_cut(out[n_out++], q, p, b, a); /* the same point as cut from the other side */
    }
    return n_out;
}

int gn_compact_clip(gn_compact_polygon *polygon, gn_compact_polygon *spare, int n, const gn_compact_view *view)
{
    /* to and fro an even number of times: the near plane counts twice */
    for (int plane = view->near_norm ? 5 : 3; plane >= 0; plane -= 2) {
        n = compact_clip_plane(spare->v_q16, polygon->v_q16, n, view, plane);
        n = compact_clip_plane(polygon->v_q16, spare->v_q16, n, view, plane - 1);
    }
    return n;
}
