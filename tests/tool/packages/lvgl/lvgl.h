/* What the view takes of LVGL 9, for a machine without it. */
#include <assert.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct lv_obj lv_obj_t;
typedef struct lv_timer lv_timer_t;
typedef struct lv_event lv_event_t;
typedef struct {
    struct {
        uint16_t w, h, stride;
    } header;
    uint8_t *data;
} lv_draw_buf_t;

enum { LV_COLOR_FORMAT_RGB565 = 0x12, LV_EVENT_DELETE = 40 };
#define LV_LOG_ERROR(...)   printf(__VA_ARGS__)
#define LV_ASSERT_MALLOC(p) assert(p)

void *lv_malloc(size_t size);
void lv_free(void *p);
lv_draw_buf_t *lv_draw_buf_create(uint32_t w, uint32_t h, int format, uint32_t stride);
void lv_draw_buf_destroy(lv_draw_buf_t *buf);
void *lv_draw_buf_goto_xy(const lv_draw_buf_t *buf, uint32_t x, uint32_t y);
lv_obj_t *lv_canvas_create(lv_obj_t *parent);
void lv_canvas_set_draw_buf(lv_obj_t *canvas, lv_draw_buf_t *buf);
void lv_obj_add_event_cb(lv_obj_t *obj, void (*call)(lv_event_t *), int code, void *user_data);
void *lv_event_get_user_data(lv_event_t *event);
void lv_obj_invalidate(const lv_obj_t *obj);
lv_timer_t *lv_timer_create(void (*draw)(lv_timer_t *), uint32_t ms, void *user_data);
void lv_timer_delete(lv_timer_t *timer);
void *lv_timer_get_user_data(lv_timer_t *timer);
