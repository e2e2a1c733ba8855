/* The truth engine from scene to picture: the reference's stages, with rays in place of shadow maps. */
#include "truth.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the reference calls instead of a shadow lookup: the part of light l, 0..1, that casters let through to a point.
 */
static double trace_surface(const void *user, const ref_surface *at, size_t l)
{
    const truth_tracer *tracer = user;
    const ref_triangle *t = &at->triangle;
    exact_point origin;
    for (int k = 0; k < 3; k++) {
        origin.vertex[k] = t->instance->world[t->idx[k]];
        origin.weight[k] = at->bary[k];
    }
    return truth_transmittance(tracer, &origin, truth_vertex_error(t), t, &tracer->s->lights[l]);
}

/* ---- several samples per pixel ---- */

/* Sums over the samples of each pixel. Only samples that show the triangle of the pixel's centre count for its shadow.
 */
typedef struct {
    double *rgb;
    double *shadow[REF_MAX_LIGHTS];
    uint32_t *n_shadows[REF_MAX_LIGHTS];
    int64_t *triangle; /* at the pixels' centres */
} sums;

static bool allocate(sums *sum, const ref_picture *p)
{
    const size_t n = (size_t)p->width * (size_t)p->height;
    *sum = (sums){.rgb = calloc(3 * n, sizeof *sum->rgb), .triangle = calloc(n, sizeof *sum->triangle)};
    bool ok = sum->rgb && sum->triangle;
    for (size_t l = 0; l < p->n_lights; l++) {
        sum->shadow[l] = calloc(n, sizeof *sum->shadow[l]);
        sum->n_shadows[l] = calloc(n, sizeof *sum->n_shadows[l]);
        ok = ok && sum->shadow[l] && sum->n_shadows[l];
    }
    if (ok) memcpy(sum->triangle, p->triangle, n * sizeof *sum->triangle);
    return ok;
}

static void free_sums(sums *sum)
{
    free(sum->rgb);
    free(sum->triangle);
    for (size_t l = 0; l < REF_MAX_LIGHTS; l++) {
        free(sum->shadow[l]);
        free(sum->n_shadows[l]);
    }
}

/* Adds the picture of one sample per pixel. */
static void add_picture(sums *sum, const ref_picture *p)
{
    const size_t n = (size_t)p->width * (size_t)p->height;
    for (size_t i = 0; i < 3 * n; i++) sum->rgb[i] += p->rgb[i];
    for (size_t l = 0; l < p->n_lights; l++)
        for (size_t i = 0; i < n; i++) {
            if (p->triangle[i] != sum->triangle[i] || !(p->ndotl[l][i] > 0.0)) continue;
            sum->shadow[l][i] += p->shadow[l][i];
            sum->n_shadows[l][i]++;
        }
}

/* The picture becomes the mean of its samples. A pixel whose centre faces a light, but none of whose samples does,
 * keeps the shadow at its centre; where the centre faces away, the shadow stays 0. */
static void take_means(ref_picture *p, const sums *sum, int samples)
{
    const size_t n = (size_t)p->width * (size_t)p->height;
    const double weight = 1.0 / ((double)samples * samples);
    for (size_t i = 0; i < 3 * n; i++) p->rgb[i] = sum->rgb[i] * weight;
    for (size_t l = 0; l < p->n_lights; l++)
        for (size_t i = 0; i < n; i++)
            if (p->ndotl[l][i] > 0.0 && sum->n_shadows[l][i] > 0)
                p->shadow[l][i] = sum->shadow[l][i] / sum->n_shadows[l][i];
}

/* Draws sample (i, j) of samples x samples in every pixel. The camera's picture is shifted by less than a pixel: the
 * grid of pixels stays, so all samples of a pixel have its dither. */
static void draw_sample(ref_frame *frame, int i, int j, int samples)
{
    const ref_camera centred = frame->camera;
    frame->camera.half_width_px -= (i + 0.5) / samples - 0.5;
    frame->camera.half_height_px -= (j + 0.5) / samples - 0.5;
    ref_find_surfaces(frame);
    ref_light_pixels(frame);
    frame->camera = centred;
}

/* A first pass at the centres tells each pixel's triangle. After the samples a last one leaves depth, normals and
 * triangles of the centres in the picture; colours and shadows then become the means. */
static const char *draw(ref_frame *frame, int samples)
{
    sums sum;
    draw_sample(frame, 0, 0, 1);
    if (samples == 1) return NULL;
    const bool ok = allocate(&sum, frame->picture);
    for (int k = 0; ok && k < samples * samples; k++) {
        draw_sample(frame, k % samples, k / samples, samples);
        add_picture(&sum, frame->picture);
    }
    if (ok) {
        draw_sample(frame, 0, 0, 1);
        take_means(frame->picture, &sum, samples);
    }
    free_sums(&sum);
    return ok ? NULL : "out of memory for the samples";
}

/* Shadow tiles were assigned, as cascades and fades depend on them, but nothing was drawn into them: none is left in
 * the result. */
static void forget_views(ref_picture *p)
{
    memset(p->grant, 0, sizeof p->grant);
    memset(p->view, 0, sizeof p->view);
}

int truth_render(ref_picture *out, const scene *s, const ref_options *options, int samples, char *error,
                 size_t error_bytes)
{
    ref_frame frame;
    truth_tracer tracer = {0};
    const char *fault = ref_begin(&frame, out, s, options);
    if (!fault && (samples < 1 || samples > TRUTH_MAX_SAMPLES)) fault = "samples out of range 1 to 16";
    if (!fault) fault = truth_begin(&tracer, &frame);
    frame.visibility = trace_surface;
    frame.visibility_user = &tracer;
    if (!fault) fault = draw(&frame, samples);
    if (!fault) ref_encode_pixels(&frame);
    out->n_layers = 0; /* they are mixed, in the mean of all samples */
    truth_end(&tracer);
    ref_end(&frame);
    forget_views(out);
    if (!fault) return 0;
    ref_free(out);
    if (error && error_bytes > 0) snprintf(error, error_bytes, "truth engine: %s", fault);
    return -1;
}
