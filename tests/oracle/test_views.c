/* What people put into scenes (R10, M10, M11, R11, R12, layers of M8, groups of triangles), on scenes in which it fills
 * the picture: views from around with roll, the library against the reference. "--list" prints what each line measures.
 * That the rows matter is test_rows' to say. */
#include <stdlib.h>
#include <string.h>

#include "../host/tool/picture/metrics.h"
#include "check.h"
#include "swing.h"

#define N_VIEWS 20 /* even, for the median; in make soak, of 320x240 pixels */
#define N_QUICK 4  /* in make test, of 192x144 */

typedef struct {
    const char *id, *path, *words;
    int frame;
} row;
static const row rows[] = {
    {"R10", "docs/scenes/isometric.gltf", "", 0},
    {"R10", "host/scenes/mixed.gltf", "half_height=2.5", 0},
    {"M10", "docs/scenes/glow.gltf", "", 0},
    {"M11", "docs/scenes/near.gltf", "texture_levels=1", 0},
    {"M11", "host/scenes/cube.gltf", "texture_format=rgb565 texture_size=48", 9},
    {"M11", "host/scenes/cube.gltf", "texture_format=palette4 texture_size=20 texture_levels=1", 9},
    {"M11", "host/scenes/fence.gltf", "texture_format=rgb565a1", 0},
    {"M11", "docs/scenes/near.gltf", "texture_format=palette1 texture_levels=1", 0},
    {"M11", "host/scenes/cube.gltf", "texture_format=palette8 texture_size=37", 9},
    {"M11", "host/scenes/cube.gltf", "texture_format=grey4", 9},
    {"M11", "host/scenes/cube.gltf", "texture_format=grey8 texture_size=3", 9},
    {"R11", "host/scenes/avenue.gltf", "background=0.1,0.25,0.7 background_bottom=1,0.75,0.45", 0},
    {"R12", "docs/scenes/snake.gltf", "", 30},
    {"R12", "docs/scenes/snake.gltf", "lights=point half_height=1.2 triangle_groups=16", 66},
    {"M8", "docs/scenes/glass.gltf", "transparent_layers=3", 0},
    {"M8", "host/scenes/fence.gltf", "transparent_layers=1", 0},
    {"M8", "docs/scenes/glass.gltf", "transparent_layers=2 triangle_groups=16 half_height=0.25 lights=spot", 0},
};

/* The medians of a row's views. */
typedef struct {
    double identical, within1, psnr_db;
} result;

static int compare_view(metrics *m, const scene *s, const settings *set, int width, int height)
{
    char error[512] = "";
    engine_picture fixed, reference;
    if (engine_fixed(&fixed, s, set, width, height, ENGINE_ALL, error, sizeof error)) {
        printf("%s\n", error);
        return -1;
    }
    const int failed = engine_reference(&reference, s, set, width, height, error, sizeof error);
    if (!failed) metrics_compute(m, &fixed, &reference);
    engine_free(&fixed);
    if (!failed) engine_free(&reference);
    return failed;
}

static int open_row(scene *s, settings *set, const row *r, int preset)
{
    char error[512] = "", buffer[256];
    const scene_options options = {.frame = r->frame, .width = 320, .height = 240};
    if (scene_load(s, r->path, &options, error, sizeof error)) {
        printf("  %s\n", error);
        return -1;
    }
    settings_init(set);
    settings_preset(set, preset);
    snprintf(buffer, sizeof buffer, "%s", r->words);
    int failed = settings_apply_all(set, s, NULL, 0, error, sizeof error);
    for (char *word = strtok(buffer, " "); word && !failed; word = strtok(NULL, " "))
        failed = settings_apply_all(set, s, &(const char *){word}, 1, error, sizeof error);
    if (!failed) return 0;
    printf("  %s: %s\n", r->words, error);
    scene_free(s);
    return -1;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static double middle(double *v, int n)
{
    qsort(v, (size_t)n, sizeof *v, ascending);
    return (v[n / 2 - 1] + v[n / 2]) / 2;
}

/* Pictures that are all alike have no limit of decibels. */
static int measure(result *out, const row *r, int preset, bool all)
{
    const int n = all ? N_VIEWS : N_QUICK, width = all ? 320 : 192;
    double identical[N_VIEWS], within1[N_VIEWS], psnr[N_VIEWS];
    scene s;
    settings set;
    if (open_row(&s, &set, r, preset)) return -1;
    const scene_camera original = s.camera;
    int failed = 0;
    for (int i = 0; i < n && !failed; i++) {
        metrics m = {0};
        swing(&s, 1 + i * (N_VIEWS / n), &original);
        failed = compare_view(&m, &s, &set, width, width * 3 / 4);
        identical[i] = m.identical;
        within1[i] = m.within1;
        psnr[i] = fmin(m.psnr_db, 99);
    }
    scene_free(&s);
    if (failed) return -1;
    *out = (result){middle(identical, n), middle(within1, n), middle(psnr, n)};
    return 0;
}

/* What the project promises of each row. */
static bool holds(const result *r, int preset)
{
    if (preset == SETTINGS_ACCURATE) return r->identical >= 0.999;
    return r->within1 >= 0.994 && r->psnr_db >= 45;
}

int main(int argc, char **argv)
{
    static const int presets[] = {SETTINGS_ACCURATE, SETTINGS_BALANCED};
    const bool list = argc > 1 && strcmp(argv[1], "--list") == 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (size_t p = 0; p < 2; p++) {
            result r = {0};
            if (!CHECK_EQ_INT(measure(&r, &rows[i], presets[p], list || getenv("SOAK")), 0)) continue;
            if (CHECK(holds(&r, presets[p])) && !list) continue;
            printf("  %s %s %s, %s: medians: identical %.5f, within one step %.5f, %.2f dB\n", rows[i].id, rows[i].path,
                   rows[i].words, settings_preset_name[presets[p]], r.identical, r.within1, r.psnr_db);
        }
    return check_report();
}
