/* Records as small triangles, against double precision: weights, depths, normals, places, levels of textures, and
 * values between the corners. The bounds follow from the formats of lib/shade/gn_record.c. */
#include <math.h>
#include <string.h>

#include "base/gn_math.h"
#include "check.h"
#include "exact.h"
#include "knobs.h"
#include "rng.h"
#include "shade/gn_patch.h"

#if GN_INTERPOLATES

enum { CASES = 20000 };

static rng random_state = {45};
static gn_frame frame;
static uint16_t idx[3] = {10, 11, 12};
static gn_mesh mesh = {.idx = idx, .n_vertices = 13, .n_triangles = 1};
static gn_object object = {.mesh = &mesh};
static gn_scene scene = {.objects = &object, .n_objects = 1};

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * rng_u32(&random_state) / 4294967296.0;
}

/* ---- Random records ---------------------------------------------------------------------------------------------- */

static gn_tri tri;
static int32_t bits;

static void any_picture(void)
{
    const int32_t near_log2 = rng_range(&random_state, 8, 20);
    frame.scene = &scene;
    frame.picture.width = (uint16_t)rng_range(&random_state, 1, 2048);
    frame.picture.height = (uint16_t)rng_range(&random_state, 1, 2048);
    frame.cam.near_q16 = rng_range(&random_state, 1 << near_log2, (2 << near_log2) - 1);
    frame.cam.focal2_px_q16 = (uint32_t)(uniform(0.3, 3) * fmax(frame.picture.width, 16) * 131072.0);
}

/* Corners of any shape, slivers among them, the top first, with some area. Returns 0 if there is none. */
static int any_corners(int32_t longest_px)
{
    const int32_t one = 1 << bits, w = (frame.picture.width << bits) / 2, h = (frame.picture.height << bits) / 2;
    const int32_t x = rng_range(&random_state, -w, w), y = rng_range(&random_state, -h, h),
                  size = rng_range(&random_state, 1, longest_px * one);
    const int thin = rng_below(&random_state, 4) == 0;
    for (int k = 0; k < 3; k++) {
        tri.x[k] = (gn_coord)(x + rng_range(&random_state, 0, size));
        tri.y[k] = (gn_coord)(y + (thin ? rng_range(&random_state, 0, 3) : rng_range(&random_state, 0, size)));
    }
    for (int k = 1; k < 3; k++)
        if (tri.y[k] < tri.y[0]) {
            const gn_coord sx = tri.x[0], sy = tri.y[0];
            tri.x[0] = tri.x[k], tri.y[0] = tri.y[k], tri.x[k] = sx, tri.y[k] = sy;
        }
    const int64_t area =
        (int64_t)(tri.x[1] - tri.x[0]) * (tri.y[2] - tri.y[0]) - (int64_t)(tri.x[2] - tri.x[0]) * (tri.y[1] - tri.y[0]);
    if (area > 0) {
        const gn_coord sx = tri.x[1], sy = tri.y[1];
        tri.x[1] = tri.x[2], tri.y[1] = tri.y[2], tri.x[2] = sx, tri.y[2] = sy;
    }
    return area != 0;
}

/* From corner 0 to the centre of its pixel, pixels. */
static double to_centre(int axis)
{
    const int32_t size = axis ? frame.picture.height : frame.picture.width, one = 1 << bits,
                  at = (axis ? tri.y[0] : tri.x[0]) + ((size << bits) >> 1);
    return 0.5 - (double)(at & (one - 1)) / one;
}

/* near / Z at a corner by the record's plane, in units of 2^-32. */
static double nearness(int k)
{
    const double one = 1 << bits;
    return tri.iz_ref + tri.iz_dx * ((tri.x[k] - tri.x[0]) / one - to_centre(0)) +
           tri.iz_dy * ((tri.y[k] - tri.y[0]) / one - to_centre(1));
}

/* A plane of near / Z from 2^least_log2 units up, that changes by up to `most` of itself. Returns 0 if a record would
 * hold bounds for it. */
static int any_plane(int32_t least_log2, double most)
{
    const double i0 = exp2(uniform(least_log2, 31.9)), change = uniform(0, 1) < 0.2 ? 0 : uniform(0, most),
                 i1 = i0 * (1 + uniform(-change, change) / 2), i2 = i0 * (1 + uniform(-change, change) / 2);
    const double one = 1 << bits, ax = (tri.x[1] - tri.x[0]) / one, ay = (tri.y[1] - tri.y[0]) / one,
                 bx = (tri.x[2] - tri.x[0]) / one, by = (tri.y[2] - tri.y[0]) / one, area = ax * by - bx * ay;
    const double dx = ((i1 - i0) * by - (i2 - i0) * ay) / area, dy = ((i2 - i0) * ax - (i1 - i0) * bx) / area;
    const double margin = (fabs(dx) + fabs(dy)) / (2 * one) + 4097, least = fmin(i0, fmin(i1, i2)),
                 ref = i0 + dx * to_centre(0) + dy * to_centre(1);
    if (margin > 1 << 18 || least < margin || fmax(i0, fmax(i1, i2)) > 4294967295.0 - margin) return 0;
    if (ref < 8 || ref > 4294967280.0) return 0;
    tri.iz_dx = (int32_t)lround(dx), tri.iz_dy = (int32_t)lround(dy);
    tri.iz_ref = ((uint32_t)ref & ~7U) | (uint32_t)rng_range(&random_state, 1, 6);
    gn_tri_set_walk(&tri, GN_TRI_EXACT);
    return 1;
}

/* The next one that is a patch. */
static void any_record(gn_patch_record *r)
{
    do any_picture();
    while (!any_corners(32) || !any_plane(13, 0.6) || !gn_record_begin(r, &frame, &tri));
}

/* ---- What begins ------------------------------------------------------------------------------------------------- */

/* Which vertices the corners are, how large the box is, near / Z; and what is refused. */
static void test_begin(void)
{
    static const int vertex[7][3] = {{0, 0, 0}, {0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    gn_patch_record r;
    tally t = {0}, near = {0}, refused = {0};
    for (int i = 0; i < CASES; i++) {
        any_picture();
        if (!any_corners(40) || !any_plane(13, 1.5)) continue;
        const int small = gn_record_begin(&r, &frame, &tri), order = (int)gn_tri_order(&tri);
        double most = 0, least = HUGE_VAL, lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
        for (int k = 0; k < 3; k++) {
            most = fmax(most, nearness(k)), least = fmin(least, nearness(k));
            lo[0] = fmin(lo[0], tri.x[k]), hi[0] = fmax(hi[0], tri.x[k]);
            lo[1] = fmin(lo[1], tri.y[k]), hi[1] = fmax(hi[1], tri.y[k]);
        }
        const int px = (int)ceil(fmax(hi[0] - lo[0], hi[1] - lo[1]) / (1 << bits));
        /* two roundings down */
        const double lost = 2, ratio = most / least;
        const int wide = frame.picture.width >= 64 && frame.picture.height >= 64;
        const double units = least / (frame.cam.focal2_px_q16 / 8192.0); /* of near / Z, of 16 for a pixel */
        if (fabs(ratio - 1.5) > 16 / least && fabs(units - 1) > 16 / least)
            HOLDS(&refused, small == (wide && px <= GN_PATCH_PX && ratio < 1.5 && units > 1),
                  "%d pixels, near / Z changes by %g, from %g units on", px, ratio, units);
        if (!small) continue;
        /* pieces of rows, a q-th of an eighth of their length off, of what is not so even that all weights are straight
         */
        const int fine = GN_K(&frame, persp_step) < 16, across = (int)(hi[0] - lo[0]) >> bits;
        const double piece = across < 16 ? across : 16,
                     off = fabs((double)tri.iz_dx) * piece * piece / least * (1 + fine);
        if (fabs(off - 1) > 0.001) HOLDS(&refused, r.bent == (r.deep && off > 1), "%g of the limit", off);
        HOLDS(&t, r.px == px && r.back == (order > 3), "%d pixels, not %d", (int)r.px, px);
        for (int k = 0; k < 3; k++) {
            HOLDS(&t, r.vertex[k] == 10 + vertex[order][k], "corner %d of order %d is vertex %d", k, order,
                  r.vertex[k]);
            const double e = r.iz_q32[k] - nearness(k);
            HOLDS(&near, e <= 0 && e > -lost, "off by %g, %d bits", e, (int)bits);
        }
        tri.iz_ref &= ~7U;
        HOLDS(&refused, !gn_record_begin(&r, &frame, &tri), "cut");
        tri.iz_ref |= GN_TRI_STEEP;
        HOLDS(&refused, !gn_record_begin(&r, &frame, &tri), "steep");
        tri.iz_ref--, tri.iz.bounds.least = 5, tri.iz.bounds.largest = 6;
        HOLDS(&refused, !gn_record_begin(&r, &frame, &tri), "bounded");
    }
    CHECK_TALLY(t, "corners and box");
    CHECK_TALLY(near, "near / Z at corners");
    CHECK_TALLY(refused, "what is a patch");
}

/* ---- Weights ----------------------------------------------------------------------------------------------------- */

static void compare_weights(const gn_patch_record *r, int32_t px, int32_t py, const int32_t x[3], const int32_t y[3],
                            tally *flat, tally *deep)
{
    const double one = 1 << bits, qx = (px + 0.5) * one, qy = (py + 0.5) * one, area = (double)-exact_area(x, y);
    const double e1 = (x[2] - x[0]) * (qy - y[0]) - (y[2] - y[0]) * (qx - x[0]),
                 e2 = (y[1] - y[0]) * (qx - x[0]) - (x[1] - x[0]) * (qy - y[0]);
    const double w1 = e1 / area, w2 = e2 / area, n0 = r->iz_q32[0], n1 = r->iz_q32[1], n2 = r->iz_q32[2],
                 all = (1 - w1 - w2) * n0 + w1 * n1 + w2 * n2, p1 = w1 * n1 / all, p2 = w2 * n2 / all;
    const gn_patch_weights w = gn_record_weights(r, &frame, px, py);
    const double most = fmax(n0, fmax(n1, n2)), least = fmin(n0, fmin(n1, n2));
    HOLDS(flat, w.of[0] >= 0 && w.of[1] >= 0 && w.of[0] + w.of[1] <= 32768, "%d, %d", (int)w.of[0], (int)w.of[1]);
    if (!r->deep) {
        /* the edge function and the product are rounded down by a unit each; the reciprocal is off by 2^-15: a unit */
        const double d1 = w.of[0] - 32768 * w1, d2 = w.of[1] - 32768 * w2;
        HOLDS(flat, d1 > -3 && d1 <= 1 && d2 > -3 && d2 <= 1, "weights off by %g, %g", d1, d2);
        /* straight instead of bent: a quarter of the change, which is at most 1/2 or 1/4 over the box, less what the
         * comparison's six bits lose */
        const int32_t down = 7 + (GN_K(&frame, persp_step) < 16);
        const double change = 64 * (least / (1 << down) / r->px + 1);
        HOLDS(flat, most - least <= change, "near / Z changes by %g, %d pixels", most / least - 1, (int)r->px);
        HOLDS(flat, fabs(w.of[0] / 32768.0 - p1) <= change / least / 4 + 3 / 32768.0, "bent by %g",
              w.of[0] / 32768.0 - p1);
        return;
    }
    /* weights 3, near / Z over corner 0's 2.75 / 2^14 (half, reciprocal, product), products 1: 8.3 in all of a sum of
     * at least 2/3; its reciprocal and the product 2 more */
    const double d1 = w.of[0] - 32768 * p1, d2 = w.of[1] - 32768 * p2;
    HOLDS(deep, fabs(d1) < 14.5 && fabs(d2) < 14.5, "weights off by %g, %g; near / Z changes by %g", d1, d2,
          most / least);
}

static void test_weights(void)
{
    gn_patch_record r;
    tally flat = {0}, deep = {0};
    for (int i = 0; i < CASES / 4; i++) {
        int32_t x[3], y[3];
        any_record(&r);
        for (int k = 0; k < 3; k++) {
            x[k] = tri.x[k] + ((frame.picture.width << bits) >> 1);
            y[k] = tri.y[k] + ((frame.picture.height << bits) >> 1);
        }
        for (int32_t py = r.y0; py <= r.y0 + r.px; py++)
            for (int32_t px = r.x0 - r.px - 1; px <= r.x0 + r.px + 1; px++)
                if (exact_covers(x, y, bits, px, py)) compare_weights(&r, px, py, x, y, &flat, &deep);
    }
    CHECK_TALLY(flat, "weights, hardly any depth");
    CHECK_TALLY(deep, "weights, with depth");
}

/* ---- Depths, normals, places ------------------------------------------------------------------------------------- */

static void test_depths(void)
{
    gn_patch_record r;
    tally t = {0};
    for (int i = 0; i < CASES; i++) {
        any_record(&r);
        gn_record_find_depths(&r, &frame);
        for (int k = 0; k < 3; k++) {
            const double z = ldexp(frame.cam.near_q16, 32) / r.iz_q32[k];
            if (z >= 2147483647.0) continue;
            /* a reciprocal of one Newton step, 2^-17, and bits below the 28th; then below Q16 */
            HOLDS(&t, fabs(ldexp(r.z[k], -r.z_up) / z - 1) < ldexp(1, -17) + ldexp(1, -25), "depth %g of %g",
                  ldexp(r.z[k], -r.z_up), z);
            HOLDS(&t, fabs(gn_record_depth(&r, k) - z) < z * (ldexp(1, -17) + ldexp(1, -25)) + 1, "depth %d of %g",
                  (int)gn_record_depth(&r, k), z);
        }
    }
    CHECK_TALLY(t, "depths at corners");
}

/* The face's normal by the plane of near / Z: near / Z at a ray is n . ray, and it points away from the viewer. */
static void exact_face(const gn_patch_record *r, double n[3])
{
    const double f = frame.cam.focal2_px_q16 / 131072.0, x = r->x0 + 0.5 - frame.picture.width / 2.0,
                 y = r->y0 + 0.5 - frame.picture.height / 2.0;
    n[0] = -tri.iz_dx * f, n[1] = tri.iz_dy * f, n[2] = -(tri.iz_ref - tri.iz_dx * x - tri.iz_dy * y);
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; i++) n[i] /= length;
}

static void test_faces(void)
{
    gn_patch_record r;
    tally t = {0};
    for (int i = 0; i < CASES; i++) {
        int32_t view_q14[3];
        double n[3];
        any_record(&r);
        gn_record_face(&r, &frame, view_q14);
        exact_face(&r, n);
        /* axes lose less than a bit of 15: sqrt(3) of a length of at least 2^14; results another, the root 2^-15 */
        for (int k = 0; k < 3; k++)
            HOLDS(&t, fabs(view_q14[k] - 16384 * n[k]) < sqrt(3) + 1.5, "axis %d: %d, not %g", k, (int)view_q14[k],
                  16384 * n[k]);
    }
    int32_t zero[3] = {0, 0, 0};
    gn_normalise_15(zero);
    HOLDS(&t, !zero[0] && !zero[1] && !zero[2], "0 stays 0");
    CHECK_TALLY(t, "normals of faces");
}

static void any_ray_plane(gn_ray_plane *plane)
{
    const double least = exp2(uniform(-12, 0)), w = frame.picture.width + 64, h = frame.picture.height + 64;
    plane->a0 = (int32_t)(uniform(-1, 1) * least * (1 << 30));
    plane->ax = (int32_t)(uniform(-1, 1) * least * (1 << 29) / w);
    plane->ay = (int32_t)(uniform(-1, 1) * least * (1 << 29) / h);
    plane->d_q16 = rng_range(&random_state, -(1 << 28), 1 << 28);
}

static void test_places(void)
{
    gn_patch_record r;
    gn_ray_plane plane;
    tally t = {0};
    for (int i = 0; i < CASES; i++) {
        int32_t at[3];
        double one, exact[3], off[3], most = 0;
        any_record(&r);
        any_ray_plane(&plane);
        gn_record_find_depths(&r, &frame);
        one = 1 << bits;
        const int32_t ray_shift = rng_range(&random_state, 4, 30), up = 32 - ray_shift - r.z_up;
        for (int k = 0; k < 3; k++) {
            const double z = ldexp(r.z[k], -r.z_up), x = 2 * tri.x[k] / one, y = -2 * tri.y[k] / one;
            const double cx = (frame.picture.width << bits >> 1) * 2 / one - frame.picture.width,
                         cy = frame.picture.height - (frame.picture.height << bits >> 1) * 2 / one;
            exact[k] = ldexp(z * (plane.a0 + plane.ax * (x + cx) + plane.ay * (y + cy)), -ray_shift);
            /* a ray loses a unit for each step of the subpixel grid, on both axes; the product one, then one of Q16 */
            off[k] = ldexp(z * 2 * (r.px + 1) * one, -ray_shift) + ldexp(1, up) + 1;
            most = fmax(most, fabs(exact[k]));
        }
        if (most > 1 << 29) continue;
        gn_record_places(&r, &frame, &plane, ray_shift, at);
        for (int k = 0; k < 3; k++)
            HOLDS(&t, fabs(at[k] - exact[k] - (double)plane.d_q16) <= off[k], "corner %d: %d, not %g +- %g", k,
                  (int)at[k], exact[k] + (double)plane.d_q16, off[k]);
    }
    CHECK_TALLY(t, "places of corners");
}

/* ---- Levels of textures ------------------------------------------------------------------------------------------ */

/* MODEL 8, for the depth of corner 0's pixel: 2 log2(S Z^2 / (F d)), with the product of the corners' depths for Z^3.
 */
static double exact_level2(double texels2)
{
    const double f = frame.cam.focal2_px_q16 / 131072.0, one = 1 << bits;
    double v[3][3], n[3], z = ldexp(frame.cam.near_q16, 16) / tri.iz_ref, product = z;
    for (int k = 0; k < 3; k++) {
        const double depth = ldexp(frame.cam.near_q16, 16) / nearness(k);
        v[k][0] = tri.x[k] / one / f * depth, v[k][1] = -tri.y[k] / one / f * depth, v[k][2] = depth;
        product *= depth;
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        n[i] = (v[1][j] - v[0][j]) * (v[2][l] - v[0][l]) - (v[1][l] - v[0][l]) * (v[2][j] - v[0][j]);
    }
    const double area2 = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]),
                 d = fabs(n[0] * v[0][0] + n[1] * v[0][1] + n[2] * v[0][2]) / area2;
    return log2(texels2 / area2 * product / (f * f * d * d));
}

static void test_levels(void)
{
    gn_patch_record r;
    tally t = {0};
    for (int i = 0; i < CASES; i++) {
        int32_t view_q14[3];
        double n[3];
        any_record(&r);
        gn_record_face(&r, &frame, view_q14);
        exact_face(&r, n);
        const uint64_t texels = rng_wide_u64(&random_state, 54);
        const int32_t log2_ = rng_range(&random_state, -30, 2), focal2 = (int32_t)(frame.cam.focal2_px_q16 >> 16),
                      got = gn_record_level2(&r, &frame, view_q14, texels, log2_);
        const double x = 2 * r.x0 + 1 - frame.picture.width, y = frame.picture.height - 1 - 2 * r.y0,
                     facing = -(n[0] * x + n[1] * y + n[2] * focal2), all = fabs(x) + fabs(y) + focal2;
        /* four factors lose 2^-15, the focal length a pixel twice, the normal 5 units of Q14 */
        const double share = (ldexp(1, -13) + 1.0 / focal2 + (1 + 5 / 16384.0 * all) / facing);
        if (share < 0 || share > 0.5) continue; /* edge on */
        const double off = -log2(1 - share), exact = exact_level2(ldexp((double)texels, log2_));
        HOLDS(&t, got >= floor(exact - off) && got <= floor(exact + off), "%d, not %g +- %g", (int)got, exact, off);
    }
    CHECK_TALLY(t, "levels of textures");
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

static int32_t any_value(int32_t most_log2)
{
    return rng_range(&random_state, -(1 << most_log2), 1 << most_log2);
}

static gn_patch_weights any_weights(void)
{
    const int32_t all = rng_range(&random_state, 0, 32768), first = rng_range(&random_state, 0, all);
    const gn_patch_weights w = {{first, all - first}};
    return w;
}

static void test_values(void)
{
    tally at = {0}, row = {0};
    for (int i = 0; i < 10 * CASES; i++) {
        const int32_t most = rng_range(&random_state, 0, 29), n = rng_range(&random_state, 1, GN_PATCH_COVERS - 1),
                      v0 = any_value(most), v1 = any_value(most), v2 = any_value(most);
        gn_patch_span span = {{any_weights(), any_weights()}, n, 0};
        const gn_patch_weights *ends = span.ends;
        gn_patch_value value;
        gn_patch_set(&value, v0, v1, v2);
        const double unit = fmax(1, fmax(fabs((double)v1 - v0), fabs((double)v2 - v0)) / 16384),
                     exact = v0 + (ends[0].of[0] * ((double)v1 - v0) + ends[0].of[1] * ((double)v2 - v0)) / 32768;
        /* differences of 15 bits and a sign lose less than a unit each, times weights; the sum another */
        const double e = gn_patch_at(&value, ends[0]) - exact;
        HOLDS(&at, e <= 0 && e > -2 * unit, "%d, %d, %d: off by %g", (int)v0, (int)v1, (int)v2, e);
        const gn_row_value got = gn_patch_row(&value, &span);
        const double first = gn_patch_at(&value, ends[0]), change = gn_patch_at(&value, ends[1]) - first;
        HOLDS(&row, got.at == first, "a row begins with %d, not %g", (int)got.at, first);
        span.at = n / 2;
        HOLDS(&row, gn_patch_row(&value, &span).at == got.at + got.step * span.at,
              "pixel %d of %d differs where a run begins", (int)span.at, (int)n);
        /* a step is even and rounded down: 2 for each; the part of a row is off by n / 2^30 */
        for (int k = 1; k < n; k++)
            HOLDS(&row,
                  fabs(got.at + (double)k * got.step - first - change * k / (n - 1)) <=
                      2 * k + fabs(change) * n / 1073741824.0,
                  "pixel %d of %d: off by %g of %g", k, n, got.at + (double)k * got.step - first - change * k / (n - 1),
                  change);
    }
    CHECK_TALLY(at, "values at weights");
    CHECK_TALLY(row, "values along rows");
}

/* ------------------------------------------------------------------------------------------------------------------ */

static void test_all(void)
{
    bits = GN_K(&frame, subpixel_bits);
    test_begin();
    test_weights();
    test_depths();
    test_faces();
    test_places();
    test_levels();
}
#endif

int main(void)
{
#if GN_INTERPOLATES
    static const int32_t some_bits[3] = {4, 7, 8};
    for (int i = 0; i < 3; i++)
        for (int32_t step = 8; step <= 16; step += 8)
            if (TAKES_KNOB(&frame, subpixel_bits, some_bits[i]) && TAKES_KNOB(&frame, persp_step, step)) test_all();
    test_values();
#endif
    return check_report();
}
