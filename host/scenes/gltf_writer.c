/* Writes glTF 2.0 as one readable JSON file. Numbers in the text have six digits, so that the last bits of a sine do not show. */
#include "gltf_writer.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

enum { ARRAY_BUFFER = 34962, ELEMENT_ARRAY_BUFFER = 34963, USHORT_COMPONENT = 5123, FLOAT_COMPONENT = 5126 };

void gltf_begin(gltf_document *d)
{
    memset(d, 0, sizeof *d);
}

static void add_text_v(gltf_document *d, gltf_list *list, const char *format, va_list arguments)
{
    size_t room = sizeof list->chars - list->n_chars;
    int n = vsnprintf(list->chars + list->n_chars, room, format, arguments);
    if (n < 0 || (size_t)n >= room) d->overflow = true;
    else list->n_chars += (size_t)n;
}

GLTF_WRITER_PRINTF(3, 4)
static void add_text(gltf_document *d, gltf_list *list, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_text_v(d, list, format, arguments);
    va_end(arguments);
}

/* Starts the next element of a list and returns its index. */
static size_t next_item(gltf_document *d, gltf_list *list)
{
    add_text(d, list, "%s\n    ", list->n_items ? "," : "");
    return list->n_items++;
}

static void add_knobs(gltf_document *d, gltf_list *list, const char *knobs)
{
    if (knobs) add_text(d, list, ", \"extras\": {\"gnomon\": {%s}}", knobs);
}

size_t gltf_add_material(gltf_document *d, const char *name, const double *rgb, const char *knobs)
{
    size_t idx = next_item(d, &d->materials);
    add_text(d, &d->materials,
             "{\"name\": \"%s\", \"pbrMetallicRoughness\": {\"baseColorFactor\": [%g, %g, %g, 1], "
             "\"metallicFactor\": 0}",
             name, rgb[0], rgb[1], rgb[2]);
    add_knobs(d, &d->materials, knobs);
    add_text(d, &d->materials, "}");
    return idx;
}

static void put_bytes(gltf_document *d, uint32_t value, size_t n)
{
    if (d->n_bytes + n > GLTF_BUFFER_BYTES) {
        d->overflow = true;
        return;
    }
    for (; n > 0; n--, value >>= 8) d->bytes[d->n_bytes++] = (uint8_t)(value & 0xFF);
}

static void put_float(gltf_document *d, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_bytes(d, bits, 4);
}

/* A view of all bytes from start to here, padded to a multiple of 4. target 0: none. */
static size_t add_view(gltf_document *d, size_t start, int target)
{
    size_t n = d->n_bytes - start, idx = next_item(d, &d->views);
    while (d->n_bytes % 4 != 0 && !d->overflow) put_bytes(d, 0, 1);
    add_text(d, &d->views, "{\"buffer\": 0, \"byteOffset\": %zu, \"byteLength\": %zu", start, n);
    if (target != 0) add_text(d, &d->views, ", \"target\": %d", target);
    add_text(d, &d->views, "}");
    return idx;
}

/* low, high: n_components values each, or NULL. */
static size_t add_accessor(gltf_document *d, size_t view, int component, size_t count, const char *type, const float *low,
                           const float *high)
{
    gltf_list *list = &d->accessors;
    size_t idx = next_item(d, list), n = type[0] == 'S' ? 1 : 3;
    add_text(d, list, "{\"bufferView\": %zu, \"componentType\": %d, \"count\": %zu, \"type\": \"%s\"", view, component, count,
             type);
    for (int side = 0; low && side < 2; side++) {
        add_text(d, list, ", \"%s\": [", side ? "max" : "min");
        for (size_t i = 0; i < n; i++) add_text(d, list, "%s%.9g", i ? ", " : "", (double)(side ? high : low)[i]);
        add_text(d, list, "]");
    }
    add_text(d, list, "}");
    return idx;
}

/* An attribute by its offset in mesh_vertex. */
static size_t add_attribute(gltf_document *d, const mesh_builder *m, size_t offset, bool with_bounds)
{
    float low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    size_t start = d->n_bytes;
    for (size_t i = 0; i < m->n_vertices; i++) {
        float v[3];
        memcpy(v, (const char *)&m->vertex[i] + offset, sizeof v);
        for (int k = 0; k < 3; k++) {
            if (i == 0 || v[k] < low[k]) low[k] = v[k];
            if (i == 0 || v[k] > high[k]) high[k] = v[k];
            put_float(d, v[k]);
        }
    }
    size_t view = add_view(d, start, ARRAY_BUFFER);
    return add_accessor(d, view, FLOAT_COMPONENT, m->n_vertices, "VEC3", with_bounds ? low : NULL, high);
}

static size_t add_indices(gltf_document *d, const mesh_builder *m)
{
    size_t start = d->n_bytes;
    for (size_t i = 0; i < m->n_corners; i++) put_bytes(d, m->idx[i], 2);
    size_t view = add_view(d, start, ELEMENT_ARRAY_BUFFER);
    return add_accessor(d, view, USHORT_COMPONENT, m->n_corners, "SCALAR", NULL, NULL);
}

static void add_surface(gltf_document *d, const gltf_surface *s)
{
    gltf_list *list = &d->meshes;
    const mesh_builder *m = s->mesh;
    if (m->overflow) d->overflow = true;
    add_text(d, list, "{\"attributes\": {\"POSITION\": %zu", add_attribute(d, m, offsetof(mesh_vertex, pos), true));
    if (m->attributes & MESH_NORMALS)
        add_text(d, list, ", \"NORMAL\": %zu", add_attribute(d, m, offsetof(mesh_vertex, nrm), false));
    if (m->attributes & MESH_COLOURS)
        add_text(d, list, ", \"COLOR_0\": %zu", add_attribute(d, m, offsetof(mesh_vertex, rgb), false));
    add_text(d, list, "}, \"indices\": %zu, \"material\": %zu}", add_indices(d, m), s->material_idx);
}

size_t gltf_add_mesh(gltf_document *d, const char *name, const gltf_surface *surfaces, size_t n)
{
    size_t idx = next_item(d, &d->meshes);
    add_text(d, &d->meshes, "{\"name\": \"%s\", \"primitives\": [", name);
    for (size_t i = 0; i < n; i++) {
        if (n > 1) add_text(d, &d->meshes, "%s\n      ", i ? "," : "");
        add_surface(d, &surfaces[i]);
    }
    add_text(d, &d->meshes, "]}");
    return idx;
}

void gltf_add_camera(gltf_document *d, const gltf_camera *c)
{
    static const mesh_point x_axis = {1, 0, 0}, y_axis = {0, 1, 0};
    const double yaw = c->yaw_deg * MESH_PI / 180, pitch = c->pitch_deg * MESH_PI / 180, flat = c->distance * cos(pitch);
    const mesh_point p = {c->target.x + flat * sin(yaw), c->target.y - c->distance * sin(pitch), c->target.z + flat * cos(yaw)};
    gltf_rotation q = gltf_multiply(gltf_turn(y_axis, c->yaw_deg), gltf_turn(x_axis, c->pitch_deg));
    size_t idx = next_item(d, &d->cameras);
    add_text(d, &d->cameras,
             "{\"type\": \"perspective\", \"perspective\": {\"yfov\": %.6g, \"aspectRatio\": 1.33333, \"znear\": %g, "
             "\"zfar\": %g}}",
             c->fov_deg * MESH_PI / 180, c->near_distance, c->far_distance);
    gltf_add_node(d, "camera", "\"camera\": %zu, \"translation\": [%.6g, %.6g, %.6g], \"rotation\": [%.6g, %.6g, %.6g, %.6g]", idx,
                  p.x, p.y, p.z, q.x, q.y, q.z, q.w);
}

size_t gltf_add_directional_light(gltf_document *d, const char *name, const double *rgb, double lux, const char *knobs)
{
    size_t idx = next_item(d, &d->lights);
    add_text(d, &d->lights, "{\"name\": \"%s\", \"type\": \"directional\", \"color\": [%g, %g, %g], \"intensity\": %g", name,
             rgb[0], rgb[1], rgb[2], lux);
    add_knobs(d, &d->lights, knobs);
    add_text(d, &d->lights, "}");
    return idx;
}

size_t gltf_add_node(gltf_document *d, const char *name, const char *format, ...)
{
    va_list arguments;
    size_t idx = next_item(d, &d->nodes);
    if (idx >= GLTF_MAX_NODES) d->overflow = true;
    else d->is_root[idx] = true;
    add_text(d, &d->nodes, "{\"name\": \"%s\", ", name);
    va_start(arguments, format);
    add_text_v(d, &d->nodes, format, arguments);
    va_end(arguments);
    add_text(d, &d->nodes, "}");
    return idx;
}

void gltf_mark_child(gltf_document *d, size_t node_idx)
{
    if (node_idx < GLTF_MAX_NODES) d->is_root[node_idx] = false;
}

void gltf_add_rotation_keys(gltf_document *d, const char *name, size_t node_idx, const gltf_rotation *keys, size_t n)
{
    size_t start = d->n_bytes;
    float first = 0, last = (float)(n - 1);
    for (size_t i = 0; i < n; i++) put_float(d, (float)i);
    size_t times = add_accessor(d, add_view(d, start, 0), FLOAT_COMPONENT, n, "SCALAR", &first, &last);
    start = d->n_bytes;
    for (size_t i = 0; i < n; i++) {
        put_float(d, (float)mesh_on_grid(keys[i].x));
        put_float(d, (float)mesh_on_grid(keys[i].y));
        put_float(d, (float)mesh_on_grid(keys[i].z));
        put_float(d, (float)mesh_on_grid(keys[i].w));
    }
    size_t values = add_accessor(d, add_view(d, start, 0), FLOAT_COMPONENT, n, "VEC4", NULL, NULL);
    next_item(d, &d->animations);
    add_text(d, &d->animations,
             "{\"name\": \"%s\",\n      \"channels\": [{\"sampler\": 0, \"target\": {\"node\": %zu, \"path\": "
             "\"rotation\"}}],\n      \"samplers\": [{\"input\": %zu, \"output\": %zu, \"interpolation\": \"LINEAR\"}]}",
             name, node_idx, times, values);
}

static void write_list(FILE *file, const char *key, const gltf_list *list)
{
    if (list->n_items > 0) fprintf(file, "  \"%s\": [%s\n  ],\n", key, list->chars);
}

static void write_base64(FILE *file, const uint8_t *bytes, size_t n)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        uint32_t b = (uint32_t)bytes[i] << 16, n_here = n - i < 3 ? (uint32_t)(n - i) : 3;
        if (n_here > 1) b |= (uint32_t)bytes[i + 1] << 8;
        if (n_here > 2) b |= bytes[i + 2];
        for (uint32_t k = 0; k < 4; k++) fputc(k <= n_here ? digits[b >> (18 - 6 * k) & 63] : '=', file);
    }
}

static void write_scene(FILE *file, const gltf_document *d, const char *settings)
{
    const char *separator = "";
    fprintf(file, "  \"scene\": 0,\n  \"scenes\": [{\"nodes\": [");
    for (size_t i = 0; i < d->nodes.n_items; i++) {
        if (!d->is_root[i]) continue;
        fprintf(file, "%s%zu", separator, i);
        separator = ", ";
    }
    fprintf(file, "],\n    \"extras\": {\"gnomon\": {%s}}}],\n", settings);
}

int gltf_write(const gltf_document *d, const gltf_scene_text *scene, FILE *file)
{
    if (d->overflow) return -1;
    fprintf(file,
            "{\n  \"asset\": {\"version\": \"2.0\", \"generator\": \"host/scenes/make_scenes.c\",\n    \"extras\": {\"comment\": "
            "\"%s\"}},\n  \"extensionsUsed\": [\"KHR_lights_punctual\"],\n",
            scene->comment);
    write_scene(file, d, scene->settings);
    write_list(file, "nodes", &d->nodes);
    write_list(file, "cameras", &d->cameras);
    fprintf(file, "  \"extensions\": {\"KHR_lights_punctual\": {\"lights\": [%s\n  ]}},\n", d->lights.chars);
    write_list(file, "animations", &d->animations);
    write_list(file, "materials", &d->materials);
    write_list(file, "meshes", &d->meshes);
    write_list(file, "accessors", &d->accessors);
    write_list(file, "bufferViews", &d->views);
    fprintf(file, "  \"buffers\": [{\"byteLength\": %zu, \"uri\": \"data:application/octet-stream;base64,", d->n_bytes);
    write_base64(file, d->bytes, d->n_bytes);
    fprintf(file, "\"}]\n}\n");
    return ferror(file) ? -1 : 0;
}

gltf_rotation gltf_turn(mesh_point unit_axis, double degrees)
{
    double half = degrees * MESH_PI / 360, s = sin(half);
    return (gltf_rotation){unit_axis.x * s, unit_axis.y * s, unit_axis.z * s, cos(half)};
}

gltf_rotation gltf_multiply(gltf_rotation a, gltf_rotation b)
{
    return (gltf_rotation){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                           a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
