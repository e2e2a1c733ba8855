// A sketch with a knob of its own: Arduino compiles the library without it, and gn_init says so. CAPACITY is set by the test.
CAPACITY
#include <gnomon.h>

static gn_renderer renderer;
static const int32_t pos[] = {GN_Q16(-4), 0, GN_Q16(4), GN_Q16(4), 0, GN_Q16(4), 0, 0, GN_Q16(-4)};
static const uint16_t idx[] = {0, 1, 2};
static const gn_mesh mesh = GN_MESH(pos, idx);

static void show(void *user, int, int, int, int, const void *)
{
    ++*static_cast<int *>(user);
}

void setup()
{
    const int32_t eye[] = {0, GN_Q16(3), GN_Q16(7)}, target[] = {0, 0, 0};
    gn_object object = gn_object_default(&mesh);
    gn_light sun = gn_light_sun(-1, -3, -1);
    gn_camera camera = gn_camera_default(eye, target);
    gn_scene scene = gn_scene_default(&camera, &object, 1, &sun, 1);
    const gn_picture picture = {320, 240, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    int tiles = 0;
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = gn_render(&renderer, &scene, show, &tiles);
    printf("%s, %d tiles\n", gn_status_text(status), tiles);
}

void loop()
{
}
