/* The box and sphere of a scene's vertices. */
#include "bounds.h"

#include <math.h>

#include "vec.h"

static void grow_box(bounds *b, const double *p)
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = fmin(b->low[k], p[k]);
        b->high[k] = fmax(b->high[k], p[k]);
    }
}

static void grow_sphere(bounds *b, const double *p)
{
    double out[3];
    vec_sub(out, p, b->centre);
    b->radius = fmax(b->radius, sqrt(vec_dot(out, out)));
}

static void each_vertex(bounds *b, const scene *s, bounds_filter counts, void (*grow)(bounds *, const double *))
{
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *object = &s->objects[i];
        const scene_mesh *mesh = &s->meshes[object->mesh_idx];
        for (size_t v = 0; v < mesh->n_vertices; v++) {
            double p[3];
            scene_vertex(p, s, object, v);
            if (!counts || counts(s, object, p)) grow(b, p);
        }
    }
}

static void begin(bounds *b)
{
    *b = (bounds){.low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

static bool find_centre(bounds *b)
{
    for (int k = 0; k < 3; k++) b->centre[k] = b->low[k] / 2 + b->high[k] / 2;
    return b->low[0] <= b->high[0];
}

/* A scene that is a single point still needs a camera and lights that stand off it, by more than rounding. */
static void widen_point(bounds *b)
{
    double magnitude = 0;
    for (int k = 0; k < 3; k++) magnitude = fmax(magnitude, fabs(b->centre[k]));
    b->radius = fmax(b->radius, 1e-9 * magnitude);
    if (!(b->radius > 1e-30)) b->radius = 1;
}

bool bounds_of_scene(bounds *out, const scene *s, bounds_filter counts)
{
    begin(out);
    each_vertex(out, s, counts, grow_box);
    if (!find_centre(out)) return false;
    each_vertex(out, s, counts, grow_sphere);
    widen_point(out);
    return true;
}

static void each_pose(bounds *b, scene *s, const scene_poses *p, bounds_filter counts,
                      void (*grow)(bounds *, const double *))
{
    for (size_t i = 0; i < p->n; i++) {
        poses_apply(p, i, s);
        each_vertex(b, s, counts, grow);
    }
    poses_apply(p, p->n, s);
}

bool bounds_of_poses(bounds *out, scene *s, const scene_poses *p, bounds_filter counts)
{
    if (p->n == 0) return bounds_of_scene(out, s, counts);
    begin(out);
    each_pose(out, s, p, counts, grow_box);
    if (!find_centre(out)) return false;
    each_pose(out, s, p, counts, grow_sphere);
    widen_point(out);
    return true;
}
