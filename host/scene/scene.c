/* Loading a scene: its first bytes tell the format, where they do not its name. */
#include "scene.h"

#include <stdlib.h>
#include <string.h>

#include "core/loader.h"
#include "core/turn.h"
#include "gltf/gltf_load.h"
#include "obj/obj_load.h"

static bool ends_with(const char *path, const char *ending)
{
    size_t n = strlen(path), n_ending = strlen(ending);
    if (n < n_ending) return false;
    for (size_t i = 0; i < n_ending; i++) {
        char c = path[n - n_ending + i];
        if (c >= 'A' && c <= 'Z') c = (char)(c - 'A' + 'a');
        if (c != ending[i]) return false;
    }
    return true;
}

/* Of the first line that is neither empty nor a comment. */
static bool begins_as_obj(const char *text, const char *end)
{
    static const char *const words[] = {"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"};
    char word[8] = "";
    for (text += strspn(text, " \t\r\n"); *text == '#'; text += strspn(text, " \t\r\n")) text += strcspn(text, "\r\n");
    const size_t n = text < end ? strcspn(text, " \t\r\n") : 0;
    if (n == 0 || n >= sizeof word) return false;
    memcpy(word, text, n);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (loader_same_word(word, words[i])) return true;
    return false;
}

typedef enum { FORMAT_GLTF, FORMAT_GLB, FORMAT_OBJ, FORMAT_UNKNOWN } format;

static format format_of_name(const char *path)
{
    if (ends_with(path, ".gltf")) return FORMAT_GLTF;
    if (ends_with(path, ".glb")) return FORMAT_GLB;
    return ends_with(path, ".obj") ? FORMAT_OBJ : FORMAT_UNKNOWN;
}

/* bytes: a zero is behind them. */
static format format_of_bytes(const uint8_t *bytes, size_t n, format named)
{
    const char *text = (const char *)bytes;
    if (n >= 4 && memcmp(bytes, "glTF", 4) == 0) return FORMAT_GLB;
    if (n >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0) text += 3; /* of UTF-8 */
    if (text[strspn(text, " \t\r\n")] == '{') return FORMAT_GLTF;
    return named != FORMAT_OBJ && begins_as_obj(text, (const char *)bytes + n) ? FORMAT_OBJ : named;
}

static bool load_any(loader *l)
{
    static const char *const names[] = {"glTF as JSON text", "glTF as binary, GLB", "OBJ"};
    const format named = format_of_name(l->path);
    uint8_t *bytes = NULL;
    size_t n_bytes = 0;
    const char *problem;
    if (l->options->width <= 0 || l->options->height <= 0) {
        return loader_fail(l, "%s: the picture size %dx%d is not positive", l->path, l->options->width,
                           l->options->height);
    }
    if (!loader_try_file(l, l->path, &bytes, &n_bytes, &problem)) return false;
    if (problem) return loader_fail(l, "%s: %s", l->path, problem);
    const format found = format_of_bytes(bytes, n_bytes, named);
    if (found == FORMAT_UNKNOWN)
        return loader_fail(l, "%s: not a scene: .gltf, .glb and .obj are read; export others as glTF", l->path);
    if (found != named && !loader_note(l, "the file is %s, whatever its name ends in", names[found])) return false;
    if (found == FORMAT_OBJ && l->options->clip)
        return loader_fail(l, "%s: there is no clip '%.60s': it has none", l->path, l->options->clip);
    if (found == FORMAT_OBJ) return obj_load(l, bytes, n_bytes);
    return found == FORMAT_GLB ? gltf_load_glb(l, bytes, n_bytes) : gltf_load(l, bytes, n_bytes);
}

int scene_load(scene *s, const char *path, const scene_options *options, char *error, size_t error_bytes)
{
    loader l = {.s = s, .options = options, .path = path, .error = error, .error_bytes = error_bytes};
    *s = (scene){0};
    if (error_bytes > 0) error[0] = '\0';
    budget_init(&l);
    bool ok = load_any(&l) && loader_add_defaults(&l);
    if (ok) scene_turn(s, options);
    loader_free_mesh_light(&l);
    arena_release(&l.memory, NULL);
    s->n_file_notes = s->n_notes;
    if (!ok) scene_free(s);
    return ok ? 0 : -1;
}
