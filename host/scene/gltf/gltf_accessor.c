/* glTF accessors, read into doubles: every integer type up to 32 bits and float are exact in them. */
#include "gltf.h"

#include <math.h>
#include <string.h>

/* Without a buffer view an accessor is all zeros and costs no bytes in the file: a bound on what a short file can
 * request. */
enum { MAX_ZEROS = 1 << 20 };

static size_t component_bytes(size_t type)
{
    switch (type) {
    case GLTF_BYTE:
    case GLTF_UBYTE:
        return 1;
    case GLTF_SHORT:
    case GLTF_USHORT:
        return 2;
    case GLTF_UINT:
    case GLTF_FLOAT:
        return 4;
    default:
        return 0;
    }
}

static uint32_t little_endian(const uint8_t *bytes, size_t n)
{
    uint32_t value = 0;
    while (n-- > 0) value = value << 8 | bytes[n];
    return value;
}

static double read_component(const uint8_t *bytes, size_t type, bool normalized)
{
    uint32_t bits = little_endian(bytes, component_bytes(type));
    float real;
    switch (type) {
    case GLTF_BYTE: {
        double value = bits < 0x80 ? (double)bits : (double)bits - 0x100;
        return normalized ? fmax(value / 127, -1) : value;
    }
    case GLTF_SHORT: {
        double value = bits < 0x8000 ? (double)bits : (double)bits - 0x10000;
        return normalized ? fmax(value / 32767, -1) : value;
    }
    case GLTF_UBYTE:
        return normalized ? bits / 255.0 : bits;
    case GLTF_USHORT:
        return normalized ? bits / 65535.0 : bits;
    case GLTF_UINT:
        return bits;
    default:
        memcpy(&real, &bits, sizeof real);
        return (double)real;
    }
}

/* A run of elements in a buffer view. */
typedef struct {
    const uint8_t *bytes;
    size_t stride;
} element_run;

static bool locate(gltf *g, const json_value *owner, size_t element_bytes, size_t count, element_run *out)
{
    size_t view = GLTF_NONE, offset = 0;
    gltf_bytes bytes;
    if (!gltf_get_ref(g, owner, "bufferView", g->buffer_views, &view) ||
        !gltf_get_size(g, owner, "byteOffset", &offset))
        return false;
    if (view == GLTF_NONE) return gltf_fail(g, owner, "bufferView is missing");
    if (!gltf_view_bytes(g, g->buffer_views->children[view], &bytes, &out->stride)) return false;
    if (out->stride == 0) out->stride = element_bytes;
    if (out->stride < element_bytes) {
        return gltf_fail(g, owner, "an element of %zu bytes is longer than byteStride %zu", element_bytes, out->stride);
    }
    if (offset > bytes.n_bytes || bytes.n_bytes - offset < element_bytes ||
        (bytes.n_bytes - offset - element_bytes) / out->stride < count - 1) {
        return gltf_fail(g, owner, "%zu elements reach beyond buffer view %zu of %zu bytes", count, view,
                         bytes.n_bytes);
    }
    out->bytes = bytes.bytes + offset;
    return true;
}

/* What is no number counts. */
static void read_element(gltf_array *a, const uint8_t *bytes, size_t element, double *out)
{
    for (size_t i = 0; i < a->n_components; i++) {
        out[i] = read_component(bytes + i * component_bytes(a->component_type), a->component_type, a->normalized);
        if (!isfinite(out[i]) && a->n_not_finite++ == 0) a->not_finite = element;
    }
}

static bool read_dense(gltf *g, const json_value *accessor, gltf_array *out)
{
    element_run run;
    if (!locate(g, accessor, out->n_components * component_bytes(out->component_type), out->count, &run)) return false;
    if (!gltf_spend(g, accessor, BUDGET_NUMBERS, out->count * out->n_components)) return false;
    out->values = loader_alloc(g->l, out->count * out->n_components, sizeof *out->values);
    if (!out->values) return false;
    for (size_t i = 0; i < out->count; i++) {
        read_element(out, run.bytes + i * run.stride, i, out->values + i * out->n_components);
    }
    return true;
}

static bool read_zeros(gltf *g, const json_value *accessor, gltf_array *out)
{
    if (out->count > MAX_ZEROS)
        return gltf_fail(g, accessor, "%zu elements without a bufferView (limit %d)", out->count, MAX_ZEROS);
    if (!gltf_spend(g, accessor, BUDGET_NUMBERS, out->count * out->n_components)) return false;
    out->values = loader_alloc(g->l, out->count * out->n_components, sizeof *out->values);
    return out->values != NULL;
}

static bool sparse_parts(gltf *g, const json_value *sparse, const json_value **indices, const json_value **values,
                         size_t *count, size_t *index_type)
{
    if (!gltf_get_size(g, sparse, "count", count) || !gltf_get(g, sparse, "indices", JSON_OBJECT, indices) ||
        !gltf_get(g, sparse, "values", JSON_OBJECT, values) || !gltf_get_size(g, *indices, "componentType", index_type))
        return false;
    if (!*indices || !*values) return gltf_fail(g, sparse, "count, indices and values are needed");
    if (*index_type != GLTF_UBYTE && *index_type != GLTF_USHORT && *index_type != GLTF_UINT) {
        return gltf_fail(g, *indices, "componentType must be 5121, 5123 or 5125");
    }
    return true;
}

static bool read_sparse(gltf *g, const json_value *sparse, gltf_array *out)
{
    const json_value *indices = NULL, *values = NULL;
    size_t count = 0, index_type = 0;
    element_run index_run, value_run;
    if (!sparse_parts(g, sparse, &indices, &values, &count, &index_type)) return false;
    if (count == 0) return true;
    if (count > out->count) return gltf_fail(g, sparse, "count %zu exceeds the accessor's %zu", count, out->count);
    if (!locate(g, indices, component_bytes(index_type), count, &index_run)) return false;
    if (!locate(g, values, out->n_components * component_bytes(out->component_type), count, &value_run)) return false;
    for (size_t i = 0, next = 0; i < count; i++) {
        size_t target = little_endian(index_run.bytes + i * index_run.stride, component_bytes(index_type));
        if (target < next) return gltf_fail(g, indices, "index %zu does not increase", i);
        if (target >= out->count)
            return gltf_fail(g, indices, "index %zu is %zu, the accessor has %zu elements", i, target, out->count);
        double *to = out->values + target * out->n_components;
        read_element(out, value_run.bytes + i * value_run.stride, i, to);
        next = target + 1;
    }
    return true;
}

static bool read_type(gltf *g, const json_value *accessor, gltf_array *out)
{
    static const char *const names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const char *type = "";
    if (!gltf_get_size(g, accessor, "componentType", &out->component_type) ||
        !gltf_get_string(g, accessor, "type", &type) || !gltf_get_bool(g, accessor, "normalized", &out->normalized))
        return false;
    if (component_bytes(out->component_type) == 0)
        return gltf_fail(g, accessor, "componentType %zu is unknown", out->component_type);
    if (out->normalized && component_bytes(out->component_type) == 4) {
        return gltf_fail(g, accessor, "componentType %zu cannot be normalized", out->component_type);
    }
    for (size_t i = 0; i < 4; i++) {
        if (strcmp(type, names[i]) == 0) out->n_components = i + 1;
    }
    if (strcmp(type, "MAT4") == 0 && out->component_type == GLTF_FLOAT) out->n_components = 16;
    return out->n_components > 0 ||
           gltf_fail(g, accessor, "type '%s' is not SCALAR, VEC2, VEC3, VEC4, or MAT4 of floats", type);
}

bool gltf_read_as_it_is(gltf *g, size_t accessor_idx, gltf_array *out)
{
    const json_value *accessor = g->accessors->children[accessor_idx], *sparse = NULL;
    *out = (gltf_array){0};
    if (!read_type(g, accessor, out) || !gltf_get_size(g, accessor, "count", &out->count) ||
        !gltf_get(g, accessor, "sparse", JSON_OBJECT, &sparse))
        return false;
    if (out->count == 0)
        return loader_remark(g->l, "accessor %zu has a count of 0: as if it were not there", accessor_idx);
    bool dense = json_get(accessor, "bufferView") != NULL;
    if (!(dense ? read_dense(g, accessor, out) : read_zeros(g, accessor, out))) return false;
    return !sparse || read_sparse(g, sparse, out);
}

bool gltf_read_loosely(gltf *g, size_t accessor_idx, gltf_array *out)
{
    if (!gltf_read_as_it_is(g, accessor_idx, out)) return false;
    const size_t n = out->n_not_finite ? out->count * out->n_components : 0;
    for (size_t i = 0; i < n; i++) out->values[i] = isfinite(out->values[i]) ? out->values[i] : 0;
    return true;
}

bool gltf_read_accessor(gltf *g, size_t accessor_idx, gltf_array *out)
{
    if (!gltf_read_loosely(g, accessor_idx, out)) return false;
    return out->n_not_finite == 0 ||
           gltf_fail(g, g->accessors->children[accessor_idx], "element %zu is not finite", out->not_finite);
}
