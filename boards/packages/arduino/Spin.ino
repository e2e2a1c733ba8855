// A pyramid turns over a ground that takes its shadow. Fill in panelWrite() for your display.
#include <gnomon.h>

static gn_renderer renderer; // all of the library's RAM

static const int32_t groundPos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                    GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const uint16_t groundIdx[] = {0, 1, 2, 0, 2, 3};
static const int32_t bodyPos[] = {GN_Q16(-1), GN_Q16(0.5), GN_Q16(-1), GN_Q16(-1), GN_Q16(0.5), GN_Q16(1), GN_Q16(1),
                                  GN_Q16(0.5), GN_Q16(1), GN_Q16(1), GN_Q16(0.5), GN_Q16(-1), 0, GN_Q16(2.5), 0};
static const uint16_t bodyIdx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(groundPos, groundIdx), body = GN_MESH(bodyPos, bodyIdx);
static gn_object objects[2];
static uint16_t turn;

// w * h pixels of 16 bits, row after row, at (x, y)
static void panelWrite(void *, int x, int y, int w, int h, const void *pixels)
{
    // for example: tft.pushImage(x, y, w, h, (uint16_t *)pixels);
    (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

void setup()
{
    const gn_picture picture = {160, 128, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_init(&renderer, &picture);
    objects[0] = gn_object_default(&ground);
    objects[1] = gn_object_default(&body);
    objects[1].albedo_uq16[2] = GN_UQ16(0.2);
}

void loop()
{
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    gn_affine_rotation(&objects[1].to_world, turn, 0, 0);
    turn += 512; // of 65536
    gn_render(&renderer, &scene, panelWrite, 0);
}
