/* Small triangles, whose light is found at their vertices, against the same pictures with every pixel for itself
 * (NUMERICS 4.17): a ball of 120 triangles with colours and normals, in the shadow of a box, under one sun. */
#include "check.h"
#include "demo_scene.h"
#include "knobs.h"

enum { WIDTH = 160, HEIGHT = 120, FRAMES = 6, N_SIZES = 4 };

static gn_renderer renderer;
static demo_scene demo;
static uint8_t picture[2][3 * WIDTH * HEIGHT];
static uint8_t *into;
static int32_t width;

static void take(void *user, int x, int y, int w, int h, const void *pixels)
{
    const uint8_t *from = pixels;
    (void)user;
    for (int j = 0; j < h; j++) memcpy(into + 3 * ((y + j) * width + x), from + 3 * j * w, 3 * (size_t)w);
}

/* A picture, exact or not. Returns whether the build has such a thing. */
static int draw(int which, int32_t step, int vertex_light, int32_t w, int32_t h)
{
    const gn_picture target = {.width = (uint16_t)w, .height = (uint16_t)h, .format = GN_FORMAT_RGB888};
    if (CHECK(gn_init(&renderer, &target) == GN_OK)) {
        if (!TAKES_KNOB(&renderer.frame, persp_step, step)) return 0;
        if (!TAKES_KNOB(&renderer.frame, vertex_light, vertex_light)) return 0;
        into = picture[which];
        width = w;
        return CHECK(gn_render(&renderer, &demo.scene, take, NULL) == GN_OK);
    }
    return 0;
}

/* What presets promise: so many pixels of a thousand within a step of RGB565. */
static void compare(int32_t step, int vertex_light, int32_t w, int32_t h)
{
    static const int one_step[3] = {8, 4, 8};
    const int n = w * h, promised = step == 8 ? 994 : 985;
    int within = 0;
    if (!draw(0, 1, vertex_light, w, h) || !draw(1, step, vertex_light, w, h)) return;
    for (int i = 0; i < n; i++) {
        int near = 1;
        for (int c = 0; c < 3; c++) {
            const int d = picture[0][3 * i + c] - picture[1][3 * i + c];
            near &= d <= one_step[c] && -d <= one_step[c];
        }
        within += near;
    }
    if (!CHECK(within * 1000 >= promised * n))
        printf("  step %d, light at vertices %d, %dx%d: %d of %d pixels within a step\n", (int)step, vertex_light,
               (int)w, (int)h, within, n);
}

int main(void)
{
    static const int32_t size[N_SIZES][2] = {{40, 30}, {64, 48}, {96, 72}, {WIDTH, HEIGHT}};
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        demo_scene_make(&demo, frame);
        if (frame & 1) { /* no part of a shadow fades */
            demo.scene.shadow.n_cascades = 1;
            demo.scene.shadow.max_distance_q16 = GN_Q16(30);
            demo.scene.shadow.distance_fade_uq16 = demo.scene.shadow.cascade_fade_uq16 = GN_UQ16(0.01);
        }
        for (int i = 0; i < N_SIZES; i++)
            for (int vertex_light = 0; vertex_light < 2; vertex_light++)
                for (int32_t step = 8; step <= 16; step += 8) compare(step, vertex_light, size[i][0], size[i][1]);
    }
    return check_report();
}
