/* Loading a scene by its file's ending. */
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

static bool load_any(loader *l)
{
    if (l->options->width <= 0 || l->options->height <= 0) {
        return loader_fail(l, "%s: the picture size %dx%d is not positive", l->path, l->options->width,
                           l->options->height);
    }
    if (ends_with(l->path, ".obj")) return obj_load(l);
    if (ends_with(l->path, ".gltf")) return gltf_load(l);
    if (ends_with(l->path, ".glb")) return gltf_load_glb(l);
    return loader_fail(l, "%s: not a scene: .gltf, .glb and .obj are read; export others as glTF", l->path);
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
