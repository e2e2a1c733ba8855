/* Screen tiles: how many there are, and where their finished pixels lie. */
#ifndef GN_SCREEN_TYPES_H
#define GN_SCREEN_TYPES_H

#include "base/gn_base_types.h"

/* Capacity: tiles per row and column of the largest picture that is configured, tiles of a picture, pixels of a tile.
 * The host, where sizes of pictures and tiles are set at run time, has room for any. */
#define GN_TILES_X_MAX ((GN_MAX_WIDTH + GN_TILE_WIDTH - 1) / GN_TILE_WIDTH)
#define GN_TILES_Y_MAX ((GN_MAX_HEIGHT + GN_TILE_HEIGHT - 1) / GN_TILE_HEIGHT)
#if GN_RUNTIME_KNOBS
#define GN_TILES_MAX       16384
#define GN_TILE_PIXELS_MAX 65536
#else
#define GN_TILES_MAX       (GN_TILES_X_MAX * GN_TILES_Y_MAX)
#define GN_TILE_PIXELS_MAX (GN_TILE_WIDTH * GN_TILE_HEIGHT)
#endif

/* Raw views of the host tool store 32 bits, RGB888 stores 3 bytes; compact arithmetic has RGB565 alone. */
#define GN_PIXEL_BYTES_MAX (GN_RAW_VIEWS ? 4 : GN_COMPACT ? 2 : 3)

/* Finished pixels of one screen tile in the picture's format (gn_format), row by row; rows of 4 and 1 bits begin at a
 * byte. */
typedef union {
    uint8_t bytes[GN_TILE_PIXELS_MAX * GN_PIXEL_BYTES_MAX];
    uint16_t rgb565[GN_TILE_PIXELS_MAX];
    uint32_t raw[GN_TILE_PIXELS_MAX * GN_PIXEL_BYTES_MAX / 4]; /* GN_FORMAT_RAW32; or two pixels of RGB565 at once */
} gn_tile_pixels;

/* Where a screen tile's pixels are stored. */
typedef struct {
    gn_tile_pixels *pixels;
    int32_t width;  /* pixels per row of the tile */
    int32_t x0, y0; /* the tile's first pixel in the picture, as the dither's pattern is fixed to the picture */
} gn_pixel_rows;

#endif
