/* Types that every stage uses. Private, as all gn_*_types.h are: gn_state.h combines them into a renderer's state.
 */
#ifndef GN_BASE_TYPES_H
#define GN_BASE_TYPES_H

#include <stdint.h>

/* A block float: a positive number mant * 2^exp, mant in [2^31, 2^32). See gn_math.h. */
typedef struct {
    uint32_t mant;
    int32_t exp;
} gn_bfloat;

/* Pixels whose centres lie in the triangle's bounding box, cut to the picture: x0 <= x < x1, y0 <= y < y1. */
typedef struct {
    int32_t x0, y0, x1, y1;
} gn_rect;

/* A colour in linear light, 65535: 1; red is the lower half of its word. */
typedef struct {
    uint32_t red_green, blue;
} gn_texel_rgb;

#endif
