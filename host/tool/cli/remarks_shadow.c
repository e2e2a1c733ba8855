/* Shadows that are switched on and yet in no picture: all casters before a light's near plane, all surfaces beyond the
 * shadow distance. */
#include <math.h>
#include <stdio.h>
#include <string.h>

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

/* ---- Near planes ------------------------------------------------------------------------------------------------- */

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

/* ---- The shadow distance ----------------------------------------------------------------------------------------- */

/* What a file without a shadow distance gets at most. One that somebody chose needs no remark. */
static const double default_distance = 100;
static const double few = 1.0 / 10; /* of the picture's area of surfaces */

enum { CORNERS_MAX = 12 }; /* of a triangle cut by six planes: one more each */
typedef struct {
    int n;
    double corner[CORNERS_MAX][3]; /* view space, depth positive */
} polygon;

/* A corner more; not one that only rounding could bring, of a polygon that it bent. */
static void add_corner(polygon *p, const double *corner)
{
    if (p->n < CORNERS_MAX) memcpy(p->corner[p->n++], corner, sizeof p->corner[0]);
}

/* Keeps the side where a . p >= b. */
static void cut(polygon *p, const double *a, double b)
{
    const polygon whole = *p;
    p->n = 0;
    for (int i = 0; i < whole.n; i++) {
        const double *from = whole.corner[i], *to = whole.corner[(i + 1) % whole.n];
        const double d0 = vec_dot(a, from) - b, d1 = vec_dot(a, to) - b;
        double crossing[3];
        if (d0 >= 0) add_corner(p, from);
        if ((d0 >= 0) == (d1 >= 0)) continue;
        for (int k = 0; k < 3; k++) crossing[k] = from[k] + d0 / (d0 - d1) * (to[k] - from[k]);
        add_corner(p, crossing);
    }
}

static void cut_to_view(polygon *p, const scene_camera *camera, double aspect)
{
    const double half_height = camera->half_height;
    if (half_height > 0) {
        cut(p, (const double[3]){0, 0, 1}, camera->near);
        cut(p, (const double[3]){1, 0, 0}, -aspect * half_height);
        cut(p, (const double[3]){-1, 0, 0}, -aspect * half_height);
        cut(p, (const double[3]){0, 1, 0}, -half_height);
        cut(p, (const double[3]){0, -1, 0}, -half_height);
        return;
    }
    const double side = aspect / camera->focal, half = 1 / camera->focal;
    cut(p, (const double[3]){0, 0, 1}, camera->near);
    cut(p, (const double[3]){1, 0, side}, 0);
    cut(p, (const double[3]){-1, 0, side}, 0);
    cut(p, (const double[3]){0, 1, half}, 0);
    cut(p, (const double[3]){0, -1, half}, 0);
}

/* On the plane at distance 1, or on any in parallel rays; positive if its front is seen. */
static double projected_area(const polygon *p, bool parallel)
{
    double sum = 0;
    for (int i = 0; i < p->n; i++) {
        const double *a = p->corner[i], *b = p->corner[(i + 1) % p->n];
        sum += (a[0] * b[1] - a[1] * b[0]) / (parallel ? 1 : a[2] * b[2]);
    }
    return sum / 2;
}

/* Of what is in the view, whether or not something stands before it. */
typedef struct {
    double area, near_area;  /* all, nearer than the shadow distance */
    double nearest, deepest; /* view depth */
} view_range;

static void take_triangle(view_range *out, const scene *s, polygon *p, double aspect, bool two_sided)
{
    cut_to_view(p, &s->camera, aspect);
    double area = projected_area(p, s->camera.half_height > 0);
    if (two_sided) area = fabs(area);
    if (!(area > 0)) return;
    for (int i = 0; i < p->n; i++) {
        out->nearest = fmin(out->nearest, p->corner[i][2]);
        out->deepest = fmax(out->deepest, p->corner[i][2]);
    }
    out->area += area;
    cut(p, (const double[3]){0, 0, -1}, -s->shadow.max_distance);
    out->near_area += fabs(projected_area(p, s->camera.half_height > 0));
}

static void to_view(double *out, const scene *s, const scene_object *o, size_t vertex)
{
    double p[3], eye[3], axis[3];
    scene_vertex(p, s, o, vertex);
    affine_column(eye, &s->camera.to_world, 3);
    vec_sub(p, p, eye);
    for (int k = 0; k < 3; k++) {
        affine_column(axis, &s->camera.to_world, k);
        out[k] = vec_dot(p, axis) * (k == 2 ? -1 : 1);
    }
}

static view_range find_range(const scene *s, double aspect)
{
    view_range out = {.nearest = HUGE_VAL};
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        const scene_mesh *mesh = &s->meshes[o->mesh_idx];
        if (o->hidden || o->unlit || !o->receives) continue;
        for (size_t t = 0; t < mesh->n_triangles; t++) {
            polygon p = {.n = 3};
            for (size_t k = 0; k < 3; k++) to_view(p.corner[k], s, o, mesh->idx[3 * t + k]);
            take_triangle(&out, s, &p, aspect, o->two_sided);
        }
    }
    return out;
}

static int note_distance(scene *s, double aspect, char *error, size_t bytes)
{
    char note[NOTE_BYTES], fraction[64] = "nothing in view is";
    bool any = false;
    for (size_t i = 0; i < s->n_lights; i++) any |= wants_shadow(&s->lights[i]);
    if (!any || s->shadow.max_distance != default_distance) return 0;
    const view_range range = find_range(s, aspect);
    if (!(range.area > 0) || range.near_area >= few * range.area) return 0;
    if (range.near_area > 0)
        snprintf(fraction, sizeof fraction, "only %.2g %% of what is in view is", 100 * range.near_area / range.area);
    snprintf(note, sizeof note,
             "%s nearer than %g, beyond which there are no shadows: it is %.6g to %.6g away; --set max_distance=%.6g",
             fraction, default_distance, range.nearest, range.deepest,
             fmin(8192, about(fmin(range.deepest, s->camera.far))));
    return scene_add_note(s, note, error, bytes);
}

int remarks_on_shadows(scene *s, int width, int height, char *error, size_t error_bytes)
{
    for (size_t i = 0; i < s->n_lights; i++)
        if (note_near_plane(s, i, error, error_bytes)) return -1;
    return note_distance(s, (double)width / height, error, error_bytes);
}
