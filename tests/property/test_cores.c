/* Many cores [R7]: screen tiles of one prepared frame drawn by 1, 2, 4 and 8 threads, each with its own scratch, give
 * the same bytes. run.sh also runs this under ThreadSanitizer. */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "demo_scene.h"
#include "light_scene.h"

#define WIDTH       320
#define HEIGHT      240
#define THREADS_MAX 8

static gn_renderer renderer;
static gn_scratch scratch[THREADS_MAX];
static demo_scene demo;
static light_scene ls;

typedef struct {
    uint32_t first, step; /* the tiles this thread draws */
    gn_scratch *scratch;
    uint16_t *picture;
} job;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    uint16_t *picture = user;
    for (int row = 0; row < h; row++)
        memcpy(picture + (size_t)(y + row) * WIDTH + (size_t)x, (const uint16_t *)pixels + (size_t)row * (size_t)w,
               (size_t)w * 2);
}

static void *draw(void *user)
{
    const job *j = user;
    for (uint32_t t = j->first; t < gn_screen_tile_count(&renderer); t += j->step)
        gn_screen_tile(&renderer.frame, j->scratch, t, flush, j->picture);
    return NULL;
}

/* Screen tiles on any number of threads. [R7] */
static void draw_with(int n_threads, uint16_t *picture)
{
    pthread_t thread[THREADS_MAX];
    job jobs[THREADS_MAX];
    for (int i = 0; i < n_threads; i++) {
        job j = {(uint32_t)i, (uint32_t)n_threads, &scratch[i], picture};
        jobs[i] = j;
        CHECK_EQ_INT(pthread_create(&thread[i], NULL, draw, &jobs[i]), 0);
    }
    for (int i = 0; i < n_threads; i++) pthread_join(thread[i], NULL);
}

/* The same bytes by one thread and by many. */
static void check_scene(const gn_scene *scene)
{
    static uint16_t one[WIDTH * HEIGHT], many[WIDTH * HEIGHT];
    gn_picture p = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
    CHECK_EQ_INT(ls_prepare(&renderer, scene), GN_OK);
    draw_with(1, one);
    for (int n = 2; n <= THREADS_MAX; n *= 2) {
        memset(many, 0, sizeof many);
        draw_with(n, many);
        CHECK(memcmp(one, many, sizeof one) == 0);
    }
}

/* Every kind of light, a texture with alpha, highlights, masks and baked light, blended cascades. */
static void every_kind(gn_filter filter, gn_blend blend)
{
    static uint8_t mask[DEMO_BALL_VERTICES * 4];
    static uint16_t baked[DEMO_BALL_VERTICES * 3];
    static const gn_light_kind kinds[5] = {GN_LIGHT_DIRECTIONAL, GN_LIGHT_SPOT, GN_LIGHT_POINT, GN_LIGHT_DIRECTIONAL,
                                           GN_LIGHT_SPOT};
    rng r = {11};
    ls_begin(&ls);
    for (int i = 0; i < 5; i++) ls_add_random_light(&ls, &r, kinds[i])->receiver_plane = i & 1;
    for (size_t i = 0; i < sizeof mask; i++) mask[i] = (uint8_t)(37 * i);
    for (size_t i = 0; i < sizeof baked / sizeof *baked; i++) baked[i] = (uint16_t)(i % 7 * 100);
    ls.light[1].mode = GN_LIGHT_MIXED;
    ls.light[1].mask_channel = 2;
    gn_object *ball = &ls.object[2];
    ball->mask_u8 = mask;
    ball->baked_uq12 = baked;
    ball->shininess_log2 = 4;
    for (int k = 0; k < 3; k++) ball->specular_uq16[k] = 20000;
    ls.object[3].visible_alpha = ls.object[3].caster_alpha = filter == GN_FILTER_DISK ? GN_ALPHA_DITHER : GN_ALPHA_CLIP;
    ls.holes.flags = GN_TEXTURE_BILINEAR;
    gn_shadow_settings *shadow = &ls.scene.shadow;
    shadow->filter = shadow->other_filter = filter;
    shadow->blend = blend;
    shadow->mixing = GN_MIXING_DISTANCE;
    shadow->n_cascades = 4;
    shadow->main_light = blend == GN_BLEND_DITHER;
    shadow->tile_sizes = GN_TILES_IMPORTANCE;
}

int main(void)
{
    for (uint32_t frame = 0; frame < 3; frame++) {
        demo_scene_make(&demo, frame);
        check_scene(&demo.scene);
    }
    every_kind(GN_FILTER_5X5, GN_BLEND_SOFT);
    check_scene(&ls.scene);
    every_kind(GN_FILTER_DISK, GN_BLEND_DITHER);
    check_scene(&ls.scene);
    return check_report();
}
