/* Structs and arrays of the library as C. */
#include "compile_emit.h"

#include <inttypes.h>
#include <string.h>

enum { LINE_WIDTH = 100 };

/* ---- Arrays ------------------------------------------------------------------------------------------------------ */

static const char *const type_names[] = {"int32_t", "int16_t", "uint16_t", "uint8_t", "gn_position", "gn_normal"};

static long number_at(emit_number type, const void *array, size_t i)
{
    switch (type) {
    case EMIT_I32:
    case EMIT_POSITION:
        return ((const int32_t *)array)[i];
    case EMIT_I16:
    case EMIT_NORMAL:
        return ((const int16_t *)array)[i];
    case EMIT_U16:
        return ((const uint16_t *)array)[i];
    default:
        return ((const uint8_t *)array)[i];
    }
}

void emit_array(FILE *f, emit_number type, const char *kind, size_t idx, const char *name, const void *array, size_t n,
                size_t per_line)
{
    if (!array || !n) return;
    fprintf(f, "static const %s %s_%zu_%s[%zu] = {", type_names[type], kind, idx, name, n);
    for (size_t i = 0; i < n; i++) fprintf(f, "%s%ld,", i % per_line == 0 ? "\n    " : " ", number_at(type, array, i));
    fprintf(f, "\n};\n");
}

/* ---- Structs ----------------------------------------------------------------------------------------------------- */

void emit_macro(FILE *f)
{
    fprintf(f, "\n/* C++11 has no designators; the order is that of the declarations. */\n"
               "#ifdef __cplusplus\n#define F(name)\n#else\n#define F(name) .name =\n#endif\n");
}

int emit_affine(FILE *f, const gn_affine *a)
{
    int n = fprintf(f, "{F(m_q30) {");
    for (int r = 0; r < 3; r++)
        n += fprintf(f, "%s{%" PRId32 ", %" PRId32 ", %" PRId32 "}", r ? ", " : "", a->m_q30[r][0], a->m_q30[r][1],
                     a->m_q30[r][2]);
    return n + fprintf(f, "}, F(t_q16) {%" PRId32 ", %" PRId32 ", %" PRId32 "}, F(exp) %" PRId32 "}", a->t_q16[0],
                       a->t_q16[1], a->t_q16[2], a->exp);
}

/* An element of a field; returns how many characters. */
static int write_value(FILE *f, const emit_field *field, const void *at)
{
    switch (field->kind) {
    case FIELD_U8:
        return fprintf(f, "%u", *(const uint8_t *)at);
    case FIELD_U16:
        return fprintf(f, "%u", *(const uint16_t *)at);
    case FIELD_U32:
        return fprintf(f, "%" PRIu32 "U", *(const uint32_t *)at);
    case FIELD_ENUM:
        return fprintf(f, "(%s)%d", field->type, (int)*(const unsigned *)at);
    case FIELD_AFFINE:
        return emit_affine(f, at);
    default:
        return fprintf(f, "%" PRId32, *(const int32_t *)at);
    }
}

static size_t size_of(emit_kind kind)
{
    return kind == FIELD_U8 ? 1 : kind == FIELD_U16 ? 2 : 4;
}

void emit_struct(FILE *f, const compiled *c, const emit_field *fields, size_t n_fields, const void *at, size_t idx,
                 emit_pointer pointer)
{
    int column = fprintf(f, "    {");
    for (size_t i = 0; i < n_fields; i++) {
        const emit_field *field = &fields[i];
        const char *from = (const char *)at + field->offset;
        if (column > LINE_WIDTH) column = fprintf(f, "\n     ");
        column += fprintf(f, "F(%s) %s", field->name, field->n > 1 ? "{" : "");
        if (field->kind == FIELD_POINTER) pointer(f, c, field, *(const void *const *)from, idx);
        for (size_t k = 0; field->kind != FIELD_POINTER && k < field->n; k++) {
            column += fprintf(f, "%s", k ? ", " : "");
            column += write_value(f, field, from + k * size_of(field->kind));
        }
        column += fprintf(f, "%s%s", field->n > 1 ? "}" : "", i + 1 < n_fields ? ", " : "");
    }
    fprintf(f, "}");
}
