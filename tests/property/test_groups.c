/* Groups of triangles in place of records (triangle_groups): the same picture, byte for byte, and the same triangle at
 * every pixel; large meshes within 64 KB. MODELS="a.obj b.obj": these, too. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../host/tool/engine/engine.h"
#include "check.h"

enum { RAM_MAX = 65536 };

static char error[512];

/* Loads a scene with triangle_groups and a preset. 0, or -1. */
static int load(scene *s, settings *set, const char *path, int preset, int groups, int width, int height)
{
    char sets[2][32];
    const char *const list[] = {sets[0], sets[1]};
    const scene_options options = {.width = width, .height = height};
    snprintf(sets[0], sizeof sets[0], "preset=%s", settings_preset_name[preset]);
    snprintf(sets[1], sizeof sets[1], "triangle_groups=%d", groups);
    settings_init(set);
    if (scene_load(s, path, &options, error, sizeof error)) return -1;
    if (!settings_apply_all(set, s, list, 2, error, sizeof error)) return 0;
    scene_free(s);
    return -1;
}

/* What a frame needs in RAM with this picture's features and capacities; 0: no picture. */
static long draw(engine_picture *p, const char *path, int preset, int groups, int width, int height, int what)
{
    scene s;
    settings set, unlimited;
    long ram = 0;
    if (load(&s, &set, path, preset, groups, width, height)) return 0;
    unlimited = set;
    if (!engine_fixed(p, &s, &unlimited, width, height, what, error, sizeof error)) {
        settings_trim(&set, &s);
        settings_fit(&set, &p->demand);
        ram = settings_ram(&set).total;
    }
    scene_free(&s);
    return ram;
}

/* The picture with groups against that with records. Returns the RAM of the first. */
static long compare(const char *path, int preset, int groups, int width, int height, int what)
{
    engine_picture records, grouped;
    const size_t n = (size_t)width * (size_t)height;
    if (!draw(&records, path, preset, 0, width, height, what)) {
        CHECK(false);
        printf("  %s: %s\n", path, error);
        return 0;
    }
    const long ram = draw(&grouped, path, preset, groups, width, height, what);
    if (!CHECK(ram > 0)) printf("  %s: %s\n", path, error);
    else {
        const int same = !memcmp(records.rgb8, grouped.rgb8, 3 * n) &&
                         (what != ENGINE_ALL || !memcmp(records.triangle, grouped.triangle, n * sizeof(int64_t)));
        if (!CHECK(same)) printf("  %s, preset %d, %d groups: other pixels\n", path, preset, groups);
        CHECK_EQ_INT(grouped.stats.n_triangles, records.stats.n_triangles);
        CHECK_EQ_INT(grouped.stats.n_clipped, records.stats.n_clipped);
        CHECK_EQ_INT(grouped.stats.n_tile_refs, records.stats.n_tile_refs);
        engine_free(&grouped);
    }
    engine_free(&records);
    return ram;
}

static void test_scenes(void)
{
    static const char *const scenes[] = {
        "host/scenes/sundial.gltf", "host/scenes/avenue.gltf",   "host/scenes/desk.gltf", "host/scenes/room.gltf",
        "host/scenes/fence.gltf",   "host/scenes/mixed.gltf",    "docs/scenes/near.gltf", "docs/scenes/materials.gltf",
        "docs/scenes/lamps.gltf",   "docs/scenes/isometric.gltf"};
    static const int numbers[] = {1, 7, 90, 4096};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        for (int preset = SETTINGS_TINY; preset < SETTINGS_PRESETS; preset++)
            compare(scenes[i], preset, numbers[(i + (size_t)preset) & 3], 96, 72,
                    preset ? ENGINE_COLOUR_ONLY : ENGINE_ALL);
}

/* ---- Large meshes ------------------------------------------------------------------------------------------------ */

enum { ACROSS = 160, DOWN = 80, STRIDE = 7919 }; /* triangles come in no order at all */

static void write_vertex(FILE *f, int i, int k)
{
    const double turn = 2 * 3.14159265358979 * i / ACROSS, rise = 3.14159265358979 * k / DOWN;
    const double r = 1 + 0.2 * sin(5 * turn) * sin(4 * rise);
    fprintf(f, "v %.9f %.9f %.9f\n", r * sin(rise) * cos(turn), r * cos(rise), r * sin(rise) * sin(turn));
}

/* A closed wavy surface of 25600 triangles. */
static int write_mesh(const char *path)
{
    FILE *f = fopen(path, "w");
    if (!f) return -1;
    for (int k = 0; k <= DOWN; k++)
        for (int i = 0; i < ACROSS; i++) write_vertex(f, i, k);
    for (int n = 0; n < ACROSS * DOWN; n++) {
        const int cell = (int)((long)n * STRIDE % (ACROSS * DOWN)), i = cell % ACROSS, next = (i + 1) % ACROSS;
        const int above = cell / ACROSS * ACROSS + 1, below = above + ACROSS;
        fprintf(f, "f %d %d %d %d\n", above + i, above + next, below + next, below + i);
    }
    return fclose(f);
}

static void test_large(const char *path)
{
    const long tiny = compare(path, SETTINGS_TINY, 1024, 320, 240, ENGINE_COLOUR_ONLY),
               balanced = compare(path, SETTINGS_BALANCED, 1024, 320, 240, ENGINE_COLOUR_ONLY);
    CHECK(tiny > 0 && tiny < RAM_MAX / 2);
    CHECK(balanced > 0 && balanced < RAM_MAX);
    printf("%s: %ld bytes of RAM by preset tiny, %ld by balanced\n", path, tiny, balanced);
}

static void test_models(const char *models)
{
    char path[512];
    int n;
    for (; models && sscanf(models, " %511s%n", path, &n) == 1; models += n) test_large(path);
}

/* A capacity that is set and too small is refused by name. */
static void test_capacity(void)
{
    scene s;
    settings set;
    engine_picture p;
    if (!CHECK_EQ_INT(load(&s, &set, "host/scenes/room.gltf", SETTINGS_TINY, 64, 96, 72), 0)) return;
    set.capacity.max_tile_refs = 1; /* unused */
    CHECK_EQ_INT(engine_fixed(&p, &s, &set, 96, 72, ENGINE_COLOUR_ONLY, error, sizeof error), 0);
    const size_t needed = p.demand.triangles;
    CHECK(needed > 2 && needed < p.stats.n_triangles);
    engine_free(&p);
    set.capacity.max_triangles = (int32_t)needed;
    CHECK_EQ_INT(engine_fixed(&p, &s, &set, 96, 72, ENGINE_COLOUR_ONLY, error, sizeof error), 0);
    engine_free(&p);
    set.capacity.max_triangles--;
    CHECK(engine_fixed(&p, &s, &set, 96, 72, ENGINE_COLOUR_ONLY, error, sizeof error) != 0);
    CHECK(strstr(error, "visible triangles of a screen tile") != NULL);
    scene_free(&s);
}

int main(int argc, char **argv)
{
    char path[512];
    snprintf(path, sizeof path, "%s.obj", argv[0]);
    (void)argc;
    test_scenes();
    test_capacity();
    if (CHECK_EQ_INT(write_mesh(path), 0)) test_large(path);
    remove(path);
    test_models(getenv("MODELS"));
    return check_report();
}
