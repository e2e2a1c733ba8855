// A pyramid turns, drawn by both cores of an RP2040 (Philhower's core): one takes the even screen tiles, one the odd.
#include <gnomon.h>

static gn_renderer renderer; // all of the library's RAM, with one core's scratch
static gn_scratch second;    // the other core's
static uint16_t picture[128][160];
static volatile bool ready; // a frame for the second core

static const int32_t groundPos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                    GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const int32_t bodyPos[] = {GN_Q16(-1), GN_Q16(0.5), GN_Q16(-1), GN_Q16(-1), GN_Q16(0.5), GN_Q16(1), GN_Q16(1),
                                  GN_Q16(0.5), GN_Q16(1), GN_Q16(1), GN_Q16(0.5), GN_Q16(-1), 0, GN_Q16(2.5), 0};
static const uint16_t groundIdx[] = {0, 1, 2, 0, 2, 3};
static const uint16_t bodyIdx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(groundPos, groundIdx), body = GN_MESH(bodyPos, bodyIdx);
static gn_object objects[2];

// Says what went wrong, and stops.
static void check(gn_status status)
{
    for (; status; delay(1000)) Serial.println(gn_status_text(status));
}

static void keep(void *, int x, int y, int w, int h, const void *pixels)
{
    for (int row = 0; row < h; row++) memcpy(&picture[y + row][x], (const uint16_t *)pixels + row * w, 2 * w);
}

static void drawTiles(uint32_t first, gn_scratch *scratch)
{
    for (uint32_t i = first; i < gn_screen_tile_count(&renderer); i += 2)
        check(gn_screen_tile(&renderer.frame, scratch, i, keep, 0));
}

void loop1()
{
    if (!__atomic_load_n(&ready, __ATOMIC_ACQUIRE)) return;
    drawTiles(1, &second);
    __atomic_store_n(&ready, false, __ATOMIC_RELEASE);
}

void setup()
{
    const gn_picture size = {160, 128, GN_FORMAT_RGB565_SWAPPED, GN_VIEW_COLOUR, 0};
    Serial.begin(115200);
    check(gn_init(&renderer, &size));
    objects[0] = gn_object_default(&ground), objects[1] = gn_object_default(&body);
}

void loop()
{
    static uint16_t turn;
    const unsigned long start = millis();
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    gn_affine_rotation(&objects[1].to_world, turn += 512, 0, 0);
    check(gn_begin(&renderer, &scene));
    for (uint32_t i = 0; i < gn_shadow_tile_count(&renderer); i++) check(gn_shadow_tile(&renderer, i));
    check(gn_prepare(&renderer));
    __atomic_store_n(&ready, true, __ATOMIC_RELEASE);
    drawTiles(0, &renderer.scratch);
    while (__atomic_load_n(&ready, __ATOMIC_ACQUIRE)) continue; // TFT_eSPI: tft.pushImage(0, 0, 160, 128, picture[0]);
    Serial.println(1000.0 / (millis() - start));                // frames per second
}
