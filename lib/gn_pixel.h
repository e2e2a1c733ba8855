/* Linear colour to output pixels (R5, M7). */
#ifndef GN_PIXEL_H
#define GN_PIXEL_H

#include "gnomon.h"

/* 65535 * srgb(x), x in Q20 clamped to 1; error below 1.5 LSB. */
uint32_t gn_srgb_encode(uint32_t linear_q20);

/* Encodes and stores one pixel of the picture's format at pixel index i of the buffer. */
void gn_pixel_store(const gn_frame *frame, uint32_t *buffer, int32_t i, const uint32_t linear_q20[3]);

#endif
