// OpenImageIO behind a C interface.
#include "oiio_shim.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <cstdio>

using namespace OIIO;

extern "C" unsigned char *oiio_read_rgb8(const char *path, int *w, int *h, char *error, int error_bytes)
{
    ImageBuf image(path);
    if (!image.read(0, 0, true, TypeDesc::UINT8) || image.nchannels() < 3) {
        std::snprintf(error, error_bytes, "%s", image.geterror().c_str());
        return nullptr;
    }
    *w = image.spec().width;
    *h = image.spec().height;
    unsigned char *pixels = new unsigned char[3 * size_t(*w) * size_t(*h)];
    ROI roi(0, *w, 0, *h, 0, 1, 0, 3);
    image.get_pixels(roi, TypeDesc::UINT8, pixels);
    return pixels;
}

extern "C" void oiio_free(unsigned char *pixels)
{
    delete[] pixels;
}

extern "C" int oiio_compare(const char *a, const char *b, double *mean, double *rms, double *largest)
{
    ImageBuf left(a), right(b);
    if (!left.read(0, 0, true, TypeDesc::FLOAT) || !right.read(0, 0, true, TypeDesc::FLOAT)) return -1;
    ImageBufAlgo::CompareResults result = ImageBufAlgo::compare(left, right, 0.0f, 0.0f);
    *mean = result.meanerror;
    *rms = result.rms_error;
    *largest = result.maxerror;
    return result.error ? -1 : 0;
}
