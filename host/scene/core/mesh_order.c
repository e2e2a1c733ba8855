/* The order of a mesh's triangles: neighbours lie near each other in the list, so that vertices are found in caches,
 * and groups of triangles (triangle_groups) are small on the screen. */
#include "loader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Smaller meshes keep the order of their file. */
enum { ORDER_MIN_TRIANGLES = 1024, ORDER_BITS = 10 };

typedef struct {
    uint32_t place; /* along the curve */
    uint32_t triangle_idx;
} ordered_triangle;

static int compare_places(const void *a, const void *b)
{
    const ordered_triangle *x = a, *y = b;
    if (x->place != y->place) return x->place < y->place ? -1 : 1;
    return (x->triangle_idx > y->triangle_idx) - (x->triangle_idx < y->triangle_idx);
}

/* Sums of a triangle's corners, per axis. */
static void sum_corners(double sum[3], const scene_mesh *input, const uint32_t *triangle)
{
    for (int k = 0; k < 3; k++) {
        sum[k] = 0;
        for (int i = 0; i < 3; i++) sum[k] += input->pos[3 * (size_t)triangle[i] + (size_t)k];
    }
}

/* A Z-order (Morton) curve through a cube: bits of the three coordinates in turn. */
static uint32_t place_on_curve(const double at[3], const double low[3], double size)
{
    uint32_t place = 0, cell[3];
    for (int k = 0; k < 3; k++) cell[k] = (uint32_t)((at[k] - low[k]) / size * ((1 << ORDER_BITS) - 1));
    for (int bit = ORDER_BITS - 1; bit >= 0; bit--)
        for (int k = 0; k < 3; k++) place = place << 1 | (cell[k] >> bit & 1);
    return place;
}

const uint32_t *mesh_order(loader *l, const scene_mesh *input, const uint32_t *idx, size_t n_triangles)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, at[3], size = 0;
    if (n_triangles < ORDER_MIN_TRIANGLES) return idx;
    ordered_triangle *order = loader_alloc(l, n_triangles, sizeof *order);
    uint32_t *out = loader_alloc(l, n_triangles, 3 * sizeof *out);
    if (!order || !out) return NULL;
    for (size_t i = 0; i < n_triangles; i++) {
        sum_corners(at, input, idx + 3 * i);
        for (int k = 0; k < 3; k++) low[k] = fmin(low[k], at[k]);
    }
    for (size_t i = 0; i < n_triangles; i++) {
        sum_corners(at, input, idx + 3 * i);
        for (int k = 0; k < 3; k++) size = fmax(size, at[k] - low[k]);
    }
    for (size_t i = 0; i < n_triangles; i++) {
        sum_corners(at, input, idx + 3 * i);
        order[i].triangle_idx = (uint32_t)i;
        order[i].place = size > 0 ? place_on_curve(at, low, size) : 0;
    }
    qsort(order, n_triangles, sizeof *order, compare_places);
    for (size_t i = 0; i < n_triangles; i++)
        memcpy(out + 3 * i, idx + 3 * (size_t)order[i].triangle_idx, 3 * sizeof *out);
    return out;
}
