/* Two views of different sizes, of which the first is deleted. Writes the first picture of the first view; what lies
 * between the rows stays as it was. Built with the address sanitizer: what a view leaves behind, or looks at when it is
 * gone, is an error. */
#include <string.h>

#include "lvgl.h"

enum { TIMERS = 4, GAP_BYTES = 20, GAP = 0xA5 };

struct lv_timer {
    void (*draw)(lv_timer_t *);
    void *user_data;
};
struct lv_event {
    void *user_data;
};
struct lv_obj {
    lv_draw_buf_t *buf;
    void (*deleted)(lv_event_t *);
    lv_event_t event;
    int n_drawn;
};

static lv_timer_t *timers[TIMERS];
static lv_obj_t screen;

lv_obj_t *gnomon_view_create(lv_obj_t *parent, uint32_t width, uint32_t height);

void *lv_malloc(size_t size)
{
    return malloc(size);
}

void lv_free(void *p)
{
    free(p);
}

lv_draw_buf_t *lv_draw_buf_create(uint32_t w, uint32_t h, int format, uint32_t stride)
{
    lv_draw_buf_t *buf = malloc(sizeof *buf);
    assert(buf && format == LV_COLOR_FORMAT_RGB565 && stride == 0);
    buf->header.w = (uint16_t)w;
    buf->header.h = (uint16_t)h;
    buf->header.stride = (uint16_t)(2 * w + GAP_BYTES);
    buf->data = malloc((size_t)buf->header.stride * h);
    assert(buf->data);
    memset(buf->data, GAP, (size_t)buf->header.stride * h);
    return buf;
}

void lv_draw_buf_destroy(lv_draw_buf_t *buf)
{
    free(buf->data);
    free(buf);
}

void *lv_draw_buf_goto_xy(const lv_draw_buf_t *buf, uint32_t x, uint32_t y)
{
    return buf->data + y * buf->header.stride + 2 * x;
}

lv_obj_t *lv_canvas_create(lv_obj_t *parent)
{
    assert(parent == &screen);
    return calloc(1, sizeof(lv_obj_t));
}

void lv_canvas_set_draw_buf(lv_obj_t *canvas, lv_draw_buf_t *buf)
{
    canvas->buf = buf;
}

void lv_obj_add_event_cb(lv_obj_t *obj, void (*call)(lv_event_t *), int code, void *user_data)
{
    assert(code == LV_EVENT_DELETE);
    obj->deleted = call;
    obj->event.user_data = user_data;
}

void *lv_event_get_user_data(lv_event_t *event)
{
    return event->user_data;
}

void lv_obj_invalidate(const lv_obj_t *obj)
{
    ((lv_obj_t *)(uintptr_t)obj)->n_drawn++;
}

lv_timer_t *lv_timer_create(void (*draw)(lv_timer_t *), uint32_t ms, void *user_data)
{
    lv_timer_t **at = timers;
    while (*at) at++;
    *at = malloc(sizeof **at);
    assert(*at && ms && at < timers + TIMERS - 1);
    (*at)->draw = draw;
    (*at)->user_data = user_data;
    return *at;
}

void lv_timer_delete(lv_timer_t *timer)
{
    for (int i = 0; i < TIMERS; i++)
        if (timers[i] == timer) timers[i] = NULL;
    free(timer);
}

void *lv_timer_get_user_data(lv_timer_t *timer)
{
    return timer->user_data;
}

static void delete_object(lv_obj_t *obj)
{
    obj->deleted(&obj->event);
    free(obj);
}

static void run_timers(void)
{
    for (int i = 0; i < TIMERS; i++)
        if (timers[i]) timers[i]->draw(timers[i]);
}

/* 0, or 1 if something was drawn between the rows. */
static int write_picture(const lv_draw_buf_t *buf)
{
    for (uint32_t y = 0; y < buf->header.h; y++) {
        const uint8_t *row = lv_draw_buf_goto_xy(buf, 0, y);
        fwrite(row, 2, buf->header.w, stdout);
        for (uint32_t i = 2U * buf->header.w; i < buf->header.stride; i++)
            if (row[i] != GAP) return 1;
    }
    return 0;
}

int main(void)
{
    lv_obj_t *first = gnomon_view_create(&screen, 150, 100), *second = gnomon_view_create(&screen, 64, 48);
    run_timers();
    if (first->n_drawn != 1 || second->n_drawn != 1 || second->buf->header.w != 64) return 1;
    if (write_picture(first->buf)) return 2;
    delete_object(first);
    run_timers();
    if (second->n_drawn != 2) return 3;
    delete_object(second);
    for (int i = 0; i < TIMERS; i++)
        if (timers[i]) return 4;
    return 0;
}
