/* gnomon.draw(buffer, width, height, objects, eye, target, sun): the script's meshes with their shadows, as RGB565.
 * objects: a list of (positions, indices, turn, (red, green, blue)): array('i') with three coordinates per vertex,
 * 65536 for a unit; array('H') with three indices per triangle; 65536 for a turn about y; 0..65536 each. eye, target:
 * coordinates as positions have them. sun: where it shines, three integers. A roof over a ground:
 *
 *     from array import array
 *     import gnomon
 *     q16 = lambda *numbers: [int(65536 * n) for n in numbers]
 *     picture, grey = bytearray(2 * 160 * 128), q16(0.8, 0.8, 0.8)
 *     square = array("H", (0, 1, 2, 0, 2, 3))
 *     ground = array("i", q16(-4, 0, -4, -4, 0, 4, 4, 0, 4, 4, 0, -4))
 *     roof = array("i", q16(-1, 1, -1, -1, 1, 1, 1, 2, 1, 1, 2, -1))
 *     for turn in range(0, 65536, 512):
 *         objects = [(ground, square, 0, grey), (roof, square, turn, grey)]
 *         gnomon.draw(picture, 160, 128, objects, q16(0, 4, 7), q16(0, 1, 0), (-1, -2, -1))
 */
#include <string.h>

#include "gnomon.h"
#include "py/runtime.h"

static gn_renderer renderer;
static gn_object objects[GN_MAX_OBJECTS];
static gn_mesh meshes[GN_MAX_OBJECTS];
static uint8_t *frame;
static int frame_width;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    const uint8_t *from = (const uint8_t *)pixels;
    (void)user;
    for (int row = 0; row < h; row++, from += 2 * w)
        memcpy(frame + 2 * ((y + row) * frame_width + x), from, (size_t)(2 * w));
}

static void get_three(mp_obj_t from, int32_t *out)
{
    mp_obj_t *item;
    mp_obj_get_array_fixed_n(from, 3, &item);
    for (int i = 0; i < 3; i++) out[i] = (int32_t)mp_obj_get_int(item[i]);
}

/* The elements of an array, whose number is 3 times *n. */
static const void *get_threes(mp_obj_t from, int typecode, size_t element_bytes, uint16_t *n)
{
    mp_buffer_info_t b;
    mp_get_buffer_raise(from, &b, MP_BUFFER_READ);
    if (b.typecode != typecode || b.len % (3 * element_bytes) || b.len / (3 * element_bytes) > UINT16_MAX)
        mp_raise_ValueError(MP_ERROR_TEXT("wanted: array('i') of positions, array('H') of indices, 3 each"));
    *n = (uint16_t)(b.len / (3 * element_bytes));
    return b.buf;
}

static void get_object(mp_obj_t from, gn_object *object, gn_mesh *mesh)
{
    mp_obj_t *item;
    int32_t colour[3];
    mp_obj_get_array_fixed_n(from, 4, &item);
    *mesh = (gn_mesh){.pos_frac_bits = 16};
    mesh->pos = get_threes(item[0], 'i', sizeof *mesh->pos, &mesh->n_vertices);
    mesh->idx = get_threes(item[1], 'H', sizeof *mesh->idx, &mesh->n_triangles);
    *object = gn_object_default(mesh);
    gn_affine_rotation(&object->to_world, (uint16_t)mp_obj_get_int(item[2]), 0, 0);
    get_three(item[3], colour);
    for (int i = 0; i < 3; i++) object->albedo_uq16[i] = (uint32_t)colour[i];
}

static mp_obj_t draw(size_t n_args, const mp_obj_t *args)
{
    const gn_picture picture = {mp_obj_get_int(args[1]), mp_obj_get_int(args[2]), GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    mp_buffer_info_t buffer;
    mp_obj_t *list;
    size_t n;
    int32_t eye[3], target[3], sun[3];
    (void)n_args;
    mp_get_buffer_raise(args[0], &buffer, MP_BUFFER_WRITE);
    gn_status status = gn_init(&renderer, &picture);
    if (!status && buffer.len / 2 / (size_t)picture.width < (size_t)picture.height)
        mp_raise_ValueError(MP_ERROR_TEXT("buffer too small"));
    mp_obj_get_array(args[3], &n, &list);
    if (n > GN_MAX_OBJECTS) mp_raise_ValueError(MP_ERROR_TEXT("too many objects"));
    for (size_t i = 0; i < n; i++) get_object(list[i], &objects[i], &meshes[i]);
    get_three(args[4], eye);
    get_three(args[5], target);
    get_three(args[6], sun);
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light light = gn_light_sun(sun[0], sun[1], sun[2]);
    const gn_scene scene = gn_scene_default(&camera, objects, (uint32_t)n, &light, 1);
    frame = buffer.buf;
    frame_width = picture.width;
    if (!status) status = gn_render(&renderer, &scene, flush, NULL);
    if (status) mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("%s"), gn_status_text(status));
    return mp_const_none;
}
static MP_DEFINE_CONST_FUN_OBJ_VAR_BETWEEN(draw_obj, 7, 7, draw);

static const mp_rom_map_elem_t names[] = {{MP_ROM_QSTR(MP_QSTR___name__), MP_ROM_QSTR(MP_QSTR_gnomon)},
                                          {MP_ROM_QSTR(MP_QSTR_draw), MP_ROM_PTR(&draw_obj)}};
static MP_DEFINE_CONST_DICT(globals, names);
const mp_obj_module_t gnomon_module = {.base = {&mp_type_module}, .globals = (mp_obj_dict_t *)&globals};
MP_REGISTER_MODULE(MP_QSTR_gnomon, gnomon_module);
