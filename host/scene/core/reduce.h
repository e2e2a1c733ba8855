/* Fewer triangles: meshes reduced by edge collapse with quadric errors. */
#ifndef GNOMON_HOST_REDUCE_H
#define GNOMON_HOST_REDUCE_H

#include "model.h"

typedef struct {
    size_t n_before, n_after; /* triangles of the meshes that objects of the file have */
    double off;               /* the farthest that a surface moved, in the scene's units at rest; see reduce_distance */
    double off_share;         /* the same of the diagonal of the box around that mesh */
    size_t mesh_idx;          /* which */
    size_t n_queued;          /* work: moves that were weighed */
    size_t n_compared;        /* and of measuring `off`: see reduce_distance */
} reduce_result;

/* Reduces the meshes together to at most n_triangles, where the scene stays what it is: no hole opens or closes,
 * borders move along themselves, seams of texture coordinates stay seams, and every vertex that is left is one of the
 * file's, with its joints and weights. So it may end above n_triangles. Returns 0; -1 if memory runs out (then the
 * scene can only be freed). */
int reduce_scene(scene *s, size_t n_triangles, reduce_result *out);

/* A surface: corners of triangles, which point into positions, 3 per vertex. */
typedef struct {
    const double *pos;
    const uint32_t *idx;
    size_t n_triangles;
} reduce_surface;

/* The largest distance from points of a surface (corners and middles of its triangles) to the other: about the
 * one-sided Hausdorff distance. -1 if memory runs out. *n_compared grows by the boxes and triangles looked at. */
double reduce_distance(const reduce_surface *from, const reduce_surface *to, size_t *n_compared);

#endif
