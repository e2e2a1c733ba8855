/* The ground of the demo scene, of small triangles, and levels of its picture as light. */
#ifndef FINE_GROUND_H
#define FINE_GROUND_H

#include <math.h>

#include "light_scene.h"

enum { FINE_QUADS = 30, FINE_ROW = FINE_QUADS + 1 };

/* The same mesh each time. */
static inline const gn_mesh *fine_ground(void)
{
    static int32_t pos[3 * FINE_ROW * FINE_ROW];
    static uint16_t idx[6 * FINE_QUADS * FINE_QUADS];
    static const gn_mesh mesh = {.pos = pos,
                                 .idx = idx,
                                 .n_vertices = FINE_ROW * FINE_ROW,
                                 .n_triangles = 2 * FINE_QUADS * FINE_QUADS,
                                 .pos_frac_bits = 16};
    uint16_t *to = idx;
    for (int i = 0; i < FINE_ROW; i++)
        for (int k = 0; k < FINE_ROW; k++) {
            int32_t *p = &pos[3 * (FINE_ROW * i + k)];
            p[0] = GN_Q16(12) / FINE_QUADS * k - GN_Q16(6);
            p[2] = GN_Q16(12) / FINE_QUADS * i - GN_Q16(6);
        }
    for (int i = 0; i < FINE_QUADS; i++)
        for (int k = 0; k < FINE_QUADS; k++) {
            const int a = FINE_ROW * i + k, c = a + FINE_ROW, quad[6] = {a, c, c + 1, a, c + 1, a + 1};
            for (int j = 0; j < 6; j++) *to++ = (uint16_t)quad[j];
        }
    return &mesh;
}

/* Of a level as stored; 1: white. */
static inline double light_of(uint8_t level)
{
    const double v = level / 255.0;
    if (!GN_SRGB) return v;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

#endif
