/* Random numbers of every size, and bounds, for the tests of compact arithmetic's stages. Included after the library.
 */
#ifndef COMPACT_RANDOM_H
#define COMPACT_RANDOM_H

#include <stdlib.h>

#include "check.h"

static gn_renderer renderer;

static uint32_t rnd(void)
{
    static uint64_t state = 7;
    state = state * 6364136223846793005U + 1442695040888963407U;
    uint32_t x = (uint32_t)(state >> 32);
    return x ^ x >> 15;
}

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * rnd() / 4294967296.0;
}

static double any_size(double lo, double hi)
{
    return lo * pow(hi / lo, uniform(0, 1));
}

static void most(double *worst, double error)
{
    *worst = fmax(*worst, fabs(error));
}

static void bounded(const char *what, double worst, double bound)
{
    if (!CHECK(worst <= bound)) printf("  %s: %g, at most %g\n", what, worst, bound);
    if (getenv("SHOW")) printf("%s: %g of %g\n", what, worst, bound);
}

static gn_camera random_camera(void)
{
    gn_camera c = {.focal_q24 = (uint32_t)(uniform(1.6, 8) * 16777216),
                   .near_q16 = (int32_t)any_size(65536, 1 << 22),
                   .far_q16 = INT32_MAX};
    gn_affine_rotation(&c.to_world, (uint16_t)rnd(), (uint16_t)rnd(), (uint16_t)rnd());
    for (int i = 0; i < 3; i++) c.to_world.t_q16[i] = (int32_t)uniform(-268435456, 268435456);
    return c;
}

/* Of a frame with this camera and a sun; returns its status. */
static gn_status setup_frame(gn_scene *scene, gn_light *sun, int width, int height)
{
    const gn_picture picture = {(uint16_t)width, (uint16_t)height, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    *sun = (gn_light){.direction = {(int32_t)rnd() >> 1, (int32_t)rnd() >> 1, (int32_t)rnd() >> 1},
                      .shadow_strength_uq16 = 65536,
                      .bias_normal_q16 = (int32_t)uniform(1, 1 << 18)};
    *scene = (gn_scene){.lights = sun, .n_lights = 1, .camera = random_camera()};
    scene->shadow.max_distance_q16 = (int32_t)fmin(1 << 28, scene->camera.near_q16 * any_size(2, 1000));
    scene->shadow.distance_fade_uq16 = 6554;
    scene->shadow.cascade_fade_uq16 = (uint32_t)uniform(66, 20000);
    gn_init(&renderer, &picture);
    return gn_begin(&renderer, scene);
}

#endif
