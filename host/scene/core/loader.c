/* What the loaders share: errors, notes, files, and growing the scene. */
#include "loader.h"
#include "../../base/utf8.h"
#include "vec.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_NOTES = 100, MAX_NOTE_BYTES = 500 };
enum { GROW_FREES = 4096 }; /* elements of an array whose old copy is worth looking for */

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

void *loader_own(loader *l, size_t n, size_t size)
{
    bool fits = size == 0 || n <= SIZE_MAX / size;
    void *memory = fits && arena_reserve(&l->memory, n * size) ? calloc(n ? n : 1, size) : NULL;
    if (!memory) budget_fail_memory(l, fits ? n * size : SIZE_MAX);
    return memory;
}

static char *duplicate(loader *l, const char *text)
{
    size_t n = strlen(text) + 1;
    char *copy = loader_own(l, n, 1);
    if (copy) memcpy(copy, text, n);
    return copy;
}

/* Capacity for element n of an array that the scene owns, grown when n is a power of two. *array stays valid on
 * failure. */
static bool scene_grow(loader *l, void **array, size_t n, size_t size)
{
    if (n != 0 && (n & (n - 1)) != 0) return true;
    size_t n_new = n ? 2 * n : 1;
    bool fits = n_new <= SIZE_MAX / 2 / size && arena_reserve(&l->memory, (n_new - n) * size);
    void *larger = fits ? realloc(*array, n_new * size) : NULL;
    if (!larger) return budget_fail_memory(l, (n_new - n) * size);
    *array = larger;
    return true;
}

/* One line more in such a list; if it is there already, and behind MAX_NOTES, nothing. */
static bool add_line(loader *l, char ***list, size_t *n, const char *text)
{
    if (*n >= MAX_NOTES) return true;
    for (size_t i = 0; i < *n; i++) {
        if (strcmp((*list)[i], text) == 0) return true;
    }
    void *array = *list;
    bool grown = scene_grow(l, &array, *n, sizeof **list);
    *list = array;
    if (!grown) return false;
    char *copy = duplicate(l, *n == MAX_NOTES - 1 ? "further notes are left out" : text);
    if (!copy) return false;
    (*list)[(*n)++] = copy;
    return true;
}

static void clean_line(char *text, const char *format, va_list arguments)
{
    vsnprintf(text, MAX_NOTE_BYTES, format, arguments);
    utf8_clean(text);
}

bool loader_note(loader *l, const char *format, ...)
{
    char text[MAX_NOTE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    clean_line(text, format, arguments);
    va_end(arguments);
    return add_line(l, &l->s->notes, &l->s->n_notes, text);
}

bool loader_remark(loader *l, const char *format, ...)
{
    char text[MAX_NOTE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    clean_line(text, format, arguments);
    va_end(arguments);
    return add_line(l, &l->s->notes, &l->s->n_notes, text) && add_line(l, &l->s->remarks, &l->s->n_remarks, text);
}

void *loader_alloc(loader *l, size_t n, size_t size)
{
    void *memory = arena_alloc(&l->memory, n, size);
    if (!memory) budget_fail_memory(l, size && n > SIZE_MAX / 2 / size ? SIZE_MAX : n * size);
    return memory;
}

void *loader_grow(loader *l, void *array, size_t n, size_t size)
{
    void *memory = arena_grow(&l->memory, array, n, size);
    if (!memory) budget_fail_memory(l, n > SIZE_MAX / 4 / size ? SIZE_MAX : 2 * n * size);
    if (memory && memory != array && n >= GROW_FREES) arena_free(&l->memory, array);
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

/* What the file says of its size is where the buffer begins: it may grow meanwhile, and some say 0. */
static bool read_stream(loader *l, FILE *file, const char *path, size_t capacity, uint8_t **bytes, size_t *n_bytes)
{
    uint8_t *buffer = loader_alloc(l, capacity + 1, 1);
    *n_bytes = 0;
    while (buffer) {
        *n_bytes += fread(buffer + *n_bytes, 1, capacity - *n_bytes, file);
        if (ferror(file)) return loader_fail(l, "%s: cannot be read", path);
        if (*n_bytes < capacity) break;
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

/* Looked at before it is opened: opening a pipe would wait for its other end. */
static const char *why_no_file(const char *path, size_t *n_bytes)
{
    struct stat about;
    if (stat(path, &about) != 0) return errno == ENOENT ? "cannot be opened (no such file)" : "cannot be opened";
    if (S_ISDIR(about.st_mode)) return "is a folder, not a file";
    if (!S_ISREG(about.st_mode)) return "is a device or a pipe, not a file";
    *n_bytes = (size_t)about.st_size;
    return NULL;
}

bool loader_try_file(loader *l, const char *path, uint8_t **bytes, size_t *n_bytes, const char **problem)
{
    size_t n_expected = 0;
    const char *over = budget_spend(l, BUDGET_FILES, 1);
    if (over) return loader_fail(l, "%s: %s", path, over);
    *problem = why_no_file(path, &n_expected);
    FILE *file = *problem ? NULL : fopen(path, "rb");
    if (!*problem && !file) *problem = "cannot be opened";
    if (!file) return true;
    bool ok = add_file(l, path);
    over = budget_spend(l, BUDGET_FILE_BYTES, n_expected);
    if (over) ok = loader_fail(l, "%s: %s", path, over);
    ok = ok && read_stream(l, file, path, n_expected + 1, bytes, n_bytes);
    fclose(file);
    return ok;
}

bool loader_read_file(loader *l, const char *path, uint8_t **bytes, size_t *n_bytes)
{
    const char *problem;
    if (!loader_try_file(l, path, bytes, n_bytes, &problem)) return false;
    return !problem || loader_fail(l, "%s: %s", path, problem);
}

bool loader_may_read(const loader *l, const char *name)
{
    if (l->options->outside) return true;
    bool has_drive = ((name[0] >= 'A' && name[0] <= 'Z') || (name[0] >= 'a' && name[0] <= 'z')) && name[1] == ':';
    if (name[0] == '/' || has_drive) return false;
    long depth = 0;
    for (const char *at = name; *at && depth >= 0;) {
        size_t n = strcspn(at, "/");
        if (n == 2 && at[0] == '.' && at[1] == '.') depth--;
        else if (n > 0 && !(n == 1 && at[0] == '.')) depth++;
        at += n + (at[n] == '/');
    }
    return depth >= 0;
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
    l->light_of_mesh[s->n_meshes] = (mesh_light){.alpha = 1};
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
    if (l->options->orbit && strcmp(key, "max_distance") == 0)
        return loader_note(l,
                           "max_distance of the scene ignored: it is for the camera that --orbit takes the place of");
    void *array = s->settings;
    bool grown = scene_grow(l, &array, s->n_settings, sizeof *s->settings);
    s->settings = array;
    if (!grown) return false;
    scene_setting *setting = &s->settings[s->n_settings];
    *setting = (scene_setting){duplicate(l, key), duplicate(l, value)};
    s->n_settings++;
    return setting->key && setting->value;
}

bool loader_add_rig_node(loader *l, size_t parent, const scene_affine *matrix, size_t *out)
{
    scene_rig *rig = l->s->rig;
    scene_node *grown = realloc(rig->nodes, (rig->n_nodes + 1) * sizeof *grown);
    if (!grown) return loader_fail(l, "out of memory");
    rig->nodes = grown;
    *out = rig->n_nodes++;
    grown[*out] = (scene_node){.parent = parent,
                               .in_scene = true,
                               .has_matrix = true,
                               .matrix = *matrix,
                               .rotation = {0, 0, 0, 1},
                               .scale = {1, 1, 1}};
    return true;
}

scene_object object_defaults(void)
{
    return (scene_object){.to_world = affine_identity(),
                          .albedo = {1, 1, 1},
                          .alpha = 1,
                          .alpha_cutoff = 0.5,
                          .shininess_log2 = 5,
                          .texture_idx = SCENE_NONE,
                          .emissive_texture_idx = SCENE_NONE,
                          .mask_texture_idx = SCENE_NONE,
                          .node_idx = SCENE_NONE,
                          .caster = SCENE_CASTER_ON,
                          .receives = true};
}

static bool copy_mesh_light(loader *l, scene_object *object)
{
    const mesh_light *light = &l->light_of_mesh[object->mesh_idx];
    size_t n = l->s->meshes[object->mesh_idx].n_vertices;
    object->alpha *= light->alpha;
    if (light->mask) object->mask = loader_own(l, n, 4);
    if (light->baked) object->baked = loader_own(l, n, 3 * sizeof *object->baked);
    if (object->mask) memcpy(object->mask, light->mask, n * 4);
    if (object->baked) memcpy(object->baked, light->baked, n * 3 * sizeof *object->baked);
    return (!light->mask || object->mask) && (!light->baked || object->baked);
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

static bool spend_object(loader *l, const scene_object *object, size_t mesh_idx)
{
    const char *over = budget_spend(l, BUDGET_OBJECTS, 1);
    if (!over) over = budget_spend(l, BUDGET_TRIANGLES, l->s->meshes[mesh_idx].n_triangles);
    return !over || loader_fail(l, "%s: object '%.64s': %s", l->path, object->name, over);
}

bool loader_add_objects(loader *l, const scene_object *pattern, size_t first_mesh, size_t n_meshes)
{
    for (size_t i = 0; i < n_meshes; i++) {
        if (!spend_object(l, pattern, first_mesh + i)) return false;
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

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

bool loader_same_word(const char *a, const char *b)
{
    for (; *a && lower(*a) == lower(*b); a++) b++;
    return !*a && !*b;
}

/* By its mark; without one, by every other byte of its beginning. */
bool loader_is_utf16(const uint8_t *bytes, size_t n_bytes)
{
    if (n_bytes < 4) return false;
    if ((bytes[0] == 0xFF && bytes[1] == 0xFE) || (bytes[0] == 0xFE && bytes[1] == 0xFF)) return true;
    return (bytes[0] && !bytes[1] && bytes[2] && !bytes[3]) || (!bytes[0] && bytes[1] && !bytes[2] && bytes[3]);
}

bool loader_limit_focal(loader *l, double *focal)
{
    static const double least = 1.0 / 32, most = 255.99, degrees_per_radian = 180 / VEC_PI; /* of gn_camera.focal_q24 */
    const double was = *focal;
    if (was >= least && was <= most) return true;
    *focal = fmin(fmax(was, least), most);
    return loader_remark(l, "the camera sees %.3g degrees from top to bottom: drawn are %.3g, of 0.448 to 176 at most",
                         2 * atan(1 / was) * degrees_per_radian, 2 * atan(1 / *focal) * degrees_per_radian);
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
