/* A lamp turns about a pyramid: one button to each side. Write panel_write() and button_is_down() for your board. */
#include "gnomon.h"

/* w * h pixels of 16 bits, row after row, at (x, y) */
void panel_write(int x, int y, int w, int h, const void *pixels);
int button_is_down(int left_or_right); /* 0, 1 */

static gn_renderer renderer; /* all of the library's RAM */

static const int32_t ground_pos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                     GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3};
static const int32_t body_pos[] = {GN_Q16(-1),  GN_Q16(0.5), GN_Q16(-1),  GN_Q16(-1),  GN_Q16(0.5),
                                   GN_Q16(1),   GN_Q16(1),   GN_Q16(0.5), GN_Q16(1),   GN_Q16(1),
                                   GN_Q16(0.5), GN_Q16(-1),  0,           GN_Q16(2.5), 0};
static const uint16_t body_idx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(ground_pos, ground_idx), body = GN_MESH(body_pos, body_idx);

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    panel_write(x, y, w, h, pixels);
}

/* Where the lamp is after so much of a turn: its arm points along the turned x axis. */
static gn_light lamp_at(uint16_t turn)
{
    const int32_t foot[] = {0, GN_Q16(0.5), 0};
    gn_affine arm;
    gn_affine_rotation(&arm, turn, 0, 0);
    const int32_t head[] = {arm.m_q30[0][0] / 4096, GN_Q16(5), arm.m_q30[2][0] / 4096};
    return gn_light_spot(head, foot, 12000);
}

int main(void)
{
    const gn_picture picture = {160, 128, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    gn_object objects[2] = {gn_object_default(&ground), gn_object_default(&body)};
    gn_status status = gn_init(&renderer, &picture);
    uint16_t turn = 0;
    while (!status) {
        if (button_is_down(0)) turn = (uint16_t)(turn - 512);
        if (button_is_down(1)) turn = (uint16_t)(turn + 512);
        const gn_light lamp = lamp_at(turn);
        const gn_scene scene = gn_scene_default(&camera, objects, 2, &lamp, 1);
        status = gn_render(&renderer, &scene, flush, 0);
    }
    return (int)status;
}
