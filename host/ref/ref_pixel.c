/* Linear radiance to what is shown (MODEL 3). Rounding to the levels of an output is left to the caller. */
#include "ref_internal.h"

/* IEC 61966-2-1 [M7] */
double ref_srgb_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

/* Not rounded: the caller has the levels of its output format. [R5] */
void ref_encode_pixels(ref_frame *frame)
{
    const size_t n_channels = 3 * (size_t)frame->picture->width * (size_t)frame->picture->height;
    for (size_t i = 0; i < n_channels; i++) {
        const double level = clamp(frame->picture->rgb[i], 0.0, 1.0);
        frame->picture->rgb[i] = frame->options->srgb ? ref_srgb_encode(level) : level;
    }
}
