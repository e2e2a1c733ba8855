/* What a user need not set: everything is accepted, seen, lit and shadowed. */
#include <string.h>

#include "check.h"
#include "gnomon.h"

enum { WIDTH = 64, HEIGHT = 48 };

static gn_renderer renderer;
static uint16_t picture[WIDTH * HEIGHT];

/* a floor, and a plate that floats above its middle */
static const gn_position pos[] = {GN_Q16(-4), 0,         GN_Q16(4),  GN_Q16(4),  0,         GN_Q16(4),
                                  GN_Q16(4),  0,         GN_Q16(-4), GN_Q16(-4), 0,         GN_Q16(-4),
                                  GN_Q16(-1), GN_Q16(1), GN_Q16(1),  GN_Q16(1),  GN_Q16(1), GN_Q16(1),
                                  GN_Q16(1),  GN_Q16(1), GN_Q16(-1), GN_Q16(-1), GN_Q16(1), GN_Q16(-1)};
static const uint16_t floor_idx[] = {0, 1, 2, 0, 2, 3};
static const uint16_t idx[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
static const gn_mesh floor_mesh = GN_MESH(pos, floor_idx), mesh = GN_MESH(pos, idx);

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
    shadowless.shadow_strength_uq16 = 0;
    CHECK(ambient > 0);
    CHECK(lit > ambient * 5 / 4);
    CHECK(with_plate < draw(&mesh, &shadowless, 1));
}

int main(void)
{
    const int32_t above[3] = {GN_Q16(1), GN_Q16(4), GN_Q16(1)}, middle[3] = {0, 0, 0};
    gn_light sun = gn_light_sun(-1, -3, -2);
    check_light(&sun);
    CHECK_EQ_INT(gn_get_light_shadow(&renderer, 0, NULL, NULL), GN_SHADOW_NOT_WANTED);
    if (GN_PUNCTUAL_LIGHTS) {
        gn_light spot = gn_light_spot(above, middle, GN_TURN(90)), point = gn_light_point(above);
        check_light(&spot);
        check_light(&point);
    }
    return check_report();
}
