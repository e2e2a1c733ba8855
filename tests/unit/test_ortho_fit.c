/* Sizes of tight fits, where what casts lies beside what is seen: beyond a cascade's sphere, where the next one sees
 * it. Tiles have whole columns of 8 texels, and no more texels than they were given. [D12] */
#include <string.h>

#include "check.h"
#include "gn_internal.h"
#include "light/gn_lights.h"

enum { WIDTH = 64, HEIGHT = 48 };

static const int32_t cube_pos[] = {-65536, -65536, -65536, 65536,  -65536, -65536, -65536, 65536,
                                   -65536, 65536,  65536,  -65536, -65536, -65536, 65536,  65536,
                                   -65536, 65536,  -65536, 65536,  65536,  65536,  65536,  65536};
static const uint16_t cube_idx[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
static const int32_t ground_pos[] = {-200 * 65536, 0, -200 * 65536, 200 * 65536, 0, -200 * 65536,
                                     -200 * 65536, 0, 200 * 65536,  200 * 65536, 0, 200 * 65536};
static const uint16_t ground_idx[] = {0, 2, 1, 1, 2, 3};

static gn_renderer renderer;
static long n_narrow, n_whole;
static uint32_t penumbra_uq16; /* 0: no disk */

static void flush(void *user, int x, int y, int width, int height, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)width, (void)height, (void)pixels;
}

/* A disk takes as many rings of texels as its radius says: of a whole number no more. */
static void check_disk(const gn_light_view *view)
{
    if (view->filter_idx > 1) CHECK((view->filter_idx - 1) << 16 < view->disk_radius_q16);
    n_whole +=
        view->disk_radius_q16 && view->disk_radius_q16 % 65536 == 0 && view->disk_radius_q16 >> 16 < GN_DISK_INDEX_MAX;
}

static void check_views(void)
{
    for (uint32_t i = 0; i < renderer.frame.n_views; i++) {
        const gn_light_view *view = &renderer.frame.view[i];
        if (!view->tight) continue;
        CHECK(view->tile_texels >= 8 && view->tile_texels % 8 == 0 && view->tile_rows >= 8 && view->tile_rows % 8 == 0);
        CHECK((uint32_t)view->tile_texels * view->tile_rows <= (uint32_t)GN_ATLAS_SIZE * GN_ATLAS_SIZE);
        n_narrow += view->tile_texels == 8 || view->tile_rows == 8;
        if (penumbra_uq16) check_disk(view);
    }
}

/* A cube at (x, 2, z) over a ground that casts nothing, seen along -Z, under a sun from (sun, -100, sun / 2). */
static void check_cube(int x, int z, int sun)
{
    const gn_mesh cube = {.pos = cube_pos, .idx = cube_idx, .n_vertices = 8, .n_triangles = 12, .pos_frac_bits = 16},
                  ground = {
                      .pos = ground_pos, .idx = ground_idx, .n_vertices = 4, .n_triangles = 2, .pos_frac_bits = 16};
    gn_object object[] = {gn_object_default(&cube), gn_object_default(&ground)};
    object[0].to_world.t_q16[0] = x * 65536;
    object[0].to_world.t_q16[1] = 2 * 65536;
    object[0].to_world.t_q16[2] = z * 65536;
    object[1].flags &= ~(uint32_t)GN_OBJECT_CASTS;
    const int32_t eye[] = {0, 2 * 65536, 0}, to[] = {0, 2 * 65536, -10 * 65536};
    const gn_light light = gn_light_sun(sun, -100, sun / 2);
    gn_camera camera = gn_camera_default(eye, to);
    camera.focal_q24 = GN_Q24(1);
    gn_scene scene = gn_scene_default(&camera, object, 2, &light, 1);
    scene.shadow.n_cascades = 2;
    scene.shadow.cascade_ratio_uq16[0] = GN_UQ16(0.1);
    if (penumbra_uq16) scene.shadow.filter = GN_FILTER_DISK, scene.shadow.disk_samples = 8;
    scene.shadow.penumbra_uq16 = penumbra_uq16;
    const gn_picture picture = {.width = WIDTH, .height = HEIGHT, .format = GN_FORMAT_RGB565};
    CHECK_EQ_INT(gn_init(&renderer, &picture), GN_OK);
    if (CHECK_EQ_INT(gn_begin(&renderer, &scene), GN_OK)) check_views();
    CHECK_EQ_INT(gn_render(&renderer, &scene, flush, NULL), GN_OK);
}

/* A penumbra that makes the disk of the first view about n texels wide; and some beside it. */
static void check_disks(int x, int n)
{
    penumbra_uq16 = 1 << 14;
    check_cube(x, -24, 20);
    const int32_t radius_q16 = renderer.frame.view[0].disk_radius_q16;
    const uint32_t about = (uint32_t)(((uint64_t)n << 30) / (uint32_t)radius_q16);
    for (penumbra_uq16 = about - 20; penumbra_uq16 < about + 20; penumbra_uq16++) check_cube(x, -24, 20);
    penumbra_uq16 = 0;
}

int main(void)
{
    for (int x = 20; x <= 36; x += 2)
        for (int z = -44; z <= -16; z += 4)
            for (int sun = -60; sun <= 60; sun += 10) check_cube(x, z, sun);
    CHECK(n_narrow > 20);
    for (int n = 1; GN_DISK_FILTER && n < 6; n++) check_disks(20 + n, n);
    CHECK(!GN_DISK_FILTER || n_whole > 2);
    return check_report();
}
