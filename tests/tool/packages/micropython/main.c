/* Calls gnomon.draw with the two meshes of a script, writes the picture, and tries what must raise a ValueError. */
#include <stdio.h>

#include "py/runtime.h"

enum { WIDTH = 150, HEIGHT = 100, Q16 = 65536, GREY = 52429, VALUE_ERROR = 1, OTHER_ERROR = 2 };
#define COUNT(a) (sizeof(a) / sizeof *(a))

typedef struct {
    size_t n;
    mp_obj_t item[4];
} sequence;

extern const mp_obj_module_t gnomon_module;
const int mp_type_module = 1, mp_type_ValueError = 2;

static jmp_buf raised;

static int32_t ground_pos[] = {-4 * Q16, 0, -4 * Q16, -4 * Q16, 0, 4 * Q16, 4 * Q16, 0, 4 * Q16, 4 * Q16, 0, -4 * Q16};
static int32_t body_pos[] = {-Q16, Q16 / 2, -Q16,    -Q16, Q16 / 2, Q16,         Q16, Q16 / 2,
                             Q16,  Q16,     Q16 / 2, -Q16, 0,       5 * Q16 / 2, 0};
static uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3};
static uint16_t body_idx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static uint8_t pixels[2 * WIDTH * HEIGHT];

static mp_buffer_info_t arrays[] = {{ground_pos, sizeof ground_pos, 'i'},
                                    {ground_idx, sizeof ground_idx, 'H'},
                                    {body_pos, sizeof body_pos, 'i'},
                                    {body_idx, sizeof body_idx, 'H'},
                                    {pixels, sizeof pixels, 'B'}};
static sequence colour = {3, {GREY, GREY, GREY}}, eye = {3, {0, 4 * Q16, 7 * Q16}}, target = {3, {0, Q16, 0}},
                sun = {3, {-1, -2, -1}};
static sequence ground = {4, {(mp_obj_t)&arrays[0], (mp_obj_t)&arrays[1], 0, (mp_obj_t)&colour}},
                body = {4, {(mp_obj_t)&arrays[2], (mp_obj_t)&arrays[3], 0, (mp_obj_t)&colour}},
                objects = {2, {(mp_obj_t)&ground, (mp_obj_t)&body}};

int mp_obj_get_int(mp_obj_t o)
{
    return (int)o;
}

void mp_obj_get_array(mp_obj_t o, size_t *n, mp_obj_t **items)
{
    sequence *s = (sequence *)o;
    *n = s->n;
    *items = s->item;
}

void mp_obj_get_array_fixed_n(mp_obj_t o, size_t n, mp_obj_t **items)
{
    size_t is;
    mp_obj_get_array(o, &is, items);
    if (is != n) longjmp(raised, VALUE_ERROR);
}

void mp_get_buffer_raise(mp_obj_t o, mp_buffer_info_t *out, int flags)
{
    if (o < 65536) longjmp(raised, OTHER_ERROR);
    *out = *(mp_buffer_info_t *)o;
    if (flags == MP_BUFFER_WRITE && out->buf != pixels) longjmp(raised, OTHER_ERROR);
}

void mp_raise_ValueError(const char *text)
{
    (void)text;
    longjmp(raised, VALUE_ERROR);
}

void mp_raise_msg_varg(const int *type, const char *format, ...)
{
    (void)format;
    longjmp(raised, type == &mp_type_ValueError ? VALUE_ERROR : OTHER_ERROR);
}

/* 0, or what was raised. */
static int draw(int width)
{
    const mp_obj_fun_t *function = gnomon_module.globals->table[1].value;
    const mp_obj_t arguments[] = {(mp_obj_t)&arrays[4], width,         HEIGHT, (mp_obj_t)&objects, (mp_obj_t)&eye,
                                  (mp_obj_t)&target,    (mp_obj_t)&sun};
    int error = setjmp(raised);
    if (error) return error;
    if (function->min != (int)COUNT(arguments) || function->max != function->min) return OTHER_ERROR;
    return (int)function->fun(COUNT(arguments), arguments);
}

/* 1 if draw raises a ValueError while a length or another number is this one. */
static int refuses(size_t *number, size_t value)
{
    const size_t was = *number;
    *number = value;
    const int error = draw(WIDTH);
    *number = was;
    return error == VALUE_ERROR;
}

int main(void)
{
    if (draw(WIDTH) || draw(0) != VALUE_ERROR) return 1;
    if (draw(WIDTH)) return 2;
    fwrite(pixels, 1, sizeof pixels, stdout);
    arrays[3].typecode = 'B';
    if (draw(WIDTH) != VALUE_ERROR) return 3;
    arrays[3].typecode = 'H';
    body_idx[0] = 5; /* no such vertex */
    if (draw(WIDTH) != VALUE_ERROR) return 4;
    body_idx[0] = 0;
    return refuses(&arrays[4].len, sizeof pixels - 1) && refuses(&arrays[2].len, sizeof body_pos - 4) &&
                   refuses(&arrays[3].len, 4) && refuses(&body.n, 3) && refuses(&eye.n, 2) && refuses(&objects.n, 41)
               ? 0
               : 5;
}
