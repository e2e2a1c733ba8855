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

/* Part of a row of pixels, each with a node of its own. A textured surface multiplies colours by those of texels,
 * 65535: 1; its nodes may be 2^spacing_log2 pixels apart, with colours that are linear in between. */
typedef struct {
    const int32_t (*node)[3];  /* Q24, from -5 2^27 to 9 2^27 */
    int32_t spacing_log2;      /* without a texture 0 */
    const gn_texel_rgb *texel; /* of each pixel; NULL: no texture */
    int inside;                /* with a texture: all nodes are in 2^-18 .. 1, so that nothing needs a clamp */
#if GN_GLOW_APART
#if GN_GLOW_TEXTURES
    const gn_texel_rgb *glow; /* what that is multiplied by, pixel by pixel, or NULL */
#endif
    int32_t glow_q24[3]; /* textured: what is added to the product, 0 .. 2^27 */
#endif
} gn_pixel_line;

#endif
