/* OpenImageIO, as far as the tests need it, from C. */
#ifndef GNOMON_TESTS_OIIO_SHIM_H
#define GNOMON_TESTS_OIIO_SHIM_H

#ifdef __cplusplus
extern "C" {
#endif

/* Reads the first three channels as 8 bits. Returns new[]-ed pixels (free with oiio_free), or NULL with a message. */
unsigned char *oiio_read_rgb8(const char *path, int *w, int *h, char *error, int error_bytes);
void oiio_free(unsigned char *pixels);

/* Two picture files over values 0..1: mean, RMS and largest difference over all channels, where that is, and in how
 * many pixels some channel differs by more than the threshold. 0, or -1. */
typedef struct {
    double mean, rms, largest;
    int x, y;
    long n_failing;
} oiio_result;
int oiio_compare(const char *a, const char *b, double threshold, oiio_result *out);

#ifdef __cplusplus
}
#endif

#endif
