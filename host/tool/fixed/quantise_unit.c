/* The unit of length: the power of two that puts a scene into the range of Q15.16. */
#include "quantise_internal.h"

#include <math.h>
#include <stdio.h>

/* Everything must stay within +-8192 units of the origin and 16384 of the camera; half of that leaves room for both. */
#define WORLD_EXTENT  4096.0
#define UNIT_LOG2_MAX 30

static double extent_of_object(const scene *s, const scene_object *o)
{
    const scene_mesh *mesh = &s->meshes[o->mesh_idx];
    double extent = 0;
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        double p[3];
        scene_vertex(p, s, o, i);
        for (int r = 0; r < 3; r++) extent = fmax(extent, fabs(p[r]));
    }
    for (int r = 0; r < 3; r++) extent = fmax(extent, fabs(o->to_world.m[r][3]));
    return extent;
}

/* Not the range: a light may shine farther than there are surfaces. */
static double extent_of_light(const scene_light *l)
{
    if (l->kind == SCENE_LIGHT_DIRECTIONAL) return l->near_offset;
    double extent = l->near;
    for (int r = 0; r < 3; r++) extent = fmax(extent, fabs(l->position[r]));
    return extent;
}

static double extent_of_camera(const scene_camera *camera)
{
    double extent = camera->half_height;
    for (int r = 0; r < 3; r++) extent = fmax(extent, fabs(camera->to_world.m[r][3]));
    return extent;
}

static void take_farther(quantise_reach *farthest, double extent, quantise_subject subject, size_t idx)
{
    if (extent > farthest->reach) *farthest = (quantise_reach){extent, subject, idx};
}

quantise_reach quantise_farthest(const scene *s)
{
    quantise_reach farthest = {.subject = QUANTISE_CAMERA};
    take_farther(&farthest, extent_of_camera(&s->camera), QUANTISE_CAMERA, 0);
    take_farther(&farthest, s->camera.near, QUANTISE_CAMERA_NEAR, 0);
    take_farther(&farthest, s->shadow.max_distance, QUANTISE_MAX_DISTANCE, 0);
    for (size_t i = 0; i < s->n_objects; i++)
        take_farther(&farthest, extent_of_object(s, &s->objects[i]), QUANTISE_OBJECT, i);
    for (size_t i = 0; i < s->n_lights; i++) take_farther(&farthest, extent_of_light(&s->lights[i]), QUANTISE_LIGHT, i);
    take_farther(&farthest, s->extent, QUANTISE_OBJECT, 0);
    return farthest;
}

int quantise_world_exp(const scene *s)
{
    int e;
    frexp(quantise_farthest(s).reach / WORLD_EXTENT, &e);
    return -e;
}

/* The library takes lengths of the model from the unit in two places: what is near a light, and the disk filter's
 * radius. */
int quantise_unit(gn_scene *out, const scene *s, int world_exp, char *error, size_t error_bytes)
{
    int needed = s->shadow.filter == SCENE_FILTER_DISK || s->shadow.other_filter == SCENE_FILTER_DISK;
    for (size_t i = 0; i < s->n_lights; i++) needed |= s->lights[i].kind != SCENE_LIGHT_DIRECTIONAL;
    int small = world_exp > UNIT_LOG2_MAX, large = world_exp < -UNIT_LOG2_MAX;
    if (needed && (small || large)) {
        snprintf(error, error_bytes,
                 "the scene is too %s for spot and point lights and the disk filter: it must extend to %s %g units",
                 small ? "small" : "large", small ? "at least" : "at farthest",
                 ldexp(WORLD_EXTENT, small ? -UNIT_LOG2_MAX - 1 : UNIT_LOG2_MAX));
        return -1;
    }
    out->unit_log2 = small ? UNIT_LOG2_MAX : large ? -UNIT_LOG2_MAX : world_exp;
    return 0;
}
