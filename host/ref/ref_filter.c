/* Attenuation: the shadow compare and its filters (DESIGN 1.6, rows F1 to F3). */
#include "ref_internal.h"

/* Integral of the tent max(0, h - |t|) / h^2 from -h to x: 0 ... 1. */
static double tent_integral(double x, double h)
{
    if (x <= -h) return 0.0;
    if (x >= h) return 1.0;
    return x <= 0.0 ? (h + x) * (h + x) / (2.0 * h * h) : 1.0 - (h - x) * (h - x) / (2.0 * h * h);
}

double ref_tent_weight(int filter_size, double centre, int texel)
{
    const double h = filter_size / 2.0;
    return tent_integral(texel + 1 - centre, h) - tent_integral(texel - centre, h);
}

/* Weight of texel i along one axis around x; every filter of DESIGN 1.6 is separable. */
static double axis_weight(scene_filter filter, double x, int i)
{
    switch (filter) {
    case SCENE_FILTER_HARD:
        return (int)floor(x) == i ? 1.0 : 0.0;
    case SCENE_FILTER_2X2:
        return fmax(0.0, 1.0 - fabs(i + 0.5 - x));
    case SCENE_FILTER_3X3:
        return ref_tent_weight(3, x, i);
    case SCENE_FILTER_5X5:
        return ref_tent_weight(5, x, i);
    case SCENE_FILTER_DISK:
        break;
    case SCENE_FILTER_7X7:
        return ref_tent_weight(7, x, i);
    }
    return 0.0;
}

/* Indices are clamped to the tile (P8). */
static double compare(const ref_light_view *view, int i, int j, double d)
{
    const int last = view->tile_texels - 1;
    const int u = i < 0 ? 0 : i > last ? last : i, v = j < 0 ? 0 : j > last ? last : j;
    return d <= view->depth[(size_t)v * (size_t)view->tile_texels + (size_t)u] ? 1.0 : 0.0;
}

double ref_attenuation(const ref_light_view *view, scene_filter filter, double u, double v, double d)
{
    const int reach = ref_filter_index(filter) + 1;
    /* Further out than its reach a filter meets the border texel alone: clamping there only keeps the int in range. */
    d = fmin(d, view->depth_range); /* beyond the far end an empty texel still lets it be lit */
    const double margin = 2.0 * reach;
    const double x = clamp(u, -margin, view->tile_texels + margin), y = clamp(v, -margin, view->tile_texels + margin);
    const int i0 = (int)floor(x), j0 = (int)floor(y);
    double sum = 0.0;
    for (int j = j0 - reach; j <= j0 + reach; j++) {
        const double row = axis_weight(filter, y, j);
        if (!(row > 0.0)) continue;
        for (int i = i0 - reach; i <= i0 + reach; i++) {
            const double weight = row * axis_weight(filter, x, i);
            if (weight > 0.0) sum += weight * compare(view, i, j, d);
        }
    }
    return fmin(sum, 1.0);
}
