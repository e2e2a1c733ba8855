/* What is drawn a screen tile at a time (R1, R2, R5, R6): against the reference, which has no tiles, formats
 * or panels, and against the library itself with other tiles. */
#include <stdlib.h>
#include <string.h>

#include "../host/tool/picture/metrics.h"
#include "../host/tool/fixed/output.h"
#include "../host/tool/fixed/quantise.h"
#include "check.h"

enum { WIDTH = 104, HEIGHT = 76, PIXELS = WIDTH * HEIGHT }; /* not a multiple of any tile */

static int load(scene *s, settings *set, const char *path, int frame)
{
    char error[512] = "";
    settings_init(set);
    if (CHECK_EQ_INT(scene_load(s, path, &(scene_options){.frame = frame, .width = WIDTH, .height = HEIGHT}, error,
                                sizeof error),
                     0) &&
        CHECK_EQ_INT(settings_apply_all(set, s, NULL, 0, error, sizeof error), 0))
        return 1;
    printf("  %s\n", error);
    return 0;
}

/* Both engines; the library's colours are added to what is kept of them. */
static int compare(metrics *m, engine_picture *fixed, const scene *s, const settings *set)
{
    char error[512] = "";
    engine_picture reference;
    if (!CHECK_EQ_INT(engine_fixed(fixed, s, set, WIDTH, HEIGHT, ENGINE_ALL, error, sizeof error), 0)) return 0;
    if (!CHECK_EQ_INT(engine_reference(&reference, s, set, WIDTH, HEIGHT, error, sizeof error), 0)) return 0;
    metrics_compute(m, fixed, &reference);
    engine_free(&reference);
    return 1;
}

/* Tiles of any size give the same picture. [R1] */
static void test_tiles(const char *path, int persp_step)
{
    static const int32_t size[][2] = {{8, 1}, {8, 8}, {64, 16}, {104, 4}, {2048, 2048}};
    engine_picture first = {0}, fixed;
    metrics m;
    scene s;
    settings set;
    if (!load(&s, &set, path, 0)) return;
    set.quality.persp_step = persp_step;
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        set.quality.tile_width = size[i][0] < WIDTH ? size[i][0] : WIDTH;
        set.quality.tile_height = size[i][1] < HEIGHT ? size[i][1] : HEIGHT;
        if (!compare(&m, i ? &fixed : &first, &s, &set)) break;
        CHECK(persp_step > 1 || (m.identical > 0.97 && m.psnr_db > 38 && m.shadow_mismatch < 0.006));
        if (!i) continue;
        CHECK(memcmp(first.rgb8, fixed.rgb8, 3 * PIXELS) == 0);
        engine_free(&fixed);
    }
    engine_free(&first);
    scene_free(&s);
}

/* The nearest surface, in whatever order objects come. [R2] */
static void test_order(const char *path)
{
    engine_picture fixed, reversed;
    metrics m, m_reversed;
    scene s;
    settings set;
    if (!load(&s, &set, path, 0)) return;
    set.quality.persp_step = 1;
    if (compare(&m, &fixed, &s, &set)) {
        for (size_t i = 0; i < s.n_objects / 2; i++) {
            scene_object swap = s.objects[i];
            s.objects[i] = s.objects[s.n_objects - 1 - i];
            s.objects[s.n_objects - 1 - i] = swap;
        }
        if (compare(&m_reversed, &reversed, &s, &set)) {
            size_t n = 0;
            for (size_t i = 0; i < PIXELS; i++) n += memcmp(fixed.rgb8 + 3 * i, reversed.rgb8 + 3 * i, 3) != 0;
            CHECK(n <= PIXELS / 500); /* of surfaces at one depth the first wins */
            CHECK(m.coverage_mismatch < 0.004 && m_reversed.coverage_mismatch < 0.004);
            engine_free(&reversed);
        }
        engine_free(&fixed);
    }
    scene_free(&s);
}

/* What panels of each format show. [R5] */
static void test_outputs(const char *path)
{
    char error[512] = "";
    engine_picture fixed, reference;
    scene s;
    settings set;
    if (!load(&s, &set, path, 96)) return;
    for (int format = 0; output_names[format]; format++) {
        set.output = (gn_format)format;
        if (!CHECK_EQ_INT(engine_fixed(&fixed, &s, &set, WIDTH, HEIGHT, ENGINE_COLOUR_ONLY, error, sizeof error), 0))
            break;
        if (!CHECK_EQ_INT(engine_reference(&reference, &s, &set, WIDTH, HEIGHT, error, sizeof error), 0)) break;
        size_t n_near = 0, n_levels = 0, worst = 0;
        bool seen[256] = {false};
        for (size_t i = 0; i < 3 * PIXELS; i++) {
            size_t apart = (size_t)abs(fixed.rgb8[i] - reference.rgb8[i]);
            n_near += apart <= 17; /* the largest step, of 4 bits */
            worst = apart > worst ? apart : worst;
            seen[fixed.rgb8[i]] = true;
        }
        for (int v = 0; v < 256; v++) n_levels += seen[v];
        if (!CHECK(n_near > 3 * PIXELS * 995 / 1000))
            printf("  %s: %zu of %d near\n", output_names[format], n_near, 3 * PIXELS);
        if (format == GN_FORMAT_MONO1) CHECK_EQ_INT(n_levels, 2);
        else if (format == GN_FORMAT_GREY4) CHECK(n_levels > 4 && n_levels <= 16);
        else CHECK(n_levels > 16);
        engine_free(&fixed);
        engine_free(&reference);
    }
    scene_free(&s);
}

/* ---- R6 ---------------------------------------------------------------------------------------------------------- */

typedef struct {
    uint16_t pixels[PIXELS];
    unsigned n_flushed;
} panel_copy;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    panel_copy *p = user;
    p->n_flushed++;
    for (int row = 0; row < h; row++)
        memcpy(p->pixels + (y + row) * WIDTH + x, (const uint16_t *)pixels + row * w, (size_t)w * sizeof *p->pixels);
}

/* A panel that is only sent what changed shows what one shows that is sent everything; what stands still is not sent.
 * [R6] */
static void test_changes(const char *path)
{
    static panel_copy kept, whole;
    static gn_panel panel;
    gn_renderer *changes = malloc(sizeof *changes), *all = malloc(sizeof *all);
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    unsigned n_sent = 0, n_frames = 0;
    char error[512] = "";
    memset(&panel, 0, sizeof panel);
    memset(kept.pixels, 0xA5, sizeof kept.pixels);
    if (!CHECK(changes && all) || !CHECK(gn_init(changes, &picture) == GN_OK && gn_init(all, &picture) == GN_OK))
        return;
    for (int step = 0; step < 24; step++) {
        int frame = 2 * (step / 2); /* each twice */
        uint32_t n = 0;
        scene s;
        settings set;
        fixed_scene fixed;
        if (!load(&s, &set, path, frame) || !CHECK_EQ_INT(quantise_scene(&fixed, &s, error, sizeof error), 0)) break;
        changes->frame.knobs = all->frame.knobs = set.quality;
        kept.n_flushed = whole.n_flushed = 0;
        CHECK_EQ_INT(gn_render_changes(changes, &fixed.scene, &panel, flush, &kept, &n), GN_OK);
        CHECK_EQ_INT(gn_render(all, &fixed.scene, flush, &whole), GN_OK);
        CHECK_EQ_INT(n, kept.n_flushed);
        CHECK(memcmp(kept.pixels, whole.pixels, sizeof kept.pixels) == 0);
        if (step == 0) CHECK_EQ_INT(n, whole.n_flushed);
        else if (step % 2) CHECK_EQ_INT(n, 0);
        else {
            CHECK(n > 0 && n < whole.n_flushed);
            n_sent += n;
            n_frames++;
        }
        if (step == 23)
            printf("%s: %.1f of %u screen tiles sent per frame\n", path, (double)n_sent / n_frames, whole.n_flushed);
        quantise_free(&fixed);
        scene_free(&s);
    }
    free(changes);
    free(all);
}

int main(void)
{
    static const char *const paths[] = {"docs/scenes/lamps.gltf", "host/scenes/mixed.gltf", "docs/scenes/near.gltf",
                                        "docs/scenes/cones.gltf"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        for (int step = 1; step <= 16; step += step < 8 ? 7 : 8) test_tiles(paths[i], step);
    test_order("host/scenes/avenue.gltf");
    test_order("docs/scenes/lamps.gltf");
    test_outputs("host/scenes/sundial.gltf");
    test_outputs("host/scenes/room.gltf");
    test_changes("host/scenes/desk.gltf");
    test_changes("host/scenes/mixed.gltf");
    return check_report();
}
