/* Writes host/tool/cost/cost_table.h: weights of the counted events, fitted to
 * instructions. From stdin, per line: the scene, instructions until the screen
 * tiles, of rasterising, of shading; the events in their order until the screen
 * tiles, then the same in them. tests/bench/calibrate.sh feeds it.
 *
 * Each stage is fitted on its own, with the events that it can depend on, by
 * least squares of its error as a share of the picture; no weight is negative,
 * as no event takes instructions back. The error is that of whole pictures,
 * stated twice: of the fit, and for scenes that were left out of it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/gn_count.h"

enum { SAMPLES_MAX = 2000, SCENES_MAX = 64, STAGES = 3, PASSES = 5000 };

/* A weight that few samples tell anything about stays small: 1000 instructions are as bad as this much of the sum of
 * squares. */
#ifndef RIDGE_OF_1000
#define RIDGE_OF_1000 1e-3
#endif
#define RIDGE (RIDGE_OF_1000 / 1e6)

typedef struct {
    char scene[64];
    double instructions[STAGES], total;
    double prepare[GN_COUNT_N], tiles[GN_COUNT_N];
} sample;

static sample samples[SAMPLES_MAX];
static size_t n_samples;

typedef struct {
    double weight[GN_COUNT_N]; /* of all stages */
} model;

#define NAME_(event, what) #event,
static const char *const name[GN_COUNT_N] = {GN_COUNT_EVENTS(NAME_)};
#define WHAT_(event, what) what,
static const char *const meaning[GN_COUNT_N] = {GN_COUNT_EVENTS(WHAT_)};

static int in_stage(int event, int stage)
{
    const int shared =
        event == GN_COUNT_tile_refs || event == GN_COUNT_pixels || event == GN_COUNT_rows || event == GN_COUNT_covered;
    if (stage == 0) return event < GN_COUNT_tile_refs;
    if (stage == 1) return event >= GN_COUNT_tile_refs && event <= GN_COUNT_covered_cut;
    return event >= GN_COUNT_surfaces || shared || event == GN_COUNT_posed_normals;
}

static double count_of(const sample *s, int event, int stage)
{
    return stage == 0 ? s->prepare[event] : s->tiles[event];
}

/* ---- The fit ----------------------------------------------------------------------------------------------------- */

/* Normal equations of one stage. */
typedef struct {
    double square[GN_COUNT_N][GN_COUNT_N], along[GN_COUNT_N];
} equations;

static void add_sample(equations *e, const sample *s, int stage)
{
    double x[GN_COUNT_N];
    for (int i = 0; i < GN_COUNT_N; i++) x[i] = in_stage(i, stage) ? count_of(s, i, stage) / s->total : 0;
    for (int i = 0; i < GN_COUNT_N; i++) {
        if (x[i] == 0) continue;
        e->along[i] += x[i] * s->instructions[stage] / s->total;
        for (int k = 0; k < GN_COUNT_N; k++) e->square[i][k] += x[i] * x[k];
    }
}

/* One weight at a time, all others given. */
static void solve(const equations *e, double *weight)
{
    for (int pass = 0; pass < PASSES; pass++)
        for (int i = 0; i < GN_COUNT_N; i++) {
            double rest = e->along[i];
            if (e->square[i][i] <= 0) continue;
            for (int k = 0; k < GN_COUNT_N; k++) rest -= k == i ? 0 : e->square[i][k] * weight[k];
            weight[i] = fmax(rest / (e->square[i][i] + RIDGE), 0);
        }
}

static void fit(model *m, const char *except)
{
    static equations e;
    memset(m, 0, sizeof *m);
    for (int stage = 0; stage < STAGES; stage++) {
        double weight[GN_COUNT_N] = {0};
        memset(&e, 0, sizeof e);
        for (size_t i = 0; i < n_samples; i++)
            if (strcmp(samples[i].scene, except) != 0) add_sample(&e, &samples[i], stage);
        solve(&e, weight);
        for (int i = 0; i < GN_COUNT_N; i++) m->weight[i] += weight[i];
    }
}

/* ---- Its error --------------------------------------------------------------------------------------------------- */

/* As the tool adds events up. */
static double relative_error(const model *m, const sample *s)
{
    double guess = 0;
    for (int i = 0; i < GN_COUNT_N; i++) guess += m->weight[i] * (s->prepare[i] + s->tiles[i]);
    return guess / s->total - 1;
}

typedef struct {
    double error[SAMPLES_MAX];
    size_t n;
} errors;

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Over the samples of a scene; NULL: all. */
static void add_errors(errors *e, const model *m, const char *scene)
{
    for (size_t i = 0; i < n_samples; i++)
        if (!scene || strcmp(scene, samples[i].scene) == 0) e->error[e->n++] = fabs(relative_error(m, &samples[i]));
}

static void print_errors(errors *e)
{
    double sum = 0;
    qsort(e->error, e->n, sizeof *e->error, by_size);
    for (size_t i = 0; i < e->n; i++) sum += e->error[i] * e->error[i];
    printf("%.1f %% RMS, %.1f %% at most", 100 * sqrt(sum / (double)e->n), 100 * e->error[e->n - 1]);
}

/* ---- Samples ----------------------------------------------------------------------------------------------------- */

static int read_numbers(double *out, int n)
{
    for (int i = 0; i < n; i++)
        if (scanf("%lf", &out[i]) != 1) return -1;
    return 0;
}

static int read_sample(sample *s)
{
    if (scanf("%63s", s->scene) != 1) return 0;
    if (read_numbers(s->instructions, STAGES) || read_numbers(s->prepare, GN_COUNT_N) ||
        read_numbers(s->tiles, GN_COUNT_N))
        return -1;
    for (int i = 0; i < STAGES; i++) s->total += s->instructions[i];
    return s->total > 0 ? 1 : -1;
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

/* Scene by scene, each left out; then the error that nine in ten of these pictures keep, which it returns in per cent.
 */
static int print_left_out(const char *const *scenes, size_t n_scenes)
{
    static errors all, one;
    static model some;
    for (size_t i = 0; i < n_scenes; i++) {
        one.n = 0;
        fit(&some, scenes[i]);
        add_errors(&one, &some, scenes[i]);
        add_errors(&all, &some, scenes[i]);
        printf(" *   %s: ", scenes[i]);
        print_errors(&one);
        printf("\n");
    }
    printf(" * All that were left out: ");
    print_errors(&all);
    printf("; nine in ten within %.1f %%.\n", 100 * all.error[all.n * 9 / 10]);
    return (int)ceil(100 * all.error[all.n * 9 / 10]);
}

int main(int argc, char **argv)
{
    static model all;
    static errors e;
    const char *scenes[SCENES_MAX];
    int status = 0;
    while (n_samples < SAMPLES_MAX && (status = read_sample(&samples[n_samples])) > 0) n_samples++;
    if (status < 0 || !n_samples) {
        fprintf(stderr, "gen_costs: bad input at sample %zu\n", n_samples);
        return 1;
    }
    const size_t n_scenes = list_scenes(scenes);
    fit(&all, "");
    add_errors(&e, &all, NULL);
    printf("/* Generated by tests/bench/calibrate.sh: instructions per event, Cortex-M3, -O2,\n * %s.\n * Fitted to "
           "%zu pictures of %zu scenes, counted in the emulator. Error of a picture's total: ",
           argc > 1 ? argv[1] : "", n_samples, n_scenes);
    print_errors(&e);
    printf(".\n * Of a scene that is left out of the fit:\n");
    const int kept = print_left_out(scenes, n_scenes);
    printf(" */\n/* clang-format off */\n#define COST_ERROR_PERCENT %d\n", kept);
    for (int event = 0; event < GN_COUNT_N; event++)
        printf("COST(%s, %.4g) /* %s */\n", name[event], all.weight[event], meaning[event]);
    return 0;
}
