/* Linear colour to output pixels (R5, M7). */
#ifndef GN_PIXEL_H
#define GN_PIXEL_H

#include "gnomon.h"

/* 65535 * srgb(x), x in Q20 clamped to 1; error below 1.5 LSB. */
uint32_t gn_srgb_encode(uint32_t linear_q20);

/* Encodes a colour as one pixel of the picture's format: RGB565, or red | green << 8 | blue << 16. */
uint32_t gn_pixel_pack(const gn_frame *frame, const uint32_t linear_q20[3]);

/* Stores a packed pixel n times from pixel index i of the buffer on. */
void gn_pixel_fill(const gn_frame *frame, uint32_t *buffer, int32_t i, int32_t n, uint32_t packed);

#endif
