/* A pyramid and its shadow, as letters on a terminal: four turns of a quarter. */
#include <stdio.h>

#include "gnomon.h"

enum { WIDTH = 64, HEIGHT = 24 };

static gn_renderer renderer;
static unsigned char screen[HEIGHT][WIDTH];

static const int32_t ground_pos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                     GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3};
static const int32_t body_pos[] = {GN_Q16(-1),  GN_Q16(0.5), GN_Q16(-1),  GN_Q16(-1),  GN_Q16(0.5),
                                   GN_Q16(1),   GN_Q16(1),   GN_Q16(0.5), GN_Q16(1),   GN_Q16(1),
                                   GN_Q16(0.5), GN_Q16(-1),  0,           GN_Q16(2.5), 0};
static const uint16_t body_idx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(ground_pos, ground_idx), body = GN_MESH(body_pos, body_idx);

static void show(void *user, int x, int y, int w, int h, const void *pixels)
{
    const unsigned char *p = (const unsigned char *)pixels;
    (void)user;
    for (int row = 0; row < h; row++)
        for (int i = 0; i < w; i++) screen[y + row][x + i] = (unsigned char)" .:-=+*#%@"[*p++ * 10 / 256];
}

int main(void)
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_GREY8, GN_VIEW_COLOUR, 0};
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    gn_object objects[2];
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    gn_status status = gn_init(&renderer, &picture);
    objects[0] = gn_object_default(&ground);
    objects[1] = gn_object_default(&body);
    for (uint16_t turn = 0; turn < 16384 && !status; turn = (uint16_t)(turn + 4096)) {
        const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
        gn_affine_rotation(&objects[1].to_world, turn, 0, 0);
        status = gn_render(&renderer, &scene, show, 0);
        for (int y = 0; y < HEIGHT; y++) printf("%.*s\n", WIDTH, (const char *)screen[y]);
    }
    if (status) printf("%s\n", gn_status_text(status));
    return status != 0;
}
