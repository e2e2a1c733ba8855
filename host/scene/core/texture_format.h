/* What small textures leave of an image (M11): fewer texels, and fewer values of each. */
#ifndef GNOMON_TEXTURE_FORMAT_H
#define GNOMON_TEXTURE_FORMAT_H

#include "model.h"

extern const char *const texture_format_names[]; /* in the order of scene_texture_format; the last is NULL */

/* Values that a channel (0..3: red..alpha) of a format has, less one. */
int texture_format_levels(scene_texture_format format, int channel);

/* Bits of a texel. */
int texture_format_bits(scene_texture_format format);

/* Rounds every texel to what the format has; palettes are chosen by the median cut. What a texel is off by then is
 * noted in the texture, in steps of 255. False: out of memory. */
bool texture_convert(scene_texture *texture, scene_texture_format format);

/* Shrinks the texture so that no side has more texels than that: means in linear light, colours weighed by alpha; of
 * data, plain numbers. False: out of memory. */
bool texture_shrink(scene_texture *texture, int side, bool is_data);

#endif
