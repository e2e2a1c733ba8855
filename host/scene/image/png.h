/* PNG files: 8-bit RGB and RGBA out; every kind in. 16 bits are rounded to 8; gamma and colour profiles are ignored: it
 * is all sRGB. */
#ifndef GNOMON_HOST_PNG_H
#define GNOMON_HOST_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "rgba8.h"

/* rgb: 3 * w * h bytes, rows from the top. Returns 0; on failure -1, with one line in error. A file that could only be
 * written in part stays: path may be a device or a pipe, which must not be removed. */
int png_write_rgb8(const char *path, int w, int h, const uint8_t *rgb, char *error, size_t error_bytes);

/* An animated PNG file, frame by frame: what does not know animations shows the first. */
typedef struct {
    FILE *file;
    int w, h;
    unsigned delay_us;  /* from one frame to the next */
    uint32_t n_chunks;  /* of the animation so far: they are numbered */
    uint8_t *shown_rgb; /* the last frame: of the next only what differs is written */
    bool failed;
} png_animation;

/* Each 0, or -1 with errno. After a failure end it, too. */
int png_animation_begin(png_animation *a, const char *path, int w, int h, uint32_t n_frames, unsigned delay_us);
int png_animation_add(png_animation *a, const uint8_t *rgb);
int png_animation_end(png_animation *a);

/* The bytes of a file with this picture, 4 * w * h bytes in, to free(); NULL if memory runs out or that is no size. */
uint8_t *png_pack_rgba8(int w, int h, const uint8_t *rgba, size_t *n_out);

/* Without alpha. 3 * w * h bytes to free(), or NULL with one line in error. */
uint8_t *png_read_rgb8(const char *path, int *w, int *h, char *error, size_t error_bytes);

/* False, with out->rgba NULL and one line in error (without a place), if the bytes are no valid PNG file or a side is
 * longer. */
bool png_decode_rgba8(const uint8_t *bytes, size_t n_bytes, int max_side, rgba8_picture *out, char *error,
                      size_t error_bytes);

/* Sides as its head gives them, however long, and the most memory that decoding takes beside the picture itself;
 * without looking further. False: no PNG file, or a head that is damaged. */
bool png_measure(const uint8_t *bytes, size_t n_bytes, int *w, int *h, size_t *n_work);

/* Whether the bytes begin like a PNG file. */
bool png_is(const uint8_t *bytes, size_t n_bytes);

#endif
