/* The workload's triangles: uniform over the picture, depths 1500 to 7000, not too thin. */
#include "bench_gen.h"

#include <math.h>

static const double margin_px = 4;       /* of triangle centres to the picture's border */
static const double depth_spread = 0.07; /* of a vertex around its triangle's depth */
static const double min_height = 0.25;   /* of a triangle, over its longest side */

typedef struct {
    double min_area_px, max_area_px;
    double reach_px; /* of vertices from the centre, per axis */
} shape;

typedef struct {
    double x[3], y[3], z[3]; /* screen, y down, and view depth */
} candidate;

/* lo <= result < hi in 100,000 steps */
static double uniform(uint32_t *state, double lo, double hi)
{
    *state = *state * 1664525U + 1013904223U;
    return lo + (hi - lo) * ((*state >> 8) % 100000U) / 100000.0;
}

/* Returns 0 if a vertex lies outside the picture; the random sequence moves on by the same number of steps. */
static int draw_candidate(candidate *c, uint32_t *state, const shape *limits)
{
    double centre_x = uniform(state, margin_px, BENCH_WIDTH - margin_px);
    double centre_y = uniform(state, margin_px, BENCH_HEIGHT - margin_px);
    double depth = uniform(state, 1500, 7000);
    int inside = 1;
    for (int i = 0; i < 3; i++) {
        c->x[i] = centre_x + uniform(state, -limits->reach_px, limits->reach_px);
        c->y[i] = centre_y + uniform(state, -limits->reach_px, limits->reach_px);
        c->z[i] = depth * uniform(state, 1 - depth_spread, 1 + depth_spread);
        inside = inside && c->x[i] >= 1 && c->x[i] <= BENCH_WIDTH - 1 && c->y[i] >= 1 && c->y[i] <= BENCH_HEIGHT - 1;
    }
    return inside;
}

/* Positive for clockwise on the screen. */
static double signed_area(const candidate *c)
{
    return ((c->x[1] - c->x[0]) * (c->y[2] - c->y[0]) - (c->x[2] - c->x[0]) * (c->y[1] - c->y[0])) / 2;
}

/* Whether area and height over the longest side are within the limits. */
static int shape_fits(const candidate *c, const shape *limits)
{
    double area = fabs(signed_area(c)), longest = 0;
    if (area < limits->min_area_px || area > limits->max_area_px) return 0;
    for (int i = 0; i < 3; i++) {
        int next = (i + 1) % 3;
        longest = fmax(longest, hypot(c->x[i] - c->x[next], c->y[i] - c->y[next]));
    }
    return area * 2 / longest >= longest * min_height;
}

/* From the screen to view space, counter-clockwise: x and y in the unit of z, y upwards. */
static void unproject(bench_triangle *out, const candidate *c)
{
    int clockwise = signed_area(c) > 0;
    for (int i = 0; i < 3; i++) {
        int from = clockwise && i ? 3 - i : i;
        long z = lround(
            c->z[i]); /* depths stay with their places: turning a triangle round moves its corners on the screen */
        out->v[i][0] = (int32_t)lround((c->x[from] - BENCH_WIDTH / 2) / BENCH_FOCAL_PX * (double)z);
        out->v[i][1] = (int32_t)lround((BENCH_HEIGHT / 2 - c->y[from]) / BENCH_FOCAL_PX * (double)z);
        out->v[i][2] = (int32_t)z;
    }
}

static void generate_set(bench_triangle *out, int n, const shape *limits, uint32_t *state)
{
    for (int made = 0; made < n;) {
        candidate c;
        if (draw_candidate(&c, state, limits) && shape_fits(&c, limits)) unproject(&out[made++], &c);
    }
}

void bench_generate(bench_triangle large[BENCH_N_LARGE], bench_triangle small[BENCH_N_SMALL])
{
    static const shape shape_large = {800, 1500, 60}, shape_small = {15, 25, 8};
    uint32_t state = 12345;
    generate_set(large, BENCH_N_LARGE, &shape_large, &state);
    generate_set(small, BENCH_N_SMALL, &shape_small, &state);
}
