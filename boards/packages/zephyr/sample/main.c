/* A turning pyramid and its shadow on the chosen display: RGB565, as most panels on SPI take it. */
#include <zephyr/device.h>
#include <zephyr/drivers/display.h>
#include <zephyr/kernel.h>

#include "gnomon.h"

static gn_renderer renderer;

static const int32_t ground_pos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                     GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3};
static const int32_t body_pos[] = {GN_Q16(-1),  GN_Q16(0.5), GN_Q16(-1),  GN_Q16(-1),  GN_Q16(0.5),
                                   GN_Q16(1),   GN_Q16(1),   GN_Q16(0.5), GN_Q16(1),   GN_Q16(1),
                                   GN_Q16(0.5), GN_Q16(-1),  0,           GN_Q16(2.5), 0};
static const uint16_t body_idx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(ground_pos, ground_idx), body = GN_MESH(body_pos, body_idx);

/* A tile goes to the display as it is. */
static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    const struct display_buffer_descriptor tile = {
        .buf_size = (uint32_t)(2 * w * h), .width = (uint16_t)w, .height = (uint16_t)h, .pitch = (uint16_t)w};
    display_write((const struct device *)user, (uint16_t)x, (uint16_t)y, &tile, pixels);
}

int main(void)
{
    const struct device *display = DEVICE_DT_GET(DT_CHOSEN(zephyr_display));
    struct display_capabilities is;
    if (!device_is_ready(display)) return -1;
    display_get_capabilities(display, &is);
    const gn_format format =
        is.current_pixel_format == PIXEL_FORMAT_BGR_565 ? GN_FORMAT_RGB565 : GN_FORMAT_RGB565_SWAPPED;
    const gn_picture picture = {is.x_resolution, is.y_resolution, format, GN_VIEW_COLOUR, 0};
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    gn_object objects[2] = {gn_object_default(&ground), gn_object_default(&body)};
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    gn_status status = gn_init(&renderer, &picture);
    display_blanking_off(display);
    for (uint16_t turn = 0; !status; turn = (uint16_t)(turn + 256)) {
        gn_affine_rotation(&objects[1].to_world, turn, 0, 0);
        status = gn_render(&renderer, &scene, flush, (void *)display);
        k_yield();
    }
    printk("%s\n", gn_status_text(status));
    return -1;
}
