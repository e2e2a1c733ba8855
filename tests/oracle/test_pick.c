/* gn_pick: what is under a pixel is what the reference sees there, and what the library draws there. */
#include <stdlib.h>
#include <string.h>

#include "../host/tool/engine/engine.h"
#include "../host/tool/fixed/quantise.h"
#include "check.h"

enum { WIDTH = 72, HEIGHT = 50, PIXELS = WIDTH * HEIGHT }; /* not a multiple of a tile */

static gn_renderer renderer;

static void drop(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

static int64_t pick(uint32_t x, uint32_t y)
{
    uint32_t object = 1, triangle = 2;
    CHECK_EQ_INT(gn_pick(&renderer, x, y, &object, &triangle), GN_OK);
    CHECK((object == GN_NOTHING) == (triangle == GN_NOTHING));
    return object == GN_NOTHING ? -1 : (int64_t)object << 32 | triangle;
}

/* The scene, its lights and camera are local, as in many programs, and gone when gn_pick is called. */
static void draw(const fixed_scene *f, const settings *set, int triangle_groups)
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_light lights[64];
    gn_scene local = f->scene;
    CHECK(local.n_lights <= 64);
    memcpy(lights, f->scene.lights, local.n_lights * sizeof *lights);
    local.lights = lights;
    CHECK_EQ_INT(gn_init(&renderer, &picture), GN_OK);
    renderer.frame.knobs = set->quality;
    renderer.frame.knobs.triangle_groups = triangle_groups;
    CHECK_EQ_INT(gn_render(&renderer, &local, drop, NULL), GN_OK);
    memset(&local, 0xA5, sizeof local);
    memset(lights, 0xA5, sizeof lights);
}

/* Every pixel: exactly the triangle of the raw view, and that of the reference but at edges: as fixed.coverage. [R2] */
static void test_scene(const char *path)
{
    char error[512] = "";
    scene s;
    settings set;
    fixed_scene f;
    engine_picture fixed, reference;
    settings_init(&set);
    if (!CHECK_EQ_INT(scene_load(&s, path, &(scene_options){.width = WIDTH, .height = HEIGHT}, error, sizeof error),
                      0) ||
        !CHECK_EQ_INT(settings_apply_all(&set, &s, NULL, 0, error, sizeof error), 0) ||
        !CHECK_EQ_INT(quantise_scene_for(&f, &s, &set.quality, error, sizeof error), 0) ||
        !CHECK_EQ_INT(engine_fixed(&fixed, &s, &set, WIDTH, HEIGHT, ENGINE_ALL, error, sizeof error), 0) ||
        !CHECK_EQ_INT(engine_reference(&reference, &s, &set, WIDTH, HEIGHT, error, sizeof error), 0))
        return;
    for (int groups = 0; groups <= 64; groups += 64) {
        int n_drawn = 0, n_seen = 0;
        draw(&f, &set, groups);
        for (uint32_t i = 0; i < PIXELS; i++) {
            const int64_t found = pick(i % WIDTH, i / WIDTH);
            n_drawn += found != fixed.triangle[i];
            n_seen += found != reference.triangle[i];
        }
        CHECK_EQ_INT(n_drawn, 0);
        CHECK(n_seen <= PIXELS / 100);
    }
    CHECK_EQ_INT(gn_pick(&renderer, WIDTH - 1, HEIGHT - 1, NULL, NULL), GN_OK);
    engine_free(&fixed);
    engine_free(&reference);
    quantise_free(&f);
    scene_free(&s);
}

static void test_refused(void)
{
    gn_renderer *r = malloc(sizeof *r);
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    uint32_t object = 7;
    if (!r) return;
    CHECK_EQ_INT(gn_pick(NULL, 0, 0, &object, NULL), GN_ERR_NULL);
    CHECK_EQ_INT((long long)object, (long long)GN_NOTHING);
    CHECK_EQ_INT(gn_init(r, &picture), GN_OK);
    CHECK_EQ_INT(gn_pick(r, 0, 0, &object, NULL), GN_ERR_NO_BEGIN); /* nothing is prepared */
    CHECK_EQ_INT(gn_pick(&renderer, WIDTH, 0, &object, NULL), GN_ERR_INDEX);
    CHECK_EQ_INT(gn_pick(&renderer, 0, HEIGHT, &object, NULL), GN_ERR_INDEX);
    free(r);
}

int main(void)
{
    static const char *const names[] = {"cube", "sundial", "avenue", "desk", "room", "fence", "mixed"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[64];
        snprintf(path, sizeof path, "host/scenes/%s.gltf", names[i]);
        test_scene(path);
    }
    test_refused();
    return check_report();
}
