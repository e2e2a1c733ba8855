/* Loads Wavefront OBJ with its materials into the scene that is being built. False once the error is written. */
#ifndef GNOMON_HOST_OBJ_LOAD_H
#define GNOMON_HOST_OBJ_LOAD_H

#include "../core/loader.h"

/* The file's bytes, a zero behind them. They are changed. */
bool obj_load(loader *l, uint8_t *bytes, size_t n_bytes);

#endif
