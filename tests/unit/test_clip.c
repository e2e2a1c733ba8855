/* Clipping in view space: what comes out lies inside, is convex, and neighbours stay neighbours, down to the last bit.
 */
#include <stdint.h>
#include <string.h>

#include "exact.h"
#include "geometry/gn_xform.h"
#include "geometry/gn_walk.h"
#include "rng.h"

static rng random_state = {6};

enum { LIMIT = (1 << 30) - 1, ALL_PLANES = 31, CUT_LSB = 2, NEAR_LSB = 0 };

typedef struct {
    int32_t near, side[2];
} frustum;

static i128 plane_distance(const int32_t v[3], uint32_t plane, const frustum *f)
{
    int axis = plane >= GN_OUT_BOTTOM, positive = plane == GN_OUT_LEFT || plane == GN_OUT_BOTTOM;
    if (plane == GN_OUT_NEAR) return (i128)v[2] - f->near;
    return (i128)v[2] * f->side[axis] + (i128)v[axis] * (positive ? 65536 : -65536);
}

static frustum random_frustum(void)
{
    static const int32_t hard_side[4] = {1, 65536, INT32_MAX, 1 << 20}, hard_near[2] = {256, 8192 << 16};
    frustum f;
    f.near = rng_below(&random_state, 4) ? (int32_t)(rng_wide_u64(&random_state, 22) + 256)
                                         : hard_near[rng_below(&random_state, 2)];
    for (int i = 0; i < 2; i++)
        f.side[i] = rng_below(&random_state, 4) ? (int32_t)rng_wide_u64(&random_state, 22)
                                                : hard_side[rng_below(&random_state, 4)];
    return f;
}

/* A view-space point: of any size, extreme, or close to a plane of the frustum. */
static void random_point(int32_t v[3], uint32_t bits, const frustum *f)
{
    for (int k = 0; k < 3; k++) v[k] = rng_wide_i32(&random_state, bits);
    switch (rng_below(&random_state, 8)) {
    case 0:
        for (int k = 0; k < 3; k++) v[k] = rng_below(&random_state, 2) ? LIMIT : -LIMIT;
        break;
    case 1:
        v[2] = f->near + rng_range(&random_state, -2, 2);
        break;
    case 2: { /* on a side plane, or beside it */
        int axis = (int)rng_below(&random_state, 2);
        int64_t x = (int64_t)v[2] * f->side[axis] / 65536;
        if (x > -LIMIT + 2 && x < LIMIT - 2) v[axis] = (int32_t)(v[2] < 0 ? x : -x) + rng_range(&random_state, -2, 2);
        break;
    }
    default:
        break;
    }
}

/* Corners around the near end of the frustum, so that many planes cut the same triangle. */
static gn_polygon uncut; /* gn_clip works in it */

static void tight_triangle(gn_polygon *p, const frustum *f)
{
    int32_t near = f->near < 1 << 24 ? f->near : 1 << 24;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) {
            int64_t reach = (int64_t)near * f->side[k] / 65536 * 4;
            p->v_q16[i][k] = rng_range(&random_state, -(int32_t)(reach < LIMIT ? reach : LIMIT),
                                       (int32_t)(reach < LIMIT ? reach : LIMIT));
        }
        p->v_q16[i][2] = rng_range(&random_state, -2 * near, 4 * near);
    }
}

static uint32_t outcodes(const gn_polygon *p, const frustum *f)
{
    uint32_t planes = 0;
    for (int i = 0; i < p->n; i++) planes |= gn_outcode(p->v_q16[i], f->near, f->side, 0);
    return planes;
}

/* ---- One triangle ------------------------------------------------------------------------------------------------ */

static void test_outcode(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 300000; i++) {
        frustum f = random_frustum();
        int32_t v[3];
        uint32_t expected = 0;
        random_point(v, 1 + i % 30, &f);
        for (uint32_t plane = GN_OUT_NEAR; plane <= GN_OUT_TOP; plane <<= 1)
            if (plane_distance(v, plane, &f) < 0) expected |= plane;
        HOLDS(&t, gn_outcode(v, f.near, f.side, 0) == expected, "(%d, %d, %d)", (int)v[0], (int)v[1], (int)v[2]);
    }
    CHECK_TALLY(t, "gn_outcode");
}

/* How far outside of a plane a vertex lies, in LSB of its coordinates: moving each by one changes the distance by side
 * + 1. */
static long double overshoot(const int32_t v[3], uint32_t plane, const frustum *f)
{
    i128 d = plane_distance(v, plane, f);
    long double lsb = plane == GN_OUT_NEAR ? 1.0L : 65536.0L + (long double)f->side[plane >= GN_OUT_BOTTOM];
    return d < 0 ? -(long double)d / lsb : 0.0L;
}

/* One plane at a time: the vertices inside stay, each edge that crosses gains one, and nothing else happens. */
static int step_ok(gn_polygon *p, uint32_t plane, const frustum *f)
{
    int n_expected = 0, inside[GN_CLIP_VERTICES_MAX], n = p->n;
    gn_polygon before = *p;
    for (int i = 0; i < n; i++) inside[i] = plane_distance(before.v_q16[i], plane, f) >= 0;
    for (int i = 0; i < n; i++) n_expected += inside[i] + (inside[i] != inside[(i + 1) % n]);
    gn_clip(p, &uncut, plane, f->near, f->side, 0);
    if (n_expected < 3) return p->n == 0;
    if (p->n != n_expected || p->n > GN_CLIP_VERTICES_MAX) return 0;
    for (int i = 0, out = 0; i < n; i++) {
        if (inside[i] && memcmp(p->v_q16[out++], before.v_q16[i], sizeof before.v_q16[i])) return 0;
        if (inside[i] == inside[(i + 1) % n]) continue;
        if (plane == GN_OUT_NEAR && p->v_q16[out][2] != f->near) return 0;
        out++;
    }
    return 1;
}

typedef struct {
    long double n[3], height; /* unit normal; the smallest height of the triangle in LSB */
} face;

static void cross(long double out[3], const long double a[3], const long double b[3])
{
    for (int k = 0; k < 3; k++) out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static long double dot(const long double a[3], const long double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void edge(long double out[3], const gn_polygon *p, int from)
{
    for (int k = 0; k < 3; k++) out[k] = (long double)p->v_q16[(from + 1) % p->n][k] - (long double)p->v_q16[from][k];
}

static face face_of(const gn_polygon *triangle)
{
    face f;
    long double e[3][3], longest = 0;
    for (int i = 0; i < 3; i++) {
        edge(e[i], triangle, i);
        longest = fmaxl(longest, sqrtl(dot(e[i], e[i])));
    }
    cross(f.n, e[0], e[1]);
    long double length = sqrtl(dot(f.n, f.n));
    f.height = length > 0 ? length / longest : 0;
    for (int k = 0; k < 3 && length > 0; k++) f.n[k] /= length;
    return f;
}

/* Vertices lie in the triangle's plane and turn one way, as far as their rounding allows. */
static int flat_and_convex(const gn_polygon *p, const gn_polygon *triangle)
{
    face f = face_of(triangle);
    if (f.height < 64.0L) return 1; /* slivers have no orientation that rounding leaves alone */
    for (int i = 0; i < p->n; i++) {
        long double a[3], b[3], turn[3], rise = 0;
        for (int k = 0; k < 3; k++) rise += f.n[k] * ((long double)p->v_q16[i][k] - (long double)triangle->v_q16[0][k]);
        if (fabsl(rise) > 2.0L * CUT_LSB) return 0;
        edge(a, p, i);
        edge(b, p, (i + 1) % p->n);
        cross(turn, a, b);
        if (dot(turn, f.n) < -2.0L * CUT_LSB * (sqrtl(dot(a, a)) + sqrtl(dot(b, b)) + 2.0L * CUT_LSB)) return 0;
    }
    return 1;
}

/* What clipping leaves lies inside, is flat and convex. [R3] */
static void test_triangles(void)
{
    tally inside = {0}, steps = {0}, shape = {0};
    worst w = {0};
    int most = 0;
    for (uint32_t i = 0; i < 120000; i++) {
        frustum f = random_frustum();
        gn_polygon triangle = {.n = 3}, p, q;
        uint32_t bits = 3 + rng_below(&random_state, 28);
        for (int k = 0; k < 3; k++) random_point(triangle.v_q16[k], bits, &f);
        if (i % 2 == 0) tight_triangle(&triangle, &f);
        if (i % 7 == 0)
            memcpy(triangle.v_q16[2], triangle.v_q16[rng_below(&random_state, 2)], sizeof triangle.v_q16[2]);
        uint32_t planes = outcodes(&triangle, &f);
        p = q = triangle;
        gn_clip(&p, &uncut, planes, f.near, f.side, 0);
        int ok = 1;
        for (uint32_t plane = GN_OUT_NEAR; plane <= GN_OUT_TOP && q.n; plane <<= 1)
            if (planes & plane) ok = ok && step_ok(&q, plane, &f);
        ok = ok && p.n == q.n && !memcmp(p.v_q16, q.v_q16, (size_t)(unsigned)p.n * sizeof p.v_q16[0]);
        HOLDS(&steps, ok, "case %u: %d vertices, planes %u", (unsigned)i, p.n, (unsigned)planes);
        most = p.n > most ? p.n : most;
        for (int k = 0; k < p.n; k++) {
            for (uint32_t plane = GN_OUT_NEAR; plane <= GN_OUT_TOP; plane <<= 1) {
                long double e = overshoot(p.v_q16[k], plane, &f);
                WORST(&w, e, "case %u, plane %u", (unsigned)i, (unsigned)plane);
                HOLDS(&inside, e <= (plane == GN_OUT_NEAR ? NEAR_LSB : CUT_LSB),
                      "case %u: vertex %d outside plane %u by %.3Lf LSB", (unsigned)i, k, (unsigned)plane, e);
            }
            for (int c = 0; c < 3; c++)
                HOLDS(&inside, i128_abs(p.v_q16[k][c]) <= LIMIT, "case %u: beyond the limit", (unsigned)i);
        }
        HOLDS(&shape, flat_and_convex(&p, &triangle), "case %u", (unsigned)i);
    }
    CHECK_TALLY(steps, "each plane cuts where edges cross it");
    CHECK_TALLY(inside, "vertices lie inside, up to rounding");
    CHECK_TALLY(shape, "flat and convex");
    CHECK_EQ_INT(most, GN_CLIP_VERTICES_MAX);
    printf("gn_clip: outside by at most %.3Lf LSB (%s); up to %d vertices\n", w.error, w.at, most);
}

/* ---- Two triangles on an edge ------------------------------------------------------------------------------------ */

/* The triangle (a, b, c) from any of its vertices on, cut by all planes. By those alone that its own vertices are
 * outside of would not do: a cut vertex may be rounded to the far side of another plane, and then one neighbour cuts
 * once more. */
static gn_polygon clipped(const int32_t a[3], const int32_t b[3], const int32_t c[3], uint32_t first, const frustum *f)
{
    gn_polygon p = {.n = 3};
    const int32_t *const v[3] = {a, b, c};
    for (uint32_t i = 0; i < 3; i++) memcpy(p.v_q16[i], v[(i + first) % 3], sizeof p.v_q16[i]);
    gn_clip(&p, &uncut, ALL_PLANES, f->near, f->side, 0);
    return p;
}

static int has_vertex(const gn_polygon *p, const int32_t v[3])
{
    for (int i = 0; i < p->n; i++)
        if (!memcmp(p->v_q16[i], v, sizeof p->v_q16[i])) return 1;
    return 0;
}

/* What remains of the edge b c, whichever triangle it belongs to, is the edge cut on its own. */
static void test_shared_edge(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 120000; i++) {
        frustum f = random_frustum();
        int32_t v[4][3];
        uint32_t bits = 3 + rng_below(&random_state, 28);
        for (int k = 0; k < 4; k++) random_point(v[k], bits, &f);
        gn_polygon alone = clipped(v[1], v[2], v[2], 0, &f);
        gn_polygon left = clipped(v[0], v[1], v[2], rng_below(&random_state, 3), &f);
        gn_polygon right = clipped(v[3], v[2], v[1], rng_below(&random_state, 3), &f);
        for (int k = 0; k < alone.n; k++)
            HOLDS(&t, has_vertex(&left, alone.v_q16[k]) && has_vertex(&right, alone.v_q16[k]), "case %u: (%d, %d, %d)",
                  (unsigned)i, (int)alone.v_q16[k][0], (int)alone.v_q16[k][1], (int)alone.v_q16[k][2]);
    }
    CHECK_TALLY(t, "both triangles get the same vertices on their edge");
}

/* ---- Coverage ---------------------------------------------------------------------------------------------------- */

enum { SIZE = 64, GUARD_PX = 1000 };

typedef struct {
    frustum f;
    int32_t focal2_q16, bits; /* rays are (2x + 1 - SIZE, SIZE - 1 - 2y, 2F) */
} camera;

static void project(const camera *c, const int32_t v[3], int32_t *x, int32_t *y)
{
    i128 scale = (i128)c->focal2_q16 * ((i128)1 << c->bits), whole = (i128)v[2] * 131072;
    *x = (SIZE << c->bits) / 2 + (int32_t)i128_floor_div(2 * v[0] * scale + whole, 2 * whole);
    *y = (SIZE << c->bits) / 2 - (int32_t)i128_floor_div(2 * v[1] * scale + whole, 2 * whole);
}

typedef struct {
    int winding[SIZE][SIZE], n[SIZE][SIZE];
} canvas;

static void draw(canvas *out, const camera *c, const gn_polygon *p)
{
    int32_t x[GN_CLIP_VERTICES_MAX], y[GN_CLIP_VERTICES_MAX], row, xa, xb;
    for (int i = 0; i < p->n; i++) project(c, p->v_q16[i], &x[i], &y[i]);
    for (int i = 1; i + 1 < p->n; i++) {
        int32_t tx[3] = {x[0], x[i], x[i + 1]}, ty[3] = {y[0], y[i], y[i + 1]};
        int sign = exact_area(tx, ty) < 0 ? 1 : -1;
        gn_walk walk;
        if (!gn_walk_begin(&walk, tx, ty, c->bits, 0, SIZE)) continue;
        while (gn_walk_row(&walk, &row, &xa, &xb))
            for (int32_t px = xa < 0 ? 0 : xa; px < xb && px < SIZE; px++) {
                out->winding[row][px] += sign;
                out->n[row][px]++;
            }
    }
}

typedef struct {
    long double v[3][3], edge[3][3], n[3], det;
} exact_triangle;

static exact_triangle exact_of(const int32_t a[3], const int32_t b[3], const int32_t c[3])
{
    exact_triangle t;
    long double e1[3], e2[3];
    for (int k = 0; k < 3; k++)
        t.v[0][k] = (long double)a[k], t.v[1][k] = (long double)b[k], t.v[2][k] = (long double)c[k];
    for (int i = 0; i < 3; i++) cross(t.edge[i], t.v[i], t.v[(i + 1) % 3]);
    for (int k = 0; k < 3; k++) e1[k] = t.v[1][k] - t.v[0][k], e2[k] = t.v[2][k] - t.v[0][k];
    cross(t.n, e1, e2);
    t.det = dot(t.n, t.v[0]);
    return t;
}

/* A line on the screen, l . ray = value: how many pixels away, with the sign of its side. */
static long double line_px(const long double l[3], long double value, const long double ray[3])
{
    long double slope = 2 * sqrtl(l[0] * l[0] + l[1] * l[1]);
    return slope > 0 ? (dot(l, ray) - value) / slope : 1e9L;
}

/* +1 or -1 where the triangle is hit beyond the near plane, by orientation; 0 where it is not; 2 too close to its
 * border or to the near plane to say. Edge 1, the shared one, has no margin: whatever is decided there, the neighbour
 * decides the other way. */
static int exact_hit(const exact_triangle *t, const long double ray[3], int32_t near)
{
    int sign = t->det > 0 ? 1 : -1, inside = 1;
    for (int i = 0; i < 3; i++) {
        long double d = line_px(t->edge[i], 0, ray) * (long double)sign;
        if (i != 1 && fabsl(d) < 1.0L) return 2;
        inside = inside && d >= 0;
    }
    /* Z = det ray_z / (n . ray): beyond the near plane where n . ray is below det ray_z / near */
    long double d = line_px(t->n, t->det * ray[2] / (long double)near, ray) * (long double)sign;
    if (fabsl(d) < 1.0L) return 2;
    return inside && d < 0 ? sign : 0;
}

static void check_coverage(tally *t, unsigned long *n_folded, const camera *c, int32_t v[4][3], uint32_t scene)
{
    static canvas out;
    exact_triangle exact[2] = {exact_of(v[0], v[1], v[2]), exact_of(v[3], v[2], v[1])};
    for (int i = 0; i < 2; i++)
        if (face_of(&(gn_polygon){.v_q16 = {{v[3 * i][0], v[3 * i][1], v[3 * i][2]},
                                            {v[1][0], v[1][1], v[1][2]},
                                            {v[2][0], v[2][1], v[2][2]}},
                                  .n = 3})
                .height < 64)
            return;
    gn_polygon left = clipped(v[0], v[1], v[2], rng_below(&random_state, 3), &c->f);
    gn_polygon right = clipped(v[3], v[2], v[1], rng_below(&random_state, 3), &c->f);
    memset(&out, 0, sizeof out);
    draw(&out, c, &left);
    draw(&out, c, &right);
    for (int py = 0; py < SIZE; py++)
        for (int px = 0; px < SIZE; px++) {
            long double ray[3] = {2 * px + 1 - SIZE, SIZE - 1 - 2 * py, (long double)c->focal2_q16 / 65536};
            int a = exact_hit(&exact[0], ray, c->f.near), b = exact_hit(&exact[1], ray, c->f.near);
            if (a == 2 || b == 2) continue;
            HOLDS(t, out.winding[py][px] == a + b, "scene %u at (%d, %d): %d, not %d %+d", (unsigned)scene, px, py,
                  out.winding[py][px], a, b);
            if (a + b == out.winding[py][px] && a * b == 0 && out.n[py][px] != (a || b)) ++*n_folded;
        }
}

/* Two triangles on an edge that crosses the picture, some of their corners behind the camera or far beyond the guard
 * band. */
static void test_coverage(void)
{
    tally t = {0};
    unsigned long n_folded = 0;
    for (uint32_t i = 0; i < 600; i++) {
        camera c;
        int32_t v[4][3];
        c.bits = 2 + (int32_t)(i % 7);
        c.focal2_q16 = rng_range(&random_state, 20 << 16, 200 << 16);
        c.f.near = rng_range(&random_state, 1 << 13, 1 << 17);
        for (int k = 0; k < 2; k++) c.f.side[k] = (int32_t)(((int64_t)(SIZE + 2 * GUARD_PX) << 32) / c.focal2_q16) + 1;
        /* the middle of the shared edge is in sight, its ends lie in opposite directions from there */
        int32_t depth = c.f.near * 2 + rng_range(&random_state, 0, 1 << 22),
                reach = 1 << rng_range(&random_state, 16, 27);
        for (int k = 0; k < 3; k++) {
            int32_t centre = k == 2 ? depth : rng_range(&random_state, -depth / 8, depth / 8),
                    along = rng_range(&random_state, -reach, reach);
            v[1][k] = centre + along;
            v[2][k] = centre - along;
            v[0][k] = rng_range(&random_state, -reach, reach);
            v[3][k] = 2 * centre - v[0][k];
        }
        check_coverage(&t, &n_folded, &c, v, i);
    }
    CHECK_TALLY(t, "two triangles on an edge cover its surroundings exactly once");
    printf("coverage: %lu pixels, %lu covered more than once where rounding folds a clipped polygon\n", t.n, n_folded);
    CHECK(n_folded <= t.n / 10000);
}

int main(void)
{
    test_outcode();
    test_triangles();
    test_shared_edge();
    test_coverage();
    return check_report();
}
