/* The triangles of a grid of vertices, for tests of what covers every place exactly once. */
#ifndef GNOMON_TESTS_GRID_MESH_H
#define GNOMON_TESTS_GRID_MESH_H

#include <stdint.h>
#include <string.h>

enum { GRID = 7, GRID_VERTICES = (GRID + 1) * (GRID + 1), GRID_TRIANGLES = 2 * GRID * GRID };

static inline void grid_indices(uint32_t idx[3 * GRID_TRIANGLES])
{
    for (uint32_t y = 0; y < GRID; y++)
        for (uint32_t x = 0; x < GRID; x++) {
            const uint32_t a = y * (GRID + 1) + x, b = a + 1, c = a + GRID + 1, d = c + 1;
            const uint32_t either[2][6] = {{a, c, b, b, c, d}, {a, c, d, a, d, b}};
            memcpy(idx + 6 * (y * GRID + x), either[(x + y) & 1], sizeof either[0]);
        }
}

#endif
