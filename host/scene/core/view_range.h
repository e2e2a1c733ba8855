/* How near and how deep what a camera sees is. */
#ifndef GNOMON_HOST_VIEW_RANGE_H
#define GNOMON_HOST_VIEW_RANGE_H

#include "model.h"

/* Steps of depth are a quarter of an octave. */
enum { VIEW_RANGE_STEPS = 1024 };

/* Of what is in the view, whether or not something stands before it; areas are those in the picture. */
typedef struct {
    double nearest;                /* view depth of anything; infinity: there is nothing */
    double deepest, area;          /* of surfaces that shadows can fall on */
    double part[VIEW_RANGE_STEPS]; /* of the area, by depth */
} view_range;

void view_range_begin(view_range *r);
/* What is before this camera, whose lens is the scene's, and beyond its near plane, in a picture of this aspect. */
void view_range_add(view_range *r, const scene *s, const scene_affine *camera, double aspect);
/* The depth that this share of the area is nearer than, to a step. */
double view_range_depth(const view_range *r, double share);
/* The share of the area that is nearer, to a step. */
double view_range_share(const view_range *r, double depth);

#endif
