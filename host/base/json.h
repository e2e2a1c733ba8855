/* A small strict JSON parser (RFC 8259). Stricter than the grammar: no byte order mark, well-formed UTF-8 only, numbers
 * must fit a double, nesting is at most JSON_MAX_DEPTH deep, and there are at most JSON_MAX_VALUES values: two bytes of
 * text make a value of a hundred. Looser: strings may hold raw tabs and line breaks, and of members with one key the
 * last counts. \u0000 and half a surrogate pair become U+FFFD. */
#ifndef GNOMON_HOST_JSON_H
#define GNOMON_HOST_JSON_H

#include <stddef.h>

#include "arena.h"

enum { JSON_MAX_DEPTH = 64, JSON_MAX_VALUES = 1 << 20 };

typedef enum { JSON_NULL, JSON_BOOL, JSON_NUMBER, JSON_STRING, JSON_ARRAY, JSON_OBJECT } json_type;

typedef struct json_value json_value;
struct json_value {
    json_type type;
    double number; /* numbers; booleans as 0 or 1 */
    const char *string;
    size_t n_children;
    json_value **children; /* of arrays and objects, in file order */
    const char *key;       /* within the parent, if that is an object */
    const json_value *parent;
    size_t child_idx; /* within the parent */
    size_t offset;    /* of the value (of its key, if it has one) in the text */
};

typedef struct {
    json_value *root;
    size_t n_duplicates;         /* members that a later one of the same key replaced */
    size_t n_replaced;           /* characters that became U+FFFD */
    const json_value *duplicate; /* a member that replaced one; NULL: there is none */
    arena memory;
} json_doc;

/* Returns 0; on failure -1, with "line:column: what" in error, and *doc empty. */
int json_parse(json_doc *doc, const char *text, size_t n_bytes, char *error, size_t error_bytes);
void json_free(json_doc *doc);

/* NULL if absent, or if the value is NULL or of another type. */
const json_value *json_get(const json_value *object, const char *key);
const json_value *json_at(const json_value *array, size_t idx);

/* JSON pointer such as /nodes/3/mesh ("/" for the root); cut to size, always terminated. */
void json_path(const json_value *value, char *out, size_t out_bytes);

const char *json_type_name(json_type type);

#endif
