/* Typed members of glTF's JSON, with errors that name the JSON path. */
#include "gltf.h"

#include <stdarg.h>
#include <stdio.h>

bool gltf_fail(gltf *g, const json_value *where, const char *format, ...)
{
    char path[256], what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    json_path(where, path, sizeof path);
    return loader_fail(g->l, "%s: %s: %s", g->l->path, path, what);
}

bool gltf_spend(gltf *g, const json_value *where, budget_kind kind, size_t n)
{
    const char *over = budget_spend(g->l, kind, n);
    return !over || gltf_fail(g, where, "%s", over);
}

bool gltf_get(gltf *g, const json_value *parent, const char *key, json_type type, const json_value **out)
{
    const json_value *value = json_get(parent, key);
    if (!value) return true;
    if (value->type != type) return gltf_fail(g, value, "%s is expected", json_type_name(type));
    *out = value;
    return true;
}

bool gltf_get_number(gltf *g, const json_value *parent, const char *key, double *out)
{
    const json_value *value = NULL;
    if (!gltf_get(g, parent, key, JSON_NUMBER, &value)) return false;
    if (value) *out = value->number;
    return true;
}

bool gltf_get_numbers(gltf *g, const json_value *parent, const char *key, double *out, size_t n)
{
    const json_value *array = NULL;
    if (!gltf_get(g, parent, key, JSON_ARRAY, &array)) return false;
    if (!array) return true;
    if (array->n_children != n) return gltf_fail(g, array, "%zu numbers are expected", n);
    for (size_t i = 0; i < n; i++) {
        const json_value *value = array->children[i];
        if (value->type != JSON_NUMBER) return gltf_fail(g, value, "a number is expected");
        out[i] = value->number;
    }
    return true;
}

bool gltf_get_bool(gltf *g, const json_value *parent, const char *key, bool *out)
{
    const json_value *value = NULL;
    if (!gltf_get(g, parent, key, JSON_BOOL, &value)) return false;
    if (value) *out = value->number > 0;
    return true;
}

bool gltf_get_string(gltf *g, const json_value *parent, const char *key, const char **out)
{
    const json_value *value = NULL;
    if (!gltf_get(g, parent, key, JSON_STRING, &value)) return false;
    if (value) *out = value->string;
    return true;
}

/* Up to 2^31 - 1: sums and products of a few of them cannot overflow 64 bits, and no real file needs more. */
bool gltf_to_size(gltf *g, const json_value *value, size_t *out)
{
    double number = value->type == JSON_NUMBER ? value->number : -1;
    if (!(number >= 0 && number <= INT32_MAX))
        return gltf_fail(g, value, "an integer from 0 to %d is expected", INT32_MAX);
    *out = (size_t)number;
    if ((double)*out < number) return gltf_fail(g, value, "an integer is expected");
    return true;
}

bool gltf_get_size(gltf *g, const json_value *parent, const char *key, size_t *out)
{
    const json_value *value = json_get(parent, key);
    return !value || gltf_to_size(g, value, out);
}

bool gltf_get_ref(gltf *g, const json_value *parent, const char *key, const json_value *array, size_t *out)
{
    const json_value *value = json_get(parent, key);
    if (!value) return true;
    if (!gltf_to_size(g, value, out)) return false;
    size_t n = array ? array->n_children : 0;
    return *out < n || gltf_fail(g, value, "there are only %zu of these", n);
}

bool gltf_get_extension(gltf *g, const json_value *parent, const char *name, const json_value **out)
{
    const json_value *extensions = NULL;
    *out = NULL;
    return gltf_get(g, parent, "extensions", JSON_OBJECT, &extensions) &&
           gltf_get(g, extensions, name, JSON_OBJECT, out);
}

const char *gltf_name(gltf *g, const json_value *parent, const char *kind)
{
    const json_value *name = json_get(parent, "name");
    if (name && name->type == JSON_STRING && name->string[0]) return name->string;
    return loader_format(g->l, "%s %zu", kind, parent->child_idx);
}
