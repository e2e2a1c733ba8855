/* Compiled fits (D12): boxes of directional views that hold what a whole animation sees. */
#ifndef GNOMON_FITS_H
#define GNOMON_FITS_H

#include "tool.h"

/* Of a scene whose fit is compiled: which is tight afterwards, with the boxes that were found, and notes of those that
 * were not. Assets and what is open get none. -1 with one line in error. */
int fits_compile(const tool_options *o, const char *const *sets, int n_sets, scene *s, char *error, size_t error_bytes);

#endif
