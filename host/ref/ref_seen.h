/* What ref_seen.c and ref_seen_directional.c share. */
#ifndef GNOMON_REF_SEEN_H
#define GNOMON_REF_SEEN_H

#include "ref_internal.h"

#define PI 3.14159265358979323846

/* dot(n, p) >= d inside; view space: X, Y, Z. */
typedef struct {
    vec3 n;
    double d;
} ref_half_space;

/* A part of the frustum: sides, and its corners. */
typedef struct {
    ref_half_space side[6];
    vec3 corner[8];
} ref_frustum;

/* Bounds of points along the camera's axes, then along the light's; from the camera. */
typedef struct {
    bool any;
    double lo[6], hi[6];
} ref_bounds;

ref_frustum ref_frustum_part(const ref_camera *camera, double first, double last);

/* Of what the frustum's part holds of an object's box. */
ref_bounds ref_bounds_of(const ref_frame *frame, const ref_instance *instance, const ref_frustum *f,
                         const ref_light_view *axes);
bool ref_is_seen(const ref_frame *frame, size_t object_idx);

/* Pixels that x by y would show at depth z, face on. */
double ref_pixels(const ref_camera *camera, double x, double y, double z);

void ref_see_directional(ref_frame *frame, size_t l, int i);

#endif
