/* Accuracy metrics. */
#include "metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int steps565(uint16_t a, uint16_t b)
{
    int r = abs((a >> 11) - (b >> 11)), g = abs((a >> 5 & 63) - (b >> 5 & 63)), blue = abs((a & 31) - (b & 31));
    return r > g ? (r > blue ? r : blue) : (g > blue ? g : blue);
}

/* Below this cosine a surface is edge-on to a light: which side it faces is rounding, and it receives nothing that
 * could be seen. */
#define FACING_LEAST 1e-5

static int comparable(const engine_picture *fixed, const engine_picture *other, size_t light, size_t i)
{
    return fixed->triangle[i] >= 0 && fixed->triangle[i] == other->triangle[i] && other->ndotl[light][i] > FACING_LEAST;
}

static void attenuation(metrics *m, const engine_picture *fixed, const engine_picture *other)
{
    double sum_all = 0;
    long wrong_all = 0, n_all = 0;
    for (size_t l = 0; l < m->n_lights; l++) {
        light_metrics *lm = &m->light[l];
        double sum = 0;
        long wrong = 0;
        for (size_t i = 0; i < (size_t)m->pixels; i++) {
            if (!comparable(fixed, other, l, i)) continue;
            double d = fabs(fixed->shadow[l][i] - other->shadow[l][i]);
            sum += d * d;
            wrong += d > 1.0 / 16;
            lm->atten_max = fmax(lm->atten_max, d);
            lm->pixels++;
        }
        if (lm->pixels) {
            lm->atten_rms = sqrt(sum / (double)lm->pixels);
            lm->shadow_mismatch = (double)wrong / (double)lm->pixels;
        }
        sum_all += sum;
        wrong_all += wrong;
        n_all += lm->pixels;
        m->atten_max = fmax(m->atten_max, lm->atten_max);
    }
    if (n_all) {
        m->atten_rms = sqrt(sum_all / (double)n_all);
        m->shadow_mismatch = (double)wrong_all / (double)n_all;
    }
}

static const char *const cause_names[] = {"coverage", "shadow", "light", "rounding"};
typedef enum { COVERAGE, SHADOW, LIGHT, ROUNDING } cause;

/* Rounding is what one step explains: where colours are farther apart under the same shadow, the light itself differs.
 */
static cause cause_of(const metrics *m, const engine_picture *fixed, const engine_picture *other, size_t i, int steps)
{
    if (fixed->triangle[i] != other->triangle[i]) return COVERAGE;
    for (size_t l = 0; l < m->n_lights; l++)
        if (fabs(fixed->shadow[l][i] - other->shadow[l][i]) > 1.0 / 256) return SHADOW;
    return steps > 1 ? LIGHT : ROUNDING;
}

static void count_cause(metrics *m, cause why)
{
    if (why == COVERAGE) m->by_coverage++;
    else if (why == SHADOW) m->by_shadow++;
    else if (why == LIGHT) m->by_light++;
    else m->by_rounding++;
}

static int worst_channel(const uint8_t *a, const uint8_t *b, size_t i, double *squares)
{
    int worst = 0;
    for (size_t k = 0; k < 3; k++) {
        int d = abs(a[3 * i + k] - b[3 * i + k]);
        *squares += (double)d * d;
        worst = d > worst ? d : worst;
    }
    return worst;
}

static double psnr_db(double squares, long pixels)
{
    return squares > 0 ? 10 * log10(255.0 * 255.0 * 3.0 * (double)pixels / squares) : (double)INFINITY;
}

double metrics_psnr_db(const uint8_t *a, const uint8_t *b, size_t n)
{
    double squares = 0;
    for (size_t i = 0; i < n; i++) worst_channel(a, b, i, &squares);
    return psnr_db(squares, (long)n);
}

void metrics_compute(metrics *m, const engine_picture *fixed, const engine_picture *other)
{
    memset(m, 0, sizeof *m);
    m->pixels = (long)fixed->width * fixed->height;
    m->n_lights = fixed->n_lights < other->n_lights ? fixed->n_lights : other->n_lights;
    m->worst_cause = "none";
    long same = 0, near = 0, other_triangle = 0;
    double squares = 0;
    for (size_t i = 0; i < (size_t)m->pixels; i++) {
        int steps = steps565(fixed->rgb565[i], other->rgb565[i]),
            worst = worst_channel(fixed->rgb8, other->rgb8, i, &squares);
        same += steps == 0;
        near += steps <= 1;
        other_triangle += fixed->triangle[i] != other->triangle[i];
        if (!steps && worst <= m->max_error) continue;
        const cause why = cause_of(m, fixed, other, i, steps);
        if (steps) count_cause(m, why);
        if (worst > m->max_error) {
            m->max_error = worst;
            m->worst_x = (int)(i % (size_t)fixed->width);
            m->worst_y = (int)(i / (size_t)fixed->width);
            m->worst_cause = cause_names[why];
        }
    }
    m->identical = (double)same / (double)m->pixels;
    m->within1 = (double)near / (double)m->pixels;
    m->coverage_mismatch = (double)other_triangle / (double)m->pixels;
    m->psnr_db = psnr_db(squares, m->pixels);
    attenuation(m, fixed, other);
}
