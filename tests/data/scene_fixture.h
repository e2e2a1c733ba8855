/* What the tests of the loaders stand on: files in build/tmp, loading them, and what holds for every scene. */
#ifndef GNOMON_TESTS_SCENE_FIXTURE_H
#define GNOMON_TESTS_SCENE_FIXTURE_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../../host/scene/scene.h"
#include "check.h"
#include "scene_cases.h"

#ifndef TMP
#define TMP "build/tmp/test_scene"
#endif
static const scene_options plain = {.frame = 0, .width = 320, .height = 240};
static char error[400];
static scene s;

static inline void write_file(const char *path, const void *bytes, size_t n)
{
    remove(path); /* cheaper than to empty it: some file systems then wait for the disk */
    FILE *file = fopen(path, "wb");
    if (!CHECK(file != NULL)) exit(check_report());
    CHECK(fwrite(bytes, 1, n, file) == n);
    fclose(file);
}

static inline int load(const char *path, const scene_options *options)
{
    memset(&s, 0xFF, sizeof s); /* scene_load must not look at what was there */
    return scene_load(&s, path, options, error, sizeof error);
}

static inline int load_text(const char *path, const char *text)
{
    write_file(path, text, strlen(text));
    return load(path, &plain);
}

static inline int has_note(const char *part)
{
    for (size_t i = 0; i < s.n_notes; i++) {
        if (strstr(s.notes[i], part)) return 1;
    }
    return 0;
}

static inline int has_remark(const char *part)
{
    for (size_t i = 0; i < s.n_remarks; i++) {
        if (strstr(s.remarks[i], part)) return has_note(part);
    }
    return 0;
}

static inline int is_empty(void)
{
    return !s.meshes && !s.textures && !s.objects && !s.lights && !s.settings && !s.notes &&
           s.n_meshes + s.n_objects + s.n_lights + s.n_textures + s.n_notes == 0;
}

/* The load failed, for the reason expected, in one line. */
static inline int refused(int result, const char *why)
{
    int ok = result == -1 && is_empty() && strstr(error, why) && !strchr(error, '\n');
    if (!ok) printf("  expected '%s', got '%s'\n", why, result ? error : "no error");
    if (result == 0) scene_free(&s);
    return ok;
}

/* text with the first `find` replaced; in static storage. */
static inline const char *replaced(const char *text, const char *find, const char *put)
{
    static char out[2][16384];
    static int turn;
    const char *at = strstr(text, find);
    if (!CHECK(at != NULL)) printf("  no '%s'\n", find);
    if (!at) return text;
    char work[sizeof out[0]];
    snprintf(work, sizeof work, "%.*s%s%s", (int)(at - text), text, put, at + strlen(find));
    return memcpy(out[turn = !turn], work, sizeof work);
}

static inline int load_changed(const char *find, const char *put)
{
    return load_text(TMP ".gltf", replaced(base_json, find, put));
}

static inline const char *without_animation(const char *text)
{
    const char *at = strstr(text, "\"animations\":");
    return replaced(text, at ? "\"animations\":" : "", "\"unused\":");
}

static unsigned last_texels; /* read for the sanitizer's sake */

static inline int texture_is_sound(const scene_texture *t)
{
    int w = t->width, h = t->height;
    int ok = t->name && w >= 1 && w <= 4096 && h >= 1 && h <= 4096 && t->rgba;
    if (ok) last_texels += t->rgba[(size_t)w * (size_t)h * 4 - 1];
    return ok;
}

static inline int object_is_sound(const scene_object *o)
{
    if (!o->name || o->mesh_idx >= s.n_meshes) return 0;
    const scene_mesh *m = &s.meshes[o->mesh_idx];
    int ok = (o->texture_idx == SCENE_NONE || (o->texture_idx < s.n_textures && m->uv)) &&
             (o->mask_texture_idx == SCENE_NONE || (o->mask_texture_idx < s.n_textures && m->mask_uv));
    for (size_t k = 0; k < 2 * m->n_vertices; k++) {
        ok = ok && (!m->uv || isfinite(m->uv[k])) && (!m->mask_uv || (m->mask_uv[k] >= 0 && m->mask_uv[k] <= 1));
    }
    for (size_t k = 0; o->baked && k < 3 * m->n_vertices; k++) ok = ok && o->baked[k] >= 0 && isfinite(o->baked[k]);
    return ok && o->alpha >= 0 && o->alpha <= 1 && o->alpha_cutoff >= 0 && o->alpha_cutoff <= 1 &&
           o->specular[0] >= 0 && o->specular[0] <= 1 && o->shininess_log2 >= 0 && o->shininess_log2 <= 7;
}

/* What the engines may rely on, whatever the file was. */
static inline void check_invariants(void)
{
    int ok =
        s.n_objects > 0 && s.n_lights > 0 && s.camera.near > 0 && s.camera.far > s.camera.near && s.camera.focal > 0;
    for (size_t i = 0; i < s.n_meshes; i++) {
        const scene_mesh *m = &s.meshes[i];
        ok = ok && m->n_triangles > 0 && m->n_triangles <= 65535 && m->n_vertices <= 65535 && m->name;
        for (size_t k = 0; ok && k < 3 * m->n_triangles; k++) ok = m->idx[k] < m->n_vertices;
        for (size_t k = 0; ok && k < 3 * m->n_vertices; k++) {
            ok = isfinite(m->pos[k]) && (!m->rgb || (m->rgb[k] >= 0 && m->rgb[k] <= 1));
            if (m->nrm && k % 3 == 0) ok = ok && fabs(hypot(hypot(m->nrm[k], m->nrm[k + 1]), m->nrm[k + 2]) - 1) < 1e-9;
        }
    }
    for (size_t i = 0; i < s.n_objects; i++) ok = ok && object_is_sound(&s.objects[i]);
    for (size_t i = 0; i < s.n_textures; i++) ok = ok && texture_is_sound(&s.textures[i]);
    for (size_t i = 0; i < s.n_lights; i++) {
        const scene_light *l = &s.lights[i];
        const double *d = l->direction;
        ok = ok && fabs(hypot(hypot(d[0], d[1]), d[2]) - 1) < 1e-9 && isfinite(l->colour[0]) && l->strength >= 0 &&
             l->strength <= 1;
        if (l->kind == SCENE_LIGHT_DIRECTIONAL) continue;
        ok = ok && l->range >= 0.01 && l->near > 0 && isfinite(l->near) &&
             isfinite(l->position[0] + l->position[1] + l->position[2]);
        if (l->kind == SCENE_LIGHT_SPOT)
            ok = ok && l->inner >= 0 && l->inner <= l->outer && l->outer * 360 >= 1 && l->outer * 360 <= 179;
    }
    CHECK(ok);
}

static inline size_t put_base64(char *out, const uint8_t *bytes, size_t n)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    size_t n_out = 0;
    for (size_t i = 0; i < n; i += 3) {
        uint32_t bits =
            (uint32_t)bytes[i] << 16 | (i + 1 < n ? (uint32_t)bytes[i + 1] << 8 : 0) | (i + 2 < n ? bytes[i + 2] : 0);
        for (int k = 0; k < 4; k++) out[n_out++] = i + (size_t)k > n ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    out[n_out] = '\0';
    return n_out;
}

/* A quad in the xy plane with everything on it. Sizes and offsets of the buffer's parts stand in base_json. */
static uint8_t base_bin[328];

static inline void put_floats(size_t offset, const float *values, size_t n)
{
    memcpy(base_bin + offset, values, n * sizeof *values);
}

static inline void make_base_bin(void)
{
    static const float pos[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, nrm[12] = {0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const uint16_t idx[6] = {0, 1, 2, 2, 1, 3};
    static const uint8_t rgba[16] = {255, 0, 0, 9, 0, 255, 0, 9, 0, 0, 255, 9, 51, 102, 153, 9};
    static const float times[3] = {1, 2, 4};
    static const float moves[27] = {0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 8, 0, 2, 0, 0, 0, 8, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0};
    static const float turns[12] = {0, 0, 0, 1, 0, 0, -0.70710678f, -0.70710678f, 0, 0, 1, 0};
    static const float scales[9] = {1, 1, 1, 2, 2, 2, 3, 3, 3};
    put_floats(0, pos, 12);
    memcpy(base_bin + 48, idx, sizeof idx);
    put_floats(60, nrm, 12);
    memcpy(base_bin + 108, rgba, sizeof rgba);
    put_floats(124, times, 3);
    put_floats(136, moves, 27);
    put_floats(244, turns, 12);
    put_floats(292, scales, 9);
}

#endif
