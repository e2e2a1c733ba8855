/* Our PNG files and our metrics, judged by OpenImageIO. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../../host/scene/png.h"
#include "../../host/tool/metrics.h"
#include "../../host/tool/views.h"
#include "../check.h"
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
    for (int i = 0; i < 3 * w * h; i++) rgb[i] = kind == 0 ? 77 : kind == 1 ? (uint8_t)(i / 3 % w + i / (3 * w)) : random_byte();
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
    if (CHECK(read != NULL) && CHECK_EQ_INT(got_w, w) && CHECK_EQ_INT(got_h, h)) CHECK(memcmp(read, rgb, (size_t)(3 * w * h)) == 0);
    oiio_free(read);
    free(rgb);
}

/* compare's PSNR and largest error are what OpenImageIO finds in the files. */
static void compare_agrees(const char *scene_path)
{
    char error[512] = "";
    scene s;
    scene_options options = {.width = 160, .height = 120};
    settings set;
    engine_picture fixed, reference;
    settings_init(&set);
    if (!CHECK_EQ_INT(scene_load(&s, scene_path, &options, error, sizeof error), 0)) return;
    CHECK_EQ_INT(engine_fixed(&fixed, &s, &set, 160, 120, ENGINE_ALL, error, sizeof error), 0);
    CHECK_EQ_INT(engine_reference(&reference, &s, &set, 160, 120, error, sizeof error), 0);
    png_write_rgb8("build/tmp/oiio_a.png", 160, 120, fixed.rgb8, error, sizeof error);
    png_write_rgb8("build/tmp/oiio_b.png", 160, 120, reference.rgb8, error, sizeof error);
    metrics m;
    double mean = 0, rms = 0, largest = 0;
    metrics_compute(&m, &fixed, &reference);
    CHECK_EQ_INT(oiio_compare("build/tmp/oiio_a.png", "build/tmp/oiio_b.png", &mean, &rms, &largest), 0);
    CHECK_NEAR(largest * 255, m.max_error, 1e-3);
    if (rms > 0) CHECK_NEAR(-20 * log10(rms), m.psnr_db, 1e-3);
    engine_free(&fixed);
    engine_free(&reference);
    scene_free(&s);
}

int main(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    for (int kind = 0; kind < 3; kind++) {
        read_back(1, 1, kind);
        read_back(7, 3, kind);
        read_back(320, 240, kind);
        read_back(1021, 5, kind);
    }
    compare_agrees("host/scenes/sundial.gltf");
    compare_agrees("host/scenes/avenue.gltf");
    return check_report();
}
