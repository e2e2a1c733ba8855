/* Scene -> glTF. Numbers have all the digits they need: it is read back as it was. */
#include "scene_write.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../image/png.h"
#include "../../base/utf8.h"
#include "../core/vec.h"
#include "../../base/write_buffer.h"

enum { UBYTE = 5121, USHORT = 5123, FLOAT = 5126, ARRAY_BUFFER = 34962, ELEMENT_ARRAY_BUFFER = 34963 };

typedef struct {
    const scene *s;
    write_buffer bytes; /* of the one glTF buffer */
    write_buffer views, accessors, meshes, nodes, materials, images, samplers, textures,
        lights; /* elements, separated by commas */
    size_t n_views, n_accessors, n_meshes, n_nodes;
} writer;

/* ---- Text ---- */

static void put_string(write_buffer *b, const char *text)
{
    write_text(b, "\"");
    while (*text) {
        const unsigned char c = (unsigned char)*text;
        const size_t length =
            utf8_length((const unsigned char *)text, 4); /* the terminating zero continues no sequence */
        if (length == 0) write_text(b, "\\ufffd");
        else if (c == '"' || c == '\\') write_format(b, "\\%c", c);
        else if (c < 32) write_format(b, "\\u%04x", c);
        else write_bytes(b, text, length);
        text += length ? length : 1;
    }
    write_text(b, "\"");
}

static void put_number(write_buffer *b, double v)
{
    char text[32];
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, v);
        const double back = strtod(text, NULL);
        if (!(back < v || back > v)) break;
    }
    write_text(b, text);
}

static void put_numbers(write_buffer *b, const char *key, const double *v, size_t n)
{
    write_format(b, "\"%s\": [", key);
    for (size_t i = 0; i < n; i++) {
        if (i) write_text(b, ", ");
        put_number(b, v[i]);
    }
    write_text(b, "]");
}

static void put_member(write_buffer *b, const char *key, double v)
{
    write_format(b, ", \"%s\": ", key);
    put_number(b, v);
}

static void begin_item(write_buffer *list, size_t n_before)
{
    write_text(list, n_before ? ",\n    {" : "\n    {");
}

/* ---- The buffer ---- */

static size_t add_view(writer *w, size_t start, int target)
{
    const size_t n = w->bytes.n - start;
    while (w->bytes.n % 4) write_bytes(&w->bytes, "", 1);
    begin_item(&w->views, w->n_views);
    write_format(&w->views, "\"buffer\": 0, \"byteOffset\": %zu, \"byteLength\": %zu", start, n);
    if (target) write_format(&w->views, ", \"target\": %d", target);
    write_text(&w->views, "}");
    return w->n_views++;
}

static size_t add_accessor(writer *w, size_t view, int component, bool normalised, size_t count, const char *type,
                           const char *bounds)
{
    begin_item(&w->accessors, w->n_accessors);
    write_format(&w->accessors, "\"bufferView\": %zu, \"componentType\": %d, \"count\": %zu, \"type\": \"%s\"%s%s}",
                 view, component, count, type, normalised ? ", \"normalized\": true" : "", bounds);
    return w->n_accessors++;
}

static void put_bounds(write_buffer *b, const double *v, size_t n)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < 3 * n; i++) {
        low[i % 3] = fmin(low[i % 3], (double)(float)v[i]);
        high[i % 3] = fmax(high[i % 3], (double)(float)v[i]);
    }
    write_text(b, ", ");
    put_numbers(b, "min", low, 3);
    write_text(b, ", ");
    put_numbers(b, "max", high, 3);
}

static size_t add_floats(writer *w, const double *v, size_t n, size_t width, bool with_bounds)
{
    const size_t start = w->bytes.n;
    write_buffer bounds = {0};
    for (size_t i = 0; i < n * width; i++) {
        const float f = (float)v[i];
        write_bytes(&w->bytes, &f, sizeof f);
    }
    if (with_bounds) put_bounds(&bounds, v, n);
    const size_t idx = add_accessor(w, add_view(w, start, ARRAY_BUFFER), FLOAT, false, n, width == 2 ? "VEC2" : "VEC3",
                                    bounds.n ? (const char *)bounds.at : "");
    write_free(&bounds);
    return idx;
}

static size_t add_masks(writer *w, const uint8_t *mask, size_t n)
{
    const size_t start = w->bytes.n;
    write_bytes(&w->bytes, mask, 4 * n);
    return add_accessor(w, add_view(w, start, ARRAY_BUFFER), UBYTE, true, n, "VEC4", "");
}

static size_t add_indices(writer *w, const scene_mesh *m)
{
    const size_t start = w->bytes.n;
    for (size_t i = 0; i < 3 * m->n_triangles; i++) {
        const uint16_t idx = (uint16_t)m->idx[i];
        write_bytes(&w->bytes, &idx, sizeof idx);
    }
    return add_accessor(w, add_view(w, start, ELEMENT_ARRAY_BUFFER), USHORT, false, 3 * m->n_triangles, "SCALAR", "");
}

/* ---- Meshes and objects ---- */

static size_t add_mesh(writer *w, const scene_object *o, size_t material)
{
    const scene_mesh *m = &w->s->meshes[o->mesh_idx];
    write_buffer *b = &w->meshes;
    const size_t n = m->n_vertices;
    begin_item(b, w->n_meshes);
    write_text(b, "\"name\": ");
    put_string(b, m->name);
    write_format(b, ", \"primitives\": [{\"attributes\": {\"POSITION\": %zu", add_floats(w, m->pos, n, 3, true));
    if (m->nrm) write_format(b, ", \"NORMAL\": %zu", add_floats(w, m->nrm, n, 3, false));
    if (m->rgb) write_format(b, ", \"COLOR_0\": %zu", add_floats(w, m->rgb, n, 3, false));
    if (m->uv) write_format(b, ", \"TEXCOORD_0\": %zu", add_floats(w, m->uv, n, 2, false));
    if (m->mask_uv) write_format(b, ", \"TEXCOORD_1\": %zu", add_floats(w, m->mask_uv, n, 2, false));
    if (o->mask) write_format(b, ", \"_GNOMON_MASK\": %zu", add_masks(w, o->mask, n));
    if (o->baked) write_format(b, ", \"_GNOMON_BAKED\": %zu", add_floats(w, o->baked, n, 3, false));
    write_format(b, "}, \"indices\": %zu, \"material\": %zu}]}", add_indices(w, m), material);
    return w->n_meshes++;
}

static void add_material(writer *w, const scene_object *o, size_t idx)
{
    static const char *const modes[] = {"OPAQUE", "MASK", "BLEND", "BLEND"}, *const casters[] = {"off", "on", "clip",
                                                                                                 "dither"};
    const double factor[4] = {o->albedo[0], o->albedo[1], o->albedo[2], o->alpha};
    write_buffer *b = &w->materials;
    begin_item(b, idx);
    write_text(b, "\"name\": ");
    put_string(b, o->name);
    write_text(b, ", \"pbrMetallicRoughness\": {");
    put_numbers(b, "baseColorFactor", factor, 4);
    if (o->texture_idx != SCENE_NONE) write_format(b, ", \"baseColorTexture\": {\"index\": %zu}", o->texture_idx);
    write_text(b, ", \"metallicFactor\": 0}, ");
    if (o->emissive_texture_idx != SCENE_NONE)
        write_format(b, "\"emissiveFactor\": [1, 1, 1], \"emissiveTexture\": {\"index\": %zu}, ",
                     o->emissive_texture_idx);
    write_format(b, "\"alphaMode\": \"%s\"%s, \"extras\": {\"gnomon\": {", modes[o->visible_alpha],
                 o->two_sided ? ", \"doubleSided\": true" : "");
    write_format(
        b,
        "\"caster\": \"%s\", \"casts_two_sided\": %d, \"hidden\": %d, \"moving\": %d, \"receives\": %d, \"unlit\": %d",
        casters[o->caster], o->casts_two_sided, o->hidden, o->moving, o->receives, o->unlit);
    if (o->visible_alpha == SCENE_ALPHA_DITHER) write_text(b, ", \"visible_alpha\": \"dither\"");
    put_member(b, "alpha_cutoff", o->alpha_cutoff);
    write_text(b, ", ");
    put_numbers(b, "specular", o->specular, 3);
    write_format(b, ", \"shininess_log2\": %d, ", o->shininess_log2);
    put_numbers(b, "emissive", o->emissive, 3);
    if (o->mask_texture_idx != SCENE_NONE) write_format(b, ", \"mask_texture\": %zu", o->mask_texture_idx);
    write_text(b, "}}}");
}

static void begin_node(writer *w, const char *name, const scene_affine *at)
{
    begin_item(&w->nodes, w->n_nodes++);
    write_text(&w->nodes, "\"name\": ");
    put_string(&w->nodes, name);
    double m[16] = {0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) m[4 * j + i] = at->m[i][j];
    m[15] = 1;
    write_text(&w->nodes, ", ");
    put_numbers(&w->nodes, "matrix", m, 16);
}

static void add_objects(writer *w)
{
    for (size_t i = 0; i < w->s->n_objects; i++) {
        const scene_object *o = &w->s->objects[i];
        add_material(w, o, i);
        const size_t mesh = add_mesh(w, o, i);
        begin_node(w, o->name, &o->to_world);
        write_format(&w->nodes, ", \"mesh\": %zu}", mesh);
    }
}

/* ---- Textures ---- */

static bool add_texture(writer *w, const scene_texture *t, size_t idx)
{
    enum { NEAREST = 9728, LINEAR = 9729, OF_LEVELS = 9984 - NEAREST, CLAMP_TO_EDGE = 33071, REPEAT = 10497 };
    size_t n = 0;
    const size_t start = w->bytes.n;
    uint8_t *png = png_pack_rgba8(t->width, t->height, t->rgba, &n);
    if (!png) return false;
    write_bytes(&w->bytes, png, n);
    free(png);
    begin_item(&w->images, idx);
    write_text(&w->images, "\"name\": ");
    put_string(&w->images, t->name);
    write_format(&w->images, ", \"mimeType\": \"image/png\", \"bufferView\": %zu}", add_view(w, start, 0));
    begin_item(&w->samplers, idx);
    const int filter = t->bilinear ? LINEAR : NEAREST;
    write_format(&w->samplers, "\"magFilter\": %d, ", filter);
    if (t->mipmapped) write_format(&w->samplers, "\"minFilter\": %d, ", filter + OF_LEVELS);
    write_format(&w->samplers, "\"wrapS\": %d, \"wrapT\": %d}", t->clamp_u ? CLAMP_TO_EDGE : REPEAT,
                 t->clamp_v ? CLAMP_TO_EDGE : REPEAT);
    begin_item(&w->textures, idx);
    write_format(&w->textures, "\"sampler\": %zu, \"source\": %zu}", idx, idx);
    return true;
}

/* ---- Lights and the camera ---- */

static void put_light_knobs(write_buffer *b, const scene_light *l)
{
    static const char *const softness[] = {"default", "hard", "soft"}, *const modes[] = {"realtime", "mixed", "baked"};
    static const char *const automatic[] = {"off", "depth", "normal"};
    write_format(
        b, ", \"extras\": {\"gnomon\": {\"shadow\": %d, \"mode\": \"%s\", \"mask_channel\": %d, \"softness\": \"%s\"",
        l->shadow, modes[l->mode], l->mask_channel, softness[l->softness]);
    put_member(b, "strength", l->strength);
    put_member(b, "bias_constant", l->bias_constant);
    put_member(b, "bias_slope", l->bias_slope);
    put_member(b, "bias_normal", l->bias_normal);
    write_text(b, ", ");
    put_numbers(b, "bias_receiver", l->bias_receiver, 4);
    put_member(b, "bias_caster", l->bias_caster);
    write_format(b, ", \"receiver_plane\": %d, \"auto_bias\": \"%s\"", l->receiver_plane, automatic[l->auto_bias]);
    if (l->kind == SCENE_LIGHT_DIRECTIONAL) put_member(b, "near_offset", l->near_offset);
    else put_member(b, "near", l->near);
    write_text(b, "}}");
}

static void add_light(writer *w, const scene_light *l, size_t idx)
{
    static const char *const kinds[] = {"directional", "spot", "point"};
    const double brightest = fmax(l->colour[0], fmax(l->colour[1], l->colour[2]));
    double colour[3];
    write_buffer *b = &w->lights;
    for (int i = 0; i < 3; i++) colour[i] = brightest > 0 ? l->colour[i] / brightest : 0;
    begin_item(b, idx);
    write_text(b, "\"name\": ");
    put_string(b, l->name);
    write_format(b, ", \"type\": \"%s\", ", kinds[l->kind]);
    put_numbers(b, "color", colour, 3);
    put_member(b, "intensity", brightest * VEC_PI);
    if (l->kind != SCENE_LIGHT_DIRECTIONAL && !isinf(l->range)) put_member(b, "range", l->range);
    if (l->kind == SCENE_LIGHT_SPOT) {
        write_text(b, ", \"spot\": {\"innerConeAngle\": ");
        put_number(b, fmin(l->inner, l->outer) * VEC_PI);
        put_member(b, "outerConeAngle", l->outer * VEC_PI);
        write_text(b, "}");
    }
    put_light_knobs(b, l);
    write_text(b, "}");
}

/* Looks along its local -Z. */
static scene_affine light_place(const scene_light *l)
{
    const double steep = fabs(l->direction[1]), hint[3] = {steep > 0.9, !(steep > 0.9), 0};
    double x[3], y[3], z[3];
    scene_affine at;
    for (int i = 0; i < 3; i++) z[i] = -l->direction[i];
    vec_cross(x, hint, z);
    vec_normalise(x);
    vec_cross(y, z, x);
    for (int i = 0; i < 3; i++) {
        const double row[4] = {x[i], y[i], z[i], l->kind == SCENE_LIGHT_DIRECTIONAL ? 0 : l->position[i]};
        memcpy(at.m[i], row, sizeof row);
    }
    return at;
}

static void add_lights(writer *w)
{
    for (size_t i = 0; i < w->s->n_lights; i++) {
        const scene_affine at = light_place(&w->s->lights[i]);
        add_light(w, &w->s->lights[i], i);
        begin_node(w, w->s->lights[i].name, &at);
        write_format(&w->nodes, ", \"extensions\": {\"KHR_lights_punctual\": {\"light\": %zu}}}", i);
    }
}

static void add_camera(writer *w)
{
    begin_node(w, "camera", &w->s->camera.to_world);
    write_text(&w->nodes, ", \"camera\": 0}");
}

/* ---- Settings ---- */

static void put_shadow(write_buffer *b, const scene *s)
{
    static const char *const filters[] = {"hard", "2x2", "3x3", "5x5", "7x7", "disk"};
    static const char *const mixing[] = {"none", "always", "distance"},
                             *const tiles[] = {"equal", "importance", "worth"}, *const fits[] = {"stable", "tight"};
    static const char *const blends[] = {"hard", "soft", "dither"}, *const distances[] = {"depth", "radius"};
    const scene_shadow *w = &s->shadow;
    write_format(b,
                 ", \"filter\": \"%s\", \"other_filter\": \"%s\", \"mixing\": \"%s\", \"tiles\": "
                 "\"%s\", \"fit\": \"%s\"",
                 filters[w->filter], filters[w->other_filter], mixing[w->mixing], tiles[w->tiles], fits[w->fit]);
    write_format(b,
                 ", \"cascade_blend\": \"%s\", \"distance_mode\": \"%s\", \"disk_samples\": %d, \"object_lights\": %d",
                 blends[w->blend], distances[w->distance_mode], w->disk_samples, w->object_lights);
    write_format(b, ", \"main_light\": %d, \"caster_culling\": %d, \"refresh\": [%d, %d, %d, %d], \"cascades\": %d",
                 w->main_light, w->caster_culling, w->refresh[0], w->refresh[1], w->refresh[2], w->refresh[3],
                 w->n_cascades);
    if (w->n_cascades > 1) {
        write_text(b, ", ");
        put_numbers(b, "cascade_ratios", w->cascade_ratio, (size_t)w->n_cascades - 1);
    }
    if (w->max_distance >= 0.004 && w->max_distance <= 8192) /* else as a file gets that sets none */
        put_member(b, "max_distance", w->max_distance);
    put_member(b, "distance_fade", w->distance_fade);
    put_member(b, "cascade_fade", w->cascade_fade);
    put_member(b, "penumbra", w->penumbra);
}

static void put_settings(write_buffer *b, const scene *s, const scene_write_setting *settings, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        put_string(b, settings[i].key);
        write_text(b, ": ");
        put_string(b, settings[i].value);
        write_text(b, ", ");
    }
    put_numbers(b, "ambient", s->ambient, 3);
    write_text(b, ", ");
    put_numbers(b, "background", s->background, 3);
    if (s->gradient) {
        write_text(b, ", ");
        put_numbers(b, "background_bottom", s->background_bottom, 3);
    }
    put_shadow(b, s);
}

/* ---- The file ---- */

static void put_list(write_buffer *out, const char *key, const write_buffer *list)
{
    if (!list->n) return;
    write_format(out, "  \"%s\": [", key);
    write_bytes(out, list->at, list->n);
    write_text(out, "\n  ],\n");
}

static void put_head(writer *w, write_buffer *out, const char *comment, const scene_write_setting *settings, size_t n)
{
    write_text(out, "{\n  \"asset\": {\"version\": \"2.0\", \"generator\": \"gnomon\", \"extras\": {\"comment\": ");
    put_string(out, comment);
    write_text(out, "}},\n");
    if (w->s->n_lights) write_text(out, "  \"extensionsUsed\": [\"KHR_lights_punctual\"],\n");
    write_text(out, "  \"scene\": 0,\n  \"scenes\": [{\"nodes\": [");
    for (size_t i = 0; i < w->n_nodes; i++) write_format(out, "%s%zu", i ? ", " : "", i);
    write_text(out, "],\n    \"extras\": {\"gnomon\": {");
    put_settings(out, w->s, settings, n);
    const scene_camera *camera = &w->s->camera;
    const bool flat = camera->half_height > 0;
    write_format(out,
                 "}}}],\n  \"cameras\": [{\"type\": \"%s\", \"%s\": {\"%s\": ", flat ? "orthographic" : "perspective",
                 flat ? "orthographic" : "perspective", flat ? "ymag" : "yfov");
    put_number(out, flat ? camera->half_height : 2 * atan(1 / camera->focal));
    if (flat) put_member(out, "xmag", camera->half_height);
    put_member(out, "znear", w->s->camera.near);
    if (!isinf(w->s->camera.far)) put_member(out, "zfar", w->s->camera.far);
    write_text(out, "}}],\n");
}

static void put_lists(writer *w, write_buffer *out)
{
    put_list(out, "nodes", &w->nodes);
    if (w->s->n_lights) {
        write_text(out, "  \"extensions\": {\"KHR_lights_punctual\": {\"lights\": [");
        write_bytes(out, w->lights.at, w->lights.n);
        write_text(out, "\n  ]}},\n");
    }
    put_list(out, "materials", &w->materials);
    put_list(out, "textures", &w->textures);
    put_list(out, "samplers", &w->samplers);
    put_list(out, "images", &w->images);
    put_list(out, "meshes", &w->meshes);
    put_list(out, "accessors", &w->accessors);
    put_list(out, "bufferViews", &w->views);
    write_format(out, "  \"buffers\": [{\"byteLength\": %zu", w->bytes.n);
}

static void put_word(write_buffer *out, uint32_t v)
{
    const uint8_t bytes[4] = {(uint8_t)v, (uint8_t)(v >> 8), (uint8_t)(v >> 16), (uint8_t)(v >> 24)};
    write_bytes(out, bytes, sizeof bytes);
}

static void put_binary(write_buffer *out, write_buffer *json, const write_buffer *bytes)
{
    write_text(json, "}]\n}");
    while (json->n % 4) write_text(json, " ");
    put_word(out, 0x46546C67); /* "glTF" */
    put_word(out, 2);
    put_word(out, (uint32_t)(12 + 8 + json->n + 8 + bytes->n));
    put_word(out, (uint32_t)json->n);
    put_word(out, 0x4E4F534A); /* "JSON" */
    write_bytes(out, json->at, json->n);
    put_word(out, (uint32_t)bytes->n);
    put_word(out, 0x004E4942); /* "BIN" */
    write_bytes(out, bytes->at, bytes->n);
}

static void put_base64(write_buffer *out, const write_buffer *bytes)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < bytes->n; i += 3) {
        const size_t left = bytes->n - i;
        const uint32_t v = (uint32_t)bytes->at[i] << 16 | (uint32_t)(left > 1 ? bytes->at[i + 1] : 0) << 8 |
                           (left > 2 ? bytes->at[i + 2] : 0);
        const char four[4] = {digit[v >> 18], digit[v >> 12 & 63], left > 1 ? digit[v >> 6 & 63] : '=',
                              left > 2 ? digit[v & 63] : '='};
        write_bytes(out, four, 4);
    }
}

static bool is_binary(const char *path)
{
    const size_t n = strlen(path);
    return n >= 4 && strcmp(path + n - 4, ".glb") == 0;
}

static int save(const write_buffer *out, const char *path, char *error, size_t error_bytes)
{
    FILE *f = fopen(path, "wb");
    if (!f) {
        snprintf(error, error_bytes, "cannot be written: %s", strerror(errno));
        return -1;
    }
    const bool failed = fwrite(out->at, 1, out->n, f) != out->n;
    if (fclose(f) == 0 && !failed) return 0;
    snprintf(error, error_bytes, "cannot be written");
    return -1;
}

static bool fill(writer *w)
{
    for (size_t i = 0; i < w->s->n_textures; i++)
        if (!add_texture(w, &w->s->textures[i], i)) return false;
    add_objects(w);
    add_lights(w);
    add_camera(w);
    return true;
}

int scene_write(const scene *s, const char *path, const char *comment, const scene_write_setting *settings,
                size_t n_settings, char *error, size_t error_bytes)
{
    writer w = {.s = s};
    write_buffer json = {0},
                 binary = {0}, *const all[] = {&w.bytes,  &w.views,    &w.accessors, &w.meshes, &w.nodes, &w.materials,
                                               &w.images, &w.samplers, &w.textures,  &w.lights, &json,    &binary};
    bool failed = !fill(&w);
    put_head(&w, &json, comment, settings, n_settings);
    put_lists(&w, &json);
    if (is_binary(path)) put_binary(&binary, &json, &w.bytes);
    else {
        write_text(&json, ", \"uri\": \"data:application/octet-stream;base64,");
        put_base64(&json, &w.bytes);
        write_text(&json, "\"}]\n}\n");
    }
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) failed = failed || all[i]->failed;
    int status = -1;
    if (failed) snprintf(error, error_bytes, "out of memory");
    else status = save(is_binary(path) ? &binary : &json, path, error, error_bytes);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) write_free(all[i]);
    return status;
}
