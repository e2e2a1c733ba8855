/* Writes host/tool/cost/cost_table.h: weights of the counted events, fitted to instructions. From stdin, per line: the
 * scene, instructions of shadow tiles, setup and binning, rasterising, shading, and the events in their order.
 * tests/bench/calibrate.sh feeds it.
 *
 * Each stage is fitted on its own, with the events that it can depend on, by least squares of the relative error; no
 * weight is negative, as no event takes instructions back. The error is stated twice: of the fit, and for scenes that
 * were left out of it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/gn_count.h"

enum { SAMPLES_MAX = 2000, SCENES_MAX = 64, STAGES = 4, PASSES = 20000 };

/* A weight that few samples tell anything about stays small: 1000 instructions are as bad as this much of the sum of
 * squares. */
#ifndef RIDGE_OF_1000
#define RIDGE_OF_1000 1e-3
#endif
#define RIDGE (RIDGE_OF_1000 / 1e6)

typedef struct {
    char scene[64];
    double instructions[STAGES];
    double n[GN_COUNT_N];
} sample;

static sample samples[SAMPLES_MAX];
static size_t n_samples;

typedef struct {
    double weight[STAGES][GN_COUNT_N];
} model;

#define NAME_(event, what) #event,
static const char *const name[GN_COUNT_N] = {GN_COUNT_EVENTS(NAME_)};
#define WHAT_(event, what) what,
static const char *const meaning[GN_COUNT_N] = {GN_COUNT_EVENTS(WHAT_)};

static int in_stage(int event, int stage)
{
    int shared =
        event == GN_COUNT_tile_refs || event == GN_COUNT_pixels || event == GN_COUNT_rows || event == GN_COUNT_covered;
    switch (stage) {
    case 0:
        return event < GN_COUNT_triangles;
    case 1:
        return event >= GN_COUNT_triangles && event <= GN_COUNT_screen_tiles;
    case 2:
        return event >= GN_COUNT_tile_refs && event <= GN_COUNT_covered_cut;
    default:
        return event >= GN_COUNT_surfaces || shared;
    }
}

/* One event's weight, all others given: the residuals are kept up to date. */
static void improve(double *weight, int event, int stage, const char *except, double *residual)
{
    double along = 0, square = 0;
    for (size_t i = 0; i < n_samples; i++) {
        double y = samples[i].instructions[stage], x = y > 0 ? samples[i].n[event] / y : 0;
        if (strcmp(samples[i].scene, except) == 0) continue;
        along += x * residual[i];
        square += x * x;
    }
    if (square <= 0) return;
    along -= RIDGE * *weight;
    square += RIDGE;
    double next = fmax(*weight + along / square, 0), change = next - *weight;
    for (size_t i = 0; i < n_samples; i++) {
        double y = samples[i].instructions[stage];
        if (y > 0) residual[i] -= change * samples[i].n[event] / y;
    }
    *weight = next;
}

static void fit(model *m, const char *except)
{
    static double residual[SAMPLES_MAX];
    memset(m, 0, sizeof *m);
    for (int stage = 0; stage < STAGES; stage++) {
        for (size_t i = 0; i < n_samples; i++) residual[i] = samples[i].instructions[stage] > 0 ? 1 : 0;
        for (int pass = 0; pass < PASSES; pass++)
            for (int event = 0; event < GN_COUNT_N; event++)
                if (in_stage(event, stage)) improve(&m->weight[stage][event], event, stage, except, residual);
    }
}

static double relative_error(const model *m, const sample *s)
{
    double real = 0, guess = 0;
    for (int stage = 0; stage < STAGES; stage++) {
        real += s->instructions[stage];
        for (int event = 0; event < GN_COUNT_N; event++) guess += m->weight[stage][event] * s->n[event];
    }
    return guess / real - 1;
}

static int read_sample(sample *s)
{
    if (scanf("%63s", s->scene) != 1) return 0;
    for (int i = 0; i < STAGES; i++)
        if (scanf("%lf", &s->instructions[i]) != 1) return -1;
    for (int i = 0; i < GN_COUNT_N; i++)
        if (scanf("%lf", &s->n[i]) != 1) return -1;
    return 1;
}

/* Scenes in the order in which they come. */
static size_t list_scenes(const char **scenes)
{
    size_t n = 0;
    for (size_t i = 0; i < n_samples; i++) {
        size_t k = 0;
        while (k < n && strcmp(scenes[k], samples[i].scene) != 0) k++;
        if (k == n && n < SCENES_MAX) scenes[n++] = samples[i].scene;
    }
    return n;
}

/* RMS and largest error, in percent, over the samples of a scene; NULL: all. */
static void print_error(const model *m, const char *scene)
{
    double sum = 0, worst = 0;
    size_t n = 0;
    for (size_t i = 0; i < n_samples; i++) {
        if (scene && strcmp(scene, samples[i].scene) != 0) continue;
        double e = fabs(relative_error(m, &samples[i]));
        sum += e * e;
        worst = fmax(worst, e);
        n++;
    }
    printf("%.1f %% RMS, %.1f %% at most", 100 * sqrt(sum / (double)n), 100 * worst);
}

int main(int argc, char **argv)
{
    static model all, some;
    const char *scenes[SCENES_MAX];
    int status = 0;
    while (n_samples < SAMPLES_MAX && (status = read_sample(&samples[n_samples])) > 0) n_samples++;
    if (status < 0 || !n_samples) {
        fprintf(stderr, "gen_costs: bad input at sample %zu\n", n_samples);
        return 1;
    }
    size_t n_scenes = list_scenes(scenes);
    fit(&all, "");
    printf("/* Generated by tests/bench/calibrate.sh: instructions per event, x86-64, %s, -O2,\n",
           argc > 1 ? argv[1] : "");
    printf(" * knobs at run time. Fitted to callgrind's counts of %zu pictures of %zu scenes.\n * Error of a picture's "
           "total: ",
           n_samples, n_scenes);
    print_error(&all, NULL);
    printf(".\n * Of a scene that is left out of the fit:\n");
    for (size_t i = 0; i < n_scenes; i++) {
        fit(&some, scenes[i]);
        printf(" *   %s: ", scenes[i]);
        print_error(&some, scenes[i]);
        printf("\n");
    }
    printf(" */\n/* clang-format off */\n");
    for (int event = 0; event < GN_COUNT_N; event++) {
        double sum = 0;
        for (int stage = 0; stage < STAGES; stage++) sum += all.weight[stage][event];
        printf("COST(%s, %.4g) /* %s */\n", name[event], sum, meaning[event]);
    }
    return 0;
}
