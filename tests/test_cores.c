/* Many cores (R7): screen tiles of one prepared frame drawn by 1, 2, 4 and 8 threads, each with its own scratch, give the same bytes.
 * run.sh also runs this under ThreadSanitizer. */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "demo_scene.h"

#define WIDTH       320
#define HEIGHT      240
#define THREADS_MAX 8

static gn_renderer renderer;
static gn_scratch scratch[THREADS_MAX];
static demo_scene demo;

typedef struct {
    uint32_t first, step; /* the tiles this thread draws */
    gn_scratch *scratch;
    uint16_t *picture;
} job;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    uint16_t *picture = user;
    for (int row = 0; row < h; row++)
        memcpy(picture + (size_t)(y + row) * WIDTH + (size_t)x, (const uint16_t *)pixels + (size_t)row * (size_t)w, (size_t)w * 2);
}

static void *draw(void *user)
{
    const job *j = user;
    for (uint32_t t = j->first; t < gn_screen_tile_count(&renderer); t += j->step)
        gn_screen_tile(&renderer.frame, j->scratch, t, flush, j->picture);
    return NULL;
}

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

int main(void)
{
    static uint16_t one[WIDTH * HEIGHT], many[WIDTH * HEIGHT];
    gn_picture p = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    for (uint32_t frame = 0; frame < 3; frame++) {
        demo_scene_make(&demo, frame);
        CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
        CHECK_EQ_INT(gn_begin(&renderer, &demo.scene), GN_OK);
        for (uint32_t i = 0; i < gn_shadow_tile_count(&renderer); i++) CHECK_EQ_INT(gn_shadow_tile(&renderer, i), GN_OK);
        CHECK_EQ_INT(gn_prepare(&renderer), GN_OK);
        draw_with(1, one);
        for (int n = 2; n <= THREADS_MAX; n *= 2) {
            memset(many, 0, sizeof many);
            draw_with(n, many);
            CHECK(memcmp(one, many, sizeof one) == 0);
        }
    }
    return check_report();
}
