/* gnomon compare: the library against the reference. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../scene/png.h"
#include "metrics.h"
#include "tool.h"

static void print_number(const char *name, double v)
{
    if (isinf(v)) printf(", \"%s\": null", name);
    else printf(", \"%s\": %.9g", name, v);
}

static void print_json(const tool_options *o, const metrics *m, long ram_bytes)
{
    printf("{\"scene\": ");
    tool_json_string(o->scene_path);
    printf(", \"with\": \"reference\", \"width\": %d, \"height\": %d", o->width, o->height);
    print_number("identical", m->identical);
    print_number("within1", m->within1);
    print_number("psnr_db", m->psnr_db);
    printf(", \"max_error\": %d", m->max_error);
    print_number("atten_rms", m->atten_rms);
    print_number("atten_max", m->atten_max);
    print_number("shadow_mismatch", m->shadow_mismatch);
    print_number("coverage_mismatch", m->coverage_mismatch);
    printf(", \"ram_bytes\": %ld, \"lights\": [", ram_bytes);
    for (size_t l = 0; l < m->n_lights; l++)
        printf("%s{\"atten_rms\": %.9g, \"atten_max\": %.9g, \"shadow_mismatch\": %.9g, \"pixels\": %ld}", l ? ", " : "",
               m->light[l].atten_rms, m->light[l].atten_max, m->light[l].shadow_mismatch, m->light[l].pixels);
    printf("], \"differing_pixels\": {\"coverage\": %ld, \"shadow\": %ld, \"rounding\": %ld}", m->by_coverage, m->by_shadow,
           m->by_rounding);
    printf(", \"worst_pixel\": {\"x\": %d, \"y\": %d, \"cause\": \"%s\"}}\n", m->worst_x, m->worst_y, m->worst_cause);
}

static void print_text(const tool_options *o, const metrics *m, long ram_bytes)
{
    printf("%s, %dx%d, fixed against reference\n", o->scene_path, o->width, o->height);
    printf("  identical (RGB565)    %8.4f %%\n", 100 * m->identical);
    printf("  within one step       %8.4f %%\n", 100 * m->within1);
    if (isinf(m->psnr_db)) printf("  PSNR (8-bit)               inf\n");
    else printf("  PSNR (8-bit)          %8.2f dB\n", m->psnr_db);
    printf("  largest error         %8d levels of 255, at (%d, %d): %s\n", m->max_error, m->worst_x, m->worst_y, m->worst_cause);
    printf("  attenuation RMS, max  %8.6f, %.4f\n", m->atten_rms, m->atten_max);
    printf("  shadow mismatch       %8.4f %%   (attenuation off by more than 1/16)\n", 100 * m->shadow_mismatch);
    printf("  coverage mismatch     %8.4f %%   (another triangle is visible)\n", 100 * m->coverage_mismatch);
    printf("  differing pixels      %ld coverage, %ld shadow, %ld rounding\n", m->by_coverage, m->by_shadow, m->by_rounding);
    printf("  library RAM           %8ld bytes\n", ram_bytes);
}

/* One of the pictures that -o writes. */
typedef struct {
    int width, height;
    uint8_t *rgb8;
} sheet;

static int write_png(const char *dir, const char *name, const sheet *p, char *error, size_t bytes)
{
    char path[4096];
    if (snprintf(path, sizeof path, "%s/%s", dir, name) >= (int)sizeof path) {
        snprintf(error, bytes, "path too long");
        return -1;
    }
    return png_write_rgb8(path, p->width, p->height, p->rgb8, error, bytes);
}

static int write_pictures(const tool_options *o, const engine_picture *fixed, const engine_picture *other, char *error,
                          size_t bytes)
{
    static const char *const names[] = {"fixed.png", "reference.png", "error.png", "beside.png"};
    const view_kind view = (view_kind)o->view;
    sheet sheets[4] = {{0}};
    sheet *a = &sheets[0], *b = &sheets[1], *difference = &sheets[2], *beside = &sheets[3];
    a->rgb8 = view_draw(fixed, view, o->light, &a->width, &a->height, error, bytes);
    if (a->rgb8) b->rgb8 = view_draw(other, view, o->light, &b->width, &b->height, error, bytes);
    int failed = !a->rgb8 || !b->rgb8;
    if (!failed && (a->width != b->width || a->height != b->height)) {
        snprintf(error, bytes, "the views differ in size: %dx%d and %dx%d", a->width, a->height, b->width, b->height);
        failed = 1;
    }
    if (!failed) {
        difference->width = a->width;
        difference->height = a->height;
        difference->rgb8 = view_error(a->rgb8, b->rgb8, a->width, a->height);
        const uint8_t *const three[3] = {a->rgb8, b->rgb8, difference->rgb8};
        if (difference->rgb8) beside->rgb8 = view_beside(three, 3, a->width, a->height, &beside->width, &beside->height);
        failed = !beside->rgb8;
    }
    if (!failed && mkdir(o->out_path, 0777) && errno != EEXIST) {
        snprintf(error, bytes, "cannot create the folder: %s", strerror(errno));
        failed = 1;
    }
    for (size_t i = 0; i < 4; i++) {
        if (!failed) failed = write_png(o->out_path, names[i], &sheets[i], error, bytes);
        free(sheets[i].rgb8);
    }
    return failed ? -1 : 0;
}

int tool_compare(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    if (tool_load(o, &s, &set)) return TOOL_FAILED;
    engine_picture fixed, other;
    int failed = engine_fixed(&fixed, &s, &set, o->width, o->height, ENGINE_ALL, error, sizeof error);
    if (!failed && engine_reference(&other, &s, &set, o->width, o->height, error, sizeof error)) {
        engine_free(&fixed);
        failed = 1;
    }
    settings_trim(&set, &s);
    scene_free(&s);
    if (failed) return tool_fail(o->scene_path, error);
    settings_fit(&set, &fixed.demand);
    metrics m;
    metrics_compute(&m, &fixed, &other);
    if (o->out_path && write_pictures(o, &fixed, &other, error, sizeof error)) failed = tool_fail(o->out_path, error);
    engine_free(&fixed);
    engine_free(&other);
    if (failed) return TOOL_FAILED;
    long ram = settings_ram(&set).total;
    if (o->json) print_json(o, &m, ram);
    else print_text(o, &m, ram);
    return TOOL_OK;
}
