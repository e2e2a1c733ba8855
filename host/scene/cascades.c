/* Where cascades end unless the scene says so (D3). */
#include <string.h>

#include "scene.h"

void scene_default_ratios(scene_shadow *shadow)
{
    static const double ratios[4][3] = {{1, 1, 1}, {0.25, 1, 1}, {0.1, 0.25, 1}, {0.1, 0.25, 0.5}};
    memcpy(shadow->cascade_ratio, ratios[shadow->n_cascades - 1], sizeof ratios[0]);
}
