// OpenImageIO behind a C interface.
#include "oiio_shim.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <cstdio>

using namespace OIIO;

// Files are opened one by one, not through the image cache: tests write the same name again.
extern "C" unsigned char *oiio_read_rgb8(const char *path, int *w, int *h, char *error, int error_bytes)
{
    auto in = ImageInput::open(path);
    if (!in || in->spec().nchannels != 3) {
        std::snprintf(error, error_bytes, "%s", in ? "not three channels" : geterror().c_str());
        return nullptr;
    }
    *w = in->spec().width;
    *h = in->spec().height;
    unsigned char *pixels = new unsigned char[3 * size_t(*w) * size_t(*h)];
    if (in->read_image(0, 0, 0, 3, TypeDesc::UINT8, pixels)) return pixels;
    std::snprintf(error, error_bytes, "%s", in->geterror().c_str());
    delete[] pixels;
    return nullptr;
}

extern "C" void oiio_free(unsigned char *pixels)
{
    delete[] pixels;
}

extern "C" int oiio_compare(const char *a, const char *b, double threshold, oiio_result *out)
{
    ImageCache::create(true)->invalidate_all(true);
    ImageBuf left(a), right(b);
    if (!left.read(0, 0, true, TypeDesc::FLOAT) || !right.read(0, 0, true, TypeDesc::FLOAT)) return -1;
    if (left.spec().width != right.spec().width || left.spec().height != right.spec().height) return -1;
    ImageBufAlgo::CompareResults result = ImageBufAlgo::compare(left, right, float(threshold), float(threshold));
    out->mean = result.meanerror;
    out->rms = result.rms_error;
    out->largest = result.maxerror;
    out->x = result.maxx;
    out->y = result.maxy;
    out->n_failing = long(result.nfail);
    return 0;
}
