/* Triangles, cut to the view and into steps of depth. */
#include "view_range.h"

#include <math.h>
#include <string.h>

#include "vec.h"

enum { STEPS_PER_OCTAVE = 4 };
enum { CORNERS_MAX = 12 }; /* of a triangle cut by seven planes: one more each, and two of them are parallel */

typedef struct {
    int n;
    double corner[CORNERS_MAX][3]; /* view space, depth positive */
} polygon;

static int step_of(double depth)
{
    const double step = floor(STEPS_PER_OCTAVE * log2(depth)) + VIEW_RANGE_STEPS / 2;
    return (int)fmin(fmax(step, 0), VIEW_RANGE_STEPS - 1);
}

/* Where the step ends. */
static double end_of(int step)
{
    return exp2((step + 1 - VIEW_RANGE_STEPS / 2) / (double)STEPS_PER_OCTAVE);
}

/* A corner more; not one that only rounding could bring, of a polygon that it bent. */
static void add_corner(polygon *p, const double *corner)
{
    if (p->n < CORNERS_MAX) memcpy(p->corner[p->n++], corner, sizeof p->corner[0]);
}

/* Keeps the side where a . p >= b: most polygons are there, or are not. */
static void cut(polygon *p, const double *a, double b)
{
    int n_kept = 0;
    for (int i = 0; i < p->n; i++) n_kept += vec_dot(a, p->corner[i]) >= b;
    if (n_kept == p->n) return;
    const polygon whole = *p;
    p->n = 0;
    if (n_kept == 0) return;
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
    const bool parallel = camera->half_height > 0;
    const double side = aspect * (parallel ? camera->half_height : 1 / camera->focal), half = side / aspect;
    const double planes[4][3] = {{1, 0, side}, {-1, 0, side}, {0, 1, half}, {0, -1, half}};
    cut(p, (const double[3]){0, 0, 1}, fmax(camera->near, 1e-100)); /* its square is a number */
    for (int i = 0; i < 4 && p->n > 0; i++) {
        const double *a = planes[i];
        if (parallel) cut(p, (const double[3]){a[0], a[1], 0}, -a[2]);
        else cut(p, a, 0);
    }
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

static void depths_of(const polygon *p, double *nearest, double *deepest)
{
    *nearest = HUGE_VAL;
    *deepest = 0;
    for (int i = 0; i < p->n; i++) {
        *nearest = fmin(*nearest, p->corner[i][2]);
        *deepest = fmax(*deepest, p->corner[i][2]);
    }
}

static void add_steps(view_range *r, polygon *p, double nearest, double deepest, bool parallel)
{
    const int last = step_of(deepest);
    for (int i = step_of(nearest); i <= last && p->n > 0; i++) {
        polygon slice = *p;
        if (i < last) {
            cut(&slice, (const double[3]){0, 0, -1}, -end_of(i));
            cut(p, (const double[3]){0, 0, 1}, end_of(i));
        }
        const double area = fabs(projected_area(&slice, parallel));
        r->part[i] += area;
        r->area += area;
    }
    r->deepest = fmax(r->deepest, deepest);
}

static void add_triangle(view_range *r, const scene *s, const scene_object *o, polygon *p, double aspect)
{
    const bool parallel = s->camera.half_height > 0;
    double nearest, deepest;
    cut_to_view(p, &s->camera, aspect);
    const double area = projected_area(p, parallel);
    if (!((o->two_sided ? fabs(area) : area) > 0)) return;
    depths_of(p, &nearest, &deepest);
    r->nearest = fmin(r->nearest, nearest);
    if (!o->unlit && o->receives) add_steps(r, p, nearest, deepest, parallel);
}

typedef struct {
    double eye[3], axis[3][3]; /* right, up, forward */
} viewer;

static void find_viewer(viewer *out, const scene_affine *camera)
{
    affine_column(out->eye, camera, 3);
    for (int k = 0; k < 3; k++) affine_column(out->axis[k], camera, k);
    for (int k = 0; k < 3; k++) out->axis[2][k] = -out->axis[2][k];
}

static void to_view(double *out, const scene *s, const scene_object *o, size_t vertex, const viewer *v)
{
    double p[3];
    scene_vertex(p, s, o, vertex);
    vec_sub(p, p, v->eye);
    for (int k = 0; k < 3; k++) out[k] = vec_dot(p, v->axis[k]);
}

/* Whether no part of a triangle shows its front. */
static bool faces_away(const polygon *p, int sign, bool parallel)
{
    double u[3], v[3], n[3];
    vec_sub(u, p->corner[1], p->corner[0]);
    vec_sub(v, p->corner[2], p->corner[0]);
    vec_cross(n, u, v);
    return sign * (parallel ? n[2] : vec_dot(n, p->corner[0])) < 0;
}

void view_range_begin(view_range *r)
{
    *r = (view_range){.nearest = HUGE_VAL};
}

void view_range_add(view_range *r, const scene *s, const scene_affine *camera, double aspect)
{
    viewer v;
    polygon p;
    find_viewer(&v, camera);
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        const scene_mesh *mesh = &s->meshes[o->mesh_idx];
        const int sign = scene_object_sign(o);
        for (size_t t = 0; t < mesh->n_triangles && !o->hidden && sign; t++) {
            p.n = 3;
            for (size_t k = 0; k < 3; k++) to_view(p.corner[k], s, o, mesh->idx[3 * t + k], &v);
            if (o->two_sided || !faces_away(&p, sign, s->camera.half_height > 0)) add_triangle(r, s, o, &p, aspect);
        }
    }
}

/* Within a step the area is taken for even. */
double view_range_depth(const view_range *r, double share)
{
    double left = share * r->area;
    for (int i = 0; i < VIEW_RANGE_STEPS; left -= r->part[i++]) {
        if (!(r->part[i] > 0) || r->part[i] < left) continue;
        return fmin(end_of(i - 1) + left / r->part[i] * (end_of(i) - end_of(i - 1)), r->deepest);
    }
    return r->deepest;
}

double view_range_share(const view_range *r, double depth)
{
    double sum = 0;
    const int last = step_of(depth);
    for (int i = 0; i < last; i++) sum += r->part[i];
    sum += r->part[last] * (depth - end_of(last - 1)) / (end_of(last) - end_of(last - 1));
    return r->area > 0 ? sum / r->area : 0;
}
