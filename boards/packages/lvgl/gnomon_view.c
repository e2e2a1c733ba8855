/* A turning pyramid and its shadow as a widget of LVGL 9: gnomon_view_create(lv_screen_active()). */
#include <string.h>

#include "gnomon.h"
#include "lvgl.h"

enum { WIDTH = 150, HEIGHT = 100, MS_PER_PICTURE = 50 };

LV_DRAW_BUF_DEFINE_STATIC(frame, WIDTH, HEIGHT, LV_COLOR_FORMAT_RGB565);
static gn_renderer renderer;
static uint16_t turn;

static const int32_t ground_pos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                     GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3};
static const int32_t body_pos[] = {GN_Q16(-1),  GN_Q16(0.5), GN_Q16(-1),  GN_Q16(-1),  GN_Q16(0.5),
                                   GN_Q16(1),   GN_Q16(1),   GN_Q16(0.5), GN_Q16(1),   GN_Q16(1),
                                   GN_Q16(0.5), GN_Q16(-1),  0,           GN_Q16(2.5), 0};
static const uint16_t body_idx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(ground_pos, ground_idx), body = GN_MESH(body_pos, body_idx);

/* Rows of the draw buffer are as far apart as its stride says. */
static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    const uint8_t *from = (const uint8_t *)pixels;
    (void)user;
    for (int row = 0; row < h; row++, from += 2 * w)
        memcpy(lv_draw_buf_goto_xy(&frame, (uint32_t)x, (uint32_t)(y + row)), from, (size_t)(2 * w));
}

static void draw(lv_timer_t *timer)
{
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    gn_object objects[2] = {gn_object_default(&ground), gn_object_default(&body)};
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    gn_affine_rotation(&objects[1].to_world, turn, 0, 0);
    turn = (uint16_t)(turn + 512);
    gn_status status = gn_render(&renderer, &scene, flush, NULL);
    if (status) LV_LOG_ERROR("%s", gn_status_text(status));
    lv_obj_invalidate((lv_obj_t *)lv_timer_get_user_data(timer));
}

lv_obj_t *gnomon_view_create(lv_obj_t *parent);
lv_obj_t *gnomon_view_create(lv_obj_t *parent)
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    lv_obj_t *canvas = lv_canvas_create(parent);
    LV_DRAW_BUF_INIT_STATIC(frame);
    lv_canvas_set_draw_buf(canvas, &frame);
    if (gn_init(&renderer, &picture) == GN_OK) lv_timer_create(draw, MS_PER_PICTURE, canvas);
    return canvas;
}
