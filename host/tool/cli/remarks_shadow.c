/* Shadows that are switched on and yet in no picture: all casters are before a light's near plane. */
#include <math.h>
#include <stdio.h>

#include "../../scene/core/vec.h"
#include "remarks.h"

enum { NOTE_BYTES = 300 };

/* To two digits, upwards: as good as a remark can be. */
static double about(double v)
{
    const double digit = pow(10, floor(log10(v)) - 1);
    return ceil(v / digit * (1 - 1e-12)) * digit;
}

static bool wants_shadow(const scene_light *l)
{
    return l->shadow && l->strength > 0 && l->mode != SCENE_BAKED;
}

/* Distance as near planes have it: along a spot's axis, along the nearest axis of a point light's cube. */
static double plane_distance(const scene_light *l, const double *p)
{
    double out[3];
    vec_sub(out, p, l->position);
    if (l->kind == SCENE_LIGHT_SPOT) return vec_dot(out, l->direction);
    return fmax(fabs(out[0]), fmax(fabs(out[1]), fabs(out[2])));
}

/* Of casters before the light; 0: there are none. */
static double farthest_caster(const scene *s, const scene_light *l)
{
    double farthest = 0;
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        const scene_mesh *mesh = &s->meshes[o->mesh_idx];
        if (o->caster == SCENE_CASTER_OFF) continue;
        for (size_t v = 0; v < mesh->n_vertices; v++) {
            double p[3];
            scene_vertex(p, s, o, v);
            farthest = fmax(farthest, plane_distance(l, p));
        }
    }
    return farthest;
}

static int note_near_plane(scene *s, size_t light, char *error, size_t bytes)
{
    const scene_light *l = &s->lights[light];
    char note[NOTE_BYTES];
    if (l->kind == SCENE_LIGHT_DIRECTIONAL || !wants_shadow(l)) return 0;
    const double farthest = farthest_caster(s, l);
    if (!(farthest > 0) || farthest >= l->near) return 0;
    snprintf(
        note, sizeof note,
        "light %zu '%.64s' casts no shadow: its near plane is %.6g away, no caster more than %.6g; --set near@%zu=%.6g",
        light, l->name, l->near, farthest, light, fmax(0.001, about(farthest / 64)));
    return scene_add_note(s, note, error, bytes);
}

int remarks_on_shadows(scene *s, char *error, size_t error_bytes)
{
    for (size_t i = 0; i < s->n_lights; i++)
        if (note_near_plane(s, i, error, error_bytes)) return -1;
    return 0;
}
