/* Values between two exact samples (gn_chord) against the perspective they stand for, in double: what NUMERICS 4.4
 * allows them. */
#include <math.h>
#include <string.h>

#include "../lib/shade/gn_chord.h"
#include "check.h"
#include "rng.h"

static rng state = {1};
static gn_frame frame;
static gn_surface surface;
static gn_light_state light;

static double between(double lo, double hi)
{
    return lo + (hi - lo) * (double)rng_below(&state, 1U << 30) / (1U << 30);
}

static int32_t rounded(double v)
{
    return (int32_t)floor(v + 0.5);
}

/* A flat surface with vertex colours and a directional light that casts shadows: all that is stepped is linear on it.
 */
static void flat_ends(gn_sample *a, gn_sample *b, double bend)
{
    const double z = between(1, 300);
    memset(a, 0, sizeof *a);
    memset(b, 0, sizeof *b);
    for (int32_t i = surface.first_value; i < surface.n_values; i++) {
        const double range = i < GN_VALUE_LIGHT ? 1 : between(0, 1) < 0.5 ? 3 : 100;
        a->value[i] = rounded(65536 * between(0, range));
        b->value[i] = rounded(65536 * between(0, range));
    }
    a->value[GN_VALUE_Z] = rounded(65536 * z * (1 - bend));
    b->value[GN_VALUE_Z] = rounded(65536 * z * (1 + bend));
}

static void setup(int smooth)
{
    memset(&surface, 0, sizeof surface);
    surface.coloured = surface.shadowed = 1;
    surface.smooth = (uint8_t)smooth;
    surface.first_value = GN_VALUE_Z;
    surface.n_lights = 1;
    surface.n_values = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT;
    light.kind = GN_LIGHT_DIRECTIONAL;
    light.view_idx = -1;
    surface.light[0].state = &light;
}

/* All that holds stays within what is promised, and much of what hardly bends does hold. [R4] */
static void test_perspective(void)
{
    long held = 0, tried = 0, near_line = 0, over = 0;
    double worst = 0;
    setup(0);

    for (int k = 0; k < 200000; k++) {
        gn_sample a, b;
        gn_chord chord;
        const double bend = between(-1, 1) * pow(2, -between(0, 14));
        const int32_t n = 2 + (int32_t)rng_below(&state, 15);
        flat_ends(&a, &b, bend);
        gn_sample here = a;
        tried++;
        if (!gn_chord_between(&chord, &frame, &surface, &a, &b, n)) continue;
        held++;
        near_line += fabs(bend) < 0.01;
        const double z0 = a.value[GN_VALUE_Z], z1 = b.value[GN_VALUE_Z], q = fabs(z1 - z0) / (z1 + z0);
        const double share = q * q / 4;
        for (int32_t p = 1; p < n; p++) {
            gn_chord_next(&chord, here.value, surface.first_value);
            const double t = (double)p / n, s = t * z0 / (t * z0 + (1 - t) * z1);
            for (int32_t i = surface.first_value; i < surface.n_values; i++) {
                const double d = (double)b.value[i] - a.value[i], exact = a.value[i] + d * s;
                const double bound = fmax(share * fabs(d), i > GN_VALUE_LIGHT                        ? 256
                                                           : i >= GN_VALUE_RGB && i < GN_VALUE_LIGHT ? 64
                                                                                                     : fabs(d) / 1024) *
                                         (1 + 0x1p-6) +
                                     n * n / 16.0 + n;
                worst = fmax(worst, fabs(here.value[i] - exact) / bound);
                over += i > GN_VALUE_LIGHT && !(fabs(here.value[i] - exact) < 65536.0 / 256 + n * n / 16.0 + n);
                over += i >= GN_VALUE_RGB && i < GN_VALUE_LIGHT &&
                        !(fabs(here.value[i] - exact) < 65536.0 / 1024 + n * n / 16.0 + n);
            }
        }
    }
    CHECK_EQ_INT(over, 0);
    CHECK(worst <= 1 && worst > 0.5);
    CHECK(held > tried / 4 && near_line > held / 4);
}

/* Cosines of an interpolated normal that turns by up to a quarter, under a directional light and for n . p of a spot or
 * point light. */
static void test_turning(void)
{
    double worst = 0, straight = 0;
    long held = 0;
    for (int k = 0; k < 200000; k++) {
        double n0[3], n1[3], l[3], p0[3], p1[3], length = 0;
        const int punctual = k & 1;
        setup(1);
        light.kind = punctual ? GN_LIGHT_POINT : GN_LIGHT_DIRECTIONAL;
        for (int i = 0; i < 3; i++) {
            n0[i] = between(-1, 1);
            l[i] = between(-1, 1);
            length += n0[i] * n0[i];
        }
        length = sqrt(length) / between(0.8, 1);
        if (length < 0.3) continue;
        const double far = between(2, 60), ll = sqrt(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]), turns = between(0, 0.3);
        gn_sample a, b;
        gn_chord chord;
        memset(&a, 0, sizeof a);
        memset(&b, 0, sizeof b);
        a.value[GN_VALUE_Z] = b.value[GN_VALUE_Z] = 20 << 16;
        for (int i = 0; i < 3; i++) {
            n0[i] /= length;
            n1[i] = n0[i] + between(-0.6, 0.6) * turns;
            a.normal_q15[i] = rounded(32767 * n0[i] * 0.98);
            b.normal_q15[i] = rounded(32767 * n1[i] * 0.98);
            l[i] /= ll;
            p0[i] = -l[i] * far;
            p1[i] = p0[i] + between(-0.1, 0.1) * far * turns;
            if (!punctual) continue;
            a.value[GN_VALUE_LIGHT + GN_LIGHT_POINT_AT + i] = rounded(65536 * p0[i]);
            b.value[GN_VALUE_LIGHT + GN_LIGHT_POINT_AT + i] = rounded(65536 * p1[i]);
        }
        for (int e = 0; e < 2; e++) {
            const double *n = e ? n1 : n0, *p = e ? p1 : p0;
            const double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            const double cosine = punctual ? -(n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) / size
                                           : (n[0] * l[0] + n[1] * l[1] + n[2] * l[2]) / size;
            (e ? &b : &a)->value[GN_VALUE_LIGHT] = rounded(cosine * (punctual ? 65536 : 1 << 24));
        }
        const int32_t steps = 8;
        if (!gn_chord_between(&chord, &frame, &surface, &a, &b, steps)) continue;
        held++;
        gn_sample here = a;
        for (int32_t p = 1; p < steps; p++) {
            double n[3], exact = 0, size = 0;
            const double t = (double)p / steps;
            gn_chord_next(&chord, here.value, surface.first_value);
            for (int i = 0; i < 3; i++) {
                n[i] = n0[i] + t * (n1[i] - n0[i]);
                size += n[i] * n[i];
                exact += n[i] * (punctual ? -(p0[i] + t * (p1[i] - p0[i])) : l[i]);
            }
            const double unit = punctual ? 65536 * far : 1 << 24;
            const double got = here.value[GN_VALUE_LIGHT] / unit, want = exact / sqrt(size) / (punctual ? far : 1);
            const double line =
                (a.value[GN_VALUE_LIGHT] + t * ((double)b.value[GN_VALUE_LIGHT] - a.value[GN_VALUE_LIGHT])) / unit;
            worst = fmax(worst, fabs(got - want));
            straight = fmax(straight, fabs(line - want));
        }
    }
    printf("n . l between samples: off by at most %.5f, straight chords by %.5f\n", worst, straight);
    CHECK(worst < 1 / 400.0 && straight > 2 * worst);
    CHECK(held > 50000);
}

/* What no parabola joins. */
static void test_refused(void)
{
    gn_sample a, b;
    gn_chord chord;
    setup(0);
    memset(&a, 0, sizeof a);
    a.value[GN_VALUE_Z] = 1 << 20;
    b = a;
    CHECK(gn_chord_between(&chord, &frame, &surface, &a, &b, 8));
    CHECK(chord.bend_first == chord.bend_end);
    b.cascade = 1;
    CHECK(!gn_chord_between(&chord, &frame, &surface, &a, &b, 8));
    b.cascade = 0;
    b.in_reach = 1;
    CHECK(!gn_chord_between(&chord, &frame, &surface, &a, &b, 8));
    b.in_reach = 0;
    b.value[GN_VALUE_Z] = 3 << 19; /* a = 1/5 */
    CHECK(!gn_chord_between(&chord, &frame, &surface, &a, &b, 8));
    surface.smooth = 1;
    b.value[GN_VALUE_Z] = 1 << 20;
    a.normal_q15[0] = b.normal_q15[0] = 30000;
    b.normal_q15[1] = 8000; /* 15 degrees */
    CHECK(!gn_chord_between(&chord, &frame, &surface, &a, &b, 8));
    b.normal_q15[1] = 7000;
    CHECK(gn_chord_between(&chord, &frame, &surface, &a, &b, 8));
}

/* The ends of every format: no step leaves it. */
static void test_extremes(void)
{
    static const int32_t ends[] = {INT32_MIN, -INT32_MAX, -1, 0, 1, 0x40000000, INT32_MAX - 1, INT32_MAX};
    setup(0);
    for (int k = 0; k < 100000; k++) {
        gn_sample a, b;
        gn_chord chord;
        flat_ends(&a, &b, between(-0.15, 0.15));
        surface.coloured = 0;
        surface.shadowed = 0;
        for (int32_t i = GN_VALUE_RGB; i < surface.n_values; i++) {
            a.value[i] = ends[rng_below(&state, 8)];
            b.value[i] = rng_below(&state, 4) ? ends[rng_below(&state, 8)] : a.value[i] - (a.value[i] > 0 ? 40 : -40);
        }
        const int32_t n = 2 + (int32_t)rng_below(&state, 15);
        if (!CHECK(gn_chord_between(&chord, &frame, &surface, &a, &b, n))) return;
        for (int32_t p = 1; p < n; p++) gn_chord_next(&chord, a.value, surface.first_value); /* sanitizers */
    }
}

int main(void)
{
    static gn_light scene_light;
    static gn_scene scene = {.lights = &scene_light, .n_lights = 1};
    frame.scene = &scene;
    test_perspective();
    test_turning();
    test_refused();
    test_extremes();
    return check_report();
}
