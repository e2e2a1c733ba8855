/* Structs and arrays of the library as C, for compile_scene.c and asset. Private to this folder.
 *
 * Fields are written in the order of their declaration, behind a macro: "F(name) value". In C it is a designator, in
 * C++11, which has none, nothing. */
#ifndef GNOMON_COMPILE_EMIT_H
#define GNOMON_COMPILE_EMIT_H

#include "compile.h"

typedef enum { EMIT_I32, EMIT_I16, EMIT_U16, EMIT_U8, EMIT_POSITION, EMIT_NORMAL } emit_number;

/* static const TYPE KIND_IDX_NAME[N] = {...}; nothing if there is no array */
void emit_array(FILE *f, emit_number type, const char *kind, size_t idx, const char *name, const void *array, size_t n,
                size_t per_line);
enum { EMIT_PER_LINE = 12 };

typedef enum { FIELD_U8, FIELD_U16, FIELD_I32, FIELD_U32, FIELD_ENUM, FIELD_AFFINE, FIELD_POINTER } emit_kind;

/* In the order of the declaration: all of a struct's. */
typedef struct {
    const char *name;
    emit_kind kind;
    size_t offset, n; /* n: of an array, else 1 */
    const char *type; /* of an enumeration */
} emit_field;

#define EMIT_FIELD(of, kind, name)                                                                                     \
    {                                                                                                                  \
#name, kind, offsetof(of, name), 1, NULL                                                                       \
    }
#define EMIT_VECTOR(of, kind, name, n)                                                                                 \
    {                                                                                                                  \
#name, kind, offsetof(of, name), n, NULL                                                                       \
    }
#define EMIT_ENUM(of, name, type)                                                                                      \
    {                                                                                                                  \
#name, FIELD_ENUM, offsetof(of, name), 1, #type                                                                \
    }

/* What a pointer of the struct refers to, in C. */
typedef void (*emit_pointer)(FILE *f, const compiled *c, const emit_field *field, const void *at, size_t idx);

/* The fields between braces; idx: of the struct, for emit_pointer. */
void emit_struct(FILE *f, const compiled *c, const emit_field *fields, size_t n_fields, const void *at, size_t idx,
                 emit_pointer pointer);
#define EMIT_COUNT(fields) (sizeof(fields) / sizeof *(fields))

int emit_affine(FILE *f, const gn_affine *a);

/* What F() is. */
void emit_macro(FILE *f);

/* Meshes, textures, objects, lights and the scene, as const data. */
void emit_data(FILE *f, const compiled *c);

#endif
