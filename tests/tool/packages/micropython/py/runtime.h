/* What the module takes of MicroPython, for a machine without it: objects are numbers, or pointers to sequences and
 * arrays. */
#include <setjmp.h>
#include <stddef.h>
#include <stdint.h>

typedef intptr_t mp_obj_t;
typedef struct {
    void *buf;
    size_t len;
    int typecode;
} mp_buffer_info_t;
typedef struct {
    mp_obj_t (*fun)(size_t, const mp_obj_t *);
    int min, max;
} mp_obj_fun_t;
typedef struct {
    const char *key;
    const void *value;
} mp_rom_map_elem_t;
typedef struct {
    const mp_rom_map_elem_t *table;
    size_t n;
} mp_obj_dict_t;
typedef struct {
    const void *type;
} mp_obj_base_t;
typedef struct {
    mp_obj_base_t base;
    mp_obj_dict_t *globals;
} mp_obj_module_t;

enum { MP_BUFFER_READ = 1, MP_BUFFER_WRITE = 2, mp_const_none = 0 };
extern const int mp_type_module, mp_type_ValueError;
#define MP_ERROR_TEXT(text) text
#define MP_QSTR___name__    "__name__"
#define MP_QSTR_gnomon      "gnomon"
#define MP_QSTR_draw        "draw"
#define MP_ROM_QSTR(text)   text
#define MP_ROM_PTR(pointer) pointer
#define MP_DEFINE_CONST_FUN_OBJ_VAR_BETWEEN(name, least, most, function)                                               \
    const mp_obj_fun_t name = {function, least, most}
#define MP_DEFINE_CONST_DICT(name, table) const mp_obj_dict_t name = {table, sizeof table / sizeof *table}
#define MP_REGISTER_MODULE(name, module)  extern const mp_obj_module_t *const registered

int mp_obj_get_int(mp_obj_t o);
void mp_obj_get_array(mp_obj_t o, size_t *n, mp_obj_t **items);
void mp_obj_get_array_fixed_n(mp_obj_t o, size_t n, mp_obj_t **items);
void mp_get_buffer_raise(mp_obj_t o, mp_buffer_info_t *out, int flags);
_Noreturn void mp_raise_ValueError(const char *text);
_Noreturn void mp_raise_msg_varg(const int *type, const char *format, ...);
