/* The box and sphere of a scene's vertices, in world space. */
#ifndef GNOMON_HOST_BOUNDS_H
#define GNOMON_HOST_BOUNDS_H

#include "poses.h"

typedef struct {
    double low[3], high[3], centre[3];
    double radius; /* of the sphere around the box's centre; > 0 */
} bounds;

/* Which vertices count; NULL: all. */
typedef bool (*bounds_filter)(const scene *s, const scene_object *object, const double *point);

/* False if no vertex counts. World coordinates must be within the loader's range. */
bool bounds_of_scene(bounds *out, const scene *s, bounds_filter counts);
/* The same of all poses together; without poses, of the scene as it is. */
bool bounds_of_poses(bounds *out, scene *s, const scene_poses *p, bounds_filter counts);

#endif
