/* The rectangle of a screen tile in the picture. */
#ifndef GN_SCREEN_RECT_H
#define GN_SCREEN_RECT_H

#include "gnomon.h"

/* The pixels of screen tile `tile_idx`, cut to the picture; tiles are counted row by row. */
gn_rect gn_screen_rect(const gn_frame *frame, uint32_t tile_idx);

#endif
