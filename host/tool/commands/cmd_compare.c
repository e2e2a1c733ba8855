/* gnomon compare: the library against the reference, and both against the truth. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../../scene/image/png.h"
#include "../picture/metrics.h"
#include "../cli/remarks.h"
#include "../cli/tool.h"

/* The engines in the order of their pictures. */
enum { FIXED, REFERENCE, TRUTH, N_ENGINES };
static const char *const engine_names[N_ENGINES] = {"fixed", "reference", "truth"};

/* Pairs to compare: with the reference only the first. */
typedef struct {
    int judged, against;
    const char *key;   /* in --json */
    const char *cost;  /* what it tells */
    const char *error; /* the picture of the error */
} pair;
static const pair pairs[] = {
    {FIXED, REFERENCE, "fixed_reference", "what fixed point costs", "error_fixed_reference.png"},
    {REFERENCE, TRUTH, "reference_truth", "what the shadow map costs", "error_reference_truth.png"},
    {FIXED, TRUTH, "fixed_truth", "both", "error_fixed_truth.png"},
};
enum { N_PAIRS = sizeof pairs / sizeof *pairs };

/* What is compared. */
typedef struct {
    int n_engines, n_pairs;
    engine_picture picture[N_ENGINES];
    metrics m[N_PAIRS];
    long ram_bytes;
} comparison;

static bool is_with_truth(const tool_options *o)
{
    return strcmp(o->with, "truth") == 0;
}

/* ---- numbers ---- */

static void print_number(const char *name, double v)
{
    if (isinf(v)) printf(", \"%s\": null", name);
    else printf(", \"%s\": %.9g", name, v);
}

/* The members of a pair's object before and after "ram_bytes". */
static void print_summary(const metrics *m)
{
    printf("\"identical\": %.9g", m->identical);
    print_number("within1", m->within1);
    print_number("psnr_db", m->psnr_db);
    printf(", \"max_error\": %d", m->max_error);
    print_number("atten_rms", m->atten_rms);
    print_number("atten_max", m->atten_max);
    print_number("shadow_mismatch", m->shadow_mismatch);
    print_number("coverage_mismatch", m->coverage_mismatch);
}

static void print_details(const metrics *m)
{
    printf(", \"lights\": [");
    for (size_t l = 0; l < m->n_lights; l++)
        printf("%s{\"atten_rms\": %.9g, \"atten_max\": %.9g, \"shadow_mismatch\": %.9g, \"pixels\": %ld}",
               l ? ", " : "", m->light[l].atten_rms, m->light[l].atten_max, m->light[l].shadow_mismatch,
               m->light[l].pixels);
    printf("], \"differing_pixels\": {\"coverage\": %ld, \"shadow\": %ld, \"light\": %ld, \"rounding\": %ld}",
           m->by_coverage, m->by_shadow, m->by_light, m->by_rounding);
    printf(", \"worst_pixel\": {\"x\": %d, \"y\": %d, \"cause\": \"%s\"}", m->worst_x, m->worst_y, m->worst_cause);
}

static void print_json(const tool_options *o, const comparison *c)
{
    printf("{\"scene\": ");
    tool_json_string(o->scene_path);
    printf(", \"with\": \"%s\", \"width\": %d, \"height\": %d, ", o->with, o->width, o->height);
    if (!is_with_truth(o)) {
        print_summary(&c->m[0]);
        printf(", \"ram_bytes\": %ld", c->ram_bytes);
        print_details(&c->m[0]);
    } else {
        printf("\"samples\": %d, \"ram_bytes\": %ld", tool_samples(o), c->ram_bytes);
        for (int i = 0; i < c->n_pairs; i++) {
            printf(", \"%s\": {", pairs[i].key);
            print_summary(&c->m[i]);
            print_details(&c->m[i]);
            printf("}");
        }
    }
    printf("}\n");
}

static void print_metrics(const metrics *m)
{
    printf("  identical (RGB565)    %8.4f %%\n", 100 * m->identical);
    printf("  within one step       %8.4f %%\n", 100 * m->within1);
    if (isinf(m->psnr_db)) printf("  PSNR (8-bit)               inf\n");
    else printf("  PSNR (8-bit)          %8.2f dB\n", m->psnr_db);
    printf("  largest error         %8d levels of 255, at (%d, %d): %s\n", m->max_error, m->worst_x, m->worst_y,
           m->worst_cause);
    printf("  attenuation RMS, max  %8.6f, %.4f\n", m->atten_rms, m->atten_max);
    printf("  shadow mismatch       %8.4f %%   (attenuation off by more than 1/16)\n", 100 * m->shadow_mismatch);
    printf("  coverage mismatch     %8.4f %%   (another triangle is visible)\n", 100 * m->coverage_mismatch);
    printf("  differing pixels      %ld coverage, %ld shadow, %ld light, %ld rounding\n", m->by_coverage, m->by_shadow,
           m->by_light, m->by_rounding);
}

static void print_text(const tool_options *o, const comparison *c)
{
    for (int i = 0; i < c->n_pairs; i++) {
        printf("%s, %dx%d, %s against %s", o->scene_path, o->width, o->height, engine_names[pairs[i].judged],
               engine_names[pairs[i].against]);
        if (is_with_truth(o)) printf(": %s", pairs[i].cost);
        printf("\n");
        print_metrics(&c->m[i]);
    }
    printf("  library RAM           %8ld bytes\n", c->ram_bytes);
}

/* ---- pictures ---- */

/* One of the pictures that -o writes. */
typedef struct {
    int width, height;
    uint8_t *rgb8;
} sheet;

typedef struct {
    sheet engine[N_ENGINES], error[N_PAIRS], beside;
} sheets;

static bool draw_engines(sheets *p, const tool_options *o, const comparison *c, char *error, size_t bytes)
{
    for (int i = 0; i < c->n_engines; i++) {
        sheet *s = &p->engine[i], *first = &p->engine[0];
        s->rgb8 = view_draw(&c->picture[i], (view_kind)o->view, o->light, &s->width, &s->height, error, bytes);
        if (!s->rgb8) return false;
        if (s->width == first->width && s->height == first->height) continue;
        snprintf(error, bytes, "the views differ in size: %dx%d and %dx%d", first->width, first->height, s->width,
                 s->height);
        return false;
    }
    return true;
}

static bool draw_errors(sheets *p, const comparison *c)
{
    for (int i = 0; i < c->n_pairs; i++) {
        const sheet *a = &p->engine[pairs[i].judged], *b = &p->engine[pairs[i].against];
        p->error[i] =
            (sheet){.width = a->width, .height = a->height, .rgb8 = view_error(a->rgb8, b->rgb8, a->width, a->height)};
        if (!p->error[i].rgb8) return false;
    }
    return true;
}

/* The engines' pictures, then the errors: three in one row, six in two. */
static bool draw_beside(sheets *p, const comparison *c)
{
    const uint8_t *all[N_ENGINES + N_PAIRS];
    const int n = c->n_engines + c->n_pairs;
    for (int i = 0; i < c->n_engines; i++) all[i] = p->engine[i].rgb8;
    for (int i = 0; i < c->n_pairs; i++) all[c->n_engines + i] = p->error[i].rgb8;
    const int w = p->engine[0].width, h = p->engine[0].height;
    if (n == 3) {
        p->beside.rgb8 = view_beside(all, 3, w, h, &p->beside.width, &p->beside.height);
        return p->beside.rgb8 != NULL;
    }
    sheet row[2];
    for (int i = 0; i < 2; i++) row[i].rgb8 = view_beside(all + 3 * i, 3, w, h, &row[i].width, &row[i].height);
    const uint8_t *const rows[2] = {row[0].rgb8, row[1].rgb8};
    if (rows[0] && rows[1])
        p->beside.rgb8 = view_beside(rows, 2, row[0].width, row[0].height, &p->beside.width, &p->beside.height);
    free(row[0].rgb8);
    free(row[1].rgb8);
    return p->beside.rgb8 != NULL;
}

static int write_png(const char *dir, const char *name, const sheet *p, char *error, size_t bytes)
{
    char path[4096];
    if (snprintf(path, sizeof path, "%s/%s", dir, name) >= (int)sizeof path) {
        snprintf(error, bytes, "path too long");
        return -1;
    }
    return png_write_rgb8(path, p->width, p->height, p->rgb8, error, bytes);
}

static int write_all(const sheets *p, const tool_options *o, const comparison *c, char *error, size_t bytes)
{
    if (mkdir(o->out_path, 0777) && errno != EEXIST) {
        snprintf(error, bytes, "cannot create the folder: %s", strerror(errno));
        return -1;
    }
    for (int i = 0; i < c->n_engines; i++) {
        char name[32];
        snprintf(name, sizeof name, "%s.png", engine_names[i]);
        if (write_png(o->out_path, name, &p->engine[i], error, bytes)) return -1;
    }
    for (int i = 0; i < c->n_pairs; i++)
        if (write_png(o->out_path, is_with_truth(o) ? pairs[i].error : "error.png", &p->error[i], error, bytes))
            return -1;
    return write_png(o->out_path, "beside.png", &p->beside, error, bytes);
}

static int write_pictures(const tool_options *o, const comparison *c, char *error, size_t bytes)
{
    sheets p = {0};
    int failed = !draw_engines(&p, o, c, error, bytes) || !draw_errors(&p, c) || !draw_beside(&p, c);
    if (!failed) failed = write_all(&p, o, c, error, bytes);
    for (int i = 0; i < N_ENGINES; i++) free(p.engine[i].rgb8);
    for (int i = 0; i < N_PAIRS; i++) free(p.error[i].rgb8);
    free(p.beside.rgb8);
    return failed ? -1 : 0;
}

/* ---- the command ---- */

/* Engines that were not reached stay empty. */
static int draw_all(comparison *c, const tool_options *o, const scene *s, const settings *set, char *error,
                    size_t bytes)
{
    const int w = o->width, h = o->height;
    if (engine_fixed(&c->picture[FIXED], s, set, w, h, ENGINE_ALL, error, bytes)) return -1;
    if (engine_reference(&c->picture[REFERENCE], s, set, w, h, error, bytes)) return -1;
    if (!is_with_truth(o)) return 0;
    return engine_truth(&c->picture[TRUTH], s, set, w, h, tool_samples(o), error, bytes);
}

static int compare(comparison *c, const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    if (tool_load(o, &s, &set)) return TOOL_FAILED;
    int failed = draw_all(c, o, &s, &set, error, sizeof error) || remarks_on_shadows(&s, error, sizeof error);
    if (!failed && !o->json) {
        remarks_on_settings(&s);
        remarks_on_view(&s, o->width, o->height);
        remarks_on_frame(&s, o->frame);
        remarks_on_picture(&s, &c->picture[FIXED]);
        remarks_on_brightness(&s, &set, &c->picture[FIXED]);
    }
    settings_trim(&set, &s);
    scene_free(&s);
    if (failed) return tool_fail(o->scene_path, error);
    settings_fit(&set, &c->picture[FIXED].demand);
    c->ram_bytes = settings_ram(&set).total;
    for (int i = 0; i < c->n_pairs; i++)
        metrics_compute(&c->m[i], &c->picture[pairs[i].judged], &c->picture[pairs[i].against]);
    if (o->out_path && write_pictures(o, c, error, sizeof error)) return tool_fail(o->out_path, error);
    return TOOL_OK;
}

int tool_compare(const tool_options *o)
{
    comparison *c = calloc(1, sizeof *c);
    if (!c) return tool_fail(o->scene_path, "out of memory");
    c->n_engines = is_with_truth(o) ? N_ENGINES : TRUTH;
    c->n_pairs = is_with_truth(o) ? N_PAIRS : 1;
    const int status = compare(c, o);
    if (status == TOOL_OK) {
        if (o->json) print_json(o, c);
        else print_text(o, c);
    }
    for (int i = 0; i < N_ENGINES; i++) engine_free(&c->picture[i]);
    free(c);
    return status;
}
