/* Writes glTF 2.0 as one readable JSON file. Numbers in the text have six digits, so that the last bits of a sine do
 * not show. */
#include "gltf_writer.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "../../scene/image/png.h"

enum {
    ARRAY_BUFFER = 34962,
    ELEMENT_ARRAY_BUFFER = 34963,
    UBYTE_COMPONENT = 5121,
    USHORT_COMPONENT = 5123,
    FLOAT_COMPONENT = 5126
};

void gltf_begin(gltf_document *d)
{
    memset(d, 0, sizeof *d);
}

static void add_text_v(gltf_document *d, gltf_list *list, const char *format, va_list arguments)
{
    size_t n_free = sizeof list->chars - list->n_chars;
    int n = vsnprintf(list->chars + list->n_chars, n_free, format, arguments);
    if (n < 0 || (size_t)n >= n_free) d->overflow = true;
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

/* Four digits for up to three bytes; n_left: bytes from here to the end. */
static void base64_digits(const uint8_t *bytes, size_t n_left, char *out)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    size_t n_here = n_left < 3 ? n_left : 3;
    uint32_t b = (uint32_t)bytes[0] << 16;
    if (n_here > 1) b |= (uint32_t)bytes[1] << 8;
    if (n_here > 2) b |= bytes[2];
    for (size_t k = 0; k < 4; k++) out[k] = k <= n_here ? digits[b >> (18 - 6 * k) & 63] : '=';
    out[4] = 0;
}

size_t gltf_add_surface_material(gltf_document *d, const gltf_material_text *m)
{
    static const char *const mode[] = {[GLTF_MASK] = "MASK", [GLTF_BLEND] = "BLEND"};
    gltf_list *list = &d->materials;
    size_t idx = next_item(d, list);
    add_text(d, list, "{\"name\": \"%s\", \"pbrMetallicRoughness\": {\"baseColorFactor\": [%g, %g, %g, %g], ", m->name,
             m->rgb[0], m->rgb[1], m->rgb[2], m->alpha_mode == GLTF_BLEND ? m->alpha : 1);
    if (m->has_texture) add_text(d, list, "\"baseColorTexture\": {\"index\": %zu}, ", m->texture_idx);
    add_text(d, list, "\"metallicFactor\": 0}");
    if (m->alpha_mode != GLTF_OPAQUE) add_text(d, list, ", \"alphaMode\": \"%s\"", mode[m->alpha_mode]);
    if (m->double_sided) add_text(d, list, ", \"doubleSided\": true");
    if (m->emits)
        add_text(d, list, ", \"emissiveFactor\": [1, 1, 1], \"emissiveTexture\": {\"index\": %zu}",
                 m->emissive_texture_idx);
    add_knobs(d, list, m->knobs);
    add_text(d, list, "}");
    return idx;
}

size_t gltf_add_material(gltf_document *d, const char *name, const double *rgb, const char *knobs)
{
    return gltf_add_surface_material(
        d, &(gltf_material_text){.name = name, .rgb = {rgb[0], rgb[1], rgb[2]}, .knobs = knobs});
}

static void add_base64(gltf_document *d, gltf_list *list, const uint8_t *bytes, size_t n)
{
    for (size_t i = 0; i < n; i += 3) {
        char digits[5];
        base64_digits(bytes + i, n - i, digits);
        add_text(d, list, "%s", digits);
    }
}

size_t gltf_add_texture(gltf_document *d, const gltf_image *image)
{
    enum { NEAREST = 9728, LINEAR = 9729, CLAMP_TO_EDGE = 33071, REPEAT = 10497 };
    int filter = image->nearest ? NEAREST : LINEAR, wrap = image->clamp ? CLAMP_TO_EDGE : REPEAT;
    size_t n_bytes = 0, image_idx = next_item(d, &d->images), sampler_idx = next_item(d, &d->samplers);
    uint8_t *png = png_pack_rgba8(image->side, image->side, image->rgba, &n_bytes);
    if (!png) d->overflow = true;
    add_text(d, &d->images, "{\"name\": \"%s\", \"mimeType\": \"image/png\", \"uri\": \"data:image/png;base64,",
             image->name);
    add_base64(d, &d->images, png, n_bytes);
    add_text(d, &d->images, "\"}");
    free(png);
    add_text(d, &d->samplers, "{\"magFilter\": %d, \"minFilter\": %d, \"wrapS\": %d, \"wrapT\": %d}", filter, filter,
             wrap, wrap);
    size_t idx = next_item(d, &d->textures);
    add_text(d, &d->textures, "{\"name\": \"%s\", \"sampler\": %zu, \"source\": %zu}", image->name, sampler_idx,
             image_idx);
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
static size_t add_accessor(gltf_document *d, size_t view, int component, size_t count, const char *type,
                           const float *low, const float *high)
{
    gltf_list *list = &d->accessors;
    size_t idx = next_item(d, list), n = type[0] == 'S' ? 1 : 3;
    add_text(d, list, "{\"bufferView\": %zu, \"componentType\": %d, \"count\": %zu, \"type\": \"%s\"", view, component,
             count, type);
    if (component == UBYTE_COMPONENT) add_text(d, list, ", \"normalized\": true");
    for (int side = 0; low && side < 2; side++) {
        add_text(d, list, ", \"%s\": [", side ? "max" : "min");
        for (size_t i = 0; i < n; i++) add_text(d, list, "%s%.9g", i ? ", " : "", (double)(side ? high : low)[i]);
        add_text(d, list, "]");
    }
    add_text(d, list, "}");
    return idx;
}

/* An attribute of floats by its offset in mesh_vertex; width: 2 or 3 of them. */
static size_t add_attribute(gltf_document *d, const mesh_builder *m, size_t offset, size_t width, bool with_bounds)
{
    float low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    size_t start = d->n_bytes;
    for (size_t i = 0; i < m->n_vertices; i++) {
        float v[3];
        memcpy(v, (const char *)&m->vertex[i] + offset, width * sizeof *v);
        for (size_t k = 0; k < width; k++) {
            if (i == 0 || v[k] < low[k]) low[k] = v[k];
            if (i == 0 || v[k] > high[k]) high[k] = v[k];
            put_float(d, v[k]);
        }
    }
    size_t view = add_view(d, start, ARRAY_BUFFER);
    return add_accessor(d, view, FLOAT_COMPONENT, m->n_vertices, width == 2 ? "VEC2" : "VEC3", with_bounds ? low : NULL,
                        high);
}

/* Four per vertex, 255 as 1. */
static size_t add_bytes(gltf_document *d, const uint8_t (*v)[4], size_t n)
{
    size_t start = d->n_bytes;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < 4; k++) put_bytes(d, v[i][k], 1);
    }
    return add_accessor(d, add_view(d, start, ARRAY_BUFFER), UBYTE_COMPONENT, n, "VEC4", NULL, NULL);
}

/* As they are: indices. */
static size_t add_shorts(gltf_document *d, const uint8_t (*v)[4], size_t n)
{
    size_t start = d->n_bytes;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < 4; k++) put_bytes(d, v[i][k], 2);
    }
    return add_accessor(d, add_view(d, start, ARRAY_BUFFER), USHORT_COMPONENT, n, "VEC4", NULL, NULL);
}

static size_t add_baked(gltf_document *d, const mesh_builder *m)
{
    size_t start = d->n_bytes;
    for (size_t i = 0; i < m->n_vertices; i++) {
        for (size_t k = 0; k < 3; k++) put_float(d, m->baked[i][k]);
    }
    return add_accessor(d, add_view(d, start, ARRAY_BUFFER), FLOAT_COMPONENT, m->n_vertices, "VEC3", NULL, NULL);
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
    add_text(d, list, "{\"attributes\": {\"POSITION\": %zu", add_attribute(d, m, offsetof(mesh_vertex, pos), 3, true));
    if (m->attributes & MESH_NORMALS)
        add_text(d, list, ", \"NORMAL\": %zu", add_attribute(d, m, offsetof(mesh_vertex, nrm), 3, false));
    if (m->attributes & MESH_COLOURS)
        add_text(d, list, ", \"COLOR_0\": %zu", add_attribute(d, m, offsetof(mesh_vertex, rgb), 3, false));
    if (m->attributes & MESH_UVS)
        add_text(d, list, ", \"TEXCOORD_0\": %zu", add_attribute(d, m, offsetof(mesh_vertex, uv), 2, false));
    if (m->attributes & MESH_MASKS) add_text(d, list, ", \"_GNOMON_MASK\": %zu", add_bytes(d, m->mask, m->n_vertices));
    if (m->attributes & MESH_BAKED) add_text(d, list, ", \"_GNOMON_BAKED\": %zu", add_baked(d, m));
    if (m->attributes & MESH_JOINTS) {
        add_text(d, list, ", \"JOINTS_0\": %zu", add_shorts(d, m->joint, m->n_vertices));
        add_text(d, list, ", \"WEIGHTS_0\": %zu", add_bytes(d, m->weight, m->n_vertices));
    }
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
    const double yaw = c->yaw_deg * MESH_PI / 180, pitch = c->pitch_deg * MESH_PI / 180,
                 flat = c->distance * cos(pitch);
    const mesh_point p = {c->target.x + flat * sin(yaw), c->target.y - c->distance * sin(pitch),
                          c->target.z + flat * cos(yaw)};
    gltf_rotation q = gltf_multiply(gltf_turn(y_axis, c->yaw_deg), gltf_turn(x_axis, c->pitch_deg));
    size_t idx = next_item(d, &d->cameras);
    if (c->half_height > 0)
        add_text(d, &d->cameras,
                 "{\"type\": \"orthographic\", \"orthographic\": {\"xmag\": %.6g, \"ymag\": %.6g, \"znear\": %g, "
                 "\"zfar\": %g}}",
                 c->half_height * 4 / 3, c->half_height, c->near_distance, c->far_distance);
    else
        add_text(
            d, &d->cameras,
            "{\"type\": \"perspective\", \"perspective\": {\"yfov\": %.6g, \"aspectRatio\": 1.33333, \"znear\": %g, "
            "\"zfar\": %g}}",
            c->fov_deg * MESH_PI / 180, c->near_distance, c->far_distance);
    gltf_add_node(d, "camera",
                  "\"camera\": %zu, \"translation\": [%.6g, %.6g, %.6g], \"rotation\": [%.6g, %.6g, %.6g, %.6g]", idx,
                  p.x, p.y, p.z, q.x, q.y, q.z, q.w);
}

size_t gltf_add_light(gltf_document *d, const gltf_light_text *light)
{
    static const char *const kind[] = {
        [GLTF_DIRECTIONAL] = "directional", [GLTF_SPOT] = "spot", [GLTF_POINT] = "point"};
    const double degree = MESH_PI / 180;
    gltf_list *list = &d->lights;
    size_t idx = next_item(d, list);
    add_text(d, list, "{\"name\": \"%s\", \"type\": \"%s\", \"color\": [%g, %g, %g], \"intensity\": %g", light->name,
             kind[light->kind], light->rgb[0], light->rgb[1], light->rgb[2], light->intensity);
    if (light->range > 0) add_text(d, list, ", \"range\": %g", light->range);
    if (light->kind == GLTF_SPOT) {
        add_text(d, list, ", \"spot\": {\"innerConeAngle\": %.6g, \"outerConeAngle\": %.6g}", light->inner_deg * degree,
                 light->outer_deg * degree);
    }
    add_knobs(d, list, light->knobs);
    add_text(d, list, "}");
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

size_t gltf_add_object(gltf_document *d, const char *name, const mesh_builder *m, size_t material_idx)
{
    size_t mesh = gltf_add_mesh(d, name, &(gltf_surface){m, material_idx}, 1);
    return gltf_add_node(d, name, "\"mesh\": %zu", mesh);
}

size_t gltf_add_light_node(gltf_document *d, mesh_point at, gltf_rotation q, const gltf_light_text *light)
{
    size_t idx = gltf_add_light(d, light);
    return gltf_add_node(d, light->name,
                         "\"translation\": [%.6g, %.6g, %.6g], \"rotation\": [%.6g, %.6g, %.6g, %.6g], "
                         "\"extensions\": {\"KHR_lights_punctual\": {\"light\": %zu}}",
                         at.x, at.y, at.z, q.x, q.y, q.z, q.w, idx);
}

void gltf_mark_child(gltf_document *d, size_t node_idx)
{
    if (node_idx < GLTF_MAX_NODES) d->is_root[node_idx] = false;
}

void gltf_add_rotation_keys(gltf_document *d, const char *name, size_t node_idx, double seconds,
                            const gltf_rotation *keys, size_t n)
{
    gltf_add_clip(d, name, &node_idx, 1, seconds, keys, n);
}

static size_t add_rotations(gltf_document *d, const gltf_rotation *keys, size_t n)
{
    const size_t start = d->n_bytes;
    for (size_t i = 0; i < n; i++) {
        put_float(d, (float)mesh_on_grid(keys[i].x));
        put_float(d, (float)mesh_on_grid(keys[i].y));
        put_float(d, (float)mesh_on_grid(keys[i].z));
        put_float(d, (float)mesh_on_grid(keys[i].w));
    }
    return add_accessor(d, add_view(d, start, 0), FLOAT_COMPONENT, n, "VEC4", NULL, NULL);
}

void gltf_add_clip(gltf_document *d, const char *name, const size_t *node_idx, size_t n_nodes, double seconds,
                   const gltf_rotation *keys, size_t n_keys)
{
    const size_t start = d->n_bytes;
    const float first = 0, last = (float)((double)(n_keys - 1) * seconds);
    gltf_list *list = &d->animations;
    for (size_t i = 0; i < n_keys; i++) put_float(d, (float)((double)i * seconds));
    const size_t times = add_accessor(d, add_view(d, start, 0), FLOAT_COMPONENT, n_keys, "SCALAR", &first, &last);
    next_item(d, list);
    add_text(d, list, "{\"name\": \"%s\",\n      \"channels\": [", name);
    for (size_t i = 0; i < n_nodes; i++)
        add_text(d, list, "%s{\"sampler\": %zu, \"target\": {\"node\": %zu, \"path\": \"rotation\"}}",
                 i ? ",\n        " : "", i, node_idx[i]);
    add_text(d, list, "],\n      \"samplers\": [");
    for (size_t i = 0; i < n_nodes; i++)
        add_text(d, list, "%s{\"input\": %zu, \"output\": %zu, \"interpolation\": \"LINEAR\"}", i ? ",\n        " : "",
                 times, add_rotations(d, keys + i * n_keys, n_keys));
    add_text(d, list, "]}");
}

size_t gltf_add_skin(gltf_document *d, const char *name, const size_t *node_idx, const mesh_point *at, size_t n)
{
    const size_t start = d->n_bytes;
    for (size_t i = 0; i < n; i++) {
        const double back[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -at[i].x, -at[i].y, -at[i].z, 1};
        for (int k = 0; k < 16; k++) put_float(d, (float)mesh_on_grid(back[k]));
    }
    const size_t binds = add_accessor(d, add_view(d, start, 0), FLOAT_COMPONENT, n, "MAT4", NULL, NULL);
    const size_t idx = next_item(d, &d->skins);
    add_text(d, &d->skins, "{\"name\": \"%s\", \"inverseBindMatrices\": %zu, \"joints\": [", name, binds);
    for (size_t i = 0; i < n; i++) add_text(d, &d->skins, "%s%zu", i ? ", " : "", node_idx[i]);
    add_text(d, &d->skins, "]}");
    return idx;
}

static void write_list(FILE *file, const char *key, const gltf_list *list)
{
    if (list->n_items > 0) fprintf(file, "  \"%s\": [%s\n  ],\n", key, list->chars);
}

static void write_base64(FILE *file, const uint8_t *bytes, size_t n)
{
    for (size_t i = 0; i < n; i += 3) {
        char digits[5];
        base64_digits(bytes + i, n - i, digits);
        fputs(digits, file);
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
            "{\n  \"asset\": {\"version\": \"2.0\", \"generator\": \"gnomon make_scenes\",\n    \"extras\": "
            "{\"comment\": "
            "\"%s\"}},\n  \"extensionsUsed\": [\"KHR_lights_punctual\"],\n",
            scene->comment);
    write_scene(file, d, scene->settings);
    write_list(file, "nodes", &d->nodes);
    write_list(file, "skins", &d->skins);
    write_list(file, "cameras", &d->cameras);
    fprintf(file, "  \"extensions\": {\"KHR_lights_punctual\": {\"lights\": [%s\n  ]}},\n", d->lights.chars);
    write_list(file, "animations", &d->animations);
    write_list(file, "materials", &d->materials);
    write_list(file, "textures", &d->textures);
    write_list(file, "samplers", &d->samplers);
    write_list(file, "images", &d->images);
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

gltf_rotation gltf_look(mesh_point direction)
{
    mesh_point to = mesh_unit(direction);
    double yaw_deg = atan2(-to.x, -to.z) * 180 / MESH_PI, pitch_deg = asin(to.y) * 180 / MESH_PI;
    return gltf_multiply(gltf_turn((mesh_point){0, 1, 0}, yaw_deg), gltf_turn((mesh_point){1, 0, 0}, pitch_deg));
}

gltf_rotation gltf_multiply(gltf_rotation a, gltf_rotation b)
{
    return (gltf_rotation){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                           a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
                           a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
