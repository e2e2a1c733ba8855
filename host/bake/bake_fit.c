/* Least squares over the points of the texels, in a few steps: each texel moves by the mean of what is missing around
 * it, weighted as it weighs there. Rows of weights sum to 1, so steps below 2 converge; values end at 0 and 1. */
#include <stdlib.h>
#include <string.h>

#include "bake_internal.h"

enum { STEPS = 24 };
static const float step = 1.5F;

typedef struct {
    size_t texel[4];
    float weight[4];
} taps;

static int within(int v, int n)
{
    return v < 0 ? 0 : v < n ? v : n - 1;
}

/* Of point k in texel (x, y): the four texels around it. Beyond the edge it repeats. */
static taps taps_of(const bake_fit *fit, int x, int y, int k)
{
    const float u = (float)(k % fit->n) / (float)fit->n + 0.5F / (float)fit->n - 0.5F,
                v = (float)(k / fit->n) / (float)fit->n + 0.5F / (float)fit->n - 0.5F;
    const int x0 = u < 0 ? x - 1 : x, y0 = v < 0 ? y - 1 : y;
    const float fu = u < 0 ? u + 1 : u, fv = v < 0 ? v + 1 : v;
    taps t;
    for (int i = 0; i < 4; i++) {
        t.texel[i] = (size_t)(within(y0 + i / 2, fit->h) * fit->w + within(x0 + i % 2, fit->w));
        t.weight[i] = (i % 2 ? fu : 1 - fu) * (i / 2 ? fv : 1 - fv);
    }
    return t;
}

/* What is missing at one point, shared among its texels. */
static void add_point(const bake_fit *fit, const taps *t, const float *wanted, float *missing, float *weight)
{
    if (isnan(wanted[0])) return;
    for (int c = 0; c < BAKE_CHANNELS; c++) {
        float have = 0;
        for (int i = 0; i < 4; i++) have += t->weight[i] * fit->masks[BAKE_CHANNELS * t->texel[i] + (size_t)c];
        for (int i = 0; i < 4; i++)
            missing[BAKE_CHANNELS * t->texel[i] + (size_t)c] += t->weight[i] * (wanted[c] - have);
    }
    for (int i = 0; i < 4; i++) weight[t->texel[i]] += t->weight[i];
}

static void move(const bake_fit *fit, const float *missing, const float *weight)
{
    for (size_t i = 0; i < (size_t)fit->w * (size_t)fit->h; i++)
        for (size_t c = 0; fit->sample[i] && weight[i] > 0 && c < BAKE_CHANNELS; c++) {
            float *mask = &fit->masks[BAKE_CHANNELS * i + c];
            *mask += step * missing[BAKE_CHANNELS * i + c] / weight[i];
            *mask = *mask < 0 ? 0 : *mask > 1 ? 1 : *mask;
        }
}

int bake_fit_masks(bake_fit *fit)
{
    const size_t n = (size_t)fit->w * (size_t)fit->h, n_points = (size_t)fit->n * (size_t)fit->n;
    float *missing = calloc(n, BAKE_CHANNELS * sizeof *missing), *weight = calloc(n, sizeof *weight);
    for (int s = 0; missing && weight && s < STEPS && fit->n_sampled; s++) {
        memset(missing, 0, n * BAKE_CHANNELS * sizeof *missing);
        memset(weight, 0, n * sizeof *weight);
        for (size_t i = 0; i < n; i++)
            for (size_t k = 0; fit->sample[i] && k < n_points; k++) {
                const taps t = taps_of(fit, (int)(i % (size_t)fit->w), (int)(i / (size_t)fit->w), (int)k);
                add_point(fit, &t, fit->samples + BAKE_CHANNELS * (n_points * (fit->sample[i] - 1) + k), missing,
                          weight);
            }
        move(fit, missing, weight);
    }
    const int failed = missing && weight ? 0 : -1;
    free(missing);
    free(weight);
    return failed;
}
