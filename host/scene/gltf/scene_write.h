/* Writes a scene as glTF 2.0: what scene_load makes of the file is that scene again, but for positions that no float
 * holds. */
#ifndef GNOMON_HOST_SCENE_WRITE_H
#define GNOMON_HOST_SCENE_WRITE_H

#include "../core/model.h"

/* A setting of extras.gnomon beside those that say what the scene itself holds; in order. */
typedef struct {
    const char *key, *value;
} scene_write_setting;

/* path ends with .glb: one binary file; else JSON with the buffer inside as base64. Animation is not part of a scene:
 * the file shows what the scene shows. Returns 0; -1 with one line in error. */
int scene_write(const scene *s, const char *path, const char *comment, const scene_write_setting *settings,
                size_t n_settings, char *error, size_t error_bytes);

#endif
