/* A picture as it is decoded, whatever its file is. */
#ifndef GNOMON_HOST_IMAGE_RGBA8_H
#define GNOMON_HOST_IMAGE_RGBA8_H

#include <stdint.h>

typedef struct {
    int w, h;
    int depth;     /* bits per channel in the file */
    uint8_t *rgba; /* 4 * w * h bytes to free(), rows from the top */
} rgba8_picture;

#endif
