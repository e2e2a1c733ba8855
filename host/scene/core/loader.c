/* What the loaders share: errors, notes, files, and growing the scene. */
#include "loader.h"
#include "../../base/utf8.h"
#include "vec.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NOTES = 100, MAX_NOTE_BYTES = 500 };
static const size_t max_file_bytes = (size_t)1 << 30;

bool loader_fail(loader *l, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (l->error_bytes > 0) {
        vsnprintf(l->error, l->error_bytes, format, arguments);
        utf8_clean(l->error);
    }
    va_end(arguments);
    return false;
}

static char *duplicate(loader *l, const char *text)
{
    size_t n = strlen(text) + 1;
    char *copy = malloc(n);
    if (copy) memcpy(copy, text, n);
    else loader_fail(l, "%s: out of memory", l->path);
    return copy;
}

/* Capacity for element n of an array that the scene owns, grown when n is a power of two. *array stays valid on
 * failure. */
static bool scene_grow(loader *l, void **array, size_t n, size_t size)
{
    if (n != 0 && (n & (n - 1)) != 0) return true;
    size_t n_new = n ? 2 * n : 1;
    void *larger = n_new <= SIZE_MAX / 2 / size ? realloc(*array, n_new * size) : NULL;
    if (!larger) return loader_fail(l, "%s: out of memory", l->path);
    *array = larger;
    return true;
}

bool loader_note(loader *l, const char *format, ...)
{
    char text[MAX_NOTE_BYTES];
    scene *s = l->s;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    utf8_clean(text);
    for (size_t i = 0; i < s->n_notes; i++) {
        if (strcmp(s->notes[i], text) == 0) return true;
    }
    if (s->n_notes >= MAX_NOTES) return true;
    void *notes = s->notes;
    bool grown = scene_grow(l, &notes, s->n_notes, sizeof *s->notes);
    s->notes = notes;
    if (!grown) return false;
    char *copy = duplicate(l, s->n_notes == MAX_NOTES - 1 ? "further notes are left out" : text);
    if (!copy) return false;
    s->notes[s->n_notes++] = copy;
    return true;
}

void *loader_alloc(loader *l, size_t n, size_t size)
{
    void *memory = arena_alloc(&l->memory, n, size);
    if (!memory) loader_fail(l, "%s: out of memory", l->path);
    return memory;
}

void *loader_grow(loader *l, void *array, size_t n, size_t size)
{
    void *memory = arena_grow(&l->memory, array, n, size);
    if (!memory) loader_fail(l, "%s: out of memory", l->path);
    return memory;
}

char *loader_format(loader *l, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int n = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = n < 0 ? NULL : loader_alloc(l, (size_t)n + 1, 1);
    if (!text) return NULL;
    va_start(arguments, format);
    vsnprintf(text, (size_t)n + 1, format, arguments);
    va_end(arguments);
    return text;
}

/* Read to the end rather than by a size requested beforehand: pipes have none, and a folder opens but does not read. */
static bool read_stream(loader *l, FILE *file, const char *path, uint8_t **bytes, size_t *n_bytes)
{
    size_t capacity = 1 << 13;
    uint8_t *buffer = loader_alloc(l, capacity + 1, 1);
    *n_bytes = 0;
    while (buffer) {
        *n_bytes += fread(buffer + *n_bytes, 1, capacity - *n_bytes, file);
        if (ferror(file)) return loader_fail(l, "%s: cannot be read", path);
        if (*n_bytes < capacity) break;
        if (capacity >= max_file_bytes) return loader_fail(l, "%s: larger than 1 GiB", path);
        uint8_t *larger = loader_alloc(l, 2 * capacity + 1, 1);
        if (larger) memcpy(larger, buffer, *n_bytes);
        buffer = larger;
        capacity *= 2;
    }
    *bytes = buffer;
    return buffer != NULL;
}

static bool add_file(loader *l, const char *path)
{
    scene *s = l->s;
    for (size_t i = 0; i < s->n_files; i++)
        if (strcmp(s->files[i], path) == 0) return true;
    void *array = s->files;
    bool grown = scene_grow(l, &array, s->n_files, sizeof *s->files);
    s->files = array;
    char *copy = grown ? duplicate(l, path) : NULL;
    if (!copy) return false;
    s->files[s->n_files++] = copy;
    return true;
}

bool loader_try_file(loader *l, const char *path, uint8_t **bytes, size_t *n_bytes, bool *opened)
{
    FILE *file = fopen(path, "rb");
    *opened = file != NULL;
    if (!file) return true;
    bool ok = add_file(l, path) && read_stream(l, file, path, bytes, n_bytes);
    fclose(file);
    return ok;
}

bool loader_read_file(loader *l, const char *path, uint8_t **bytes, size_t *n_bytes)
{
    bool opened;
    if (!loader_try_file(l, path, bytes, n_bytes, &opened)) return false;
    return opened || loader_fail(l, "%s: cannot be opened", path);
}

char *loader_relative_path(loader *l, const char *name)
{
    const char *slash = strrchr(l->path, '/');
    size_t n_folder = slash && name[0] != '/' ? (size_t)(slash - l->path) + 1 : 0;
    char *joined = loader_alloc(l, n_folder + strlen(name) + 1, 1);
    if (!joined) return NULL;
    memcpy(joined, l->path, n_folder);
    strcpy(joined + n_folder, name);
    return joined;
}

scene_mesh *loader_add_mesh(loader *l, const char *name)
{
    scene *s = l->s;
    void *array = s->meshes, *lights = l->light_of_mesh;
    bool grown = scene_grow(l, &array, s->n_meshes, sizeof *s->meshes);
    s->meshes = array;
    grown = grown && scene_grow(l, &lights, s->n_meshes, sizeof *l->light_of_mesh);
    l->light_of_mesh = lights;
    char *copy = grown ? duplicate(l, name) : NULL;
    if (!copy) return NULL;
    l->light_of_mesh[s->n_meshes] = (mesh_light){0};
    s->meshes[s->n_meshes] = (scene_mesh){.name = copy};
    return &s->meshes[s->n_meshes++];
}

scene_object *loader_add_object(loader *l, const char *name)
{
    scene *s = l->s;
    void *array = s->objects;
    bool grown = scene_grow(l, &array, s->n_objects, sizeof *s->objects);
    s->objects = array;
    char *copy = grown ? duplicate(l, name) : NULL;
    if (!copy) return NULL;
    s->objects[s->n_objects] = (scene_object){.name = copy};
    return &s->objects[s->n_objects++];
}

scene_light *loader_add_light(loader *l, const char *name)
{
    scene *s = l->s;
    void *array = s->lights;
    bool grown = scene_grow(l, &array, s->n_lights, sizeof *s->lights);
    s->lights = array;
    char *copy = grown ? duplicate(l, name) : NULL;
    if (!copy) return NULL;
    s->lights[s->n_lights] = (scene_light){.name = copy};
    return &s->lights[s->n_lights++];
}

scene_texture *loader_add_texture(loader *l, const char *name)
{
    scene *s = l->s;
    void *array = s->textures;
    bool grown = scene_grow(l, &array, s->n_textures, sizeof *s->textures);
    s->textures = array;
    char *copy = grown ? duplicate(l, name) : NULL;
    if (!copy) return NULL;
    s->textures[s->n_textures] = (scene_texture){.name = copy};
    return &s->textures[s->n_textures++];
}

bool loader_add_setting(loader *l, const char *key, const char *value)
{
    scene *s = l->s;
    void *array = s->settings;
    bool grown = scene_grow(l, &array, s->n_settings, sizeof *s->settings);
    s->settings = array;
    if (!grown) return false;
    scene_setting *setting = &s->settings[s->n_settings];
    *setting = (scene_setting){duplicate(l, key), duplicate(l, value)};
    s->n_settings++;
    return setting->key && setting->value;
}

scene_object object_defaults(void)
{
    return (scene_object){.to_world = affine_identity(),
                          .albedo = {1, 1, 1},
                          .alpha = 1,
                          .alpha_cutoff = 0.5,
                          .shininess_log2 = 5,
                          .texture_idx = SCENE_NONE,
                          .mask_texture_idx = SCENE_NONE,
                          .caster = SCENE_CASTER_ON,
                          .receives = true};
}

static bool copy_mesh_light(loader *l, scene_object *object)
{
    const mesh_light *light = &l->light_of_mesh[object->mesh_idx];
    size_t n = l->s->meshes[object->mesh_idx].n_vertices;
    if (light->mask) object->mask = malloc(n * 4);
    if (light->baked) object->baked = malloc(n * 3 * sizeof *object->baked);
    if (object->mask) memcpy(object->mask, light->mask, n * 4);
    if (object->baked) memcpy(object->baked, light->baked, n * 3 * sizeof *object->baked);
    bool ok = (!light->mask || object->mask) && (!light->baked || object->baked);
    return ok || loader_fail(l, "%s: out of memory", l->path);
}

void loader_free_mesh_light(loader *l)
{
    for (size_t i = 0; i < l->s->n_meshes; i++) {
        free(l->light_of_mesh[i].mask);
        free(l->light_of_mesh[i].baked);
    }
    free(l->light_of_mesh);
    l->light_of_mesh = NULL;
}

bool loader_add_objects(loader *l, const scene_object *pattern, size_t first_mesh, size_t n_meshes)
{
    for (size_t i = 0; i < n_meshes; i++) {
        scene_object *object = loader_add_object(l, pattern->name);
        if (!object) return false;
        char *name = object->name;
        *object = *pattern;
        object->name = name;
        object->mesh_idx = first_mesh + i;
        if (!copy_mesh_light(l, object)) return false;
    }
    return true;
}

bool loader_clamp_colour(double *rgb, size_t n)
{
    bool unchanged = true;
    for (size_t i = 0; i < n; i++) {
        double clamped = fmin(fmax(rgb[i], 0), 1);
        if (clamped < rgb[i] || clamped > rgb[i]) unchanged = false;
        rgb[i] = clamped;
    }
    return unchanged;
}
