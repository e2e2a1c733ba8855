/* What the stages of the reference engine share. Stages run in the order of the declarations below; none knows a later one.
 *
 * A stage returns NULL, or the text of what went wrong.
 */
#ifndef GNOMON_REF_INTERNAL_H
#define GNOMON_REF_INTERNAL_H

#include "ref.h"
#include "ref_math.h"

/* DESIGN 1.1 */
typedef struct {
    vec3 position, right, up, forward;
    double half_width_px, half_height_px; /* W/2, H/2 */
    double focal_px;                      /* F */
    double near;
} ref_camera;

/* One object's vertices after its transform. */
typedef struct {
    vec3 *world;
    vec3 *view;   /* X, Y, Z of DESIGN 1.1; Z is the view depth */
    vec3 *normal; /* unit world normals; NULL: face normals */
} ref_instance;

typedef struct {
    double bary[3]; /* perspective-correct */
    bool behind;    /* the surface is seen from its back (two-sided objects only) */
} ref_hit;

/* The bounding sphere of a cascade's slice of the frustum; all lights share it. */
typedef struct {
    bool empty; /* the slice is: never selected */
    vec3 centre;
    double radius;
} ref_sphere;

/* Which cascade a surface point is looked up in, and how far it is from leaving it. */
typedef struct {
    int here;    /* -1: none */
    int next;    /* the next one that is not empty; -1: here is the last */
    double fade; /* F of here, 0..1 */
} ref_selection;

typedef struct {
    const scene *s;
    const ref_options *options;
    ref_picture *picture;
    ref_camera camera;
    ref_instance *instances; /* one per object */
    ref_sphere sphere[REF_MAX_CASCADES];
    ref_hit *hits; /* one per pixel; meaningful where picture->triangle >= 0 */
} ref_frame;

/* Inclusive sample indices; empty if x1 < x0 or y1 < y0. */
typedef struct {
    int x0, y0, x1, y1;
} ref_box;

/* ref_xform.c */
ref_camera ref_make_camera(const scene_camera *camera, int width, int height);
const char *ref_transform_objects(ref_frame *frame);
void ref_free_instances(ref_frame *frame);

/* ref_cascade.c */
int ref_filter_index(scene_filter filter); /* k_f of DESIGN 1.4 */
bool ref_ratios_ascend(const scene_shadow *shadow);
const char *ref_fit_lights(ref_frame *frame); /* and the spheres */
ref_selection ref_select_cascade(const ref_frame *frame, vec3 world);
vec3 ref_to_light(const ref_light_view *view, vec3 world); /* (U, V, D), texels */

/* ref_atlas.c */
const char *ref_render_atlas(ref_frame *frame);

/* ref_raster.c */
ref_box ref_clip_box(vec2 low, vec2 high, int width, int height);
void ref_find_surfaces(ref_frame *frame);

/* ref_light.c */
void ref_light_pixels(ref_frame *frame); /* picture->rgb: linear radiance */

/* ref_pixel.c */
void ref_encode_pixels(ref_frame *frame); /* picture->rgb: as shown */

#endif
