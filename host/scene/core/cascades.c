/* Where cascades end unless the scene says so (D3). */
#include <math.h>

#include "model.h"

double scene_share(double v)
{
    return floor(v * 65536 + 0.5) / 65536;
}

void scene_default_ratios(scene_shadow *shadow)
{
    static const double ratios[4][3] = {{1, 1, 1}, {0.25, 1, 1}, {0.1, 0.25, 1}, {0.1, 0.25, 0.5}};
    for (int i = 0; i < 3; i++) shadow->cascade_ratio[i] = scene_share(ratios[shadow->n_cascades - 1][i]);
}
