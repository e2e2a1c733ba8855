/* JPEG files (ITU T.81) in: 8 bits a sample, coded by Huffman, sequential or progressive. Grey, YCbCr, RGB, and CMYK or
 * YCCK as Adobe writes them. Colour profiles and the orientation of EXIF are ignored: it is all sRGB, as it is stored.
 *
 * Colour at fewer places than brightness is interpolated linearly between the centres of its samples. All is integers:
 * every host gets the same pixels. */
#ifndef GNOMON_HOST_JPEG_H
#define GNOMON_HOST_JPEG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rgba8.h"

/* Whether the bytes begin like a JPEG file. */
bool jpeg_is(const uint8_t *bytes, size_t n_bytes);

/* Sides as its head gives them, however long, and the most memory that decoding takes beside the picture itself;
 * without looking further. False: no JPEG file that is read, or a head that is damaged. */
bool jpeg_measure(const uint8_t *bytes, size_t n_bytes, int *w, int *h, size_t *n_work);

/* As png_decode_rgba8; opaque. */
bool jpeg_decode_rgba8(const uint8_t *bytes, size_t n_bytes, int max_side, rgba8_picture *out, char *error,
                       size_t error_bytes);

#endif
