/* Turning pyramids and their shadows as widgets of LVGL 9: gnomon_view_create(parent, WIDTH, HEIGHT), as often as there
 * is memory. A view ends when its object is deleted. */
#include <string.h>

#include "gnomon.h"
#include "lvgl.h"

typedef struct {
    lv_obj_t *canvas;
    lv_draw_buf_t *frame;
    lv_timer_t *timer;
    uint16_t turn;
} view;

static gn_renderer renderer; /* of all views, which are drawn one after the other */

static const int32_t ground_pos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                     GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3};
static const int32_t body_pos[] = {GN_Q16(-1),  GN_Q16(0.5), GN_Q16(-1),  GN_Q16(-1),  GN_Q16(0.5),
                                   GN_Q16(1),   GN_Q16(1),   GN_Q16(0.5), GN_Q16(1),   GN_Q16(1),
                                   GN_Q16(0.5), GN_Q16(-1),  0,           GN_Q16(2.5), 0};
static const uint16_t body_idx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(ground_pos, ground_idx), body = GN_MESH(body_pos, body_idx);

static void flush(void *user, int x, int y, int w, int h, const void *pixels) /* rows of LVGL are a stride apart */
{
    const uint8_t *from = (const uint8_t *)pixels;
    for (int row = 0; row < h; row++, from += 2 * w)
        memcpy(lv_draw_buf_goto_xy((lv_draw_buf_t *)user, (uint32_t)x, (uint32_t)(y + row)), from, (size_t)(2 * w));
}

static void draw(lv_timer_t *timer)
{
    view *v = (view *)lv_timer_get_user_data(timer);
    const gn_picture picture = {v->frame->header.w, v->frame->header.h, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    gn_object objects[2] = {gn_object_default(&ground), gn_object_default(&body)};
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    gn_status status = gn_init(&renderer, &picture);
    gn_affine_rotation(&objects[1].to_world, v->turn, 0, 0);
    v->turn = (uint16_t)(v->turn + 512);
    if (!status) status = gn_render(&renderer, &scene, flush, v->frame);
    if (status) LV_LOG_ERROR("%s", gn_status_text(status));
    lv_obj_invalidate(v->canvas);
}

static void deleted(lv_event_t *event) /* LV_EVENT_DELETE: the canvas is about to go */
{
    view *v = (view *)lv_event_get_user_data(event);
    lv_timer_delete(v->timer);
    lv_draw_buf_destroy(v->frame);
    lv_free(v);
}

lv_obj_t *gnomon_view_create(lv_obj_t *parent, uint32_t width, uint32_t height);
lv_obj_t *gnomon_view_create(lv_obj_t *parent, uint32_t width, uint32_t height)
{
    view *v = (view *)lv_malloc(sizeof *v);
    LV_ASSERT_MALLOC(v);
    *v = (view){lv_canvas_create(parent), lv_draw_buf_create(width, height, LV_COLOR_FORMAT_RGB565, 0), NULL, 0};
    LV_ASSERT_MALLOC(v->frame);
    v->timer = lv_timer_create(draw, 50, v); /* ms */
    lv_canvas_set_draw_buf(v->canvas, v->frame);
    lv_obj_add_event_cb(v->canvas, deleted, LV_EVENT_DELETE, v);
    return v->canvas;
}
