/* Our PNG files and our metrics, judged by OpenImageIO. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../host/scene/image/png.h"
#include "../host/tool/picture/metrics.h"
#include "../host/tool/picture/views.h"
#include "check.h"
#include "oiio_shim.h"

static uint32_t state = 7;
static uint8_t random_byte(void)
{
    state = state * 1664525U + 1013904223U;
    return (uint8_t)(state >> 24);
}

/* Flat, smooth, noisy: kind 0, 1, 2 */
static void fill(uint8_t *rgb, int w, int h, int kind)
{
    for (int i = 0; i < 3 * w * h; i++)
        rgb[i] = kind == 0 ? 77 : kind == 1 ? (uint8_t)(i / 3 % w + i / (3 * w)) : random_byte();
}

static void read_back(int w, int h, int kind)
{
    const char *path = "build/tmp/oiio.png";
    char error[256] = "";
    uint8_t *rgb = malloc((size_t)(3 * w * h));
    int got_w = 0, got_h = 0;
    fill(rgb, w, h, kind);
    CHECK_EQ_INT(png_write_rgb8(path, w, h, rgb, error, sizeof error), 0);
    unsigned char *read = oiio_read_rgb8(path, &got_w, &got_h, error, sizeof error);
    if (CHECK(read != NULL) && CHECK_EQ_INT(got_w, w) && CHECK_EQ_INT(got_h, h))
        CHECK(memcmp(read, rgb, (size_t)(3 * w * h)) == 0);
    oiio_free(read);
    free(rgb);
}

/* ---- Pictures of all engines ------------------------------------------------------------------------------------- */

enum { FIXED, REFERENCE, TRUTH, N_ENGINES };
static const char *const engine_names[N_ENGINES] = {"fixed", "reference", "truth"};
#define WIDTH  120
#define HEIGHT 90

/* RGB565 as a picture in which one step is STEP levels, whatever the channel. */
#define STEP 4
static void write_565(const char *path, const engine_picture *p)
{
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    char error[256] = "";
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        rgb[3 * i] = (uint8_t)(STEP * (p->rgb565[i] >> 11));
        rgb[3 * i + 1] = (uint8_t)(STEP * (p->rgb565[i] >> 5 & 63));
        rgb[3 * i + 2] = (uint8_t)(STEP * (p->rgb565[i] & 31));
    }
    CHECK_EQ_INT(png_write_rgb8(path, WIDTH, HEIGHT, rgb, error, sizeof error), 0);
}

static double mean_difference(const engine_picture *a, const engine_picture *b)
{
    double sum = 0;
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) sum += abs(a->rgb8[i] - b->rgb8[i]);
    return sum / (3.0 * WIDTH * HEIGHT);
}

static int worst_channel(const engine_picture *a, const engine_picture *b, int i)
{
    int worst = 0;
    for (int k = 3 * i; k < 3 * i + 3; k++) {
        const int d = abs(a->rgb8[k] - b->rgb8[k]);
        worst = d > worst ? d : worst;
    }
    return worst;
}

static int differ_8(const engine_picture *a, const engine_picture *b, int threshold)
{
    int n = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) n += worst_channel(a, b, i) > threshold;
    return n;
}

/* Our metrics are what OpenImageIO finds in the files. A threshold lies between two levels. */
static void check_pair(const engine_picture *a, const char *a_name, const engine_picture *b, const char *b_name)
{
    char path[4][64];
    oiio_result all = {0}, step = {0}, exact = {0};
    metrics m;
    const unsigned long failed = check_n_failed;
    metrics_compute(&m, a, b);
    snprintf(path[0], sizeof path[0], "build/tmp/oiio_%s.png", a_name);
    snprintf(path[1], sizeof path[1], "build/tmp/oiio_%s.png", b_name);
    snprintf(path[2], sizeof path[2], "build/tmp/oiio_%s_565.png", a_name);
    snprintf(path[3], sizeof path[3], "build/tmp/oiio_%s_565.png", b_name);
    CHECK_EQ_INT(oiio_compare(path[0], path[1], 16.5 / 255, &all), 0);
    CHECK_EQ_INT(oiio_compare(path[2], path[3], 0.5 / 255, &exact), 0);
    CHECK_EQ_INT(oiio_compare(path[2], path[3], (STEP + 0.5) / 255, &step), 0);
    CHECK_EQ_INT(lround(all.largest * 255), m.max_error);
    CHECK_NEAR(all.largest * 255, m.max_error, 1e-4);
    if (all.rms > 0) CHECK_NEAR(-20 * log10(all.rms), m.psnr_db, 1e-4);
    else CHECK(isinf(m.psnr_db));
    CHECK_NEAR(255 * all.mean, mean_difference(a, b), 1e-4);
    CHECK_EQ_INT(all.n_failing, differ_8(a, b, 16));
    CHECK_EQ_INT(exact.n_failing, lround((1 - m.identical) * WIDTH * HEIGHT));
    CHECK_EQ_INT(step.n_failing, lround((1 - m.within1) * WIDTH * HEIGHT));
    if (m.max_error > 0) CHECK_EQ_INT(worst_channel(a, b, all.y * WIDTH + all.x), m.max_error);
    if (check_n_failed > failed) printf("  %s against %s\n", a_name, b_name);
}

/* And the library is nearer to the reference than either is to the truth: not one picture read three times. */
static void check_scene(const char *scene_path)
{
    char error[512] = "";
    scene s;
    const scene_options options = {.width = WIDTH, .height = HEIGHT};
    settings set;
    engine_picture p[N_ENGINES] = {0};
    const unsigned long failed = check_n_failed;
    settings_init(&set);
    if (!CHECK_EQ_INT(scene_load(&s, scene_path, &options, error, sizeof error), 0)) return;
    CHECK_EQ_INT(engine_fixed(&p[FIXED], &s, &set, WIDTH, HEIGHT, ENGINE_ALL, error, sizeof error), 0);
    CHECK_EQ_INT(engine_reference(&p[REFERENCE], &s, &set, WIDTH, HEIGHT, error, sizeof error), 0);
    CHECK_EQ_INT(engine_truth(&p[TRUTH], &s, &set, WIDTH, HEIGHT, 1, error, sizeof error), 0);
    for (int i = 0; i < N_ENGINES; i++) {
        char path[64];
        snprintf(path, sizeof path, "build/tmp/oiio_%s.png", engine_names[i]);
        CHECK_EQ_INT(png_write_rgb8(path, WIDTH, HEIGHT, p[i].rgb8, error, sizeof error), 0);
        snprintf(path, sizeof path, "build/tmp/oiio_%s_565.png", engine_names[i]);
        write_565(path, &p[i]);
    }
    check_pair(&p[FIXED], "fixed", &p[REFERENCE], "reference");
    check_pair(&p[REFERENCE], "reference", &p[TRUTH], "truth");
    check_pair(&p[FIXED], "fixed", &p[TRUTH], "truth");
    oiio_result cost_of_fixed, cost_of_maps;
    CHECK_EQ_INT(oiio_compare("build/tmp/oiio_fixed.png", "build/tmp/oiio_reference.png", 1, &cost_of_fixed), 0);
    CHECK_EQ_INT(oiio_compare("build/tmp/oiio_reference.png", "build/tmp/oiio_truth.png", 1, &cost_of_maps), 0);
    CHECK(cost_of_fixed.rms < cost_of_maps.rms && cost_of_maps.rms < 0.2 && cost_of_fixed.rms < 0.01);
    if (check_n_failed > failed) printf("  %s %s\n", scene_path, error);
    for (int i = 0; i < N_ENGINES; i++) engine_free(&p[i]);
    scene_free(&s);
}

int main(void)
{
    static const char *const scenes[] = {"sundial", "avenue", "desk", "room", "fence", "mixed"};
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    for (int kind = 0; kind < 3; kind++) {
        read_back(1, 1, kind);
        read_back(7, 3, kind);
        read_back(320, 240, kind);
        read_back(1021, 5, kind);
    }
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char path[64];
        snprintf(path, sizeof path, "host/scenes/%s.gltf", scenes[i]);
        check_scene(path);
    }
    return check_report();
}
