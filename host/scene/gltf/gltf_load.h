/* Loads glTF 2.0 into the scene that is being built. False once the error is written. */
#ifndef GNOMON_HOST_GLTF_LOAD_H
#define GNOMON_HOST_GLTF_LOAD_H

#include "../core/loader.h"

bool gltf_load(loader *l);     /* .gltf */
bool gltf_load_glb(loader *l); /* .glb */

#endif
