/* What a user need not set: everything is accepted, seen, lit and shadowed. */
#include <string.h>

#include "check.h"
#include "gnomon.h"

enum { WIDTH = 64, HEIGHT = 48 };

static gn_renderer renderer;
static uint16_t picture[WIDTH * HEIGHT];

/* Short positions hold fewer fraction bits. */
#if GN_SHORT_VERTICES % 2 && !GN_RUNTIME_KNOBS
#define POS(x)         (GN_Q16(x) / 256)
#define MESH(pos, idx) GN_MESH_FRAC(pos, idx, 8)
#else
#define POS(x)         GN_Q16(x)
#define MESH(pos, idx) GN_MESH(pos, idx)
#endif

/* a floor, and a plate that floats above its middle */
static const gn_position pos[] = {POS(-4), 0,       POS(4), POS(4),  0,       POS(4),  POS(4), 0,
                                  POS(-4), POS(-4), 0,      POS(-4), POS(-1), POS(1),  POS(1), POS(1),
                                  POS(1),  POS(1),  POS(1), POS(1),  POS(-1), POS(-1), POS(1), POS(-1)};
static const uint16_t floor_idx[] = {0, 1, 2, 0, 2, 3};
static const uint16_t idx[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
static const gn_mesh floor_mesh = MESH(pos, floor_idx), mesh = MESH(pos, idx);

static void store(void *user, int x, int y, int w, int h, const void *pixels)
{
    const uint16_t *px = pixels;
    (void)user;
    for (int i = 0; i < h; i++) memcpy(picture + (y + i) * WIDTH + x, px + i * w, (size_t)w * sizeof *px);
}

/* Returns the sum of green over the picture, and checks that nothing failed. */
static long draw(const gn_mesh *of, const gn_light *light, uint32_t n_lights)
{
    const int32_t eye[3] = {0, GN_Q16(6), GN_Q16(6)}, target[3] = {0, 0, 0};
    const gn_picture p = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_object object = gn_object_default(of);
    gn_camera camera = gn_camera_default(eye, target);
    gn_scene scene = gn_scene_default(&camera, &object, 1, light, n_lights);
    long sum = 0;
    CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
    CHECK_EQ_INT(gn_render(&renderer, &scene, store, NULL), GN_OK);
    for (int i = 0; i < WIDTH * HEIGHT; i++) sum += picture[i] >> 5 & 63;
    return sum;
}

/* A light brightens the floor; the plate, as bright as the floor, darkens some of it. */
static void check_light(const gn_light *light)
{
    long ambient = draw(&floor_mesh, light, 0), lit = draw(&floor_mesh, light, 1), with_plate = draw(&mesh, light, 1);
    gn_light shadowless = *light;
    CHECK_EQ_INT(gn_get_light_shadow(&renderer, 0, NULL, NULL), GN_SHADOW_REALTIME);
    shadowless.shadow_strength_uq16 = 0;
    CHECK(ambient > 0);
    CHECK(lit > ambient * 5 / 4);
    CHECK(with_plate < draw(&mesh, &shadowless, 1));
    CHECK_EQ_INT(gn_get_light_shadow(&renderer, 0, NULL, NULL), GN_SHADOW_NOT_WANTED);
}

/* Two lights are brighter than either, and the second gets a shadow where `room`. */
static void check_two(const gn_light *first, const gn_light *second, int room)
{
    const gn_light both[2] = {*first, *second};
    long of_first = draw(&mesh, first, 1), of_second = draw(&mesh, second, 1), of_both = draw(&mesh, both, 2);
    CHECK(of_both > of_first && of_both > of_second);
    CHECK_EQ_INT(gn_get_light_shadow(&renderer, 0, NULL, NULL), GN_SHADOW_REALTIME);
    CHECK_EQ_INT(gn_get_light_shadow(&renderer, 1, NULL, NULL), room ? GN_SHADOW_REALTIME : GN_SHADOW_NO_ROOM);
}

/* Four cascades, where four tiles of every sun fit the atlas. */
static void check_cascades(const gn_light *sun)
{
    gn_light suns[17];
    const gn_camera camera = {0};
    const uint32_t most = GN_MAX_SHADOW_TILES / 4U;
    if (!GN_SHADOWS || !GN_MANY_CASCADES || GN_ATLAS_SIZE < 64 || GN_ATLAS_TEXELS != GN_ATLAS_SIZE * GN_ATLAS_SIZE)
        return;
    for (int i = 0; i < 17; i++) suns[i] = *sun;
    CHECK_EQ_INT(gn_scene_default(&camera, NULL, 0, suns, most).shadow.n_cascades, 4);
    CHECK_EQ_INT(gn_scene_default(&camera, NULL, 0, suns, most + 1).shadow.n_cascades, 1);
}

int main(void)
{
    const int32_t above[3] = {GN_Q16(1), GN_Q16(4), GN_Q16(1)}, beside[3] = {GN_Q16(-1), GN_Q16(4), GN_Q16(1)};
    const int32_t middle[3] = {0, 0, 0};
    gn_light sun = gn_light_sun(-1, -3, -2), evening = gn_light_sun(3, -2, -1);
    check_light(&sun);
    check_cascades(&sun);
    if (GN_MAX_LIGHTS > 1) check_two(&sun, &evening, GN_MAX_SHADOW_TILES > 1);
    if (GN_PUNCTUAL_LIGHTS) {
        gn_light spot = gn_light_spot(above, middle, GN_TURN(90)), point = gn_light_point(above);
        gn_light other_point = gn_light_point(beside);
        check_light(&spot);
        check_light(&point);
        check_two(&sun, &point, 1);
        check_two(&spot, &point, 1);
        check_two(&point, &other_point, GN_MAX_OTHER_TILES >= 12); /* six faces each */
    }
    return check_report();
}
