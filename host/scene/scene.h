/* Scene files: loading one, whatever its format. The scene itself: core/model.h. */
#ifndef GNOMON_HOST_SCENE_H
#define GNOMON_HOST_SCENE_H

#include "core/model.h"

/* Loads OBJ, glTF or GLB: the first bytes tell which, else the file's ending. Returns 0; on failure returns -1 with one
 * line in error (what, and where: file, line or JSON path) and leaves *s empty. */
int scene_load(scene *s, const char *path, const scene_options *options, char *error, size_t error_bytes);

#endif
