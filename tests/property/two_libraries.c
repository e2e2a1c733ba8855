/* One program with two configurations of the library: GN_PREFIX gives the functions of each other names, so that both
 * can be linked. This file is compiled three times. With DRAW=draw_general or draw_compact it becomes a function of
 * that name that draws a triangle with its library, and returns a checksum of the pixels. Without DRAW it is the
 * program: it prints whether both drew, and whether both draw the same again. */
#include <stdint.h>
#include <stdio.h>

#ifdef DRAW
#include "gnomon.h"

static gn_renderer renderer;
static const gn_position pos[] = {GN_Q16(-4), 0, GN_Q16(4), GN_Q16(4), 0, GN_Q16(4), 0, 0, GN_Q16(-4)};
static const uint16_t idx[] = {0, 1, 2};
static const gn_mesh mesh = GN_MESH(pos, idx);

static void add(void *user, int x, int y, int w, int h, const void *pixels)
{
    const uint16_t *px = pixels;
    (void)x, (void)y;
    for (int i = 0; i < w * h; i++) *(uint32_t *)user = *(uint32_t *)user * 31 + px[i];
}

uint32_t DRAW(void);
uint32_t DRAW(void)
{
    const int32_t eye[3] = {0, GN_Q16(3), GN_Q16(7)}, target[3] = {0, 0, 0};
    const gn_picture picture = {64, 48, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_object object = gn_object_default(&mesh);
    gn_light sun = gn_light_sun(-1, -3, -1);
    gn_camera camera = gn_camera_default(eye, target);
    gn_scene scene = gn_scene_default(&camera, &object, 1, &sun, 1);
    uint32_t sum = 0;
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = gn_render(&renderer, &scene, add, &sum);
    return status ? 0 : sum;
}

#else
uint32_t draw_general(void), draw_compact(void);

int main(void)
{
    uint32_t general = draw_general(), compact = draw_compact();
    printf("%d %d\n", general != 0 && compact != 0, general == draw_general() && compact == draw_compact());
    return 0;
}
#endif
