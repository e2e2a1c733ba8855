/* Loads glTF 2.0 into the scene that is being built. False once the error is written. */
#ifndef GNOMON_HOST_GLTF_LOAD_H
#define GNOMON_HOST_GLTF_LOAD_H

#include "../core/loader.h"

/* The file's bytes: JSON text, and the binary container. */
bool gltf_load(loader *l, const uint8_t *file, size_t n_file);
bool gltf_load_glb(loader *l, const uint8_t *file, size_t n_file);

#endif
