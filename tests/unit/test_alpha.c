/* Texture coordinates along the rows of triangles that alpha cuts (gn_alpha.h), against double precision: found one by
 * one, and in steps. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "exact.h"
#include "knobs.h"
#include "geometry/gn_texture.h"
#include "gnomon.h"
#include "rng.h"

static rng random_state = {31};
static gn_frame frame;

enum { WIDTH = 320, HEIGHT = 240, ROWS_MAX = 6 };

/* A triangle with a texture, as a camera sees it. */
typedef struct {
    gn_texture texture;
    int16_t uv[6];
    int uv_frac_bits;
    int32_t v[3][3];
    double focal2; /* in half pixels */
    int newton_steps;
    gn_object object;
    gn_mesh mesh;
    gn_alpha_cut cut;
} triangle;

static double exponential(double lo, double hi)
{
    return lo * pow(hi / lo, rng_u32(&random_state) / 4294967296.0);
}

static void random_triangle(triangle *t)
{
    memset(t, 0, sizeof *t);
    t->texture = (gn_texture){.width_log2 = (uint8_t)rng_below(&random_state, 11),
                              .height_log2 = (uint8_t)rng_below(&random_state, 11),
                              .flags = (uint8_t)(rng_u32(&random_state) & 7U)};
    t->uv_frac_bits = rng_range(&random_state, 0, 15);
    for (int k = 0; k < 6; k++) t->uv[k] = (int16_t)rng_range(&random_state, -32768, 32767);
    t->focal2 = rng_range(&random_state, 200 * 256, 1200 * 256) / 256.0;
    t->newton_steps = rng_range(&random_state, 1, 2);
    double z = exponential(0x1p17, 0x1p26), steep = exponential(1, 8);
    for (int i = 0; i < 3; i++) {
        double depth = z * exponential(1, steep);
        t->v[i][0] = (int32_t)(depth * rng_range(&random_state, -WIDTH, WIDTH) / t->focal2);
        t->v[i][1] = (int32_t)(depth * rng_range(&random_state, -HEIGHT, HEIGHT) / t->focal2);
        t->v[i][2] = (int32_t)depth;
    }
    t->mesh = (gn_mesh){.uv = t->uv, .n_vertices = 3, .uv_frac_bits = (uint8_t)t->uv_frac_bits};
    t->object = (gn_object){.texture = &t->texture, .mesh = &t->mesh};
    gn_alpha_begin(&t->cut, &t->object, GN_ALPHA_CLIP, (const uint16_t[]){0, 1, 2});
    gn_alpha_plane(&t->cut, &frame, t->v, (uint32_t)(t->focal2 * 65536), WIDTH, t->newton_steps);
}

static double det3(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Barycentrics along a ray: the weights of the corners in it. Returns how ill they are conditioned. */
static double barycentrics(const triangle *t, int32_t x, int32_t y, double b[3])
{
    const double ray[3] = {2 * x + 1 - WIDTH, HEIGHT - 1 - 2 * y, t->focal2};
    double v[3][3], sum = 0, sizes = 0, length = sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) v[i][k] = t->v[i][k];
    for (int i = 0; i < 3; i++) {
        const double *p = v[(i + 1) % 3], *q = v[(i + 2) % 3];
        b[i] = det3(ray, p, q);
        sum += b[i];
        sizes += length * (fabs(p[0]) + fabs(p[1]) + fabs(p[2])) * (fabs(q[0]) + fabs(q[1]) + fabs(q[2]));
    }
    for (int i = 0; i < 3; i++) b[i] /= sum;
    return sizes / fabs(sum);
}

/* Of coordinate k, in turns: at most what the corners have, and where it is clamped what 32 bits hold. */
static double coordinate(const triangle *t, const double b[3], int k)
{
    const double at = b[0] * t->uv[k] + b[1] * t->uv[2 + k] + b[2] * t->uv[4 + k],
                 least = fmin(fmin(t->uv[k], t->uv[2 + k]), t->uv[4 + k]),
                 most = fmax(fmax(t->uv[k], t->uv[2 + k]), t->uv[4 + k]),
                 turns = ldexp(fmax(fmin(at, most), least), -t->uv_frac_bits);
    return gn_texture_clamps(&t->texture, k) ? fmax(fmin(turns, 2048), -2048) : turns;
}

/* How far a coordinate is off; whole turns do not count where it repeats. */
static double turns_off(const triangle *t, int32_t c_q20, const double b[3], int k)
{
    double off = ldexp(c_q20, -20) - coordinate(t, b, k);
    return gn_texture_clamps(&t->texture, k) ? off : off - floor(off + 0.5);
}

/* What the coordinates may be off by: b, to 2^-28, 2^-17 with one Newton step, and as ill as they are conditioned; each
 * side of 2^-8 texel; a unit of each step. */
static double bound(const triangle *t, double ill, int k, int step)
{
    double spread = ldexp(abs(t->uv[2 + k] - t->uv[k]) + abs(t->uv[4 + k] - t->uv[k]), -t->uv_frac_bits);
    double exact = spread * (ill * 0x1p-28 + (t->newton_steps == 1 ? 0x1p-17 : 0) + 0x1p-28) + 0x1p-20;
    return step > 1 ? exact + ldexp(1, -8 - (k ? t->texture.height_log2 : t->texture.width_log2)) + 2 * 0x1p-20 : exact;
}

/* A row's pixels that lie inside the triangle: from *x0, how many. */
static int inside(const triangle *t, int32_t y, int32_t *x0)
{
    int n = 0;
    double b[3];
    for (int32_t x = 0; x < WIDTH; x++) {
        barycentrics(t, x, y, b);
        if (b[0] < 0 || b[1] < 0 || b[2] < 0) {
            if (n) return n;
            continue;
        }
        if (!n++) *x0 = x;
    }
    return n;
}

typedef struct {
    tally close;
    double most; /* error / bound */
    unsigned long n, n_held;
} outcome;

/* Texture coordinates of the pixel k beyond x; returns for how many from x on they are told. */
static int32_t coordinates_at(gn_alpha_cut *cut, int32_t x, int32_t k, int32_t uv_q20[2])
{
    gn_texture_curve curve;
    int32_t n = gn_alpha_coords(cut, x, &curve);
    for (int i = 0; i < 2; i++) {
        int64_t sum = curve.at_q28[i] + (int64_t)k * curve.step_q28[i] + (int64_t)(k * (k - 1) / 2) * curve.bend_q28[i];
        uv_q20[i] = (int32_t)(uint32_t)(curve.from_q20[i] + (sum >> 8));
    }
    return n;
}

static void try_row(outcome *out, triangle *t, int32_t y, int32_t x0, int n, int step)
{
    gn_alpha_row(&t->cut, y, HEIGHT - 1 - 2 * y, x0, x0 + n);
    for (int32_t x = x0; x < x0 + n; x += 1 + (int32_t)rng_below(&random_state, 2)) { /* as some are hidden */
        int32_t uv_q20[2];
        double b[3], ill = barycentrics(t, x, y, b);
        coordinates_at(&t->cut, x, 0, uv_q20);
        out->n++;
        out->n_held += step > 1 && t->cut.steps.hold;
        for (int k = 0; k < 2; k++) {
            double off = turns_off(t, uv_q20[k], b, k), most = bound(t, ill, k, step);
            if (fabs(off) / most > out->most) out->most = fabs(off) / most;
            HOLDS(&out->close, fabs(off) <= most, "x %d, axis %d, step %d: off by %g, not %g", (int)x, k, step, off,
                  most);
        }
    }
}

static void test_rows(int step)
{
    outcome out = {{0}, 0, 0, 0};
    SET_KNOB(&frame, persp_step, step);
    for (int i = 0; i < 3000; i++) {
        triangle t;
        random_triangle(&t);
        for (int row = 0; row < ROWS_MAX; row++) {
            int32_t y = (int32_t)rng_below(&random_state, HEIGHT), x0 = 0;
            int n = inside(&t, y, &x0);
            if (n) try_row(&out, &t, y, x0, n, step);
        }
    }
    printf("steps of %d: %.3f of the bound, %.0f %% of %lu pixels stepped\n", step, out.most,
           100.0 * (double)out.n_held / (double)out.n, out.n);
    CHECK_TALLY(out.close, "gn_alpha_coords");
    CHECK(out.most > 0.125);
    CHECK(step == 1 || out.n_held * 4 > out.n);
}

/* What is beside the row's pixels must not change them: a row seen in two screen tiles is one row. */
static void test_tiles(void)
{
    tally same = {0};
    SET_KNOB(&frame, persp_step, 16);
    for (int i = 0; i < 3000; i++) {
        triangle t;
        random_triangle(&t);
        int32_t y = (int32_t)rng_below(&random_state, HEIGHT), x0 = 0, whole[WIDTH][2];
        int n = inside(&t, y, &x0);
        if (!n) continue;
        gn_alpha_row(&t.cut, y, HEIGHT - 1 - 2 * y, x0, x0 + n);
        for (int32_t x = x0; x < x0 + n; x++) coordinates_at(&t.cut, x, 0, whole[x]);
        for (int32_t x = x0 + n - 1; x >= x0;
             x -= 1 + (int32_t)rng_below(&random_state, 12)) { /* in any order, with any left out */
            int32_t uv_q20[2], n_on = coordinates_at(&t.cut, x, 0, uv_q20);
            HOLDS(&same, memcmp(uv_q20, whole[x], sizeof uv_q20) == 0, "x %d", (int)x);
            for (int32_t k = 1; k < n_on; k++) {
                coordinates_at(&t.cut, x, k, uv_q20);
                HOLDS(&same, memcmp(uv_q20, whole[x + k], sizeof uv_q20) == 0, "x %d, %d on", (int)x, (int)k);
            }
        }
    }
    CHECK_TALLY(same, "coordinates do not depend on what was found before");
}

/* Beside the triangle, as where corners are rounded, coordinates go no farther than to its corners; where its plane
 * is behind, they are those of the first. */
static void test_beside(void)
{
    tally close = {0};
    unsigned long n_beyond = 0;
    SET_KNOB(&frame, persp_step, 1);
    for (int i = 0; i < 20000; i++) {
        triangle t;
        double b[3];
        const int32_t y = (int32_t)rng_below(&random_state, HEIGHT), x = (int32_t)rng_below(&random_state, WIDTH);
        int32_t uv_q20[2];
        random_triangle(&t);
        const double ill = barycentrics(&t, x, y, b), first[3] = {1, 0, 0};
        const int seen = b[0] * t.v[0][2] + b[1] * t.v[1][2] + b[2] * t.v[2][2] > 0;
        gn_alpha_row(&t.cut, y, HEIGHT - 1 - 2 * y, 0, WIDTH);
        coordinates_at(&t.cut, x, 0, uv_q20);
        n_beyond += seen && (b[0] < -4 || b[1] < -4 || b[2] < -4);
        for (int k = 0; k < 2 && ill < 0x1p20; k++) {
            /* beyond the corners, the error grows with the distance from the first */
            const double off = turns_off(&t, uv_q20[k], seen ? b : first, k),
                         most = bound(&t, ill * (1 + fabs(b[1]) + fabs(b[2])), k, 1);
            HOLDS(&close, fabs(off) <= most, "x %d, axis %d: off by %g, not %g", (int)x, k, off, most);
        }
    }
    CHECK_TALLY(close, "coordinates beside a triangle");
    CHECK(n_beyond > 500);
}

/* Of triangles that are seen edge on those of the first corner. */
static void test_edge_on(void)
{
    const int32_t v[3][3] = {{0, 0, 1 << 18}, {1 << 17, 0, 1 << 18}, {0, 0, 1 << 19}};
    tally same = {0};
    for (int i = 0; i < 100; i++) {
        triangle t;
        random_triangle(&t);
        t.texture.flags |= GN_TEXTURE_CLAMP_U | GN_TEXTURE_CLAMP_V;
        memcpy(t.v, v, sizeof v);
        t.mesh.uv_frac_bits = 8;
        gn_alpha_begin(&t.cut, &t.object, GN_ALPHA_CLIP, (const uint16_t[]){0, 1, 2});
        gn_alpha_plane(&t.cut, &frame, t.v, (uint32_t)(t.focal2 * 65536), WIDTH, t.newton_steps);
        for (int32_t y = 0; y < HEIGHT; y += HEIGHT - 1) {
            int32_t uv_q20[2];
            gn_alpha_row(&t.cut, y, HEIGHT - 1 - 2 * y, 0, WIDTH);
            coordinates_at(&t.cut, (int32_t)rng_below(&random_state, WIDTH), 0, uv_q20);
            for (int k = 0; k < 2; k++)
                HOLDS(&same, uv_q20[k] == t.uv[k] * 4096, "y %d, axis %d: %d", (int)y, k, (int)uv_q20[k]);
        }
    }
    CHECK_TALLY(same, "coordinates edge on");
}

/* A sliver of two units, 2^29 long: one barycentric's form is 2^28 times the other's, and does not count where the
 * coordinate is the same at both ends of its edge. */
static void test_sliver(void)
{
    tally close = {0};
    const int32_t side[3] = {(1 << 20) - 193, 12345 - (1 << 28), (1 << 29) - 192 * 512}; /* around the ray px = 1 */
    for (int turned = 0; turned < 2; turned++) {
        triangle t;
        random_triangle(&t);
        t.texture.flags = 0;
        t.focal2 = 512;
        t.newton_steps = 2;
        t.uv_frac_bits = 15;
        t.mesh.uv_frac_bits = 15;
        for (int i = 0; i < 3; i++) memcpy(t.v[i], side, sizeof side);
        t.v[1 + turned][0] += 2;
        t.v[2 - turned][0] += 1;
        t.v[2 - turned][1] = (1 << 28) - 54321;
        for (int k = 0; k < 2; k++) t.uv[2 * (1 + turned) + k] = t.uv[k];
        gn_alpha_begin(&t.cut, &t.object, GN_ALPHA_CLIP, (const uint16_t[]){0, 1, 2});
        gn_alpha_plane(&t.cut, &frame, t.v, (uint32_t)(t.focal2 * 65536), WIDTH, t.newton_steps);
        for (int32_t y = 0; y < HEIGHT; y++) {
            int32_t uv_q20[2];
            double b[3];
            barycentrics(&t, WIDTH / 2, y, b);
            gn_alpha_row(&t.cut, y, HEIGHT - 1 - 2 * y, WIDTH / 2, WIDTH / 2 + 1);
            coordinates_at(&t.cut, WIDTH / 2, 0, uv_q20);
            for (int k = 0; k < 2; k++) /* only the other one counts, and is as well conditioned as the plane */
                HOLDS(&close, fabs(turns_off(&t, uv_q20[k], b, k)) <= 0x1p-20, "y %d, axis %d, turned %d: off by %g",
                      (int)y, k, turned, turns_off(&t, uv_q20[k], b, k));
        }
    }
    CHECK_TALLY(close, "coordinates of a sliver");
}

int main(void)
{
    const int steps[] = {1, 4, 8, 16};
    for (unsigned i = 0; i < sizeof steps / sizeof *steps; i++)
        if (TAKES_KNOB(&frame, persp_step, steps[i])) test_rows(steps[i]);
    test_tiles();
    if (TAKES_KNOB(&frame, persp_step, 1)) test_beside();
    test_edge_on();
    test_sliver();
    return check_report();
}
