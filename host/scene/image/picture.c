#include "picture.h"
#include "jpeg.h"

bool picture_is(const uint8_t *bytes, size_t n_bytes)
{
    return png_is(bytes, n_bytes) || jpeg_is(bytes, n_bytes);
}

bool picture_decode_rgba8(const uint8_t *bytes, size_t n_bytes, int max_side, png_picture *out, char *error,
                          size_t error_bytes)
{
    return jpeg_is(bytes, n_bytes) ? jpeg_decode_rgba8(bytes, n_bytes, max_side, out, error, error_bytes)
                                   : png_decode_rgba8(bytes, n_bytes, max_side, out, error, error_bytes);
}
