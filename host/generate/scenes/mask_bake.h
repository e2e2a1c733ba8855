/* Shadow masks of static meshes, for the scene generator: per vertex and channel the share of a light that arrives, by
 * rays. */
#ifndef GNOMON_HOST_MASK_BAKE_H
#define GNOMON_HOST_MASK_BAKE_H

#include "mesh_builder.h"

typedef struct {
    unsigned channel; /* 0 ... 3 */
    bool directional;
    mesh_point at;        /* the light's position; directional: towards the light, unit length */
    double near_distance; /* nothing nearer to the light casts */
} mask_light;

/* Fills mask of the receivers, meshes in world coordinates: 0 (dark) ... 255 (lit), 255 in channels without a light. A
 * vertex takes the mean over points of its triangles near it: what is interpolated between vertices had better be
 * smooth. All faces of the casters block, from either side. */
void mask_bake(mesh_builder *const *receivers, size_t n_receivers, mesh_builder *const *casters, size_t n_casters,
               const mask_light *lights, size_t n_lights);

#endif
