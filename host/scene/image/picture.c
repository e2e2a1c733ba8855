#include "picture.h"

#include "jpeg.h"
#include "png.h"

bool picture_is(const uint8_t *bytes, size_t n_bytes)
{
    return png_is(bytes, n_bytes) || jpeg_is(bytes, n_bytes);
}

bool picture_measure(const uint8_t *bytes, size_t n_bytes, int *w, int *h, size_t *n_work)
{
    return jpeg_is(bytes, n_bytes) ? jpeg_measure(bytes, n_bytes, w, h, n_work)
                                   : png_measure(bytes, n_bytes, w, h, n_work);
}

bool picture_decode_rgba8(const uint8_t *bytes, size_t n_bytes, int max_side, rgba8_picture *out, char *error,
                          size_t error_bytes)
{
    return jpeg_is(bytes, n_bytes) ? jpeg_decode_rgba8(bytes, n_bytes, max_side, out, error, error_bytes)
                                   : png_decode_rgba8(bytes, n_bytes, max_side, out, error, error_bytes);
}
