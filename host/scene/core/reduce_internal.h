/* What the reduction of meshes works on: reduce.c, reduce_edges.c. */
#ifndef GNOMON_HOST_REDUCE_INTERNAL_H
#define GNOMON_HOST_REDUCE_INTERNAL_H

#include "reduce.h"

enum { REDUCE_CORNERS_MAX = 64 }; /* triangles around a vertex that may move */
#define REDUCE_NONE UINT32_MAX

/* Weighted sum of squared distances to planes n . p + d = 0: symmetric 4x4. */
typedef struct {
    double nn[6], nd[3], dd; /* nn: xx xy xz yy yz zz */
} reduce_quadric;

/* An edge that may be collapsed: point `from` would move onto `to`. It is stale if a point has got another stamp since.
 */
typedef struct {
    double cost;
    uint32_t from, to;             /* points */
    uint32_t stamp_from, stamp_to; /* of the points when the cost was found */
} reduce_move;

/* A mesh while it shrinks. Vertices of one place are one point: along seams and hard edges a point has several. */
typedef struct {
    scene_mesh *mesh;
    double *world;                 /* 3 per vertex: where it is at rest */
    uint32_t *point_of;            /* per vertex: its point, the first vertex of that place */
    bool *dead;                    /* per triangle */
    uint32_t *next;                /* per corner 3 t + i: the next of its point, or REDUCE_NONE */
    uint32_t *head, *tail, *stamp; /* per point */
    bool *locked;                  /* per point: an edge of it has more than two triangles */
    reduce_quadric *quadric;       /* per point */
} reduce_mesh;

/* The corners of live triangles at a point: how many, or REDUCE_CORNERS_MAX + 1. */
size_t reduce_corners(const reduce_mesh *m, uint32_t point, uint32_t *out);
static inline uint32_t reduce_point(const reduce_mesh *m, uint32_t corner)
{
    return m->point_of[m->mesh->idx[corner]];
}
/* The next corner of the same triangle. */
static inline uint32_t reduce_next(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/* Whether a point may move onto its neighbour; then the vertices that its corners become, corner by corner (those of
 * triangles that vanish: REDUCE_NONE). */
typedef struct {
    size_t n;
    uint32_t corner[REDUCE_CORNERS_MAX + 1], becomes[REDUCE_CORNERS_MAX + 1];
    bool keeps[REDUCE_CORNERS_MAX + 1]; /* `becomes` is its own vertex, which takes the place of another's: source */
    uint32_t source[REDUCE_CORNERS_MAX + 1];
} reduce_step;
bool reduce_allowed(const reduce_mesh *m, uint32_t from, uint32_t to, reduce_step *step);

/* Quadrics of all faces, borders and seams. */
void reduce_quadrics(reduce_mesh *m);
double reduce_cost(const reduce_mesh *m, uint32_t from, uint32_t to);

#endif
