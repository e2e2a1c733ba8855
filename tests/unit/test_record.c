/* Records as small triangles, against double precision: slopes, depths, normals, places, and levels of textures. The
 * bounds follow from the formats of lib/shade/gn_record.c. */
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

/* The pixel of values, corners from there in pixels, and near / Z at its centre. */
static double column, row, corner[3][2], middle;

static void find_middle(void)
{
    const int32_t one = 1 << bits, half_w = (frame.picture.width << bits) / 2,
                  half_h = (frame.picture.height << bits) / 2;
    double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < 3; k++) {
        lo[0] = fmin(lo[0], tri.x[k]), hi[0] = fmax(hi[0], tri.x[k]);
        lo[1] = fmin(lo[1], tri.y[k]), hi[1] = fmax(hi[1], tri.y[k]);
    }
    column = floor((floor((lo[0] + hi[0]) / 2) + half_w) / one),
    row = floor((floor((lo[1] + hi[1]) / 2) + half_h) / one);
    for (int k = 0; k < 3; k++) {
        corner[k][0] = (tri.x[k] + half_w) / (double)one - column - 0.5;
        corner[k][1] = (tri.y[k] + half_h) / (double)one - row - 0.5;
    }
    middle = tri.iz_ref + tri.iz_dx * (column - floor((tri.x[0] + half_w) / (double)one)) +
             tri.iz_dy * (row - floor((tri.y[0] + half_h) / (double)one));
}

/* Which vertices the corners are, how large the box is, near / Z; and what is refused. */
static void test_begin(void)
{
    static const int vertex[7][3] = {{0, 0, 0}, {0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    gn_patch_record r;
    tally t = {0}, refused = {0};
    long n_small = 0, n_deep = 0;
    for (int i = 0; i < CASES; i++) {
        any_picture();
        if (!any_corners(40) || !any_plane(13, 1.5)) continue;
        find_middle();
        const int small = gn_record_begin(&r, &frame, &tri), order = (int)gn_tri_order(&tri);
        double w = 0, h = 0;
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < 3; j++)
                w = fmax(w, corner[k][0] - corner[j][0]), h = fmax(h, corner[k][1] - corner[j][1]);
        const double w_px = ceil(w), h_px = ceil(h), px = fmax(w_px, h_px), dx = fabs((double)tri.iz_dx),
                     dy = fabs((double)tri.iz_dy), change = dx * w_px + dy * h_px,
                     area = fabs((corner[1][0] - corner[0][0]) * (corner[2][1] - corner[0][1]) -
                                 (corner[2][0] - corner[0][0]) * (corner[1][1] - corner[0][1])),
                     limit = GN_K(&frame, persp_step) == 16  ? 2
                             : GN_K(&frame, persp_step) == 8 ? 4
                                                             : 8;
        /* a quarter of the change, as a part of near / Z, times the box: by how many pixels what is linear is off */
        const double bend = change / middle * px / 4 * limit, near_one = 64 * px / middle * px / 4 * limit;
        const int wide = frame.picture.width >= 64 && frame.picture.height >= 64;
        const int holds = wide && px <= GN_PATCH_PX && fmax(dx, dy) < 1 << 26 && change <= floor(middle / 2) &&
                          middle >= frame.cam.focal2_px_q16 / 8192 && area >= px / 8 &&
                          (area >= px * px / 8 || bend <= 1) && middle < 4294967296.0;
        if (fabs(bend - 1) <= near_one + 0.01 && area < px * px / 8) continue; /* deep or not: 6 bits less */
        HOLDS(&refused, small == holds, "%g pixels, near / Z changes by %g, area %g", px, change / middle, area);
        if (!small) continue;
        n_small++;
        n_deep += r.deep;
        if (fabs(bend - 1) > near_one + 0.01) /* 6 bits less */
            HOLDS(&refused, r.deep == (bend > 1), "bent by %g pixels, %d", bend / limit, (int)r.deep);
        HOLDS(&t, r.px == px && r.back == (order > 3) && r.x == column && r.y == row, "%d pixels, not %g", (int)r.px,
              px);
        HOLDS(&t, r.iz_q32 == middle, "near / Z %u, not %g", (unsigned)r.iz_q32, middle);
        for (int k = 0; k < 3; k++)
            HOLDS(&t,
                  r.vertex[k] == 10 + vertex[order][k] && r.at[k][0] == corner[k][0] * (1 << bits) &&
                      r.at[k][1] == corner[k][1] * (1 << bits),
                  "corner %d of order %d is vertex %d", k, order, r.vertex[k]);
        tri.iz_ref &= ~7U;
        HOLDS(&refused, !gn_record_begin(&r, &frame, &tri), "cut");
        tri.iz_ref |= GN_TRI_STEEP;
        HOLDS(&refused, !gn_record_begin(&r, &frame, &tri), "steep");
        tri.iz_ref--, tri.iz.bounds.least = 5, tri.iz.bounds.largest = 6;
        HOLDS(&refused, !gn_record_begin(&r, &frame, &tri), "bounded");
    }
    CHECK_TALLY(t, "corners and box");
    CHECK_TALLY(refused, "what is a patch");
    CHECK(n_small > CASES / 20 && n_deep > n_small / 20 && n_deep < n_small);
}

/* Near / Z that leaves its 32 bits beside the triangle: none is a patch whose middle would have gone round. */
static void test_round(void)
{
    tally t = {0};
    for (int i = 0; i < CASES; i++) {
        gn_patch_record r;
        any_picture();
        if (!any_corners(32)) continue;
        find_middle();
        const double i0 = uniform(0, 1) < 0.5 ? uniform(8, 2000) : 4294967295.0 - uniform(8, 2000);
        tri.iz_ref = ((uint32_t)i0 & ~7U) | 1U;
        tri.iz_dx = rng_range(&random_state, -300, 300), tri.iz_dy = rng_range(&random_state, -300, 300);
        gn_tri_set_walk(&tri, GN_TRI_EXACT);
        find_middle();
        const double least = fmin(nearness(0), fmin(nearness(1), nearness(2))),
                     largest = fmax(nearness(0), fmax(nearness(1), nearness(2)));
        if (least > 0 && largest < 4294967296.0 && gn_record_begin(&r, &frame, &tri))
            HOLDS(&t, r.iz_q32 == middle, "near / Z %u, not %g", (unsigned)r.iz_q32, middle);
    }
    CHECK_TALLY(t, "near / Z beside triangles");
}

/* ---- Slopes ------------------------------------------------------------------------------------------------------ */

/* What weights of corners 1 and 2 change by per pixel. */
static void exact_parts(double part[2][2])
{
    const double ax = corner[1][0] - corner[0][0], ay = corner[1][1] - corner[0][1], bx = corner[2][0] - corner[0][0],
                 by = corner[2][1] - corner[0][1], area = bx * ay - ax * by;
    part[0][0] = -by / area, part[0][1] = bx / area, part[1][0] = ay / area, part[1][1] = -ax / area;
}

/* near / Z over that in the middle, so far from there. */
static double ratio_at(double x, double y)
{
    return 1 + (tri.iz_dx * x + tri.iz_dy * y) / middle;
}

/* Perspective's value so far from the middle; of what is not deep, a plane's. */
static double exact_value(const gn_patch_record *r, const int32_t v[3], double x, double y)
{
    double part[2][2], sum = 0, to_x = x - corner[0][0], to_y = y - corner[0][1];
    exact_parts(part);
    for (int k = 0; k < 2; k++) {
        const double near = r->deep ? ratio_at(corner[k + 1][0], corner[k + 1][1]) / ratio_at(x, y) : 1;
        sum += ((double)v[k + 1] - v[0]) * near * (part[k][0] * to_x + part[k][1] * to_y);
    }
    return v[0] + sum;
}

/* A piece of a row: between the exact values at both ends. */
static double exact_piece(const gn_patch_record *r, const int32_t v[3], int32_t px, int32_t py)
{
    if (!r->deep) return exact_value(r, v, px - r->x, py - r->y);
    const double first = exact_value(r, v, r->row.first - r->x, py - r->y), n = r->row.last - r->row.first,
                 last = exact_value(r, v, r->row.last - r->x, py - r->y);
    return first + (n ? (last - first) * (px - r->row.first) / n : 0);
}

static void compare_slope(gn_patch_record *r, const gn_slope *slope, const int32_t v[3], const int32_t x[3],
                          const int32_t y[3], tally *t)
{
    double part[2][2], off[2];
    const double d1 = fabs((double)v[1] - v[0]), d2 = fabs((double)v[2] - v[0]),
                 unit = fmax(1, ldexp(fmax(d1, d2), -14)), step = ldexp(1, -r->part_shift);
    exact_parts(part);
    for (int i = 0; i < 2; i++) /* differences lose less than a unit each; parts a step, and 2^-14.9 of themselves; the
                                   result 1; of deep ones, near / Z 2^-15, too, the difference and the result another */
        off[i] = (r->deep ? 4 : 1) * (unit * (fabs(part[0][i]) + fabs(part[1][i]) + 2 * step) + (d1 + d2) * step +
                                      (d1 * fabs(part[0][i]) + d2 * fabs(part[1][i])) * ldexp(1.1, -15) + 1);
    for (int32_t py = r->y - r->px; py <= r->y + r->px; py++)
        for (int32_t px = r->x - r->px; px <= r->x + r->px; px++) {
            if (!exact_covers(x, y, bits, px, py)) continue;
            if (r->deep) gn_record_begin_row(r, px, py);
            const double exact = exact_piece(r, v, px, py), got = gn_record_row_of(r, slope, px, py).at;
            const double far_x = fabs(px - r->x - corner[0][0]) + fabs((double)px - r->x) + (r->deep ? 32 : 0),
                         far_y = fabs(py - r->y - corner[0][1]) + fabs((double)py - r->y);
            /* deep: up to twice that, 16 units and the reciprocal's 2^-17 of what is added at both ends, and 16 per
             * pixel */
            const double bound = r->deep ? 2 * (off[0] * far_x + off[1] * far_y) + 600 + ldexp(d1 + d2, -14)
                                         : off[0] * far_x + off[1] * far_y + 2;
            HOLDS(t, fabs(got - exact) <= bound, "%g, not %g +- %g: %d, %d, %d; %d pixels, deep %d", got, exact, bound,
                  (int)v[0], (int)v[1], (int)v[2], (int)r->px, r->deep);
        }
    for (int k = 0; k < 3; k++) {
        const double to_x = fabs(corner[k][0] - corner[0][0]) + fabs(corner[k][0]),
                     to_y = fabs(corner[k][1] - corner[0][1]) + fabs(corner[k][1]),
                     got = gn_record_at_corner(r, &frame, slope, k),
                     bound = (r->deep ? 2 : 1) * (off[0] * to_x + off[1] * to_y) +
                             (r->deep ? 100 + ldexp(d1 + d2, -14) : 6);
        HOLDS(t, fabs(got - v[k]) <= bound, "corner %d: %g, not %d +- %g", k, got, (int)v[k], bound);
    }
}

/* Pieces of rows between exact ends: off by an eighth of the square of their length times the bend. */
static void compare_pieces(gn_patch_record *r, const int32_t x[3], const int32_t y[3], tally *t)
{
    const int32_t v[3] = {0, 1 << 20, -(1 << 20)};
    for (int32_t py = r->y - r->px; r->deep && py <= r->y + r->px; py++)
        for (int32_t px = r->x - r->px; px <= r->x + r->px; px++) {
            if (!exact_covers(x, y, bits, px, py)) continue;
            const int32_t n = gn_record_begin_row(r, px, py);
            HOLDS(t,
                  n > 0 && r->row.first <= px && px <= r->row.last && px + n == r->row.first + 16 &&
                      r->row.last - r->row.first <= 16,
                  "pixel %d in a piece from %d to %d", (int)px, (int)r->row.first, (int)r->row.last);
            const double length = r->row.last - r->row.first, lean = fabs(tri.iz_dx / middle),
                         a = ratio_at(r->row.first - r->x, py - r->y), b = ratio_at(r->row.last - r->x, py - r->y),
                         least = fmin(a, b), first = exact_value(r, v, r->row.first - r->x, py - r->y),
                         last = exact_value(r, v, r->row.last - r->x, py - r->y);
            HOLDS(t, least > 0.25, "near / Z is %g of the middle", least);
            HOLDS(t,
                  fabs(exact_piece(r, v, px, py) - exact_value(r, v, px - r->x, py - r->y)) <=
                      fabs(last - first) * length * lean / least / 4 * 1.6 + 1e-6,
                  "bent by %g", exact_piece(r, v, px, py) - exact_value(r, v, px - r->x, py - r->y));
        }
}

static void test_slopes(void)
{
    gn_patch_record r;
    tally t = {0}, pieces = {0};
    for (int i = 0; i < CASES; i++) {
        int32_t x[3], y[3], v[3];
        gn_slope slope;
        any_record(&r);
        find_middle();
        const int32_t half = 1 << rng_range(&random_state, 0, 26),
                      about = rng_range(&random_state, -(1 << 29), 1 << 29);
        for (int k = 0; k < 3; k++) {
            x[k] = tri.x[k] + ((frame.picture.width << bits) >> 1);
            y[k] = tri.y[k] + ((frame.picture.height << bits) >> 1);
            v[k] = about + rng_range(&random_state, -half, half);
        }
        gn_record_slope(&r, &frame, v[0], v[1], v[2], &slope);
        compare_slope(&r, &slope, v, x, y, &t);
        compare_pieces(&r, x, y, &pieces);
    }
    CHECK_TALLY(t, "slopes through corners");
    CHECK_TALLY(pieces, "pieces of rows");
}

/* ---- Depths, normals, places ------------------------------------------------------------------------------------- */

static void test_depths(void)
{
    gn_patch_record r;
    tally t = {0};
    for (int i = 0; i < CASES; i++) {
        any_record(&r);
        find_middle();
        gn_record_find_depth(&r, &frame);
        const double z = ldexp(frame.cam.near_q16, 32) / middle, share = ldexp(1, -17) + ldexp(1, -25);
        /* a reciprocal of one Newton step, 2^-17, and bits below the 28th; then below Q16 */
        HOLDS(&t, fabs(ldexp(r.z, -r.z_up) / z - 1) < share, "depth %g of %g", ldexp(r.z, -r.z_up), z);
        HOLDS(&t,
              fabs(r.lean_q30[0] - ldexp(tri.iz_dx / middle, 30)) < fabs(ldexp(tri.iz_dx / middle, 13)) + 2 &&
                  fabs(r.lean_q30[1] - ldexp(tri.iz_dy / middle, 30)) < fabs(ldexp(tri.iz_dy / middle, 13)) + 2,
              "leans by %d, %d", (int)r.lean_q30[0], (int)r.lean_q30[1]);
        if (z >= 1073741823.0) continue;
        int32_t lo, hi;
        const double at = gn_record_depth(&r);
        gn_record_depths(&r, &frame, &lo, &hi);
        HOLDS(&t, fabs(at - z) < z * share + 1, "depth %g of %g", at, z);
        double farthest = 0, nearest = HUGE_VAL, off = 0;
        for (int k = 0; k < 3; k++) {
            const double zk = ldexp(frame.cam.near_q16, 32) / nearness(k);
            HOLDS(&t, lo < zk * (1 + share) && hi > zk * (1 - share), "corner %d: %g, not in %d .. %d", k, zk, (int)lo,
                  (int)hi);
            farthest = fmax(farthest, zk), nearest = fmin(nearest, zk);
            off = fmax(off, fabs(corner[k][0] * tri.iz_dx) + fabs(corner[k][1] * tri.iz_dy));
        }
        off /= middle; /* each axis for itself, so up to twice what one corner has of both */
        HOLDS(&t, lo > z * (1 - 2.01 * off - share) - 4 && hi < z * (1 + 2.01 * off * (1 + 4.1 * off) + share) + 4,
              "%g .. %g between %d and %d", nearest, farthest, (int)lo, (int)hi);
    }
    CHECK_TALLY(t, "depths");
}

/* The face's normal by the plane of near / Z: near / Z at a ray is n . ray, and it points away from the viewer. */
static void exact_face(double n[3])
{
    const double f = frame.cam.focal2_px_q16 / 131072.0, x = column + 0.5 - frame.picture.width / 2.0,
                 y = row + 0.5 - frame.picture.height / 2.0;
    n[0] = -tri.iz_dx * f, n[1] = tri.iz_dy * f, n[2] = -(middle - tri.iz_dx * x - tri.iz_dy * y);
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
        find_middle();
        gn_record_face(&r, &frame, view_q14);
        exact_face(n);
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
        gn_slope got;
        any_record(&r);
        find_middle();
        any_ray_plane(&plane);
        gn_record_find_depth(&r, &frame);
        const int32_t ray_shift = rng_range(&random_state, 4, 30), up = 32 - ray_shift - r.z_up;
        const double px = 2 * column + 1 - frame.picture.width, py = frame.picture.height - 1 - 2 * row,
                     z = ldexp(r.z, -r.z_up - ray_shift), lean[2] = {tri.iz_dx / middle, tri.iz_dy / middle},
                     v = z * (plane.a0 + plane.ax * px + plane.ay * py), dx = 2 * z * plane.ax - v * lean[0],
                     dy = -2 * z * plane.ay - v * lean[1], most = fabs(v) + 32 * (fabs(dx) + fabs(dy)),
                     lost = ldexp(1, up) + 1; /* a unit of the product, one of Q16 */
        const int fits = gn_record_place(&r, &frame, &plane, ray_shift, &got);
        HOLDS(&t,
              fits || most > 1 << 28 || fmax(fabs(dx), fabs(dy)) > ldexp(1, 23 + up) || up > 28 ||
                  fabs((double)plane.d_q16) > 1 << 29,
              "%g does not fit", most);
        if (!fits) continue;
        /* lean is off by 2^-17 of itself and 2^-30; four products */
        HOLDS(&t, fabs(got.at - v - (double)plane.d_q16) <= lost, "%d, not %g", (int)got.at, v + (double)plane.d_q16);
        HOLDS(&t,
              fabs(got.dx - dx) <= fabs(v) * (fabs(lean[0]) * ldexp(1, -17) + ldexp(2, -30)) + 5 * lost &&
                  fabs(got.dy - dy) <= fabs(v) * (fabs(lean[1]) * ldexp(1, -17) + ldexp(2, -30)) + 5 * lost,
              "%d, %d, not %g, %g", (int)got.dx, (int)got.dy, dx, dy);
        for (int k = 0; k < 3; k++) { /* straight in place of bent: by the change of near / Z of what there is */
            const double x = corner[k][0], y = corner[k][1], bent = lean[0] * x + lean[1] * y,
                         exact = z * (plane.a0 + plane.ax * (px + 2 * x) + plane.ay * (py - 2 * y)) / (1 + bent);
            HOLDS(&t, fabs(v + dx * x + dy * y - exact) <= fabs((dx * x + dy * y) * bent / (1 + bent)) * 1.0001 + 1e-3,
                  "corner %d is %g off, leans by %g", k, v + dx * x + dy * y - exact, bent);
        }
    }
    CHECK_TALLY(t, "places");
}

/* ---- Levels of textures ------------------------------------------------------------------------------------------ */

/* MODEL 8, for the depth of the pixel: 2 log2(S Z^2 / (F d)), with the product of the corners' depths for Z^3.
 */
static double exact_level2(double texels2)
{
    const double f = frame.cam.focal2_px_q16 / 131072.0, one = 1 << bits;
    double v[3][3], n[3], z = ldexp(frame.cam.near_q16, 16) / middle, product = z;
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
        find_middle();
        gn_record_face(&r, &frame, view_q14);
        exact_face(n);
        const uint64_t texels = rng_wide_u64(&random_state, 54);
        const int32_t log2_ = rng_range(&random_state, -30, 2), focal2 = (int32_t)(frame.cam.focal2_px_q16 >> 16),
                      got = gn_record_level2(&r, &frame, view_q14, texels, log2_);
        const double x = 2 * r.x + 1 - frame.picture.width, y = frame.picture.height - 1 - 2 * r.y,
                     facing = -(n[0] * x + n[1] * y + n[2] * focal2), all = fabs(x) + fabs(y) + focal2;
        /* four factors lose 2^-15, the focal length a pixel twice, the normal 5 units of Q14 */
        const double share = (ldexp(1, -13) + 1.0 / focal2 + (1 + 5 / 16384.0 * all) / facing);
        if (share < 0 || share > 0.5) continue; /* edge on */
        const double off = -log2(1 - share), exact = exact_level2(ldexp((double)texels, log2_));
        HOLDS(&t, got >= floor(exact - off) && got <= floor(exact + off), "%d, not %g +- %g", (int)got, exact, off);
    }
    CHECK_TALLY(t, "levels of textures");
}

/* ------------------------------------------------------------------------------------------------------------------ */

static void test_all(void)
{
    bits = GN_K(&frame, subpixel_bits);
    test_begin();
    test_round();
    test_slopes();
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
#endif
    return check_report();
}
