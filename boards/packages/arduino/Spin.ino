// A pyramid turns over a ground that takes its shadow. Fill in panelWrite() for your display; Panel drives one itself.
#include <gnomon.h>

static gn_renderer renderer; // all of the library's RAM

static const int32_t groundPos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                    GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const int32_t bodyPos[] = {GN_Q16(-1), GN_Q16(0.5), GN_Q16(-1), GN_Q16(-1), GN_Q16(0.5), GN_Q16(1), GN_Q16(1),
                                  GN_Q16(0.5), GN_Q16(1), GN_Q16(1), GN_Q16(0.5), GN_Q16(-1), 0, GN_Q16(2.5), 0};
static const uint16_t groundIdx[] = {0, 1, 2, 0, 2, 3};
static const uint16_t bodyIdx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(groundPos, groundIdx), body = GN_MESH(bodyPos, bodyIdx);
static gn_object objects[2];
static uint16_t turn;

// Takes w * h pixels of 16 bits, row after row, at (x, y). Their format is that of setup():
//   TFT_eSPI, LovyanGFX: GN_FORMAT_RGB565_SWAPPED, tft.pushImage(x, y, w, h, (uint16_t *)pixels);
//   Adafruit_GFX: GN_FORMAT_RGB565, tft.drawRGBBitmap(x, y, (uint16_t *)pixels, w, h);
static void panelWrite(void *, int x, int y, int w, int h, const void *pixels)
{
    (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

// Says what went wrong, and stops.
static void check(gn_status status)
{
    for (; status; delay(1000)) Serial.println(gn_status_text(status));
}

void setup()
{
    const gn_picture picture = {160, 128, GN_FORMAT_RGB565_SWAPPED, GN_VIEW_COLOUR, 0};
    Serial.begin(115200);
    check(gn_init(&renderer, &picture));
    objects[0] = gn_object_default(&ground);
    objects[1] = gn_object_default(&body);
    objects[1].albedo_uq16[2] = GN_UQ16(0.2);
}

void loop()
{
    const unsigned long start = millis();
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    gn_affine_rotation(&objects[1].to_world, turn += 512, 0, 0); // of 65536
    check(gn_render(&renderer, &scene, panelWrite, 0));
    Serial.println(1000.0 / (millis() - start)); // frames per second
}
