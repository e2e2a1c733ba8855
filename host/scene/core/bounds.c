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

bool bounds_of_scene(bounds *out, const scene *s, bounds_filter counts)
{
    *out = (bounds){.low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    each_vertex(out, s, counts, grow_box);
    if (!(out->low[0] <= out->high[0])) return false;
    double magnitude = 0;
    for (int k = 0; k < 3; k++) {
        out->centre[k] = out->low[k] / 2 + out->high[k] / 2;
        magnitude = fmax(magnitude, fabs(out->centre[k]));
    }
    each_vertex(out, s, counts, grow_sphere);
    /* A scene that is a single point still needs a camera and lights that stand off it, by more than rounding. */
    out->radius = fmax(out->radius, 1e-9 * magnitude);
    if (!(out->radius > 1e-30)) out->radius = 1;
    return true;
}
