/* A picture file of any format that is read. Which one it is its first bytes say, not its name. */
#ifndef GNOMON_HOST_IMAGE_PICTURE_H
#define GNOMON_HOST_IMAGE_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rgba8.h"

#define PICTURE_FORMATS "PNG and JPEG"

/* Whether the bytes begin like such a file. */
bool picture_is(const uint8_t *bytes, size_t n_bytes);

/* As png_measure. */
bool picture_measure(const uint8_t *bytes, size_t n_bytes, int *w, int *h, size_t *n_work);

/* As png_decode_rgba8. */
bool picture_decode_rgba8(const uint8_t *bytes, size_t n_bytes, int max_side, rgba8_picture *out, char *error,
                          size_t error_bytes);

#endif
