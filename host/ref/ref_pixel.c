/* Linear radiance to what is shown (MODEL 3). Rounding to the levels of an output is left to the caller. */
#include "ref_internal.h"

/* IEC 61966-2-1 [M7] */
double ref_srgb_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

double ref_srgb_decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

static double encode(double linear, bool srgb)
{
    const double level = clamp(linear, 0.0, 1.0);
    return srgb ? ref_srgb_encode(level) : level;
}

/* The linear light of the nearest level. */
static double rounded(double linear, double levels, bool srgb)
{
    const double level = floor(encode(linear, srgb) * levels + 0.5) / levels;
    return srgb ? ref_srgb_decode(level) : level;
}

/* From the farthest to the nearest. [M8] */
void ref_shown(const ref_picture *p, size_t pixel, const double levels[3], bool srgb, double rgb[3])
{
    const ref_layer *layer = p->n_layers ? p->layer + pixel * (size_t)p->n_layers : NULL;
    for (int c = 0; c < 3; c++) rgb[c] = p->rgb[3 * pixel + (size_t)c];
    if (!layer || !(layer[0].alpha > 0.0)) return;
    for (int c = 0; c < 3; c++) {
        double light = p->solid[3 * pixel + (size_t)c];
        for (int k = p->n_layers - 1; k >= 0; k--)
            if (layer[k].alpha > 0.0)
                light = layer[k].alpha * rounded(layer[k].rgb[c], levels[c], srgb) +
                        (1.0 - layer[k].alpha) * rounded(light, levels[c], srgb);
        rgb[c] = encode(light, srgb);
    }
}

/* Not rounded: the caller has the levels of its output format. [R5] */
void ref_encode_pixels(ref_frame *frame)
{
    const size_t n_channels = 3 * (size_t)frame->picture->width * (size_t)frame->picture->height;
    for (size_t i = 0; i < n_channels; i++)
        frame->picture->rgb[i] = encode(frame->picture->rgb[i], frame->options->srgb);
}
