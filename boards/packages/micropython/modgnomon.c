/* gnomon.draw(buffer, width, height, turn): a pyramid after turn/65536 of a turn, and its shadow, as RGB565. */
#include <string.h>

#include "gnomon.h"
#include "py/runtime.h"

static gn_renderer renderer;
static uint8_t *frame;
static int frame_width;

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
    const uint8_t *from = (const uint8_t *)pixels;
    (void)user;
    for (int row = 0; row < h; row++, from += 2 * w)
        memcpy(frame + 2 * ((y + row) * frame_width + x), from, (size_t)(2 * w));
}

static mp_obj_t draw(size_t n, const mp_obj_t *args)
{
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    gn_object objects[2] = {gn_object_default(&ground), gn_object_default(&body)};
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    const gn_picture picture = {mp_obj_get_int(args[1]), mp_obj_get_int(args[2]), GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    mp_buffer_info_t buffer;
    (void)n;
    mp_get_buffer_raise(args[0], &buffer, MP_BUFFER_WRITE);
    gn_status status = gn_init(&renderer, &picture);
    if (!status && buffer.len / 2 / (size_t)picture.width < (size_t)picture.height)
        mp_raise_ValueError(MP_ERROR_TEXT("buffer too small"));
    frame = buffer.buf;
    frame_width = picture.width;
    gn_affine_rotation(&objects[1].to_world, (uint16_t)mp_obj_get_int(args[3]), 0, 0);
    if (!status) status = gn_render(&renderer, &scene, flush, NULL);
    if (status) mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("%s"), gn_status_text(status));
    return mp_const_none;
}
static MP_DEFINE_CONST_FUN_OBJ_VAR_BETWEEN(draw_obj, 4, 4, draw);

static const mp_rom_map_elem_t names[] = {{MP_ROM_QSTR(MP_QSTR___name__), MP_ROM_QSTR(MP_QSTR_gnomon)},
                                          {MP_ROM_QSTR(MP_QSTR_draw), MP_ROM_PTR(&draw_obj)}};
static MP_DEFINE_CONST_DICT(globals, names);
const mp_obj_module_t gnomon_module = {.base = {&mp_type_module}, .globals = (mp_obj_dict_t *)&globals};
MP_REGISTER_MODULE(MP_QSTR_gnomon, gnomon_module);
