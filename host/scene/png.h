/* PNG files: 8-bit RGB out; 8-bit grey, grey + alpha, palette, RGB and RGBA, not interlaced, in. Alpha is dropped. */
#ifndef GNOMON_HOST_PNG_H
#define GNOMON_HOST_PNG_H

#include <stddef.h>
#include <stdint.h>

/* rgb: 3 * w * h bytes, rows from the top. Returns 0; on failure -1, with one line in error. A file that could only be written in
 * part stays: path may be a device or a pipe, which must not be removed. */
int png_write_rgb8(const char *path, int w, int h, const uint8_t *rgb, char *error, size_t error_bytes);

/* The bytes of a file with this picture, 4 * w * h bytes in, to free(); NULL if memory runs out or that is no size. */
uint8_t *png_pack_rgba8(int w, int h, const uint8_t *rgba, size_t *n_out);

/* 3 * w * h bytes to free(), or NULL with one line in error. */
uint8_t *png_read_rgb8(const char *path, int *w, int *h, char *error, size_t error_bytes);

#endif
