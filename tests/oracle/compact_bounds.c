/* The error bounds of docs/NUMERICS.md 4.15, stage by stage, against double precision. Compiled with GN_COMPACT and the
 * whole library as one file, LIBRARY, of which it asks the stages. */
#include LIBRARY

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

static void units(void)
{
    double worst = 0;
    for (int n = 0; n < 100000; n++) {
        int64_t a[3];
        int32_t out[3];
        double size = any_size(1, ldexp(1, 62)), length = 0;
        for (int i = 0; i < 3; i++) {
            a[i] = (int64_t)(uniform(-1, 1) * size);
            length += (double)a[i] * (double)a[i];
        }
        if (!CHECK_EQ_INT(gn_compact_unit(out, a), length > 0)) return;
        for (int i = 0; i < 3 && length > 0; i++) most(&worst, out[i] - ldexp((double)a[i] / sqrt(length), 30));
    }
    bounded("unit vectors, LSB of Q30", worst, 8);
}

/* ---- Points ------------------------------------------------------------------------------------------------------ */

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

static void points(void)
{
    double turned = 0, place = 0, key = 0;
    for (int n = 0; n < 20000; n++) {
        gn_scene scene;
        gn_light sun;
        gn_object object = {0};
        gn_compact_xform xform;
        gn_compact_corner corner;
        if (setup_frame(&scene, &sun, 160, 120)) continue;
        const gn_compact_view *cam = &renderer.frame.cam;
        gn_affine_rotation(&object.to_world, (uint16_t)rnd(), (uint16_t)rnd(), (uint16_t)rnd());
        for (int i = 0; i < 3; i++) object.to_world.t_q16[i] = scene.camera.to_world.t_q16[i] / 2;
        if (!CHECK(gn_compact_compose(&xform, cam, &object.to_world, 16))) return;
        int32_t p[3], v[3];
        double world[3], exact[3], size = 0;
        for (int i = 0; i < 3; i++) p[i] = (int32_t)uniform(-134217728, 134217728), size += abs(p[i]);
        for (int i = 0; i < 3; i++) {
            world[i] = object.to_world.t_q16[i] - (double)cam->eye_q16[i];
            for (int k = 0; k < 3; k++) world[i] += ldexp(object.to_world.m_q30[i][k], -30) * p[k];
        }
        if (!gn_compact_transform(v, &xform, p)) continue;
        for (int i = 0; i < 3; i++) {
            exact[i] = 0;
            for (int k = 0; k < 3; k++) exact[i] += ldexp(cam->axis_q30[i][k], -30) * world[k];
            most(&turned, (v[i] - exact[i]) / (2 + ldexp(size, -28)));
        }
        if (v[2] < scene.camera.near_q16) continue;
        CHECK(gn_compact_project(&corner, cam, v));
        most(&key, corner.key - ldexp((double)scene.camera.near_q16 / v[2], 30));
        for (int i = 0; i < 2; i++) {
            double at = ldexp(scene.camera.focal_q24, -24) * 60 * v[i] / v[2] + (i ? 60 : 80);
            if (fabs(at) < 1300) most(&place, (corner.at_q16[i] - at * 65536) / (2 + fabs(at) / 256));
        }
    }
    bounded("transformed points, of their bound", turned, 1);
    bounded("projected points, of their bound", place, 1);
    bounded("keys, LSB of Q30", key, 2);
}

/* ---- Planes of keys ---------------------------------------------------------------------------------------------- */

static void planes(void)
{
    double worst = 0;
    for (int n = 0; n < 50000; n++) {
        gn_compact_view view = {.size = {256, 256}, .two_sided = 1};
        gn_compact_corner c[3];
        gn_tri tri;
        double reach = any_size(1, 1400);
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 2; k++)
                c[i].at_q16[k] = (int32_t)((128 + uniform(-reach, reach)) * 65536) & ~255; /* on the subpixel grid */
            c[i].key = (int32_t)any_size(1, 1 << 30);
        }
        if (!setup(&tri, c, &view, 1)) continue;
        double x[3], y[3], k[3];
        for (int i = 0; i < 3; i++) x[i] = c[i].at_q16[0] / 65536.0, y[i] = c[i].at_q16[1] / 65536.0, k[i] = c[i].key;
        double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        double dx = ((k[1] - k[0]) * (y[2] - y[0]) - (k[2] - k[0]) * (y[1] - y[0])) / area;
        double dy = ((k[2] - k[0]) * (x[1] - x[0]) - (k[1] - k[0]) * (x[2] - x[0])) / area;
        if (fmax(fabs(dx), fabs(dy)) > 1 << 27) continue; /* one key for all of it */
        for (int i = 0; i < 8; i++) {
            int px = tri.begin[0] + (int)(rnd() % (uint32_t)(tri.end[0] - tri.begin[0])),
                py = tri.begin[1] + (int)(rnd() % (uint32_t)(tri.end[1] - tri.begin[1]));
            double exact = k[0] + dx * (px + 0.5 - x[0]) + dy * (py + 0.5 - y[0]);
            double steps = px - tri.begin[0] + py - tri.begin[1],
                   far = fabs(dx) * fabs(px - x[0]) + fabs(dy) * fabs(py - y[0]);
            if (fabs(exact) < 1 << 30)
                most(&worst, ((int32_t)gn_compact_key(&tri, px, py) - exact) /
                                 (steps / (tri.frac_bits ? 256 : 2) + 16 + ldexp(far, -27)));
        }
    }
    bounded("keys of a triangle, of their bound", worst, 1);
}

/* ---- The light's tile -------------------------------------------------------------------------------------------- */

/* Texel, place and sphere by the formulas of MODEL 4, in Q16 units of length. */
static void tiles(void)
{
    double texel = 0, middle = 0, radius = 0;
    int n_frames = 0;
    for (int n = 0; n < 20000; n++) {
        gn_scene scene;
        gn_light sun;
        if (setup_frame(&scene, &sun, 160, 120)) continue;
        const gn_frame *frame = &renderer.frame;
        const gn_compact_view *light = &frame->view[0].project;
        double focal = ldexp(scene.camera.focal_q24, -24),
               k2 = (160.0 * 160 + 120.0 * 120) / (120.0 * focal * 120.0 * focal);
        double m = scene.shadow.max_distance_q16, near = scene.camera.near_q16,
               q = fmax(1 - scene.shadow.cascade_fade_uq16 / 65536.0, 0.125);
        double a = 1 - q * q, b = near - q * q * m, big_c = (1 + k2) * (q * q * m * m - near * near), c = m;
        if (b * b + a * big_c >= 0 && big_c > 0) c = fmin(m, big_c / (sqrt(b * b + a * big_c) - b));
        double r = sqrt(fmax((m - c) * (m - c) + k2 * m * m, ((c - near) * (c - near) + k2 * near * near) / (q * q)));
        double d = fmax(GN_ATLAS_SIZE - 2 * (1 + sqrt(2) * sun.bias_normal_q16 / 65536) - 1, GN_ATLAS_SIZE / 4.0),
               exact = (1 - ldexp(1, -20)) * 2 * r / d;
        int e;
        double digits = frexp(exact, &e) * 256, t = ldexp(ceil(digits), e - 8);
        if (fabs(digits - floor(digits + 0.5)) < 1e-4) continue; /* which of two texels is a matter of the last bits */
        n_frames++;
        most(&texel, ldexp(light->scale, -light->shift - 16) * t - 1);
        most(&radius, (sqrt((double)frame->radius2_q32) / 65536 * t - r) / (2 + ldexp(r, -20)));
        for (int k = 0; k < 3; k++) { /* whole texels: the middle of the tile, its near plane */
            double at = 0;
            for (int i = 0; i < 3; i++) at += ldexp(light->axis_q30[k][i], -30) * light->eye_q16[i];
            most(&middle, (at / t - floor(at / t + 0.5)) * t / (4 + ldexp(t, -15)));
        }
    }
    CHECK(n_frames > 2000);
    bounded("texels per unit, relative", texel, ldexp(1, -28));
    bounded("radius of the sphere, of its bound", radius, 1);
    bounded("the tile's place, of its bound", middle, 1);
}

int main(void)
{
    units();
    points();
    planes();
    tiles();
    return check_report();
}
