/* A clock in the sun. localtime() is right after SNTP or settimeofday(). */
#include <time.h>
#include <unistd.h>

#include "gnomon.h"

/* st7789.c: the display; w * h pixels of 16 bits, row after row, at (x, y), sent when it returns */
int panel_open(int width, int height);
void panel_write(void *user, int x, int y, int w, int h, const void *pixels);

enum { SIDE = 240, TICKS = 12, MINUTES = 720, OBJECTS = TICKS + 3 };

static gn_renderer renderer; /* all of the library's RAM */

/* A box on the dial, pointing to twelve: half its width, from where to where along it, and upwards. */
#define CORNERS(w, y, from, to)                                                                                        \
    GN_Q16(-w), GN_Q16(y), GN_Q16(-to), GN_Q16(w), GN_Q16(y), GN_Q16(-to), GN_Q16(w), GN_Q16(y), GN_Q16(-from),        \
        GN_Q16(-w), GN_Q16(y), GN_Q16(-from)
#define BOX(w, from, to, low, high)                                                                                    \
    {                                                                                                                  \
        CORNERS(w, low, from, to), CORNERS(w, high, from, to)                                                          \
    }
static const int32_t dial_pos[] = BOX(4, -4, 4, -0.5, 0), tick_pos[] = BOX(0.12, 3, 3.6, 0, 0.3);
static const int32_t hour_pos[] = BOX(0.24, -0.5, 1.9, 0.4, 0.6), minute_pos[] = BOX(0.14, -0.5, 2.8, 0.8, 1);
static const uint16_t idx[] = {4, 7, 6, 4, 6, 5, 3, 2, 6, 3, 6, 7, 2, 1, 5,
                               2, 5, 6, 1, 0, 4, 1, 4, 5, 0, 3, 7, 0, 7, 4};
static const gn_mesh dial = GN_MESH(dial_pos, idx), tick = GN_MESH(tick_pos, idx);
static const gn_mesh hour = GN_MESH(hour_pos, idx), minute = GN_MESH(minute_pos, idx);

/* So many minutes of a round of so many, clockwise. */
static void turn(gn_object *hand, int minutes, int round)
{
    gn_affine_rotation(&hand->to_world, (uint16_t)(-minutes % round * 65536 / round), 0, 0);
}

void app_main(void)
{
    static gn_object object[OBJECTS];
    const gn_picture picture = {SIDE, SIDE, GN_FORMAT_RGB565_SWAPPED, GN_VIEW_COLOUR, 0};
    const int32_t eye[] = {0, GN_Q16(11), GN_Q16(6)}, target[] = {0, 0, 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(2, -3, 1);
    gn_scene scene = gn_scene_default(&camera, object, OBJECTS, &sun, 1);
    scene.shadow.max_distance_q16 = GN_Q16(20);
    scene.shadow.n_cascades = 1;
    for (int i = 0; i < TICKS; i++) object[i] = gn_object_default(&tick), turn(&object[i], i, TICKS);
    object[TICKS] = gn_object_default(&dial);
    gn_object *hands = &object[TICKS + 1];
    hands[0] = gn_object_default(&hour);
    hands[1] = gn_object_default(&minute);
    hands[0].albedo_uq16[1] = hands[0].albedo_uq16[2] = hands[1].albedo_uq16[0] = 8000;
    gn_status status = panel_open(SIDE, SIDE) ? GN_ERR_NULL : gn_init(&renderer, &picture);
    while (!status) {
        const struct tm *t = localtime(&(time_t){time(NULL)});
        turn(&hands[0], t->tm_hour * 60 + t->tm_min, MINUTES);
        turn(&hands[1], t->tm_min, 60);
        status = gn_render(&renderer, &scene, panel_write, NULL);
        sleep(1);
    }
}
