/* Where an animation takes objects, joints and lights, frame by frame: what a tool adds to a scene, or fits, is the
 * same in all of it. */
#ifndef GNOMON_HOST_POSES_H
#define GNOMON_HOST_POSES_H

#include "model.h"

typedef struct {
    size_t n; /* 0: nothing moves */
    size_t n_affines;
    size_t n_objects; /* of the file: what is added to them later, behind them, stands still */
    scene_affine
        *affines; /* per pose, object by object: its to_world and its joints; behind the last pose the scene's */
    size_t n_lights;
    double (*light)[3];   /* positions, per pose, light by light of the file */
    scene_affine *camera; /* per pose, of the file's; NULL: it has none */
} scene_poses;

/* Of one pose of this scene. */
size_t poses_count_affines(const scene *s);
void poses_store(const scene_poses *p, size_t pose_idx, const scene *s);
/* pose_idx n: the scene's own. */
void poses_apply(const scene_poses *p, size_t pose_idx, scene *s);

#endif
