/* The metrics of `gnomon compare` on pictures of a few pixels, made by hand, with the values worked out on paper. */
#include <string.h>

#include "../host/tool/picture/metrics.h"
#include "check.h"

enum { MAX_PIXELS = 4, MAX_LIGHTS = ENGINE_LIGHTS_MAX };

typedef struct {
    uint8_t rgb8[3 * MAX_PIXELS];
    uint16_t rgb565[MAX_PIXELS];
    int64_t triangle[MAX_PIXELS];
    double shadow[MAX_LIGHTS][MAX_PIXELS], ndotl[MAX_LIGHTS][MAX_PIXELS];
    engine_picture p;
} picture;

static picture fixed, other;
static metrics m;

static void make(picture *a, int width, int height, size_t n_lights)
{
    memset(a, 0, sizeof *a);
    a->p.width = width;
    a->p.height = height;
    a->p.n_lights = n_lights;
    a->p.rgb8 = a->rgb8;
    a->p.rgb565 = a->rgb565;
    a->p.triangle = a->triangle;
    memset(a->rgb8, 100, sizeof a->rgb8);
    for (int i = 0; i < MAX_PIXELS; i++) {
        a->rgb565[i] = 10 << 11 | 20 << 5 | 10;
        a->triangle[i] = 7;
    }
    for (size_t l = 0; l < n_lights; l++) {
        for (int i = 0; i < MAX_PIXELS; i++) {
            a->shadow[l][i] = 0.5;
            a->ndotl[l][i] = 1;
        }
        a->p.shadow[l] = a->shadow[l];
        a->p.ndotl[l] = a->ndotl[l];
    }
}

/* Two equal pictures: every pixel of one triangle, half lit by each light. */
static void begin(int width, int height, size_t n_lights)
{
    make(&fixed, width, height, n_lights);
    make(&other, width, height, n_lights);
    for (size_t l = 0; l < n_lights; l++) fixed.p.ndotl[l] = NULL; /* the library gives none */
}

static void compute(void)
{
    memset(&m, 0x55, sizeof m); /* nothing may be left as it was */
    metrics_compute(&m, &fixed.p, &other.p);
}

static void test_equal(void)
{
    begin(2, 2, 1);
    compute();
    CHECK_EQ_INT(m.pixels, 4);
    CHECK_NEAR(m.identical, 1, 0);
    CHECK_NEAR(m.within1, 1, 0);
    CHECK(isinf(m.psnr_db) && m.psnr_db > 0);
    CHECK_EQ_INT(m.max_error, 0);
    CHECK_NEAR(m.atten_rms, 0, 0);
    CHECK_NEAR(m.atten_max, 0, 0);
    CHECK_NEAR(m.shadow_mismatch, 0, 0);
    CHECK_NEAR(m.coverage_mismatch, 0, 0);
    CHECK_EQ_INT(m.by_coverage, 0);
    CHECK_EQ_INT(m.by_shadow, 0);
    CHECK_EQ_INT(m.by_light, 0);
    CHECK_EQ_INT(m.by_rounding, 0);
    CHECK_EQ_INT(m.worst_x, 0);
    CHECK_EQ_INT(m.worst_y, 0);
    CHECK_EQ_INT(strcmp(m.worst_cause, "none"), 0);
    CHECK_EQ_INT(m.n_lights, 1);
    CHECK_EQ_INT(m.light[0].pixels, 4);
    CHECK_NEAR(m.light[0].atten_rms, 0, 0);
}

/* Every combination of 0, 1 and 2 steps per channel, upwards and downwards: the largest decides. */
static void test_steps(void)
{
    static const int shift[3] = {11, 5, 0};
    for (int i = 0; i < 27; i++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            int step[3] = {i % 3, i / 3 % 3, i / 9}, largest = 0, colour = 10 << 11 | 20 << 5 | 10;
            for (int k = 0; k < 3; k++) {
                colour += sign * step[k] * (1 << shift[k]);
                largest = step[k] > largest ? step[k] : largest;
            }
            begin(3, 1, 0);
            fixed.rgb565[1] = (uint16_t)colour;
            compute();
            CHECK_NEAR(m.identical, largest == 0 ? 1 : 2.0 / 3, 1e-15);
            CHECK_NEAR(m.within1, largest <= 1 ? 1 : 2.0 / 3, 1e-15);
        }
    }
    begin(1, 1, 0); /* all bits of each channel count */
    fixed.rgb565[0] = 63 << 5;
    other.rgb565[0] = 31 << 5;
    compute();
    CHECK_NEAR(m.within1, 0, 0);
}

/* 10 log10(255^2 / mean square), the mean over the channels too. */
static void test_psnr(void)
{
    begin(2, 1, 0);
    fixed.rgb8[4] = 103;
    compute();
    CHECK_NEAR(m.psnr_db, 10 * log10(65025.0 * 6 / 9), 1e-12);
    fixed.rgb8[4] = 101;
    compute();
    CHECK_NEAR(m.psnr_db, 10 * log10(65025.0 * 6), 1e-12);
    fixed.rgb8[0] = 98;
    other.rgb8[5] = 110;
    compute();
    CHECK_NEAR(m.psnr_db, 10 * log10(65025.0 * 6 / (1 + 4 + 100)), 1e-12);
    begin(1, 1, 0);
    memset(fixed.rgb8, 0, 3);
    memset(other.rgb8, 255, 3);
    compute();
    CHECK_NEAR(m.psnr_db, 0, 1e-12);
}

static void test_worst_pixel(void)
{
    for (int k = 0; k < 3; k++) {
        begin(2, 2, 0);
        fixed.rgb8[3 + (k + 1) % 3] = 105; /* (1, 0) */
        other.rgb8[6 + k] = 107;           /* (0, 1): the largest, downwards */
        fixed.rgb8[9 + k] = 107;           /* (1, 1): as large, but later */
        compute();
        CHECK_EQ_INT(m.max_error, 7);
        CHECK_EQ_INT(m.worst_x, 0);
        CHECK_EQ_INT(m.worst_y, 1);
        CHECK_EQ_INT(strcmp(m.worst_cause, "rounding"), 0);
        CHECK_NEAR(m.identical, 1, 0); /* the 16-bit colours are equal */
        CHECK_EQ_INT(m.by_rounding, 0);
        fixed.rgb565[3]++;
        compute();
        CHECK_EQ_INT(m.worst_x, 0);
        CHECK_EQ_INT(m.by_rounding, 1);
    }
    begin(3, 1, 0);
    fixed.rgb8[6] = 101;
    compute();
    CHECK_EQ_INT(m.max_error, 1);
    CHECK_EQ_INT(m.worst_x, 2);
    CHECK_EQ_INT(m.worst_y, 0);
}

/* A difference of 1/16 is no mismatch yet, of a little more is one, whichever is darker. */
static void test_attenuation(void)
{
    const double more = 1.0 / 16 + 1.0 / 1048576;
    for (int sign = -1; sign <= 1; sign += 2) {
        begin(2, 2, 1);
        fixed.shadow[0][1] = 0.5 + sign * 1.0 / 16;
        compute();
        CHECK_NEAR(m.shadow_mismatch, 0, 0);
        CHECK_NEAR(m.atten_max, 1.0 / 16, 0);
        CHECK_NEAR(m.atten_rms, 1.0 / 32, 1e-15); /* sqrt(1/256 / 4) */
        fixed.shadow[0][2] = 0.5 + sign * more;
        compute();
        CHECK_NEAR(m.shadow_mismatch, 0.25, 0);
        CHECK_NEAR(m.light[0].shadow_mismatch, 0.25, 0);
        CHECK_NEAR(m.atten_max, more, 0);
        CHECK_NEAR(m.light[0].atten_max, more, 0);
        CHECK_NEAR(m.atten_rms, sqrt((1.0 / 256 + more * more) / 4), 1e-15);
        CHECK_NEAR(m.light[0].atten_rms, m.atten_rms, 0);
    }
}

/* Shadows count where both show the same triangle and it faces the light by more than rounding, and nowhere else. */
static void test_comparable(void)
{
    static const struct {
        int64_t fixed, other;
        double ndotl;
        int counts;
    } cases[] = {
        {7, 7, 1, 1}, {0, 0, 1, 1},  {7, 7, 1.1e-5, 1}, {7, 7, 1e-5, 0}, {7, 8, 1, 0},  {7, (int64_t)1 << 32 | 7, 1, 0},
        {7, 7, 0, 0}, {7, 7, -1, 0}, {-1, -1, 1, 0},    {-1, 7, 1, 0},   {7, -1, 1, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        begin(3, 1, 1);
        fixed.triangle[2] = cases[i].fixed;
        other.triangle[2] = cases[i].other;
        other.ndotl[0][2] = cases[i].ndotl;
        fixed.shadow[0][2] = 1;
        other.shadow[0][2] = 0;
        compute();
        CHECK_EQ_INT(m.light[0].pixels, 2 + cases[i].counts);
        CHECK_NEAR(m.atten_max, cases[i].counts, 0);
        CHECK_NEAR(m.shadow_mismatch, cases[i].counts / 3.0, 1e-15);
        CHECK_NEAR(m.atten_rms, sqrt(cases[i].counts / 3.0), 1e-15);
        CHECK_NEAR(m.coverage_mismatch, cases[i].fixed == cases[i].other ? 0 : 1.0 / 3, 1e-15);
    }
}

static void test_causes(void)
{
    begin(2, 2, 2);
    for (int i = 0; i < 4; i++) fixed.rgb565[i]++;
    fixed.triangle[0] = 8; /* another triangle, whatever its shadow */
    fixed.shadow[0][0] = 0;
    other.shadow[1][1] += 1.0 / 256 + 1.0 / 65536; /* of the second light */
    fixed.shadow[0][2] += 1.0 / 256;               /* not more than the limit */
    compute();
    CHECK_EQ_INT(m.by_coverage, 1);
    CHECK_EQ_INT(m.by_shadow, 1);
    CHECK_EQ_INT(m.by_rounding, 2);
    CHECK_NEAR(m.coverage_mismatch, 0.25, 0);
    CHECK_NEAR(m.identical, 0, 0);
    static const char *const causes[] = {"coverage", "shadow", "rounding"};
    for (size_t i = 0; i < 3; i++) {
        memset(fixed.rgb8, 100, sizeof fixed.rgb8);
        fixed.rgb8[3 * i] = 99;
        compute();
        CHECK_EQ_INT(m.worst_x, i % 2);
        CHECK_EQ_INT(m.worst_y, i / 2);
        CHECK_EQ_INT(strcmp(m.worst_cause, causes[i]), 0);
    }
    fixed.rgb565[0]--; /* equal colours have no cause */
    fixed.rgb565[1]--;
    compute();
    CHECK_EQ_INT(m.by_coverage, 0);
    CHECK_EQ_INT(m.by_shadow, 0);
    CHECK_EQ_INT(m.by_rounding, 2);
}

/* Rounding is one step, in whichever channel; two steps are another light, unless surface or shadow says more. */
static void test_light_or_rounding(void)
{
    static const int shift[3] = {11, 5, 0};
    for (int k = 0; k < 3; k++) {
        begin(2, 2, 1);
        fixed.rgb565[0] = (uint16_t)(fixed.rgb565[0] + (1 << shift[k]));
        for (int i = 1; i < 4; i++) fixed.rgb565[i] = (uint16_t)(fixed.rgb565[i] + (2 << shift[k]));
        fixed.triangle[2] = 8;
        other.shadow[0][3] += 1.0 / 128;
        fixed.rgb8[3] = 80;
        compute();
        CHECK_EQ_INT(m.by_rounding, 1);
        CHECK_EQ_INT(m.by_light, 1);
        CHECK_EQ_INT(m.by_coverage, 1);
        CHECK_EQ_INT(m.by_shadow, 1);
        CHECK(m.worst_x == 1 && m.worst_y == 0 && strcmp(m.worst_cause, "light") == 0);
    }
}

/* Each light for itself, and all samples of all lights together. */
static void test_lights(void)
{
    begin(2, 1, 3);
    fixed.shadow[0][0] = 1;    /* off by 1/2 */
    fixed.shadow[1][1] = 0.75; /* off by 1/4 */
    other.ndotl[1][0] = -1;    /* only one pixel faces the second light, none the third */
    other.ndotl[2][0] = other.ndotl[2][1] = 0;
    fixed.shadow[2][0] = 0;
    compute();
    CHECK_EQ_INT(m.n_lights, 3);
    CHECK_EQ_INT(m.light[0].pixels, 2);
    CHECK_EQ_INT(m.light[1].pixels, 1);
    CHECK_EQ_INT(m.light[2].pixels, 0);
    CHECK_NEAR(m.light[0].atten_rms, sqrt(0.125), 1e-15);
    CHECK_NEAR(m.light[1].atten_rms, 0.25, 1e-15);
    CHECK_NEAR(m.light[2].atten_rms, 0, 0);
    CHECK_NEAR(m.light[0].atten_max, 0.5, 0);
    CHECK_NEAR(m.light[1].atten_max, 0.25, 0);
    CHECK_NEAR(m.light[2].atten_max, 0, 0);
    CHECK_NEAR(m.light[0].shadow_mismatch, 0.5, 0);
    CHECK_NEAR(m.light[1].shadow_mismatch, 1, 0);
    CHECK_NEAR(m.light[2].shadow_mismatch, 0, 0);
    CHECK_NEAR(m.atten_rms, sqrt((0.25 + 0.0625) / 3), 1e-15);
    CHECK_NEAR(m.atten_max, 0.5, 0);
    CHECK_NEAR(m.shadow_mismatch, 2.0 / 3, 1e-15);
    fixed.p.n_lights = 1; /* what one of the pictures does not have is not compared */
    compute();
    CHECK_EQ_INT(m.n_lights, 1);
    CHECK_NEAR(m.atten_rms, sqrt(0.125), 1e-15);
    fixed.p.n_lights = 3;
    other.p.n_lights = 2;
    compute();
    CHECK_EQ_INT(m.n_lights, 2);
    CHECK_EQ_INT(m.light[2].pixels, 0);
    other.p.n_lights = 0;
    compute();
    CHECK_EQ_INT(m.n_lights, 0);
    CHECK_NEAR(m.atten_rms, 0, 0);
    CHECK_NEAR(m.shadow_mismatch, 0, 0);
}

/* As many lights as there can be; what a light does not reach (the reference says n.L = -1) does not count for it. */
static void test_many_lights(void)
{
    begin(2, 2, MAX_LIGHTS);
    for (size_t l = 0; l < MAX_LIGHTS; l++) {
        other.ndotl[l][l % 4] = -1;
        fixed.shadow[l][l % 4] = 1;
    }
    fixed.shadow[MAX_LIGHTS - 1][0] = 0.25;
    compute();
    CHECK_EQ_INT(m.n_lights, MAX_LIGHTS);
    for (size_t l = 0; l < MAX_LIGHTS; l++) {
        CHECK_EQ_INT(m.light[l].pixels, 3);
        CHECK_NEAR(m.light[l].atten_max, l == MAX_LIGHTS - 1 ? 0.25 : 0, 0);
    }
    CHECK_NEAR(m.atten_max, 0.25, 0);
    CHECK_NEAR(m.atten_rms, 0.25 / sqrt(3.0 * MAX_LIGHTS), 1e-15);
    CHECK_NEAR(m.shadow_mismatch, 1 / (3.0 * MAX_LIGHTS), 1e-15);
}

int main(void)
{
    test_equal();
    test_steps();
    test_psnr();
    test_worst_pixel();
    test_attenuation();
    test_comparable();
    test_causes();
    test_light_or_rounding();
    test_lights();
    test_many_lights();
    return check_report();
}
