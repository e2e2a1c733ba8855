/* What small textures leave of an image (M11): fewer texels, and fewer values of each. */
#ifndef GNOMON_TEXTURE_FORMAT_H
#define GNOMON_TEXTURE_FORMAT_H

#include "model.h"

extern const char *const texture_format_names[]; /* in the order of scene_texture_format; the last is NULL */

/* Values that a channel (0..3: red..alpha) of a format has, less one. */
int texture_format_levels(scene_texture_format format, int channel);

/* Bits of a texel. */
int texture_format_bits(scene_texture_format format);

/* Texels of the first n levels: each is half the size of the one before, rounded down, at least 1. */
size_t texture_level_texels(const scene_texture *texture, int n);

/* Levels that it has: 1 without smaller ones. */
int texture_level_count(const scene_texture *texture);

/* Makes the smaller levels, or takes them away: means in linear light, colours weighed by alpha, of the first level
 * each, rounded to the texture's format. False: out of memory. */
bool texture_set_levels(scene_texture *texture, bool mipmapped);

/* Rounds every texel to what the format has; palettes are chosen by the median cut. What a texel is off by then is
 * noted in the texture, in steps of 255. False: out of memory. */
bool texture_convert(scene_texture *texture, scene_texture_format format);

/* What texels are off by, in steps of 255. */
typedef struct {
    double max, rms;
} texture_error;

/* Shrinks the texture, and makes its levels anew, so that no side has more texels than that: means in linear light,
 * colours weighed by alpha; of data, plain numbers. *error, or NULL: how far each of the texels before is from the one
 * that its middle lies in now, both as what their alpha leaves. False: out of memory. */
bool texture_shrink(scene_texture *texture, int side, bool is_data, texture_error *error);

#endif
